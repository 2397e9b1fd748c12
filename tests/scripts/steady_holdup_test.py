#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study steady_holdup: exponents, models, groups of flows, and its table."""
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from millfoam.readings import models
from millfoam.readings.means import Mean, turns_mean
from millfoam.readings.residence import Residence
from report_cases import PRINTS, change_json, write_flow, write_json

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "studies" / "steady_holdup"))

import steady_holdup as study  # noqa: E402, in the study's folder
from held_flows import (Held, HoldUps, Kind, Stay, Trial, at_feed, change_of_flow, change_of_trial,  # noqa: E402
                        complete_case, expected_volume, late_turns, read_all, read_held, scatter, with_relaxation)

FEEDS = (33e-6, 65e-6, 131e-6)


def mill(speed=0.75, discharge_radius=0.0467):
    """What the study reads of the 30 cm mill."""
    grates = {"inner_radius_m": 0.09, "outer_radius_m": 0.13, "sector_share": 0.8, "open_fraction": 0.3, "pegged": 0.5}
    derived = {("charge", "resting_solidity"): 0.55, ("charge", "pore_volume_m3"): 3e-3,
               **{("geometry", "grates", key): value for key, value in grates.items()}}
    return SimpleNamespace(radius=0.15, length=0.305, sauter_diameter=0.005, discharge_radius=discharge_radius,
                           critical_share=speed, derived=lambda *keys: derived[keys],
                           slurry={"plastic_viscosity_Pa_s": 0.0013, "density_kg_m3": 1148}.__getitem__)


def held(name, feed, volume, law="Beetstra", mesh="coarse", error=1e-5, whole=1.1, **of_mill):
    case = SimpleNamespace(mill=mill(**of_mill), law=law, flow=SimpleNamespace(mesh=SimpleNamespace(cells=9515)))
    one = Mean(volume, error)
    return Held(mesh, name, case, feed, 10, Mean(whole * volume, error), one, Mean(feed, 1e-7), Mean(-0.05, 1e-4), 20.0,
                "steady", "holds")


def trial(volume, discharge, kind=Kind(75, True), error=1e-6):
    return Trial(kind, volume, 0.8 * volume, Mean(discharge, error))


class Exponents(unittest.TestCase):
    def test_a_power_is_found_with_the_error_of_its_points(self):
        volumes = [Mean(2e-3 * (feed / 65e-6)**0.4, 2e-5) for feed in FEEDS]
        slope, offset = study.exponent(FEEDS, volumes)
        self.assertAlmostEqual(slope.value, 0.4, places=9)
        self.assertAlmostEqual(np.exp(offset) * (65e-6)**slope.value, 2e-3, places=9)
        # Errors of 1 % at both ends of a factor of four, about
        self.assertAlmostEqual(slope.error, 0.01 * np.sqrt(2) / np.log(131 / 33), delta=0.003)

    def test_points_off_the_line_make_it_less_certain(self):
        exact = [Mean(2e-3 * (feed / 65e-6)**0.4, 1e-6) for feed in FEEDS]
        bent = [exact[0], Mean(1.1 * exact[1].value, 1e-6), exact[2]]
        self.assertGreater(study.exponent(FEEDS, bent)[0].error, 50 * study.exponent(FEEDS, exact)[0].error)

    def test_three_points_off_the_line_have_one_degree_of_freedom(self):
        exact = [Mean(2e-3 * (feed / 65e-6)**0.4, 1e-6) for feed in FEEDS]
        bent = [exact[0], Mean(1.1 * exact[1].value, 1e-6), exact[2]]
        self.assertEqual(study.exponent(FEEDS, exact)[0].freedom, np.inf)
        self.assertEqual(study.exponent(FEEDS, bent)[0].freedom, 1)
        # Of the errors of both, each of 4
        self.assertAlmostEqual(study.exponent(FEEDS[::2], [replace(one, error=0.01 * one.value, freedom=4)
                                                           for one in exact[::2]])[0].freedom, 8)

    def test_one_feed_has_none(self):
        with self.assertRaisesRegex(ValueError, "1 feeds"):
            study.exponent(FEEDS[:1], [Mean(1e-3, 1e-6)])


