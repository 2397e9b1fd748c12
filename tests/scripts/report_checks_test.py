#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every check of the report's verdict list holds, looks or fails on the right side of its limit, and says what to
do."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np

from millfoam.files.flow_record import FlowRecord
from millfoam.files.mill_case import MillCase
from millfoam.readings.batches import batches_of, error_over_turns
from millfoam.report import checks
from millfoam.report.steadiness import gap_of_feed, halves
from millfoam.report.verdict import judged
from report_cases import PRINTS, change_json, write_dry, write_flow

LIMITS = {"maxCo": 0.5, "maxAlphaCo": 0.4, "maxAirCo": 3, "maxVoidageChange": 0.1}


def case(**parts):
    """What checks read of a MillCase; steps: column -> values; limits: of the last start; files: name -> content."""
    steps, limits, files = (parts.pop(key, None) for key in ("steps", "limits", "files"))
    feed = parts.pop("feed", 0.0)
    record = FlowRecord(steps, [(Path("flow.json"), {"limits": limits})] if limits else [])
    results = parts.get("results") or {}
    mill = SimpleNamespace(fingerprint={}, flow=lambda key, default=None: {"feed_m3_s": feed}.get(key, default))
    return SimpleNamespace(**{"begin": 2.0, "radius": 0.15, "turn": 9.0, "mill": mill, "machine": "tumbling",
                              "unusable": [], "results": None, "averages": None,
                              "solids": None, "slurry": None, "flow": None, "law": None, "balance": None,
                              "folder": Path(),
                              "charge_folders": [], "record": record, "result": results.get,
                              "json": lambda path, _: (files or {}).get(path.name), **parts})


class Verdicts(unittest.TestCase):
    def check(self, check, state):
        self.assertEqual(check.state, state, check)
        self.assertTrue(check.found, check)
        self.assertTrue(check.advice or state == "holds", check)

    def solids(self, fields):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        with h5py.File(Path(folder) / "solids.h5", "w") as file:
            for name, values in fields.items():
                file[name] = np.asarray(values, dtype=float)
        return case(solids=Path(folder) / "solids.h5")


class Numbers(Verdicts):
    def test_a_value_holds_up_to_its_limit_is_doubtful_up_to_the_next_and_fails_beyond(self):
        for value, state in ((1.0, "holds"), (1.001, "look"), (2.0, "look"), (2.001, "fails"),
                             (np.nan, "fails"), (np.inf, "fails")):
            self.check(judged("name", value, 1, "found", "do", doubtful=2), state)
        self.check(judged("name", 1.001, 1, "found", "do"), "fails")


class Contacts(Verdicts):
    def test_they_must_dissipate_what_the_drive_gives_to_1_per_cent(self):
        for ratio, state in ((0.9901, "holds"), (1.0099, "holds"), (1.02, "look"), (0.94, "fails"), (np.nan, "fails")):
            self.check(checks.contact_balance(case(result=lambda *keys, found=ratio: found)), state)


