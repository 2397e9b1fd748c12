#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and slurry in turn: two passes of a small mill by its stages, changes of its keys, and what is refused."""
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from mill_case import run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.readings.fluid_on_balls import fluid_on_balls
from millfoam.run import RunError

MILL = """
geometry: {diameter: 0.06, length: 0.02, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.6, sense: clockwise}
charge: {fill: 0.3, diameter: 0.004}
materials: {ball: glass, wall: HDPE}
dem: {settle_time: 0.15, duration: 0.8, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {voxel_size: 0.008, window: 0.05, start: 0.4}
resolution: {cell_size: 0.006, layers: 2}
flow: {duration: 0.5, coupling: iterated, passes: 2, averages: {start: 0.2}}
"""


class Passes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = Path(tempfile.mkdtemp(prefix="coupling-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        (cls.case / "mill.yaml").write_text(MILL)
        cls.output = run_mill(cls.case, "mill.yaml")

    def test_the_second_goes_on_where_the_first_ended(self):
        runs = [read_json(folder / "dumps" / "run.json", "dumps") for folder in (self.case, self.case / "pass_2")]
        self.assertEqual([run["begin_s"] for run in runs], [0, runs[0]["duration_s"]])
        begins = [read_json(folder / "solids.json", "averages")["time0_s"]
                  for folder in (self.case, self.case / "pass_2")]
        self.assertAlmostEqual(begins[1] - begins[0], runs[0]["duration_s"], delta=1e-6)
        mesh = read_json(self.case / "pass_2" / "mesh.json", "mesh")
        self.assertAlmostEqual(mesh["time0_s"], begins[1], delta=1e-9)

    def test_its_balls_feel_the_mean_flow_of_the_first(self):
        with h5py.File(self.case / "slurry.h5") as flow, h5py.File(self.case / "pass_2" / "forces.h5") as forces:
            for name in ("pressure_force", "drag_force", "exchange"):
                np.testing.assert_allclose(forces[f"mean/balls/{name}"][()], flow[f"mean/balls/{name}"][()], rtol=1e-12)
        felt = read_json(self.case / "pass_2" / "dumps" / "results.json", "charge")["fluid"]
        given = fluid_on_balls(self.case / "slurry.h5", 2700.0)
        self.assertEqual(felt["kind"], "slurry")
        # Other balls than those of the first flow: they have moved
        self.assertAlmostEqual(felt["force_N"][1] / given.force[1], 1, delta=0.1)
        self.assertGreater(given.force[1], 0.05 * given.weight)

    def test_both_are_compared(self):
        table = read_csv(self.case / "coupling.csv")
        self.assertEqual(list(table["pass"]), [1, 2])
        self.assertGreater(table["solidity_change"][1], 0)
        self.assertGreater(table["force_disagreement"][1], 0)
        content = read_json(self.case / "coupling.json", "coupling")
        self.assertEqual((content["passes"], content["settled"], content["folders"]), (2, False, [".", "pass_2"]))
        # Less than a turn of flow has no error, so that it never settles
        self.assertTrue(np.isnan(table["drive_power_W"]).all())
        self.assertTrue(np.isfinite(table["charge_power_W"]).all())

    def test_the_report_is_that_of_the_last(self):
        page = (self.case / "report.html").read_text()
        for words in ("Balls and slurry in turn", "Balls and slurry have settled", "The balls feel the slurry"):
            self.assertIn(words, page)
        self.assertNotIn("The slurry would not move the balls", page)

    def test_a_second_call_keeps_all_passes(self):
        again = run_mill(self.case, "mill.yaml")
        for stage in ("charge", "flow", "forces"):
            self.assertIn(f"Keeping {stage}: it is up to date", again)
        self.assertNotIn("Running charge", again)
        self.assertNotIn("Running flow", again)

    def test_one_way_coupling_keeps_the_first(self):
        case = self.case.with_name(self.case.name + "-copy")
        shutil.copytree(self.case, case, symlinks=True)
        self.addCleanup(shutil.rmtree, case)
        output = run_mill(case, "mill.yaml", "flow.coupling=one_way")
        self.assertNotIn("Running flow", output)
        self.assertNotIn("Pass 2", output)
        page = (case / "report.html").read_text()
        self.assertNotIn("Balls and slurry have settled", page)
        self.assertIn("The slurry would not move the balls", page)

    def test_relaxation_changes_the_passes_after_the_second_and_a_law_changes_all_flows(self):
        case = self.case.with_name(self.case.name + "-law")
        shutil.copytree(self.case, case, symlinks=True)
        self.addCleanup(shutil.rmtree, case)
        output = run_mill(case, "mill.yaml", "flow.relaxation=0.5")
        self.assertNotIn("Running charge", output)
        self.assertNotIn("Running flow", output)
        output = run_mill(case, "mill.yaml", "flow.law=Ergun")
        self.assertEqual(output.count("Running flow"), 2)
        self.assertEqual(output.count("Running forces"), 1)
        self.assertEqual(output.count("Running charge"), 1)  # of pass 2; the dry one is kept

    def test_a_charge_of_another_case_is_refused(self):
        with self.assertRaisesRegex(RunError, "expected flow.coupling one_way, because balls that feel"):
            run_mill(self.case, "mill.yaml", charge=".")


if __name__ == "__main__":
    unittest.main()
