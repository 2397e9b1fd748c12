#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mill's case will take: arithmetic on programs that print fixed numbers, and one real small mill."""
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from millfoam.plan import trial
from millfoam.plan.stages import FORCES
from millfoam.run import RunError

SMALL = """
geometry: {diameter: 0.1, length: 0.02, ends: periodic, lifters: {count: 8, height: 0.008, width: 0.008}}
speed: {fraction_of_critical: 0.6, sense: clockwise}
charge: {fill: 0.3, diameter: 0.008}
materials: {ball: glass, wall: HDPE, ball_ball: glass-glass, ball_wall: glass-HDPE}
dem: {settle_time: 0.1, duration: 0.4, record_interval: 0.004, seed: 1}
slurry: {density: 1200, plastic_viscosity: 0.005, yield_stress: 0.1, level: -0.01}
resolution: {cell_size: 0.008, layers: 2}
flow: {duration: 0.5}
"""
ROOT = Path(__file__).resolve().parents[2]
MILLS = ROOT / "cases" / "mills"
CELLS, FACES, SECTION_CELLS, VOLUME, LENGTH, RADIUS = 1000, 3500, 250, 0.001, 0.1, 0.05
STEP = 0.5  # s that the stub's flow takes for a step, after a first one of 40 s
MILL_MESH = f"""mkdir -p walls constant/polyMesh
head -c 2000000 /dev/zero > walls/shell.stl
head -c 3000000 /dev/zero > constant/polyMesh/points
echo "$@" > constant/asked
echo '{{"format": "millfoam-mesh", "cells": {CELLS}, "faces": {FACES}, "cells_in_section": {SECTION_CELLS},
    "volume_m3": {VOLUME}, "smallest_opening_cell_m2": 0}}' > mesh.json"""
REFUSAL = "millDem: error: mill.yaml:7: key 'dem.duration' = 0: expected more"
MILL_DEM = f"""[ ! -e "$STUBS/refuse" ] || {{ echo "{REFUSAL}" >&2; exit 1; }}
""" + """while [ "$1" != --json ]; do shift; done
echo '{"format": "millfoam-dem-plan", "wall_time_s": 600, "disk_bytes": 5e9, "memory_bytes": 2e8, "balls": 5000,
    "rate_balls_steps_per_s": 1e4}' > "$2"
"""
FLOW = f"""grep -c "^endTime 0.03;" system/controlDict
[ ! -e constant/bedProperties ] || exit 1
mkdir -p postProcessing/steps/0
{{ printf '# Time\tcpuTime\tclockTime\n'; seq 0 30 | awk '{{ print $1, 40 + {STEP} * $1, 1 }}'; }} \\
    > postProcessing/steps/0/timeInfo.dat"""
STUBS = {"millMesh": MILL_MESH, "millDem": MILL_DEM, "slurryStart": "true", "decomposePar": "mkdir processor0",
         "mpirun": 'shift 2; "$@"', "slurryFoam": FLOW, "millInterFoam": FLOW}


