#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and slurry in turn: two passes of a small mill by its stages, a pass that is killed, changes of its keys, and
what is refused."""
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

import h5py
import numpy as np

from mill_case import kill_mill_when, run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.files.flow_record import read_flow_record, starts
from millfoam.files.foam import read_field
from millfoam.readings.fluid_on_balls import fluid_on_balls
from millfoam.run import RunError

MILL = """
geometry: {diameter: 0.06, length: 0.02, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.6, sense: clockwise}
charge: {fill: 0.3, diameter: 0.004}
materials: {ball: glass, wall: HDPE}
dem: {settle_time: 0.1, duration: 0.3, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {voxel_size: 0.008, window: 0.05, start: 0.15}
resolution: {cell_size: 0.006, layers: 2}
flow: {duration: 0.15, coupling: iterated, passes: 2, averages: {start: 0.05}}
"""


def last_restart(folder):
    """Step of a dry run's last restart file, 0 without one."""
    return max((int(path.suffix[1:]) for path in folder.glob("dem/restart.*[0-9]")), default=0)


def written_times(folder):
    """[(s, folder)] of a flow on one process, without its start."""
    return sorted((float(path.name), path) for path in folder.glob("0.*") if re.fullmatch(r"0\.\d+", path.name))


def stages(word, output):
    """The stages of which an Allrun said that they are `Running` or `Keeping`."""
    return re.findall(rf"^{word} (\w+):", output, re.M)


def numbers(path):
    """All of an HDF5 file: name -> array."""
    found = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = item[()]

    with h5py.File(path) as file:
        file.visititems(add)
    return found


class Passes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # On one process a resumed dry run has the numbers of one that was not killed, to the last digit
        cls.enterClassContext(patch.dict(os.environ, MILLFOAM_NP="1"))
        cls.case = Path(tempfile.mkdtemp(prefix="coupling-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        (cls.case / "mill.yaml").write_text(MILL)
        run_mill(cls.case, "mill.yaml", undrawn="pictures")

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

    def copy(self, name):
        case = self.case.with_name(self.case.name + name)
        shutil.copytree(self.case, case, symlinks=True)
        self.addCleanup(shutil.rmtree, case)
        return case

    def assert_same_charge(self, found, expected):
        """All records, windows and numbers of one run."""
        for name in ("energy.csv", "fluid.csv", "overlaps.csv"):
            self.assertEqual((found / "dumps" / name).read_bytes(), (expected / "dumps" / name).read_bytes(), name)
        one, other = (numbers(folder / "solids.h5") for folder in (found, expected))
        self.assertEqual(one.keys(), other.keys())
        for name, values in other.items():
            np.testing.assert_array_equal(one[name], values, err_msg=name)

    def assert_same_flow(self, found, expected):
        """The same steps, balls and windows. The name of the time at which a flow resumes has ten digits, so that its
        walls and steps differ by 1e-11 from there on; other causes were not looked for. Splashing slurry makes more of
        it. Found in 0.3 s: the share differs by 2e-6 (mean over the cells) after ten steps, its mean over time by
        2 %."""
        one, other = (read_flow_record(folder) for folder in (found, expected))
        self.assertTrue(one.complete)
        np.testing.assert_allclose(one.steps["time_s"], other.steps["time_s"], rtol=0, atol=1e-9)
        flows = [numbers(folder / "slurry.h5") for folder in (found, expected)]
        self.assertEqual(*({name: values.shape for name, values in flow.items()} for flow in flows))
        for name in ("balls/solidity", "balls/velocity", "voidage", "ledger/deposited"):
            scale = np.abs(flows[1][name]).max()
            np.testing.assert_allclose(flows[0][name], flows[1][name], rtol=0, atol=1e-8 * scale, err_msg=name)
        shares = [flow["mean/slurry"] for flow in flows]
        self.assertLess(np.abs(shares[0] - shares[1]).mean(), 0.1 * shares[1].mean())
        times = [written_times(folder) for folder in (found, expected)]
        np.testing.assert_allclose(*([time for time, _ in of_one] for of_one in times), rtol=0, atol=1e-9)
        resumed = starts(found)[-1][0]
        after = next(k for k, (time, _) in enumerate(times[0]) if time > resumed + 1e-6)
        shares = [read_field(of_one[after][1] / "alpha.slurry") for of_one in times]
        self.assertLess(np.abs(shares[0] - shares[1]).mean(), 1e-4)

    def test_a_pass_that_is_killed_in_its_charge_and_in_its_flow_has_the_same_numbers(self):
        case = self.copy("-killed")
        second, expected = case / "pass_2", self.case / "pass_2"
        shutil.rmtree(second)
        for file in (*case.glob("coupling.*"), case / "report.html"):
            file.unlink()

        begin = last_restart(case)
        output = kill_mill_when(case, "mill.yaml", lambda: last_restart(second) > begin)
        self.assertEqual(stages("Running", output), ["forces", "walls", "charge"])
        self.assertFalse((second / "dumps" / "run.json").exists())

        output = kill_mill_when(case, "mill.yaml", lambda: len(written_times(second)) > 1)
        self.assertEqual(stages("Running", output), ["charge", "average", "mesh", "check", "start", "flow"])
        self.assertIn("resumed at step", (second / "log.charge").read_text())
        self.assertFalse((second / "slurry.h5").exists())

        output = run_mill(case, "mill.yaml")
        self.assertEqual(stages("Running", output), ["flow", "coupling", "pictures", "report"])
        self.assertTrue((second / "pictures" / "maps.png").exists())
        before = ["walls", "charge", "average", "mesh", "check", "start"]
        self.assertEqual(stages("Keeping", output), [*before, "flow", "forces", *before])
        self.assertGreater(starts(second)[-1][0], 0)

        self.assert_same_charge(second, expected)
        self.assert_same_flow(second, expected)
        tables = [read_csv(folder / "coupling.csv") for folder in (case, self.case)]
        # Of what the flow changes; the rest is of the balls alone
        limits = {"force_over_weight": 0.01, "force_disagreement": 0.05}
        for name, values in tables[1].items():
            np.testing.assert_allclose(tables[0][name], values, rtol=0, atol=limits.get(name, 0), err_msg=name)
        self.assertTrue((case / "report.html").exists())

    def test_one_way_coupling_keeps_the_first(self):
        case = self.copy("-copy")
        output = run_mill(case, "mill.yaml", "flow.coupling=one_way", undrawn="pictures")
        self.assertNotIn("Running flow", output)
        self.assertNotIn("Pass 2", output)
        page = (case / "report.html").read_text()
        self.assertNotIn("Balls and slurry have settled", page)
        self.assertIn("The slurry would not move the balls", page)

    def test_relaxation_changes_the_passes_after_the_second_and_a_law_changes_all_flows(self):
        case = self.copy("-law")
        output = run_mill(case, "mill.yaml", "flow.relaxation=0.5", undrawn="pictures report")
        for stage in ("charge", "flow", "forces"):
            self.assertIn(f"Keeping {stage}: it is up to date", output)
        self.assertNotIn("Running charge", output)
        self.assertNotIn("Running flow", output)
        output = run_mill(case, "mill.yaml", "flow.law=Ergun", undrawn="pictures report")
        self.assertEqual(output.count("Running flow"), 2)
        self.assertEqual(output.count("Running forces"), 1)
        self.assertEqual(output.count("Running charge"), 1)  # of pass 2; the dry one is kept

    def test_a_charge_of_another_case_is_refused(self):
        with self.assertRaisesRegex(RunError, "expected flow.coupling one_way, because balls that feel"):
            run_mill(self.case, "mill.yaml", charge=".")


if __name__ == "__main__":
    unittest.main()
