# SPDX-License-Identifier: GPL-3.0-or-later
"""Predictions of a mill's stages from trials on this machine, with constants calibrated on earlier runs
(scripts/README.md, "What it will cost")."""
import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..files.data_files import entry, number
from ..files.mill import Mill
from .trial import Cost, FlowTrial, MeshTrial, try_charge, try_flow, try_mesh


# Calibrated on runs of a 0.6 m, a 12 cm and a 30 cm mill
AIR_COURANT, SLURRY_COURANT = 0.55, 1.05  # limit of the Courant number -> time-step over cell size / speed of the fall
STEP_WITH_BALLS, STEP_WITHOUT = 2.0, 1.35  # mean step of a flow over a step at its start without balls
CELL_BYTES_WITH_BALLS, CELL_BYTES_WITHOUT = 190, 110  # of a written time
FACE_BYTES = 32
FORCES = 1.29  # time of a step of balls that feel a flow, over that of a dry one: (step + force) / step, the median of
# the table of PERFORMANCE.md, "Scale"
RECONSTRUCT_STEPS = 4.4  # time of one written time's reconstruction over a step's on one rank
PARALLEL_GAIN = 0.65  # a step on N ranks takes N^-0.65 of one on one rank
VOXEL_BYTES_WITH_BALLS, VOXEL_BYTES_WITHOUT = 100, 42  # of one window of slurry.h5
SOLIDS_VOXEL_BYTES = 120  # of one window of solids.h5
PICTURES_TIME, FRAME_TIME, FRAMES = 8.0, 0.1, 60  # s; of a frame of the animations, which have 60 at most
PICTURES_DISK, PYTHON_MEMORY = 6e6, 190e6
AVERAGE_MEMORY = 21e6  # without the memory of one record of all balls
RECORD_BYTES = 100  # of one ball in memory
CHARGE_STAGES = ("walls", "charge", "average")
STAGES = (*CHARGE_STAGES, "mesh", "start", "flow")  # after which Allrun --until stops


@dataclass(frozen=True)
class Stage:
    """Prediction of a stage: time (s), disk (bytes), memory (bytes); source: how it was obtained, in words."""
    name: str
    time: float
    disk: float
    memory: float
    source: str


@dataclass(frozen=True)
class FlowPlan:
    """Plan of a flow: typical time-step in s, numbers of steps, of written times and of windows of slurry.h5."""
    time_step: float
    steps: int
    written_times: int
    windows: int


def flow_number(mill: Mill, *keys: str) -> float:
    """A number of the mill's derived flow; DataError names a missing key."""
    return mill.derived("flow", *keys)


def typical_time_step(mill: Mill, cell: float, opening_cell: float = 0.0) -> float:
    """Time-step in s of a flow through cells of that size (m, across the mill) during most of its time.

    opening_cell: size in m of the smallest cell of inlet and outlet, through which slurry falls; 0 without both.

    The limits are the largest one allowed, and those at which slurry that falls through the mill, U = sqrt(2 g D +
    (omega R)^2), and the air above it reach their Courant numbers. A flow is below the smallest for part of the time,
    so the limits are joined smoothly. slurryFoam has one limit for air and two for slurry, of which the smaller counts.
    Other solvers have one for all cells."""
    speed = math.hypot(math.sqrt(4 * mill.derived("gravity_m_s2") * mill.radius), mill.omega * mill.radius)
    apart = mill.flow("solver") == "slurryFoam"
    slurry = min(flow_number(mill, key) for key in ("max_courant", "max_surface_courant"))
    limits = (flow_number(mill, "max_time_step_s"),
              SLURRY_COURANT * slurry * (min(cell, opening_cell) if opening_cell else cell) / speed,
              AIR_COURANT * flow_number(mill, "max_air_courant" if apart else "max_courant") * cell / speed)
    smallest = min(limits)
    return smallest * sum((limit / smallest) ** -8 for limit in limits) ** (-1 / 8)


