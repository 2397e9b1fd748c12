#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study mill_30cm_published: its runs are mills that can be made, and what it reads of a slurry whose answers are
known."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

from millfoam.files.slurry_file import VoxelMap
from millfoam.files.solids_file import mean_map
from millfoam.readings.axial import gaussians
from millfoam.readings.means import Mean
from millfoam.run import set_options
from millstudies.axial_slices import Slices, jackknife, pressure_drop, read_profile, read_slices
from millstudies.compared_runs import CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED, by_sign
from millstudies.run_readings import ReynoldsNumbers, RunReadings, Surface
from millstudies.statements import larger_drop
from charge_test import RADIUS, below, cell, charge_map
from slurry_on_maps_test import slurry_map

ROOT = Path(__file__).resolve().parents[2]
STUDY = ROOT / "cases" / "studies" / "mill_30cm_published"
sys.path.insert(0, str(STUDY))

import as_published  # noqa: E402, in the study's folder
import flow_numbers  # noqa: E402, in the study's folder
import mill_30cm_published as study  # noqa: E402
import own_statements  # noqa: E402
from runs import RUNS, UNKNOWNS, is_published  # noqa: E402

TURN, WINDOW, TIME0, BEGIN, LAST = 1.0, 0.05, 0.4, 1.9, 5.0
LOWER, UPPER, SHAPE = np.array([-0.15, -0.15, 0.0]), np.array([0.15, 0.15, 0.338]), (33, 33, 33)
LENGTH = 0.305
PEAKS, HIGH, WIDE, BASE = (0.09, 0.21), (0.02, 0.015), (0.03, 0.03), -0.09
FALL = 300.0  # of the pressure along the axis, Pa/m
JUMP = 200.0  # of the pressure in the first slice, in the one that is partly behind the grates, and in those behind, Pa


class Runs(unittest.TestCase):
    def test_each_is_a_mill_in_both_forms(self):
        for run in RUNS.values():
            for quick in (False, True):
                with self.subTest(run=run.name, quick=quick):
                    done = subprocess.run(["millMesh", ROOT / "cases/mills/mill_30cm/mill.yaml",
                                           *set_options(run.settings(quick)), "--resolved", "-"], capture_output=True,
                                          text=True)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_an_unknown_says_whether_balls_see_it_and_what_it_changes(self):
        for name, expected in (("wide_lifters", "yes\ngeometry.lifters.width=0.020\n"),
                               ("layers_17", "no\nresolution.layers=17\n")):
            done = subprocess.run([sys.executable, STUDY / "runs.py", "--unknown", name], capture_output=True,
                                  text=True)
            self.assertEqual((done.returncode, done.stdout), (0, expected), done.stderr)

    def test_steady_holdup_changes_what_is_unknown_here(self):
        allrun = (STUDY.parent / "steady_holdup" / "Allrun").read_text()
        names = re.search(r"for change in (.*); do", allrun)[1].split()
        self.assertLessEqual(set(names), set(UNKNOWNS))

    def test_charges_come_from_dry_runs_of_the_same_speed(self):
        for run in RUNS.values():
            self.assertEqual(run.dry is None, run.way in ("dry", "alone"))
            if run.dry:
                self.assertEqual((RUNS[run.dry].way, RUNS[run.dry].speed), ("dry", run.speed))

    def test_published_are_six_without_balls_and_nine_with(self):
        flows = [run for run in RUNS.values() if is_published(run) and run.way != "dry"]
        self.assertEqual(sum(run.law is None for run in flows), 6)
        self.assertEqual(sum(run.law is not None for run in flows), 9)
        for name in ("direct_75_20", "iterated_75_20"):
            self.assertEqual(RUNS[name].way, "copies")

    def test_the_last_of_all_passes_has_the_results(self):
        run, root = RUNS["iterated_75_20"], Path(self.enterContext(tempfile.TemporaryDirectory()))
        folder = root / run.name
        with self.assertRaisesRegex(flow_numbers.NotFinished, "not begun"):
            flow_numbers.folders_of(root, run)
        folder.mkdir()
        with self.assertRaisesRegex(flow_numbers.NotFinished, "no pass of balls that feel the slurry is complete"):
            flow_numbers.folders_of(root, run)
        coupling = {"format": "millfoam-coupling", "passes": 2, "most_passes": 3, "settled": False,
                    "folders": [".", "pass_2"]}
        (folder / "coupling.json").write_text(json.dumps(coupling))
        with self.assertRaisesRegex(flow_numbers.NotFinished, "pass 2 of at most 3 changed the results"):
            flow_numbers.folders_of(root, run)
        for end in ({"settled": True}, {"most_passes": 2}):
            (folder / "coupling.json").write_text(json.dumps(coupling | end))
            self.assertEqual(flow_numbers.folders_of(root, run), [folder, folder / "pass_2"])
        self.assertEqual(flow_numbers.folders_of(root, RUNS["direct_75_20"]), [root / "direct_75_20" / "direct"])
        self.assertEqual(flow_numbers.folders_of(root, RUNS["seed"]), [root / "seed"])


