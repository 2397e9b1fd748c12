#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls at rest on a mesh that turns, as in a stirred mill, compared with closed forms: Couette flow between a turning
shaft and a shell at rest, on a mesh that turns and on one at rest; the surface of a liquid that turns with its vessel,
from the closed form and from rest; a pool at rest around an impeller at rest. Exit code 1 if a check fails."""
import math
import re
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.files.mill import Mill, read_mill
from millfoam.files.tables import read_columns
from millfoam.run import case_options, fresh_runs, limit_table, run, run_jobs, set_options, stop_mill, write_table

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
TEMPLATE = HERE.parents[2] / "scripts" / "mill_case"
STIRRED = HERE.parents[1] / "mills" / "stirred_A" / "mill.yaml"
HEAD = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
MIDDLE = (0.4, 0.8)  # shares of the height between which Couette flow is read, away from the ends
# Largest differences: of Couette flow from the closed form, over the shaft's speed, and of the two meshes; of the
# torques of shaft and shell; of the surface from the paraboloid, over its rise; of a pool at rest, m/s.
# At a curved wall OpenFOAM's stress is of first order: with nine cells between shaft and shell, torques differ by some
# percent, and their difference halves with the cells
COUETTE, MESHES, TORQUE, SURFACE, STILL = 0.02, 0.005, 0.08, 0.02, 0.002
KEPT = 0.01  # of a surface that begins as the paraboloid, over its rise
PASSED = 1e-12  # slurry through closed walls, over the shaft's speed times the shell's area
PARABOLOID = 11.2509  # rad/s, sqrt(g/R): the surface has 45 degrees at the shell
KEEPS, SPINS_UP = "vessel, from the paraboloid", "vessel, from rest"
WALLS = {
    "turning": '"(base|lid)" { type slip; } impeller { type movingWallVelocity; value uniform (0 0 0); }\n'
               'shell { type restingWallVelocity; value uniform (0 0 0); }',
    "rest": '"(base|lid)" { type slip; } shell { type fixedValue; value uniform (0 0 0); }\n'
            'impeller { type rotatingWallVelocity; origin (0 0 0); axis (0 0 1); omega $omega; }',
    "vessel": '".*" { type movingWallVelocity; value uniform (0 0 0); }',
    "pool": '".*" { type fixedValue; value uniform (0 0 0); }',
}


@dataclass(frozen=True)
class Run:
    """One flow: its mill.yaml and changes, the walls (of WALLS), whether the mesh turns, whether slurry fills it, and
    whether it begins as the paraboloid."""
    mill: Path
    changes: tuple[str, ...]
    walls: str
    turns: bool
    full: bool = False
    turning: bool = False


def runs(quick: bool) -> dict[str, Run]:
    """Name -> run."""
    own = HERE / "mill.yaml"
    still = ("speed.angular_velocity=0.02", "slurry={density: 1379, plastic_viscosity: 0.0022, yield_stress: 0, "
             "level: 0.0775}", "flow.balls=false", f"flow.duration={0.05 if quick else 1}",
             "flow.write_interval=0.05", "flow.max_time_step=0.002",
             f"resolution.cell_size={0.0775 / (9 if quick else 12):.6g}")
    # The closed form has no viscosity: with twice as much the flow is steady in half of the time
    couette = (f"resolution.cell_size={0.0775 / (18 if quick else 24):.6g}", f"flow.duration={0.12 if quick else 0.4}",
               f"flow.max_time_step={0.002 if quick else 0.0005}",
               f"slurry.plastic_viscosity={10 if quick else 5}")
    found = {"Couette, turning mesh": Run(own, couette, "turning", True, True),
             "Couette, mesh at rest": Run(own, couette, "rest", False, True),
             "pool at rest": Run(STIRRED, still, "pool", False)}
    # The shaft ends near the surface, because cells grow above the impeller
    vessel = (f"speed.angular_velocity={PARABOLOID}", "geometry.height=0.15",
              "geometry.impeller.shaft={diameter: 0.02, end: 0.06}", "slurry.plastic_viscosity=2",
              "flow.max_time_step=0.002")
    keeps = (f"flow.duration={0.2 if quick else 0.3}", f"resolution.cell_size={0.0775 / (10 if quick else 14):.6g}")
    found[KEEPS] = Run(own, (*vessel, *keeps), "vessel", True, turning=True)
    if not quick:
        found[SPINS_UP] = Run(own, (*vessel, "flow.duration=3", f"resolution.cell_size={0.0775 / 20:.6g}"), "vessel",
                              True)
    return found


def start_turning(case: Path) -> None:
    """Writes share and velocity of a liquid that turns with its vessel."""
    mill = read_mill(case, "stirred")
    mesh = foam.read_mesh(case)
    centre, _ = mesh.centres_and_volumes()
    omega = mill.derived("speed", "angular_velocity_rad_s")
    slope = omega**2 / (2 * GRAVITY)
    level = mill.asked("slurry", "level")
    inner, outer = extents(mesh, np.hypot(mesh.points[:, 0], mesh.points[:, 1]))
    lower, upper = extents(mesh, mesh.points[:, 2])
    share = np.zeros(mesh.cells)
    for part in (np.arange(8) + 0.5) / 8:
        height = level + slope * ((inner + (outer - inner) * part)**2 - mill.radius**2 / 2)
        share += np.clip((height - lower) / (upper - lower), 0, 1) / 8
    write_field(case / "0" / "alpha.slurry", "scalar", [f"{value:.12g}" for value in share])
    write_field(case / "0" / "U", "vector", [f"({-omega * y:.12g} {omega * x:.12g} 0)" for x, y, _ in centre])


def extents(mesh: foam.Mesh, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Smallest and largest of the points' values in each cell."""
    low, high = np.full(mesh.cells, np.inf), np.full(mesh.cells, -np.inf)
    for cells in (mesh.owner, mesh.neighbour):
        np.minimum.at(low, cells, [values[face].min() for face in mesh.faces[:len(cells)]])
        np.maximum.at(high, cells, [values[face].max() for face in mesh.faces[:len(cells)]])
    return low, high