class Flow(Verdicts):
    def test_slurry_that_is_missing(self):
        for missing, state in ((0.9e-13, "holds"), (-0.9e-13, "holds"), (1.1e-13, "fails"), (-1.1e-13, "fails"),
                               (np.nan, "fails")):
            columns = {"missing": np.array([0, missing]), "holdUp": np.array([1e-3, 1e-3])}
            self.check(checks.conservation(case(balance=columns)), state)
        self.check(checks.conservation(case()), "unknown")

    def test_time_that_the_averages_do_not_cover(self):
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "slurry.h5"
        for covered, state in (({}, "unknown"), ({"duration": 2.0}, "holds"), ({"duration": 1.999}, "holds"),
                               ({"duration": 1.997}, "fails")):
            with h5py.File(path, "w") as file:
                file.attrs.update(complete=1, version=2)
                file.create_group("mean").attrs.update(begin=3.0, end=5.0, **covered)
            self.check(checks.averaged_time(case(slurry=path)), state)

    def test_a_feed_that_is_not_as_asked(self):
        time = np.linspace(0.1, 6, 60)
        for error, state in ((0.0, "holds"), (0.9e-6, "holds"), (-0.9e-6, "holds"), (1.1e-6, "fails"),
                             (-1.1e-6, "fails"), (np.nan, "fails")):
            columns = {"Time": time, "fed": 6e-5 * (1 + error) * time}
            self.check(checks.fed_as_asked(case(balance=columns, feed=6e-5)), state)
        # Too much for a while, and then too little
        columns = {"Time": time, "fed": 6e-5 * (time + 1e-4 * np.sin(np.pi * time / 6))}
        self.check(checks.fed_as_asked(case(balance=columns, feed=6e-5)), "fails")
        self.check(checks.fed_as_asked(case(feed=6e-5)), "unknown")

    def test_only_a_mill_with_a_feed_is_asked_for_it(self):
        for feed, expected in ((6e-5, True), (0.0, False)):
            mill = case(flow=True, feed=feed)
            mill.mill.slurry = {"yield_stress_Pa": 0}.get
            names = [one.name for one in checks.all_checks(mill)]
            self.assertEqual("Fed as asked" in names, expected)

    def steadiness(self, drift=0.0, noise=0.0, machine="tumbling", **others):
        """Of a hold-up of 1 l that drifts by a share of itself in the whole time."""
        time = np.linspace(0, 6, 1201)
        wobble = np.random.default_rng(3).normal(0, 1, time.shape)
        columns = {"Time": time, "holdUp": 1e-3 * (1 + drift * time / 4 + noise * wobble), "x": 0 * time,
                   "y": 0 * time, **others}
        return checks.flow_steadiness(case(balance=columns, machine=machine))

    def test_a_drift_of_the_hold_up(self):
        # The second half's mean differs by half of the drift from the first's; 1 % of the hold-up is not a drift that
        # matters
        for drift, state in ((0.0, "holds"), (0.018, "holds"), (0.025, "look"), (-0.025, "look"), (0.05, "fails"),
                             (3.0, "fails")):
            self.check(self.steadiness(drift), state)

    def test_noise_is_no_drift_and_hides_none(self):
        self.check(self.steadiness(noise=0.05), "holds")
        self.check(self.steadiness(1.0, noise=0.2), "fails")

    def test_errors_in_which_a_drift_that_matters_would_not_be_seen_leave_it_undecided(self):
        found = self.steadiness(noise=0.2)
        self.check(found, "look")
        self.assertTrue(found.undecided)
        self.assertRegex(found.found, r"undecided: 3 standard errors of the hold-up are [\d.]+ %, more than 2 %$")
        self.assertIn("Run longer", found.advice)
        # Nor is a drift that is seen, or none in quiet slurry
        for drift, noise in ((1.0, 0.2), (0.025, 0.0), (0.0, 0.0)):
            self.assertFalse(self.steadiness(drift, noise=noise).undecided)

    def test_a_discharge_off_by_a_tenth_is_not_the_feed_however_much_turns_scatter(self):
        states = []
        for seed in range(100):
            of_turns = 1e-5 * (0.9 + 0.2 * np.random.default_rng(seed).normal(0, 1, 6))
            time, rate = np.linspace(0, 18, 1801), np.append(np.repeat(of_turns, 300), of_turns[-1])
            columns = {"Time": time, "holdUp": 1e-3 + 0 * time, "x": 0 * time, "y": 0 * time,
                       "fed": 1e-3 + 1e-5 * time, "discharged": np.cumsum(rate) * 0.01, "discharge": rate}
            states.append(checks.flow_steadiness(case(balance=columns, feed=1e-5, turn=3.0, begin=0.0)).state)
        self.assertLess(states.count("holds"), 10)

    def test_a_torque_that_rises_by_a_tenth_is_not_steady_however_much_turns_scatter(self):
        states = []
        for seed in range(100):
            turns = 1 + np.linspace(-0.05, 0.05, 6) + 0.05 * np.random.default_rng(seed).normal(0, 1, 6)
            time = np.linspace(2, 20, 1801)
            columns = {"Time": time, "holdUp": 1e-3 + 0 * time, "z": 0 * time,
                       "torque_impeller": 0.02 * np.append(np.repeat(turns, 300), turns[-1])}
            states.append(checks.flow_steadiness(case(balance=columns, machine="stirred", turn=3.0)).state)
        self.assertLess(states.count("holds"), 10)

    def test_a_centre_that_moves_or_is_unknown(self):
        time = np.linspace(0, 6, 1201)
        self.check(self.steadiness(y=-0.01 * time), "fails")
        self.check(self.steadiness(x=np.full(1201, np.nan)), "fails")

    def test_a_stirred_mill_has_the_height_of_the_centre_and_the_torque_of_its_impeller(self):
        time = np.linspace(0, 6, 1201)
        still, torque = 0 * time, np.full(1201, 0.02)
        self.check(self.steadiness(machine="stirred", z=still, torque_impeller=torque, y=-0.01 * time), "holds")
        self.check(self.steadiness(machine="stirred", z=0.01 * time, torque_impeller=torque), "fails")
        falling = self.steadiness(machine="stirred", z=still, torque_impeller=0.02 * (1 - 0.05 * time))
        self.check(falling, "fails")
        self.assertIn("torque of the impeller", falling.found)

    def test_too_few_times_or_none_are_unknown(self):
        time = np.linspace(0, 2.1, 30)
        self.check(checks.flow_steadiness(case(balance={"Time": time, "holdUp": 1 + time, "x": time, "y": time})),
                   "unknown")
        self.check(checks.flow_steadiness(case()), "unknown")

    def test_a_discharge_that_is_not_the_feed(self):
        time = np.linspace(0, 30, 3001)
        fed = 1e-3 + 1e-5 * time  # as much as the mill holds, before these times
        of_turns = np.random.default_rng(3).normal(0, 1, 10)
        noise = np.append(np.repeat(of_turns - of_turns.mean(), 300), 0)
        for gap, wobble, state in ((0.01, 0, "holds"), (0.03, 0, "look"), (-0.03, 0, "look"), (0.2, 0, "fails"),
                                   (0.03, 0.03, "holds"), (0.03, 0.3, "look")):
            rate = 1e-5 * (1 - gap + wobble * noise)
            columns = {"Time": time, "holdUp": 1e-3 + 0 * time, "x": 0 * time, "y": 0 * time, "fed": fed,
                       "discharged": np.cumsum(rate) * 0.01, "discharge": rate}
            self.check(checks.flow_steadiness(case(balance=columns, feed=1e-5, turn=3.0)), state)

    def test_slurry_that_the_feed_has_not_replaced_yet_is_doubtful(self):
        time = np.linspace(0, 30, 3001)
        steady = {"Time": time, "holdUp": 1e-3 + 0 * time, "x": 0 * time, "y": 0 * time}
        for replaced, state, words in ((0.001, "look", "slurry 0.001 times"), (0.3, "look", "slurry 0.3 times"),
                                       (0.98, "look", "slurry 0.98 times"), (1.02, "holds", "slurry 1 times")):
            rate = replaced * 1e-3 / 30
            columns = {**steady, "fed": rate * time, "discharged": rate * time, "discharge": np.full(3001, rate)}
            found = checks.flow_steadiness(case(balance=columns, feed=rate, turn=3.0))
            self.check(found, state)
            self.assertIn(words, found.found)
        # It forgives no failure
        columns["discharged"] = 0.5 * columns["fed"]
        columns["discharge"] = 0.5 * columns["discharge"]
        self.check(checks.flow_steadiness(case(balance=columns, feed=rate, turn=3.0)), "fails")

    def test_a_mill_without_slurry_or_feed_fails_in_words(self):
        time = np.linspace(0, 30, 3001)
        none = {"Time": time, **dict.fromkeys(("holdUp", "fed", "discharged", "discharge"), 0 * time),
                **dict.fromkeys("xy", np.full(3001, np.nan))}
        with np.errstate(all="raise"):
            empty = checks.flow_steadiness(case(balance=none, feed=1e-5, turn=3.0))
            unfed = checks.flow_steadiness(case(balance={**none, "holdUp": 1e-3 + 0 * time, "y": 0 * time}, feed=1e-5,
                                                turn=3.0))
        for found, words in ((empty, "from 2 s on (9.3 turns) there is no slurry in the mill"),
                             (unfed, "nothing was fed in this time"), (unfed, "centre's x not known")):
            self.check(found, "fails")
            self.assertIn(words, found.found)
            self.assertNotIn("nan", found.found)

    def test_a_discharge_that_still_grows_is_not_the_feed(self):
        time = np.linspace(0, 20, 4001)
        rate = 1e-5 * (1 - np.exp(-(time - 2) / 6))
        columns = {"Time": time, "holdUp": 3e-3 + 0 * time, "x": 0 * time, "y": 0 * time, "fed": 1e-5 * time,
                   "discharged": np.cumsum(rate) * 0.005, "discharge": rate}
        self.check(checks.flow_steadiness(case(balance=columns, feed=1e-5, turn=3.0)), "fails")

    def turns(self, count, part=0.0, drift=0.0, wobble=0.0, turn=1.0):
        """flow_steadiness of a hold-up of 1 l over so many turns and a part of one, that drifts by a share of itself
        in all of that time and comes and goes with every turn."""
        time = np.arange(2.0, 2.0 + (count + part) * turn + 1e-9, turn / 200)
        held = 1e-3 * (1 + drift * (time - 2) / np.ptp(time) + wobble * np.sin(2 * np.pi * time / turn))
        held += 1e-8 * np.random.default_rng(3).normal(0, 1, time.shape)
        return checks.flow_steadiness(case(balance={"Time": time, "holdUp": held, "x": 0 * time, "y": 0 * time},
                                           turn=turn))

    def test_what_comes_back_with_every_turn_is_no_drift(self):
        # Halves of 1.25 turns, … would differ by what is left of the wobble
        for count in (2, 3, 4, 12):
            self.check(self.turns(count, 0.5, wobble=0.15), "holds")

    def test_a_drift_counts_alike_however_many_turns_there_are(self):
        for count, part in ((1, 0.5), (2, 0.0), (2, 0.9), (3, 0.2), (5, 0.5), (10, 0.0), (23, 0.3)):
            for drift, state in ((0.018, "holds"), (0.025, "look"), (0.05, "fails"), (-0.05, "fails")):
                self.check(self.turns(count, part, drift), state)

    def test_batches_are_whole_turns_or_whole_parts_of_them(self):
        for turns, length, count in ((1.9, 0.19, 5), (2, 0.2, 5), (3.9, 0.2, 5), (4, 1 / 3, 6), (8, 0.5, 8),
                                     (10.5, 1, 5), (25, 2, 6)):
            np.testing.assert_allclose(batches_of(3 * turns, 3.0), (3 * length, count), err_msg=str(turns))

    def test_the_error_of_noise_is_what_the_difference_deviates_by(self):
        time = np.arange(0, 12, 1e-2)
        for turn in (1.0, 4.0, 5.0, 100.0):
            found = [halves(time, np.random.default_rng(seed).normal(0, 1, time.shape), 0, turn)
                     for seed in range(200)]
            difference, error = np.sqrt(np.mean([(one.value**2, one.error**2) for one in found], axis=0))
            self.assertAlmostEqual(error / difference, 1, delta=0.15)

    def test_the_error_of_a_mean_is_of_whole_turns(self):
        time = np.arange(0, 6.5 + 1e-9, 1e-2)
        found = []
        for seed in range(200):
            values = np.random.default_rng(seed).normal(0, 1, time.shape) + np.sin(2 * np.pi * time)
            late = time >= 0.5
            found.append((values[late].mean(), error_over_turns(time, values, 0.5, 1.0)))
        spread, error = np.std([mean for mean, _ in found]), np.sqrt(np.mean([error**2 for _, error in found]))
        self.assertAlmostEqual(error / spread, 1, delta=0.15)
        # What comes back with every turn adds no error
        self.assertLess(error_over_turns(time, np.sin(2 * np.pi * time), 0.5, 1.0), 1e-9)
        self.assertTrue(np.isnan(error_over_turns(time, time, 5.0, 1.0)))

    def test_a_discharge_that_is_more_than_the_feed_is_said_so(self):
        time = np.arange(1, 601) * 0.01
        for out, words in ((2.9, "-190 % of the feed (discharges 2.9 times its feed)"), (0.4, "+60 % of the feed")):
            columns = {"Time": time, "fed": time, "discharged": out * time, "discharge": out + 0 * time}
            found = gap_of_feed(columns, 1.0, 4.0).text
            self.assertEqual(found, f"feed minus discharge is {words}")

    def courant(self, steps, limits=None):
        columns = dict(zip(("courant", "courant_surface", "courant_air", "voidage_change"), np.transpose(steps)))
        return checks.courant(case(steps={"time_s": np.arange(len(steps)), **columns}, limits=limits or LIMITS))

    def test_steps_beyond_their_limits(self):
        good, bad = (0.5, 0.4, 3, 0.1), ((1.01, 0.4, 3, 0.1), (0.5, 0.81, 3, 0.1), (0.5, 0.4, 6.1, 0.1),
                                         (0.5, 0.4, 3, 0.21), (0.5, np.nan, 3, 0.1))
        for one in bad:
            for count, state in ((1, "holds"), (3, "look"), (10, "fails")):
                self.check(self.courant([good] * (101 - count) + [one] * count), state)
        self.check(self.courant([(0.99, 0.79, 5.9, 0.199)] * 100), "holds")

    def test_steps_are_judged_by_the_limits_that_are_known(self):
        found = self.courant([(0.55, 0.4, 2, 0.1)] * 100,
                             {"maxCo": 0.5, "maxAlphaCo": 0.4, "maxAirCo": 3, "maxVoidageChange": None}).found
        self.assertEqual(found, "0.0 % of the steps are beyond 2 times their aim (holds up to 1 %, fails above 5 %); "
                                "95 % of the steps are below: Courant number 0.55 (aim 0.5), at the surface 0.4 (aim "
                                "0.4), in air 2 (aim 3), change of voidage 0.1")

    def test_steps_or_limits_that_are_missing_are_unknown(self):
        self.check(checks.courant(case(limits=LIMITS)), "unknown")
        self.check(self.courant([(9, 9, 9, 9)] * 10, {"maxCo": None}), "unknown")

    def test_a_mesh_that_checkMesh_finds_fault_with(self):
        mesh = {"mesh.json": {"quality": {"skewness": {"value": 0.512, "limit": 1.0}}}}
        for ok, state in ((True, "holds"), (False, "fails"), (None, "fails")):
            found = checks.mesh(case(files={"check.json": {"ok": ok}, **mesh}))
            self.check(found, state)
            self.assertIn("skewness 0.512 (limit 1)", found.found)
        self.check(checks.mesh(case(files={"check.json": {"ok": True}})), "holds")
        self.check(checks.mesh(case(files=mesh)), "unknown")


