#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study stirred_scale_up: its runs are mills that can be made, and what it reads of made-up runs whose answers are
known."""
import csv
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_json, write_json
from millfoam.files.mill import read_mill
from millfoam.readings.means import Mean
from millfoam.run import set_options
from millstudies.compared_runs import CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED
from millstudies.stirred_runs import drifts, read_all, read_numbers
from millstudies.stirred_settings import FILE
from millstudies.stirred_tables import lines_of
from millstudies.stirred_verdicts import ratio
from stirred_studies import assert_are_mills

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "studies" / "stirred_scale_up"))

import scale_up_verdicts  # noqa: E402, in the study's folder
import stirred_scale_up as study  # noqa: E402
from runs import RUNS, SPEEDS  # noqa: E402

STEP, RECORDS = 1e-4, 100  # s; steps between records
BALLS = 4
TORQUE, SHELL, SPEED = 0.8, 0.6, 0.5  # N m; m/s
DRIFT = 0.02  # of the torque and of the speed from turn to turn, N m and m/s


def make_run(folder, name, torque=TORQUE, speed=SPEED, falling=0.0):
    """A run as millDem leaves it: torque and mean speed rise by DRIFT from each turn to the next, and the mean of the
    last five turns is the given one. A fortieth of the torque is missing on the walls at rest. The kinetic energy of
    1 J falls by `falling` from turn to turn."""
    place = folder / name
    (place / "dumps").mkdir(parents=True)
    subprocess.run(["millMesh", FILE, *set_options(RUNS[name].settings(False)), "--resolved", place / "mill.json"],
                   check=True)
    mill = read_mill(place, "stirred")
    end, turn = mill.asked("dem", "duration"), mill.turn
    times = STEP * RECORDS * np.arange(1, int(end / STEP / RECORDS) + 1)
    # A value is that of the time since the record before
    drift = DRIFT * (np.clip(np.floor((times - STEP * RECORDS / 2 - end + 5 * turn) / turn), 0, 4) - 2)
    early = np.where(times >= end - 5 * turn - 1e-6, 0, 10)  # what must not be read
    columns = {"time_s": times, "impeller_Nm": -torque - drift - early, "shell_Nm": SHELL + 0.975 * drift,
               "base_Nm": 0.975 * torque - SHELL + 0 * times, "lid_Nm": 0 * times}
    write_table(place / "dumps" / "torques.csv", columns)
    write_table(place / "dumps" / "energy.csv", {
        "time_s": times, "power_W": 10 + 0 * times, "kinetic_J": 1 - falling * (drift / DRIFT + 2),
        "potential_J": 1 + 0 * times})
    write_json(place / "dumps" / "run.json", {"format": "millfoam-dumps", "timestep_s": STEP})
    write_json(place / "dumps" / "results.json", {
        "format": "millfoam-charge", "duration_s": end, "balls": BALLS, "steady": False,
        "part_torques_Nm": {part: 0.0 for part in ("impeller", "shell", "base", "lid")}})
    for time, more, before in zip(times, drift, early):
        # Balls of different speed and direction
        speeds = (speed + more + before) * np.array([0.5, 1.5, 0.8, 1.2])
        rows = [f"{ball} {speeds[ball] * 0.6:.9g} {1 + ball} 1 0 {-speeds[ball] * 0.8:.9g}" for ball in range(BALLS)]
        (place / "dumps" / f"dump.{round(time / STEP)}.txt").write_text(
            f"ITEM: TIMESTEP\n{round(time / STEP)}\nITEM: NUMBER OF ATOMS\n{BALLS}\nITEM: BOX BOUNDS\n0 1\n0 1\n0 1\n"
            "ITEM: ATOMS id vx z type vy vz\n" + "\n".join(rows) + "\n")
    return place


def write_table(path, columns):
    """A CSV of columns, name -> values."""
    rows = (",".join(f"{one:.9g}" for one in row) for row in zip(*columns.values()))
    path.write_text("\n".join([",".join(columns), *rows]) + "\n")


class Runs(unittest.TestCase):
    def test_each_is_a_mill_in_both_forms(self):
        assert_are_mills(self, RUNS)

    def test_are_three_mills_at_three_speeds(self):
        self.assertEqual(len(RUNS), 9)
        self.assertEqual({run.mill for run in RUNS.values()}, {"A", "B", "C"})
        self.assertEqual({run.speed for run in RUNS.values()}, set(SPEEDS))


class Numbers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="scale-up-")))
        make_run(cls.folder, "A_1.8_dry")
        make_run(cls.folder, "A_2.2_dry", 1.5 * TORQUE, 1.2 * SPEED, falling=0.02)
        cls.one = read_numbers(cls.folder / "A_1.8_dry")

    def test_are_means_of_the_last_five_turns(self):
        one = self.one
        error = DRIFT / np.sqrt(2)  # of five turns' means, -2, -1, 0, 1 and 2 times DRIFT from their mean
        self.assertEqual((one.turns, one.balls), (5, BALLS))
        self.assertAlmostEqual(one.begin, 0.8, delta=1e-5)
        for found, value, by in ((one.torques["impeller"], -TORQUE, 1), (one.torques["shell"], SHELL, 0.975),
                                 (one.power, TORQUE * 1.846 / 0.0705, 1.846 / 0.0705), (one.speed, SPEED, 1)):
            # Turns have 24 records each; the last turn ends with the last record, up to a record before the end
            self.assertAlmostEqual(found.value, value, delta=2e-3 * abs(value))
            self.assertAlmostEqual(found.error, by * error, delta=0.05 * by * error)
        self.assertAlmostEqual(one.at_rest.value, 0.975, delta=1e-6)
        self.assertAlmostEqual(one.at_rest.error, 0.025 * error / TORQUE, delta=0.05 * 0.025 * error / TORQUE)

    def test_a_drift_in_the_turns_that_are_read_is_named(self):
        self.assertEqual(self.one.drifting, ())
        self.assertEqual(read_numbers(self.folder / "A_2.2_dry").drifting, ("kinetic_J",))

    def test_a_drift_is_more_than_a_share_and_more_than_the_scatter(self):
        self.assertFalse(drifts(np.array([1.0, 1.0, 1.01, 1.01, 1.015])))
        self.assertTrue(drifts(np.array([1.0, 1.0, 1.02, 1.03, 1.03])))
        self.assertFalse(drifts(np.array([1.0, 1.1, 0.9, 1.15, 1.0])))

    def test_a_single_turn_counts_as_a_drift(self):
        self.assertTrue(drifts(np.array([1.0])))
        self.assertFalse(drifts(np.array([1.0, 1.01])))

    def test_a_run_that_is_shorter_is_not_complete(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        place = make_run(folder, "C_1.5_dry")
        write_json(place / "dumps" / "results.json", {"format": "millfoam-charge", "duration_s": 1.0})
        found, missing = read_all(folder, RUNS)
        self.assertEqual(found, {})
        self.assertIn("C_1.5_dry", missing[-1])
        self.assertIn("the run ends at 1 s; expected 3.278 s", missing[-1])
        self.assertEqual(missing[0], "A_1.8_dry: not begun")

    def test_a_run_of_another_mill_is_not_complete(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, file, kind in (("C_1.5_dry", "results.json", "charge"), ("C_1.8_dry", "run.json", "dumps")):
            path = make_run(folder, name) / "dumps" / file
            write_json(path, read_json(path, kind) | {"mill": {"charge": "0" * 16}})
        found, missing = read_all(folder, ["C_1.5_dry", "C_1.8_dry"])
        self.assertEqual(found, {})
        for words, file in zip(missing, ("results", "run")):
            self.assertRegex(words, f": its mill has changed: dumps/{file}.json has the fingerprint charge 0{{16}}, "
                             "mill.json has [0-9a-f]{16}: run millDem again$")

    def test_table_adds_up(self):
        row = study.row_of(self.one)
        by_parts = sum(row[f"power by {part}, W"] for part in ("shell", "base", "lid"))
        self.assertAlmostEqual(by_parts, 0.975 * row["power, W"])
        self.assertEqual((row["mill"], row["slurry"], row["millDem: steady"]), ("A", "dry", "no"))
        # Volume of the balls, which is that of the published slurry: 696 cm3
        self.assertAlmostEqual(row["power per volume of slurry, kW/m3"], row["power, W"] / 0.696, delta=0.05)
        lines = list(lines_of([row, row | {"run": "B_1.5_dry", "published with slurry, m/s": None}]))
        self.assertEqual(lines[0].split(), ["run", "A_1.8_dry", "B_1.5_dry"])
        self.assertEqual(lines[-2].split()[-2:], ["0.6", "–"])

    def test_whole_study_is_written(self):
        script = Path(study.__file__)
        done = subprocess.run([sys.executable, script, self.folder], capture_output=True, text=True, check=True)
        self.assertIn("not finished: B_1.8_dry: not begun", done.stdout)
        self.assertTrue((self.folder / "stirred_scale_up.png").is_file())
        self.assertEqual((self.folder / "stirred_scale_up.txt").read_text(), done.stdout)
        with open(self.folder / "runs.csv", newline="") as file:
            self.assertEqual([row["run"] for row in csv.DictReader(file)], ["A_1.8_dry", "A_2.2_dry"])


class Statements(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="scale-up-")))
        cls.one = read_numbers(make_run(cls.folder, "B_2.2_dry"))

    def found(self, **speeds):
        """Runs with these mean speeds (m/s) and powers 30 times as high, by name without `_dry`."""
        return {f"{name.replace('x', '.')}_dry": replace(
            self.one, name=f"{name.replace('x', '.')}_dry", speed=Mean(value, 0.01), power=Mean(30 * value, 0.3))
            for name, value in speeds.items()}

    def verdict(self, statement, found):
        return [one.verdict for one in scale_up_verdicts.verdicts(found)
                if one.statement.startswith(statement) and one.verdict != NOT_TESTED]

    def test_without_runs_none_is_tested(self):
        self.assertEqual({one.verdict for one in scale_up_verdicts.verdicts({})}, {NOT_TESTED})

    def test_speeds_have_an_order(self):
        words = "the mean speed of the balls is higher at 2.2 than at 1.8"
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, A_2x2=0.6)), [CONFIRMED])
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, A_2x2=0.4)), [CONTRADICTED])
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, A_2x2=0.51)), [UNDECIDED])
        moving = {name: replace(one, drifting=("power_W",)) for name, one in self.found(A_1x8=0.5, A_2x2=0.6).items()}
        self.assertEqual(self.verdict(words, moving), [UNDECIDED])

    def test_mills_have_an_order(self):
        words = "the power per volume is higher in mill A than in B"
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.6, B_1x8=0.5)), [CONFIRMED])
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, B_1x8=0.6)), [CONTRADICTED])

    def test_published_numbers(self):
        words = "the mean speed of the balls is the published one"
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.52, B_1x8=0.4)), [CONFIRMED, CONTRADICTED])
        words = "the ratio of mean speeds to"
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, A_2x2=0.6, B_1x8=0.3)), [CONFIRMED, CONTRADICTED])

    def test_dry_runs_with_other_balls(self):
        words = "the ratio of powers of B and A is that of published dry runs"
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, B_1x8=0.65)), [CONFIRMED])
        self.assertEqual(self.verdict(words, self.found(A_1x8=0.5, B_1x8=0.5)), [CONTRADICTED])

    def test_torque_must_balance(self):
        words = "the walls at rest take"
        found = self.found(A_1x8=0.5)
        self.assertEqual(self.verdict(words, found), [CONFIRMED])
        lost = {name: replace(one, at_rest=Mean(0.96, 0.001)) for name, one in found.items()}
        self.assertEqual(self.verdict(words, lost), [CONTRADICTED])
        moving = {name: replace(one, drifting=("power_W",)) for name, one in found.items()}
        self.assertEqual(self.verdict(words, moving), [UNDECIDED])

    def test_errors_of_ratios(self):
        found = ratio(Mean(2.0, 0.06), Mean(4.0, 0.16))
        self.assertAlmostEqual(found.value, 0.5)
        self.assertAlmostEqual(found.error, 0.5 * 0.05)


if __name__ == "__main__":
    unittest.main()