def write_field(path: Path, kind: str, values: list[str]) -> None:
    """Replaces the uniform field of a file."""
    text = path.read_text()
    words = "\n".join((f"nonuniform List<{kind}> {len(values)}", "(", *values, ")"))
    path.write_text(re.sub(r"(internalField\s+)uniform [^;]*;", lambda found: f"{found[1]}{words};", text))


def compute(item: tuple[str, Run]) -> Path:
    """Runs a flow in a folder of its own."""
    name, what = item
    case = HERE / "runs" / name.replace(", ", "_").replace(" ", "_")
    for folder in ("0.orig", "constant", "system"):
        shutil.copytree(TEMPLATE / folder, case / folder)
    (case / "constant" / "bedProperties").unlink()
    run(case, "millMesh", what.mill, *set_options(what.changes), "--case", ".", "--resolved", "mill.json")
    run(case, "millMesh", "mill.json", "--case", ".", "--at-time", 0)
    shutil.move(case / "0.orig", case / "0")
    (case / "0" / "U").write_text(
        HEAD.format(kind="volVectorField", name="U") + '#include "<case>/constant/millProperties"\n'
        "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\n"
        "boundaryField\n{\n" + WALLS[what.walls] + "\n}\n")
    if not what.turns:
        (case / "constant" / "dynamicMeshDict").write_text(
            HEAD.format(kind="dictionary", name="dynamicMeshDict") + "dynamicFvMesh staticFvMesh;\n")
    if what.walls == "pool":
        stop_mill(case)
    if what.full:
        alpha = case / "0" / "alpha.slurry"
        alpha.write_text(alpha.read_text().replace("internalField   uniform 0;", "internalField   uniform 1;"))
    elif what.turning:
        start_turning(case)
    else:
        run(case, "slurryStart")
    run(case, "slurryFoam")
    return case


@dataclass
class State:
    """A flow at its end: of each cell its centre [n, 3] in the lab (m), volume (m3), velocity [n, 3] (m/s), share."""
    mill: Mill
    centre: np.ndarray
    volume: np.ndarray
    velocity: np.ndarray
    share: np.ndarray
    radius: np.ndarray
    around: np.ndarray


def state_of(case: Path, turns: bool) -> State:
    mill = read_mill(case, "stirred")
    mesh = foam.read_mesh(case)
    centre, volume = mesh.centres_and_volumes()
    time, folder = foam.times(case)[-1]
    if turns:
        angle = mill.derived("speed", "angular_velocity_rad_s") * time
        cosine, sine = math.cos(angle), math.sin(angle)
        centre = centre @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
    velocity = foam.read_field(folder / "U", mesh.cells)
    radius = np.hypot(centre[:, 0], centre[:, 1])
    around = (centre[:, 0] * velocity[:, 1] - centre[:, 1] * velocity[:, 0]) / radius
    return State(mill, centre, volume, velocity, foam.read_field(folder / "alpha.slurry", mesh.cells), radius, around)


def couette(mill: Mill, radius: np.ndarray) -> np.ndarray:
    """Velocity around the axis (m/s) at radii (m) between a turning shaft and a shell at rest."""
    outer, inner = mill.radius, mill.impeller["shaft_diameter_m"] / 2
    omega = mill.derived("speed", "angular_velocity_rad_s")
    return omega * inner**2 / (outer**2 - inner**2) * (outer**2 / radius - radius)