class Charge(Verdicts):
    def test_a_ball_that_is_lost(self):
        for lost, state in ((0, "holds"), (1, "fails")):
            self.check(checks.lost_balls(case(results={"lost_balls": lost, "balls": 10})), state)

    def test_averages_that_begin_before_the_charge_is_steady(self):
        for since, state in ((1.0, "holds"), (2.009, "holds"), (2.011, "look"), (2.4, "look"), (2.6, "fails")):
            results = {"steady": True, "steady_from_s": since}
            self.check(checks.charge_steadiness(case(results=results, solids="solids.h5", charge_span=(2.0, 3.0))),
                       state)
        for since, state in ((20.5, "holds"), (20.7, "look"), (49.0, "look"), (51.0, "fails")):
            results = {"steady": True, "steady_from_s": since}
            self.check(checks.charge_steadiness(case(results=results, solids="solids.h5", charge_span=(20.0, 80.0))),
                       state)
        self.check(checks.charge_steadiness(case(results={"steady": False})), "fails")
        self.check(checks.charge_steadiness(case(results={"steady": True, "steady_from_s": 1})), "holds")

    def test_balls_that_are_too_soft(self):
        for largest, state in ((0.149 * 0.004, "holds"), (0.151 * 0.004, "fails"), (np.nan, "fails")):
            results = {"ball_overlap_largest_m": largest, "ball_overlap_99_m": 1e-5, "smallest_diameter_m": 0.004,
                       "allowed_overlap": 0.15}
            self.check(checks.overlap(case(results=results)), state)

    def test_balls_outside_or_clipped(self):
        for outside, clipped, state in ((0, 0.009, "holds"), (0.009, 0, "holds"), (0.006, 0.006, "fails"),
                                        (0, np.nan, "fails")):
            ledger = {"ledger/volume_in": [1, 1], "ledger/outside": [0, outside], "ledger/clipped": [0, clipped]}
            self.check(checks.ledger(self.solids(ledger)), state)

    def test_averaging_volumes_with_few_or_many_balls(self):
        for balls, state in ((8.1, "holds"), (64, "holds"), (65, "look"), (7.9, "look"), (1.1, "look"), (0.9, "fails")):
            averages = {"balls_per_cell": balls, "balls_of_laws": [8, 64]}
            self.check(checks.averaging_volume(case(solids=Path("solids.h5"), averages=averages)), state)
        self.check(checks.averaging_volume(case(solids=Path("solids.h5"))), "unknown")

    def test_windows_that_are_short(self):
        # A deviation of 0.5 of the mean over the root of the number of records
        for records, state in ((101, "holds"), (99, "look"), (26, "look"), (24, "fails")):
            self.check(checks.window_noise(self.noise(0.5, 0.25, records)), state)
        self.check(checks.window_noise(self.noise(0.2, 0.1, 100)), "unknown")

    def noise(self, solidity, deviation, records):
        shape = (3, 2, 2, 2)
        return self.solids({"window/begin": [0, 1, 2], "window/records": [records] * 3,
                            "solidity": np.full(shape, solidity),
                            "solidity_deviation": np.full(shape, deviation)})


