#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mechanistic models against closed forms, their limits and quadrature."""
import unittest

import numpy as np
from scipy.integrate import quad

from millfoam.readings.models import (Charge, describes, fit_free_surface, free_surface, grate_hold_up,
                                      mean_grate_radius, slurry_depth, slurry_hold_up, surface_number)

CHARGE = Charge(radius=0.15, length=0.3, porosity=0.4, diameter=0.005)
SLURRY = {"viscosity": 0.01, "density": 1300.0}


class Surface(unittest.TestCase):
    def test_without_end_friction_it_is_a_straight_line_through_the_axis_at_half_filling(self):
        surface = free_surface(0.5, 0.0, 0.3, filling=0.5, clockwise=False)
        np.testing.assert_allclose(surface.y, 0.5 * surface.x, atol=1e-8)
        np.testing.assert_allclose(surface.x[[0, -1]], [-1 / np.sqrt(1.25), 1 / np.sqrt(1.25)], rtol=1e-6)

    def test_of_a_flat_one_the_filling_is_that_of_a_segment(self):
        for height in (-0.7, -0.2, 0.4):
            angle = 2 * np.arccos(-height)
            surface = free_surface(0.0, 0.0, 0.3, height=height)
            self.assertAlmostEqual(surface.filling, (angle - np.sin(angle)) / (2 * np.pi), places=8)

    def test_encloses_the_filling_asked_for(self):
        surface = free_surface(0.4, 0.8, 0.5, filling=0.3)
        turn = np.linspace(np.arctan2(surface.y[0], surface.x[0]) % (2 * np.pi),
                           np.arctan2(surface.y[-1], surface.x[-1]) % (2 * np.pi), 2000)
        x, y = np.concatenate([np.cos(turn), surface.x[::-1]]), np.concatenate([np.sin(turn), surface.y[::-1]])
        area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        self.assertAlmostEqual(area / np.pi, 0.3, places=4)

    def test_has_the_slope_of_the_equation(self):
        surface = free_surface(0.4, 0.8, 0.5, filling=0.4, clockwise=False, points=4001)
        middle = slice(100, -100)
        slope = np.gradient(surface.y, surface.x)[middle]
        expected = 0.4 + 0.8 * 0.5 * np.sqrt((1 - surface.x ** 2 - surface.y ** 2)[middle])
        np.testing.assert_allclose(slope, expected, rtol=1e-4)

    def test_of_a_clockwise_mill_is_its_mirror_image_high_on_the_left(self):
        one, other = (free_surface(0.4, 0.8, 0.5, filling=0.4, clockwise=sense) for sense in (True, False))
        np.testing.assert_allclose(one.x, -other.x[::-1])
        np.testing.assert_allclose(one.y, other.y[::-1])
        self.assertGreater(one.y[0], one.y[-1])

    def test_is_fitted_back_with_and_without_the_filling(self):
        surface = free_surface(0.45, 0.7, 0.5, filling=0.35)
        for filling in (0.35, None):
            found, rest = fit_free_surface(surface.x[5:-5], surface.y[5:-5], 0.5, filling)
            self.assertAlmostEqual(found.internal, 0.45, places=3)
            self.assertAlmostEqual(found.wall, 0.7, places=3)
            self.assertAlmostEqual(found.height, surface.height, places=4)
            self.assertLess(rest, 1e-4)

    def test_that_is_fitted_is_described(self):
        surface = free_surface(0.45, 0.7, 0.5, filling=0.35)
        self.assertTrue(describes(*fit_free_surface(surface.x[5:-5], surface.y[5:-5], 0.5)))

    def test_that_asks_for_negative_friction_is_fitted_with_none_and_not_described(self):
        along = np.linspace(-0.7, 0.6, 60)
        # Bent up at both ends, as no friction bends it; steepest at the axis, as much of the ends' friction and less
        # than none within would make it
        for height in (0.4 * along + 0.3 * along ** 2, 0.4 * np.sin(3 * along)):
            found, rest = fit_free_surface(-along, height, 0.2)
            self.assertGreaterEqual(min(found.internal, found.wall), 0)
            self.assertFalse(describes(found, rest))

    def test_number_has_no_dimension(self):
        # Lengths in cm and times in ms with gravity in cm/ms^2 would give the same: Omega^2 d / g and R / L are pure
        # numbers
        self.assertAlmostEqual(surface_number(6.0, 0.005, 0.15, 0.3), (36 * 0.005 / 9.81) ** 0.25 / 2, places=12)
        self.assertAlmostEqual(surface_number(3.0, 0.02, 0.15, 0.3), surface_number(6.0, 0.005, 0.15, 0.3), places=12)

    def test_other_than_one_of_filling_and_height_is_refused(self):
        with self.assertRaisesRegex(ValueError, "one of them"):
            free_surface(0.4, 0.1, 0.5)
        with self.assertRaisesRegex(ValueError, "filling 1.2"):
            free_surface(0.4, 0.1, 0.5, filling=1.2)


