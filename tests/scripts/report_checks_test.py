#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every check of the report's verdict list holds, looks or fails on the right side of its limit, and says what to do."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np

from millfoam.report import checks

CLASSES = {"charge": {"classes": [{"diameter": 0.004, "mass": 1}]}}


def case(**parts):
    """What checks read of a MillCase; logs: name -> text."""
    logs = parts.pop("logs", {})
    return SimpleNamespace(**{"begin": 2.0, "radius": 0.15, "mill": CLASSES, "unusable": [], "results": None, "solids": None,
                              "flow": None, "law": None, "balance": None, "log": lambda name: logs.get(name, ""), **parts})


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
            self.check(checks.judged("name", value, 1, "found", "do", doubtful=2), state)
        self.check(checks.judged("name", 1.001, 1, "found", "do"), "fails")


class Flow(Verdicts):
    def test_slurry_that_is_missing(self):
        for missing, state in ((0.9e-9, "holds"), (-0.9e-9, "holds"), (1.1e-9, "fails"), (-1.1e-9, "fails"), (np.nan, "fails")):
            told = {"missing": np.array([0, missing]), "holdUp": np.array([1e-3, 1e-3])}
            self.check(checks.conservation(case(balance=told)), state)
        self.check(checks.conservation(case()), "unknown")

    def steadiness(self, drift=0.0, noise=0.0, **others):
        """Of a hold-up of 1 l that drifts by a share of itself in the whole time."""
        time = np.linspace(0, 6, 1201)
        wobble = np.random.default_rng(3).normal(0, 1, time.shape)
        told = {"Time": time, "holdUp": 1e-3 * (1 + drift * time / 4 + noise * wobble), "x": 0 * time, "y": 0 * time, **others}
        return checks.flow_steadiness(case(balance=told))

    def test_a_drift_of_the_hold_up(self):
        # The second half's mean differs by half of the drift from the first's; 1 % of the hold-up is no drift that matters
        for drift, state in ((0.0, "holds"), (0.018, "holds"), (0.025, "look"), (-0.025, "look"), (0.05, "fails"),
                             (3.0, "fails")):
            self.check(self.steadiness(drift), state)

    def test_noise_is_no_drift_and_hides_none(self):
        self.check(self.steadiness(noise=0.2), "holds")
        self.check(self.steadiness(1.0, noise=0.2), "fails")

    def test_a_centre_that_moves_or_is_unknown(self):
        time = np.linspace(0, 6, 1201)
        self.check(self.steadiness(y=-0.01 * time), "fails")
        self.check(self.steadiness(x=np.full(1201, np.nan)), "fails")

    def test_too_few_times_or_none_tell_nothing(self):
        time = np.linspace(0, 2.1, 30)
        self.check(checks.flow_steadiness(case(balance={"Time": time, "holdUp": 1 + time, "x": time, "y": time})), "unknown")
        self.check(checks.flow_steadiness(case()), "unknown")

    def courant(self, steps, control="maxCo 0.5;\nmaxAlphaCo 0.4;\nmaxVoidageChange 0.1;\n"):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "system").mkdir()
        (folder / "system" / "controlDict").write_text(control)
        log = "".join(f"Courant number {a}, at the surface {b}, change of voidage {c}\n" for a, b, c in steps)
        return checks.courant(case(folder=folder, logs={"flow": log}))

    def test_steps_beyond_their_limits(self):
        good, bad = (0.5, 0.4, 0.1), ((0.76, 0.4, 0.1), (0.5, 0.61, 0.1), (0.5, 0.4, 0.16), (0.5, np.nan, 0.1))
        self.check(self.courant([bad[0]] + [good] * 100), "holds")  # before the first step nothing was limited
        for one in bad:
            for count, state in ((1, "holds"), (3, "look"), (10, "fails")):
                self.check(self.courant([good] * (101 - count) + [one] * count), state)
        self.check(self.courant([(0.74, 0.59, 0.149)] * 100), "holds")

    def test_steps_are_judged_by_what_is_told(self):
        found = self.courant([(0.55, 0.4, 0.1)] * 100, "maxCo 0.5;\nmaxAlphaCo 0.4;\nmaxVoidageChange $most;\n").found
        self.assertEqual(found, "0.0 % of the steps are beyond 1.5 times what controlDict asks for (limit 1 %); 95 % of the steps "
                                "stay below: Courant number 0.55 for 0.5, at the surface 0.4 for 0.4, change of voidage 0.1")

    def test_steps_or_limits_that_are_not_told_are_unknown(self):
        self.check(self.courant([(0.1, 0.1, 0.1)]), "unknown")
        self.check(self.courant([(9, 9, 9)] * 10, "maxCo $co;\n"), "unknown")

    def test_a_mesh_that_checkMesh_finds_fault_with(self):
        self.check(checks.mesh(case(logs={"check": "Mesh OK.\n", "mesh": "max skewness  0.5 (limit 1)\n"})), "holds")
        self.check(checks.mesh(case(logs={"check": "Failed 1 mesh checks.\n"})), "fails")
        self.check(checks.mesh(case()), "unknown")


