#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of dry runs: what a call does to the folders of runs, and options that contradict each other. Nothing is
run."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

from millfoam.files.solids_file import SolidsMap
from millstudies import dry_runs
from millstudies.published_mills import run_name
from study_scripts import load

MILL = SimpleNamespace(fingerprint={"averages": "a" * 16, "charge": "c" * 16})


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))


class Dumps(Folder):
    """Dumps and restart files of a folder that is complete, or becomes so in this call."""

    def make(self, whole, **options):
        """Names of the large files that are left after a call."""
        files = ["dumps/dump.10.txt", "dem/restart.10"]
        for name in files:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).touch()
        with mock.patch.multiple(dry_runs, is_whole=lambda *_: whole, make_charge=mock.DEFAULT, run=mock.DEFAULT,
                                 read_json=mock.DEFAULT, read_map=mock.DEFAULT):
            dry_runs.make_dry_run(self.folder, MILL, **options)
        return [name for name in files if (self.folder / name).exists()]

    def test_of_a_complete_run_are_kept(self):
        self.assertEqual(len(self.make(whole=True)), 2)

    def test_go_after_they_are_averaged_unless_they_are_to_be_kept(self):
        self.assertEqual(len(self.make(whole=False, keep_dumps=True)), 2)
        self.assertEqual(self.make(whole=False), [])


class Study(Folder):
    def setUp(self):
        super().setUp()
        self.study = load("studies/dem_12cm/dem_12cm.py")
        self.matrix = load("studies/dem_matrix/dem_matrix.py")

    def refused(self, study, *words):
        """The message of a call that is refused."""
        errors = io.StringIO()
        with mock.patch.object(sys, "argv", ["study", *words]), contextlib.redirect_stderr(errors), \
                self.assertRaises(SystemExit) as end:
            study.parse()
        self.assertEqual(end.exception.code, 2)
        return errors.getvalue()

    def test_a_duration_must_be_one(self):
        for study in (self.study, self.matrix):
            for text in ("0", "-1", "nan", "long"):
                self.assertIn(f"'{text}'; expected a time above 0 s", self.refused(study, "--duration", text, "all"))

    def test_a_slice_has_a_length_and_a_run_has_ranks(self):
        for study in (self.study, self.matrix):
            for text in ("0", "-1", "nan", "inf", "thin"):
                self.assertIn(f"'{text}'; expected a length above 0 m", self.refused(study, "--slice", text, "all"))
            for text in ("0", "-2", "1.5", "nan", "two"):
                self.assertIn(f"'{text}'; expected a whole number, 1 or more",
                              self.refused(study, "--ranks", text, "all"))

    def test_a_call_without_a_slice_is_of_whole_mills(self):
        for words, found in (((), (None, 2)), (("--slice", "0.024", "--ranks", "3"), (0.024, 3))):
            with mock.patch.object(sys, "argv", ["study", *words]):
                options, _ = self.matrix.parse()
            self.assertEqual((options.slice, options.ranks), found)
        name = "12cm_load25_speed50"
        self.assertEqual((run_name(name, None), run_name(name, 0.024)), (name, f"{name}_slice24mm"))

    def test_a_quick_call_takes_no_extent(self):
        for words in (("--slice", "0.024"), ("--duration", "8")):
            self.assertIn("--quick has a duration and a slice of its own", self.refused(self.study, "--quick", *words))
        self.assertIn("expected a length above 0 m", self.refused(self.study, "--quick", "--slice", "0"))

    def result(self, name, folder, begin=1.0, end=4.0):
        maps = [SimpleNamespace(begin=begin + (end - begin) * k / 30, end=begin + (end - begin) * (k + 1) / 30)
                for k in range(30)]
        return self.study.Result(self.study.cases()[name], folder, 0.983, SimpleNamespace(name=name), maps)

    def test_errors_of_parts_below_a_turn_are_called_lower_bounds(self):
        name = "12cm_load25_speed50"
        line = self.study.warning([self.result(name, self.folder)])
        self.assertEqual(line, "±: standard error of parts of 0.38 turns or more; those of parts below a turn are "
                               "lower bounds")
        self.assertNotIn("lower bounds", self.study.warning([self.result(name, self.folder, end=9.0)]))

    def test_a_run_of_the_matrix_has_its_report_in_this_study(self):
        name = "12cm_load25_speed50"
        theirs = self.folder / "dem_matrix" / "runs" / name
        theirs.mkdir(parents=True)
        own = self.folder / "dem_12cm" / "runs" / name
        results = [self.result(name, folder) for folder in (theirs, own)]
        self.study.HERE = self.folder / "dem_12cm"
        with mock.patch.multiple(self.study, row=mock.DEFAULT, write_csv=mock.DEFAULT, print_table=mock.DEFAULT,
                                 plot=mock.DEFAULT, run=mock.DEFAULT) as made:
            with contextlib.redirect_stdout(io.StringIO()):
                for result in results:
                    self.study.report([result], SimpleNamespace(quick=False, readings=False))
        calls = [call.args for call in made["run"].call_args_list]
        self.assertEqual([call[0] for call in calls], [own, own])
        self.assertEqual([call[2] for call in calls], [theirs, own])
        self.assertTrue(all(call[3:] == ("-o", "report.html") for call in calls))
        self.assertEqual(list(theirs.iterdir()), [])


class Seeds(unittest.TestCase):
    def test_pairs_that_differ_in_the_seed_alone_show_the_difference_by_chance(self):
        study = load("studies/softening/softening.py")
        edges = np.linspace(-1, 1, 5)
        maps = [SolidsMap(edges, edges, np.ones((4, 4)), np.full((4, 4), solidity), np.ones((4, 4, 3)), 0, 1)
                for solidity in (0.5, 0.56, 0.52, 0.51, 0.5)]
        runs = [SimpleNamespace(charge=one) for one in maps]
        rows = list(study.chance_rows(runs, list(study.settings(quick=False))))
        self.assertEqual([row["run"] for row in rows], ["1e7, two seeds", "1e8, two seeds"])
        np.testing.assert_allclose([row["solidity_difference"] for row in rows], [0.06 / 0.634, 0.01 / 0.634])
        with tempfile.TemporaryDirectory() as folder:
            study.write_table([], rows, Path(folder) / "softening.txt")
            self.assertIn("1e8, two seeds", (Path(folder) / "softening.txt").read_text())
            self.assertIn("1e7, two seeds", (Path(folder) / "softening.csv").read_text())


if __name__ == "__main__":
    unittest.main()
