#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read off maps of the slurry, on maps whose answers are known."""
import unittest
from dataclasses import replace

import numpy as np

from millfoam.files.slurry_file import SlurryMap, VoxelMap
from millfoam.files.solids_file import ANTICLOCKWISE
from millfoam.readings.slurry_on_maps import axial_flow, entrained_air, pixel_angles, pool, slurry_ends

RADIUS, WALL, PIXELS = 0.15, 0.01, 150


def slurry_map(share, along=lambda x, y: 0 * x):
    """Of functions of x and y (m): share within the mill, and velocity along the axis."""
    edges = np.linspace(-RADIUS, RADIUS, PIXELS + 1)
    x = (edges[1:] + edges[:-1]) / 2
    xx, yy = np.meshgrid(x, x)
    shares = np.where(np.hypot(xx, yy) < RADIUS, share(xx, yy), np.nan)
    velocity = np.stack([0 * xx, 0 * xx, along(xx, yy)], axis=-1)
    return SlurryMap(edges, edges, shares, np.where((shares > 0.02)[..., None], velocity, np.nan), source="functions")


def cut_voxels():
    """VoxelMap of 2 x 2 voxels: the shell leaves a tenth of the lower left one; share 0.6 there and 0.9 elsewhere,
    velocity along the axis 0.05 there and 0.01 m/s elsewhere."""
    edges, share = np.array([-0.1, 0.0, 0.1]), np.array([[0.6, 0.9], [0.9, 0.9]])
    velocity = np.zeros((2, 2, 3))
    velocity[..., 2] = np.where(share < 0.9, 0.05, 0.01)
    inside = np.where(share < 0.9, 0.1, 1.0)
    return VoxelMap(edges, edges, share, velocity, inside, share, share, 0.0, 1.0, source="functions")


def bed_and_pool(along):
    """VoxelMap of slurry that fills the lower half: a bed with a voidage of 0.45 below y = -0.075 m, clear of balls
    above it; along: velocity along the axis (m/s) of y."""
    clear = slurry_map(lambda x, y: np.where(y < 0, 1.0, 0.0), lambda x, y: along(y))
    inside = np.isfinite(clear.share).astype(float)
    voidage = np.where(np.meshgrid(*clear.centres())[1] < -0.075, 0.45, 1.0)
    return VoxelMap(clear.x, clear.y, clear.share, clear.velocity, inside, voidage * np.nan_to_num(clear.share),
                    clear.share, 0.0, 1.0, source="functions")


def tilted(degrees):
    """Share of slurry at rest below a level 0.05 m under the axis, turned clockwise."""
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    return lambda x, y: np.where(x * sine + y * cosine < -0.05, 1.0, 0.0)


class EntrainedAir(unittest.TestCase):
    def test_is_weighted_by_the_pores_of_the_wet_charge(self):
        # Rising side: solidity 0.5, a tenth of air; falling side: solidity 0.25, four tenths of air; the rest is dry
        slurry = slurry_map(lambda x, y: np.where(y > 0, 0.3, np.where(x > 0, 0.6, 0.9)))
        x, y = np.meshgrid(*slurry.centres())
        solidity = np.where(x > 0, 0.25, 0.5)
        self.assertAlmostEqual(entrained_air(slurry, solidity), (0.1 * 0.5 + 0.4 * 0.75) / (0.5 + 0.75), places=12)

    def test_has_of_voxels_that_the_shell_cuts_only_their_part(self):
        found = entrained_air(cut_voxels(), np.full((2, 2), 0.5))
        self.assertAlmostEqual(found, (0.1 * 0.4 + 3 * 0.1) / 3.1, places=12)

    def test_slurry_clear_of_the_charge_has_none(self):
        slurry = slurry_map(lambda x, y: 0 * x + 0.9)
        self.assertTrue(np.isnan(entrained_air(slurry, np.full(slurry.share.shape, 0.1))))