def heights(turn):
    """Mean heights of the slurry (m) at the slices' middles in a turn: the second hump moves by 4 mm a turn."""
    z = (np.arange(SHAPE[0]) + 0.5) * UPPER[2] / SHAPE[0]
    return z, gaussians(z, BASE, HIGH[0], PEAKS[0], WIDE[0], HIGH[1], PEAKS[1] + 0.004 * (turn - 1), WIDE[1])


def write_slurry(path):
    """slurry.h5 of three turns: a column of voxels in the middle of the mill, with as much slurry in the rows above and
    below as gives the slices' heights; a pressure that falls along the axis and with the height."""
    begins = TIME0 + np.arange(BEGIN + 0.1, LAST - 1e-9, WINDOW)
    step = (UPPER[1] - LOWER[1]) / SHAPE[1]
    y = LOWER[1] + (np.arange(SHAPE[1]) + 0.5) * step
    shape = (len(begins), *SHAPE)
    slurry, pressure = np.zeros(shape), np.zeros(shape)
    for window, begin in enumerate(begins):
        z, height = heights(int((begin - TIME0 - BEGIN - 0.1 + 1e-9) / TURN))
        row = np.searchsorted(y, height) - 1
        above = (height - y[row]) / step
        slurry[window, np.arange(SHAPE[0]), row, 16] = 1 - above
        slurry[window, np.arange(SHAPE[0]), row + 1, 16] = above
        slurry[window, :, np.argmin(np.abs(y + 0.03)), 16] += 1e-9
        jump = np.where((z < 0.01) | (z > LENGTH - 0.01), JUMP, 0.0)
        pressure[window] = 1000 - FALL * z[:, None, None] + jump[:, None, None] - 9810 * y[None, :, None]
    with h5py.File(path, "w") as file:
        grid = file.create_group("grid")
        grid.attrs.update(lower=LOWER, upper=UPPER, shape=SHAPE)
        grid["insideFraction"] = np.ones(shape)
        file["window/begin"], file["window/end"] = begins, begins + WINDOW
        file["slurry"], file["voidage"] = slurry, np.where(slurry > 0, slurry, 1.0)
        file["pressure"], file["p_rgh"] = pressure, pressure + 9810 * y[None, None, :, None]


def case_of(path):
    """What read_slices reads of a MillCase."""
    return SimpleNamespace(slurry=path, flow=SimpleNamespace(time0=TIME0), turn=TURN, begin=BEGIN + 0.1, last=LAST,
                           folder=path.parent, unusable=[])


