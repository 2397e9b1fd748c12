#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane Poiseuille flow of a Bingham slurry, with both regularisations, against the closed form.

With the plates at y = -h and h, force per volume G, yield stress tau0 and plastic viscosity mu, the slurry moves as a
plug of half width y0 = tau0/G with speed G (h - y0)^2/(2 mu); beside it u = G ((h - y0)^2 - (|y| - y0)^2)/(2 mu)
(Bird, Armstrong & Hassager 1987, Dynamics of Polymeric Liquids 1, chapter 4). Exit code 1 when one misses."""
import argparse
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from millfoam import foam
from millfoam.run import run as run_program
from millfoam.run import write_parameters

# Slurry with 30 % solids by mass
DENSITY, YIELD_STRESS, PLASTIC_VISCOSITY = 1239.0, 0.16, 0.0014
HALF_GAP, CELLS = 0.005, 100
PLUG = 0.4  # half width of the plug over half the gap
DRIVE = YIELD_STRESS / (PLUG * HALF_GAP)
# The plug creeps by a hundredth of the plastic rate. Stiffer plugs need a shorter step: runs whose largest viscosity
# times step over density and cell squared was 361 were steady, with 3600 they were not; here it is 330.
VISCOSITY_RATIO, M = 100.0, 1.0
REGULARISATIONS = ("biviscosity", "Papanastasiou")
TOLERANCE = 0.02
# Steady to this change of the largest speed over the last tenth of the run
STEADY = 1e-4
STEP, STEPS = 0.025, 3600


def exact(y):
    """Closed-form speed, m/s, at the distances y (m) from the middle."""
    y0 = PLUG * HALF_GAP
    return DRIVE / (2 * PLASTIC_VISCOSITY) * ((HALF_GAP - y0) ** 2 - np.maximum(np.abs(y) - y0, 0) ** 2)


@dataclass
class Flow:
    """The computed profile u (m/s) at y (m), and what is compared with the closed form, as relative errors."""
    regularisation: str
    y: np.ndarray
    u: np.ndarray
    drift: float  # change of the largest speed over the last tenth of the run, relative

    @property
    def profile_error(self):
        return np.abs(self.u - exact(self.y)).max() / exact(0.0)

    @property
    def plug_speed_error(self):
        return self.u.max() / exact(0.0) - 1

    @property
    def plug_half_width(self):
        """Where the shear rate of the yielded slurry, a straight line, comes down to zero, m."""
        y = (self.y[1:] + self.y[:-1]) / 2
        rate = np.diff(self.u) / np.diff(self.y) * -np.sign(y)
        # A tenth of the rate at the wall: well above what the regularised plug shears
        yielded = rate > 0.1 * rate.max()
        slope, offset = np.polyfit(np.abs(y[yielded]), rate[yielded], 1)
        return -offset / slope

    @property
    def plug_width_error(self):
        return self.plug_half_width / (PLUG * HALF_GAP) - 1

    def misses(self):
        errors = (self.profile_error, self.plug_speed_error, self.plug_width_error)
        return not (all(abs(error) <= TOLERANCE for error in errors) and self.drift <= STEADY)


def run(regularisation, case, template):
    shutil.copytree(template, case)
    write_parameters(
        case, density=DENSITY, yieldStress=YIELD_STRESS, plasticViscosity=PLASTIC_VISCOSITY, regularisation=regularisation,
        viscosityRatio=VISCOSITY_RATIO, m=M, drive=DRIVE, halfGap=HALF_GAP, cells=CELLS, step=STEP,
        endTime=STEPS * STEP, writeInterval=STEPS // 10)
    run_program(case, "blockMesh")
    run_program(case, "millInterFoam")
    *_, before, last = (path for _, path in foam.times(case))
    mesh = foam.read_mesh(case)
    y = mesh.centres_and_volumes()[0][:, 1]
    u = foam.read_field(last / "U", mesh.cells)[:, 0]
    drift = abs(foam.read_field(before / "U", mesh.cells)[:, 0].max() / u.max() - 1)
    return Flow(regularisation, y, u, drift)


def print_table(flows, out):
    lines = [f"{'regularisation':<15} {'profile %':>10} {'plug speed m/s':>15} {'error %':>8} {'plug width mm':>14} "
             f"{'error %':>8} {'drift':>9}",
             f"{'closed form':<15} {'':>10} {exact(0.0):15.5f} {'':>8} {2e3 * PLUG * HALF_GAP:14.4f}"]
    for flow in flows:
        lines.append(
            f"{flow.regularisation:<15} {100 * flow.profile_error:10.3f} {flow.u.max():15.5f} "
            f"{100 * flow.plug_speed_error:8.3f} {2e3 * flow.plug_half_width:14.4f} "
            f"{100 * flow.plug_width_error:8.3f} {flow.drift:9.1e}" + ("  MISSED" if flow.misses() else ""))
    lines.append(f"tolerance {100 * TOLERANCE} %; steady to {STEADY}; profile: largest error over the plug's speed")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")


def plot(flows, out):
    figure, (profile, error) = plt.subplots(1, 2, figsize=(11, 5), constrained_layout=True)
    y = np.linspace(-HALF_GAP, HALF_GAP, 401)
    profile.plot(exact(y), 1e3 * y, "k-", label="closed form")
    for flow, marker in zip(flows, "ox"):
        profile.plot(flow.u, 1e3 * flow.y, marker, ms=4, mfc="none", label=flow.regularisation)
        error.plot(100 * (flow.u - exact(flow.y)) / exact(0.0), 1e3 * flow.y, marker + "-", ms=4, mfc="none",
                   label=flow.regularisation)
    for axis in (profile, error):
        axis.axhspan(-1e3 * PLUG * HALF_GAP, 1e3 * PLUG * HALF_GAP, color="0.9", label="plug")
        axis.set_ylabel("distance from the middle, mm")
        axis.grid(alpha=0.3)
    profile.set(xlabel="speed, m/s", title="Bingham slurry (30 % solids) between two plates")
    error.set(xlabel="error over the plug's speed, %", title=f"Difference from the closed form (tolerance "
                                                             f"{100 * TOLERANCE:g} %)")
    profile.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    here = Path(__file__).parent.resolve()
    work = here / "runs"
    shutil.rmtree(work, ignore_errors=True)
    with ThreadPoolExecutor(options.jobs) as pool:
        flows = list(pool.map(lambda name: run(name, work / name, here / "template"), REGULARISATIONS))
    print_table(flows, here / "bingham_poiseuille.txt")
    plot(flows, here / "bingham_poiseuille.png")
    return 1 if any(flow.misses() for flow in flows) else 0


if __name__ == "__main__":
    sys.exit(main())
