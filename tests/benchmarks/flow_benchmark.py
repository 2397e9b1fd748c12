# SPDX-License-Identifier: GPL-3.0-or-later
"""slurryFoam on meshes of the 12 cm mill: cost of a cell by stage of a step, and two processes against one.

The mesh turns through a bed that stands still, so that all parts of a step have work. Steps are fixed."""
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MILL = ROOT / "cases" / "mills" / "mill_12cm" / "mill.yaml"
TEMPLATE = ROOT / "scripts" / "mill_case"
# Size of the cells, m, and layers of the whole mill, for about 10^4, 10^5 and 10^6 cells
MESHES = ((0.0045, 10), (0.0022, 24), (0.00105, 60))
BOTH = 2  # of them are also run on two processes
STEPS = 20
SPEED = 1.6  # m/s: cells over a step; the shell turns at a quarter of it
BED = """FoamFile {{ version 2.0; format ascii; class dictionary; object bedProperties; }}
block {{ box (-0.045 -0.045 -1) (0.02 0.02 1); edge {edge}; edgeAxes (1 1 0); solidity 0.5; diameter 0.005;
    velocity (0 0 0); }}
drag {{ law Beetstra; }}
"""
CONTROL = """FoamFile {{ version 2.0; format ascii; class dictionary; object controlDict; }}
application slurryFoam; libs ("libmillFoam.so");
startFrom startTime; startTime 0; stopAt endTime; endTime {end}; deltaT {step}; adjustTimeStep no;
writeControl timeStep; writeInterval 1000000; writeFormat binary; writePrecision 12; timePrecision 10;
runTimeModifiable no;
"""


def run(case, *command):
    with open(case / f"log.{command[0]}", "w") as log:
        subprocess.run(command, cwd=case, stdout=log, stderr=subprocess.STDOUT, check=True)


def make_case(case, cell, layers):
    """The whole mill at its start, on cells of this size (m) in these layers."""
    for name in ("0.orig", "constant", "system"):
        shutil.copytree(TEMPLATE / name, case / name)
    run(case, "millMesh", MILL, "--case", ".", "--set", "geometry.slice=~", "--set", f"resolution.cell_size={cell}",
        "--set", f"resolution.layers={layers}")
    (case / "constant" / "bedProperties").write_text(BED.format(edge=max(0.011, 2 * cell)))
    step = cell / SPEED
    (case / "system" / "controlDict").write_text(CONTROL.format(end=STEPS * step, step=step))
    shutil.copytree(case / "0.orig", case / "0")
    run(case, "slurryStart")


def run_flow(case, ranks):
    """flow.json of a flow of STEPS steps."""
    shutil.rmtree(case / "postProcessing", ignore_errors=True)
    if ranks > 1:
        run(case, "decomposePar", "-force")
        run(case, "mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks), "slurryFoam", "-parallel")
    else:
        run(case, "slurryFoam")
    return json.loads((case / "postProcessing" / "flow" / "0" / "flow.json").read_text())


def cells_of(case):
    return json.loads((case / "mesh.json").read_text())["cells"]


def flow_lines():
    """The table: a row for each mesh and number of processes."""
    stages, rows = [], []
    for number, (cell, layers) in enumerate(MESHES):
        with tempfile.TemporaryDirectory() as name:
            case = Path(name)
            make_case(case, cell, layers)
            alone = None
            for ranks in (1, 2) if number < BOTH else (1,):
                flow = run_flow(case, ranks)
                stages = stages or list(flow["stages_s"])
                taken = sum(flow["stages_s"].values())
                alone = alone or taken
                scale = 1e6 / STEPS / cells_of(case)
                by_stage = " | ".join(f"{scale * flow['stages_s'][stage]:.2f}" for stage in stages)
                rows.append(f"| {cells_of(case)} | {ranks} | {1e3 * taken / STEPS:.0f} | {scale * taken:.1f} | "
                            f"{by_stage} | {flow['pressure_iterations_per_step']:.0f} | {alone / taken:.2f} |")
    head = ["cells", "processes", "ms a step", "µs a cell and step", *stages, "iterations", "times faster"]
    return [f"| {' | '.join(head)} |", "|" + "---|" * len(head), *rows]
