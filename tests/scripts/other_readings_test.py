#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Other ways to read tangential velocity and free surface, on maps whose answers are known."""
import unittest

import numpy as np

from charge_test import RADIUS, WALL, below, cell, charge_map, noisy, turning
from millfoam.readings.charge import tangential_profile
from millfoam.readings.free_surface import free_surface, logistic
from millstudies import other_readings as other


def flying(solidity, line, thin):
    """The solidity with a thin flight of balls up to 20 mm above the line."""
    return lambda x, y: np.where((y >= line(x)) & (y < line(x) + 0.02), thin, solidity(x, y))


class Velocity(unittest.TestCase):
    def test_of_rigid_rotation_is_linear_in_every_reading(self):
        # The velocity across a ray of rigid rotation about a point on it is linear in the distance
        charge = charge_map(below(lambda x: 0 * x), turning(5, (0, -RADIUS / np.sqrt(3))))
        for name, reading in other.VELOCITY.items():
            with self.subTest(name):
                self.assertLess(reading(charge, RADIUS), 2e-3 * 5 * RADIUS)

    def test_voxels_lie_on_the_line_once_each_from_the_centre_outwards(self):
        charge = charge_map(below(lambda x: 0 * x), cell)
        rows, columns, distance = other.voxels_on_line(charge, np.array([0.0, -1.0]), RADIUS - WALL)
        self.assertEqual(set(columns), {32})
        np.testing.assert_array_equal(rows, np.arange(32, 32 - len(rows), -1))
        np.testing.assert_allclose(distance, 2 * RADIUS / 65 * np.arange(len(rows)), atol=1e-12)
        self.assertLess(RADIUS - WALL - distance[-1], 2 * RADIUS / 65)

    def test_voxel_by_voxel_is_the_librarys_where_the_map_is_smooth(self):
        charge = charge_map(below(lambda x: 0 * x), cell)
        profile = tangential_profile(charge, RADIUS)
        self.assertAlmostEqual(other.by_voxel(charge, RADIUS), profile.rmsd, delta=0.01 * np.ptp(profile.velocity))

    def test_balls_in_flight_count_from_the_first_balls_on(self):
        charge = charge_map(flying(below(lambda x: 0 * x - 0.03), lambda x: 0 * x - 0.03, 0.03), cell)
        charge.velocity[..., 0] = np.where(charge.solidity < 0.1, 3.0, charge.velocity[..., 0])
        self.assertGreater(other.by_voxel(charge, RADIUS, begin=0), 5 * other.by_voxel(charge, RADIUS))

    def test_degrees_of_freedom_are_taken_off(self):
        self.assertAlmostEqual(other.rms(np.ones(16), 4), np.sqrt(16 / 12))

    def test_a_short_line_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "5 voxels on the line"):
            other.cubic_deviation(np.arange(5.0), np.arange(5.0))


class Surface(unittest.TestCase):
    def slope(self, x):
        return logistic(x, -0.12, 1.0, 30.0, 0.03)

    def test_of_a_logistic_is_a_voxel_at_most_in_the_readings_that_keep_its_form(self):
        charge = charge_map(below(self.slope), turning(5, (-0.03, -0.09)))
        for name in ("as the library reads it", "not smoothed", "highest voxel of each column"):
            with self.subTest(name):
                self.assertLess(other.SURFACE[name](charge, RADIUS), 0.5 * 2 * RADIUS / 65)

    def test_noise_shows_where_it_is_not_smoothed(self):
        charge = noisy(charge_map(below(self.slope), turning(5, (-0.03, -0.09))), 0.2)
        self.assertGreater(other.SURFACE["not smoothed"](charge, RADIUS),
                           1.5 * other.SURFACE["as the library reads it"](charge, RADIUS))

    def test_of_fewer_parameters_is_found_where_they_suffice(self):
        x = np.linspace(-0.1, 0.1, 60)
        centred = np.column_stack([x, logistic(x, -0.12, 1.0, 30.0, 0.03)])
        without_offset = np.column_stack([x, logistic(x, -0.12, 2.0, 30.0, 0)])
        self.assertLess(other.shorter_logistic(centred, RADIUS, [0.0]), 1e-4)
        self.assertGreater(other.shorter_logistic(centred, RADIUS, other.PLACES, offset=False), 5e-3)
        self.assertLess(other.shorter_logistic(without_offset, RADIUS, other.PLACES, offset=False), 1e-3)
        self.assertGreater(other.straight_line(centred), 2e-3)

    def test_thin_flight_is_seen_by_the_reading_of_first_balls_only(self):
        charge = charge_map(flying(below(self.slope), self.slope, 0.03), turning(5, (-0.03, -0.09)))
        rise = np.mean(other.column_tops(charge, RADIUS, other.FIRST_BALLS)[20:40, 1]
                       - other.column_tops(charge, RADIUS, 0.5)[20:40, 1])
        self.assertAlmostEqual(rise, 0.02, delta=0.004)

    def test_the_largest_deviation_is_no_smaller_than_the_rmsd(self):
        charge = charge_map(below(lambda x: 0.02 * np.sin(60 * x) - 0.5 * x - 0.03), turning(5, (-0.03, -0.09)))
        self.assertGreater(other.SURFACE["largest deviation instead of the RMSD"](charge, RADIUS),
                           free_surface(charge, RADIUS).rmsd)


class Windows(unittest.TestCase):
    def test_the_mean_is_over_those_that_have_the_reading(self):
        def reading(one, _radius):
            if one is None:
                raise RuntimeError("nothing to read")
            return one

        self.assertAlmostEqual(other.mean_of_windows(reading, [1.0, None, 3.0], RADIUS), 2.0)
        self.assertTrue(np.isnan(other.mean_of_windows(reading, [None], RADIUS)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
