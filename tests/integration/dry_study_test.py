#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What studies of dry runs are made of: on a drum of a few balls, and on made-up data whose answers are known."""
import importlib.util
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

from dem_run_test import MILL
from millfoam.files.mill import read_mill
from millfoam.files.solids_file import SolidsMap
from millfoam.readings.compare import difference
from millfoam.run import RunError, run
from millstudies.dry_runs import is_whole, make_dry_run
from millstudies.mill_runs import resolved, write_mill
from millstudies.published_mills import averages, published_loads

ROOT = Path(__file__).resolve().parents[2]


def load(path):
    """A study's script as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # where dataclasses look their module up
    spec.loader.exec_module(module)
    return module


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="dry-study-"))
        self.addCleanup(shutil.rmtree, self.folder)


class Runs(FolderTest):
    def drum(self, duration, *changes):
        """The drum's Mill, averaged over its second part."""
        (self.folder / "drum.yaml").write_text(MILL)
        return resolved(self.folder / "drum.yaml",
                        (f"dem.duration={duration}", averages(6, duration / 2, duration / 2), *changes))

    def test_a_run_is_made_once_and_its_dumps_go(self):
        mill = self.drum(0.2)
        first = make_dry_run(self.folder / "drum", mill, ranks=1)
        self.assertEqual(first.number("lost_balls"), 0)
        self.assertLess(first.charge.centroid()[1], -0.002)
        self.assertEqual(list((self.folder / "drum" / "dumps").glob("dump.*")), [])
        log = self.folder / "drum" / "log.millDem"
        log.unlink()
        again = make_dry_run(self.folder / "drum", mill, ranks=1)
        self.assertEqual(again.results, first.results)
        self.assertFalse(log.exists())

    def test_a_run_of_another_mill_or_with_other_averages_is_not_replaced(self):
        make_dry_run(self.folder / "drum", self.drum(0.1), ranks=1)
        solids = (self.folder / "drum" / "solids.h5").read_bytes()
        for change in ("dem.seed=4", "averages.window=0.02", "dem.duration=0.11"):
            with self.subTest(change), self.assertRaisesRegex(RunError, "of another mill or with other averages"):
                make_dry_run(self.folder / "drum", self.drum(0.1, change), ranks=1)
        self.assertEqual((self.folder / "drum" / "solids.h5").read_bytes(), solids)

    def test_a_run_that_was_broken_off_is_resumed_with_another_duration_but_not_as_another_mill(self):
        made = []
        write_mill(self.drum(0.1), self.folder / "drum")
        with mock.patch("millstudies.mill_runs.run", lambda folder, *command: made.append(command)), \
                mock.patch("millstudies.dry_runs.run", side_effect=RunError("stopped")):
            with self.assertRaisesRegex(RunError, "of another mill"):
                make_dry_run(self.folder / "drum", self.drum(0.1, "dem.seed=4"), ranks=1)
            self.assertEqual(made, [])
            with self.assertRaisesRegex(RunError, "stopped"):
                make_dry_run(self.folder / "drum", self.drum(0.2), ranks=1)
        self.assertEqual([command[0] for command in made], ["millMesh", "millDem"])
        self.assertIn("--resume", made[1])
        self.assertEqual(read_mill(self.folder / "drum").asked("dem", "duration"), 0.2)

    def test_a_key_that_is_not_there_is_refused_by_its_name(self):
        with self.assertRaisesRegex(RunError, "key 'dem.sed' is unknown"):
            self.drum(0.1, "dem.sed=4")


class Matrix(FolderTest):
    def setUp(self):
        super().setUp()
        self.study = load(ROOT / "cases" / "studies" / "dem_matrix" / "dem_matrix.py")

    def test_it_is_the_published_one(self):
        names = list(self.study.matrix())
        self.assertEqual(len(names), 34)
        self.assertEqual(len(set(names)), 34)
        self.assertAlmostEqual(sum(mass for _, mass in published_loads()["37.5"]), 0.824, delta=0.002)

    def test_every_mill_of_it_is_accepted(self):
        for name, setting in self.study.matrix().items():
            slice_length = 0.024 if setting.mill == "12cm" and setting.speed == 40 else 0
            with self.subTest(name):
                mill = self.study.mill(setting, 4.0, slice_length)
                self.assertAlmostEqual(mill.critical_share, setting.speed / 100)
                self.assertEqual(mill.asked("dem", "duration"), 4)
                whole = {"12cm": 0.12, "30cm": 0.305}[setting.mill]
                self.assertEqual((mill.length, mill.is_slice), (slice_length or whole, bool(slice_length)))
                total = {"12.5": 0.275, "25": 0.549, "37.5": 0.824, "50": 1.098, "31.25": 9.662}[setting.load]
                asked = sum(one["mass_asked_kg"] for one in mill.content["derived"]["charge"]["classes"])
                self.assertAlmostEqual(asked * whole / mill.length, total, delta=0.002)
                self.assertEqual(mill.content["derived"]["averages"]["shape"], [65, 65, 1])
                self.assertEqual([mill.asked("averages", key) for key in ("start", "window")], [1, 0.1])
                write_mill(mill, self.folder)
                run(self.folder, "millMesh", "mill.json", "--case", ".", "--walls")
                run(self.folder, "millDem", "mill.json", "--case", ".", "--deck-only")


