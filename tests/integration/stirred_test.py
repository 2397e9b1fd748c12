# SPDX-License-Identifier: GPL-3.0-or-later
"""A small stirred mill from its description to its averages and report: torques on its parts, contacts, a resumed run,
and what is refused."""
import os
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from mill_case import run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.files.mill import NoMill, read_mill
from millfoam.files.rings_file import read_rings
from millfoam.files.wall_forces import read_wall_forces
from millfoam.run import RunError, run, set_options
from stirred_mill import small_mill

MILL = small_mill("""
dem: {youngs_modulus: 5.0e6, settle_time: 0.05, duration: 0.3, record_interval: 0.005,
      contact_statistics: true}
averages: {start: 0.15}
""")
# Two discs, one of them at the shaft's end
DISCS = ("geometry.impeller={shaft: {diameter: 0.012, end: 0.008}, discs: [{height: 0.010, diameter: 0.044, "
         "thickness: 0.004}, {height: 0.022, diameter: 0.040, thickness: 0.004}]}")
ROOT = Path(__file__).resolve().parents[2]
PARTS = ("impeller", "shell", "base", "lid")
os.environ["MILLFOAM_NP"] = "1"  # on one rank a resumed run is the same to round-off


class Stirred(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="stirred-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "mill.yaml").write_text(MILL)
        cls.case = cls.folder / "case"
        run_mill(cls.case, cls.folder / "mill.yaml")
        cls.results = read_json(cls.case / "dumps" / "results.json", "charge")

    def test_balls_stay_in_the_mill_around_the_impeller(self):
        self.assertEqual(self.results["lost_balls"], 0)
        self.assertEqual(self.results["balls"], read_mill(self.case, "stirred").derived("charge", "balls"))
        last = max((self.case / "dumps").glob("dump.*.txt"), key=lambda path: int(path.name.split(".")[1]))
        balls = np.loadtxt(last, skiprows=9)
        x, y, z, radius = *balls[:, 2:5].T, balls[0, 8]
        away = np.hypot(x, y)
        slack = 0.3 * radius  # softened balls overlap the walls, by up to 15 % of their diameter
        self.assertLess(away.max(), 0.03 - radius + slack)
        self.assertGreater(z.min(), radius - slack)
        self.assertGreater(away[z > 0.008 + radius].min(), 0.006 + radius - slack)

    def test_torque_of_the_impeller_is_that_of_the_walls_at_rest(self):
        torques = self.results["part_torques_Nm"]
        self.assertEqual(tuple(torques), PARTS)
        # Balls that keep their angular momentum pass it on; they resist the impeller, which turns anticlockwise
        self.assertLess(torques["impeller"], 0)
        at_rest = sum(torques[part] for part in PARTS[1:])
        self.assertAlmostEqual(-torques["impeller"] / at_rest, 1, delta=0.03)
        self.assertGreater(torques["shell"], 0)
        self.assertGreater(torques["base"], 0)

    def test_power_is_the_impellers_torque_times_its_speed(self):
        columns, energy = (read_csv(self.case / "dumps" / name) for name in ("torques.csv", "energy.csv"))
        self.assertEqual(tuple(columns), ("time_s", *(f"{part}_Nm" for part in PARTS)))
        np.testing.assert_allclose(columns["impeller_Nm"], energy["torque_Nm"], rtol=1e-5, atol=1e-9)
        np.testing.assert_allclose(energy["power_W"], -energy["torque_Nm"] * 0.8 / 0.025, rtol=1e-6)
        late = energy["time_s"] >= self.results["steady_from_s"]
        self.assertAlmostEqual(energy["power_W"][late].mean(), self.results["power_W"],
                               delta=3 * self.results["power_error_W"])
        self.assertGreater(energy["potential_J"].min(), 0)

    def test_averages_turn_with_the_impeller(self):
        with h5py.File(self.case / "solids.h5") as file:
            self.assertEqual(file.attrs["version"], 3)
            grid = file["grid"].attrs
            self.assertEqual((grid["frame"], grid["components"]), (b"turning", b"cylindrical"))
            self.assertAlmostEqual(grid["angular_velocity"], 0.8 / 0.025, places=9)
        rings = read_rings(self.case / "solids.h5")
        self.assertAlmostEqual(rings.balls.sum() / read_mill(self.case, "stirred").derived("charge", "volume_m3"), 1,
                               delta=1e-3)
        mean = (rings.balls[..., None] * np.nan_to_num(rings.velocity)).sum(axis=(0, 1, 2)) / rings.balls.sum()
        self.assertGreater(mean[1], 0.05)
        # The same time as in the lab's frame, whose test below has other voxels
        self.assertLess(mean[1], 0.8)

    def test_balls_are_never_where_the_pins_are(self):
        # In the impeller's frame the mean over the run has pins as sharp as in a single record: lower ones along x
        run(self.case, "millAverage", "--dumps", "dumps/dump.*.txt", "--cylinder", 0.012, 0.024, 0.0115, 0.0145,
            "--shape", 1, 60, 1, "--frame", "turning", "--start", 0.15, "--window", "whole", "--tolerance", 1, "-o",
            "pins.h5")
        rings = read_rings(self.case / "pins.h5")
        at_pins = rings.solidity[0, [0, 29, 30, 59], 0]  # within 6 degrees: 1.3 mm of 3 mm at 12 mm
        others = rings.solidity[0, [14, 15, 44, 45], 0]
        self.assertLess(at_pins.max(), 0.02 * others.mean())
        run(self.case, "millAverage", "--dumps", "dumps/dump.*.txt", "--cylinder", 0.012, 0.024, 0.0115, 0.0145,
            "--shape", 1, 60, 1, "--components", "cylindrical", "--start", 0.15, "--window", "whole", "--tolerance", 1,
            "-o", "pins.h5")
        lab = read_rings(self.case / "pins.h5")
        self.assertGreater(lab.solidity.min(), 0.3 * others.mean())

    def test_averages_made_in_the_run_are_those_of_its_dumps(self):
        case = self.folder / "live"
        run_mill(case, self.folder / "mill.yaml", "dem.duration=0.06", "averages.start=0.03",
                 "averages.live=yes", "dem.contact_statistics=no", until="average")
        run(case, "millAverage", "mill.json", "--case", ".", "-o", "later.h5")
        live, later = (read_rings(case / name) for name in ("solids.h5", "later.h5"))
        # Dumps have six digits
        np.testing.assert_allclose(live.solidity, later.solidity, atol=1e-4)
        np.testing.assert_allclose(live.velocity, later.velocity, atol=1e-3)
        self.assertEqual(live.angular_velocity, later.angular_velocity)
        self.assertEqual((live.begin, live.end), (later.begin, later.end))

    def test_frames_that_do_not_fit_are_refused(self):
        grid = ("--shape", 2, 2, 2, "--window", "whole", "-o", "no.h5", "--dumps", "dumps/dump.*.txt")
        for options, words in ((("--box", 0, 0, 0, 1, 1, 1, "--frame", "turning"), "are for --cylinder"),
                               (("--cylinder", 0, 1, 0, 1, "--frame", "turning", "--components", "cartesian"),
                                "--components is cartesian, expected cylindrical with --frame turning")):
            with self.assertRaisesRegex(RunError, words):
                run(self.case, "millAverage", *options, *grid)

    def test_balls_move_with_the_impeller(self):
        run(self.case, "millAverage", "--dumps", "dumps/dump.*.txt", "--cylinder", 0, 0.03, 0, 0.09, "--shape", 6, 24,
            18, "--inside", "walls/*.stl", "--start", 0.15, "--window", 0.15, "-o", "rings.h5")
        with h5py.File(self.case / "rings.h5") as file:
            solidity, velocity = file["solidity"][0], file["velocity"][0]  # [z][theta][r]
            # Softened balls overlap the walls
            self.assertLess(file["ledger/outside"][0], 1e-4 * file["ledger/volume_in"][0])
            weight = np.nan_to_num(solidity * file["grid/insideFraction"][0])
        theta = 2 * np.pi * (np.arange(24) + 0.5) / 24
        tangential = np.nan_to_num(velocity[..., 1] * np.cos(theta)[:, None]
                                   - velocity[..., 0] * np.sin(theta)[:, None])
        mean = (weight * tangential).sum() / weight.sum()
        self.assertGreater(mean, 0.05)
        self.assertLess(mean, 0.8)

    def test_discs_drive_the_balls(self):
        case = self.folder / "discs"
        run_mill(case, self.folder / "mill.yaml", DISCS, "dem.duration=0.15", "averages.start=0.05",
                 "averages.window=0.1")  # with its report: that of discs is made nowhere else
        results, mill = read_json(case / "dumps" / "results.json", "charge"), read_mill(case, "stirred")
        self.assertEqual(results["lost_balls"], 0)
        self.assertAlmostEqual(mill.derived("speed", "tip_speed_m_s"), 0.8)
        last = max((case / "dumps").glob("dump.*.txt"), key=lambda path: int(path.name.split(".")[1]))
        balls = np.loadtxt(last, skiprows=9)
        x, y, z, vx, vy = balls[:, 2:7].T
        away = np.hypot(x, y)
        # No centre lies in a disc
        for disc in mill.content["derived"]["geometry"]["impeller"]["discs"]:
            within = (np.abs(z - disc["height_m"]) < disc["thickness_m"] / 2) & (away < disc["diameter_m"] / 2)
            self.assertFalse(within.any())
        # Smooth discs drag the balls by friction, those near them most
        tangential = (x * vy - y * vx) / away
        self.assertGreater(tangential.mean(), 0.05)
        self.assertLess(np.percentile(tangential, 99), 0.8)
        columns = read_csv(case / "dumps" / "torques.csv")
        late = columns["time_s"] > 0.05
        self.assertLess(columns["impeller_Nm"][late].mean(), 0)
        self.assertGreater(columns["shell_Nm"][late].mean() + columns["base_Nm"][late].mean(), 0)

    def test_a_run_that_goes_on_is_the_one_that_was_not_interrupted(self):
        case = self.folder / "parts"
        averages = ("averages.start=0.02", "averages.window=0.02")
        # Until a restart file of the whole run: after its restart files the balls are listed anew
        run_mill(case, self.folder / "mill.yaml", "dem.duration=0.05", *averages, until="charge")
        output = run(case, "millDem", "../mill.yaml", "--case", ".", "--resume",
                     *set_options(("dem.duration=0.07", *averages)))
        self.assertIn("resumed at step", output)
        self.assertEqual(len(list((case / "dem").glob("partTorques.*.txt"))), 2)
        whole, parts = (read_csv(place / "dumps" / "torques.csv") for place in (self.case, case))
        self.assertAlmostEqual(parts["time_s"][-1], 0.07, delta=1e-6)
        for name, values in whole.items():
            np.testing.assert_allclose(parts[name], values[:len(parts[name])], rtol=1e-6, atol=1e-9)

    def test_contacts_dissipate_what_the_impeller_gives(self):
        contacts = self.results["contacts"]
        self.assertAlmostEqual(contacts["dissipated_over_drive"], 1, delta=0.01)
        self.assertEqual(sorted(contacts["power"]), sorted(("balls", *PARTS)))
        whole = sum(sum(parts.values()) for parts in contacts["power"].values())
        self.assertAlmostEqual(whole / contacts["dissipated_W"], 1, delta=1e-6)
        for partner in ("balls", "impeller", "shell", "base"):
            self.assertGreater(contacts["power"][partner]["tangential_W"], 0)
        spectra = read_csv(self.case / "dumps" / "contact_spectra.csv")
        self.assertAlmostEqual(spectra["touches_per_s"].sum() / contacts["collisions_per_s"], 1, delta=1e-6)

    def test_wall_cells_of_the_impeller_turn_and_the_others_are_at_rest(self):
        walls = self.results["contacts"]["walls"]
        energy = read_csv(self.case / "dumps" / "energy.csv")
        inside = (energy["time_s"] > walls["begin_s"] + 1e-9) & (energy["time_s"] <= walls["end_s"] + 1e-9)
        self.assertAlmostEqual(walls["torque_Nm"] / energy["torque_Nm"][inside].mean(), 1, delta=1e-5)
        torques = read_csv(self.case / "dumps" / "torques.csv")
        cells = read_wall_forces(self.case / "dumps" / "wall_forces.vtp")
        self.assertEqual(tuple(cells.parts), PARTS)
        middle, force = cells.corners.mean(axis=1), cells.fields["force_N"]
        moments = middle[:, 0] * force[:, 1] - middle[:, 1] * force[:, 0]
        # In the wrong frame the cells' middles are far from the contacts, and the forces of a turn add up to nothing
        for number, part in enumerate(PARTS[:3]):
            moment = moments[cells.fields["part"] == number].sum()
            self.assertAlmostEqual(moment / torques[f"{part}_Nm"][inside].mean(), 1, delta=0.05)
        # Each arm pushes as much as the opposite one, and against the sense of rotation
        pin = (cells.fields["part"] == 0) & (middle[:, 2] < 0.0165) & (np.abs(middle[:, 1]) < 0.0035)
        for side in (-1, 1):
            arm = pin & (side * middle[:, 0] > 0.008)
            self.assertLess(side * force[arm, 1].sum(), 0)

    def test_the_report_has_its_numbers(self):
        text = (self.case / "report.html").read_text()
        for words in ("power number", "mean speed of the balls", "ball on impeller",
                      "Walls at rest take the impeller", "Contacts dissipate what the drive gives",
                      "Spectra of energy", "Around the pins"):
            self.assertIn(words, text)
        run(self.case, ROOT / "scripts" / "report", ".", ".", "-o", "comparison.html")
        self.assertIn("Comparison of stirred mills", (self.case / "comparison.html").read_text())

    def test_everything_is_kept(self):
        output = run_mill(self.case, self.folder / "mill.yaml", until="average")
        self.assertEqual((output.count("Keeping"), output.count("Running")), (3, 0))

    def test_a_plan_is_made_of_the_whole_mill(self):
        # Of fewer balls, because the plan measures the mill itself
        changes = set_options(("charge.level=0.02", "dem.contact_statistics=no"))
        run(self.folder, "millMesh", "mill.yaml", "--resolved", "shallow.json", *changes)
        run(self.folder, "millDem", "plan", "mill.yaml", "--json", "dem_plan.json", *changes)
        plan, shallow = (read_json(self.folder / name, kind)
                         for name, kind in (("dem_plan.json", "dem-plan"), ("shallow.json", "mill")))
        self.assertEqual(plan["balls"], shallow["derived"]["charge"]["balls"])
        self.assertLess(plan["balls"], self.results["balls"])
        self.assertGreater(plan["wall_time_s"], 0)

    def test_new_mill_makes_a_folder_that_runs(self):
        run(self.folder, ROOT / "scripts" / "new_mill", "mill.yaml", "new")
        self.assertFalse((self.folder / "new" / "system").exists())
        run(self.folder, "new/Allrun", "--until", "walls")
        self.assertEqual(read_json(self.folder / "new" / "walls" / "walls.json", "walls")["triangles"],
                         read_json(self.case / "walls" / "walls.json", "walls")["triangles"])

    def test_stages_that_it_does_not_have_are_refused(self):
        for command, words in ((("millMesh", "mill.json", "--case", "."), "has no slurry: expected --walls"),
                               (("millMesh", "faces", "mill.json", "-o", "a.obj"), "faces of a stirred mill")):
            with self.assertRaisesRegex(RunError, words):
                run(self.case, *command)
        with self.assertRaisesRegex(RunError, "--until flow: expected walls, charge or average"):
            run_mill(self.case, self.folder / "mill.yaml", until="flow")
        with self.assertRaisesRegex(RunError, "expected a mill with slurry, because this one has no flow"):
            run_mill(self.folder / "other", self.folder / "mill.yaml", charge=self.case)
        with self.assertRaisesRegex(RunError, "voxels of slurry.h5 do not turn with the impeller"):
            run(self.case, "millDem", "mill.json", "--case", ".", "--fluid", "slurry.h5")
        with self.assertRaisesRegex(RunError, "direct with --with-flow"):
            run(self.case, "millDem", "mill.json", "--case", ".", "--with-flow", "exchange")
        with self.assertRaisesRegex(NoMill, "the mill is stirred; expected a tumbling one"):
            read_mill(self.case)


if __name__ == "__main__":
    unittest.main()