class Axis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.path = folder / "slurry.h5"
        write_slurry(cls.path)
        cls.slices = read_slices(case_of(cls.path))

    def test_heights_are_those_of_the_turns(self):
        self.assertEqual(self.slices.height.shape, (3, 33))
        for turn in range(3):
            np.testing.assert_allclose(self.slices.height[turn], heights(turn)[1], atol=1e-8)
        np.testing.assert_allclose(self.slices.holdup, np.prod((UPPER - LOWER) / SHAPE), rtol=1e-8)

    def test_profile_leaves_out_three_slices_and_one(self):
        self.assertEqual(len(read_profile(self.slices, 2).z), 29)
        inside = read_profile(self.slices, 2, LENGTH).z
        self.assertEqual(len(inside), 25)  # 29 of the 33 slices end in front of the grates
        np.testing.assert_allclose(inside[0], 3.5 * 0.338 / 33)

    def test_distance_has_the_error_of_the_turns(self):
        found = read_profile(self.slices, 2, LENGTH)
        self.assertAlmostEqual(found.distances[0].value, PEAKS[1] - PEAKS[0], delta=1e-3)
        # 116, 120 and 124 mm
        self.assertAlmostEqual(found.distances[0].error, 0.004 / np.sqrt(3), delta=4e-4)
        self.assertEqual(found.at_ends, (False, False))
        self.assertAlmostEqual(found.humps.rmsd, 0, delta=2e-4)

    def test_a_peak_at_the_end_of_the_fit_has_no_distance(self):
        slices = self.slices
        height = np.tile(gaussians(slices.z, BASE, 0.02, 0.09, 0.03, 0.04, 0.34, 0.04), (3, 1))
        height += 1e-4 * np.random.default_rng(2).standard_normal(height.shape)
        found = read_profile(replace(slices, height=height), 2, LENGTH)
        self.assertEqual(found.at_ends, (False, True))
        self.assertRegex(found.marked_peaks, r"^\d+ 282\*$")
        self.assertTrue(np.isnan(found.distances[0].value))
        self.assertFalse(own_statements.is_known(found))

    def test_a_slice_that_one_turn_alone_fills_has_no_error(self):
        holdup = self.slices.holdup.copy()
        holdup[1:, 10] = 0  # the profile without the first turn has no slurry there
        with self.assertRaisesRegex(RuntimeError, r"no slurry in the slice at 107\.5 mm"):
            read_profile(replace(self.slices, holdup=holdup), 2, LENGTH)

    def test_too_few_slices_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "9 places along the axis; a fit of 3 Gaussians needs at least 10"):
            read_profile(self.slices, 3, 0.134)

    def test_pressure_falls_over_the_mill(self):
        for name in ("p_rgh", "level"):
            drop = pressure_drop(self.slices, name, LENGTH)
            self.assertAlmostEqual(drop.value, FALL * LENGTH, delta=1e-3)
            self.assertAlmostEqual(drop.error, 0, delta=1e-3)
            self.assertEqual(drop.freedom, 2)
        # Where slurry stands higher, its own pressure is lower
        self.assertNotAlmostEqual(pressure_drop(self.slices, "pressure", LENGTH).value, FALL * LENGTH, delta=10)

    def test_less_than_a_turn_is_refused(self):
        case = case_of(self.path)
        case.begin = LAST - 0.9 * TURN
        with self.assertRaisesRegex(RuntimeError, "averaged over 0.9 s; expected a turn of 1 s"):
            read_slices(case)

    def test_a_run_without_voxels_is_named(self):
        case = case_of(self.path)
        case.slurry, case.unusable = None, ["slurry.h5: not complete"]
        with self.assertRaisesRegex(RuntimeError, "no slurry.h5; slurry.h5: not complete"):
            read_slices(case)

    def test_jackknife_of_a_mean_is_its_standard_error(self):
        values = np.array([1.0, 4.0, 2.5, 3.0])
        value, error = jackknife(lambda turns: np.array([values[turns].mean()]), 4)
        self.assertAlmostEqual(value[0], values.mean())
        self.assertAlmostEqual(error[0], values.std(ddof=1) / 2)


