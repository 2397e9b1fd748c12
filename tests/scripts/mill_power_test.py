#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Power of charge, slurry and drive: which time it is of, and its error, for balls that feel the slurry and that do
not."""
import re
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.readings import mill_power

TURN, BEGIN, LAST, TIME0 = 1.0, 2.0, 5.0, 3.0
# Of the last three turns; what the walls give to the slurry is less where they give more to the balls
BALLS, WALLS, BACK = np.array([2.0, 2.2, 2.1]), np.array([0.5, 0.31, 0.4]), np.array([0.3, 0.2, 0.4])


def series(of_turns, before, step):
    """Times (s) of five turns and values: `before` in the first two, then one for each turn."""
    times = np.arange(1, round(LAST / step) + 1) * step
    turn = np.clip(np.ceil(times - 1e-9) - 3, 0, 2).astype(int)
    return times, np.where(times <= BEGIN + 1e-9, before, of_turns[turn])


def case(kind, has_balls=True):
    """What the powers read of a case of five turns whose first two are averaged by nothing; kind: of the fluid on the
    balls, None for dry ones; has_balls: whether the flow has them."""
    times, balls = series(BALLS, 9.0, 0.01)
    flow_times, walls = series(WALLS, 9.0, 0.004)
    back = series(BACK, 9.0, 0.01)[1]
    found = SimpleNamespace(
        results={"fluid": {"kind": kind} if kind else None, "power_from_s": 0.7},
        result={"power_W": 3.0, "power_error_W": 0.04, "power_from_s": 0.7, "steady_from_s": 0.9}.get,
        flow=SimpleNamespace(time0=TIME0), has_balls=has_balls, begin=BEGIN, last=LAST, turn=TURN,
        energy={"time_s": TIME0 + times, "power_W": balls},
        fluid_on_balls={"time_s": TIME0 + times, "power_W": -back} if kind else None,
        balance={"Time": flow_times, "power": 0 * walls + 1.5, "power_shell": 0.25 * walls,
                 "power_lifters": 0.75 * walls})
    assert all(hasattr(MillCase, name) for name in vars(found))
    return found


class Powers(unittest.TestCase):
    def test_of_balls_that_move_with_the_flow_are_those_of_the_averaged_turns(self):
        direct = case("flow")
        self.assertAlmostEqual(mill_power.charge_power(direct).value, BALLS.mean(), places=9)
        drive = mill_power.drive_power(direct)
        self.assertAlmostEqual(drive.value, (BALLS + WALLS).mean(), places=9)
        # Of the sums of each turn, which differ less than their parts
        self.assertAlmostEqual(drive.error, (BALLS + WALLS).std(ddof=1) / np.sqrt(3), places=9)
        self.assertLess(drive.error, 0.1 * mill_power.charge_power(direct).error)
        self.assertEqual(drive.freedom, 2)
        self.assertAlmostEqual(mill_power.given_power(direct).value, (WALLS + BACK).mean(), places=9)

    def test_end_with_the_last_written_time_of_a_flow_that_went_on(self):
        direct, longer = case("flow"), case("flow")
        more = LAST + np.arange(1, 76) * 0.004
        longer.balance = {name: np.concatenate([values, more if name == "Time" else 9 + 0 * more])
                          for name, values in longer.balance.items()}
        for power in (mill_power.drive_power, mill_power.slurry_power, mill_power.given_power):
            self.assertEqual(power(longer), power(direct))

    def test_begin_with_the_averaged_turns_of_a_flow_that_moved_the_balls_or_as_the_results_have_it(self):
        self.assertEqual(mill_power.power_begin(case("flow")), TIME0 + BEGIN)
        for kind in ("slurry", None):
            self.assertEqual(mill_power.power_begin(case(kind)), 0.7)
        short, old = case("flow"), case(None)
        short.begin = 4.0
        self.assertEqual(mill_power.power_begin(short), 0.7)
        del old.results["power_from_s"]
        self.assertEqual(mill_power.power_begin(old), 0.9)

    def test_begin_with_the_last_whole_turns_where_the_averages_are_of_no_whole_turns(self):
        longer = case("flow")
        longer.begin = LAST - 2.6 * TURN
        self.assertAlmostEqual(mill_power.charge_power(longer).value, BALLS[1:].mean(), places=9)
        self.assertAlmostEqual(mill_power.power_begin(longer), TIME0 + LAST - 2 * TURN, places=9)

    def test_of_balls_that_felt_an_earlier_flow_are_of_their_own_run(self):
        passed = case("slurry")
        self.assertEqual(mill_power.charge_power(passed).value, 3.0)
        drive = mill_power.drive_power(passed)
        self.assertAlmostEqual(drive.value, 3.0 + WALLS.mean(), places=9)
        self.assertAlmostEqual(drive.error, np.hypot(0.04, WALLS.std(ddof=1) / np.sqrt(3)), places=9)
        self.assertTrue(np.isnan(mill_power.given_power(passed).value))

    def test_of_dry_balls_are_added_to_what_they_and_the_walls_give(self):
        dry = case(None)
        self.assertAlmostEqual(mill_power.drive_power(dry).value, 4.5, places=9)
        self.assertAlmostEqual(mill_power.drive_power(dry).error, 0.04, places=9)
        self.assertAlmostEqual(mill_power.slurry_power(dry).value, 1.5, places=9)

    def test_of_a_flow_without_balls_are_the_slurrys_alone(self):
        for kind in (None, "buoyancy"):
            fluid_only = case(kind, has_balls=False)
            # Turns of 1.4, 1.5 and 1.7 W
            fluid_only.balance["power"] = series(np.array([1.4, 1.5, 1.7]), 9.0, 0.004)[1]
            drive = mill_power.drive_power(fluid_only)
            self.assertEqual(drive, mill_power.slurry_power(fluid_only))
            self.assertAlmostEqual(drive.value, 4.6 / 3, places=9)
            self.assertAlmostEqual(drive.error, np.std([1.4, 1.5, 1.7], ddof=1) / np.sqrt(3), places=9)
            fluid_only.begin = 2.5
            self.assertTrue(np.isnan(mill_power.drive_power(fluid_only).value))

    def test_of_balls_in_a_pool_at_rest_the_drives_is_not_known(self):
        pool = case("buoyancy")
        self.assertTrue(np.isnan(mill_power.drive_power(pool).value))
        self.assertEqual(mill_power.charge_power(pool).value, 3.0)
        self.assertAlmostEqual(mill_power.slurry_power(pool).value, 1.5, places=9)

    def test_of_results_have_the_freedom_of_the_batches_of_milldem(self):
        source = Path(__file__).parents[2] / "dem_driver" / "steady_state.cpp"
        batches = int(re.search(r"size_t batches = (\d+);", source.read_text())[1])
        found = mill_power.result_power(case(None))
        # Of the batches' distances from a straight line, which takes two
        self.assertEqual((found.value, found.error, found.freedom), (3.0, 0.04, batches - 2))
        self.assertEqual(mill_power.drive_power(case(None)).freedom, batches - 2)  # the slurry's turns are equal

    def test_of_fewer_turns_than_three_are_not_known(self):
        for kind in ("flow", "slurry", None):
            short = case(kind)
            short.begin = 2.5
            for power in (mill_power.slurry_power, mill_power.drive_power, mill_power.given_power):
                self.assertTrue(np.isnan(power(short).value), (kind, power))
        self.assertAlmostEqual(mill_power.charge_power(case("flow")).value, BALLS.mean(), places=9)

    def test_of_a_flow_shorter_than_two_averaged_turns_the_charges_is_that_of_the_results(self):
        short = case("flow")
        short.begin = 4.0
        self.assertEqual(mill_power.charge_power(short).value, 3.0)


if __name__ == "__main__":
    unittest.main()
