# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials on this machine: the cost of the dry run, the mesh and a step of the flow of one mill."""
import os
import shutil
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..files.data_files import number, read_json
from ..files.tables import TableError, read_table
from ..run import RunError

TEMPLATE = Path(__file__).resolve().parents[2] / "mill_case"
TRIAL_TIME = 20.0  # s, longest time of the flow's trial
LARGEST_STEPS = 30  # its length in largest time-steps: about 40 steps, because the first ones are shorter
FIRST_STEPS = 10  # not counted, because the time-step grows from its first value
WITHOUT_BALLS = ("flow.balls=no", "flow.coupling=one_way", "flow.exchange=~")  # what makes a mill's flow one of slurry
FEWEST_STEPS = 4  # on a mesh too large for the trial's time, the trial makes this many, or a multiple


@dataclass(frozen=True)
class Cost:
    """Wall time in s, largest memory of one process in bytes."""
    time: float
    memory: float


@dataclass(frozen=True)
class MeshTrial:
    """A mesh made here: its cost; its cells, faces and cells of a cross-section (0: in no layers); its volume in m3;
    smallest face of inlet and outlet in m2 (0: without both); disk of walls and mesh in bytes."""
    cost: Cost
    cells: int
    faces: int
    cells_in_section: int
    volume: float
    smallest_opening_cell: float
    walls_disk: float
    mesh_disk: float


@dataclass(frozen=True)
class FlowTrial:
    """Start and first steps of the flow without balls: cost of the start, its disk in bytes, s of one step, memory in
    bytes of one rank."""
    start: Cost
    start_disk: float
    step_time: float
    memory: float


def disk(*paths: Path) -> float:
    """Bytes of all files in folders."""
    return float(sum(file.stat().st_size for path in paths for file in Path(path).rglob("*") if file.is_file()))


def run_measured(folder: Path | str, *command: Any, log: str = "log", watch: Callable[[float], None] | None = None,
                 ranks: int = 1) -> Cost:
    """Runs a command in a folder and returns its Cost. RunError with the command's own message if it fails.

    log: file in the folder for the command's output. watch(seconds): called repeatedly while it runs."""
    environment = {**os.environ, "PWD": str(Path(folder).resolve()), "MILLFOAM_NP": str(ranks)}
    begun, place = time.monotonic(), Path(folder) / log
    with open(place, "w") as out:
        child = subprocess.Popen([str(word) for word in command], cwd=folder, env=environment, stdout=out,
                                 stderr=subprocess.STDOUT)
    try:
        pid, code, resources = os.wait4(child.pid, os.WNOHANG)
        while not pid:
            if watch:
                watch(time.monotonic() - begun)
            time.sleep(0.02)
            pid, code, resources = os.wait4(child.pid, os.WNOHANG)
    except BaseException:
        child.terminate()
        raise
    child.returncode = os.waitstatus_to_exitcode(code)
    if child.returncode:
        raise RunError(error_message(command[0], place))
    return Cost(time.monotonic() - begun, 1024.0 * resources.ru_maxrss)


def error_message(program: str, log: Path) -> str:
    """A tool's own error message, or the end of its output if there is none."""
    lines = [line for line in log.read_text(errors="replace").splitlines() if line.strip()]
    for place, line in enumerate(lines):
        if ": error:" in line:
            return "\n".join(lines[place:])
    return "\n".join([f"{program} failed; its output ends with:", *lines[-15:]])


def try_charge(folder: Path | str, mill: Path | str, ranks: int) -> dict[str, Any]:
    """Content of millDem's plan of a mill.json: time, disk and memory of the dry run from a trial of half a minute."""
    file = Path(folder) / "dem_plan.json"
    run_measured(folder, "millDem", "plan", mill, "-np", ranks, "--json", file)
    return read_json(file, "dem-plan")


