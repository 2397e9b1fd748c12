# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the 12 cm mill's slice with changes: charge, averages and flows, each made once and kept.

    charge/             the dry run, of the mill case's own mill.yaml
    averages/NAME/      solids.h5 of a window and a voxel size
    flows/NAME/         a case of slurryFoam

Every folder holds the files that it was made from and, once it is whole, the file `whole` with their fingerprint."""
import hashlib
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from .run import RunError, run

MILL = Path(__file__).resolve().parents[2] / "cases" / "mills" / "mill_12cm"
MADE = ("polyMesh", "millProperties")  # in constant/: by millMesh
START = 1.0  # DEM time at flow time 0, s
HALF_BOX = 0.066  # half of the averages' square about the axis, m
AXIAL_VOXEL = 12 / 11  # of the slice's voxels, over their width


@dataclass(frozen=True)
class Setting:
    """What a run of the slice is made with; what is not given is as in the mill case.

    window: s, or `whole`; voxel: width of the averages' voxels, m; steps: share of the mill case's limits on the time-step;
    cell_size (m) and layers: None for the mill case's; law, multiplier: of the drag."""
    name: str
    window: str = "0.05"
    voxel: float = 0.011
    steps: float = 1.0
    cell_size: float = None
    layers: int = None
    law: str = "Beetstra"
    multiplier: float = 1.0

    @property
    def averages(self):
        """Name of the averages that the run takes its balls from."""
        return f"window_{self.window}_voxel_{1e3 * self.voxel:g}mm"


def changed(text, name, entries):
    """The text of file `name` with entries `key value` or `key: value` given new values; each key must be there once."""
    for key, value in entries.items():
        text, count = re.subn(rf"^(\s*{key}\b:?\s+)[^\s;]+", rf"\g<1>{value}", text, flags=re.M)
        if count != 1:
            raise RunError(f"{name}: '{key}' was found {count} times; expected once")
    return text


def case_files(setting):
    """Files of the mill case with the setting's changes: path in the case -> text."""
    folders = [MILL / name for name in ("system", "constant", "0.orig")]
    paths = [path for folder in folders for path in sorted(folder.iterdir()) if path.name not in MADE and path.is_file()]
    files = {str(path.relative_to(MILL)): path.read_text() for path in [MILL / "mill.yaml", *paths]}
    control = files["system/controlDict"]
    limits = {key: float(re.search(rf"^{key}\s+([^;]+);", control, flags=re.M).group(1)) * setting.steps
              for key in ("maxCo", "maxAlphaCo", "maxVoidageChange", "maxDeltaT")}
    mesh = {key: value for key, value in (("cell_size", setting.cell_size), ("layers", setting.layers)) if value}
    edits = {"mill.yaml": mesh, "system/controlDict": {key: f"{value:g}" for key, value in limits.items()},
             "constant/bedProperties": {"law": setting.law, "multiplier": f"{setting.multiplier:g}"}}
    for name, entries in edits.items():
        files[name] = changed(files[name], name, entries)
    return files


def fingerprint(files):
    """Hash of named texts."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name}\0{files[name]}\0".encode())
    return digest.hexdigest()


def is_whole(folder, files):
    """Whether a folder was made, to its end, from these files."""
    stamp = Path(folder) / "whole"
    return stamp.is_file() and stamp.read_text() == fingerprint(files)


def make_once(folder, files, make):
    """Fills a folder by make(folder) from these files (path -> text), unless it is whole; what was interrupted, or made from
    other files, is made anew."""
    folder = Path(folder)
    if is_whole(folder, files):
        return
    shutil.rmtree(folder, ignore_errors=True)
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    make(folder)
    (folder / "whole").write_text(fingerprint(files))


def dry_run(folder):
    """millDem's run of the slice; walls/ and dumps/."""
    run(folder, "millMesh", "mill.yaml", "--case", ".", "--at-time", START)
    run(folder, "millDem", "mill.yaml", "--case", ".", "-np", 2)


def averaging_options(setting, length):
    """millAverage's options for a slice of this length (m), the charge's folder being ../../charge."""
    across = round(2 * HALF_BOX / setting.voxel)
    along = max(1, round(length / (AXIAL_VOXEL * setting.voxel)))
    return ["--dumps", "../../charge/dumps/dump.*.txt", "--box", -HALF_BOX, -HALF_BOX, 0, HALF_BOX, HALF_BOX, length,
            "--shape", across, across, along, "--periodic", "z", "--inside", "../../charge/walls/*.stl", "--start", START,
            "--window", setting.window, "-o", "solids.h5"]


def compute_flow(folder, solids):
    """slurryFoam's run of a case whose balls are in `solids`."""
    (folder / "solids.h5").symlink_to(solids)
    run(folder, "millMesh", "mill.yaml", "--case", ".", "--at-time", START)
    shutil.copytree(folder / "0.orig", folder / "0")
    run(folder, "slurryStart")
    run(folder, "slurryFoam")


def make_run(setting, runs):
    """A setting's flow in the folder `runs`, with what it needs; returns the case's folder."""
    runs = Path(runs)
    mill = {"mill.yaml": (MILL / "mill.yaml").read_text()}
    make_once(runs / "charge", mill, dry_run)
    length = float(re.search(r"^ +length:\s+(\S+)", mill["mill.yaml"], flags=re.M).group(1))
    options = [str(word) for word in averaging_options(setting, length)]
    source = {"charge": fingerprint(mill), "options": " ".join(options) + "\n"}
    averages = runs / "averages" / setting.averages
    make_once(averages, source, lambda folder: run(folder, "millAverage", *options))
    files = {**case_files(setting), "averages": fingerprint(source)}
    case = runs / "flows" / setting.name
    make_once(case, files, lambda folder: compute_flow(folder, Path("../..") / averages.relative_to(runs) / "solids.h5"))
    return case


def make_runs(settings, runs):
    """Every setting's flow, one after the other: (name -> case's folder of what is whole, messages of what failed)."""
    cases, failures = {}, []
    for setting in settings:
        print(f"{setting.name} …", flush=True)
        try:
            cases[setting.name] = make_run(setting, runs)
        except RunError as error:
            failures.append(f"{setting.name}: {error}")
            print(failures[-1], flush=True)
    return cases, failures