class Models(unittest.TestCase):
    def test_pegged_holes_do_not_count(self):
        volume = np.pi * 0.15**2 * 0.305
        area = np.pi * (0.13**2 - 0.09**2) * 0.8 * 0.3 * 0.5
        expected = models.grate_hold_up(65e-6, 0.3, models.mean_grate_radius(0.09, 0.13), area, 0.75, 3e-3 / volume)
        self.assertAlmostEqual(study.model_holdups(mill(), 65e-6)["Morrell & Stephenson"] / volume, expected, places=12)

    def test_hold_more_with_more_feed(self):
        less, more = (study.model_holdups(mill(), feed) for feed in FEEDS[::2])
        for name in less:
            self.assertGreater(more[name], less[name])


class Trials(unittest.TestCase):
    def expected(self, feed, *points):
        trials = [Trial(Kind(75, True), volume, volume, Mean(discharge, 1e-6)) for volume, discharge in points]
        return expected_volume(feed, trials)

    def test_the_hold_up_is_where_the_line_has_the_feed(self):
        self.assertAlmostEqual(self.expected(65e-6, (7e-3, 115e-6), (4e-3, 25e-6)), 7e-3 - 50 / 30e3, places=12)
        self.assertAlmostEqual(self.expected(10e-6, (4e-3, 25e-6), (7e-3, 115e-6)), 4e-3 - 15 / 30e3, places=12)

    def test_the_hold_up_stays_near_the_trials(self):
        self.assertAlmostEqual(self.expected(1e-3, (7e-3, 115e-6), (4e-3, 25e-6)), 1.5 * 7e-3)
        self.assertAlmostEqual(self.expected(1e-6, (7e-3, 115e-6), (4e-3, 100e-6)), 0.2 * 7e-3)

    def test_without_a_slope_it_is_between_them(self):
        self.assertAlmostEqual(self.expected(65e-6, (7e-3, 60e-6), (4e-3, 70e-6)), 5.5e-3)

    def test_they_are_listed(self):
        trials = [trial(4e-3, 7e-5, Kind(75, True), error=2e-6), trial(5e-3, 6e-5, Kind(75, False)),
                  trial(4e-3, 6e-5, Kind(75, False, "wide_lifters"))]
        self.assertEqual(list(study.trial_lines(trials)),
                         ["trial at 75 %, without balls: 5.000 l discharge 60.0 ± 1.0 ml/s",
                          "trial at 75 %, without balls, wide_lifters: 4.000 l discharge 60.0 ± 1.0 ml/s",
                          "trial at 75 %, with balls: 4.000 l discharge 70.0 ± 2.0 ml/s"])


class LateTurns(unittest.TestCase):
    def test_are_those_of_the_last_half_and_at_least_those_that_were_judged(self):
        for judged, end, turns in ((12.0, 20.0, 6), (12.0, 40.0, 10), (11.99, 16.0, 6), (0.5, 0.9, 1)):
            self.assertEqual(late_turns(judged, end, turn=2.0), turns)


class RelaxingFlow(unittest.TestCase):
    TRIALS = (trial(5e-3, 1e-4), trial(3e-3, 4e-5))

    def flow(self, turns, seed=1):
        """Turns of 1 s with independent discharges, 100 times in each, of a mill that discharges 60 ml/s more with 2 l
        more."""
        random, times = np.random.default_rng(seed), np.arange(100 * turns + 1) / 100
        held_so_far, discharge, holdup = 4e-3, np.empty(len(times)), np.empty(len(times))
        for k in range(len(times)):
            if k % 100 == 0:
                by_chance = random.normal(0, 8e-6)
            discharge[k] = 65e-6 + by_chance + (held_so_far - 4e-3) * 6e-5 / 2e-3
            held_so_far += (65e-6 - discharge[k]) / 100
            holdup[k] = held_so_far
        case = SimpleNamespace(mill=mill(), law="Beetstra", turn=1.0, balance={
            "Time": times, "discharge": discharge, "holdUp": holdup})
        return replace(held("Beetstra_75_65", 65e-6, 4e-3), case=case, end=float(turns), turns=turns)


