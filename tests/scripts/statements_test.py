#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on the thesis' statements, on runs made up so that the answer is known; and what is read of runs, on made-up
flows."""
import importlib.util
import json
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

from millfoam.files.mill import Mill
from millfoam.readings import slurry_over_time
from millfoam.readings.axial import AxialSeries, gaussians
from millfoam.readings.means import Mean, block_mean, by_resolution, series_mean
from millstudies import own_mill, run_readings, statements
from millstudies.compared_runs import CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED, Runs, height, unsteady
from millstudies.mill_runs import OTHER_MESH
from millstudies.run_readings import ReynoldsNumbers, RunReadings, Surface, surface_line, surface_resolution
from slurry_on_maps_test import RADIUS, WALL, slurry_map

Z = np.linspace(0.005, 0.3, 33)
TIMES = np.arange(2, 5, 0.05)


def series(profile=-0.05, pressure=0.0, noise=1e-4):
    """AxialSeries with a mean height (m, number or [33]) and pressure (Pa), with noise over time."""
    random = np.random.default_rng(3)
    shape = (len(TIMES), len(Z))
    return AxialSeries(Z, TIMES, profile + noise * random.standard_normal(shape), np.full(shape, 1e-4),
                       pressure + 1e3 * noise * random.standard_normal(shape))


def turn(diameter, speed):
    """Time (s) of a turn of a mill (m) at a speed (% of critical)."""
    return 2 * np.pi / (speed / 100 * np.sqrt(9.81 / (diameter / 2)))


def run(speed=75, law=None, solids=20, last=5.0, **read):
    """A run of the 30 cm mill, steady by default."""
    return RunReadings(f"run_{speed}_{law}_{solids}", 0.3, speed, law, solids, last, True, turn(0.3, speed),
                       **{"series": series(), **read})


def reynolds_by_turn(numbers, slurry, turns=3):
    """ReynoldsNumbers that are the same in each turn: numbers [n], slurry's volumes [n] (m3)."""
    return ReynoldsNumbers(np.tile(numbers, turns), np.tile(slurry, turns), np.repeat(np.arange(turns), len(numbers)))


def a_slice(law=None, solids=30, last=5.0, **read):
    """A run of the 12 cm mill's slice at half of the critical speed."""
    return RunReadings(f"slice_{law}_{solids}", 0.12, 50, law, solids, last, False, turn(0.12, 50),
                       **{"series": series(), **read})


def verdicts_of(function, *runs, of_slice=False):
    """The verdicts on the 30 cm mill, or those on the 12 cm mill's slice."""
    found = function(Runs(runs))
    return [one.verdict for one in found if of_slice == ("slice" in one.runs + one.figure)]


class Flat(unittest.TestCase):
    def surface(self, tilt, deviation):
        return run(surface=Surface(Mean(tilt), Mean(deviation)))

    def test_is_judged_by_tilt_and_deviation(self):
        for tilt, deviation, verdict in ((2, 0.003, CONFIRMED), (12, 0.003, CONTRADICTED), (2, 0.02, CONTRADICTED)):
            self.assertEqual(verdicts_of(statements.flat_without_balls, self.surface(tilt, deviation)),
                             [NOT_TESTED, verdict])

    def test_what_its_error_takes_over_the_limit_is_undecided(self):
        # Of two turns: 12.7 errors
        for tilt, deviation in ((Mean(4.0, 0.2, 1), Mean(0.003)), (Mean(-6.0, 0.2, 1), Mean(0.003)),
                                (Mean(2.0, 0.1, 1), Mean(0.005, 2e-4, 1)), (Mean(2.0, np.nan, 0), Mean(0.003))):
            one = run(surface=Surface(tilt, deviation))
            self.assertEqual(verdicts_of(statements.flat_without_balls, one), [NOT_TESTED, UNDECIDED])

    def test_a_surface_that_is_equal_in_all_turns_is_known_to_its_voxels(self):
        # Voxels of 9 mm over 0.23 m, of a mill of 0.3 m: limits of 6 mm and 5 degrees
        resolution = surface_resolution(0.3 / 33, 0.23)
        np.testing.assert_allclose(resolution, (1.31, 0.00152), rtol=0.01)
        for tilt, deviation, verdict in ((1.0, 0.0022, CONFIRMED), (1.0, 0.0040, UNDECIDED), (1.0, 0.0080, UNDECIDED),
                                         (1.0, 0.0095, CONTRADICTED), (3.0, 0.0022, UNDECIDED),
                                         (8.0, 0.0022, CONTRADICTED)):
            with self.subTest(tilt=tilt, deviation=deviation):
                found = [by_resolution(block_mean([value] * 2), least)
                         for value, least in zip((tilt, deviation), resolution)]
                self.assertEqual(verdicts_of(statements.flat_without_balls, run(surface=Surface(*found))),
                                 [NOT_TESTED, verdict])
        # Without a resolution, no error is no certainty
        unknown = Surface(Mean(1.0), block_mean([0.0022] * 2))
        self.assertEqual(verdicts_of(statements.flat_without_balls, run(surface=unknown)), [NOT_TESTED, UNDECIDED])

    def test_a_run_that_is_short_or_missing_is_reported(self):
        short = run(60, last=3.4, surface=Surface(Mean(0), Mean(0)))
        found = statements.flat_without_balls(Runs([short]))
        self.assertEqual([one.verdict for one in found], [NOT_TESTED] * 3)
        self.assertIn("fluid_only_60 ends at 3.4 s; expected 4.5 s", found[0].figure)
        self.assertIn("missing: fluid_only_75", found[1].figure)
        self.assertEqual("missing: 12 cm slice at 50 %, without balls", found[2].figure)

    def test_what_could_not_be_read_is_reported(self):
        found = statements.flat_without_balls(Runs([run(failures=["surface not read: no slurry"])]))
        self.assertEqual((found[1].verdict, found[1].figure), (NOT_TESTED, "surface not read: no slurry"))