def plan_flow(mill: Mill, mesh: MeshTrial) -> FlowPlan:
    """FlowPlan of a Mill on a MeshTrial's mesh. Steps are shortened so that they end at the written times."""
    # A stirred mill's cells are in no layers, and about cubes
    cell = (math.sqrt(mesh.volume / mill.length / mesh.cells_in_section) if mesh.cells_in_section
            else (mesh.volume / mesh.cells) ** (1 / 3))
    time_step = typical_time_step(mill, cell, math.sqrt(mesh.smallest_opening_cell))
    duration, interval = flow_number(mill, "duration_s"), flow_number(mill, "write_interval_s")
    time_step = interval / math.ceil(interval / time_step - 1e-6)
    windows = duration / flow_number(mill, "averages", "window_s")
    steps, written_times = duration / time_step, duration / interval
    return FlowPlan(time_step, *(math.ceil(count - 1e-6) for count in (steps, written_times, windows)))


def charge_stage(dem: dict[str, Any]) -> Stage:
    """Stage of the dry run from millDem's plan."""
    keys = ("wall_time_s", "disk_bytes", "memory_bytes")
    time, disk, memory = (number(dem, "dem_plan.json", key) for key in keys)
    return Stage("charge", time, disk, memory, "trial of the dry run")


def average_stage(mill: Mill, dem: dict[str, Any]) -> Stage:
    """Stage of the averages: a ball's record takes about as long as a ball's step of the dry run.

    If the averages start when the charge is steady, this is at half of the dry run at the latest; the prediction
    takes that half."""
    duration, start = mill.asked("dem", "duration"), entry(mill.content, mill.path, "derived", "averages", "start_s")
    span = duration / 2 if start == "steady" else duration - start
    balls = number(dem, "dem_plan.json", "balls")
    records = span / mill.asked("dem", "record_interval")
    voxels = math.prod(entry(mill.content, mill.path, "derived", "averages", "shape"))
    windows = span / mill.derived("averages", "window_s")
    return Stage("average", balls * records / number(dem, "dem_plan.json", "rate_balls_steps_per_s"),
                 SOLIDS_VOXEL_BYTES * voxels * windows, AVERAGE_MEMORY + RECORD_BYTES * balls,
                 "rate of the dry run's trial")


def flow_stage(mill: Mill, mesh: MeshTrial, trial: FlowTrial, plan: FlowPlan, ranks: int) -> Stage:
    """Stage of the flow with its reconstruction."""
    balls = mill.flow("balls")
    step = trial.step_time * (STEP_WITH_BALLS if balls else STEP_WITHOUT)
    rebuilt = RECONSTRUCT_STEPS * trial.step_time * ranks ** PARALLEL_GAIN if ranks > 1 else 0.0
    cell_bytes = CELL_BYTES_WITH_BALLS if balls else CELL_BYTES_WITHOUT
    copies = 2 if ranks > 1 else 1  # in processor* and reconstructed
    fields = plan.written_times * copies * (cell_bytes * mesh.cells + FACE_BYTES * mesh.faces)
    voxels = math.prod(mill.flow("averages")["shape"])
    felt = balls and mill.flow("solver") == "slurryFoam"
    voxel_bytes = VOXEL_BYTES_WITH_BALLS if felt else VOXEL_BYTES_WITHOUT
    averages = voxel_bytes * voxels * (2 * plan.windows + plan.written_times)  # slurry.h5, and the parts it is made of
    source = "trial of the flow's first steps" + ("; at most, less if it is steady before" if mill.flow("steady")
                                                  else "")
    return Stage("flow", plan.steps * step + plan.written_times * rebuilt, fields + averages, ranks * trial.memory,
                 source)