class TurnsScatter(RelaxingFlow):
    def test_the_hold_up_s_follows_from_the_discharge_s(self):
        found = scatter(self.flow(3000), self.TRIALS)
        self.assertAlmostEqual(found.discharge, 8e-6, delta=4e-7)
        self.assertAlmostEqual(found.expected, 8e-6 * np.sqrt(0.5 * 2e-3 / 6e-5), delta=2e-6)
        self.assertAlmostEqual(found.holdup / found.expected, 1, delta=0.1)

    def test_of_few_turns_it_is_about_their_own_mean(self):
        found = [scatter(self.flow(25, seed), self.TRIALS) for seed in range(200)]
        ratio = np.sqrt(np.mean([(one.holdup / one.expected)**2 for one in found]))
        self.assertAlmostEqual(ratio, 1, delta=0.2)
        # An endless series scatters more
        self.assertLess(np.mean([one.expected for one in found]), 0.7 * 8e-6 * np.sqrt(0.5 * 2e-3 / 6e-5))

    def test_it_is_listed_for_more_than_one_turn_and_with_trials(self):
        flow = self.flow(20)
        self.assertRegex("".join(study.scatter_lines([flow], self.TRIALS)), r"^coarse/Beetstra_75_65: 20 turns scatter "
                         r"by \d\.\d ml/s and \d+ ml; independent discharges give \d+ ml$")
        self.assertEqual(list(study.scatter_lines([flow], ())), [])
        self.assertEqual(list(study.scatter_lines([replace(flow, turns=1)], self.TRIALS)), [])


class LateErrors(RelaxingFlow):
    """Errors of hold-ups over late turns, of a mill whose hold-up relaxes over 33 turns."""

    def test_cover_the_steady_hold_up(self):
        within, plainly = [], []
        for seed in range(60):
            flow = self.flow(300, seed)
            columns = flow.case.balance
            table = np.zeros(1), columns["Time"], 0.8 * columns["holdUp"][:, None]
            case = SimpleNamespace(**vars(flow.case), axial=lambda _, table=table: table)
            flow = replace(flow, turns=12, case=case)
            found, plain = with_relaxation(flow, self.TRIALS), turns_mean(flow.of_turns("holdUp"))
            within.append(abs(found.whole.value - 4e-3) < found.whole.reach)
            # Without the trials, and with one degree of freedom less than turns
            plainly.append(abs(plain.value - 4e-3) < Mean(plain.value, plain.error, 11).reach)
            self.assertAlmostEqual(found.chamber.error / found.whole.error, 0.8)
        self.assertGreater(np.mean(within), 0.9)
        self.assertLess(np.mean(plainly), 0.7)

    def test_without_trials_are_those_of_its_turns(self):
        flow = self.flow(20)
        self.assertIs(with_relaxation(flow, ()), flow)


