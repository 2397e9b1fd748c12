#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls that feel the fluid, compared with closed forms: terminal velocity, a bed in a pool, minimum fluidisation,
settling suspensions, two sizes under an upflow. Exit code 1 if a number misses its limit."""
import sys
from functools import partial
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from experiments import fluidisation, pool, segregation, settled_bed, settling, terminal, upflow
from millfoam.run import case_options, fresh_runs, marked, run_jobs, write_table

matplotlib.use("Agg")

PANELS = {"terminal velocity": ("time, s", "velocity, m/s"),
          "fluidisation": ("superficial velocity, m/s", "pressure that the bed takes, Pa"),
          "settling": ("time, s", "velocity of the balls, m/s"),
          "two sizes": ("time, s", "smaller above larger balls by, mm")}


def experiments(work, quick):
    """Experiments as functions of the folder of their runs."""
    if quick:
        bed = settled_bed(work, 0.01, 0.02)
        return [partial(terminal, law="DiFelice", upflow=0.0, ways=("direct", "iterated"), end=0.3),
                partial(terminal, law="WenYu", upflow=0.1, end=0.3),
                partial(pool, bed=bed, end=0.25), partial(upflow, bed=bed, end=0.25),
                partial(fluidisation, bed=bed, rise=1.4, begin=0.3),
                partial(settling, width=0.01, solidity=0.3, top=0.112, end=0.3),
                partial(segregation, width=0.0168, depth=0.08, end=1.1, compared=False)]
    width = 0.016  # m
    bed = settled_bed(work, width, 0.048)
    return [partial(terminal, law="DiFelice", upflow=0.0, ways=("direct", "iterated")),
            partial(terminal, law="WenYu", upflow=0.1),
            partial(pool, bed=bed), partial(upflow, bed=bed), partial(fluidisation, bed=bed, rise=4.0),
            *(partial(settling, width=width, solidity=solidity) for solidity in (0.3, 0.05, 0.45)),
            partial(segregation, width=0.02, depth=0.1, end=3.0, compared=True)]


def print_table(findings, out):
    lines = [f"{'experiment':<40}{'quantity':<38}{'found':>12}{'expected':>12}{'off %':>9}{'limit %':>9}"]
    for one in findings:
        limit = f"{100 * one.limit:9.2g}" if one.limit else f"{'above':>9}"
        off = f"{100 * one.off:9.3f}" if one.limit else f"{'':9}"
        line = f"{one.experiment:<40}{one.quantity + (f', {one.unit}' if one.unit else ''):<38}{one.found:12.6g}" \
               f"{one.expected:12.6g}{off}{limit}"
        lines.append(marked(line, one.missed))
    write_table(lines, out)


def plot(curves, out):
    figure, axes = plt.subplots(2, 2, figsize=(13, 9), constrained_layout=True)
    for (panel, (x_label, y_label)), axis in zip(PANELS.items(), axes.flat):
        for curve in (one for one in curves if one.panel == panel):
            line, = axis.plot(curve.x, curve.y, "-", label=curve.label)
            if curve.expected is not None:
                axis.plot(curve.x, np.broadcast_to(curve.expected, curve.x.shape), "--", color=line.get_color(), lw=1,
                          label=f"{curve.label}: closed form")
        axis.set(title=panel, xlabel=x_label, ylabel=y_label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, "smaller and shorter, one suspension, no run that is only drawn")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    done = run_jobs(lambda experiment: experiment(work), experiments(work, options.quick), options.jobs)
    findings = [finding for found, _ in done for finding in found]
    print_table(findings, here / "balls_in_fluid.txt")
    plot([curve for _, found in done for curve in found], here / "balls_in_fluid.png")
    return 1 if any(finding.missed for finding in findings) else 0


if __name__ == "__main__":
    sys.exit(main())
