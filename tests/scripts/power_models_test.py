#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of a mill's power against published examples and closed forms."""
import unittest

import numpy as np
from scipy.optimize import brentq

from millfoam.readings.power_models import (RANGES, TONNE, bond, bulk_density, hogg_fuerstenau, morrell,
                                            pores_filled)

STEEL = bulk_density(7800, 0.6)  # kg/m3, dry
LOSSES = 1.26  # of the C-model, on its net power
# A. G. Doll, An updated data set for SAG mill power model calibration, XXVIII IMPC (2016), paper 123, table 1, read in
# a transcription: row, diameter and length, m, filling, that of balls, speed, density of the ore, t/m3, share of solids
# in the slurry by mass, power of the motor, kW, and share of it at the shell
SURVEYS = ((15, 10.74, 5.03, 0.300, 0.130, 0.740, 2.70, 0.75, 10965, 1.0),
           (20, 6.29, 5.88, 0.414, 0.0, 0.753, 4.33, 0.76, 3857, 0.9456),
           (31, 7.45, 9.25, 0.370, 0.080, 0.760, 2.70, 0.70, 7400, 0.9310),
           (32, 7.23, 3.00, 0.191, 0.150, 0.749, 2.80, 0.70, 2710, 0.9310),
           (35, 4.71, 9.49, 0.400, 0.097, 0.889, 2.84, 0.73, 3034, 0.9310),
           (36, 8.26, 4.19, 0.237, 0.127, 0.747, 2.59, 0.65, 3917, 0.9361),
           (39, 9.45, 3.96, 0.320, 0.080, 0.749, 2.75, 0.72, 6803, 0.9014),
           (42, 9.15, 5.00, 0.332, 0.0, 0.750, 3.24, 0.70, 6667, 0.9312),
           (43, 11.28, 6.40, 0.280, 0.149, 0.769, 2.86, 0.70, 16635, 0.9600),
           (44, 10.06, 5.18, 0.262, 0.186, 0.767, 2.70, 0.77, 11062, 0.9456),
           (47, 9.45, 3.35, 0.270, 0.0, 0.730, 2.70, 0.70, 3297, 0.9219))


def surveyed(filling, balls, ore, solids):
    """Density, kg/m3, of the bulk of a surveyed charge: 60 % of it balls of 7.85 t/m3 and ore, slurry in its pores."""
    slurry = 1 / (solids / ore + 1 - solids)
    return TONNE * (0.6 * (7.85 * balls + ore * (filling - balls)) / filling + 0.4 * slurry)


