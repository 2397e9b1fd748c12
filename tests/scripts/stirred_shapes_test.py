#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study stirred_shapes: its runs are mills that can be made, and its verdicts on made-up runs."""
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

from millfoam.readings.means import Mean
from millstudies.compared_runs import CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED
from millstudies.mill_runs import resolved
from millstudies.stirred_settings import FILE
from stirred_studies import assert_are_mills

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "studies" / "stirred_shapes"))

import shape_verdicts  # noqa: E402, in the study's folder
from runs import RUNS  # noqa: E402

BAND = {"below": 0.7, "impeller": 0.4}


class Runs(unittest.TestCase):
    def test_each_is_a_mill_in_both_forms(self):
        assert_are_mills(self, RUNS)

    def test_a_mill_has_as_many_balls_of_each_shape(self):
        for mill, balls in (("A", 10640), ("B", 18511), ("C", 29694)):
            for shape in ("spheres", "group_3"):
                with self.subTest(mill=mill, shape=shape):
                    found = resolved(FILE, RUNS[f"{mill}_{shape}"].settings(False))
                    self.assertEqual(found.derived("charge", "balls"), balls)

    def test_groups_have_the_published_sphericity(self):
        for group, published in (("group_1", 0.996), ("group_2", 0.975), ("group_3", 0.922)):
            with self.subTest(group=group):
                mill = resolved(FILE, RUNS[f"A_{group}"].settings(False))
                self.assertAlmostEqual(mill.derived("charge", "sphericity"), published, delta=6e-4)
                # Every shape has the volume of a sphere of 5 mm, and is as frequent as the others
                self.assertAlmostEqual(mill.derived("charge", "sauter_diameter_m"), 0.005, delta=1e-6)

    def test_five_whole_turns_are_read(self):
        for run in RUNS.values():
            mill = resolved(FILE, run.settings(False))
            averaged = mill.asked("dem", "duration") - mill.asked("averages", "start")
            turns = averaged / mill.derived("speed", "turn_s")
            self.assertTrue(5 <= turns < 5.06, f"{run.name}: {turns} turns")


def made_up(name, speed, power, drifting=(), at_rest=1.0):
    """A run with these numbers."""
    return SimpleNamespace(name=name, speed=Mean(speed, 0.005), power=Mean(power, 0.2), drifting=drifting,
                           at_rest=Mean(at_rest, 0.001))


class Statements(unittest.TestCase):
    def verdicts(self, words, *runs, solidity=None):
        """Verdicts on made-up runs, of statements that begin with these words and are tested."""
        found = {run.name: run for run in runs}
        bands = solidity or {name: BAND for name in found}
        return [one.verdict for one in shape_verdicts.verdicts(found, bands)
                if one.statement.startswith(words) and one.verdict != NOT_TESTED]

    def test_without_runs_none_is_tested(self):
        self.assertEqual({one.verdict for one in shape_verdicts.verdicts({}, {})}, {NOT_TESTED})

    def test_ratio_of_powers(self):
        # Published: 673 W over 498 W, 1.35
        words = "the ratio of powers of groups 3 and 1"
        for power, verdict in ((13.5, CONFIRMED), (11.6, CONFIRMED), (11.4, CONTRADICTED), (15.6, CONTRADICTED)):
            with self.subTest(power=power):
                self.assertEqual(self.verdicts(words, made_up("A_group_1", 0.6, 10), made_up("A_group_3", 0.5, power)),
                                 [verdict])

    def test_a_run_that_drifts_is_undecided(self):
        self.assertEqual(self.verdicts("the ratio of powers of groups 3 and 1", made_up("A_group_1", 0.6, 10),
                                       made_up("A_group_3", 0.5, 13.5, drifting=("power_W",))), [UNDECIDED])

    def test_mean_speeds(self):
        words = "the mean speed of the balls is the published one"
        self.assertEqual(self.verdicts(words, made_up("A_group_1", 0.65, 10), made_up("A_group_3", 0.4, 10)),
                         [CONFIRMED, CONTRADICTED])

    def test_order_of_the_shapes(self):
        runs = made_up("A_spheres", 0.5, 10), made_up("A_group_1", 0.6, 12), made_up("A_group_3", 0.45, 11)
        self.assertEqual(self.verdicts("the power is higher", *runs), [CONFIRMED, CONTRADICTED])
        self.assertEqual(self.verdicts("the mean speed of the balls is higher", *runs), [CONFIRMED, CONFIRMED])

    def test_solidity(self):
        run = made_up("A_group_3", 0.5, 10)
        self.assertEqual(self.verdicts("the solidity", run), [CONFIRMED, CONFIRMED])
        self.assertEqual(self.verdicts("the solidity", run, solidity={run.name: {"below": 0.5, "impeller": 0.7}}),
                         [CONTRADICTED, CONTRADICTED])

    def test_torque_must_balance(self):
        words = "the walls at rest take"
        self.assertEqual(self.verdicts(words, made_up("A_group_2", 0.5, 10)), [CONFIRMED])
        self.assertEqual(self.verdicts(words, made_up("A_group_2", 0.5, 10, at_rest=0.96)), [CONTRADICTED])

    def test_power_over_that_of_spheres(self):
        one, spheres = made_up("B_group_3", 0.5, 12), made_up("B_spheres", 0.4, 10)
        self.assertAlmostEqual(shape_verdicts.over_spheres("power", one, {"B_spheres": spheres}).value, 1.2)
        self.assertIsNone(shape_verdicts.over_spheres("power", one, {"A_spheres": spheres}))


if __name__ == "__main__":
    unittest.main()
