#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and flow at the same time: both resume at the same time, and neither outlives the other."""
import json
import tempfile
import time
import unittest
from pathlib import Path

from millfoam.coupling.together import TogetherError, align, run_together

STEP = 1e-5  # s, of the balls
BEGIN = 1000  # their first step


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)


class Align(Case):
    def make(self, restarts, *flows):
        """Restart files at flow times, and the times of the flow on each rank."""
        (self.case / "dem").mkdir()
        order = {"format": "millfoam-fluid", "timestep_s": STEP, "exchange": {"begin": BEGIN}}
        (self.case / "dem" / "fluid.json").write_text(json.dumps(order))
        for at in (0, *restarts):
            (self.case / "dem" / f"restart.{BEGIN + round(at / STEP)}").touch()
        for number, names in enumerate(flows):
            for name in ("0", *names):
                (self.case / f"processor{number}" / name).mkdir(parents=True)

    def names(self, folder):
        return sorted(path.name for path in (self.case / folder).iterdir())

    def test_takes_the_latest_time_that_both_have(self):
        self.make([0.02, 0.04], ["0.02", "0.04", "0.06"], ["0.02", "0.04", "0.06"])
        self.assertAlmostEqual(align(self.case), 0.04)
        self.assertEqual(self.names("processor1"), ["0", "0.02", "0.04"])

    def test_removes_restart_files_that_the_flow_has_not_reached(self):
        self.make([0.02, 0.04], ["0.02", "0.04"], ["0.02"])
        self.assertAlmostEqual(align(self.case), 0.02)
        self.assertEqual(self.names("processor0"), ["0", "0.02"])
        self.assertEqual(self.names("dem"), ["fluid.json", "restart.1000", "restart.3000"])

    def test_times_may_differ_by_rounding(self):
        self.make([0.02], ["0.0200000003"])
        self.assertAlmostEqual(align(self.case), 0.02)
        self.assertEqual(self.names("processor0"), ["0", "0.0200000003"])

    def test_goes_back_where_the_balls_have_ended(self):
        self.make([0.02, 0.04], ["0.02", "0.04"])
        (self.case / "dumps").mkdir()
        (self.case / "dumps" / "run.json").touch()
        self.assertAlmostEqual(align(self.case), 0.02)
        self.assertEqual(self.names("processor0"), ["0", "0.02"])
        self.assertEqual(self.names("dem"), ["fluid.json", "restart.1000", "restart.3000"])
        self.assertEqual(self.names("dumps"), [], "millDem keeps a complete run")

    def test_begins_anew_without_a_common_time(self):
        self.make([0.02], ["0.01"])
        self.assertEqual(align(self.case), 0)
        self.assertEqual(self.names("processor0"), ["0"])
        self.assertEqual(self.names("dem"), ["fluid.json", "restart.1000"])

    def test_begins_anew_before_any_restart_file(self):
        (self.case / "0.01").mkdir()
        self.assertEqual(align(self.case), 0)
        self.assertFalse((self.case / "0.01").exists())


class Together(Case):
    def run_both(self, balls, flow):
        began = time.monotonic()
        try:
            run_together(["sh", "-c", balls], ["sh", "-c", flow], self.case)
        finally:
            self.took = time.monotonic() - began

    def test_both_end(self):
        self.run_both("echo balls; sleep 0.5", "sleep 0.1")
        self.assertEqual((self.case / "log.balls").read_text(), "balls\n")

    def test_balls_that_fail_end_the_flow_and_are_shown(self):
        with self.assertRaisesRegex(TogetherError, "^sh ended with 1; .*log.balls ends with:\na wall is missing$"):
            self.run_both("echo a wall is missing; exit 1", "exec sleep 60")
        self.assertLess(self.took, 30)

    def test_a_flow_that_fails_ends_the_balls(self):
        with self.assertRaisesRegex(TogetherError, "^sh ended with 3$"):
            self.run_both("exec sleep 60", "exit 3")
        self.assertLess(self.took, 30)

    def test_a_flow_that_fails_is_named_before_the_balls_that_notice_it(self):
        with self.assertRaisesRegex(TogetherError, "^sh ended with 3, sh ended with 1$"):
            self.run_both("sleep 0.2; echo the flow has ended; exit 1", "exit 3")


if __name__ == "__main__":
    unittest.main()