class Morrell(unittest.TestCase):
    def test_reproduces_the_two_chambers_of_a_dry_cement_mill(self):
        # O. Erdem, S. L. Ergun & H. Benzer, Physicochem. Probl. Miner. Process. 38 (2004) 221, kW. With steel of 7800
        # kg/m3 and 40 % pores both are 0.1 % lower than printed; why is not known
        for length, filling, no_load, net in ((3.6, 0.2748, 41.94, 341.97), (7.0, 0.2663, 72.35, 650.69)):
            found = morrell(3.27, length, 0.7267, filling, STEEL)
            self.assertAlmostEqual(found.no_load / 1e3, no_load, delta=0.005)
            self.assertAlmostEqual(found.net / 1e3 / net, 1, delta=1.5e-3)

    def test_both_chambers_take_the_power_of_their_motor(self):
        # Erdem et al., kW: 41.94 + 72.35 + 1.26 (341.97 + 650.69)
        chambers = [morrell(3.27, length, 0.7267, filling, STEEL) for length, filling in ((3.6, 0.2748), (7.0, 0.2663))]
        gross = sum(one.no_load + LOSSES * one.net for one in chambers)
        self.assertAlmostEqual(gross / 1365.04e3, 1, delta=1.5e-3)

    def test_has_the_power_of_surveyed_mills(self):
        # Doll adds 5 % to the charge's power for conical ends. His mean error of a model of Morrell's over 21 surveys
        # is 9 % (Procemin 2013): a survey may differ by twice as much, and the mean of eleven by a third of it
        ratios = []
        for row, diameter, length, filling, balls, speed, ore, solids, motor, _ in SURVEYS:
            found = morrell(diameter, length, speed, filling, surveyed(filling, balls, ore, solids))
            ratios.append((found.no_load + LOSSES * 1.05 * found.net) / (TONNE * motor))
            self.assertAlmostEqual(ratios[-1], 1, delta=0.18, msg=f"row {row}")
        self.assertAlmostEqual(np.mean(ratios), 1, delta=0.03)

    def test_toe_and_shoulder_part_with_the_speed(self):
        slow, fast = (morrell(3, 4, speed, 0.3, STEEL) for speed in (0.6, 0.8))
        self.assertLess(fast.toe, slow.toe)
        self.assertGreater(fast.shoulder, slow.shoulder)

    def test_a_pool_takes_power_back(self):
        dry = morrell(3, 4, 0.72, 0.35, 5000, pool=1600)
        pool = morrell(3, 4, 0.72, 0.35, 5000, pool=1600, overflow=True)
        self.assertEqual(dry.net, morrell(3, 4, 0.72, 0.35, 5000).net)
        self.assertLess(pool.net, dry.net)
        self.assertEqual(pool.kinetic, dry.kinetic)

    def test_power_has_a_maximum_over_the_filling(self):
        fillings = np.arange(0.1, 0.6, 0.05)
        powers = [morrell(5, 6, 0.75, filling, 5000).net for filling in fillings]
        self.assertTrue(0 < np.argmax(powers) < len(powers) - 1)

    def test_inner_surface_encloses_the_part_of_the_charge_that_touches(self):
        found = morrell(4, 1, 0.7, 0.3, 5000)
        area = (2 * np.pi + found.shoulder - found.toe) / 2 * (2**2 - found.inner**2)
        self.assertLess(area, 0.3 * np.pi * 4)
        self.assertGreater(area, 0.15 * np.pi * 4)


class HoggFuerstenau(unittest.TestCase):
    def test_is_the_torque_of_a_tilted_segment(self):
        # The charge's weight times the way of its centroid from the axis, 2/3 (R sin t)^3 over its section, and the
        # speed: 0.238 and 1.065 are a fit to that
        for filling in (0.3, 0.35, 0.4, 0.45):
            half = brentq(lambda t, share=filling: (t - np.sin(t) * np.cos(t)) / np.pi - share, 0.1, 3)
            torque = 5000 * 9.81 * 6 * 2 / 3 * (2 * np.sin(half))**3 * np.sin(np.radians(35))
            speed = 0.7 * np.sqrt(9.81 / 2)
            self.assertAlmostEqual(hogg_fuerstenau(4, 6, 0.7, filling, 5000) / (torque * speed), 1, delta=0.05)

    def test_has_the_power_of_surveyed_mills_with_usual_angles_of_lift(self):
        # At the shell; a power that is 9 % off turns an angle of 41 by 5
        angles = []
        for row, diameter, length, filling, balls, speed, ore, solids, motor, shell in SURVEYS:
            upright = hogg_fuerstenau(diameter, length, speed, filling, surveyed(filling, balls, ore, solids), 90)
            angles.append(np.degrees(np.arcsin(TONNE * motor * shell / upright)))
            self.assertTrue(25 <= angles[-1] <= 50, f"row {row}: {angles[-1]}")
        self.assertTrue(30 <= np.mean(angles) <= 45, np.mean(angles))

    def test_scales_with_diameter_and_length(self):
        self.assertAlmostEqual(hogg_fuerstenau(8, 6, 0.7, 0.3, 5000) / hogg_fuerstenau(4, 6, 0.7, 0.3, 5000), 2**2.5)
        self.assertAlmostEqual(hogg_fuerstenau(4, 12, 0.7, 0.3, 5000) / hogg_fuerstenau(4, 6, 0.7, 0.3, 5000), 2)