class TwoHumps(unittest.TestCase):
    def profile(self, apart, heights=(0.01, 0.01)):
        return series(gaussians(Z, -0.06, heights[0], 0.15 - apart / 2, 0.02, heights[1], 0.15 + apart / 2, 0.02))

    def test_are_counted_and_their_distances_compared(self):
        for apart, verdict in ((0.2, CONFIRMED), (0.12, CONTRADICTED)):
            runs = run(60, series=self.profile(0.1)), run(75, series=self.profile(apart))
            self.assertEqual(verdicts_of(statements.humps_without_balls, *runs), [CONFIRMED, CONFIRMED, verdict])

    def test_their_distances_have_the_error_of_the_turns(self):
        # The second hump is 0.1 or 0.14 m further on in the mean of the last two turns, and moves by 20 mm in a second
        def moving(times, apart):
            return np.array([gaussians(Z, -0.06, 0.01, 0.05, 0.02, 0.01, 0.05 + apart + 0.02 * (time - 3.91), 0.02)
                             for time in times])
        slow, fast = (run(speed, series=series(moving(TIMES, apart))) for speed, apart in ((60, 0.1), (75, 0.14)))
        distance = statements.hump_distance(fast)
        self.assertAlmostEqual(distance.value, 0.14, delta=5e-3)
        self.assertGreater(distance.error, 3e-3)
        self.assertEqual(distance.freedom, 1)
        self.assertEqual(statements.distance_ratio({60: (statements.hump_distance(slow), True, slow),
                                                    75: (distance, True, fast)}).verdict, UNDECIDED)

    def test_a_hump_at_the_end_of_the_fit_has_no_distance(self):
        rising = run(75, series=series(gaussians(Z, -0.06, 0.01, 0.1, 0.02, 0.03, 0.34, 0.04)))
        self.assertTrue(np.isnan(statements.hump_distance(rising).value))
        found = statements.distance_ratio({60: (Mean(0.1), True, run(60)), 75: (Mean(np.nan, np.nan), True, rising)})
        self.assertEqual(found.verdict, UNDECIDED)
        self.assertIn("no distance: a peak is at the end of the fit", found.figure)

    def test_a_ratio_beside_a_limit_is_seldom_decided_wrongly(self):
        # Distances of three turns each, whose true ratio is a hundredth beside 1.5 or 2.5
        random = np.random.default_rng(11)
        for ratio, wrong in ((1.49, CONFIRMED), (1.51, CONTRADICTED), (2.49, CONTRADICTED), (2.51, CONFIRMED)):
            found = [statements.about_twice(*(block_mean(random.normal(apart, 0.05 * apart, 3))
                                              for apart in (0.08, ratio * 0.08))) for _ in range(1000)]
            self.assertLess(np.mean([one == wrong for one in found]), 0.05)

    def test_one_hump_is_not_two_and_leaves_the_distance_open(self):
        runs = run(60, series=self.profile(0.1, (0.0, 0.01))), run(75, series=self.profile(0.2))
        self.assertEqual(verdicts_of(statements.humps_without_balls, *runs), [CONTRADICTED, CONFIRMED, UNDECIDED])

    def test_maxima_below_the_error_do_not_count(self):
        height = gaussians(Z, -0.06, 0.01, 0.1, 0.02, 0.002, 0.2, 0.02)
        for error, count, verdict in ((1e-4, 2, CONFIRMED), (5e-4, 1, UNDECIDED), (np.nan, 0, UNDECIDED)):
            self.assertEqual(len(statements.maxima(Z, height, error)), count)
            self.assertEqual(statements.two_maxima(Z, height, error), verdict)

    def test_raised_ends_are_no_humps(self):
        run_60 = run(60, series=series(np.abs(Z - 0.15)))
        (verdict, *_) = statements.humps_without_balls(Runs([run_60]))
        self.assertEqual(verdict.verdict, CONTRADICTED)
        self.assertIn(f"no maximum between the ends, {1e3 * Z[0]:.0f}, {1e3 * Z[-1]:.0f} mm", verdict.figure)