def mill(**flow):
    """A resolved mill as millMesh writes it, as far as the plan reads it, at rest, with these values of its flow."""
    flow = {"solver": "slurryFoam", "balls": True, "duration_s": 1.0, "max_time_step_s": 0.001, "max_courant": 1e9,
            "max_surface_courant": 1e9, "max_air_courant": 1e9, "write_interval_s": 0.01,
            "averages": {"shape": [10, 10, 4], "window_s": 0.1}, **flow}
    return {"format": "millfoam-mill", "program": "millMesh 1", "fingerprint": {"flow": "0123456789abcdef"},
            "mill": {"geometry": {}, "speed": {}, "charge": {}, "dem": {"duration": 4.0, "record_interval": 0.01}},
            "derived": {"gravity_m_s2": 9.81, "geometry": {"radius_m": RADIUS, "length_m": LENGTH}, "charge": {},
                        "speed": {"angular_velocity_rad_s": 0.0}, "flow": flow,
                        "averages": {"start_s": "steady", "window_s": 0.5, "shape": [10, 10, 10]}}}


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="plan-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.temporary)}

    def plan(self, *options):
        """Runs the plan on the folder; temporary folders must be gone behind it."""
        done = subprocess.run([sys.executable, "-m", "millfoam.plan", str(self.folder), *options], text=True,
                              capture_output=True, env=self.environment)
        self.assertEqual([], [path.name for path in self.temporary.iterdir() if path.name.startswith("millfoam-plan")])
        self.assertNotIn("Traceback", done.stderr)
        return done

    def planned(self, *options):
        """plan.json, its stages by name, and what was printed."""
        done = self.plan(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        content = json.loads((self.folder / "plan.json").read_text())
        return content, {stage["stage"]: stage for stage in content["stages"]}, done.stdout


class Arithmetic(Folder):
    def setUp(self):
        super().setUp()
        stubs = self.folder / "stubs"
        stubs.mkdir()
        for name, text in STUBS.items():
            program = stubs / name
            program.write_text(f"#!/bin/sh\n{text}\n")
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
        self.environment |= {"PATH": f"{stubs}:{os.environ['PATH']}", "STUBS": str(stubs)}

    def write(self, content):
        (self.folder / "mill.json").write_text(json.dumps(content))

    def test_the_dry_run_is_what_millDem_says(self):
        self.write(mill())
        _, stages, _ = self.planned()
        self.assertEqual([stages["charge"][key] for key in ("time_s", "disk_bytes", "memory_bytes")], [600, 5e9, 2e8])

    def test_averages_of_a_steady_charge_take_half_of_the_record(self):
        self.write(mill())
        _, stages, _ = self.planned()
        self.assertAlmostEqual(stages["average"]["time_s"], 5000 * 200 / 1e4)
        later = mill()
        later["derived"]["averages"]["start_s"] = 3.0
        self.write(later)
        self.assertAlmostEqual(self.planned()[1]["average"]["time_s"], 5000 * 100 / 1e4)

    def test_flow_is_steps_of_the_largest_time_step_where_no_courant_number_limits_it(self):
        self.write(mill())
        content, stages, _ = self.planned()
        self.assertEqual((content["flow_steps"], content["written_times"]), (1000, 100))
        self.assertAlmostEqual(stages["flow"]["time_s"], 1000 * STEP * 2.0)
        self.assertEqual(stages["flow"]["disk_bytes"], 100 * (190 * CELLS + 32 * FACES) + 100 * 400 * (2 * 10 + 100))

    def test_courant_numbers_limit_the_time_step_by_the_speed_of_a_fall_through_the_mill(self):
        # Cells of 6.3 mm across the mill, a fall through 0.1 m: 1.4 m/s; 0.01 s between written times are whole steps
        cell, speed = (VOLUME / LENGTH / SECTION_CELLS) ** 0.5, (4 * 9.81 * RADIUS) ** 0.5
        for solver, limit, calibrated in (
                ("slurryFoam", "max_courant", 1.05), ("slurryFoam", "max_surface_courant", 1.05),
                ("slurryFoam", "max_air_courant", 0.55), ("interFoam", "max_courant", 0.55)):
            self.write(mill(solver=solver, **{limit: 0.1}))
            content, _, _ = self.planned()
            expected = 0.1 * calibrated * cell / speed
            self.assertLessEqual(content["flow_time_step_s"], expected)
            self.assertGreater(content["flow_time_step_s"], 0.9 * expected)
        self.assertLess(content["flow_time_step_s"], 0.001)

    def test_small_cells_that_slurry_falls_through_limit_the_time_step_but_not_by_the_air_in_them(self):
        # A face of inlet or outlet of 1.5 mm; cells are of 6.3 mm in the mean
        small, speed = 1.5e-3, (4 * 9.81 * RADIUS) ** 0.5
        mesh = MILL_MESH.replace('cell_m2": 0', f'cell_m2": {small ** 2}')
        (self.folder / "stubs" / "millMesh").write_text(f"#!/bin/sh\n{mesh}\n")
        self.write(mill(max_courant=0.1))
        content, _, _ = self.planned()
        expected = 0.1 * 1.05 * small / speed
        self.assertLessEqual(content["flow_time_step_s"], expected)
        self.assertGreater(content["flow_time_step_s"], 0.9 * expected)
        self.write(mill(max_air_courant=0.1))
        self.assertGreater(self.planned()[0]["flow_time_step_s"], 2 * expected * 0.55 / 1.05)

    def test_a_stirred_mill_has_its_own_walls_and_cells_like_cubes(self):
        stubs = self.folder / "stubs"
        (stubs / "millMesh").write_text("#!/bin/sh\n" + MILL_MESH.replace(f'section": {SECTION_CELLS}', 'section": 0'))
        (stubs / "slurryFoam").write_text(f"#!/bin/sh\ngrep -q restingWallVelocity 0/U || exit 1\n{FLOW}\n")
        content = mill(max_courant=0.1)
        content["derived"]["machine"] = "stirred"
        self.write(content)
        planned, _, _ = self.planned()
        expected = 0.1 * 1.05 * (VOLUME / CELLS) ** (1 / 3) / (4 * 9.81 * RADIUS) ** 0.5
        self.assertLessEqual(planned["flow_time_step_s"], expected)
        self.assertGreater(planned["flow_time_step_s"], 0.9 * expected)

    def test_two_processes_reconstruct_and_keep_all_twice(self):
        self.write(mill())
        one = self.planned()[1]["flow"]
        two = self.planned("-np", "2")[1]["flow"]
        self.assertAlmostEqual(two["time_s"] - one["time_s"], 100 * 4.4 * STEP * 2**0.65)
        self.assertEqual(two["disk_bytes"] - one["disk_bytes"], 100 * (190 * CELLS + 32 * FACES))

    def test_mesh_and_walls_are_made(self):
        self.write(mill())
        _, stages, _ = self.planned()
        self.assertEqual(stages["walls"]["disk_bytes"], 2e6)
        self.assertAlmostEqual(stages["mesh"]["disk_bytes"], 3e6, delta=1e5)

    def test_a_mill_without_balls_has_no_charge(self):
        self.write(mill(balls=False))
        content, stages, _ = self.planned()
        self.assertEqual(list(stages), ["mesh", "start", "flow", "pictures and report"])
        self.assertAlmostEqual(stages["flow"]["time_s"], 1000 * STEP * 1.35)

    def test_a_charge_from_elsewhere_is_not_counted(self):
        self.write(mill())
        content, stages, text = self.planned("--charge", "../dry")
        self.assertEqual(list(stages), ["mesh", "start", "flow", "pictures and report"])
        self.assertAlmostEqual(stages["flow"]["time_s"], 1000 * STEP * 2.0)
        self.assertEqual(content["charge_from"], "../dry")
        self.assertIn("are those of ../dry", text)

    def test_steps_of_balls_that_feel_a_flow_take_longer_by_the_median_of_the_measured_table(self):
        rows = [line.split("|")[1:-1] for line in (ROOT / "PERFORMANCE.md").read_text().splitlines()
                if re.match(r"\| [\d ]+ \| [12] (\| \d\.\d+ ){7}(\| \d+ ){3}\|$", line)]
        longer = [1 + float(row[7]) / float(row[3]) for row in rows]
        self.assertEqual(len(longer), 8)
        self.assertAlmostEqual(FORCES, np.median(longer), delta=0.005)
        dry, flow = 600, 1000 * STEP * 2.0
        self.write(mill(coupling="iterated", passes=3))
        stages = self.planned()[1]
        first = sum(stages[name]["time_s"] for name in ("walls", "charge", "average", "mesh", "start", "flow"))
        self.assertAlmostEqual(stages["2 more passes"]["time_s"], 2 * (first + (FORCES - 1) * dry), places=3)
        self.write(mill(coupling="direct", duration_s=2.0))
        self.assertAlmostEqual(self.planned()[1]["balls and flow"]["time_s"], FORCES * dry / 2 + 2 * flow)

    def test_a_plan_until_a_stage_ends_with_it_and_makes_no_trial_of_what_follows(self):
        self.write(mill())
        (self.folder / "stubs" / "slurryFoam").unlink()
        for last, expected in (("average", ["walls", "charge", "average"]),
                               ("mesh", ["walls", "charge", "average", "mesh"])):
            content, stages, text = self.planned("--until", last)
            self.assertEqual(list(stages), expected)
            self.assertIsNone(content["flow_steps"])
            self.assertNotIn("The flow", text)
            self.assertAlmostEqual(content["total"]["time_s"], sum(stage["time_s"] for stage in stages.values()))

    def test_a_plan_until_the_flow_has_no_pictures(self):
        self.write(mill())
        content, stages, _ = self.planned("--until", "flow")
        self.assertEqual(list(stages), ["walls", "charge", "average", "mesh", "start", "flow"])
        self.assertEqual(content["flow_steps"], 1000)
        self.assertEqual(list(self.planned("--until", "start")[1]), ["walls", "charge", "average", "mesh", "start"])
        self.write(mill(coupling="direct", duration_s=2.0))
        together = self.planned()[1]["balls and flow"]
        stages = self.planned("--until", "flow")[1]
        self.assertEqual(list(stages), ["walls", "charge", "average", "mesh", "start", "balls and flow"])
        for key in ("time_s", "disk_bytes"):
            self.assertEqual(stages["balls and flow"][key], together[key])

    def test_the_dry_run_of_a_flow_without_balls_is_planned_where_it_is_asked_for(self):
        self.write(mill(balls=False))
        self.assertEqual(list(self.planned("--until", "charge")[1]), ["walls", "charge"])

    def test_a_stage_that_does_not_exist_is_refused(self):
        self.write(mill())
        done = self.plan("--until", "flows")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'flows' (choose from 'walls', 'charge', 'average', 'mesh', 'start', 'flow')", done.stderr)

    def test_table_and_total(self):
        self.write(mill())
        content, stages, text = self.planned()
        for key in ("time_s", "disk_bytes"):
            self.assertAlmostEqual(content["total"][key], sum(stage[key] for stage in stages.values()), delta=7)
        self.assertEqual(content["total"]["memory_bytes"], max(stage["memory_bytes"] for stage in stages.values()))
        self.assertRegex(text, r"(?m)^charge +10 min +5\.0 GB +200 MB")
        self.assertRegex(text, r"(?m)^mesh +< 10 s +3 MB")
        self.assertRegex(text, r"(?m)^total +\d+ min +5\.0 GB")

    def test_what_a_tool_refuses_is_its_own_sentence(self):
        self.write(mill())
        (self.folder / "stubs" / "refuse").touch()
        done = self.plan()
        self.assertEqual((done.returncode, done.stderr), (1, REFUSAL + "\n"))
        self.assertFalse((self.folder / "plan.json").exists())

    def test_a_solver_that_fails_shows_its_last_lines(self):
        self.write(mill())
        (self.folder / "stubs" / "slurryFoam").write_text("#!/bin/sh\necho FOAM FATAL ERROR: no room\nexit 1\n")
        done = self.plan()
        self.assertEqual(done.returncode, 1)
        self.assertIn("slurryFoam failed; its output ends with:\nFOAM FATAL ERROR: no room", done.stderr)

    def test_a_folder_without_a_mill_is_refused(self):
        done = self.plan()
        self.assertEqual(done.returncode, 1)
        self.assertIn("no mill.json", done.stderr)


class Steps(unittest.TestCase):
    def test_the_first_ones_are_not_counted(self):
        first = [40.0 + 0.1 * step for step in range(trial.FIRST_STEPS)]
        later = [first[-1] + STEP * step for step in range(1, 22)]
        self.assertAlmostEqual(trial.step_time(first + later), STEP)

    def test_too_few_are_refused(self):
        for times in ([], [1.0]):
            with self.assertRaisesRegex(RunError, f"made {len(times)} steps; expected 2 or more"):
                trial.step_time(times)


class SmallMill(Folder):
    def test_what_millDem_refuses_ends_the_plan(self):
        (self.folder / "mill.yaml").write_text(SMALL.replace("fill: 0.3", "fill: 0.3, start_radius: 0.006"))
        subprocess.run(["millMesh", "mill.yaml", "--resolved", "mill.json"], cwd=self.folder, check=True)
        done = self.plan()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"^millDem: error: .*mill\.yaml:\d+: key 'charge.start_radius' = 0.006: expected")

    def test_a_trial_that_takes_too_long_is_ended(self):
        finer = ("--set", "resolution.cell_size=0.003", "--set", "resolution.layers=6")
        (self.folder / "mill.yaml").write_text(SMALL)
        subprocess.run(["millMesh", "mill.yaml", *finer, "--resolved", "mill.json"], cwd=self.folder, check=True)
        for solver in ("slurryFoam", "interFoam"):
            case = self.folder / solver
            case.mkdir()
            mesh = trial.try_mesh(case, self.folder / "mill.json")
            self.assertEqual(mesh.cells, 6 * mesh.cells_in_section)
            with mock.patch.object(trial, "TRIAL_TIME", 0):
                flow = trial.try_flow(case, solver, 1e-3, 2)
            # It is stopped at one of the next multiples; otherwise it makes about 20 steps or more
            self.assertIn(len(trial.execution_times(case)), range(trial.FEWEST_STEPS, 3 * trial.FEWEST_STEPS))
            self.assertGreater(flow.step_time, 0)
            # Of a rank with OpenFOAM's libraries, not of mpirun
            self.assertGreater(flow.memory, 80e6)

    def test_a_mesh_of_balls_that_feel_the_slurry_is_that_of_slurry_alone(self):
        (self.folder / "mill.yaml").write_text(SMALL)
        cells = {}
        for coupling in ("one_way", "iterated", "direct"):
            subprocess.run(["millMesh", "mill.yaml", "--set", f"flow.coupling={coupling}", "--resolved", "mill.json"],
                           cwd=self.folder, check=True)
            case = self.folder / coupling
            case.mkdir()
            cells[coupling] = trial.try_mesh(case, self.folder / "mill.json").cells
        self.assertEqual(len(set(cells.values())), 1, cells)

    def test_a_stirred_mill_whose_balls_feel_the_slurry_has_a_mesh_without_their_voxels(self):
        subprocess.run(["millMesh", MILLS / "stirred_A" / "mill.yaml", "--set", "variant=quick_wet", "--set",
                        "flow.coupling=direct", "--set", "flow.exchange={voxel_size: 0.01}", "--resolved", "mill.json"],
                       cwd=self.folder, check=True)
        self.assertGreater(trial.try_mesh(self.folder, self.folder / "mill.json", "stirred").cells, 1000)

    def test_every_stage_of_a_real_mill_is_planned(self):
        (self.folder / "mill.yaml").write_text(SMALL)
        subprocess.run(["millMesh", "mill.yaml", "--resolved", "mill.json"], cwd=self.folder, check=True)
        content, stages, text = self.planned("-np", "2")
        self.assertEqual(list(stages), ["walls", "charge", "average", "mesh", "start", "flow", "pictures and report"])
        for stage in stages.values():
            for key in ("time_s", "disk_bytes", "memory_bytes"):
                self.assertGreater(stage[key], 0, f"{stage['stage']}: {key}")
        longest = max(stages.values(), key=lambda stage: stage["time_s"])
        self.assertIn(longest["stage"], ("charge", "flow", "pictures and report"))
        self.assertGreater(content["flow_steps"], 100)
        self.assertIn(f"{content['cells']} cells", text)
        self.assertEqual(content["mill"], json.loads((self.folder / "mill.json").read_text())["fingerprint"])


if __name__ == "__main__":
    unittest.main()
