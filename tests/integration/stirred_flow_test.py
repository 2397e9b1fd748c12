# SPDX-License-Identifier: GPL-3.0-or-later
"""The slurry in a small stirred mill: its mesh, start and flow between the balls of the dry run, from one mill.yaml."""
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest.mock import patch

import numpy as np

from mill_case import kill_mill_when, run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.files.foam import read_field, read_mesh, times
from millfoam.files.mill import read_mill
from millfoam.files.tables import read_columns
from millfoam.run import RunError, run
from stirred_mill import small_mill

MILL = small_mill("""
dem: {youngs_modulus: 5.0e6, settle_time: 0.05, duration: 0.15, record_interval: 0.005}
averages: {start: 0.1}
slurry: {density: 1379, plastic_viscosity: 0.1, yield_stress: 0, level: 0.036}
resolution: {cell_size: 0.0035}
flow: {duration: 0.03, write_interval: 0.015, averages: {start: 0.01}}
""", ("height: 0.025", "height: 0.033"), ("level: 0.035", "level: 0.036"),
                  ("tip_speed: 0.8", "tip_speed: 0.8, sense: clockwise"))
ROOT = Path(__file__).resolve().parents[2]
os.environ["MILLFOAM_NP"] = "1"


class StirredFlow(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="stirred-flow-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "mill.yaml").write_text(MILL)
        cls.case = cls.folder / "case"
        run_mill(cls.case, cls.folder / "mill.yaml", until="flow")
        cls.again = run_mill(cls.case, cls.folder / "mill.yaml")  # its report
        cls.mill = read_mill(cls.case, "stirred")
        cls.balance = read_columns(cls.case, "slurryBalance")

    def test_mesh_turns_with_the_impeller_and_is_good(self):
        mesh = read_json(self.case / "mesh.json", "mesh")
        self.assertEqual(mesh["time0_s"], 0.1)
        for quantity, limited in mesh["quality"].items():
            self.assertLessEqual(limited["value"], limited["limit"], quantity)
        self.assertTrue(read_json(self.case / "check.json", "check")["ok"])
        # Turned by 0.8 m/s / 25 mm for 0.1 s: a tip of the lower pins lies there
        points = np.unique(read_mesh(self.case).points.round(9), axis=0)
        angle = -0.8 / 0.025 * 0.1
        tip = 0.025 * np.array([np.cos(angle), np.sin(angle)])
        self.assertLess(np.abs(points - [*tip, 0.013]).max(axis=1).min(), 1e-8)

    def test_slurry_is_kept(self):
        start = self.mill.derived("flow", "start", "volume_m3")
        self.assertAlmostEqual(self.balance["holdUp"][0] / start, 1, delta=1e-6)
        self.assertLess(np.abs(self.balance["missing"]).max() / start, 1e-10)
        self.assertLess(np.abs(self.balance["discharge"]).max() * 0.03 / start, 1e-12)

    def test_balls_are_those_of_the_dry_run(self):
        steps = read_csv(next((self.case / "postProcessing" / "flow").glob("*/steps.csv")))
        np.testing.assert_allclose(steps["solids_m3"], self.mill.derived("charge", "volume_m3"), rtol=1e-3)

    def test_slurry_turns_with_the_balls_and_the_shell_holds_it(self):
        late = self.balance["Time"] > 0.01
        # Clockwise, so that what holds it is positive
        self.assertGreater(self.balance["torque_shell"][late].mean(), 0)
        np.testing.assert_allclose(self.balance["power"], self.balance["power_impeller"], rtol=1e-12)
        np.testing.assert_allclose(self.balance["power_impeller"], -0.8 / 0.025 * self.balance["torque_impeller"],
                                   rtol=1e-9)
        for part in ("shell", "base", "lid"):
            self.assertEqual(np.abs(self.balance[f"power_{part}"]).max(), 0)
        folder = times(self.case)[-1][1]
        mesh = read_mesh(self.case, folder)
        centre, volume = mesh.centres_and_volumes()
        velocity, share = read_field(folder / "U", mesh.cells), read_field(folder / "alpha.slurry", mesh.cells)
        around = (centre[:, 0] * velocity[:, 1] - centre[:, 1] * velocity[:, 0]) / np.hypot(centre[:, 0], centre[:, 1])
        mean = (volume * share * around).sum() / (volume * share).sum()
        self.assertLess(mean, -0.01)
        self.assertGreater(mean, -0.8)

    def test_walls_and_balls_give_what_the_slurry_takes(self):
        late = self.balance["Time"] > 0.01
        mean = {name: self.balance[f"torque_{name}"][late].mean()
                for name in ("impeller", "shell", "base", "lid", "balls", "all")}
        # Clockwise balls drive the slurry and walls at rest hold it. On this coarse mesh the moments of pressures at
        # the pins miss a quarter of it
        self.assertLess(mean["balls"], -1e-3)
        rest = mean["all"] - sum(value for name, value in mean.items() if name != "all")
        self.assertLess(abs(rest), 0.35 * abs(mean["balls"]))

    def test_a_killed_flow_resumes_to_the_same_numbers(self):
        case = self.folder / "killed"
        shutil.copytree(self.case, case, symlinks=True)
        shutil.rmtree(case / "postProcessing")
        for _, folder in times(case):
            shutil.rmtree(folder)
        (case / ".stages" / "start").unlink()
        (case / "log.flow").unlink()
        kill_mill_when(case, self.folder / "mill.yaml",
                       lambda: (case / "log.flow").exists() and "\nTime = 0.02" in (case / "log.flow").read_text())
        output = run_mill(case, self.folder / "mill.yaml", until="flow")
        self.assertIn("Running flow", output)
        self.assertNotIn("Running start", output)
        resumed = read_columns(case, "slurryBalance")
        np.testing.assert_allclose(resumed["Time"], self.balance["Time"], rtol=1e-9)
        for name in ("z", "torque_impeller", "torque_balls", "holdUp"):
            np.testing.assert_allclose(resumed[name], self.balance[name], rtol=1e-6, err_msg=name)

    def test_the_report_has_a_section_of_the_slurry(self):
        page = (self.case / "report.html").read_text()
        for words in ("Numbers of the slurry", "torque on the slurry by balls", "The last turn", "Reynolds number",
                      "Vortex", "of the radius and of the torque", "one-way", "torques are balanced"):
            self.assertTrue(words in page, words)

    def test_gravity_is_along_the_axis(self):
        centre, volume = read_mesh(self.case).centres_and_volumes()
        share = read_field(self.case / "0" / "alpha.slurry", len(volume))
        full = share > 1 - 1e-9
        self.assertLess(centre[full, 2].max(), centre[share < 1e-9, 2].min() + 0.004)

    def test_its_numbers_are_written_and_drawn(self):
        script = Path(__file__).resolve().parents[2] / "cases" / "mills" / "stirred_A" / "stirred_flow.py"
        run(self.case, sys.executable, script, ".")
        numbers = read_csv(self.case / "flow.csv")
        late = self.balance["Time"] > 0.01
        self.assertAlmostEqual(numbers["torque_shell_Nm"][0] / self.balance["torque_shell"][late].mean(), 1, delta=0.02)
        self.assertGreater(numbers["reynolds"][0], 0)
        for name in ("flow_maps.png", "vortex.png"):
            self.assertGreater((self.case / name).stat().st_size, 10000)

    def test_new_mill_makes_a_case_with_the_walls_of_a_stirred_mill(self):
        run(self.folder, ROOT / "scripts" / "new_mill", "mill.yaml", "new")
        self.assertEqual((self.folder / "new" / "0.orig" / "U").read_text(), (self.case / "0.orig" / "U").read_text())
        run(self.folder, "new/Allrun", "--charge", self.case, "--until", "start")
        self.assertEqual(read_field(self.folder / "new" / "0" / "alpha.slurry").tolist(),
                         read_field(self.case / "0" / "alpha.slurry").tolist())

    def test_dictionaries_of_another_machine_are_refused(self):
        other = self.folder / "other"
        shutil.copytree(self.case / "0.orig", other / "0.orig")
        path = other / "0.orig" / "U"
        path.write_text(path.read_text().replace("restingWallVelocity", "movingWallVelocity"))
        with self.assertRaisesRegex(RunError, "its walls are those of a tumbling mill"):
            run_mill(other, self.folder / "mill.yaml", "flow.balls=false", until="mesh")

    def test_an_up_to_date_flow_is_kept_and_reported(self):
        for stage in ("charge", "average", "mesh", "start", "flow"):
            self.assertIn(f"Keeping {stage}", self.again)
        self.assertTrue((self.case / "report.html").is_file())

    def test_two_ranks_give_the_same_as_one(self):
        with patch.dict(os.environ, MILLFOAM_NP="2"):
            run_mill(self.folder / "two", self.folder / "mill.yaml", charge=self.case, until="flow")
        other = read_columns(self.folder / "two", "slurryBalance")
        self.assertAlmostEqual(other["Time"][-1], self.balance["Time"][-1], delta=1e-9)
        for name, limit in (("holdUp", 1e-12), ("z", 1e-4), ("torque_shell", 0.01), ("torque_balls", 0.01)):
            late = [columns[name][columns["Time"] > 0.01].mean() for columns in (other, self.balance)]
            self.assertLess(abs(late[0] / late[1] - 1), limit, name)
        share = [read_field(times(folder)[-1][1] / "alpha.slurry") for folder in (self.folder / "two", self.case)]
        self.assertLess(np.abs(share[0] - share[1]).mean(), 1e-3)


if __name__ == "__main__":
    unittest.main()