class Bed(unittest.TestCase):
    def test_top_of_the_shoulder_is_on_the_rising_side(self):
        # Clockwise: the left side rises
        slurry = slurry_map(lambda x, y: np.where(y < 0.05, 1.0, 0.0),
                            lambda x, y: np.where(x > 0, 5.0, np.where(y > 0.02, -0.3, 1.0)))
        self.assertAlmostEqual(flow_numbers.top_velocity(slurry), -0.3)

    def test_top_of_the_shoulder_has_little_slurry_in_a_bed(self):
        def slurry(voidage):
            clear = slurry_map(lambda x, y: 0 * x + 1, lambda x, y: np.where(x < -0.05, 0.1, -0.1))
            filled = np.where(np.meshgrid(*clear.centres())[0] < -0.05, voidage, 1.0)
            return VoxelMap(clear.x, clear.y, clear.share, clear.velocity, np.isfinite(clear.share) * 1.0, filled,
                            clear.share, 0.0, 1.0, source="functions")
        bed = 0.5 * (1 + flow_numbers.top_velocity(slurry(1.0)) / 0.1)  # of the top's pixels
        self.assertAlmostEqual(flow_numbers.top_velocity(slurry(0.45)), 0.1 * (0.45 * bed - (1 - bed)) / (
            0.45 * bed + 1 - bed), places=12)


