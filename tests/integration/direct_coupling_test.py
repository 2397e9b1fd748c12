#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and flow at the same time in a small mill: what they give to each other, a run that is killed and resumed, and
programs that lose each other."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from unittest.mock import patch

import numpy as np

from mill_case import SCRIPTS, STAGES, run_mill
from millfoam.coupling.passes import given
from millfoam.files.data_files import read_csv, read_json
from millfoam.files.dumps import numbered_dumps, read_balls
from millfoam.files.mill_case import MillCase
from millfoam.files.solids_file import read_windows
from millfoam.readings.fluid_on_balls import fluid_on_balls
from millfoam.run import RunError, run

MILL = """
geometry: {diameter: 0.06, length: 0.02, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.6, sense: clockwise}
charge: {classes: [{diameter: 0.005, mass: 0.0128}, {diameter: 0.0035, mass: 0.0128}]}
materials: {ball: glass, wall: HDPE}
dem: {settle_time: 0.1, duration: 0.2, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {counts: {across: 8, along: 4}, window: 0.05, start: 0.1}
resolution: {cell_size: 0.006, layers: 2}
flow: {duration: 0.3, coupling: direct, polydispersity: yes, averages: {start: 0.1}}
"""


class Direct(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.enterClassContext(patch.dict(os.environ, MILLFOAM_NP="1"))
        cls.case = Path(tempfile.mkdtemp(prefix="direct-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        (cls.case / "mill.yaml").write_text(MILL)
        run_mill(cls.case, "mill.yaml", until="flow")
        cls.again = run_mill(cls.case, "mill.yaml", "title=another title", undrawn="pictures")
        cls.direct = cls.case / "direct"

    def copy(self, name):
        case = self.case.with_name(self.case.name + name)
        shutil.copytree(self.case, case, symlinks=True)
        self.addCleanup(shutil.rmtree, case)
        return case

    def test_the_balls_take_what_the_flow_gives(self):
        force, torque = given(MillCase(self.direct))
        rows = read_csv(self.direct / "dumps" / "fluid.csv")
        within = rows["time_s"] > 0.2 + 0.1
        taken = np.array([np.mean(rows[f"force_{axis}_N"][within]) for axis in "xyz"])
        # Without the drag of the mixture of sizes in the flow's force, 0.01 (after a dry run of 0.4 s)
        self.assertLess(np.linalg.norm(force - taken) / np.linalg.norm(force), 0.005)
        # Of single steps
        sampled = fluid_on_balls(self.direct / "slurry.h5", 2500.0).force
        self.assertLess(np.linalg.norm(force - sampled) / np.linalg.norm(force), 0.05)
        self.assertEqual(np.max(rows["balls_without_field"]), 0)
        content = read_json(self.case / "coupling.json", "coupling")
        self.assertEqual(content["folders"], [".", "direct"])
        self.assertAlmostEqual(content["force_by_balls_N"], np.linalg.norm(taken), places=6)
        self.assertAlmostEqual(content["torque_by_flow_Nm"], torque, places=9)
        self.assertAlmostEqual(content["torque_by_balls_Nm"], np.mean(rows["torque_Nm"][within]), places=9)
        drive = read_csv(self.direct / "dumps" / "energy.csv")
        self.assertAlmostEqual(content["torque_disagreement"], abs(torque - content["torque_by_balls_Nm"])
                               / abs(np.mean(drive["torque_Nm"][drive["time_s"] > 0.2 + 0.1])), places=6)
        # Balls and walls move between two meetings; without the torque that is added, 3 % (after 0.4 s)
        self.assertLess(content["torque_disagreement"], 0.003)
        self.assertGreater(content["torque_added"], 10 * content["torque_disagreement"])

    def test_the_balls_gain_what_walls_weight_and_fluid_give_by_their_torques(self):
        dumps = numbered_dumps(self.direct / "dumps")
        density = read_json(self.case / "mill.json", "mill")["derived"]["materials"]["ball"]["density_kg_m3"]
        momentum, weight = [], []
        for _, path in dumps:
            x, y, vx, vy, radius = read_balls(path, "x", "y", "vx", "vy", "radius").T
            mass = density * 4 / 3 * np.pi * radius**3
            momentum.append(np.sum(mass * (x * vy - y * vx)))
            weight.append(-9.81 * np.sum(mass * x))
        walls, fluid = (read_csv(self.direct / "dumps" / name) for name in ("energy.csv", "fluid.csv"))
        interval = np.diff(walls["time_s"]).mean()
        # energy.csv has the charge's torque on the mill. The spin of the balls is not here
        given = interval * np.cumsum(fluid["torque_Nm"] - walls["torque_Nm"] + weight[1:])
        felt = interval * np.cumsum(fluid["torque_Nm"])
        self.assertEqual(len(dumps), len(given) + 1)
        apart = given - (np.array(momentum[1:]) - momentum[0])
        self.assertLess(np.ptp(apart), 0.1 * np.ptp(felt))

    def test_both_begin_with_the_last_state_of_the_dry_run_and_end_together(self):
        notes = read_json(self.direct / "dumps" / "run.json", "dumps")
        self.assertAlmostEqual(notes["begin_s"], 0.2, delta=1e-9)
        self.assertAlmostEqual(notes["duration_s"], 0.3, delta=1e-9)
        self.assertAlmostEqual(read_json(self.direct / "mesh.json", "mesh")["time0_s"], 0.2, delta=1e-9)
        steps = read_csv(next((self.direct / "postProcessing" / "flow" / "0").glob("steps.csv")))
        self.assertAlmostEqual(steps["time_s"][-1], 0.3, delta=1e-9)

    def test_the_flow_sees_the_volume_of_the_balls(self):
        steps = read_csv(self.direct / "postProcessing" / "flow" / "0" / "steps.csv")
        volume = read_json(self.case / "mill.json", "mill")["derived"]["charge"]["volume_m3"]
        # Averages cut balls where walls leave next to nothing of a voxel; the fluid of the mesh is then more by that
        np.testing.assert_allclose(steps["solids_m3"], volume, rtol=1e-6)
        np.testing.assert_allclose(steps["solids_m3"] - steps["without_room_m3"], volume, rtol=1e-9)

    def test_the_report_says_how_they_agree(self):
        page = (self.case / "report.html").read_text()
        self.assertIn("Balls and slurry at the same time", page)
        self.assertNotIn("The slurry would not move the balls", page)

    def test_a_new_title_is_in_the_report_and_computes_nothing_again(self):
        self.assertIn("Keeping flow: it is up to date", self.again)
        self.assertNotIn("Running flow", self.again)
        self.assertIn("another title", (self.case / "report.html").read_text())

    def test_stops_after_a_stage(self):
        case = self.copy("-until")
        (case / "direct" / "slurry.h5").unlink()
        self.assertIn("slurry.h5 is gone: start runs again", run_mill(case, "mill.yaml", until="start"))
        shutil.rmtree(case / "direct")
        for stage, product in (("mesh", "constant/polyMesh/owner"), ("start", "0/alpha.slurry")):
            output = run_mill(case, "mill.yaml", until=stage)
            self.assertTrue((case / "direct" / product).is_file())
            self.assertNotIn("Running flow", output)

    def test_a_killed_run_resumes_both_at_the_same_time(self):
        self.enterContext(patch.dict(os.environ, MILLFOAM_NP="2"))
        case = self.copy("-killed")
        shutil.rmtree(case / "direct")
        process = subprocess.Popen(["bash", "-c", STAGES, "run_mill", case, SCRIPTS, ".", "mill.yaml"], cwd=case,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        folders = case / "direct"
        deadline = time.monotonic() + 120
        while not [*folders.glob("processor0/0.1*"), *folders.glob("0.1*")]:
            self.assertLess(time.monotonic(), deadline, "no restart file")
            self.assertIsNone(process.poll(), "the run ended before it could be killed")
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        time.sleep(1)
        output = run_mill(case, "mill.yaml", until="flow")
        self.assertIn("Balls and flow resume at the flow's time", output)
        notes = read_json(folders / "dumps" / "run.json", "dumps")
        self.assertAlmostEqual(notes["duration_s"], 0.3, delta=1e-9)
        run(folders, "millAverage", "mill.json", "--case", ".")
        windows = [read_windows(place / "direct" / "solids.h5", 0.2, 0.5) for place in (self.case, case)]
        self.assertEqual(*(len(found) for found in windows))
        # Not the same numbers: two ranks round sums differently, and the flow's times have ten digits
        apart = [np.abs(one.solidity - other.solidity).max() for one, other in zip(*windows)]
        self.assertLess(apart[0], 0.05)
        # The first window after the resume; later ones are those of other balls, because impacts enlarge the difference
        self.assertLess(next(filter(None, apart), 0), 0.05)
        # Killed after the balls' end, before the stage was noted
        (folders / ".stages" / "flow").unlink()
        self.assertIn("Balls and flow are complete", run_mill(case, "mill.yaml", until="flow"))

    def test_a_flow_without_its_balls_ends_with_a_sentence(self):
        case = self.copy("-alone")
        (case / "direct" / "walls" / "shell.stl").unlink()
        (case / "direct" / ".stages" / "walls.files").unlink()  # otherwise the walls are made again
        (case / "direct" / ".stages" / "flow").unlink()
        (case / "direct" / "dumps" / "run.json").unlink()
        with self.assertRaisesRegex(RunError, "shell"):
            run_mill(case, "mill.yaml")


if __name__ == "__main__":
    unittest.main()
