# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of studies: a folder per run with mill.yaml, walls, dumps and averages, each made once, gone on with after a kill."""
import re
from dataclasses import dataclass
from pathlib import Path

from .mill_runs import changed, is_whole, fingerprint
from .run import RunError, run
from .solids import read_map


@dataclass
class DryRun:
    """A run's results (dumps/results.txt: name -> number or word) and its map averaged over axis and time."""
    name: str
    results: dict
    charge: object

    def number(self, key):
        return float(self.results[key])


def read_results(path):
    """Lines `key value` of a results.txt as a dictionary; numbers as text."""
    return dict(line.split(maxsplit=1) for line in Path(path).read_text().splitlines())


def make_dry_run(folder, mill, averaging, *, ranks=2, keep_dumps=False):
    """Runs millMesh, millDem and millAverage in a folder, unless that was done with the same mill and options before.

    folder: its name is the run's; mill: text of mill.yaml; averaging: millAverage's options but for dumps, walls and file.
    A run that was broken off is gone on with, also with another duration; one of another mill is left alone: RunError. Dumps
    are large: they are removed once they are averaged, unless `keep_dumps`."""
    folder = Path(folder)
    files = run_files(mill, averaging)
    if not is_whole(folder, files):
        begun = folder / "mill.yaml"
        if begun.is_file() and (without_duration(begun.read_text()) != without_duration(mill) or (folder / "whole").is_file()):
            raise RunError(f"{folder}: holds a run of another mill.yaml or other averages; remove it, or keep it elsewhere")
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in files.items():
            (folder / name).write_text(text)
        run(folder, "millMesh", "mill.yaml", "--case", ".")
        run(folder, "millDem", "mill.yaml", "--case", ".", "-np", ranks, "--resume")
        run(folder, "millAverage", "--dumps", "dumps/dump.*.txt", "--inside", "walls/*.stl", *averaging, "-o", "solids.h5")
        (folder / "whole").write_text(fingerprint(files))
    if not keep_dumps:
        # The restart files first: without them nobody goes on with a run that lacks dumps
        for large in [*(folder / "dem").glob("restart.*"), *(folder / "dumps").glob("dump.*.txt")]:
            large.unlink()
    return DryRun(folder.name, read_results(folder / "dumps" / "results.txt"), read_map(folder / "solids.h5"))


def run_files(mill, averaging):
    """What a run is made from: name of a file in its folder -> text."""
    return {"mill.yaml": mill, "averaging": " ".join(map(str, averaging)) + "\n"}


def without_duration(mill):
    """A mill.yaml's text but for the dry run's length."""
    return re.sub(r"duration: +[^\s,}]+", "duration", mill)


def with_entries(mill, **entries):
    """A mill.yaml's text with the entries `key: value` given new values; each key must be there once."""
    return changed(mill, "mill.yaml", entries)
