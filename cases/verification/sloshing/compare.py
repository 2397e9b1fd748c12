#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small standing waves in a box and in the round section of a mill, compared with linear theory.

Frequency and damping of slurryFoam and interFoam on the same meshes; slurryFoam also on the round mesh that turns
inside its slip wall, and with a bed at rest in which the waves return slowly. Exit code 1 if a check fails."""
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import curve_fit

import potential_flow
from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

sys.path.insert(0, str(Path(__file__).parent.parent / "pressure_drop"))
import published_laws  # noqa: E402, in that case's folder

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
SLURRY = dict(slurryDensity=1239, slurryKinematicViscosity=1e-6)
AIR = dict(airDensity=1.2, airKinematicViscosity=1.5e-5)
# Box, m. The wave passes through more than two rows of cells: the error depends on the level's place in its row.
WIDTH, HEIGHT, DEPTH, CELLS = 0.2, 0.16, 0.0875, (30, 64)
BOX_AMPLITUDE = 0.003
# Round section, half full. The mesh is turned so that no line of its cells lies in the surface.
RADIUS, TILT, MESH_TURN = 0.15, np.radians(2), np.radians(20)
OMEGA = -6.4  # rad/s, of the turning mesh
SOLIDITY = 0.5
OVERDAMPING = 4.0  # drag per mass over the wave's omega; 2 is critical
BED_DECAY = 1.4  # over the slow rate: how long a wave in a bed is followed, until a quarter of it is left
# Slurry far below its yield stress has the plastic viscosity of the mills' (Pa s) times their viscosity ratio
PLASTIC_VISCOSITY, VISCOSITY_RATIO = 1.4e-3, 1000
RECORDS, STEPS = 20, 150  # per period
TOLERANCE = 0.01
DECAY_TOLERANCE = 0.05  # of stiff slurry's rate of decay
# interFoam's decay in the box, 1/s (README.md, version 1ad2367): the bound of the quick runs, which lack interFoam
INTERFOAM_DECAY = 0.023
CONSERVED = 5e-12  # change of the slurry's volume, relative


@dataclass(frozen=True)
class Run:
    room: str  # box or round
    solver: str  # interFoam or slurryFoam
    bed: bool = False
    turning: bool = False
    stiff: bool = False  # slurry that does not yield
    periods: int = 4

    @property
    def name(self):
        return "_".join([self.room, self.solver] + ["bed"] * self.bed + ["turning"] * self.turning
                        + ["stiff"] * self.stiff)


RUNS = [Run(room, solver) for room in ("box", "round") for solver in ("slurryFoam", "interFoam")]
RUNS += [Run("round", solver, turning=True) for solver in ("slurryFoam", "interFoam")]
RUNS += [Run("box", "slurryFoam", bed=True), Run("round", "slurryFoam", bed=True)]
STIFF = Run("box", "slurryFoam", stiff=True, periods=2)
RUNS.append(STIFF)
PROGRAMS = {"interFoam": "millInterFoam", "slurryFoam": "slurryFoam"}
# interFoam's matrix cannot always be solved with the scheme that slurryFoam uses
CONVECTION = {"interFoam": "linearUpwind grad(U)", "slurryFoam": "limitedLinearV 1"}


def theory(run):
    """The Wave of linear theory."""
    if run.room == "box":
        slurry = potential_flow.box_eigenvalue(WIDTH, DEPTH)
        air = potential_flow.box_eigenvalue(WIDTH, HEIGHT - DEPTH)
    else:
        slurry = air = potential_flow.half_circle_mode(RADIUS)[0]
    rho_s, rho_a = SLURRY["slurryDensity"], AIR["airDensity"]
    fluids = [potential_flow.Fluid(rho_s, slurry), potential_flow.Fluid(rho_a, air)]
    if run.bed:
        free = potential_flow.wave(*fluids, GRAVITY)
        fluids[0].drag = OVERDAMPING * free.omega
        # Darcy's drag is proportional to the viscosity
        fluids[1].drag = fluids[0].drag * AIR["airKinematicViscosity"] / SLURRY["slurryKinematicViscosity"]
    return potential_flow.wave(*fluids, GRAVITY)


def stiff_mode():
    """Rate s (1/s, complex) of the box's first mode, exp(s t), with all of the stiff slurry's viscosity nu and no air.

    The potential A cosh k(y + h) and the vortical part B cosh m(y + h), m^2 = k^2 + s/nu, slip along the floor. Without
    stress at the surface (s + 2 nu k^2)^2 + g k tanh(kh) = 4 nu^2 k^3 m tanh(kh)/tanh(mh) (Lamb 1932, paragraph 349,
    for a finite depth h)."""
    nu = PLASTIC_VISCOSITY * VISCOSITY_RATIO / SLURRY["slurryDensity"]
    k = np.pi / WIDTH
    tanh = np.tanh(k * DEPTH)
    s = 1j * np.sqrt(GRAVITY * k * tanh)
    for _ in range(100):
        m = np.sqrt(k**2 + s / nu)
        s = -2 * nu * k**2 + 1j * np.sqrt(GRAVITY * k * tanh - 4 * nu**2 * k**3 * m * tanh / np.tanh(m * DEPTH))
    return s


def turn_mesh(case, angle):
    """Turns the mesh of a case about z."""
    path = case / "constant" / "polyMesh" / "points"
    head, body = path.read_text().split("\n(\n", 1)
    points = np.array([line.strip("()").split() for line in body.splitlines() if line.startswith("(")], dtype=float)
    c, s = np.cos(angle), np.sin(angle)
    points = points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    path.write_text(head + "\n(\n" + "\n".join("({:.15g} {:.15g} {:.15g})".format(*point) for point in points)
                    + "\n)\n")


def cosine_surface(case):
    """alpha.slurry below y = DEPTH + BOX_AMPLITUDE cos(pi x/WIDTH), exact in each cell's mean over x."""
    edges = np.linspace(0, WIDTH, CELLS[0] + 1)
    k = np.pi / WIDTH
    level = DEPTH + BOX_AMPLITUDE * np.diff(np.sin(k * edges)) / (k * np.diff(edges))
    rows = np.arange(CELLS[1])[:, None]
    alpha = np.clip(level * CELLS[1] / HEIGHT - rows, 0, 1)
    path = case / "0" / "alpha.slurry"
    values = "\n".join(f"{value:.15g}" for value in alpha.ravel())
    path.write_text(path.read_text().replace(
        "internalField   uniform 0;", f"internalField   nonuniform List<scalar> {alpha.size}\n(\n{values}\n);"))


