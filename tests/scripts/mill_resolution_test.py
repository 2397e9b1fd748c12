#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study mill_resolution on made-up flows: families that cannot be judged, and the error to cite."""
import unittest
from types import SimpleNamespace

import numpy as np

from millfoam.readings.means import Mean
from study_scripts import load


class Judged(unittest.TestCase):
    def setUp(self):
        self.study = load("studies/mill_resolution/mill_resolution.py")
        self.families = [self.study.Family("steps", {1.0: "Beetstra", 0.5: "steps_0.5"}, 1.0, ""),
                         self.study.Family("window", {0.05: "Beetstra", 0.1: "window_0.1"}, 0.05, "s")]

    def lines(self, **changes):
        """Lines of families that are not judged, and the rows to cite, of runs that are steady and differ by 1; a run
        is changed to another drift or value, or fails (None)."""
        readings = {}
        for k, name in enumerate(("Beetstra", "steps_0.5", "window_0.1")):
            change = changes.get(name.replace(".", "_"), {})
            if change is not None:
                readings[name] = SimpleNamespace(
                    drift=change.get("drift", ""),
                    mean=lambda number, k=k, change=change: Mean(change.get(number, 10.0 + (k > 0)), 0.1, 5))
        found = self.study.judgements(self.families, readings)
        lines = [line for line in self.study.judgement_lines(self.families, found, readings) if "NOT" in line]
        return lines, list(self.study.cited_rows(self.families, found, readings))

    def test_a_total_has_all_bars_and_the_error_over_time(self):
        lines, rows = self.lines()
        self.assertEqual(lines, [])
        self.assertAlmostEqual(rows[0]["total"], np.sqrt(rows[0]["steps"]**2 + rows[0]["window"]**2 + 0.01))

    def test_a_failed_run_is_named_and_the_total_is_not_known(self):
        lines, rows = self.lines(steps_0_5=None)
        self.assertEqual(lines, ["NOT JUDGED: steps: a run failed: steps_0.5"])
        self.assertGreater(rows[0]["window"], 0)
        self.assertTrue(np.isnan(rows[0]["total"]))
        self.assertEqual(list(self.study.cited_lines(rows))[1].split()[3::2], ["–", "0.10"])

    def test_a_base_that_drifts_is_not_a_failed_run(self):
        lines, rows = self.lines(Beetstra={"drift": "x drifts"})
        self.assertEqual(lines, [f"NOT JUDGED: {name}: the base is not steady" for name in ("steps", "window")])
        self.assertTrue(np.isnan(rows[0]["total"]))

    def test_a_family_of_which_the_base_alone_is_steady_and_one_without_a_number(self):
        lines, rows = self.lines(steps_0_5={"drift": "x drifts"}, window_0_1={"cell air": np.nan, "toe": np.nan})
        self.assertEqual(lines, ["NOT JUDGED: steps: only the base is steady",
                                 "NOT JUDGED: window: a run has no toe, no cell air"])


if __name__ == "__main__":
    unittest.main()
