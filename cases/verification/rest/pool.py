#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A pool with an exactly flat free surface stays at rest, on meshes that are not aligned with it.

Runs the pool with several solvers on the O-grid of a mill's section and on the mill's own meshes, with and without
surface tension, with and without a bed of balls at rest, on a mesh at rest and on a mesh that turns inside walls that
slip; and slurry alone in such a bed. Writes one table and two pictures. Exit code 1 if slurryFoam exceeds
its limits."""
import argparse
import shutil
import sys
from pathlib import Path

import numpy as np

import pool_pictures
import pool_table
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import RunError, copy_case, run_jobs, set_options, stop_mill, write_parameters
from mill_slice import FINE, MILL
from pool_history import Run, measure, read_history, write_history

SOLVERS = {"interFoam": "millInterFoam", "interIsoFoam": "millInterIsoFoam", "slurryFoam": "slurryFoam"}
RESOURCES = Path(__file__).resolve().parents[1] / "resources"
SLURRY = dict(slurryDensity=1239, slurryViscosity=1.4e-3, slurryKinematicViscosity=1.4e-3 / 1239)
AIR = dict(airDensity=1.2, airViscosity=1.8e-5, airKinematicViscosity=1.8e-5 / 1.2)
TENSION = 0.07  # N/m
# By name: the mill whose mesh it is (None: blockMesh), the pool's level, the mesh's radius and length, m. Levels run
# through cells, not along their faces.
MESHES = {
    "ogrid": (None, -0.031, 0.15, 0.006),
    "mill": ("mill.yaml", -0.012, 0.06, 0.12),
    "slice": (MILL, -0.002, 0.06, 0.024),
    "drum": ("drum.yaml", -0.012, 0.06, 0.12),
}
# Turning, rad/s: four fifths of the critical speed of 30 cm, half of that of 12 cm. Only round walls slide past a pool.
OMEGA = {"ogrid": -6.4, "drum": -6.4}
QUICK_END, LONG_END = 0.15, 1.0  # s
QUICK_RECORDS, LONG_RECORDS = 16, 40  # multiples of four: the table shows quarters of a run
# Bed, in radii: sides, lower and upper end from the pool's level, soft edge (16.5 mm in a mill of 12 cm: as soft as
# averages on voxels of 11 mm). It touches no wall, so that its volume in the mesh is known.
BED_SIDES, BED_ENDS, BED_EDGE = (-0.5, 0.4), (-0.4, 0.35), 0.275
BED_SOLIDITY = 0.5
FULL = 1.0  # m: a level above every mesh
BEDS = {"slurryFoam": "bedProperties", "interFoam": "fvOptions"}  # solver -> file in constant/ that holds the bed


def matrix(meshes, solvers, quick):
    """Every run, the O-grid's first. Quick: a few with surface tension for a short time, slurry alone in a bed at rest
    and turning, and the slice, whose pool has a thin film at its edge."""
    if quick:
        settings = [("ogrid", False, False), ("ogrid", False, True), ("ogrid", True, False), ("ogrid", True, True),
                    ("mill", False, False)]
        runs = [Run(mesh, solver, TENSION, turning, bed) for mesh, turning, bed in settings for solver in BEDS]
        runs += [Run("ogrid", "slurryFoam", 0, turning, bed=True, filled=True) for turning in (False, True)]
        return runs + [Run("slice", "slurryFoam", TENSION, turning=False)]
    runs = []
    for mesh in meshes:
        for turning in ((False,) if mesh not in OMEGA else (True,) if mesh == "drum" else (False, True)):
            runs += [Run(mesh, solver, tension, turning) for tension in (TENSION, 0) for solver in solvers]
            runs += [Run(mesh, solver, TENSION, turning, bed=True) for solver in solvers if solver in BEDS]
    if "slurryFoam" in solvers:
        runs += [Run(mesh, "slurryFoam", 0, mesh in OMEGA, bed=True, filled=True)
                 for mesh in meshes]
    return runs


def bed_parameters(level, radius, length):
    """Entries of the dictionaries in pool/beds for a mesh; the edges rise to full solidity within the box."""
    sides, ends = (radius * np.array(part) for part in (BED_SIDES, BED_ENDS))
    across, up = (np.ptp(part) - BED_EDGE * radius for part in (sides, ends))
    return dict(bedLeft=sides[0], bedRight=sides[1], bedBottom=level + ends[0], bedTop=level + ends[1],
                bedEdge=BED_EDGE * radius, bedSolidity=BED_SOLIDITY, bedVolume=BED_SOLIDITY * across * up * length)


def build(run, case, here, end, records=LONG_RECORDS, gravity=GRAVITY):
    """The case of a run: what all solvers share, the solver's own schemes, the mesh, the flat surface. records: how
    many times are written; gravity: along -y, m/s2."""
    copy_case(case, RESOURCES / "common", RESOURCES / "closed", RESOURCES / "turning", here / "pool" / "common",
              *([here / "pool" / run.solver] if run.solver != "slurryFoam" else []))
    if run.bed:
        shutil.copy(here / "pool" / "beds" / BEDS[run.solver], case / "constant")
    mill, level, radius, length = MESHES[run.mesh]
    write_parameters(
        case, solver=SOLVERS[run.solver], **SLURRY, **AIR, surfaceTension=run.tension,
        level=FULL if run.filled else level, **bed_parameters(level, radius, length), endTime=end,
        writeInterval=end / records, wall="slip" if run.turning else "noSlip",
        meshMotion="dynamicMotionSolverFvMesh" if run.turning else "staticFvMesh", meshOmega=OMEGA.get(run.mesh, 0),
        gravity=f"(0 {-gravity} 0)", skewCorrectors=1)
    if mill:
        run_program(case, "millMesh", here / mill, "--case", ".", *set_options(FINE if run.mesh == "slice" else ()))
        if not run.turning:
            stop_mill(case)
    else:
        copy_case(case, RESOURCES / run.mesh)
        run_program(case, "blockMesh")
    run_program(case, "setAlphaField")


def kept(run, case, here, end):
    """History that an earlier run left, or None: it must have reached the end and be newer than its solver and
    inputs."""
    left = case / "history.csv"
    program = shutil.which(SOLVERS[run.solver])
    if not left.is_file() or not program:
        return None
    library = Path(program).parents[1] / "lib" / "libmillFoam.so"
    mills = [here / mesh[0] for mesh in MESHES.values() if mesh[0]]
    inputs = [Path(program), library, *mills, here / "pool.py", *(here / "pool").rglob("*"),
              *RESOURCES.rglob("*")]
    if left.stat().st_mtime < max(path.stat().st_mtime for path in inputs):
        return None
    history = read_history(case)
    return history if history and history.time[-1] >= end - 1e-9 else None


def perform(run, work, here, end, records, keep):
    """History of a run: an earlier one's where `keep` allows it, else that of a run made now."""
    case = work / run.name
    earlier = kept(run, case, here, end) if keep else None
    if earlier:
        return earlier
    shutil.rmtree(case, ignore_errors=True)
    build(run, case, here, end, records)
    try:
        run_program(case, SOLVERS[run.solver])
    except RunError as error:
        # A reference that diverges is a finding; the table shows the time that it reached.
        print(f"{run.name}: {error}", file=sys.stderr)
    history = measure(case)
    write_history(history, case)
    print(f"{run.name}: {history.time[-1]:g} s, slurry rms {history.slurry_rms[-1]:.2e} m/s", flush=True)
    return history


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"a few settings, {QUICK_END} s, interFoam and slurryFoam")
    parser.add_argument("--meshes", nargs="+", choices=MESHES, default=list(MESHES))
    parser.add_argument("--solvers", nargs="+", choices=SOLVERS, default=list(SOLVERS))
    parser.add_argument("--keep", action="store_true",
                        help="use earlier complete runs that are newer than their solver and inputs")
    parser.add_argument("--work", type=Path, default=Path(__file__).parent / "runs_pool", help="folder of the runs")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent, help="folder of the table and pictures")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    here, work, out = Path(__file__).parent.resolve(), options.work.resolve(), options.out.resolve()
    end, records = (QUICK_END, QUICK_RECORDS) if options.quick else (LONG_END, LONG_RECORDS)
    runs = matrix(options.meshes, options.solvers, options.quick)
    for program in sorted({SOLVERS[run.solver] for run in runs}):
        if not shutil.which(program):
            parser.error(f"{program} is not on the PATH: run scripts/setup, then cmake --build build/release --target "
                         f"{program}, then source scripts/env")
    work.mkdir(parents=True, exist_ok=True)
    histories = dict(zip(runs, run_jobs(lambda run: perform(run, work, here, end, records, options.keep), runs,
                                        options.jobs)))
    missed = pool_table.report(histories, end, out)
    pool_pictures.speeds(histories, out / "pool_speeds.png")
    pool_pictures.maps(histories, work, out / "pool_maps.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
