# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of studies: a folder per run with mill.json, walls, dumps and averages, made once, resumed if killed."""
from dataclasses import dataclass
from pathlib import Path

from millfoam.files.data_files import number, read_json
from millfoam.files.mill import read_mill
from millfoam.files.solids_file import read_map
from millfoam.run import RunError, run

from .mill_runs import is_of, make_charge


@dataclass
class DryRun:
    """A run's results (dumps/results.json) and its map averaged over axis and time."""
    name: str
    results: dict
    charge: object

    def number(self, key):
        """A number of the results, NaN for null; DataError where there is none."""
        return number(self.results, self.name, key)

    @property
    def steady(self):
        """`yes` or `no`, as tables have it."""
        return "yes" if self.results["steady"] else "no"


def is_whole(folder, mill):
    """Whether a folder has the complete averages of a Mill's dry run."""
    return is_of(Path(folder) / "solids.json", "averages", "averages", mill)


def make_dry_run(folder, mill, *, ranks=2, keep_dumps=False):
    """DryRun of a Mill in a folder, whose name is the run's; it is made unless it is complete.

    An interrupted run is resumed, also with another duration. RunError for the run of another mill, which stays as it
    is. Dumps are large: they are removed after they are averaged, unless `keep_dumps`. A complete run is only read."""
    folder = Path(folder)
    if not is_whole(folder, mill):
        refuse_another(folder, mill)
        make_charge(folder, mill, ranks)
        run(folder, "millAverage", "mill.json", "--case", ".")
        if not keep_dumps:
            # The restart files first: without them, no one can resume a run that lacks dumps
            for large in [*(folder / "dem").glob("restart.*"), *(folder / "dumps").glob("dump.*.txt")]:
                large.unlink()
    return DryRun(folder.name, read_json(folder / "dumps" / "results.json", "charge"), read_map(folder / "solids.h5"))


def refuse_another(folder, mill):
    """RunError if a folder holds a run of another charge, or one with other averages, whose dumps may be gone."""
    if not (folder / "mill.json").is_file():
        return
    if (folder / "solids.json").is_file() or read_mill(folder).fingerprint["charge"] != mill.fingerprint["charge"]:
        raise RunError(f"{folder}: holds a run of another mill or with other averages; remove it or move it")