class BallsInTheFlow(Verdicts):
    def test_volume_that_the_flows_mesh_does_not_keep(self):
        for share, state in ((-0.019, "holds"), (-0.021, "look"), (0.049, "look"), (0.051, "fails")):
            steps = {"volume_correction": np.array([0.001, np.nan, share, 0.005])}
            self.check(checks.solids_on_mesh(case(steps=steps)), state)
        self.check(checks.solids_on_mesh(case()), "unknown")
        self.check(checks.solids_on_mesh(case(steps={"volume_correction": np.array([np.nan])})), "unknown")

    def test_averages_that_drive_a_flow_of_their_own(self):
        for share, state in ((0.14, "holds"), (0.16, "look"), (0.41, "fails")):
            # Known at written times
            steps = {"continuity_speed_m_per_s": np.array([np.nan, 0.2 * share, 0]),
                     "slip_m_per_s": np.array([np.nan, 0.1, 0.1])}
            self.check(checks.continuity(case(steps=steps)), state)
        self.check(checks.continuity(case()), "unknown")

    def test_slurry_that_has_no_yield_stress_where_it_moves_slowly(self):
        for stress, ratio, state in ((0.9, 101, "holds"), (1.1, 101, "look"), (10.1, 101, "fails"),
                                     (10.1, 1101, "holds")):
            slurry = {"yield_stress_Pa": stress, "plastic_viscosity_Pa_s": 0.01}.get
            found = checks.yield_stress(case(mill=SimpleNamespace(slurry=slurry, viscosity_ratio=ratio)))
            self.check(found, state)
            self.assertIn(f"below a shear rate of {stress / (0.01 * (ratio - 1)):.2g} 1/s", found.found)
            self.assertIn(f"a liquid of {0.01 * ratio:.2g} Pa s", found.found)
        slurry = {"yield_stress_Pa": 0, "plastic_viscosity_Pa_s": 0.01}.get
        found = checks.yield_stress(case(mill=SimpleNamespace(slurry=slurry, viscosity_ratio=1000)))
        self.assertEqual((found.state, found.found), ("holds", "it has none"))

    def test_drag_by_the_plastic_viscosity_where_the_pores_shear_slowly(self):
        # 12 slip/d is 240 1/s with the root mean square of the slip, which is known at written times
        steps = {"slip_m_per_s": np.array([np.nan, 0.14, 0.02])}
        for stress, ratio, state in ((1.1, 1000, "holds"), (1.3, 1000, "look"), (4.9, 1000, "fails"),
                                     (4.9, 1.4, "holds")):
            slurry = {"yield_stress_Pa": stress, "plastic_viscosity_Pa_s": 0.01}.get
            mill = SimpleNamespace(slurry=slurry, viscosity_ratio=ratio, sauter_diameter=0.005,
                                   flow={"viscosity": "plastic"}.get)
            found = checks.drag_viscosity(case(mill=mill, steps=steps))
            self.check(found, state)
            self.assertIn("pores shear at 240 1/s", found.found)
            self.assertIn(f"{1 + min(stress / 2.4, ratio - 1):.3g} times as much", found.found)
        self.check(checks.drag_viscosity(case(mill=mill)), "unknown")
        self.check(checks.drag_viscosity(case(mill=mill, steps={"slip_m_per_s": np.zeros(2)})), "unknown")
        mill.flow = {"viscosity": "pore"}.get
        self.check(checks.drag_viscosity(case(mill=mill)), "holds")
        mill.flow, mill.slurry = {}.get, {"yield_stress_Pa": 0}.get
        self.check(checks.drag_viscosity(case(mill=mill)), "holds")

    def test_a_mill_without_a_number_of_its_slurry_is_named(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_flow(folder)
        found = {check.name: check.state for check in checks.all_checks(MillCase(folder))}
        self.assertEqual(found["Slow slurry keeps its yield stress"], "holds")
        self.assertIn("The drag has the slurry's viscosity", found)
        change_json(folder / "mill.json", "derived", "slurry", to={})
        found = {check.name: check for check in checks.all_checks(MillCase(folder))}
        self.assertEqual(found["All files can be used"].state, "fails")
        self.assertIn("yield_stress_Pa", found["All files can be used"].found)

    def test_slurry_beyond_the_drag_laws_range_in_the_mean_over_time(self):
        for share, state in ((0.19, "holds"), (0.21, "look"), (0.51, "fails")):
            # A short step of another share, and one in which it is not known
            steps = {"beyond_law": np.array([share, 1.0, np.nan]), "deltaT_s": np.array([1.0, 1e-9, 1.0])}
            self.check(checks.drag_range(case(law="Beetstra", steps=steps)), state)
        self.check(checks.drag_range(case(law="Beetstra")), "unknown")

    def test_a_force_that_would_move_the_balls(self):
        for load, state in (((0.19, 0.49), "holds"), ((0.21, 0.3), "look"), ((0.1, 0.51), "look"),
                            ((0.41, 0.3), "fails"),
                            ((0.1, 1.1), "fails"), ((0.1, np.nan), "fails"), ((np.nan, 0.1), "fails")):
            self.check(checks.one_way(case(load=load)), state)
        self.check(checks.one_way(case(load=None)), "unknown")


class OneMill(Verdicts):
    """The fingerprints of the stages against those of mill.json."""

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def found(self):
        return checks.same_mill(MillCase(self.folder))

    def test_holds_for_stages_of_one_mill(self):
        write_flow(self.folder)
        self.check(self.found(), "holds")

    def test_names_the_stage_both_fingerprints_and_what_to_run_again(self):
        write_flow(self.folder)
        other = "f" * 16
        for name, part, again in (("dumps/run.json", "charge", "millDem"), ("dumps/results.json", "charge", "millDem"),
                                  ("mesh.json", "flow", "millMesh"), ("postProcessing/flow/0/flow.json", "averages",
                                                                      "the flow")):
            path = self.folder / name
            before = path.read_text()
            change_json(path, "mill", part, to=other)
            self.check(self.found(), "fails")
            self.assertEqual(self.found().found, f"{name} has the fingerprint {part} {other}, mill.json has "
                                                 f"{PRINTS[part]}: run {again} again")
            path.write_text(before)
        for name, part, again in (("solids.h5", "averages", "millAverage"), ("solids.h5", "charge", "millAverage"),
                                  ("slurry.h5", "flow", "the flow")):
            with h5py.File(self.folder / name, "a") as file:
                file.attrs[f"mill_{part}"] = other
            self.assertEqual(self.found().found, f"{name} has the fingerprint {part} {other}, mill.json has "
                                                 f"{PRINTS[part]}: run {again} again")
            with h5py.File(self.folder / name, "a") as file:
                file.attrs[f"mill_{part}"] = PRINTS[part]
        self.check(self.found(), "holds")

    def test_is_unknown_where_no_stage_names_its_mill(self):
        write_dry(self.folder)
        for name in ("dumps/run.json", "dumps/results.json", "solids.json"):
            change_json(self.folder / name, "mill", to={})
        with h5py.File(self.folder / "solids.h5", "a") as file:
            del file.attrs["mill_charge"], file.attrs["mill_averages"]
        self.check(self.found(), "unknown")


class List(Verdicts):
    def test_begins_with_what_fails_and_names_files_that_cannot_be_used(self):
        results = {"lost_balls": 0, "balls": 5, "steady": False, "ball_overlap_largest_m": 1e-5,
                   "ball_overlap_99_m": 1e-6, "allowed_overlap": 0.15,
                   "smallest_diameter_m": 0.004}
        found = checks.all_checks(case(results=results, unusable=["slurry.h5: not used, because it is not complete"]))
        self.assertEqual([check.state for check in found], ["fails", "fails", "unknown", "holds", "holds"])
        self.assertIn("not complete", " ".join(check.found for check in found[:2]))

    def test_a_number_that_a_file_lacks_is_reported(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_dry(folder)
        change_json(folder / "dumps" / "results.json", "lost_balls", to="none")
        found = checks.all_checks(MillCase(folder))[0]
        self.check(found, "fails")
        self.assertRegex(found.found, "results.json: lost_balls = 'none'; expected a number")
        for key, value, reason in (("lost_balls", None, "null; expected a number"),
                                   ("smallest_diameter_m", 0, "0; expected a number above 0")):
            write_dry(folder)
            change_json(folder / "dumps" / "results.json", key, to=value)
            found = checks.all_checks(MillCase(folder))[0]
            self.check(found, "fails")
            self.assertIn(f"results.json: {key} = {reason}", found.found)

    def test_only_verdicts_that_no_longer_run_can_change_are_lasting(self):
        found = checks.one_way(case(load=(0.5, 1.1)))
        self.assertTrue(found.lasting)
        self.assertFalse(checks.one_way(case(load=(0.1, 0.2))).lasting)
        self.assertFalse(checks.charge_steadiness(case(results={"steady": False})).lasting)


if __name__ == "__main__":
    unittest.main()
