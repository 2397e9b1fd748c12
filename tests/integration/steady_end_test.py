#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow that ends by itself: slurry in a slice without balls, in the stages of a mill's Allrun."""
import shutil
import tempfile
import unittest
from pathlib import Path

from millfoam.files.data_files import read_json
from millfoam.files.mill_case import MillCase
from millfoam.run import RunError
from mill_case import replace, run_mill

MILL = Path(__file__).resolve().parents[2] / "cases" / "mills" / "mill_12cm" / "mill.yaml"
# Without lifters, over which slurry splashes: four turns would not show whether it is steady
CHANGES = ("geometry.lifters={count: 0}", "flow.balls=no", "flow.turns=30", "flow.steady={turns: 4}",
           "flow.start={volume: 3e-4}", "resolution={cell_size: 0.01, layers: 5}")


class SteadyEnd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.start = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="steady-"))) / "start"
        run_mill(cls.start, MILL, *CHANGES, until="start")

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="steady-"))) / "case"
        shutil.copytree(self.start, self.folder, symlinks=True)

    def test_a_solver_that_fails_ends_the_run(self):
        replace(self.folder / "system" / "fvSolution", (r"momentumPredictor +\w+;", "momentumPredictor perhaps;"))
        with self.assertRaises(RunError):
            run_mill(self.folder, MILL, *CHANGES, until="flow")
        self.assertIn("step 'flow' failed", (self.folder / "log.bash").read_text())
        self.assertFalse((self.folder / "steady.json").exists())

    def test_a_dictionary_with_an_end_of_its_own_is_refused(self):
        replace(self.folder / "system" / "controlDict", (r"^endTime .*", "endTime 7;"))
        with self.assertRaisesRegex(RunError, "system/controlDict: endTime is 7; expected"):
            run_mill(self.folder, MILL, *CHANGES, until="flow")

    def test_it_ends_when_its_last_turns_are_steady_and_is_kept(self):
        folder = self.folder
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
        self.interrupt(found["end_s"] - case.turn / 2)
        run_mill(folder, MILL, *CHANGES, until="flow")
        again = read_json(folder / "steady.json", "steady")
        for key in ("reason", "begin_s", "end_s", "mill"):
            self.assertEqual(again[key], found[key])

    def interrupt(self, time):
        """Leaves a flow as if it had been killed after a time (s)."""
        (self.folder / "steady.json").unlink()
        for table in self.folder.glob("postProcessing/slurryBalance/*/*.dat"):
            lines = table.read_text().splitlines(keepends=True)
            table.write_text("".join(line for line in lines if line.startswith("#") or float(line.split()[0]) < time))
        for written in (*self.folder.glob("processor*/[0-9]*"), *self.folder.glob("[0-9]*")):
            if float(written.name.replace("0.orig", "0")) > time:
                shutil.rmtree(written)


if __name__ == "__main__":
    unittest.main()