class Ends(unittest.TestCase):
    def test_are_where_the_level_meets_the_circle(self):
        half = np.degrees(np.arccos(0.05 / (RADIUS - WALL)))
        for tilt in (0, 35):
            found = slurry_ends(slurry_map(tilted(tilt)), RADIUS, WALL)
            np.testing.assert_allclose(found, (tilt - half, tilt + half), atol=1.5)

    def test_of_a_mill_that_turns_the_other_way_are_those_of_its_mirror_image(self):
        mirrored = replace(slurry_map(tilted(-35)), sense=ANTICLOCKWISE)
        here = slurry_map(tilted(35))
        np.testing.assert_allclose(slurry_ends(mirrored, RADIUS, WALL), slurry_ends(here, RADIUS, WALL), atol=1e-6)
        np.testing.assert_allclose(pixel_angles(mirrored)[:, ::-1], pixel_angles(here), atol=1e-9)

    def test_there_are_none_without_slurry(self):
        self.assertTrue(np.isnan(slurry_ends(slurry_map(lambda x, y: 0 * x), RADIUS, WALL)).all())

    def test_the_shell_takes_nothing_off_the_share(self):
        # So near the shell that pixels outside have a part in it
        half = np.degrees(np.arccos(0.05 / (RADIUS - 5e-4)))
        found = slurry_ends(slurry_map(lambda x, y: 0.6 * tilted(0)(x, y)), RADIUS, 5e-4)
        np.testing.assert_allclose(found, (-half, half), atol=3)


class APool(unittest.TestCase):
    def test_without_balls_is_all_slurry(self):
        found = pool(slurry_map(tilted(0)), np.zeros((PIXELS, PIXELS)))
        segment = RADIUS**2 * np.arccos(0.05 / RADIUS) - 0.05 * np.sqrt(RADIUS**2 - 0.05**2)
        self.assertAlmostEqual(found.area / segment, 1, delta=0.01)
        self.assertAlmostEqual(found.level, -0.05, delta=1e-9)
        self.assertLess(found.deviation, 1e-9)

    def test_has_of_voxels_that_the_shell_cuts_only_their_part(self):
        # 15 voxels across the mill, 20 mm wide: whole voxels would hold 12 % more
        edges = np.linspace(-RADIUS, RADIUS, 16)
        fine = (np.arange(15 * 50) + 0.5) / (15 * 50) * 2 * RADIUS - RADIUS
        within = np.hypot(*np.meshgrid(fine, fine)) < RADIUS
        inside = within.reshape(15, 50, 15, 50).mean(axis=(1, 3))
        middles = (edges[1:] + edges[:-1]) / 2
        share = np.where(inside > 0, np.meshgrid(middles, middles)[1] < -0.05, np.nan)
        coarse = VoxelMap(edges, edges, share, np.zeros((15, 15, 3)), inside, share, share, 0.0, 1.0,
                          source="functions")
        segment = RADIUS**2 * np.arccos(0.05 / RADIUS) - 0.05 * np.sqrt(RADIUS**2 - 0.05**2)
        self.assertAlmostEqual(pool(coarse, np.zeros((15, 15))).area / segment, 1, delta=1e-3)
        self.assertGreater(np.nansum(share) * coarse.pixel() / segment, 1.1)

    def test_is_what_stands_in_front_of_the_charge(self):
        # Slurry up to x = 0.08 under the level, in balls left of x = 0.04; some away from it on the left
        slurry = slurry_map(lambda x, y: np.where((y < -0.05) & (y > -0.09) & (x < 0.08), 0.8, 0.0))
        xx, yy = np.meshgrid(*slurry.centres())
        solidity = np.where((xx > -0.11) & (xx < 0.04), 0.5, 0.05)
        found = pool(slurry, solidity)
        # Without the few balls in it
        self.assertAlmostEqual(found.area, 0.04 * 0.04 * 0.8 * 0.95, delta=1e-9)
        self.assertAlmostEqual(found.level, -0.05, delta=1e-9)
        self.assertTrue(np.all(xx[found.where] > 0.04))

    def test_its_surface_may_slope(self):
        slurry = slurry_map(lambda x, y: np.where((np.abs(x) < 0.06) & (y < 0.5 * x) & (y > -0.1), 1.0, 0.0))
        found = pool(slurry, np.zeros((PIXELS, PIXELS)))
        self.assertAlmostEqual(found.level, 0, delta=2e-3)
        self.assertAlmostEqual(found.deviation, 0.5 * 0.12 / np.sqrt(12), delta=1e-3)

    def test_is_none_of_a_splash(self):
        # Slurry of 2580 pixels is in the charge; the drops are above the axis
        for drops, there in ((2, False), (3, True)):
            slurry = slurry_map(lambda x, y: np.where(y < -0.05, 1.0, 0.0))
            solidity = np.full((PIXELS, PIXELS), 0.5)
            row = 3 * PIXELS // 4
            slurry.share[row, 40:40 + drops] = 1.0
            solidity[row] = 0.0
            self.assertEqual(pool(slurry, solidity).area > 0, there)

    def test_there_is_none_where_balls_are_everywhere(self):
        found = pool(slurry_map(tilted(0)), np.full((PIXELS, PIXELS), 0.5))
        self.assertEqual(found.area, 0)
        self.assertTrue(np.isnan(found.level))
        with self.assertRaisesRegex(ValueError, "expected the same"):
            pool(slurry_map(tilted(0)), np.zeros((3, 3)))


