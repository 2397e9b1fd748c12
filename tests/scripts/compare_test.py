#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two maps of a charge are apart, on maps whose difference is known, and measured maps out of a CSV."""
import tempfile
import unittest
import warnings
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from charge_test import RADIUS, below, charge_map, turning
from millfoam.files.measured_map import read_measured
from millfoam.files.solids_file import SolidsMap
from millfoam.readings.compare import CLOSEST, compare, difference, difference_maps, surface_difference
from millfoam.readings.free_surface import free_surface, toe_and_shoulder
from millfoam.report import measurements


def uniform(solidity, speed):
    """A square of 4 x 4 voxels full of balls of one solidity that move along x."""
    edges = np.linspace(0, 1, 5)
    velocity = np.zeros((4, 4, 3))
    velocity[..., 0] = speed
    return SolidsMap(edges, edges, np.ones((4, 4)), np.full((4, 4), solidity), velocity, 0.0, 1.0)


class Difference(unittest.TestCase):
    def test_of_a_map_from_itself_is_nought(self):
        apart = difference(uniform(0.5, 2), uniform(0.5, 2))
        self.assertEqual((apart.solidity, apart.velocity_x, apart.velocity_y), (0, 0, 0))

    def test_of_uniform_maps_is_that_of_their_values(self):
        apart = difference(uniform(0.5, 2), uniform(0.3, 1))
        self.assertAlmostEqual(apart.solidity, 0.2 / CLOSEST)
        self.assertAlmostEqual(apart.velocity_x, 1 / 1.5)
        self.assertAlmostEqual(apart.velocity_y, 0)

    def test_velocities_weigh_by_both_solidities(self):
        a, b = uniform(0.5, 2), uniform(0.3, 2)
        a.solidity[:, :2], b.solidity[:, :2] = 0.1, 0.1
        b.velocity[:, :2, 0] = 1
        self.assertAlmostEqual(difference(a, b).velocity_x, 0.1 * 1 / (0.1 + 0.4) / 2)

    def test_maps_on_other_voxels_are_refused(self):
        other = uniform(0.5, 2)
        other.x = other.x + 0.1
        with self.assertRaisesRegex(ValueError, "same voxels"):
            difference(uniform(0.5, 2), other)

    def test_maps_of_it_and_its_histogram_have_its_sign(self):
        a, b = uniform(0.5, 2), uniform(0.38, 1)
        b.solidity[0] = 0.5
        b.solidity[3, 3] = np.nan
        apart = difference_maps(a, b, 0.02)
        np.testing.assert_allclose(apart.solidity[1:3], 0.12)
        np.testing.assert_allclose(apart.velocity_x[1:3], 1)
        self.assertTrue(np.isnan(apart.solidity[3, 3]) and np.isnan(apart.velocity_x[3, 3]))
        middles = (apart.edges[1:] + apart.edges[:-1]) / 2
        self.assertAlmostEqual(apart.shares.sum(), 1)
        self.assertAlmostEqual(apart.shares[np.abs(middles) < 1e-9][0], 4 / 15)
        self.assertAlmostEqual(apart.shares[np.abs(middles - 0.12) < 1e-9][0], 11 / 15)


class Surface(unittest.TestCase):
    def test_of_flat_ones_is_how_far_they_are_apart(self):
        high, low, tilted = (charge_map(below(line), turning(5, (0, -0.06))) for line in (
            lambda x: -0.03 + 0 * x, lambda x: -0.05 + 0 * x, lambda x: -0.05 - 0.4 * x))
        found = compare(high, low, RADIUS)
        self.assertAlmostEqual(found.surface.mean, 0.02, delta=3e-4)
        self.assertLess(found.surface.deviation, 3e-4)
        self.assertEqual(found.difference, difference(high, low))
        # Height differences 0.4 x, evenly over the chord
        slope = surface_difference(free_surface(low, RADIUS), free_surface(tilted, RADIUS))
        width = slope.end - slope.begin
        self.assertAlmostEqual(slope.mean, 0.4 * (slope.begin + slope.end) / 2, delta=1e-3)
        self.assertAlmostEqual(slope.deviation, 0.4 * width / np.sqrt(12), delta=1e-3)

    def test_of_such_as_do_not_stand_over_each_other_is_refused(self):
        surface = free_surface(charge_map(below(lambda x: -0.03 + 0 * x), turning(5, (0, 0))), RADIUS)
        shifted = free_surface(charge_map(below(lambda x: -0.03 + 0 * x), turning(5, (0, 0))), RADIUS)
        shifted.points = shifted.points + (0.4, 0)
        with self.assertRaisesRegex(RuntimeError, "have no common range of x"):
            surface_difference(surface, shifted)