class Statements(unittest.TestCase):
    def flow(self, **numbers):
        series = SimpleNamespace(times=np.arange(2, 5, 0.05), holdup=np.ones((60, 2)), height=np.full((60, 2), -0.05))
        run = SimpleNamespace(series=series, speed=75, diameter=0.3, turn=1.036, name="run", steady=None,
                              feed=6.53e-5, first_slurry=3.71e-3)
        drops = dict.fromkeys(("p_rgh", "pressure", "level"), Mean(10.0, 1.0))
        return SimpleNamespace(**{"readings": run, "run": RUNS["Beetstra_75_20"], "drops": drops, **numbers})

    def test_none_is_tested_without_runs(self):
        found = own_statements.own_verdicts({}, {})
        self.assertGreater(len(found), 20)
        self.assertEqual({one.verdict for one in found}, {NOT_TESTED})

    def test_pressure_must_drop_clearly_more(self):
        def judged(more):
            flows = {"Beetstra_75_20": self.flow(), "ErgunWenYu_75_20": self.flow(
                drops=dict.fromkeys(("p_rgh", "pressure", "level"), Mean(more, 1.0)))}
            return {one.verdict for one in own_statements.drops(flows) if one.verdict != NOT_TESTED}
        self.assertEqual(judged(15.0), {CONFIRMED})
        self.assertEqual(judged(5.0), {CONTRADICTED})

    def test_a_larger_drop_that_may_be_none_is_undecided(self):
        # Of two turns each: the difference is clear, the drop itself needs 12.7 errors
        self.assertEqual(larger_drop(Mean(20.0, 5.0, 1), Mean(90.0, 7.5, 1)), UNDECIDED)
        self.assertEqual(larger_drop(Mean(20.0, 0.5, 1), Mean(90.0, 0.7, 1)), CONFIRMED)
        self.assertEqual(larger_drop(Mean(-90.0, 0.5, 1), Mean(-20.0, 0.7, 1)), CONTRADICTED)
        self.assertEqual(larger_drop(Mean(20.0, 0.01, 1), Mean(21.0, 0.01, 1)), CONTRADICTED)

    def test_balls_that_feel_the_slurry_have_verdicts_of_their_own(self):
        series = self.flow().readings.series
        readings = RunReadings("direct_75_20/direct", 0.3, 75, "Beetstra", 20, 5.0, True, 1.036, "fails",
                               Surface(Mean(40, 1, 1), Mean(0.002), 44.0), series, Mean(0.01, 1e-4, 1),
                               Mean(-0.01, 1e-4, 1), ReynoldsNumbers(np.array([100.0, 400.0] * 2),
                                                                     np.array([1.0, 3.0] * 2), np.repeat([0, 1], 2)))
        with mock.patch.object(own_statements, "why_withheld", lambda *_: ""):
            found = list(own_statements.felt({"direct_75_20": SimpleNamespace(readings=readings)}))
        self.assertEqual([one.verdict for one in found], [CONFIRMED, CONTRADICTED, CONFIRMED])
        self.assertTrue(all("not steady by the report: direct_75_20/direct" in one.figure for one in found))
        self.assertEqual(list(own_statements.felt({})), [])
        with mock.patch.object(own_statements, "why_withheld", lambda *_: "its force is too large"):
            found = list(own_statements.felt({"direct_75_20": SimpleNamespace(readings=readings)}))
        self.assertEqual([one.verdict for one in found], [UNDECIDED] * 3)
        self.assertTrue(all(one.figure.endswith("; its force is too large") for one in found))

    def test_a_drop_of_flows_with_other_feeds_is_undecided(self):
        drops = dict.fromkeys(("p_rgh", "pressure", "level"), Mean(15.0, 1.0))
        for feed, verdict in ((6.53e-5, CONFIRMED), (6.7e-5, UNDECIDED)):
            more = self.flow(drops=drops)
            more.readings.feed = feed
            found = own_statements.drops({"Beetstra_75_20": self.flow(), "ErgunWenYu_75_20": more})
            self.assertEqual({one.verdict for one in found if one.verdict != NOT_TESTED}, {verdict})
        self.assertEqual(own_statements.unlike(self.flow().readings, more.readings),
                         "their feeds differ, too: 65.3 and 67 ml/s")

    def patch_of(self, name, first, published=("Beetstra_75_20", 3.71e-3)):
        """Verdict on the dry patch of a flow that begins with so much slurry (m3), next to a published flow."""
        flows = {one: self.flow(centre_share=Mean(0.9, 0.01, 2), top_velocity=Mean(0.01, 0.001, 2), run=RUNS[one],
                                holdup=(volume, volume)) for one, volume in (published, (name, first))}
        return next(one for one in own_statements.bed(flows) if one.runs == name)

    def test_a_flow_that_begins_with_more_slurry_than_the_published_one_is_undecided(self):
        for name, first, verdict in (("whole_75_20", 4.91e-3, UNDECIDED), ("whole_75_20", 4.1e-3, UNDECIDED),
                                     ("whole_75_20", 4.0e-3, CONTRADICTED), ("layers_66", 3.3e-3, UNDECIDED),
                                     ("seed", 3.72e-3, CONTRADICTED), ("ErgunWenYu_75_20", 4.91e-3, CONTRADICTED)):
            with self.subTest(name=name, first=first):
                self.assertEqual(self.patch_of(name, first).verdict, verdict)
        self.assertIn("; it begins with 4.91 l of slurry, Beetstra_75_20 with 3.71",
                      self.patch_of("whole_75_20", 4.91e-3).figure)
        # Slower mills begin with another volume, and those without balls
        for other in ("Beetstra_60_20", "fluid_75_20"):
            found = self.patch_of("seed", 3.72e-3, (other, 3.72e-3))
            self.assertEqual(found.verdict, UNDECIDED)
            self.assertIn("no published flow with balls at 75 % is complete", found.figure)

    def test_balls_that_feel_another_force_than_the_flows_are_undecided(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        flow = self.flow(run=RUNS["direct_75_20"], holdup=(3.71e-3, 3.5e-3), case=SimpleNamespace(coupled=folder))
        flows = {"Beetstra_75_20": self.flow(holdup=(3.71e-3, 3.35e-3)), "direct_75_20": flow}

        def reason(**content):
            (folder / "coupling.json").write_text(json.dumps({"format": "millfoam-coupling", **content}))
            return as_published.why_withheld(flow, flows)
        self.assertEqual(reason(force_unbalanced=0.015, force_unbalanced_reach=0.01), "")
        self.assertIn("differs from what its own balance of momentum leaves for them by 9.5 %",
                      reason(force_unbalanced=0.095, force_unbalanced_reach=0.01))
        self.assertIn("undecided: with 95 % confidence", reason(force_unbalanced=0.015, force_unbalanced_reach=0.05))
        for old in ({}, {"force_unbalanced": None}):
            self.assertIn("not known: its slurryBalance has no force_balance_x_N", reason(**old))
        flow.run = RUNS["iterated_75_20"]
        passes = {"passes": 3, "most_passes": 3, "largest_change": "toe"}
        self.assertEqual(reason(settled=True, **passes), "")
        self.assertIn("not after 3 passes: most of all changed the toe", reason(settled=False, **passes))
        flow.run, flow.case.coupled = RUNS["direct_75_20"], None
        self.assertIn("there is no coupling.json", as_published.why_withheld(flow, flows))
        flow.run = RUNS["Beetstra_75_20"]
        self.assertEqual(as_published.why_withheld(flow, flows), "")

    def profile_of(self, height, noise=1e-4, turns=3):
        """Profile by read_profile of heights (z -> m) that differ from turn to turn by a noise (m)."""
        z = (np.arange(SHAPE[0]) + 0.5) * UPPER[2] / SHAPE[0]
        by_turn = height(z) + noise * np.random.default_rng(5).standard_normal((turns, len(z)))
        return read_profile(Slices(z, np.ones((turns, len(z))), by_turn, {}), 2, LENGTH)

    def humps(self, height, **more):
        flows = {"fluid_60_20": self.flow(chamber=self.profile_of(height, **more))}
        return next(own_statements.humps(flows, "chamber", "in front")).verdict

    def test_two_humps_are_two_maxima(self):
        def two(z):
            return gaussians(z, BASE, 0.02, 0.09, 0.03, second, 0.21, 0.03)
        second = 0.015
        self.assertEqual(self.humps(two), CONFIRMED)
        self.assertEqual(self.humps(two, noise=0.01), UNDECIDED)
        self.assertEqual(self.humps(two, turns=1), UNDECIDED)
        second = 0.0
        self.assertEqual(self.humps(two), CONTRADICTED)

    def test_where_the_error_leaves_fewer_than_two_of_three_it_is_undecided(self):
        z = np.linspace(0.03, 0.28, 26)
        height = sum(gaussians(z, 0, high, at, 0.01, 0, 0.1, 0.01) for high, at in
                     ((0.02, 0.06), (0.006, 0.15), (0.005, 0.24)))
        for error, expected in ((1e-4, CONTRADICTED), (1.25e-3, UNDECIDED), (2e-3, UNDECIDED), (np.nan, UNDECIDED)):
            self.assertEqual(own_statements.has_two(SimpleNamespace(z=z, height=height, error=error)), expected)

    def test_profiles_with_one_hump_or_none_have_not_two(self):
        # Two Gaussians can be fitted to each of them
        for name, height in (("parabola", lambda z: -0.5 * (z - 0.16)**2),
                             ("cosine", lambda z: 0.02 * np.cos(12 * z - 2)), ("ramp", lambda z: 0.1 * z),
                             ("flat top", lambda z: -8.0 * np.abs(z - 0.16)**3),
                             ("skewed", lambda z: 0.5 * z * np.exp(-z / 0.08))):
            with self.subTest(name):
                self.assertEqual(self.humps(height), CONTRADICTED)

    def test_distances_are_compared_only_of_two_maxima(self):
        def verdict(slow, fast):
            flows = {"fluid_60_20": self.flow(chamber=self.profile_of(slow)),
                     "fluid_75_20": self.flow(chamber=self.profile_of(fast))}
            found = own_statements.humps(flows, "chamber", "in front")
            return next(one.verdict for one in found if "twice" in one.statement)

        def apart(distance):
            return lambda z: gaussians(z, BASE, 0.02, 0.16 - distance / 2, 0.02, 0.02, 0.16 + distance / 2, 0.02)
        self.assertEqual(verdict(apart(0.08), apart(0.16)), CONFIRMED)
        self.assertEqual(verdict(apart(0.1), apart(0.12)), CONTRADICTED)
        self.assertEqual(verdict(lambda z: -0.5 * (z - 0.16)**2, apart(0.16)), UNDECIDED)

    def test_patch_and_return_are_those_of_every_flow_with_balls(self):
        flows = {name: self.flow(centre_share=Mean(share, 0.01, 2), top_velocity=Mean(velocity, 0.001, 2))
                 for name, share, velocity in (("Beetstra_60_30", 0.3, -0.01), ("direct_75_20", 0.9, 0.01),
                                               ("Beetstra_75_20", 0.52, -0.003))}
        found = [(one.runs, one.verdict) for one in own_statements.bed(flows)]
        self.assertEqual(found, [("Beetstra_60_30", CONFIRMED)] * 2 + [("direct_75_20", CONTRADICTED)] * 2
                         + [("Beetstra_75_20", UNDECIDED)] * 2)

    def test_maps_of_the_balls_are_compared_with_the_dry_run(self):
        dry = {"dry_75": "dry", "dry_seed": "seed"}
        flows = {"direct_75_20": SimpleNamespace(case="felt", withheld="")}
        apart = {"felt": Mean(0.03, 0.001, 2), "seed": Mean(0.01, 0.001, 2), "near": Mean(0.025, 0.002, 2)}
        with mock.patch.object(own_statements, "charge_apart", lambda one, _: (apart[one], "far")), \
                mock.patch.object(own_statements, "noise", lambda _: 0.002), \
                mock.patch.object(own_statements, "why_withheld", lambda flow, _: flow.withheld):
            found = list(own_statements.charges(flows, dry))
            missing = list(own_statements.charges(flows, {"dry_seed": "seed"}))
            near = list(own_statements.charges({"direct_75_20": SimpleNamespace(case="near", withheld="")}, dry))
            held = list(own_statements.charges({"direct_75_20": SimpleNamespace(case="felt", withheld="why")}, dry))
        self.assertEqual([one.verdict for one in found], [CONTRADICTED, CONFIRMED])
        self.assertEqual(near[0].verdict, UNDECIDED)
        self.assertEqual([one.verdict for one in held], [UNDECIDED, CONFIRMED])
        self.assertTrue(held[0].figure.endswith("; why"))
        self.assertIn("far (limit 2 % of solidity; halves of dry_75 differ by 0.20 %)", found[0].figure)
        self.assertEqual([one.figure for one in missing], ["not complete: dry_75"] * 2)

    def test_maps_of_charges_have_the_error_of_their_turns(self):
        def case(*tilts):
            maps = [charge_map(below(lambda x, tilt=tilt: -np.tan(np.radians(tilt)) * x), cell) for tilt in tilts]
            for number, one in enumerate(maps):
                one.begin, one.end = number * TURN, (number + 1) * TURN
            return SimpleNamespace(charge=mean_map(maps), charge_windows=maps, radius=RADIUS, turn=TURN)
        found = own_statements.map_difference(case(32, 34, 36), case(30, 30, 30))
        self.assertAlmostEqual(found.value, own_statements.HARDLY, delta=0.004)
        self.assertGreater(found.error, 0.002)
        self.assertEqual((found.freedom, by_sign(Mean(own_statements.HARDLY) - found)), (2, UNDECIDED))

    def test_a_charge_is_apart_from_one_that_is_turned(self):
        def case(tilt):
            charge = charge_map(below(lambda x: -np.tan(np.radians(tilt)) * x), cell)
            return SimpleNamespace(charge=charge, charge_windows=[charge] * 4, radius=RADIUS, turn=TURN)
        apart, words = own_statements.charge_apart(case(30), case(34))
        self.assertAlmostEqual(apart.value, own_statements.HARDLY, delta=0.002)
        self.assertAlmostEqual(apart.error, 0, delta=1e-12)
        for end in ("toe", "shoulder"):
            self.assertRegex(words, end + r" by -(3\.[89]|4\.[01])\d ± 0\.00 degrees")


class Tables(unittest.TestCase):
    def test_runs_that_are_not_there_are_named(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "dry_75").mkdir()
        (folder / "dry_75" / "mill.json").write_text("{}")
        found, missing = study.read_each(folder, [RUNS["dry_75"], RUNS["dry_60"]], study.dry_case)
        self.assertEqual(found, {})
        self.assertRegex(missing[0], "not read: dry_75: .*mill.json")
        self.assertEqual(missing[1], "not finished: dry_60: not begun")

    def test_a_flow_beyond_its_limits_is_named_and_fails_the_study_after_all_is_written(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(mock.patch.object(sys, "argv", ["mill_30cm_published", str(folder)]))
        for missing, error, words in ((1e-13, 1e-13, []), (2e-10, 1e-13, ["2.0e-10 of the slurry is missing"]),
                                      (np.nan, 2e-6, ["nan of the slurry", "the feed differs by 2.0e-06 of it"])):
            flow = SimpleNamespace(run=RUNS["fluid_75_20"], case=SimpleNamespace(feed=6e-5), missing=missing,
                                   feed_error=error)
            with mock.patch.object(study, "read_each", side_effect=[({}, []), ({"fluid_75_20": flow}, [])]), \
                    mock.patch.object(study, "write_all", lambda root, dry, flows, missing: missing), \
                    mock.patch("builtins.print"):
                if words:
                    with self.assertRaisesRegex(SystemExit, "error: these flows are beyond their limits"):
                        study.main()
                else:
                    study.main()
            written = (folder / "mill_30cm_published.txt").read_text()
            self.assertEqual(written.count("not conserved: fluid_75_20: "), len(words))
            for one in words:
                self.assertIn(one, written)

    def test_cost_of_a_dry_run_stands_beside_its_plan(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        run = folder / "dry_75"
        (run / "dumps").mkdir(parents=True)
        subprocess.run(["millMesh", ROOT / "cases/mills/mill_30cm/mill.yaml", "--resolved", run / "mill.json"],
                       check=True)
        results = {"format": "millfoam-charge", "mill": {}, "wall_time_s": 120.0, "memory_bytes": 3e8}
        (run / "dumps" / "results.json").write_text(json.dumps(results))
        plan = {"format": "millfoam-plan", "stages": [{"stage": "charge", "time_s": 90.0}],
                "total": {"memory_bytes": 4e8, "disk_bytes": 5e9}}
        (run / "plan.json").write_text(json.dumps(plan))
        row = study.cost_row(RUNS["dry_75"], folder)
        self.assertEqual((row["dry run, min"], row["planned charge, min"], row["planned flow, min"]), (2, 1.5, None))
        self.assertEqual((row["memory, GB"], row["planned memory, GB"], row["planned disk, GB"]), (0.3, 0.4, 5))

    def test_rows_have_the_version_that_computed_a_run(self):
        for summary, version in (({"program": "slurryFoam 0.2.0+ed1f35881"}, "0.2.0+ed1f35881"), ({}, "–"),
                                 ({"program": None}, "–")):
            self.assertEqual(study.version_of(summary), version)

    def test_columns_have_the_freedom_of_an_error(self):
        row = study.freedom_columns("drop, Pa", Mean(1.234e-3, 0.056e-3, 2), 1e3)
        self.assertEqual(row, {"drop, Pa": 1.234, "drop, Pa ±": 0.056, "drop, Pa, freedom": 2})
        self.assertEqual(list(study.lines_of([row]))[0].split(maxsplit=2)[2], "1.23 ± 0.06 (2)")

    def test_cells_have_errors_where_they_are_known(self):
        rows = [{"run": "a", **study.freedom_columns("drop, Pa", Mean(1.234, 0.056))},
                {"run": "b", **study.freedom_columns("drop, Pa", Mean(np.nan, np.nan))}]
        self.assertEqual([line.split() for line in study.lines_of(rows)],
                         [["run", "a", "b"], ["drop,", "Pa", "1.23", "±", "0.06", "–"], []])


if __name__ == "__main__":
    unittest.main()