class WithBalls(unittest.TestCase):
    def test_the_surface_follows_what_its_tilt_is_nearer_to(self):
        for tilt, error, verdict in ((30, 1, CONFIRMED), (10, 1, CONTRADICTED), (20.5, 3, UNDECIDED)):
            one = run(law="Beetstra", surface=Surface(Mean(tilt, error), Mean(0.01), 40.0))
            self.assertEqual(verdicts_of(statements.surface_follows, one), [verdict])

    def pair(self, rise, solids=20):
        return (run(law="Beetstra", solids=solids, series=series(-0.05)),
                run(law="ErgunWenYu", solids=solids, series=series(-0.05 + rise)))

    def test_slightly_higher_is_higher_and_not_much(self):
        for rise, verdict in ((0.002, CONFIRMED), (-0.002, CONTRADICTED), (0.0, UNDECIDED), (0.03, CONTRADICTED)):
            self.assertEqual(verdicts_of(statements.drag_raises, *self.pair(rise)), [verdict, NOT_TESTED])

    def test_runs_on_other_slices_are_not_compared(self):
        for change in (lambda z: z[:9], lambda z: z * z / z[-1]):
            beetstra, ergun = self.pair(0.002)
            ergun.series.z = change(ergun.series.z)
            self.assertEqual(verdicts_of(statements.drag_raises, beetstra, ergun)[0], NOT_TESTED)

    def test_the_difference_shrinks_with_concentration(self):
        for later, verdict in ((0.001, CONFIRMED), (0.004, CONTRADICTED)):
            found = verdicts_of(statements.drag_raises, *self.pair(0.002), *self.pair(later, 40))
            self.assertEqual(found[1], verdict)

    def test_a_slice_is_compared_with_what_slurries_there_are(self):
        runs = [a_slice(law, solids, series=series(height)) for law, solids, height in (
            ("Beetstra", 30, -0.05), ("ErgunWenYu", 30, -0.049), ("Beetstra", 50, -0.045), ("ErgunWenYu", 50, -0.0445))]
        for function, count in ((statements.drag_raises, 3), (statements.concentration_raises, 2)):
            self.assertEqual(verdicts_of(function, *runs, of_slice=True), [CONFIRMED] * count)
            self.assertEqual(set(verdicts_of(function, *runs)), {NOT_TESTED})
        shrinks = statements.drag_raises(Runs(runs))[-1]
        self.assertEqual(shrinks.statement, "that difference shrinks from 30 % to 50 % slurry")
        self.assertIn("1.00 ± 0.0", shrinks.figure)
        self.assertEqual(verdicts_of(statements.drag_raises, *runs[:2], of_slice=True), [CONFIRMED, NOT_TESTED])
        missing = statements.concentration_raises(Runs(runs[:1]))[2]
        self.assertEqual(missing.figure, "missing: 12 cm slice at 50 %, Beetstra, 40 % slurry")

    def test_a_slice_is_flat_without_balls_and_follows_them(self):
        flat = a_slice(surface=Surface(Mean(2), Mean(0.001)))
        self.assertEqual(verdicts_of(statements.flat_without_balls, flat, of_slice=True), [CONFIRMED])
        follows = a_slice("Beetstra", surface=Surface(Mean(30, 1), Mean(0.01), 40.0))
        self.assertEqual(verdicts_of(statements.surface_follows, follows, of_slice=True), [CONFIRMED])
        self.assertEqual(verdicts_of(statements.surface_follows, follows), [NOT_TESTED])

    def test_another_mill_is_not_judged(self):
        other = a_slice("Beetstra", surface=Surface(Mean(30, 1), Mean(0.01), 40.0))
        other.diameter = 0.2
        self.assertEqual({one.verdict for one in statements.verdicts([other])}, {NOT_TESTED})

    def test_a_slice_says_nothing_along_the_axis(self):
        runs = [a_slice(law, 20, series=series(pressure=-1e3 * Z)) for law in (None, "Beetstra", "ErgunWenYu")]
        for function in (statements.humps_without_balls, statements.pressure_drops, statements.circulation):
            self.assertEqual(set(verdicts_of(function, *runs)), {NOT_TESTED})
            self.assertEqual(verdicts_of(function, *runs, of_slice=True), [])

    def test_concentration_raises(self):
        runs = run(law="Beetstra", series=series(-0.05)), run(law="Beetstra", solids=40, series=series(-0.04))
        self.assertEqual(verdicts_of(statements.concentration_raises, *runs), [CONFIRMED, NOT_TESTED, NOT_TESTED])
        slow = run(60, "Beetstra", series=series(-0.05)), run(60, "Beetstra", 40, series=series(-0.06))
        self.assertEqual(verdicts_of(statements.concentration_raises, *runs, *slow),
                         [CONFIRMED, NOT_TESTED, CONTRADICTED])

    def test_a_concentration_with_another_feed_or_slurry_is_undecided(self):
        def verdicts(feeds, slurries=(None, None)):
            runs = [run(law=law, solids=solids, series=series(height), feed=feed, first_slurry=slurry)
                    for law, heights in (("Beetstra", (-0.05, -0.04)), ("ErgunWenYu", (-0.048, -0.039)))
                    for solids, feed, slurry, height in zip((20, 40), feeds, slurries, heights)]
            return [[one for one in statement(Runs(runs)) if one.verdict != NOT_TESTED]
                    for statement in (statements.concentration_raises, statements.drag_raises)]
        alike = verdicts((6.53e-5, 6.57e-5), (3.71e-3, 3.72e-3))
        self.assertEqual([one.verdict for part in alike for one in part], [CONFIRMED] * 4)
        for other, words in ((verdicts((6.53e-5, 9.32e-5)), "their feeds differ, too: 65.3 and 93.2 ml/s"),
                             (verdicts((6.53e-5, 6.53e-5), (3.71e-3, 4.91e-3)),
                              "their slurries at first differ, too: 3.71 and 4.91 l")):
            raises, (law, shrinks) = other
            self.assertEqual([one.verdict for one in (*raises, shrinks)], [UNDECIDED] * 3)
            self.assertTrue(all(words in one.figure for one in raises))
            self.assertEqual(law.verdict, CONFIRMED)  # both laws have the same feed and slurry

    def test_runs_that_the_report_does_not_call_steady_are_named(self):
        runs = (run(law="Beetstra", series=series(-0.05), steady="holds"),
                run(law="Beetstra", solids=40, series=series(-0.04), steady="fails"))
        found = statements.concentration_raises(Runs(runs))[0]
        self.assertEqual(found.verdict, CONFIRMED)
        self.assertTrue(found.figure.endswith("(not steady by the report: run_75_Beetstra_40)"), found.figure)

    def test_reynolds_numbers_are_weighted_by_slurry(self):
        numbers = np.array([50.0, 400.0])
        for slurry, verdict in (((3.0, 1.0), CONFIRMED), ((1.0, 3.0), CONTRADICTED)):
            one = run(law="Beetstra", reynolds=reynolds_by_turn(numbers, slurry))
            self.assertEqual(verdicts_of(statements.reynolds_below, one), [verdict, NOT_TESTED])
            thick = a_slice("Beetstra", 40, reynolds=reynolds_by_turn(numbers, slurry))
            self.assertEqual(verdicts_of(statements.reynolds_below, thick, of_slice=True), [NOT_TESTED, verdict])

    def test_reynolds_numbers_are_judged_by_diameter_and_by_radius(self):
        # Limits of 150 and 300; the third is between both in one of the turns
        for numbers, verdict in (((50, 100), CONFIRMED), ((200, 250), statements.DEPENDS), ((350, 400), CONTRADICTED)):
            one = run(law="Beetstra", reynolds=reynolds_by_turn(np.array(numbers), (1.0, 1.0)))
            found = statements.reynolds_below(Runs([one]))[0]
            self.assertEqual(found.verdict, verdict)
            self.assertRegex(found.figure, f"by the diameter .*median {numbers[0]}; by the radius .*median "
                             f"{numbers[0] / 2:.0f}")

    def test_a_share_of_reynolds_numbers_has_its_error_by_turns(self):
        # More than half is below 150 in one turn of two, and in each of two turns
        for first, verdict in ((0.45, UNDECIDED), (0.78, CONFIRMED)):
            shares = np.array([[first, 1 - first], [0.8, 0.2]])
            one = run(law="Beetstra", reynolds=ReynoldsNumbers(np.tile([50.0, 900.0], 2), shares.ravel(),
                                                               np.repeat([0, 1], 2)))
            self.assertEqual(verdicts_of(statements.reynolds_below, one)[0], verdict)

    def test_a_share_of_few_cells_is_known_to_one_of_them(self):
        # In both turns 52 % of the slurry is below the limit, in a single cell or in 52 of 100
        for numbers, slurry, verdict in (([50.0, 900.0], [0.52, 0.48], UNDECIDED),
                                         ([50.0] * 52 + [900.0] * 48, [0.01] * 100, CONFIRMED)):
            one = run(law="Beetstra", reynolds=reynolds_by_turn(np.array(numbers), np.array(slurry), 2))
            share = one.reynolds.share_below(150)
            self.assertAlmostEqual(share.value, 0.52)
            self.assertAlmostEqual(share.error, slurry[0] / 2 / np.sqrt(12))
            self.assertEqual(verdicts_of(statements.reynolds_below, one)[0], verdict)

    def test_reynolds_numbers_belong_to_the_last_whole_turns(self):
        def parts_of(last):
            case = SimpleNamespace(mill=SimpleNamespace(slurry=lambda _: 1.0), begin=0.25, last=last, turn=1.0,
                                   flow=SimpleNamespace(frames=[(0.25 * k, "") for k in range(int(4 * last) + 1)]))
            with mock.patch.object(run_readings, "read_frame", lambda flow, time, path: time), \
                    mock.patch.object(run_readings, "reynolds", lambda time, *fluid: (np.array([time]), np.ones(1))):
                found = run_readings.read_reynolds(case)
            np.testing.assert_array_equal(found.values, 0.25 * np.arange(1, 4 * last + 1))
            return list(found.parts)
        self.assertEqual(parts_of(2.5), [-1, -1, 0, 0, 0, 0, 1, 1, 1, 1])
        self.assertEqual(parts_of(1.25), [0, 1, 2, 3, 4])  # less than two turns

    def test_reynolds_numbers_of_slurries_without_a_published_limit_are_not_tested(self):
        for one in (run(law="Beetstra", solids=30), a_slice("Beetstra", 30), a_slice("Beetstra", None)):
            one.reynolds = reynolds_by_turn(np.array([50.0, 400.0]), (3.0, 1.0))
            found = statements.reynolds_below(Runs([one]))
            self.assertEqual({each.verdict for each in found}, {NOT_TESTED})
            self.assertRegex(found[-1].figure,
                             "none is published for (30 %|this) slurry, for 20 and 40 % only; median 50")

    def test_a_pressure_drop_must_be_one_and_clearly_larger(self):
        def runs(beetstra, ergun):
            return (run(law=law, series=series(pressure=-drop / (Z[-1] - Z[0]) * Z)) for law, drop in (
                ("Beetstra", beetstra), ("ErgunWenYu", ergun)))

        for beetstra, ergun, verdict in ((100, 150, CONFIRMED), (150, 100, CONTRADICTED), (100, 103, CONTRADICTED),
                                         (-100, -50, CONTRADICTED), (100, 100, UNDECIDED)):
            with self.subTest(f"{beetstra} {ergun}"):
                self.assertEqual(verdicts_of(statements.pressure_drops, *runs(beetstra, ergun)), [verdict])

    def test_a_pressure_drop_is_judged_by_its_error(self):
        # Of two turns each. Each is clearly more than the other one: is it a drop, and 1.1 times as much?
        for less, more, verdict in ((Mean(-150, 1, 1), Mean(-25, 7, 1), UNDECIDED),
                                    (Mean(-150, 1, 1), Mean(-25, 1, 1), CONTRADICTED),
                                    (Mean(100, 0.1, 1), Mean(109, 0.5, 1), UNDECIDED),
                                    (Mean(100, 0.1, 1), Mean(111, 0.5, 1), UNDECIDED),
                                    (Mean(100, 0.1, 1), Mean(105, 0.1, 1), CONTRADICTED),
                                    (Mean(100, 0.1, 1), Mean(130, 1, 1), CONFIRMED)):
            with self.subTest(f"{less} {more}"):
                self.assertEqual((more - less).sign, 1)
                self.assertEqual(statements.larger_drop(less, more), verdict)

    def test_a_drop_is_that_of_the_line(self):
        found = statements.drop(run(series=series(pressure=-200 * Z, noise=0)))
        self.assertAlmostEqual(found.value, 200 * (Z[-1] - Z[0]))

    def test_slurry_circulates_there_and_back(self):
        for toe, shoulder, verdict in ((0.01, -0.01, CONFIRMED), (0.01, 0.01, CONTRADICTED),
                                       (0.01, -0.0005, UNDECIDED)):
            one = run(law="Beetstra", toe=Mean(toe, 1e-3), shoulder=Mean(shoulder, 1e-3))
            self.assertEqual(verdicts_of(statements.circulation, one), [verdict])

    def test_every_statement_without_runs_is_not_tested(self):
        found = statements.verdicts([])
        self.assertEqual({one.verdict for one in found}, {NOT_TESTED})
        self.assertTrue(all("missing" in one.figure for one in found))
        of_slice = {one.statement for one in found if "slice" in one.figure}
        self.assertEqual(len(of_slice), 7)


