#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and slurry of a small stirred mill at the same time: what they give to each other, and their report."""
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from mill_case import force_difference, run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.run import RunError, run
from stirred_mill import small_mill

MILL = small_mill("""
dem: {youngs_modulus: 5.0e6, settle_time: 0.1, duration: 0.1, record_interval: 0.005}
averages: {start: 0.05}
slurry: {density: 1379, plastic_viscosity: 0.1, yield_stress: 0, level: 0.036}
resolution: {cell_size: 0.0035}
flow: {duration: 0.03, write_interval: 0.015, averages: {start: 0.01}, coupling: direct}
""", ("height: 0.025", "height: 0.033"), ("level: 0.035", "level: 0.036"))
os.environ["MILLFOAM_NP"] = "1"
SCRIPT = Path(__file__).resolve().parents[2] / "cases" / "mills" / "stirred_A" / "stirred_flow.py"


class StirredDirect(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = Path(tempfile.mkdtemp(prefix="stirred-direct-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        (cls.case / "mill.yaml").write_text(MILL)
        run_mill(cls.case, "mill.yaml")
        cls.direct = cls.case / "direct"
        cls.mill = read_json(cls.case / "mill.json", "mill")["derived"]

    def test_the_balls_take_what_the_flow_gives(self):
        # Thirty steps, of which the balls feel each one step later
        self.assertLess(force_difference(self.direct, 0.1 + 0.01), 0.08)
        self.assertEqual(np.max(read_csv(self.direct / "dumps" / "fluid.csv")["balls_without_field"]), 0)

    def test_the_pressure_carries_the_balls_in_slurry(self):
        rows = read_csv(self.direct / "dumps" / "fluid.csv")
        buoyancy = 1379 * 9.81 * self.mill["charge"]["volume_m3"]
        late = rows["pressure_z_N"][len(rows["time_s"]) // 2:].mean()
        self.assertGreater(late, 0.4 * buoyancy)
        self.assertLess(late, 1.2 * buoyancy)

    def test_mesh_and_balls_begin_where_the_dry_run_ended(self):
        self.assertAlmostEqual(read_json(self.direct / "dumps" / "run.json", "dumps")["begin_s"], 0.1, delta=1e-9)
        self.assertAlmostEqual(read_json(self.direct / "mesh.json", "mesh")["time0_s"], 0.1, delta=1e-9)

    def test_the_flow_sees_the_volume_of_the_balls(self):
        steps = read_csv(self.direct / "postProcessing" / "flow" / "0" / "steps.csv")
        # But for what balls reach into the walls
        np.testing.assert_allclose(steps["solids_m3"] - steps["without_room_m3"], self.mill["charge"]["volume_m3"],
                                   rtol=1e-4)

    def test_its_report_and_numbers_are_of_balls_that_feel_it(self):
        page = (self.case / "report.html").read_text()
        for words in ("The balls feel the force that the flow gives", "power of the impeller to the balls", "Vortex"):
            self.assertTrue(words in page, words)
        for words in ("The slurry would not move the balls", "balls of the dry run",
                      "Walls at rest take the impeller"):
            self.assertFalse(words in page, words)
        run(self.direct, sys.executable, SCRIPT, ".")
        numbers = read_csv(self.direct / "flow.csv")
        energy = read_csv(self.direct / "dumps" / "energy.csv")
        # A record is of the time before it, so that at the begin of the averages does not count
        late = energy["time_s"] > 0.1 + 0.01 + 1e-6
        self.assertAlmostEqual(numbers["power_balls_W"][0] / energy["power_W"][late].mean(), 1, delta=1e-6)

    def test_iterated_coupling_is_refused(self):
        with self.assertRaisesRegex(RunError, "one_way or direct for a stirred mill"):
            run_mill(self.case / "other", self.case / "mill.yaml", "flow.coupling=iterated")


if __name__ == "__main__":
    unittest.main()