class AlongTheAxis(unittest.TestCase):
    def flow(self, along, share=tilted(30)):
        slurry = slurry_map(share, along)
        return axial_flow(slurry, *slurry_ends(slurry, RADIUS, WALL))

    def test_to_the_discharge_at_the_toe_and_back_at_the_shoulder(self):
        # The line straight down from the axis of the tilted pool parts it: x cos 30 - y sin 30 > 0 is the toe's half
        def toe(x, y):
            return x * np.cos(np.pi / 6) - y * np.sin(np.pi / 6)

        found = self.flow(lambda x, y: np.where(toe(x, y) > 0, 0.02, -0.01))
        self.assertAlmostEqual(found.middle, 30, delta=0.5)
        self.assertAlmostEqual(found.toe.mean, 0.02, delta=4e-4)
        self.assertAlmostEqual(found.shoulder.mean, -0.01, delta=4e-4)
        self.assertTrue(found.circulates)
        self.assertFalse(self.flow(lambda x, y: np.where(toe(x, y) > 0, -0.02, 0.01)).circulates)
        self.assertFalse(self.flow(lambda x, y: 0.01 + 0 * x).circulates)

    def test_range_is_that_of_most_of_it(self):
        # A pool left and right of the axis, with a velocity even over its toe's half, from 0 to 0.1 m/s
        found = axial_flow(slurry_map(lambda x, y: np.where((np.abs(x) < 0.1) & (y < -0.02) & (y > -0.11), 1.0, 0.0),
                                      lambda x, y: np.where(x > 0, x, -0.05)), -45, 45)
        self.assertAlmostEqual(found.toe.lowest, 0.005, delta=2e-3)
        self.assertAlmostEqual(found.toe.highest, 0.095, delta=2e-3)
        self.assertAlmostEqual(found.shoulder.highest, -0.05)

    def test_voxels_that_the_shell_cuts_have_only_their_part(self):
        # The line straight down from the axis parts left and right
        found = axial_flow(cut_voxels(), -90, 90)
        halves = sorted((found.toe.mean, found.shoulder.mean))
        self.assertAlmostEqual(halves[0], 0.01, places=12)
        self.assertAlmostEqual(halves[1], (0.06 * 0.05 + 0.9 * 0.01) / 0.96, places=12)

    def test_mean_is_that_of_the_slurry(self):
        slurry = slurry_map(lambda x, y: np.where(y < -0.05, 0.9, 0.6), lambda x, y: np.where(y < -0.05, 0.01, 0.0))
        found = axial_flow(slurry, -90, 90)
        segment = RADIUS**2 * np.arccos(0.05 / RADIUS) - 0.05 * np.sqrt(RADIUS**2 - 0.05**2)
        wanted = 0.01 * 0.9 * segment / (0.9 * segment + 0.6 * (np.pi * RADIUS**2 - segment))
        self.assertAlmostEqual(found.toe.mean / wanted, 1, delta=0.02)

    def test_balls_leave_less_slurry_in_a_bed(self):
        # 20 mm/s in the pool, none in the bed. By the share of the fluid alone it would be 12.2 mm/s
        found = axial_flow(bed_and_pool(lambda y: np.where(y < -0.075, 0.0, 0.02)), -90, 90)
        half, segment = np.pi / 2, np.pi / 3 - np.sqrt(3) / 4  # over the radius squared
        for side in (found.toe, found.shoulder):
            self.assertAlmostEqual(side.mean, 0.02 * (half - segment) / (half - 0.55 * segment), delta=2e-4)

    def test_thin_slurry_does_not_count(self):
        found = self.flow(lambda x, y: np.where(y < -0.05, 0.01, 9.0), lambda x, y: np.where(y < -0.05, 1.0, 0.4))
        self.assertAlmostEqual(found.toe.mean, 0.01)

    def test_no_slurry_on_a_half_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "no slurry on the half of the toe: it reaches from -170 to -120"):
            axial_flow(slurry_map(lambda x, y: np.where(x > 0.1, 1.0, 0.0)), -170, -120)


if __name__ == "__main__":
    unittest.main()