class HoldUp(unittest.TestCase):
    def test_is_the_integral_of_the_pores_cross_section_over_the_length(self):
        for flow, depth in ((5e-7, 0.02), (1e-5, 0.02), (1e-4, 0.02), (1e-4, 0.0), (1e-3, 0.05)):
            integral = quad(lambda z: 0.4 * CHARGE.cross_section(slurry_depth(CHARGE, z, flow, depth, **SLURRY)), 0,
                            0.3, epsrel=1e-12)[0]
            self.assertAlmostEqual(slurry_hold_up(CHARGE, flow, depth, **SLURRY) / integral, 1, places=9)

    def test_is_the_printed_formula_where_that_does_not_cancel(self):
        flow, depth = 2e-4, 0.03
        b = CHARGE.resistance(**SLURRY)
        feed_end = (depth ** 2.5 + 2.5 * b * flow * 0.3) ** 1.6
        printed = 0.4 * np.pi * np.sqrt(0.15) * (feed_end - depth ** 4) / (8 * b * flow)
        self.assertAlmostEqual(slurry_hold_up(CHARGE, flow, depth, **SLURRY) / printed, 1, places=12)

    def test_without_flow_is_that_of_a_flat_pool_and_no_flow_is_reached_smoothly(self):
        pool = 0.4 * np.pi / 2 * np.sqrt(0.15) * 0.02 ** 1.5 * 0.3
        for flow in (0.0, 1e-30, 1e-16):
            self.assertAlmostEqual(slurry_hold_up(CHARGE, flow, 0.02, **SLURRY) / pool, 1, places=9)
        np.testing.assert_allclose(slurry_depth(CHARGE, [0, 0.1, 0.3], 0.0, 0.02, **SLURRY), 0.02)

    def test_of_depth_obeys_darcys_law(self):
        z = np.linspace(0, 0.299, 2001)
        depth = slurry_depth(CHARGE, z, 1e-4, 0.02, **SLURRY)
        filter_velocity = -CHARGE.permeability() * 1300 * 9.81 / 0.01 * np.gradient(depth, z)
        np.testing.assert_allclose((CHARGE.cross_section(depth) * filter_velocity)[5:-5], 1e-4, rtol=1e-3)

    def test_the_cross_section_is_half_the_circle_at_the_axis(self):
        self.assertAlmostEqual(CHARGE.cross_section(0.15), np.pi * 0.15 ** 2 / 2)

    def test_negative_flow_is_refused(self):
        with self.assertRaisesRegex(ValueError, "flow -1"):
            slurry_hold_up(CHARGE, -1.0, 0.02, **SLURRY)


class GrateHoldUp(unittest.TestCase):
    # A mill of 1 m, at critical speed, whose holes are all at its shell: factors of 1 but for the area
    MILL = {"diameter": 1.0, "grate_radius": 0.5, "critical_share": 1.0}

    def test_is_the_root_of_the_flow_through_the_charge(self):
        self.assertAlmostEqual(grate_hold_up(61 / 3600, open_area=0.04, **self.MILL), 0.5, places=12)

    def test_a_pool_takes_what_the_charge_cannot(self):
        # 24.4 m3/h fill a tenth of 1 m2 up to the pores' share of 0.2; 93.5 m3/h more a pool of a whole mill
        flow = (24.4 + 93.5) / 3600
        self.assertAlmostEqual(grate_hold_up(flow, open_area=0.1, most=0.2, **self.MILL), 1.2, places=12)
        self.assertAlmostEqual(grate_hold_up(24.4 / 3600, open_area=0.1, most=0.2, **self.MILL), 0.2, places=12)

    def test_radius_speed_and_diameter_have_their_powers(self):
        whole = grate_hold_up(1e-3, 1.0, 0.5, 0.1, 1.0)
        for change, power in (({"grate_radius": 0.25}, 2 ** 1.25), ({"critical_share": 0.5}, 2 ** -0.69),
                              ({"diameter": 4.0, "grate_radius": 2.0}, 4 ** -0.25), ({"open_area": 0.2}, 2 ** -0.5)):
            found = grate_hold_up(1e-3, **{**self.MILL, "open_area": 0.1, **change})
            self.assertAlmostEqual(found / whole, power, places=12)

    def test_holes_lie_farther_out_than_the_middle(self):
        self.assertAlmostEqual(mean_grate_radius(0.0, 0.3), 0.2)
        self.assertAlmostEqual(mean_grate_radius(0.2999, 0.3001), 0.3, places=6)

    def test_holes_outside_the_mill_are_refused(self):
        with self.assertRaisesRegex(ValueError, "grates at 0.6 m"):
            grate_hold_up(1e-3, 1.0, 0.6, 0.1, 1.0)


if __name__ == "__main__":
    unittest.main()