class Steady(unittest.TestCase):
    def moved(self, change, **other):
        """A run whose height over time is changed by change(share of the time)."""
        found = run(law="Beetstra", surface=Surface(Mean(30, 1), Mean(0.01), 40.0), **other)
        found.series.height = found.series.height + change(np.linspace(0, 1, len(TIMES)))[:, None]
        return found

    def judged(self, one):
        return statements.surface_follows(Runs([one]))[0]

    def test_a_drift_between_the_halves_leaves_a_statement_undecided(self):
        self.assertEqual(self.judged(self.moved(lambda t: 0 * t)).verdict, CONFIRMED)
        # A wave of whole periods in each half is not a drift
        self.assertEqual(self.judged(self.moved(lambda t: 1e-3 * np.sin(12 * np.pi * t))).verdict, CONFIRMED)
        found = self.judged(self.moved(lambda t: 2e-3 * t))
        self.assertEqual(found.verdict, UNDECIDED)
        self.assertRegex(found.figure, "not steady: .*: its height drifts by 1.0[0-9] ± 0.[0-9]+ mm between the halves")

    def test_less_than_a_turn_leaves_a_statement_undecided(self):
        one = run(law="Beetstra", surface=Surface(Mean(30, 1), Mean(0.01), 40.0))
        late = TIMES > 4.0
        one.series = AxialSeries(Z, TIMES[late], *(values[late] for values in (
            one.series.height, one.series.holdup, one.series.pressure)))
        found = self.judged(one)
        self.assertEqual(found.verdict, UNDECIDED)
        self.assertIn("averaged over 0.9 s, less than a turn of the mill, 1 s", found.figure)

    @staticmethod
    def called_unsteady(times, correlation=0.0):
        """Share of 300 steady runs that are called unsteady; correlation: of a height and the next one, of an
        autoregressive process of first order."""
        called, shape = 0, (len(times), len(Z))
        for seed in range(300):
            one = run(law="Beetstra")
            noise = np.random.default_rng(seed).standard_normal(len(times))
            for k in range(1, len(times)):
                noise[k] = correlation * noise[k - 1] + np.sqrt(1 - correlation**2) * noise[k]
            one.series = AxialSeries(Z, times, -0.05 + 1e-4 * noise[:, None] + np.zeros(shape), np.full(shape, 1e-4),
                                     np.zeros(shape))
            called += bool(unsteady(one))
        return called / 300

    def test_a_steady_run_whose_heights_are_independent_is_seldom_called_unsteady(self):
        for times in (np.arange(2, 4.9, 0.05), np.arange(2, 9, 0.05)):
            # 5 % are expected, 12 % of a limit of two errors with four degrees of freedom
            self.assertLess(self.called_unsteady(times), 0.08)

    def test_a_steady_run_whose_heights_are_correlated_is_called_unsteady_as_often_as_the_readme_says(self):
        # A correlation time of 0.5 s, half a turn: 34 and 15 % of 600 runs. The limits are four deviations of 300 runs
        for times, low, high in ((np.arange(2, 4.9, 0.05), 0.23, 0.45), (np.arange(2, 9, 0.05), 0.07, 0.23)):
            share = self.called_unsteady(times, np.exp(-0.05 / 0.5))
            self.assertTrue(low < share < high, share)

    def test_each_of_two_runs_must_be_steady(self):
        runs = self.moved(lambda t: 0 * t), self.moved(lambda t: 5e-3 * t)
        runs[1].law = "ErgunWenYu"
        found = statements.drag_raises(Runs(runs))[0]
        self.assertEqual(found.verdict, UNDECIDED)
        self.assertIn("not steady: run_75_Beetstra_20: its height drifts", found.figure)

    def test_what_is_not_known_to_be_steady_is_undecided(self):
        self.assertEqual(self.judged(run(law="Beetstra", series=None,
                                         surface=Surface(Mean(30, 1), Mean(0.01), 40.0))).verdict,
                         UNDECIDED)

    def test_a_slice_is_read_with_its_series_and_the_reports_verdict(self):
        for ends, read in ((False, True), (True, False)):
            found = RunReadings("a", 0.12, 50, "Beetstra", 30, 5.0, ends, 1.0)
            with mock.patch.object(statements, "read_run", lambda _, found=found: found), \
                    mock.patch.object(statements, "flow_steadiness", lambda _: SimpleNamespace(state="look")), \
                    mock.patch.object(statements, "read_series", lambda _: "its series"):
                one = statements.read(None)
            self.assertEqual((one.series, one.steady), ("its series" if read else None, "look"))


