#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report about power: powers of flows of two and three turns, and their places among the models."""
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.readings.power_models import bond, hogg_fuerstenau, morrell
from millfoam.readings.means import Mean
from millfoam.report.case_readings import power_name
from millfoam.report.power_section import models_table, net_note, outside, powers, specific
from report_cases import DURATION, LENGTH, OMEGA, TIME0, change_json, write_flow, write_steps

TURN, BEGIN = 0.1, 0.5  # s: averages of write_flow's 0.8 s that are three turns
SPEED = -OMEGA / 8.09
# Bulk of 2 kg of balls of 2500 kg/m3 at a solidity of 0.6, over the shell without regard to lifters
FILLING = 2.0 / 2500 / 0.6 / (np.pi * 0.15**2 * LENGTH)
PORES = 2.0 / 2500 / 0.6 * 0.4  # m3
SIZE = 0.3, LENGTH, SPEED, FILLING
DRY, THREE_QUARTERS = 0.6 * 2500, 0.6 * 2500 + 0.4 * 0.75 * 1500  # kg/m3, of the bulk, by the share of filled pores


class Powers(unittest.TestCase):
    def setUp(self):
        self.folder = write_flow(Path(self.enterContext(tempfile.TemporaryDirectory())) / "flow")
        # The mill is a part of a longer one
        change_json(self.folder / "mill.json", "derived", "geometry", "whole_length_m", to=4 * LENGTH)

    def case(self, kind=None, of_balls=(), held=0.75 * PORES):
        """The flow with turns of 0.1 s. Of the last three, the walls give 0.3, 0.4 and 0.5 W to the slurry, and
        walls and balls 0.6, 0.7 and 0.8 W. kind: of the fluid on the balls, None for dry ones; of_balls: what the
        walls give to balls that move with the flow in these turns, W; held: slurry in the mill, m3."""
        if kind:
            change_json(self.folder / "dumps" / "results.json", "fluid", to={"kind": kind})
        case = MillCase(self.folder, BEGIN)
        case.turn = TURN
        times = case.balance["Time"]
        walls = self.of_turns(times, (0.3, 0.4, 0.5))
        case.balance |= {"power": self.of_turns(times, (0.6, 0.7, 0.8)), "power_shell": 0.25 * walls,
                         "power_lifters": 0.75 * walls, "holdUp": np.where(times > BEGIN + 1e-9, held, 9.0)}
        if len(of_balls):
            case.energy["power_W"] = self.of_turns(case.energy["time_s"] - TIME0, of_balls)
        return case

    @staticmethod
    def of_turns(times, values):
        """One value for each turn from BEGIN on, others before and after them."""
        turn = np.ceil((times - BEGIN) / TURN - 1e-6).astype(int)
        return np.concatenate([[9.0], values, [9.0]])[np.clip(turn, 0, len(values) + 1)]

    def without_balls(self):
        """Makes the flow one without balls, after the dry run in the same case."""
        (self.folder / "constant" / "bedProperties").unlink()
        write_steps(self.folder, 0, np.linspace(0.008, DURATION, 100), law=None)

    def rows(self, case):
        """Rows (name, power by the model, simulated over it) of the card of the models."""
        card = models_table(case, powers(case))
        return [tuple(re.findall(r"<td[^>]*>(.*?)</td>", row)) for row in re.findall(r"<tr>(<td.*?)</tr>", card)]

    def row(self, name, model, simulated):
        return name, f"{model:.3g} W", f"{simulated / model:.2f}"

    def test_of_a_flow_whose_balls_do_not_feel_it_are_the_charges_and_the_slurrys_and_their_sum(self):
        found = powers(self.case())
        self.assertEqual(list(found), ["charge", "slurry", "drive"])
        self.assertEqual((found["charge"].value, found["charge"].error), (3.21, 0.0123))
        self.assertAlmostEqual(found["slurry"].value, 0.7, places=9)
        self.assertAlmostEqual(found["slurry"].error, 0.1 / np.sqrt(3), places=9)
        self.assertAlmostEqual(found["drive"].value, 3.21 + 0.7, places=9)
        self.assertAlmostEqual(found["drive"].error, np.hypot(0.0123, 0.1 / np.sqrt(3)), places=9)

    def test_of_a_flow_whose_balls_move_with_it_the_drives_has_the_walls_part_of_the_slurrys(self):
        found = powers(self.case("flow", (2.0, 2.1, 1.9)))
        self.assertEqual(list(found), ["charge", "slurry", "drive"])
        self.assertAlmostEqual(found["charge"].value, 2.0, places=9)
        self.assertAlmostEqual(found["slurry"].value, 0.7, places=9)
        self.assertAlmostEqual(found["drive"].value, 2.0 + 0.4, places=9)
        # Of the sums 2.3, 2.5 and 2.4
        self.assertAlmostEqual(found["drive"].error, 0.1 / np.sqrt(3), places=9)

    def test_of_two_turns_have_an_error_of_one_degree_of_freedom_and_its_reach(self):
        case = self.case("flow", (2.0, 2.1, 1.9))
        case.begin = BEGIN + TURN
        found = powers(case)
        self.assertEqual(list(found), ["charge", "slurry", "drive"])
        self.assertAlmostEqual(found["slurry"].value, 0.75, places=9)
        self.assertEqual([one.freedom for one in found.values()], [1, 1, 1])
        # 12.7 errors of 0.05 W
        self.assertEqual(specific(case, "slurry", found["slurry"])[1], "0.75 ± 0.05 W (95 % within ± 0.64 W: the error "
                                                                       "has 1 degree of freedom)")
        self.assertIn("Both are means over 2 whole turns", net_note(case))
        # Three turns have two degrees; eight degrees, those of a dry run, and what is not from turns are known enough
        self.assertEqual(specific(case, "slurry", Mean(0.75, 0.05, 2))[1], "0.75 ± 0.05 W (95 % within ± 0.22 W: the "
                                                                           "error has 2 degrees of freedom)")
        for power in (Mean(0.75, 0.05, 8), Mean(0.75, 0.05)):
            self.assertEqual(specific(case, "slurry", power)[1], "0.75 ± 0.05 W")

    def test_of_fewer_than_two_turns_are_the_charges_alone(self):
        case = self.case()
        case.turn = 0.2
        self.assertEqual(list(powers(case)), ["charge"])
        self.assertIn("needs two whole turns; this flow has 1", net_note(case))

    def test_a_flow_whose_balls_do_not_feel_it_is_compared_dry_and_with_the_slurry_in_its_pores(self):
        wet = "pores filled to 75 %"
        self.assertEqual(self.rows(self.case()), [
            self.row("Hogg &amp; Fuerstenau, 35°, dry", hogg_fuerstenau(*SIZE, DRY), 3.21),
            self.row("Morrell, C-model, dry", morrell(*SIZE, DRY).net, 3.21),
            self.row(f"Hogg &amp; Fuerstenau, 35°, {wet}", hogg_fuerstenau(*SIZE, THREE_QUARTERS), 3.91),
            self.row(f"Morrell, C-model, {wet}", morrell(*SIZE, THREE_QUARTERS).net, 3.91),
            self.row("Bond", bond(0.3, SPEED, FILLING, 2.0), 3.91)])

    def test_a_flow_whose_balls_move_with_it_is_compared_with_the_slurry_in_its_pores_alone(self):
        wet = "pores filled to 75 %"
        self.assertEqual(self.rows(self.case("flow", (2.0, 2.1, 1.9))), [
            self.row(f"Hogg &amp; Fuerstenau, 35°, {wet}", hogg_fuerstenau(*SIZE, THREE_QUARTERS), 2.4),
            self.row(f"Morrell, C-model, {wet}", morrell(*SIZE, THREE_QUARTERS).net, 2.4),
            self.row("Bond", bond(0.3, SPEED, FILLING, 2.0), 2.4)])

    def test_a_pool_above_the_charge_fills_the_pores_once(self):
        full = 0.6 * 2500 + 0.4 * 1500
        row = self.row("Hogg &amp; Fuerstenau, 35°, pores filled to 100 %", hogg_fuerstenau(*SIZE, full), 3.91)
        self.assertIn(row, self.rows(self.case(held=2 * PORES)))

    def test_the_models_are_named_out_of_whose_range_the_mill_is(self):
        case = self.case()
        card = models_table(case, powers(case))
        self.assertIn("Outside of the range of Morrell: diameter 0.3 m, range 3.2 to 12.2 m", card)
        self.assertIn("Outside of the range of Hogg &amp; Fuerstenau: diameter 0.3 m, range 4.71 to 12.2 m",
                      card)
        self.assertNotIn("range of Bond", card)
        self.assertEqual(outside((5.0, 6.0, 0.75, 0.3)),
                         " Outside of the range of Bond: diameter 5 m, range up to 3.3 m.")

    def test_a_pool_above_the_charge_has_a_row_of_its_own(self):
        full, pool = 0.6 * 2500 + 0.4 * 1500, "Morrell, C-model, pores filled to 100 %, with its pool"
        rows = self.rows(self.case(held=1.01 * PORES))
        self.assertIn(self.row(pool, morrell(*SIZE, full, 1500, overflow=True).net, 3.91), rows)
        self.assertIn(self.row(pool.removesuffix(", with its pool"), morrell(*SIZE, full).net, 3.91), rows)
        self.assertNotIn(pool, [name for name, *_ in self.rows(self.case(held=0.99 * PORES))])

    def test_balls_that_move_with_a_flow_of_fewer_than_two_turns_are_not_compared(self):
        case = self.case("flow", (2.0, 2.1, 1.9))
        case.turn = 0.2
        card = models_table(case, powers(case))
        self.assertIn("The power is not compared with models: the balls feel the slurry", card)

    def test_of_a_flow_without_balls_the_drives_is_the_slurrys_and_the_charge_is_compared_dry(self):
        self.without_balls()
        case = self.case(held=2 * PORES)
        found = powers(case)
        self.assertEqual(list(found), ["charge", "slurry", "drive"])
        self.assertEqual(found["drive"], found["slurry"])
        self.assertAlmostEqual(found["drive"].value, 0.7, places=9)
        self.assertEqual(power_name(case), "power of the dry charge, which is not in this flow")
        self.assertIn("Charge: what the walls give to the balls of the dry run, which are not in this flow. Slurry: "
                      "the torque of the walls on it, times the mill's speed. Drive: what the walls give to the "
                      "slurry. Both are means over 3 whole turns", net_note(case))
        self.assertEqual(self.rows(case), [
            self.row("Hogg &amp; Fuerstenau, 35°, dry", hogg_fuerstenau(*SIZE, DRY), 3.21),
            self.row("Morrell, C-model, dry", morrell(*SIZE, DRY).net, 3.21),
            self.row("Bond", bond(0.3, SPEED, FILLING, 2.0), 3.21)])

    def test_of_balls_in_a_pool_at_rest_the_drives_is_not_known_and_nothing_is_compared(self):
        case = self.case("buoyancy")
        self.assertEqual(list(powers(case)), ["charge", "slurry"])
        self.assertEqual(power_name(case), "power of the charge in a pool at rest")
        self.assertIn("Charge: what the walls give to the balls, which feel the buoyancy of a pool at rest.",
                      net_note(case))
        self.assertIn("Drive: not known, because what moves the pool at rest is not known. The slurry's is a mean over "
                      "3 whole turns", net_note(case))
        self.assertEqual(self.rows(case), [])
        self.assertIn("The power is not compared with models: the balls lie in a pool at rest",
                      models_table(case, powers(case)))
        case.turn = 0.2
        self.assertIn("The power of the slurry needs two whole turns; this flow has 1.", net_note(case))

    def test_of_balls_in_a_pool_at_rest_that_are_not_in_the_flow_have_both_words(self):
        self.without_balls()
        case = self.case("buoyancy")
        found = powers(case)
        self.assertEqual(found["drive"], found["slurry"])
        self.assertEqual(power_name(case), "power of the charge in a pool at rest, which is not in this flow")
        self.assertIn("the balls of a run in a pool at rest, which are not in this flow", net_note(case))
        self.assertEqual(self.rows(case), [])

    def test_two_turns_end_with_the_flow(self):
        case = self.case("flow", (2.0, 2.1, 1.9))
        case.turn = 0.12
        # 0.24 s of 2.0, 2.1 and 1.9 W
        self.assertAlmostEqual(powers(case)["charge"].value, (0.04 * 2.0 + 0.1 * 2.1 + 0.1 * 1.9) / 0.24, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