def try_mesh(folder: Path | str, mill: Path | str, machine: str = "tumbling") -> MeshTrial:
    """Makes `folder` a case of the mill without balls, with its mesh, and returns its MeshTrial; machine: tumbling or
    stirred, whose walls need other dictionaries. Balls that feel the slurry have the same mesh."""
    folder = Path(folder)
    for part in ("0.orig", "constant", "system"):
        shutil.copytree(TEMPLATE / part, folder / part)
    if machine != "tumbling":
        shutil.copytree(TEMPLATE / machine, folder, dirs_exist_ok=True)
    alone = [word for change in WITHOUT_BALLS for word in ("--set", change)]
    cost = run_measured(folder, "millMesh", mill, *alone, "--case", ".")
    file = folder / "mesh.json"
    mesh = read_json(file, "mesh")
    count = {key: int(number(mesh, file, key)) for key in ("cells", "faces", "cells_in_section")}
    return MeshTrial(cost, **count, volume=number(mesh, file, "volume_m3"),
                     smallest_opening_cell=number(mesh, file, "smallest_opening_cell_m2"),
                     walls_disk=disk(folder / "walls"), mesh_disk=disk(folder / "constant"))


def shorten(folder: Path, largest_step: float) -> None:
    """Ends a case's flow after about forty steps, or earlier if a file `stop` appears in the case. A table records the
    time of each step."""
    with open(folder / "system" / "controlDict", "a") as control:
        control.write(f"endTime {LARGEST_STEPS * largest_step:.9g};\n"
                      'functions { trial { type abort; libs ("libutilityFunctionObjects.so"); '
                      'file "<case>/stop"; action noWriteNow; '
                      f'timeStart 1e-12; executeControl timeStep; executeInterval {FEWEST_STEPS}; '
                      f'writeControl timeStep; writeInterval {FEWEST_STEPS}; }} '
                      'steps { type timeInfo; libs ("libutilityFunctionObjects.so"); } '
                      # The mean over the run begins before this early end, too
                      'voxelAverages { start 0; } }\n')


def try_flow(folder: Path | str, solver: str, largest_step: float, ranks: int) -> FlowTrial:
    """FlowTrial of a mill's case with the mesh of try_mesh. largest_step: largest time-step, s."""
    case = Path(folder)
    program = ["slurryFoam"]
    if solver == "interFoam":
        program = ["millInterFoam"]
        shutil.copytree(TEMPLATE / "interFoam", case, dirs_exist_ok=True)
        (case / "constant" / "fvOptions").unlink()
    (case / "constant" / "bedProperties").unlink()
    shorten(case, largest_step)
    shutil.copytree(case / "0.orig", case / "0")
    start = [run_measured(case, "slurryStart", ranks=ranks)]
    if ranks > 1:
        start.append(run_measured(case, "decomposePar", "-force", ranks=ranks))
        program = ["mpirun", "-np", str(ranks), *program, "-parallel"]
    start_disk = disk(case / "0", *case.glob("processor*"))

    def watch(seconds: float) -> None:
        if seconds > TRIAL_TIME:
            (case / "stop").touch()
    cost = run_measured(case, *program, log="log.flow", watch=watch, ranks=ranks)
    return FlowTrial(Cost(sum(one.time for one in start), max(one.memory for one in start)), start_disk,
                     step_time(execution_times(case)), cost.memory)


def execution_times(folder: Path | str) -> Sequence[float]:
    """CPU times in s [steps] of a trial's solver at the end of each step; empty if there is none."""
    try:
        names, rows = read_table(folder, "steps", "timeInfo")
    except TableError:
        return []
    return list(rows[:, names.index("cpuTime")])


def step_time(times: Sequence[float]) -> float:
    """Mean time in s of a step after the first ones. RunError if there are too few steps."""
    if len(times) < 2:
        raise RunError(f"the trial of the flow made {len(times)} steps; expected 2 or more")
    first = min(FIRST_STEPS, len(times) // 2)
    return (times[-1] - times[first - 1]) / (len(times) - first)
