#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What verification cases call a miss, on made-up results. Nothing is run."""
import contextlib
import io
import sys
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np

from study_scripts import load


class RotatingDrum(unittest.TestCase):
    def setUp(self):
        self.case = load("verification/rotating_drum/compare.py", "rotating_drum")

    def missed(self, rms, angle=27.0, zero=0.059):
        value = np.array([angle, 0.03, zero, rms, 0.4, 0.95])
        return self.case.Found("run", (), value, 0 * value, 0.012, None, None, 0.12, -1.2).missed

    def test_the_velocity_is_judged_beyond_what_no_charge_can_meet(self):
        # 0.0156 is the root of 0.012 squared plus 0.01 squared
        for rms, missed in ((0.012, []), (0.0156, []), (0.0157, ["velocity"]), (np.nan, ["velocity"])):
            self.assertEqual(self.missed(rms), missed)
        self.assertEqual(self.missed(0.012, angle=29.0, zero=np.nan), ["angle", "zero"])

    def test_the_best_charge_that_the_drum_drags_has_the_least_rms(self):
        depth, omega = np.linspace(0.061, 0.12, 40), -1.2
        drum = omega * depth
        measured = depth, np.where(depth > 0.09, 1.2, 0.8) * drum
        least = self.case.least_rms(measured, omega)
        best = np.maximum(measured[1], drum)
        self.assertAlmostEqual(np.sqrt(np.mean((best - measured[1])**2)), least)
        for slower in (0.9, 0.7):
            # A charge that is slower: its excess is at least its difference from the best one
            rms = np.sqrt(np.mean((slower * best - measured[1])**2))
            found = self.case.Found("run", (), np.array([27, 0.03, 0.059, rms]), 0, least, None, None, 0.12, omega)
            self.assertGreaterEqual(found.excess, np.sqrt(np.mean((slower * best - best)**2)))

    def test_options_that_replace_each_others_runs_are_refused(self):
        for words in (("scan", "--quick"), ("full", "--read", "a"), ("--quick", "--read", "a")):
            errors = io.StringIO()
            with mock.patch.object(sys, "argv", ["compare.py", *words]), contextlib.redirect_stderr(errors), \
                    mock.patch.object(self.case, "run_jobs", side_effect=AssertionError), \
                    self.assertRaises(SystemExit) as end:
                self.case.main()
            self.assertEqual(end.exception.code, 2)
            self.assertIn("expected only one of the three", errors.getvalue())


class ResidenceTime(unittest.TestCase):
    def missed(self, mean=1.0, spread=1.0, missing=0.0, lowest=0.0, highest=1.0):
        case = load("verification/residence_time/compare.py", "residence_time")
        vessel = case.Vessel("tank", 1, 0.0, 0.1, 0.0, "upwind", 8.0, 1.0, 1e-2)
        return case.Run(vessel, SimpleNamespace(missing=missing, lowest=lowest, highest=highest),
                        SimpleNamespace(mean=mean * vessel.mean, spread=spread)).missed

    def test_what_is_not_a_number_misses_its_limit(self):
        self.assertEqual(self.missed(), [])
        self.assertEqual(self.missed(mean=1.02, spread=1.1, missing=1e-9, highest=1.01),
                         ["mean", "spread", "conserved", "bounded"])
        self.assertEqual(self.missed(mean=np.nan), ["mean"])
        self.assertEqual(self.missed(spread=np.nan), ["spread"])
        self.assertEqual(self.missed(missing=np.nan, lowest=np.nan), ["conserved", "bounded"])


class Displacement(unittest.TestCase):
    def setUp(self):
        self.case = load("verification/displacement/compare.py", "displacement")

    def result(self, name, pressure=0.0):
        """An exact result of a box, with an error of the pressure over the largest one."""
        case, kind = self.case, self.case.RUNS[name][0]
        times = np.array([0.02, case.END])
        levels = np.array([case.expected_level(kind, time) for time in times])
        share = np.clip(levels[:, None] / case.LAYER - np.arange(case.LAYERS), 0, 1)[..., None].repeat(case.COLUMNS, 2)
        exact = case.bottom_pressure(times)
        return case.Displacement(name, kind, times, share, 0.0, times, exact + pressure * exact.max())

    def test_an_exact_result_holds_and_one_that_is_not_a_number_does_not(self):
        self.assertFalse(self.result("open").misses())
        self.assertTrue(self.result("open", pressure=0.03).misses())
        self.assertTrue(self.result("open", pressure=np.nan).misses())
        one = self.result("open")
        one.share[-1, 3, 0] = np.nan
        self.assertTrue(one.misses())

    def test_of_the_closed_box_no_pressure_is_judged(self):
        self.assertFalse(self.result("closed").misses())
        self.assertFalse(self.result("closed", pressure=np.nan).misses())


if __name__ == "__main__":
    unittest.main()