class Study(unittest.TestCase):
    """The runs that cases/studies/thesis_statements takes by default."""

    def setUp(self):
        path = Path(__file__).parents[2] / "cases" / "studies" / "thesis_statements" / "statements.py"
        specification = importlib.util.spec_from_file_location("thesis_statements", path)
        self.study = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(self.study)
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def make(self, name, whole=True):
        folder = self.folder / name
        summary = folder / "postProcessing" / "flow" / "0" / "flow.json"
        summary.parent.mkdir(parents=True)
        summary.write_text(json.dumps({"format": "millfoam-flow", "mill": {}, "complete": whole}))
        return folder

    def test_whole_slices_with_their_own_drag_are_taken_of_the_finer_mesh_or_else_of_the_mills_own(self):
        self.assertEqual(self.study.slices_there(self.folder / "none"), [])
        own = [self.make("Beetstra"), self.make("ErgunWenYu")]
        for name in ("no_drag", "whole_run", "cells_3mm", "no_tension_3mm", "fine_no_drag"):
            self.make(name)
        self.make("fine_Hill", whole=False)
        cut_short = self.make("Tang") / "postProcessing" / "flow" / "0" / "flow.json"
        cut_short.write_text(cut_short.read_text()[:30])
        self.assertEqual(self.study.slices_there(self.folder), own)
        fine = self.make("fine_Beetstra")
        self.assertEqual(self.study.slices_there(self.folder), [fine])

    def case_of(self, law, multiplier):
        """A case whose mill has a law with a factor on its drag."""
        sections = {key: {} for key in ("geometry", "charge", "speed")}
        derived = {**sections, "flow": {"law": law, "multiplier": multiplier}}
        return SimpleNamespace(mill=Mill(Path("a/mill.json"), {"mill": sections, "derived": derived}), law=law)

    def test_a_multiplied_drag_is_refused_and_a_laws_own_is_not(self):
        self.study.refuse_multiplied(self.case_of("Tang", 1))
        self.study.refuse_multiplied(self.case_of(None, 0))
        with self.assertRaisesRegex(RuntimeError, r"a/mill.json: flow.multiplier 0; expected 1"):
            self.study.refuse_multiplied(self.case_of("Tang", 0))

    def read(self, **parts):
        """What read_case does with a case of these parts, a whole slice by default."""
        case = SimpleNamespace(folder=self.folder, **{
            "flow": True, "law": None, "mill": SimpleNamespace(flow=lambda *_: 1, fingerprint={"flow": "own"}),
            "is_slice": True, "is_cut_short": False, "last": 3.0, "duration": 7.86, **parts})
        with mock.patch.object(self.study, "MillCase", lambda _: case):
            return self.study.read_case("a")

    def test_a_slice_that_was_interrupted_is_refused(self):
        with mock.patch.object(own_mill, "same_mill", lambda _: SimpleNamespace(state="holds")):
            self.assertEqual(self.read().last, 3.0)
            with self.assertRaisesRegex(RuntimeError, "a: the flow ends at 3 s; expected 7.86 s"):
                self.read(is_cut_short=True)
            self.read(is_cut_short=True, is_slice=False)

    def test_a_run_of_another_mill_is_refused_but_not_one_with_the_balls_of_another_mesh(self):
        stage = SimpleNamespace(mill={"flow": "own", "charge": "other"})
        with mock.patch.object(own_mill, "same_mill", lambda _: SimpleNamespace(state="fails", found="file")), \
                mock.patch.object(own_mill, "stages", lambda _: [stage]):
            with self.assertRaisesRegex(RuntimeError, "a: its mill has changed: file"):
                self.read()
            (self.folder / "constant").mkdir()
            (self.folder / "constant" / "bedProperties").write_text("fingerprint 1;\n" + OTHER_MESH)
            self.read()
            stage.mill["flow"] = "other"
            with self.assertRaisesRegex(RuntimeError, "its mill has changed"):
                self.read()


