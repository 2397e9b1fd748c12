#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bingham slurry between an inner cylinder that turns and an outer one at rest, compared with the closed form.

With the torque 2 pi T per length the shear stress is T/r^2. Where it is above the yield stress, up to r0 =
sqrt(T/tau0), the slurry shears; beyond, it rests. Its angular velocity is

    w(r) = tau0/(2 mu) [(r0/r)^2 - 1 - 2 ln(r0/r)]        for r < r0, else 0

(Bird, Dai & Yarusso 1983, Rev. Chem. Eng. 1:1.) Runs have both regularisations and softer plugs: the error must
decrease with the regularisation, and every profile must agree with its regularised flow curve. Exit code 1 if a check
fails."""
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import brentq

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

sys.path.insert(0, str(Path(__file__).parent.parent / "bingham_poiseuille"))
from flow_curve import regularised  # noqa: E402

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
# Viscous enough to be steady soon
DENSITY, YIELD_STRESS, PLASTIC_VISCOSITY = 1239.0, 1.0, 0.1
INNER, OUTER, EDGE = 0.02, 0.04, 0.03  # m; the edge of the plug
RADIAL_CELLS, QUARTER_CELLS = 60, 8
# The middles of the faces, which are flat, lie on the cylinders: the speeds are known there
CORNERS = 1 / np.cos(np.pi / (4 * QUARTER_CELLS))
REGULARISATIONS = ("biviscosity", "Papanastasiou")
# Of the stiffest plug: viscosity ratio, and m times tau0/mu, which is its viscosity ratio less 1
STIFFEST = {"biviscosity": 300.0, "Papanastasiou": 600.0}
SOFTER = (0.1, 0.3)
# The viscosity ratio of the mills' cases, 1000, on a finer mesh and for longer: the viscosity jumps more at the plug's
# edge
MILL, MILL_CELLS, MILL_END = 1000 / STIFFEST["biviscosity"], 120, 4.0
STEP, END = 8e-3, 2.4  # s
TOLERANCE = 0.01
# Steady to this change of the largest speed inside the yielded slurry over the last tenth of the run
STEADY = 1e-4


def exact(r):
    """Closed-form tangential speed, m/s, at the radii r, m."""
    ratio = np.maximum(EDGE / r, 1)
    return r * YIELD_STRESS / (2 * PLASTIC_VISCOSITY) * (ratio**2 - 1 - 2 * np.log(ratio))


OMEGA = exact(INNER) / INNER


def regularised_profile(r, regularisation, stiffness):
    """Tangential speed, m/s, of the regularised slurry: the torque for which the outer cylinder rests, by
    quadrature."""
    points = np.linspace(INNER, OUTER, 1001)
    ratio = stiffness * STIFFEST[regularisation]

    def fall(torque):
        """Drop of the angular velocity from the inner cylinder outwards."""
        rate = regularised(torque / points**2, regularisation, YIELD_STRESS, PLASTIC_VISCOSITY, ratio,
                           ratio * PLASTIC_VISCOSITY / YIELD_STRESS) / points
        return np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(points))])

    guess = YIELD_STRESS * EDGE**2
    torque = brentq(lambda value: fall(value)[-1] - OMEGA, 0.5 * guess, 2 * guess)
    return r * (OMEGA - np.interp(r, points, fall(torque)))


@dataclass
class Flow:
    """Mean tangential speed u (m/s) of each ring of cells at its radius r (m), and what is compared with the closed
    form."""
    regularisation: str
    stiffness: float  # of the plug, over the stiffest
    r: np.ndarray
    u: np.ndarray
    drift: float
    unevenness: float  # largest departure of a cell from its ring's mean, over the inner cylinder's speed

    @property
    def profile_error(self):
        return np.abs(self.u - exact(self.r)).max() / exact(INNER)

    @property
    def model_error(self):
        return np.abs(self.u - regularised_profile(self.r, self.regularisation, self.stiffness)).max() / exact(INNER)

    @property
    def edge(self):
        """Where the yielded slurry's shear rate reaches zero, m: it is a straight line in 1/r^2."""
        r = (self.r[1:] + self.r[:-1]) / 2
        rate = -r * np.diff(self.u / self.r) / np.diff(self.r)
        # A tenth of the rate at the wall: well above what the regularised plug shears
        yielded = rate > 0.1 * rate.max()
        slope, offset = np.polyfit(r[yielded] ** -2, rate[yielded], 1)
        return np.sqrt(-slope / offset)

    @property
    def plug_width_error(self):
        return (OUTER - self.edge) / (OUTER - EDGE) - 1

    def misses(self):
        if not (self.drift <= STEADY and self.model_error <= TOLERANCE and self.unevenness <= TOLERANCE):
            return True
        return self.stiffness >= 1 and not (self.profile_error <= TOLERANCE and abs(self.plug_width_error) <= TOLERANCE)


