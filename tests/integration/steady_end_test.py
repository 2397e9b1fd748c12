#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow that ends by itself: slurry in a slice without balls, in the stages of a mill's Allrun."""
import tempfile
import unittest
from pathlib import Path

from millfoam.files.data_files import read_json
from millfoam.files.mill_case import MillCase
from mill_case import run_mill

MILL = Path(__file__).resolve().parents[2] / "cases" / "mills" / "mill_12cm" / "mill.yaml"
CHANGES = ("flow.balls=no", "flow.turns=30", "flow.steady={turns: 4}", "flow.start={volume: 3e-4}",
           "resolution={cell_size: 0.01, layers: 5}")


class SteadyEnd(unittest.TestCase):
    def test_it_ends_when_its_last_turns_are_steady_and_is_kept(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="steady-")))
        run_mill(folder, MILL, *CHANGES, until="flow")
        found = read_json(folder / "steady.json", "steady")
        case = MillCase(folder)
        self.assertEqual(found["reason"], "steady")
        self.assertLess(found["end_s"], 30 * case.turn)
        self.assertAlmostEqual((found["end_s"] - found["begin_s"]) / case.turn, 4, delta=1e-6)
        self.assertGreater(found["begin_s"] / case.turn, 2 - 1e-6)
        self.assertAlmostEqual(case.last, found["end_s"], delta=1e-6)
        self.assertEqual(case.begin, found["begin_s"])
        self.assertFalse(case.is_cut_short)
        self.assertIn("Keeping flow: it is up to date", run_mill(folder, MILL, *CHANGES, until="flow"))


if __name__ == "__main__":
    unittest.main()
