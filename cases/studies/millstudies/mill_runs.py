# SPDX-License-Identifier: GPL-3.0-or-later
"""Mills with changes, and runs of the 12 cm mill's slice with them, each made once and kept.

A run changes a list of settings `path=value`, as every tool takes them after --set. The resulting mill, mill.json, is
in the run's folder, and its fingerprints show what was made from the same inputs:

    charge_FINGERPRINT/      a dry run
    averages_FINGERPRINT/    solids.h5 of a charge, a window and a voxel size
    flows/NAME/              a case of slurryFoam"""
import fcntl
import json
import os
import shutil
import subprocess
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from millfoam.files.data_files import DataError, read_json
from millfoam.files.flow_record import read_flow_record
from millfoam.files.mill import Mill
from millfoam.run import RunError, run, set_options

ROOT = Path(__file__).resolve().parents[3]
MILL = ROOT / "cases" / "mills" / "mill_12cm" / "mill.yaml"
TEMPLATE = ROOT / "scripts" / "mill_case"
DICTIONARIES = ("0.orig", "constant", "system")  # of the template: a case of slurryFoam with balls
SLICES = 5  # of the slice's length in the mill's: mill.yaml has the layers of the whole mill
FINE = ("resolution.cell_size=0.003", f"resolution.layers={4 * SLICES}")  # four times the mill's own cells
# The mill's own case, but longer: two turns bring the slurry to its place, six are averaged (a turn takes 0.983 s)
BASE = ("flow.turns=8", "flow.averages.start=1.9655")
LIMITS = ("max_courant", "max_surface_courant", "max_air_courant", "max_voidage_change", "max_time_step")
OTHER_MESH = "\n// Balls of another mesh's walls, so that runs differ in the mesh alone\n#remove fingerprint\n"


@dataclass(frozen=True)
class Setting:
    """Changes of a run of the slice from BASE: settings of the balls' averages, and settings of the mesh and the flow,
    which leave the balls as they are."""
    name: str
    averages: tuple = ()
    flow: tuple = ()


def resolved(mill, changes=()):
    """The Mill of a mill.yaml with settings `path=value`. RunError with millMesh's message where it refuses one."""
    done = subprocess.run(["millMesh", str(mill), *set_options(changes), "--resolved", "-"], capture_output=True,
                          text=True)
    if done.returncode:
        raise RunError(done.stderr.strip())
    return Mill(mill, json.loads(done.stdout))


def write_mill(mill, folder):
    """Makes a folder with a Mill's mill.json, from which the tools are run in it."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "mill.json").write_text(json.dumps(mill.content, indent=2) + "\n")


def is_of(path, kind, part, mill):
    """Whether a JSON file millfoam-`kind` is there and was made from a Mill's part: charge, averages or flow."""
    try:
        return path.is_file() and read_json(path, kind)["mill"].get(part) == mill.fingerprint[part]
    except DataError:
        return False


@contextmanager
def alone(folder):
    """Waits until no other study makes this folder, and lets others wait meanwhile."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    with open(folder.with_name(f".{folder.name}.lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def make_charge(folder, mill, ranks=2):
    """The dry run of a Mill in a folder: walls/ and dumps/. A complete one is kept, an interrupted one is resumed."""
    write_mill(mill, folder)
    run(folder, "millMesh", "mill.json", "--case", ".", "--walls")
    run(folder, "millDem", "mill.json", "--case", ".", "-np", ranks, "--resume")


def make_averages(mill, runs):
    """Folder, in `runs`, of a Mill's solids.h5."""
    folder = runs / f"averages_{mill.fingerprint['averages']}"
    with alone(folder):
        if not is_of(folder / "solids.json", "averages", "averages", mill):
            charge = runs / f"charge_{mill.fingerprint['charge']}"
            with alone(charge):
                make_charge(charge, mill)
            write_mill(mill, folder)
            run(folder, "millAverage", "mill.json", "--case", Path("..") / charge.name, "-o", "solids.h5")
    return folder


def case_files(own_balls):
    """Dictionaries of a case: path in it -> text. With `own_balls` they refuse the averages of another mill."""
    paths = [path for name in DICTIONARIES for path in sorted((TEMPLATE / name).iterdir())]
    files = {path.relative_to(TEMPLATE): path.read_text() for path in paths}
    if not own_balls:
        files[Path("constant/bedProperties")] += OTHER_MESH
    return files


def summary_of_whole(case):
    """slurryFoam's summary of a case whose flow came to its end, or None."""
    try:
        record = read_flow_record(case)
    except DataError:
        return None
    return record.last if record.complete else None


def is_whole(case, mill, averages, files):
    """Whether a case is a flow that came to its end, of this Mill, with the balls in the folder `averages` and with
    these dictionaries."""
    summary = summary_of_whole(case)
    return bool(summary and summary["mill"].get("flow") == mill.fingerprint["flow"]
                and (case / "solids.h5").resolve().parent == averages.resolve()
                and all((case / name).is_file() and (case / name).read_text() == text for name, text in files.items()))


def make_flow(case, mill, averages, files):
    """Makes a case of these dictionaries and runs slurryFoam in it; removes the folder's earlier content."""
    shutil.rmtree(case, ignore_errors=True)
    write_mill(mill, case)
    for name, text in files.items():
        (case / name).parent.mkdir(exist_ok=True)
        (case / name).write_text(text)
    for name in ("solids.h5", "solids.json"):
        (case / name).symlink_to(Path(os.path.relpath(averages, case)) / name)
    run(case, "millMesh", "mill.json", "--case", ".")
    shutil.copytree(case / "0.orig", case / "0")
    run(case, "slurryStart")
    run(case, "slurryFoam")


def make_run(setting, runs):
    """A setting's flow in the folder `runs`, with what it needs, unless it is complete; returns the case's folder."""
    runs = Path(runs)
    balls = resolved(MILL, (*BASE, *setting.averages))
    mill = resolved(MILL, (*BASE, *setting.averages, *setting.flow))
    averages = make_averages(balls, runs)
    files = case_files(mill.fingerprint["averages"] == balls.fingerprint["averages"])
    case = runs / "flows" / setting.name
    with alone(case):
        if not is_whole(case, mill, averages, files):
            make_flow(case, mill, averages, files)
    return case


def time_step_limits(share):
    """Settings that take a share of all limits on the time-step."""
    usual = resolved(MILL, BASE)
    return tuple(f"flow.{key}={share * usual.asked('flow', key):.12g}" for key in LIMITS)


def make_runs(settings, runs):
    """Every setting's flow, one after the other: (name -> case's folder of complete ones, messages of failed ones)."""
    cases, failures = {}, []
    for setting in settings:
        print(f"{setting.name} …", flush=True)
        try:
            cases[setting.name] = make_run(setting, runs)
        except RunError as error:
            failures.append(f"{setting.name}: {error}")
            print(failures[-1], flush=True)
    return cases, failures
