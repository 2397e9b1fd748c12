#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Along the axis: thickness of slices; humps of a profile: sums of Gaussians are found again, in noise too."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

from millfoam.files.written_times import MillFlow
from millfoam.readings.axial import axial_series, fit_gaussians, gaussians, humps_at_ends, slice_thickness
from report_cases import LENGTH, RADIUS, write_fluid_only

Z = np.linspace(0.005, 0.3, 33)
TWO = (0.003, 0.08, 0.03, 0.002, 0.21, 0.04)
THREE = (0.003, 0.05, 0.02, 0.002, 0.15, 0.025, 0.0025, 0.25, 0.02)
BASE, NOISE = -0.06, 5e-5


class Slices(unittest.TestCase):
    def test_equal_ones_are_as_thick_as_they_are_apart_wherever_they_begin(self):
        np.testing.assert_allclose(slice_thickness(np.array([0.12, 0.14, 0.16])), 0.02)

    def test_of_unequal_ones_fill_the_mill_from_its_feed_end(self):
        thickness = 0.01 * 1.29 ** np.arange(8, -1, -1)
        ends = np.concatenate(([0.0], np.cumsum(thickness)))
        np.testing.assert_allclose(slice_thickness(np.round((ends[1:] + ends[:-1]) / 2, 7)), thickness, atol=1e-6)

    def test_the_last_one_says_what_the_end_of_unequal_ones_is(self):
        z = np.array([0.05, 0.13, 0.18, 0.21, 0.225])
        for place, at_end in ((0.2, 0), (0.223, 0), (0.2245, 1), (0.055, 1), (0.06, 0)):
            with self.subTest(place=place):
                self.assertEqual(humps_at_ends(SimpleNamespace(places=(place,)), z), at_end)


class Pool(unittest.TestCase):
    """Slurry below y = -0.05 m in a mill that turns."""
    LEVEL = 0.05

    def setUp(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "flow"
        self.flow = MillFlow(write_fluid_only(folder, tables=False, voxels=False))

    def test_slices_have_the_pools_height_volume_and_pressure_wherever_the_mill_has_turned(self):
        found = axial_series(self.flow, 0.1)
        half = np.sqrt(RADIUS**2 - self.LEVEL**2)
        area = RADIUS**2 * np.arccos(self.LEVEL / RADIUS) - self.LEVEL * half
        np.testing.assert_allclose(found.times, [0.2, 0.4, 0.6, 0.8])
        np.testing.assert_allclose(found.z, LENGTH * (np.arange(4) + 0.5) / 4)
        # The cells are 30 mm wide
        np.testing.assert_allclose(found.height, -2 / 3 * half**3 / area, atol=0.005)
        np.testing.assert_allclose(found.holdup, area * LENGTH / 4, rtol=0.15)
        np.testing.assert_allclose(found.pressure, np.tile(100 - 1000 * found.z, (4, 1)), rtol=1e-6)

    def test_the_pressure_is_that_of_the_slurry(self):
        read = self.flow.field

        def field(name, path):
            upwards = self.flow.turned(self.flow.centres[:, :2], float(path.name))[:, 1]
            return upwards if name == "p_rgh" else read(name, path)
        with mock.patch.object(self.flow, "field", field):
            found = axial_series(self.flow, 0.1)
        np.testing.assert_allclose(found.pressure, found.height)


class Humps(unittest.TestCase):
    def profile(self, humps, level=NOISE):
        return gaussians(Z, BASE, *humps) + level * np.random.default_rng(5).standard_normal(len(Z))

    def test_two_and_three_are_found_where_they_are(self):
        for humps in (TWO, THREE):
            found = fit_gaussians(Z, self.profile(humps), len(humps) // 3)
            heights, places, widths = np.reshape(humps, (-1, 3)).T
            np.testing.assert_allclose(found.places, places, atol=2e-3)
            np.testing.assert_allclose(found.heights, heights, atol=3e-4)
            np.testing.assert_allclose(found.widths, widths, atol=4e-3)
            np.testing.assert_allclose(found.distances, np.diff(places), atol=3e-3)
            np.testing.assert_allclose(found.fitted(Z), gaussians(Z, BASE, *humps), atol=3 * NOISE)

    def test_what_is_left_is_the_noise(self):
        for humps in (TWO, THREE):
            found = fit_gaussians(Z, self.profile(humps), len(humps) // 3)
            self.assertAlmostEqual(found.rmsd / NOISE, 1, delta=0.4)

    def test_two_are_not_enough_for_three(self):
        profile = self.profile(THREE)
        self.assertGreater(fit_gaussians(Z, profile, 2).rmsd, 5 * fit_gaussians(Z, profile, 3).rmsd)

    def test_no_hump_is_narrower_than_slices_can_show(self):
        # Heights (m) of nine slices of a mill that has no two humps
        z = np.linspace(0.017, 0.288, 9)
        found = fit_gaussians(z, np.array([-42.3, -29.7, -36.0, -48.7, -40.0, -30.9, -45.2, -39.9, -27.3]) / 1e3, 2)
        self.assertGreaterEqual(min(found.widths), (z[1] - z[0]) / 2)
        self.assertLess(found.fitted(np.linspace(z[0], z[-1], 500)).max(), -0.02)

    def test_too_few_slices_are_refused(self):
        with self.assertRaisesRegex(ValueError, "9 places along the axis; a fit of 3 Gaussians needs at least 10"):
            fit_gaussians(Z[:9], Z[:9], 3)


if __name__ == "__main__":
    unittest.main()