class SteadyHoldUps(unittest.TestCase):
    """Trials of 40 and 100 ml/s at 3 and 5 l: 2 l for 60 ml/s, of which 1.6 l are in front of the grates."""
    TRIALS = (trial(5e-3, 1e-4), trial(3e-3, 4e-5))

    def one(self, discharge, error=0.0, name="Beetstra_75_65"):
        return replace(held(name, 65e-6, 3.4e-3, error=0.0, whole=1.2), discharge=Mean(discharge, error))

    def test_are_where_the_line_through_the_trials_has_the_feed(self):
        found = at_feed(self.one(59e-6), self.TRIALS)
        self.assertAlmostEqual(found.whole.value, 1.2 * 3.4e-3 + 6 / 60 * 2e-3, places=12)
        self.assertAlmostEqual(found.chamber.value, 3.4e-3 + 6 / 60 * 1.6e-3, places=12)
        self.assertLess(at_feed(self.one(68e-6), self.TRIALS).whole.value, 1.2 * 3.4e-3)

    def test_have_the_errors_of_hold_up_discharge_and_slope(self):
        whole = at_feed(self.one(65e-6, 3e-6), self.TRIALS).whole
        self.assertAlmostEqual(whole.value, 1.2 * 3.4e-3, places=12)
        self.assertAlmostEqual(whole.error, 3 / 60 * 2e-3, places=12)
        of_slope = at_feed(self.one(35e-6), self.TRIALS).whole.error
        self.assertAlmostEqual(of_slope, 30 / 60 * 2e-3 * np.sqrt(2) / 60, places=12)
        held_worse = replace(self.one(65e-6), whole=Mean(4e-3, 5e-5))
        self.assertAlmostEqual(at_feed(held_worse, self.TRIALS).whole.error, 5e-5, places=12)

    def test_have_the_degrees_of_freedom_of_what_they_are_made_of(self):
        few = tuple(replace(one, discharge=replace(one.discharge, freedom=2)) for one in self.TRIALS)
        # Both trials have the same error, of two degrees each: their difference has four
        self.assertAlmostEqual(at_feed(self.one(35e-6), few).whole.freedom, 4)
        worse = replace(self.one(65e-6), whole=Mean(4e-3, 5e-5, 5))
        self.assertAlmostEqual(at_feed(worse, few).whole.freedom, 5)
        flow = replace(self.one(65e-6), discharge=Mean(65e-6, 3e-6, 7))
        self.assertAlmostEqual(at_feed(flow, few).whole.freedom, 7)

    def test_trials_of_few_turns_must_differ_by_students_factor(self):
        # 20 ml/s apart, with an error of 5: four errors, of which two turns each need 4.3
        def pair(freedom):
            return tuple(replace(one, discharge=Mean(value, 5e-6 / np.sqrt(2), freedom))
                         for one, value in zip(self.TRIALS, (6e-5, 4e-5) if self.TRIALS[0].volume
                                               > self.TRIALS[1].volume else (4e-5, 6e-5)))
        self.assertIsNone(at_feed(self.one(59e-6), pair(1)))
        self.assertIsNotNone(at_feed(self.one(59e-6), pair(5)))

    def test_need_both_trials_of_their_mill_and_more_discharge_of_more_slurry(self):
        for trials in ((), self.TRIALS[:1], tuple(replace(one, kind=Kind(60, True)) for one in self.TRIALS),
                       (trial(5e-3, 4e-5), trial(3e-3, 4e-5)), (trial(5e-3, 42e-6), trial(3e-3, 4e-5))):
            self.assertIsNone(at_feed(self.one(59e-6), trials))
        self.assertIsNone(at_feed(self.one(59e-6, name="Beetstra_75_65_layers_17"), self.TRIALS))

    def test_are_compared_only_if_both_flows_have_them(self):
        base, wide = (held(f"fluid_75_65{change}", 65e-6, volume, law=None)
                      for change, volume in (("", 4e-3), ("_wide_lifters", 4.4e-3)))
        base = replace(base, steady=HoldUps(Mean(9e-3, 1e-5), Mean(8e-3, 1e-5)))
        self.assertIn("hold-up over the late turns in front of the grates +10.00",
                      "\n".join(study.lines_of([base, wide])))
        wide = replace(wide, steady=HoldUps(Mean(9e-3, 1e-5), Mean(8.8e-3, 1e-5)))
        self.assertIn("hold-up in front of the grates +10.00", "\n".join(study.lines_of([base, wide])))

    def test_are_in_the_table_the_exponent_and_the_comparisons(self):
        flows = [replace(one, steady=HoldUps(one.whole, Mean(2e-3 * (one.feed / 65e-6)**0.3, 1e-5)))
                 for one in (held(f"Beetstra_75_{1e6 * feed:.0f}", feed, 2e-3) for feed in FEEDS)]
        high = held("Beetstra_75_65_high", 65e-6, 2.2e-3)
        flows.append(replace(high, steady=HoldUps(Mean(2.2e-3, 1e-5), high.chamber)))
        text = "\n".join(study.lines_of(flows))
        self.assertIn("~ feed^0.300", text)
        self.assertIn("coarse/Beetstra_75_65_high: hold-up +0.00 ", text)
        self.assertEqual([row["steady, in front of the grates, l"] for row in study.rows_of(flows)][1], 2.0)