def build(run, case, here):
    wave = theory(run)
    copy_case(case, *(RESOURCES / name for name in ("common", "closed", "turning", "with_interfoam")),
              here / "template", here / "box" if run.room == "box" else RESOURCES / "ogrid")
    period = 2 * np.pi / wave.omega
    drag = OVERDAMPING * wave.omega
    if run.bed:
        end, step = BED_DECAY / wave.slow_rate, 0.03 / drag
    else:
        (case / "constant" / "bedProperties").unlink()
        end, step = run.periods * period, period / STEPS
    write_parameters(
        case, solver=PROGRAMS[run.solver], convection=CONVECTION[run.solver], **SLURRY, **AIR,
        gravity=f"(0 {-GRAVITY} 0)", endTime=end, writeInterval=end / (run.periods * RECORDS), largestStep=step,
        correctors=3 if run.solver == "interFoam" else 1, skewCorrectors=0 if run.room == "box" else 1,
        meshMotion="dynamicMotionSolverFvMesh" if run.turning else "staticFvMesh", meshOmega=OMEGA, solidity=SOLIDITY,
        diameter=published_laws.darcy_diameter(drag, SOLIDITY, SLURRY["slurryKinematicViscosity"]),
        width=WIDTH, height=HEIGHT, cellsX=CELLS[0], cellsY=CELLS[1],
        slurryModel="Bingham" if run.stiff else "Newtonian", plasticViscosity=PLASTIC_VISCOSITY,
        viscosityRatio=VISCOSITY_RATIO, surfaceNormal=f"({-np.sin(TILT):.15g} {np.cos(TILT):.15g} 0)")
    run_program(case, "blockMesh")
    if run.room == "box":
        cosine_surface(case)
    else:
        turn_mesh(case, MESH_TURN)
        run_program(case, "setAlphaField")


@dataclass
class History:
    """The first mode's share of the surface's elevation (m) at the written times (s), and its reference."""
    run: Run
    time: np.ndarray
    elevation: np.ndarray
    volume_change: float  # of the slurry, relative

    @property
    def wave(self):
        return theory(self.run)

    @property
    def fit(self):
        """Fitted omega without damping (rad/s) and rate of decay of the amplitude (1/s)."""
        def damped(t, amplitude, rate, omega, phase, rest):
            return amplitude * np.exp(-rate * t) * np.cos(omega * t + phase) + rest
        guess = (self.elevation[0], 0.01, self.wave.omega, 0, 0)
        _, rate, omega, _, _ = curve_fit(damped, self.time, self.elevation, guess)[0]
        return np.hypot(omega, rate), rate

    @property
    def bed_rate(self):
        """With a bed: rate of decay, 1/s, after the fast mode has decayed."""
        late = self.time > 10 / (self.wave.damping - self.wave.slow_rate)
        return -np.polyfit(self.time[late], np.log(np.abs(self.elevation[late])), 1)[0]

    @property
    def frequency(self):
        """Theory's omega without damping, rad/s."""
        return abs(stiff_mode()) if self.run.stiff else self.wave.omega

    @property
    def error(self):
        """Relative error of the frequency, or with a bed of the rate of decay."""
        if self.run.bed:
            return self.bed_rate / self.wave.slow_rate - 1
        return self.fit[0] / self.frequency - 1

    @property
    def bed_deviation(self):
        """With a bed: largest difference from theory over time, over the elevation at the start."""
        return np.abs(self.elevation / self.elevation[0] - self.wave.from_rest(self.time)).max()