class Charge(Verdicts):
    def test_a_ball_that_is_lost(self):
        for lost, state in ((0, "holds"), (1, "fails")):
            self.check(checks.lost_balls(case(results={"lost_balls": lost, "balls": "10"})), state)

    def test_averages_that_begin_before_the_charge_is_steady(self):
        for since, state in ((1.0, "holds"), (2.0, "holds"), (2.4, "look"), (2.6, "fails")):
            results = {"steady": "yes", "steady_from": str(since)}
            self.check(checks.charge_steadiness(case(results=results, solids="solids.h5", charge_span=(2.0, 3.0))), state)
        self.check(checks.charge_steadiness(case(results={"steady": "no"})), "fails")
        self.check(checks.charge_steadiness(case(results={"steady": "yes", "steady_from": "1"})), "holds")

    def test_balls_that_are_too_soft(self):
        for largest, state in ((0.149 * 0.004, "holds"), (0.151 * 0.004, "fails"), (np.nan, "fails")):
            results = {"ball_overlap_largest": str(largest), "ball_overlap_99": "1e-5"}
            self.check(checks.overlap(case(results=results)), state)
        # The smallest ball that was made counts, where it is told
        results = {"ball_overlap_largest": "4e-4", "ball_overlap_99": "1e-5", "smallest_diameter": "0.002"}
        self.check(checks.overlap(case(results=results)), "fails")

    def test_balls_outside_or_clipped(self):
        for outside, clipped, state in ((0, 0.009, "holds"), (0.009, 0, "holds"), (0.006, 0.006, "fails"), (0, np.nan, "fails")):
            ledger = {"ledger/volume_in": [1, 1], "ledger/outside": [0, outside], "ledger/clipped": [0, clipped]}
            self.check(checks.ledger(self.solids(ledger)), state)

    def test_averaging_volumes_with_few_or_many_balls(self):
        for balls, state in ((8.1, "holds"), (64, "holds"), (65, "look"), (7.9, "look"), (1.1, "look"), (0.9, "fails")):
            self.check(checks.averaging_volume(self.solids({"window/balls_per_cell": [balls, balls]})), state)

    def test_windows_that_are_short(self):
        # A deviation of 0.5 of the mean over the root of the number of records
        for records, state in ((101, "holds"), (99, "look"), (26, "look"), (24, "fails")):
            self.check(checks.window_noise(self.noise(0.5, 0.25, records)), state)
        self.check(checks.window_noise(self.noise(0.2, 0.1, 100)), "unknown")

    def noise(self, solidity, deviation, records):
        shape = (3, 2, 2, 2)
        return self.solids({"window/begin": [0, 1, 2], "window/records": [records] * 3, "solidity": np.full(shape, solidity),
                            "solidity_deviation": np.full(shape, deviation)})


class BallsInTheFlow(Verdicts):
    def test_volume_that_the_flows_mesh_does_not_keep(self):
        for share, state in ((-1.9, "holds"), (-2.1, "fails"), (2.1, "fails")):
            log = "".join(f"bed: volume corrected by 0.1 %, at most {most} %, to 1 m3\n" for most in (0.5, share, 0.5))
            self.check(checks.solids_on_mesh(case(logs={"flow": log})), state)
        self.check(checks.solids_on_mesh(case()), "unknown")

    def test_slurry_beyond_the_drag_laws_range(self):
        for share, state in ((19, "holds"), (21, "look"), (51, "fails")):
            log = f"bed: beyond Beetstra's range: at most 60 % of the slurry in the bed, in the mean over 5 s {share} %\n"
            self.check(checks.drag_range(case(law="Beetstra", logs={"flow": log})), state)
        self.check(checks.drag_range(case(law="Beetstra")), "unknown")

    def test_a_force_that_would_move_the_balls(self):
        for load, state in (((0.19, 0.49), "holds"), ((0.21, 0.3), "look"), ((0.1, 0.51), "look"), ((0.41, 0.3), "fails"),
                            ((0.1, 1.1), "fails"), ((0.1, np.nan), "fails"), ((np.nan, 0.1), "fails")):
            self.check(checks.one_way(case(load=load)), state)
        self.check(checks.one_way(case(load=None)), "unknown")


class List(Verdicts):
    def test_begins_with_what_fails_and_tells_files_that_cannot_be_used(self):
        results = {"lost_balls": "0", "balls": "5", "steady": "no", "ball_overlap_largest": "1e-5", "ball_overlap_99": "1e-6"}
        found = checks.all_checks(case(results=results, unusable=["slurry.h5: not used, as it is half-written"]))
        self.assertEqual([check.state for check in found], ["fails", "fails", "holds", "holds"])
        self.assertIn("half-written", " ".join(check.found for check in found[:2]))


if __name__ == "__main__":
    unittest.main()