class Readings12cm(FolderTest):
    """The study dem_12cm."""

    def setUp(self):
        super().setUp()
        self.study = load(ROOT / "cases" / "studies" / "dem_12cm" / "dem_12cm.py")
        self.cases = self.study.cases()

    def options(self, **changes):
        return SimpleNamespace(**{"quick": False, "duration": None, "slice": 0.0, **changes})

    def test_published_numbers_are_those_of_runs_of_the_matrix(self):
        published = self.study.published()
        self.assertEqual(len(published), 12)
        self.assertLessEqual({setting.name for setting in published}, set(self.study.published_mills.matrix()))
        self.assertEqual(published[self.cases["12cm_load37.5_speed50_stiff"].setting], (0.0293, 8.69))

    def test_every_variant_changes_the_mill_and_is_accepted(self):
        base = self.cases["12cm_load37.5_speed50"]
        decks = set()
        for name in ("", *self.study.VARIANTS):
            with self.subTest(name):
                mill = self.cases[base.name + (f"_{name}" if name else "")].mill(*self.study.QUICK)
                write_mill(mill, self.folder)
                shutil.rmtree(self.folder / "walls", ignore_errors=True)
                run(self.folder, "millMesh", "mill.json", "--case", ".", "--walls")
                run(self.folder, "millDem", "mill.json", "--case", ".", "--deck-only")
                walls = (self.folder / "walls" / "lifters.stl").read_bytes()
                decks.add((self.folder / "dem" / "in.mill").read_bytes() + walls)
        self.assertEqual(len(decks), 1 + len(self.study.VARIANTS))

    def test_a_whole_run_of_the_matrix_is_taken_as_it_is(self):
        case = self.cases["12cm_load25_speed50"]
        self.study.HERE = self.folder / "dem_12cm"
        own, mill = self.study.asked(case, self.options())
        self.assertEqual(own, self.folder / "dem_12cm" / "runs" / case.name)
        matrix = load(ROOT / "cases" / "studies" / "dem_matrix" / "dem_matrix.py")
        made = []
        matrix.HERE = self.folder / "dem_matrix"
        matrix.make_dry_run = lambda folder, mill, **_: made.append((folder, mill))
        matrix.make(matrix.matrix()[case.name], SimpleNamespace(duration=None, slice=0.0, ranks=2, keep_dumps=False))
        folder, theirs = made[0]
        self.assertEqual(theirs.fingerprint, mill.fingerprint)
        folder.mkdir(parents=True)
        summary = {"format": "millfoam-averages", "mill": {"averages": theirs.fingerprint["averages"]}}
        (folder / "solids.json").write_text(json.dumps(summary))
        self.assertTrue(is_whole(folder, mill))
        self.assertEqual(self.study.asked(case, self.options())[0], folder)
        self.assertEqual(self.study.asked(case, self.options(duration=2.0))[0], own)
        self.assertNotEqual(self.study.asked(case, self.options(slice=0.024))[0], folder)

    def test_patterns_choose_and_all_are_those_without_a_variant(self):
        parser = SimpleNamespace(error=mock.Mock(side_effect=KeyError))
        self.assertEqual(len(self.study.chosen(["all"], self.cases, parser, lambda case: not case.variant)), 12)
        self.assertEqual(len(self.study.chosen(["all"], self.cases, parser)), len(self.cases))
        self.assertEqual(len(self.study.chosen(["12cm_load25_speed50*"], self.cases, parser)),
                         1 + len(self.study.VARIANTS))
        with self.assertRaises(KeyError):
            self.study.chosen(["nothing"], self.cases, parser)
        self.assertIn("no run is named 'nothing'", parser.error.call_args.args[0])


class Softening(FolderTest):
    def test_its_mills_differ_in_modulus_and_seed_and_are_accepted(self):
        study = load(ROOT / "cases" / "studies" / "softening" / "softening.py")
        made = []
        study.make_dry_run = lambda folder, mill: made.append((folder.name, mill))
        for setting in study.settings(quick=False):
            study.make(*setting, quick=False)
        self.assertEqual([name for name, _ in made], ["1e7", "1e7_other_seed", "1e8", "1e8_other_seed", "1e9"])
        for name, mill in made:
            self.assertEqual(mill.asked("dem", "seed"), 20122 if name.endswith("other_seed") else 20121)
            write_mill(mill, self.folder)
            run(self.folder, "millMesh", "mill.json", "--case", ".", "--walls")
            deck = run(self.folder, "millDem", "mill.json", "--case", ".", "--deck-only")
            self.assertIn(f"softened modulus of balls and walls: {float(name.split('_')[0]):.4g} Pa", deck)


class Difference(unittest.TestCase):
    def map(self, solidity, velocity):
        edges = np.linspace(-1, 1, 5)
        shape = (4, 4)
        return SolidsMap(edges, edges, np.ones(shape), np.full(shape, solidity),
                         np.broadcast_to(velocity, (*shape, 3)).copy(), 0, 1)

    def test_a_map_is_not_apart_from_itself(self):
        one = self.map(0.5, (1.0, 0.5, 0))
        self.assertEqual(difference(one, one).solidity, 0)
        self.assertEqual(difference(one, one).velocity_x, 0)

    def test_differences_are_normed(self):
        found = difference(self.map(0.5, (1.0, 0, 0)), self.map(0.5634, (0.5, 0.5, 0)))
        norm = (1 + np.hypot(0.5, 0.5)) / 2
        self.assertAlmostEqual(found.solidity, 0.1)
        self.assertAlmostEqual(found.velocity_x, 0.5 / norm)
        self.assertAlmostEqual(found.velocity_y, 0.5 / norm)

    def test_other_voxels_are_refused(self):
        other = self.map(0.5, (0, 0, 0))
        other.x = 2 * other.x
        with self.assertRaisesRegex(ValueError, "same voxels"):
            difference(self.map(0.5, (0, 0, 0)), other)


if __name__ == "__main__":
    unittest.main(verbosity=2)