class Names(unittest.TestCase):
    def test_say_what_is_changed(self):
        for name, change in (("Beetstra_75_65", ""), ("fluid_75_65_layers_17", "layers_17"),
                             ("fluid_75_65_low", ""), ("Beetstra_75_65_high", "")):
            self.assertEqual(change_of_flow(name), change)
        for name, change in (("Beetstra_75_level", ""), ("fluid_75_layers_17_less", "layers_17")):
            self.assertEqual(change_of_trial(name), change)


class Stays(unittest.TestCase):
    def test_they_are_compared_with_hold_up_over_feed(self):
        found = Residence(*np.zeros((3, 1)), mean=33.0, variance=33.0**2 / 2, left=0.13, tail=30.0)
        (line,) = study.stay_lines([Stay("Beetstra_75_131", found, 30.0, -6e-5, 1 + 4e-7)])
        begin = ("residence/Beetstra_75_131: slurry stays 33.0 s, +10.0 % from hold-up over feed, 30.0 s; 2.00 stirred "
                 "tanks in series, Pe ")
        self.assertTrue(line.startswith(begin), line)
        self.assertTrue(line.endswith("; 13 % had not left; concentration from -6.0e-05 to 1 +4.0e-07"), line)

    def test_a_flow_that_is_not_complete_is_named(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "residence" / "Beetstra_75_131").mkdir(parents=True)
        *_, missing = read_all(folder)
        self.assertEqual(len(missing), 1)
        self.assertTrue(missing[0].startswith("residence/Beetstra_75_131: "), missing)


class OtherMills(unittest.TestCase):
    """Results in the folder of a mill that has changed since."""

    def setUp(self):
        self.folder = write_flow(Path(self.enterContext(tempfile.TemporaryDirectory())) / "coarse" / "flow")
        write_json(self.folder / "steady.json", "steady", tuple(PRINTS), reason="steady", begin_s=0.4, end_s=0.8,
                   found="holds")

    def test_flows_of_the_mill_are_read(self):
        self.assertEqual(read_held("coarse", self.folder).reason, "steady")
        self.assertEqual(complete_case(self.folder).folder, self.folder)

    def test_an_end_of_another_mill_is_none(self):
        change_json(self.folder / "steady.json", "mill", "flow", to="f" * 16)
        with self.assertRaisesRegex(RuntimeError, "the flow of mill.json has not come to its end: steady.json belongs"):
            read_held("coarse", self.folder)

    def test_a_flow_or_charge_of_another_mill_is_none(self):
        for file, part, words in (("postProcessing/flow/0/flow.json", "flow", "run the flow again"),
                                  ("dumps/results.json", "charge", "run millDem again")):
            change_json(self.folder / file, "mill", part, to="f" * 16)
            for read in (complete_case, lambda folder: read_held("coarse", folder)):
                with self.assertRaisesRegex(RuntimeError, f"its mill has changed: .*{file} has .*{words}"):
                    read(self.folder)
            change_json(self.folder / file, "mill", part, to=PRINTS[part])