class Reading(unittest.TestCase):
    def test_a_surfaces_tilt_is_that_of_the_level_turned_up_on_the_left(self):
        slope = np.tan(np.radians(25))
        for sign in (1, -1):
            level = slurry_map(lambda x, y, sign=sign: np.where(y < -sign * slope * x - 0.02, 1.0, 0.0))
            tilt, deviation, _ = surface_line(level, RADIUS - WALL)
            self.assertAlmostEqual(tilt, sign * 25, delta=0.5)
            self.assertLess(deviation, 0.001)

    def test_a_surface_is_off_by_no_more_than_its_resolution(self):
        # Straight surfaces at random heights and tilts, whose deviation from a line is 0
        random, step = np.random.default_rng(3), 2 * RADIUS / 150
        found = []
        for tilt, level in zip(random.uniform(-5, 5, 200), random.uniform(-0.06, 0.0, 200)):
            slope = np.tan(np.radians(tilt))
            read = surface_line(slurry_map(lambda x, y, slope=slope, level=level: np.where(
                y < -slope * x + level, 1.0, 0.0)), RADIUS - WALL)
            resolution = surface_resolution(step, read[2][1] - read[2][0])
            found.append(((read[0] - tilt) / resolution[0], read[1] / resolution[1]))
        for off in np.abs(found).T:
            self.assertLess(np.mean(off > 1.96), 0.05)

    def test_equal_maps_have_the_error_of_their_pixels(self):
        level = slurry_map(lambda x, y: np.where(y < -0.02, 1.0, 0.0))
        case = SimpleNamespace(radius=RADIUS, lifter_height=WALL / slurry_over_time.RING)
        found = run_readings.RunReadings("a", 0.3, 75, None, 20, 5.0, False, 1.0)
        with mock.patch.object(run_readings, "slurry_blocks", lambda _: [level] * 2):
            run_readings.read_maps(case, found)
        step, width = 2 * RADIUS / 150, 2 * np.sqrt((RADIUS - WALL)**2 - 0.02**2)
        self.assertEqual((found.surface.tilt.freedom, found.surface.deviation.freedom), (np.inf, np.inf))
        self.assertAlmostEqual(found.surface.deviation.error, step / 6)
        self.assertAlmostEqual(found.surface.tilt.error, np.degrees(step / width / np.sqrt(3)), delta=0.01)

    def test_a_wavy_surface_deviates(self):
        wavy = slurry_map(lambda x, y: np.where(y < 0.01 * np.sin(100 * x), 1.0, 0.0))
        self.assertAlmostEqual(surface_line(wavy, RADIUS - WALL)[1], 0.01 / np.sqrt(2), delta=0.001)

    def test_without_slurry_there_is_no_surface(self):
        with self.assertRaisesRegex(RuntimeError, "no free surface of the slurry"):
            surface_line(slurry_map(lambda x, y: 0 * x), RADIUS - WALL)

    def test_errors_are_those_of_block_means(self):
        value, error = series_mean(np.repeat([1.0, 2.0, 3.0, 4.0, 5.0], 4))
        self.assertAlmostEqual(float(value), 3)
        self.assertAlmostEqual(float(error), np.std([1, 2, 3, 4, 5], ddof=1) / np.sqrt(5))

    def test_windows_of_the_averaged_time_are_parted(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(slurry_over_time, "read_slurry_map") as read:
            path = Path(folder) / "slurry.h5"
            with h5py.File(path, "w") as file:
                file["window/begin"] = 1 + 0.05 * np.arange(12)
                file["window/end"] = 1.05 + 0.05 * np.arange(12)
            case = SimpleNamespace(begin=0.3, last=0.6, length=0.1, omega=-6.0, slurry=path, turn=1.05,
                                   flow=SimpleNamespace(time0=1.0))
            list(slurry_over_time.slurry_blocks(case))
            parts = [call.args[1:3] for call in read.call_args_list]
            np.testing.assert_allclose(parts, [(1.3, 1.4), (1.4, 1.45), (1.45, 1.5), (1.5, 1.55), (1.55, 1.6)])
            case.turn = 0.1  # three whole turns
            read.reset_mock()
            list(slurry_over_time.slurry_blocks(case))
            parts = [call.args[1:3] for call in read.call_args_list]
            np.testing.assert_allclose(parts, [(1.3, 1.4), (1.4, 1.5), (1.5, 1.6)])
            case.begin = 0.35  # two of them, and a half that is left out
            read.reset_mock()
            list(slurry_over_time.slurry_blocks(case))
            parts = [call.args[1:3] for call in read.call_args_list]
            np.testing.assert_allclose(parts, [(1.4, 1.5), (1.5, 1.6)])
            case.begin = 0.58
            with self.assertRaisesRegex(RuntimeError, "slurry.h5: no window from DEM time 1.58 to 1.6 s"):
                list(slurry_over_time.slurry_blocks(case))

    def test_written_times_are_parted_where_there_is_no_slurry_file(self):
        frames = [(0.1 * k, f"time {k}") for k in range(11)]
        case = SimpleNamespace(begin=0.5, last=1.0, slurry=None, turn=1.05,
                               flow=SimpleNamespace(time0=0.0, frames=frames))
        with mock.patch.object(slurry_over_time, "mean_flow", lambda flow, begin: [path for _, path in flow.frames]):
            parts = list(slurry_over_time.slurry_blocks(case))
            case.turn = 0.2
            turns = list(slurry_over_time.slurry_blocks(case))
        self.assertEqual(parts, [["time 5", "time 6"], ["time 7"], ["time 8"], ["time 9"], ["time 10"]])
        self.assertEqual(turns, [["time 7", "time 8"], ["time 9", "time 10"]])

    def test_many_turns_are_parted_into_five(self):
        case = SimpleNamespace(begin=0.0, last=12.0, turn=1.0)
        parts = slurry_over_time.parts_of(case, np.arange(0.25, 12, 0.5))
        self.assertEqual([len(part) for part in parts], [6, 6, 4, 4, 4])

    def test_tables_of_function_objects_are_taken_from_the_beginning_of_the_averages_on(self):
        times = np.array([1.0, 2.0, 3.0])
        tables = {"height": [[9, 9], [-1, 0], [-3, -4]], "holdUp": [[1, 1], [1, 0], [1, 1]],
                  "p_rgh": [[9, 9], [5, 0], [7, 8]]}
        case = SimpleNamespace(begin=2.0,
                               axial=lambda name: (np.array([0.1, 0.2]), times, np.array(tables[name], float)))
        found = slurry_over_time.read_series(case)
        np.testing.assert_array_equal(found.times, [2, 3])
        np.testing.assert_array_equal(found.height, [[-1, np.nan], [-3, -4]])
        np.testing.assert_array_equal(found.pressure, [[5, np.nan], [7, 8]])
        self.assertAlmostEqual(height(run(series=found)).value, (-1 - 3.5) / 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