def passes_stage(mill: Mill, stages: Sequence[Stage]) -> Stage | None:
    """Stage of all passes after the dry one, if as many are made as the mill allows; None unless they are made. Each
    repeats the Stages of the dry one, but for the balls' fall into the mill, which is short. The forces make a step of
    the balls longer by FORCES."""
    if mill.flow("coupling", "one_way") != "iterated":
        return None
    one, more = total(stages), round(flow_number(mill, "passes")) - 1
    forces = (FORCES - 1) * sum(stage.time for stage in stages if stage.name == "charge")
    return Stage(f"{more} more pass{'es' if more > 1 else ''}", more * (one.time + forces), more * one.disk, one.memory,
                 "as the first, with forces on the balls; fewer if it settles")


def together_stage(mill: Mill, charge: Stage, flow: Stage) -> Stage:
    """Stage of balls and flow at the same time: one waits for the other; the balls turn as long as the flow. Their
    forces make a step of the balls longer by FORCES."""
    longer = flow_number(mill, "duration_s") / mill.asked("dem", "duration")
    return Stage("balls and flow", FORCES * longer * charge.time + flow.time, longer * charge.disk + flow.disk,
                 charge.memory + flow.memory, "both trials")


def pictures_stage(plan: FlowPlan) -> Stage:
    """Stage of the pictures and the report."""
    return Stage("pictures and report", PICTURES_TIME + FRAME_TIME * min(FRAMES, plan.written_times), PICTURES_DISK,
                 PYTHON_MEMORY, "earlier runs")


def stages_until(last: str | None, stages: Sequence[Stage]) -> list[Stage]:
    """Stages up to one of STAGES, itself included; None: all."""
    return [one for one in stages if last is None or STAGES.index(one.name) <= STAGES.index(last)]


def make_stages(mill: Mill, ranks: int, charge: str | None = None,
                until: str | None = None) -> tuple[list[Stage], FlowPlan | None, MeshTrial]:
    """Stages of a Mill's case, its FlowPlan and MeshTrial; trials are made in a temporary folder.

    charge: folder of the case from which the charge is taken; its stages are then left out. until: the last one of
    STAGES; None: all, with further passes, pictures and report. Up to the mesh there is no FlowPlan. RunError with a
    tool's own message if the tool refuses the mill."""
    path = mill.path.resolve()
    trial = None
    with tempfile.TemporaryDirectory(prefix="millfoam-plan-") as folder:
        dry = try_charge(folder, path, ranks) if (mill.flow("balls") or until in CHARGE_STAGES) and not charge else None
        case = Path(folder) / "case"
        case.mkdir()
        mesh = try_mesh(case, path, mill.machine)
        if until not in (*CHARGE_STAGES, "mesh"):
            trial = try_flow(case, mill.flow("solver"), flow_number(mill, "max_time_step_s"), ranks)
    made = Cost(mesh.cost.time, mesh.cost.memory)
    stages = []
    if dry:
        stages = [Stage("walls", made.time, mesh.walls_disk, made.memory, "made here"), charge_stage(dry),
                  average_stage(mill, dry)]
    stages.append(Stage("mesh", made.time, mesh.mesh_disk, made.memory, "made here"))
    if not trial:
        return stages_until(until, stages), None, mesh
    plan = plan_flow(mill, mesh)
    stages.append(Stage("start", trial.start.time, trial.start_disk, trial.start.memory, "made here"))
    if until == "start":
        return stages, plan, mesh
    flow = flow_stage(mill, mesh, trial, plan, ranks)
    direct = dry and mill.flow("coupling", "one_way") == "direct"
    stages.append(together_stage(mill, stages[1], flow) if direct else flow)
    if until:
        return stages, plan, mesh
    passes = passes_stage(mill, stages)
    stages += [passes] if passes else []
    return [*stages, pictures_stage(plan)], plan, mesh


def total(stages: Sequence[Stage]) -> Stage:
    """Stage of all: sums of time and disk, the largest memory."""
    return Stage("total", sum(one.time for one in stages), sum(one.disk for one in stages),
                 max((one.memory for one in stages), default=0.0), "")