def paraboloid(state: State) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Radii of rings of columns from lid to base, heights of the slurry there, and those of the closed form, m."""
    mill = state.mill
    omega, length = mill.derived("speed", "angular_velocity_rad_s"), mill.length
    shaft, shell = mill.impeller["shaft_diameter_m"] / 2, mill.radius
    outside = state.radius > shaft
    radius, share, volume = state.radius[outside], state.share[outside], state.volume[outside]
    # Not narrower than a cell
    rings = min(12, int((shell - shaft) / mill.derived("resolution", "cell_size_m")))
    ring = np.digitize(radius, np.linspace(shaft, shell, rings + 1)) - 1
    wet, room, square = (np.bincount(ring, values, rings) for values in (share * volume, volume, radius**2 * volume))
    at = np.sqrt(square / room)
    slope = omega**2 / (2 * GRAVITY)
    # The slurry's volume outside of the shaft's radius is that of the closed form
    mean = wet.sum() / room.sum() * length
    middle = mean - slope * (shell**2 + shaft**2) / 2
    return at, wet / room * length, middle + slope * at**2


def table(found: dict[str, Path], what: dict[str, Run]) -> tuple[list[tuple[str, float, float]], dict[str, State]]:
    """Rows (text, found, allowed) and the states at the end."""
    states = {name: state_of(case, what[name].turns) for name, case in found.items()}
    rows = []
    profiles = {}
    for name in ("Couette, turning mesh", "Couette, mesh at rest"):
        state = states[name]
        low, high = (share * state.mill.length for share in MIDDLE)
        shaft_radius = state.mill.impeller["shaft_diameter_m"] / 2
        chosen = (state.centre[:, 2] > low) & (state.centre[:, 2] < high) & (state.radius > shaft_radius)
        speed = state.mill.derived("speed", "angular_velocity_rad_s") * shaft_radius
        error = np.abs(state.around - couette(state.mill, state.radius))[chosen] / speed
        rows.append((f"{name}: largest difference from the closed form", error.max(), COUETTE))
        columns = read_columns(found[name], "slurryBalance")
        shaft, shell = columns["torque_impeller"][-1], columns["torque_shell"][-1]
        rows.append((f"{name}: torques of shaft and shell, sum over one", abs(shaft + shell) / abs(shaft), TORQUE))
        swept = speed * 2 * math.pi * state.mill.radius * state.mill.length
        rows.append((f"{name}: slurry through the walls, share", np.abs(columns["discharge"]).max() / swept, PASSED))
        profiles[name] = state.around[chosen] / speed
    rows.append(("the two meshes, largest difference",
                 np.abs(np.subtract(*profiles.values())).max(), MESHES))
    pool = states["pool at rest"]
    largest = max(np.linalg.norm(foam.read_field(folder / "U", len(pool.volume)), axis=1)[
        foam.read_field(folder / "alpha.slurry", len(pool.volume)) > 0.5].max()
        for time, folder in foam.times(found["pool at rest"]) if time > 0)
    rows.append(("pool at rest: largest speed of the slurry, m/s", largest, STILL))
    for name, allowed in ((KEEPS, KEPT), (SPINS_UP, SURFACE)):
        if name in states:
            _, height, closed = paraboloid(states[name])
            rise = PARABOLOID**2 * states[name].mill.radius**2 / (2 * GRAVITY)
            rows.append((f"{name}: surface from the paraboloid, over its rise", np.abs(height - closed).max() / rise,
                         allowed))
    return rows, states


def draw(states: dict[str, State]) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    for (name, state), mark in zip(((n, s) for n, s in states.items() if n.startswith("Couette")), "ox"):
        chosen = np.abs(state.centre[:, 2] / state.mill.length - 0.6) < 0.05
        order = np.argsort(state.radius[chosen])[::7]
        axes[0].plot(1e3 * state.radius[chosen][order], state.around[chosen][order], mark, ms=4, label=name)
    line = np.linspace(state.mill.impeller["shaft_diameter_m"] / 2, state.mill.radius)
    axes[0].plot(1e3 * line, couette(state.mill, line), "k", lw=1, label="closed form")
    axes[0].set(xlabel="radius, mm", ylabel="velocity around the axis, m/s", title="A turning shaft in a shell at rest")
    axes[0].legend()
    for name, mark in ((KEEPS, "x"), (SPINS_UP, "o")):
        if name in states:
            radius, height, closed = paraboloid(states[name])
            axes[1].plot(1e3 * radius, 1e3 * height, mark, label=name)
    axes[1].plot(1e3 * radius, 1e3 * closed, "k", lw=1, label="paraboloid")
    axes[1].set(xlabel="radius, mm", ylabel="height of the slurry, mm", title="A vessel that turns with its liquid")
    axes[1].set_aspect("equal")
    axes[1].legend()
    figure.savefig(HERE / "stirred_walls.png", dpi=120)


def main() -> int:
    options = case_options(__doc__, "coarser cells, a shorter pool, and no vessel from rest")
    fresh_runs(HERE)
    what = runs(options.quick)
    found = dict(zip(what, run_jobs(compute, what.items(), options.jobs)))
    rows, states = table(found, what)
    lines, missed = limit_table(rows)
    write_table(lines, HERE / "stirred_walls.txt")
    draw(states)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