class Table(unittest.TestCase):
    def test_groups_have_their_exponent_and_starts_are_compared(self):
        flows = [held(f"Beetstra_75_{1e6 * feed:.0f}", feed, 2e-3 * (feed / 65e-6)**0.5) for feed in FEEDS]
        flows += [held("Beetstra_75_65_high", 65e-6, 2.002e-3), held("fluid_75_65", 65e-6, 5e-3, law=None)]
        text = "\n".join(study.lines_of(flows))
        self.assertIn("coarse, 75 %, with balls: hold-up in front of the grates ~ feed^0.500", text)
        self.assertIn("(3 feeds)", text)
        self.assertNotIn("without balls: hold-up", text)  # a single feed
        self.assertRegex(text, r"coarse/Beetstra_75_65_high: hold-up over the late turns \+0\.10 ± 0\.\d\d % from "
                         "Beetstra_75_65's")

    def test_errors_of_few_degrees_of_freedom_say_so(self):
        base, high = (replace(held(name, 65e-6, volume, law=None), whole=Mean(1.1 * volume, 1e-5, 4))
                      for name, volume in (("fluid_75_65", 4e-3), ("fluid_75_65_high", 4.04e-3)))
        lines = list(study.lines_of([base, high]))
        self.assertIn("4.400 ± 0.010 (4)", lines[1])
        self.assertRegex(lines[-1], r"\+1\.00 ± 0\.32 %, 95 %: ± 0\.74, from fluid_75_65's")
        self.assertEqual(next(study.rows_of([base]))["hold-up, l, freedom"], 4)

    def test_a_high_start_is_compared_with_a_low_one(self):
        flows = [held("fluid_75_65_low", 65e-6, 4e-3, law=None), held("fluid_75_65_high", 65e-6, 4.04e-3, law=None)]
        lines = list(study.comparisons(flows))  # each of 4.4 l with an error of 0.01 l
        self.assertEqual(lines[0], "coarse/fluid_75_65_low: no flow to compare it with is complete")
        self.assertTrue(lines[1].startswith("coarse/fluid_75_65_high: hold-up over the late turns +1.00 ± 0.32 % from "
                                            "fluid_75_65_low's"), lines)
        self.assertEqual(len(lines), 2)

    def test_an_exponent_names_few_degrees_of_freedom_and_flows_that_were_not_steady(self):
        flows = [held(f"Beetstra_75_{1e6 * feed:.0f}", feed, 2e-3 * (1 + 0.2 * (feed == 65e-6))) for feed in FEEDS]
        flows[2] = replace(flows[2], reason="duration")
        self.assertRegex("\n".join(study.lines_of(flows)), r"~ feed\^\S+ ± \S+ \(3 feeds; error of 1 degree of "
                         r"freedom: 95 % within ± [\d.]+; Beetstra_75_131 ended by duration\)")

    def test_a_changed_mill_is_compared_with_its_base_and_has_no_exponent(self):
        flows = [held("Beetstra_75_65", 65e-6, 3e-3),
                 *(held(f"fluid_75_{name}", 1e-6 * float(name.split("_")[0]), volume, law=None, whole=whole)
                   for name, volume, whole in (("65", 4e-3, 1.1), ("65_wide_lifters", 4.4e-3, 1.0),
                                               ("131", 5e-3, 1.1)))]
        lines = list(study.lines_of(flows))
        self.assertTrue(any(line.startswith("coarse/fluid_75_65_wide_lifters: hold-up over the late turns in "
                                            "front of the grates +10.00 ± "
                                            "0.35 % from fluid_75_65's") for line in lines), lines)
        self.assertTrue(any("without balls: hold-up" in line and "(2 feeds)" in line for line in lines), lines)

    def test_a_mill_without_pulp_lifters_has_no_hold_up_by_moys(self):
        flows = [held("Beetstra_75_65", 65e-6, 3e-3),
                 held("Beetstra_75_65_open_grates", 65e-6, 3.3e-3, whole=1.0, discharge_radius=None)]
        base, changed = study.rows_of(flows)
        self.assertIn("Moys, l", base)
        self.assertNotIn("Moys, l", changed)
        self.assertIn("Morrell & Stephenson, l", changed)
        self.assertIn("+10.00", "\n".join(study.lines_of(flows)))

    def test_a_flow_without_its_base_says_so(self):
        text = "\n".join(study.lines_of([held("fluid_75_65_wide_lifters", 65e-6, 4e-3, law=None)]))
        self.assertIn("coarse/fluid_75_65_wide_lifters: no flow to compare it with is complete", text)

    def test_flows_that_have_not_ended_are_named(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "own" / "fluid_60_33").mkdir(parents=True)
        found = read_all(folder)
        self.assertEqual(found, ([], [], [], ["own/fluid_60_33: the flow has not come to its end"]))


if __name__ == "__main__":
    unittest.main()
