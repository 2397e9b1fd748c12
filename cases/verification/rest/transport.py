#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface at rest that a mesh turns past: without gravity nothing moves, so that only the slurry's transport acts.

After one turn every cell is where it was. The change of its share of slurry, summed over the surface, is the distance
by which the transport has moved the surface: geometric (slurryFoam, interIsoFoam) compared with compressive MULES
(interFoam). Writes transport.txt. Exit code 1 if slurryFoam moves it by more than half of interFoam's distance, or
loses slurry."""
import argparse
import math
import shutil
import sys
from pathlib import Path

import numpy as np

import pool
from millfoam.files import foam
from millfoam.run import marked, write_table
from millfoam.run import run as run_program
from pool_history import Run

MIXED = 1e-3  # cells whose share is further than this from 0 and 1 hold the surface
LARGEST_SHARE = 0.5  # of interFoam's displacement
CONSERVED = 1e-8


def perform(mesh, solver, work, here):
    """The case of a solver's run of one turn."""
    run = Run(mesh, solver, 0, True)
    case = work / f"{mesh}_{solver}"
    shutil.rmtree(case, ignore_errors=True)
    pool.build(run, case, here, 2 * math.pi / abs(pool.OMEGA[mesh]), gravity=0)
    run_program(case, pool.SOLVERS[solver])
    return case


def measure(case, name):
    """(mean displacement of the surface in m, relative change of the slurry's volume, cells that hold the surface
    before and after)."""
    mesh = foam.read_mesh(case)
    _, volume = mesh.centres_and_volumes()
    times = foam.times(case)
    first, last = (foam.read_field(folder / "alpha.slurry", mesh.cells) for _, folder in (times[0], times[-1]))
    _, level, radius, length = pool.MESHES[name]
    surface = 2 * math.sqrt(radius**2 - level**2) * length
    mixed = [np.count_nonzero((alpha > MIXED) & (alpha < 1 - MIXED)) for alpha in (first, last)]
    changed = abs((last * volume).sum() / (first * volume).sum() - 1)
    return (np.abs(last - first) * volume).sum() / surface, changed, *mixed


def judge(mesh, found):
    """Lines of the table about a mesh, and how many limits slurryFoam missed; found: what `measure` returns, by
    solver."""
    lines = [f"{mesh:<8} {solver:<13} {1e3 * moved:18.3f} {change:14.1e} {before:10d} -> {after:7d}"
             for solver, (moved, change, before, after) in found.items()]
    moved, change, *_ = found["slurryFoam"]
    share = moved / found["interFoam"][0]
    missed = [name for name, hit in (("distance", share <= LARGEST_SHARE), ("volume", change <= CONSERVED)) if not hit]
    lines.append(marked(f"{mesh}: slurryFoam moves it by {share:.2f} of interFoam's distance, allowed {LARGEST_SHARE}",
                        missed))
    return lines, len(missed)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--meshes", nargs="+", choices=pool.OMEGA, default=list(pool.OMEGA))
    parser.add_argument("--work", type=Path, default=Path(__file__).parent / "runs_transport",
                        help="folder of the runs; it is made again")
    options = parser.parse_args()
    here, work = Path(__file__).parent.resolve(), options.work.resolve()
    lines = [f"{'mesh':<8} {'solver':<13} {'surface moved, mm':>18} {'volume change':>14} {'cells of the surface':>21}"]
    missed = 0
    for mesh in options.meshes:
        text, bad = judge(mesh, {solver: measure(perform(mesh, solver, work, here), mesh) for solver in pool.SOLVERS})
        lines += text
        missed += bad
    write_table(lines, here / "transport.txt")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