def run(regularisation, stiffness, case, template):
    cells, end = (MILL_CELLS, MILL_END) if stiffness == MILL else (RADIAL_CELLS, END)
    copy_case(case, RESOURCES / "common", RESOURCES / "bingham", template)
    ratio = stiffness * STIFFEST[regularisation]
    write_parameters(
        case, convection="linearUpwind grad(U)", density=DENSITY, yieldStress=YIELD_STRESS,
        plasticViscosity=PLASTIC_VISCOSITY, regularisation=regularisation, viscosityRatio=ratio,
        m=ratio * PLASTIC_VISCOSITY / YIELD_STRESS, omega=OMEGA, innerRadius=CORNERS * INNER, radialCells=cells,
        quarterCells=QUARTER_CELLS, step=STEP, endTime=end, writeInterval=round(end / STEP / 10))
    run_program(case, "blockMesh")
    run_program(case, "slurryFoam")
    mesh = foam.read_mesh(case)
    centre = mesh.centres_and_volumes()[0]
    radius = np.hypot(centre[:, 0], centre[:, 1])
    ring = np.round((radius - INNER) / (OUTER - INNER) * cells - 0.5).astype(int)
    count = np.bincount(ring)

    def rings(folder):
        u = foam.read_field(folder / "U", mesh.cells)
        speed = (centre[:, 0] * u[:, 1] - centre[:, 1] * u[:, 0]) / radius
        return np.bincount(ring, speed) / count, speed

    *_, before, last = (path for _, path in foam.times(case))
    mean, speed = rings(last)
    drift = np.abs(mean - rings(before)[0]).max() / exact(INNER)
    return Flow(regularisation, stiffness, np.bincount(ring, radius) / count, mean, drift,
                np.abs(speed - mean[ring]).max() / exact(INNER))


def converges(flows):
    """Whether the errors go down as the plug gets stiffer, for both regularisations."""
    for name in REGULARISATIONS:
        errors = [flow.profile_error for flow in sorted(flows, key=lambda flow: flow.stiffness)
                  if flow.regularisation == name]
        if not errors or not np.all(np.diff(errors) < 0):
            return False
    return True


def print_table(flows, out):
    lines = [f"{'regularisation':<14} {'stiffness':>9} {'profile %':>9} {'own curve %':>11} {'plug width mm':>13} "
             f"{'error %':>8} {'uneven %':>8} {'drift':>8}", f"{'closed form':<46} {1e3 * (OUTER - EDGE):13.4f}"]
    for flow in flows:
        lines.append(marked(
            f"{flow.regularisation:<14} {flow.stiffness:9.3g} {100 * flow.profile_error:9.3f} "
            f"{100 * flow.model_error:11.3f} {1e3 * (OUTER - flow.edge):13.4f} {100 * flow.plug_width_error:8.3f} "
            f"{100 * flow.unevenness:8.3f} {flow.drift:8.1e}", flow.misses()))
    if not converges(flows):
        lines.append("MISSED: a stiffer plug is not nearer to the closed form")
    lines.append(f"tolerance {100 * TOLERANCE:g} %; steady to {STEADY}; profiles: largest error over the inner "
                 f"cylinder's speed; stiffness {MILL:.3g}: the mills' ratio, {MILL_CELLS} cells; 1: viscosity ratios "
                 f"{', '.join(f'{value:g}' for value in STIFFEST.values())}; softer plugs are compared with "
                 "their own curve alone")
    write_table(lines, out)


def plot(flows, out):
    figure, (profile, error) = plt.subplots(1, 2, figsize=(12, 5), constrained_layout=True)
    r = np.linspace(INNER, OUTER, 401)
    profile.plot(1e3 * r, exact(r), "k-", lw=0.8, label="closed form")
    markers = iter("ox+")
    for flow in flows:
        label = f"{flow.regularisation}, stiffness {flow.stiffness:.3g}"
        if flow.stiffness >= 1:
            profile.plot(1e3 * flow.r, flow.u, next(markers), ms=4, mfc="none", label=label)
        error.plot(1e3 * flow.r, 100 * (flow.u - exact(flow.r)) / exact(INNER), "-" if flow.stiffness >= 1 else "--",
                   label=label)
    for axis in (profile, error):
        axis.axvspan(1e3 * EDGE, 1e3 * OUTER, color="0.9", label="plug")
        axis.set_xlabel("radius, mm")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    profile.set(ylabel="tangential speed, m/s", title="Bingham slurry between a turning and a resting cylinder")
    error.set(ylabel="error over the inner cylinder's speed, %", title="Difference from the closed form")
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="the stiffest plugs alone")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    wanted = [(name, stiffness) for name in REGULARISATIONS for stiffness in ((1,) if options.quick else (*SOFTER, 1))]
    wanted.append(("biviscosity", MILL))
    flows = run_jobs(lambda item: run(*item, work / "_".join(map(str, item)), here / "template"), wanted, options.jobs)
    print_table(flows, here / "bingham_couette.txt")
    plot(flows, here / "bingham_couette.png")
    return 1 if any(flow.misses() for flow in flows) or not converges(flows) else 0


if __name__ == "__main__":
    sys.exit(main())