class Bond(unittest.TestCase):
    def test_of_a_tonne_of_balls(self):
        # By hand: 4.879 1.231144 (3.2 - 1.2) 0.72 (1 - 0.1/2^1.8) kW with 2^0.3 = 1.231144
        self.assertAlmostEqual(bond(2, 0.72, 0.4, 1000), 8.4013e3, delta=1)

    def test_is_the_equation_in_feet_and_short_tons(self):
        # 3.1 D^0.3 (3.2 - 3 J) N (1 - 0.1/2^(9 - 10 N)) kW for each short ton (907.18474 kg) of balls with D in feet;
        # 3.1 is good to its last digit, 1.6 %, 4.879 to 0.01 %; they agree to 0.03 %
        for diameter, speed, filling in ((8.0, 0.70, 0.35), (10.5, 0.75, 0.40)):
            short_ton = (3.1 * diameter**0.3 * (3.2 - 3 * filling) * speed * (1 - 0.1 / 2**(9 - 10 * speed)))
            self.assertAlmostEqual(bond(0.3048 * diameter, speed, filling, 907.18474) / 1e3 / short_ton, 1, delta=5e-4)

    def test_falls_near_the_critical_speed(self):
        speeds = np.arange(0.5, 0.995, 0.01)
        powers = [bond(3, speed, 0.4, 1000) for speed in speeds]
        self.assertTrue(0.8 < speeds[np.argmax(powers)] < 0.95)


class Ranges(unittest.TestCase):
    def test_the_surveyed_mills_are_not_outside(self):
        self.assertEqual(RANGES["Morrell"].outside(3.27, 0.7267, 0.2748), [])
        for _, diameter, _, filling, _, speed, *_ in SURVEYS:
            for model in ("Hogg & Fuerstenau", "Morrell"):
                self.assertEqual(RANGES[model].outside(diameter, speed, filling), [])

    def test_what_lies_outside_is_named_with_its_ends(self):
        self.assertEqual(RANGES["Morrell"].outside(0.3, 0.75, 0.3125),
                         ["diameter 0.3 m, range 3.2 to 12.2 m"])
        self.assertEqual(RANGES["Hogg & Fuerstenau"].outside(5, 0.5, 0.45),
                         ["speed 0.5, range 0.645 to 0.889", "filling 0.45, range 0.179 to 0.425"])

    def test_an_end_that_is_not_known_is_not_judged(self):
        self.assertEqual(RANGES["Bond"].outside(0.3, 0.1, 0.6), [])
        self.assertEqual(RANGES["Bond"].outside(4, 0.7, 0.4), ["diameter 4 m, range up to 3.3 m"])


class Inputs(unittest.TestCase):
    def test_what_a_mill_cannot_have_is_refused(self):
        for model in (lambda speed, filling: hogg_fuerstenau(3, 4, speed, filling, 5000),
                      lambda speed, filling: bond(3, speed, filling, 1000),
                      lambda speed, filling: morrell(3, 4, speed, filling, 5000)):
            with self.assertRaisesRegex(ValueError, "filling is 30;.*at most 0.6"):
                model(0.7, 30)
            with self.assertRaisesRegex(ValueError, "speed is 0;"):
                model(0, 0.3)

    def test_more_than_fits_between_toe_and_shoulder_is_refused(self):
        with self.assertRaisesRegex(ValueError, "filling is 0.45 at a speed of 0.3; expected at most 0.4"):
            morrell(3, 4, 0.3, 0.45, 5000)

    def test_densities_of_a_charge(self):
        self.assertEqual(bulk_density(2500, 0.6), 1500)
        self.assertEqual(bulk_density(2500, 0.6, 1000, 0.5), 1700)
        self.assertEqual(pores_filled(2e-3, 1e-3), 1)
        self.assertEqual(pores_filled(0.5e-3, 1e-3), 0.5)


if __name__ == "__main__":
    unittest.main()
