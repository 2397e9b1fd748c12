#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Along the axis: a pool in a mesh that turns; thickness of slices; humps of a profile: sums of Gaussians are found
again, in noise too."""
import contextlib
import io
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

from millfoam.files.written_times import MillFlow
from millfoam.readings.axial import (AxialProfile, axial_profile, axial_series, fit_gaussians, gaussians, humps_at_ends,
                                     slice_thickness)
from report_cases import HEAD, hexahedra, write_field, write_mesh
from study_scripts import load

Z = np.linspace(0.005, 0.3, 33)
TWO = (0.003, 0.08, 0.03, 0.002, 0.21, 0.04)
THREE = (0.003, 0.05, 0.02, 0.002, 0.15, 0.025, 0.0025, 0.25, 0.02)
BASE, NOISE = -0.06, 5e-5


class TurnedPool(unittest.TestCase):
    """A pool at the lowest side of a square box of 0.2 m that has turned by a quarter and by half of a turn. The lower
    of its two rows of cells has balls of solidity 0.5."""
    OMEGA, SIDE, CELL, THICKNESS, SLICES = -6.0, 0.2, 0.025, 0.02, 3
    LOWEST, SECOND = -0.0875, -0.0625  # y (m) of the rows
    HEIGHT = (0.5 * LOWEST + SECOND) / 1.5
    HOLDUP = 1.5 * SIDE * CELL * THICKNESS

    def setUp(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        length = self.SLICES * self.THICKNESS
        # One layer more is behind the grates
        points = hexahedra.box((-0.1, -0.1, 0), (0.1, 0.1, length + self.THICKNESS), (8, 8, self.SLICES + 1))
        write_mesh(folder / "constant" / "polyMesh", points)
        (folder / "constant" / "millProperties").write_text(
            HEAD.format("dictionary", "millProperties")
            + f"radius 0.1;\nlength {length};\nomega {self.OMEGA};\ntime0 0;\n")
        (folder / "constant" / "bedProperties").write_text(HEAD.format("dictionary", "bedProperties"))
        self.places = (points[:-1, :-1, :-1] / 2 + points[1:, 1:, 1:] / 2).reshape(-1, 3)
        quarter = np.pi / 2 / abs(self.OMEGA)
        self.write(folder, 0.1, 0.1 * self.OMEGA, 1.0)
        self.write(folder, quarter, -np.pi / 2, 1.0)
        self.write(folder, 2 * quarter, -np.pi, 0.4)
        self.begin, self.flow = quarter, MillFlow(folder)

    def write(self, folder, time, angle, share):
        """Fields at a time (s) at which the mesh has turned by an angle (rad): in the pool, slurry takes this share of
        the space between the balls; none is in the last slice before the grates."""
        y = np.sin(angle) * self.places[:, 0] + np.cos(angle) * self.places[:, 1]
        z = self.places[:, 2]
        pool = (y < -0.05) & (np.abs(z - (self.SLICES - 0.5) * self.THICKNESS) > 1e-6)
        for name, values in (("alpha.slurry", share * pool), ("solidity", 0.5 * (y < -0.075)),
                             ("p_rgh", 100 - 1000 * z + 500 * y)):
            write_field(folder / f"{time:.9f}" / name, values)

    def test_has_height_hold_up_and_pressure_of_the_lab(self):
        series = axial_series(self.flow, self.begin)
        np.testing.assert_allclose(series.z, [0.01, 0.03, 0.05])
        np.testing.assert_allclose(series.times, [self.begin, 2 * self.begin], rtol=1e-8)
        np.testing.assert_allclose(series.height, [[self.HEIGHT, self.HEIGHT, np.nan]] * 2, rtol=1e-7)
        np.testing.assert_allclose(series.holdup, np.outer([1, 0.4], [self.HOLDUP, self.HOLDUP, 0]), rtol=1e-7)
        pressure = [*(100 - 1000 * series.z[:2] + 500 * self.HEIGHT), np.nan]
        np.testing.assert_allclose(series.pressure, [pressure] * 2, rtol=1e-7)

    def test_has_means_over_its_times(self):
        filled = slice(self.SLICES - 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # the last slice never has slurry
            profile = axial_profile(self.flow, self.begin)
        np.testing.assert_allclose(profile.holdup, [0.7 * self.HOLDUP, 0.7 * self.HOLDUP, 0], rtol=1e-7)
        np.testing.assert_allclose(profile.height[filled], self.HEIGHT, rtol=1e-7)
        np.testing.assert_allclose(profile.height_spread[filled], 0, atol=1e-9)
        np.testing.assert_allclose(profile.pressure[filled], 100 - 1000 * profile.z[filled] + 500 * self.HEIGHT)
        self.assertTrue(np.isnan([profile.height[-1], profile.pressure[-1]]).all())

    def test_of_a_time_that_was_not_written_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "no time from 2 s on was written"):
            axial_series(self.flow, 2)


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
        with self.assertRaisesRegex(RuntimeError, "9 places along the axis; a fit of 3 Gaussians needs at least 10"):
            fit_gaussians(Z[:9], Z[:9], 3)

    def test_a_slice_without_slurry_is_named(self):
        profile = self.profile(TWO)
        profile[-1] = np.nan
        with self.assertRaisesRegex(RuntimeError, "no slurry in the slice at 300 mm; a fit of 2 Gaussians needs it"):
            fit_gaussians(Z, profile, 2)

    def test_a_flat_profile_has_none(self):
        for height in (np.full(len(Z), BASE), BASE + 1e-12 * Z):
            with self.assertRaisesRegex(RuntimeError, "the heights differ by .* m; a profile with humps"):
                fit_gaussians(Z, height, 2)


class Printed(unittest.TestCase):
    """What the 30 cm mill's axial.py prints of a profile."""

    def setUp(self):
        self.script = load("mills/mill_30cm/axial.py", "mill_30cm_axial")

    def printed(self, slices, dry=()):
        script = self.script
        z = Z[:slices]
        height, holdup = gaussians(z, BASE, *TWO), np.full(slices, 1e-6)
        height[list(dry)], holdup[list(dry)] = np.nan, 0
        profile = AxialProfile(z, height, 0 * z, holdup, 100 - 1000 * z + 0 * height)
        words = io.StringIO()
        with contextlib.redirect_stdout(words):
            script.print_profile(profile, script.fit_profile(profile))
        script.plot_profile(profile, script.fit_profile(profile), io.BytesIO())
        return words.getvalue()

    def test_one_layer_of_cells_is_refused(self):
        errors, one = io.StringIO(), np.ones(1)
        flow = SimpleNamespace(frames=[(1.0, None)])
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(errors), \
                mock.patch.multiple(self.script, MillFlow=lambda _: flow,
                                    axial_profile=lambda *_: AxialProfile(one, one, one, one, one)), \
                mock.patch.object(sys, "argv", ["axial.py", folder, "--begin", "0.5"]), self.assertRaises(SystemExit):
            self.script.main()
        self.assertRegex(errors.getvalue(), "one layer of cells along the axis; expected two or more$")

    def test_gaussians_are_not_known_of_too_few_slices(self):
        words = self.printed(9)
        self.assertRegex(words, "(?m)^2 Gaussians: humps at ")
        self.assertRegex(words, "(?m)^3 Gaussians: not known: 9 places along the axis; a fit of 3 .* at least 10$")

    def test_slices_without_slurry_leave_the_rest(self):
        words = self.printed(33, dry=(31, 32))
        self.assertNotIn("nan", words)
        self.assertRegex(words, "^height .*: mean -58.* mm along the axis; 2 of 33 slices hold no slurry\n")
        self.assertRegex(words, "(?m)^2 Gaussians: not known: no slurry in the slice at 290.8 mm")
        self.assertRegex(words, "(?m)^p_rgh .*: 95.0 Pa at z = 5 mm, -181.6 Pa at z = 282 mm, drop 276.6 Pa$")
        self.assertEqual(self.printed(9, dry=range(9)),
                         "height of the slurry's centre of mass: not known: no slice holds slurry\n")


if __name__ == "__main__":
    unittest.main()