class Measured(unittest.TestCase):
    ROWS = ["x_m,y_m,solidity,vx,vy", "0.125,0.125,0.4,1.5,-0.5", "0.375,0.125,0.2,,", "0.125,0.875,0,0,0"]

    def read(self, *rows):
        folder = tempfile.TemporaryDirectory(prefix="measured-")
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "measured.csv"
        path.write_text("\n".join(rows) + "\n")
        return read_measured(path, uniform(0.5, 2))

    def test_each_row_is_in_its_voxel(self):
        found = self.read(*self.ROWS)
        np.testing.assert_allclose(found.solidity[(0, 0, 3), (0, 1, 0)], (0.4, 0.2, 0))
        np.testing.assert_allclose(found.velocity[0, 0], (1.5, -0.5, 0))
        self.assertTrue(np.isnan(found.velocity[0, 1, 0]))
        self.assertEqual(np.isfinite(found.solidity).sum(), 3)

    def test_missing_voxels_are_counted_and_left_out(self):
        apart = difference(uniform(0.5, 1.5), self.read(*self.ROWS))
        self.assertEqual(apart.missing, 13)
        self.assertAlmostEqual(apart.solidity, (0.1 + 0.3 + 0.5) / 3 / CLOSEST)
        # Of the two voxels with a velocity: weights 0.45 and 0.25, norm the mean of 1.5 and sqrt(2.5)
        self.assertAlmostEqual(apart.velocity_x, 0.25 * 1.5 / 0.7 / ((1.5 + np.sqrt(2.5)) / 2))

    def test_missing_voxels_do_not_move_the_surface(self):
        charge = charge_map(below(lambda x: -0.03 + 0 * x), turning(5, (0, -0.06)))
        holed = charge_map(below(lambda x: -0.03 + 0 * x), turning(5, (0, -0.06)))
        holed.solidity[20:28, 30:35], holed.velocity[20:28, 30:35] = np.nan, np.nan
        found = surface_difference(free_surface(charge, RADIUS), free_surface(holed, RADIUS))
        self.assertLess(max(abs(found.mean), found.deviation), 1e-3)

    def test_only_what_is_known_of_the_surface_is_read(self):
        # Without this the edge of the lower rows is taken for the surface
        def line(x):
            return -0.03 - 0.4 * x

        charge = charge_map(below(line), turning(5, (-0.03, -0.06)), voxels=32)
        whole = free_surface(charge, RADIUS)
        for rows, columns in ((slice(14), slice(None)), (slice(None), slice(18)), (slice(None), slice(14, None))):
            with self.subTest(f"{rows} {columns}"):
                part = np.full_like(charge.solidity, np.nan)
                part[rows, columns] = charge.solidity[rows, columns]
                found = surface_difference(whole, free_surface(replace(charge, solidity=part), RADIUS))
                self.assertLess(max(abs(found.mean), found.deviation), 1e-3)
                self.assertGreater(found.end - found.begin, 0.4 * RADIUS)
                self.assertLess(found.end - found.begin, 1.4 * RADIUS)
                with self.assertRaisesRegex(RuntimeError, "free surface not known at the (toe|shoulder)"):
                    toe_and_shoulder(replace(charge, solidity=part), RADIUS)

    def test_a_surface_beyond_what_is_known_is_refused(self):
        charge = charge_map(below(lambda x: -0.01 + 0 * x), turning(5, (0, -0.06)), voxels=32)
        charge.solidity[13:] = np.nan
        with self.assertRaisesRegex(RuntimeError, "free surface not known: 0 mm of it are farther than 9.4 mm"):
            free_surface(charge, RADIUS)

    def test_a_whole_map_that_was_written_is_no_different(self):
        charge = charge_map(below(lambda x: -0.03 + 0 * x), turning(5, (0, -0.06)), voxels=33)
        folder = tempfile.TemporaryDirectory(prefix="measured-")
        self.addCleanup(folder.cleanup)
        x, y = np.meshgrid(*charge.centres())
        table = np.column_stack([values.ravel()
                                 for values in (x, y, charge.solidity, *np.moveaxis(charge.velocity, -1, 0)[:2])])
        path = Path(folder.name) / "measured.csv"
        rows = [",".join("" if np.isnan(value) else f"{value:.9g}" for value in row)
                for row in table[charge.inside.ravel() > 0]]
        path.write_text("\n".join(["x_m,y_m,solidity,vx,vy", *rows]) + "\n")
        found = compare(charge, read_measured(path, charge), RADIUS)
        self.assertEqual(found.difference.missing, 0)
        self.assertLess(max(found.difference.solidity, found.difference.velocity_x, abs(found.surface.mean)), 1e-6)

    def test_names_may_have_blanks_and_velocities_may_be_missing(self):
        rows = ["\ufeffx_m, y_m, solidity , vx, vy", "0.125, 0.125, 0.4, 1.5, -0.5", "0.375, 0.125, 0.2, , "]
        spaced = self.read(*rows)
        np.testing.assert_allclose(spaced.solidity[0, :2], (0.4, 0.2))
        np.testing.assert_allclose(spaced.velocity[0, 0], (1.5, -0.5, 0))
        still = self.read(*(",".join(row.split(",")[:3]) for row in rows))
        np.testing.assert_allclose(still.solidity[0, :2], (0.4, 0.2))
        self.assertTrue(np.isnan(still.velocity).all())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            apart = difference(uniform(0.5, 1.5), still)
        self.assertAlmostEqual(apart.solidity, (0.1 + 0.3) / 2 / CLOSEST)
        self.assertTrue(np.isnan(apart.velocity_x) and np.isnan(apart.velocity_y))

    def test_the_report_says_what_is_not_known(self):
        charge = charge_map(below(lambda x: -0.01 + 0 * x), turning(5, (0, -0.06)), voxels=32)
        other = replace(charge, solidity=charge.solidity.copy(), velocity=np.full_like(charge.velocity, np.nan))
        other.solidity[13:] = np.nan
        rows = dict(measurements.difference_rows(SimpleNamespace(charge=charge, radius=RADIUS), other,
                                                 difference_maps(charge, other)))
        self.assertEqual((rows["velocity, x"], rows["velocity, y"]), ("not known", "not known"))
        self.assertIn("not known", rows["free surface"])

    def test_what_is_wrong_is_named(self):
        head, first, *_ = self.ROWS
        for rows, message in (
                (["x_m,y_m,solidity,vx", first], "line 1: no column vy in 'x_m,y_m,solidity,vx'"),
                (["x_m,y_m,vx,vy", first], "line 1: no column solidity in 'x_m,y_m,vx,vy'"),
                ([], "line 1: no column x_m"),
                ([head], "measured.csv: no voxels"),
                ([head, first, "0.375,0.125,much,0,0"],
                 "line 3, column solidity: 'much'; expected a number from 0 to 1"),
                ([head, "0.125,0.125,1.2,0,0"], "line 2, column solidity: '1.2'; expected a number from 0 to 1"),
                ([head, "0.125,0.125,0.4,nan,0"], "line 2, column vx: 'nan'; expected a number"),
                ([head, "0.125,0.125,0.4,1"], "line 2, column vy: ''; expected a number"),
                ([head, "0.2,0.125,0.4,0,0"], "line 2, column x_m: 0.2 m is not a voxel's centre; expected 4 voxels"),
                ([head, "0.125,1.125,0.4,0,0"], "line 2, column y_m: 1.125 m is not a voxel's centre"),
                ([head, first, first], "line 3, columns x_m, y_m: voxel 0.125, 0.125 was given before")):
            with self.subTest(message), self.assertRaisesRegex(ValueError, message):
                self.read(*rows)


if __name__ == "__main__":
    unittest.main()