def measure(run, case):
    if run.room == "box":
        shape, norm = lambda x: np.cos(np.pi * x / WIDTH), WIDTH / 2
    else:
        shape = potential_flow.half_circle_mode(RADIUS)[1]
        x = np.linspace(-RADIUS, RADIUS, 2001)
        norm = np.trapz(shape(x) ** 2, x)
    rows = []
    for time, folder in foam.times(case):
        if not rows or run.turning:
            mesh = foam.read_mesh(case, folder)
            centre, volume = mesh.centres_and_volumes()
            thickness = np.ptp(mesh.points[:, 2])
        slurry = foam.read_field(folder / "alpha.slurry", mesh.cells) * volume / thickness
        rows.append((time, (slurry * shape(centre[:, 0])).sum() / norm, slurry.sum()))
    time, elevation, area = np.array(rows).T
    return History(run, time, elevation, np.abs(area / area[0] - 1).max())


def perform(run, work, here):
    case = work / run.name
    build(run, case, here)
    run_program(case, PROGRAMS[run.solver])
    return measure(run, case)


def report(histories, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    lines = [f"{'run':<26} {'theory':>9} {'found':>9} {'error %':>8} {'decay 1/s':>10} {'volume change':>14}"]
    # On the turning mesh interFoam's wave gains energy (see ../rest) and loses slurry, so its damping is no reference
    reference = {"box": INTERFOAM_DECAY} | {
        history.run.room: history.fit[1] for history in histories
        if history.run.solver == "interFoam" and not history.run.turning}
    missed = 0
    for history in histories:
        run, wave = history.run, history.wave
        if run.bed:
            expected, found, decay = wave.slow_rate, history.bed_rate, f"{100 * history.bed_deviation:9.2f}%"
            bad = not (abs(history.error) <= TOLERANCE and history.bed_deviation <= TOLERANCE)
        else:
            expected, (found, rate) = history.frequency, history.fit
            decay = f"{rate:10.4f}"
            if run.stiff:
                bad = not abs(rate / -stiff_mode().real - 1) <= DECAY_TOLERANCE
            else:
                bad = not (run.turning or rate <= reference.get(run.room, np.nan))
            bad = bad or not abs(history.error) <= TOLERANCE
        bad = run.solver == "slurryFoam" and (bad or not history.volume_change <= CONSERVED)
        missed += bad
        lines.append(marked(f"{run.name:<26} {expected:9.4f} {found:9.4f} {100 * history.error:8.3f} {decay} "
                            f"{history.volume_change:14.1e}", bad))
    lines.append("rad/s; with a bed the slow rate of decay, 1/s, and in per cent of the start the largest distance "
                 f"from theory's course. Tolerance {100 * TOLERANCE:g} % for slurryFoam, which may not damp more than "
                 "interFoam where the mesh rests (without a run of interFoam, in the box: "
                 f"{INTERFOAM_DECAY} 1/s)")
    if any(history.run.stiff for history in histories):
        lines.append(f"stiff: theory's decay is {-stiff_mode().real:.4f} 1/s, tolerance {100 * DECAY_TOLERANCE:g} %")
    write_table(lines, out)
    return missed


def plot(histories, out):
    figure, axes = plt.subplots(2, 2, figsize=(13, 8), constrained_layout=True)
    for row, room in zip(axes, ("box", "round")):
        for history in (history for history in histories if history.run.room == room):
            axis = row[int(history.run.bed)]
            axis.plot(history.time, history.elevation / history.elevation[0], "o-", ms=3, lw=0.8, mfc="none",
                      label=history.run.solver + (", mesh turning" if history.run.turning else "")
                      + (", stiff slurry" if history.run.stiff else ""))
        for bed, axis in enumerate(row):
            first = next(history for history in histories if history.run.room == room and history.run.bed == bed)
            time = np.linspace(0, first.time[-1], 600)
            value = first.wave.from_rest(time) if bed else np.cos(first.wave.omega * time)
            axis.plot(time, value, "k-", lw=0.8, label="linear theory, no viscosity")
            axis.set(title={"box": "Box", "round": "Round section, half full"}[room] + (", with a bed" if bed else ""),
                     xlabel="time, s", ylabel="first mode over its start")
            axis.grid(alpha=0.3)
            if not bed:
                axis.set_ylim(-1.1, 1.7)  # room for the legend
            axis.legend(fontsize=8, loc="upper right", ncol=1 if bed else 2)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="two periods of the box with slurryFoam, also with stiff slurry")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    runs = [Run("box", "slurryFoam", periods=2), STIFF] if options.quick else RUNS
    histories = run_jobs(lambda run: perform(run, work, here), runs, options.jobs)
    missed = report(histories, here / "sloshing.txt")
    if not options.quick:
        plot(histories, here / "sloshing.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
