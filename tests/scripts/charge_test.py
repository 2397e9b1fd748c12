#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read off a map of the charge, on maps whose answers are known in closed form."""
import unittest
from dataclasses import replace

import numpy as np

from millfoam.files.solids_file import ANTICLOCKWISE, SolidsMap
from millfoam.readings.charge import (circulation_centre, read_charge, shell_following, stream_function,
                                      tangential_profile)
from millfoam.readings.free_surface import fit_logistic, free_surface, logistic, pieces_within, toe_and_shoulder

RADIUS, WALL, PHI = 0.15, 0.008, 0.55


def charge_map(solidity, velocity, voxels=65, part=8):
    """Map of a mill, of functions of x and y (m): solidity and inside are means over part x part points of each
    voxel."""
    edges = np.linspace(-RADIUS, RADIUS, voxels + 1)
    fine = np.linspace(-RADIUS, RADIUS, 2 * voxels * part + 1)[1::2]
    x, y = np.meshgrid(fine, fine)
    inside = (np.hypot(x, y) < RADIUS).astype(float)

    def mean(values):
        return values.reshape(voxels, part, voxels, part).mean(axis=(1, 3))

    room, balls = mean(inside), mean(inside * solidity(x, y))
    flux = np.stack([mean(inside * solidity(x, y) * component) for component in (*velocity(x, y), 0 * x)], axis=-1)
    with np.errstate(invalid="ignore"):
        return SolidsMap(edges, edges, room, np.where(room > 0, balls / room, 0.0),
                         np.where(balls[..., None] > 1e-6, flux /
                         balls[..., None], np.nan), 0.0, 1.0)


def below(line):
    """Solidity PHI below the line y = line(x), zero above."""
    return lambda x, y: np.where(y < line(x), PHI, 0.0)


def turning(speed, centre):
    """Rigid clockwise rotation with `speed` (rad/s) about a point."""
    return lambda x, y: (speed * (y - centre[1]), -speed * (x - centre[0]))


def cell(x, y):
    """Flow of a charge of solidity PHI in the lower half of the mill that passes neither shell nor surface: of the
    stream function y (R^2 - r^2), whose centre is R/sqrt(3) below the axis."""
    return (RADIUS**2 - x**2 - 3 * y**2) * 300, 2 * x * y * 300


def noisy(charge, level):
    """The map with noise of `level` times the largest speed on its velocities, and `level` times PHI on solidities."""
    random = np.random.default_rng(7)
    speed = np.nanmax(np.abs(charge.velocity))
    charge.velocity = charge.velocity + level * speed * random.standard_normal(charge.velocity.shape)
    charge.solidity = np.clip(charge.solidity + level * PHI * random.standard_normal(charge.solidity.shape), 0, 1)
    return charge


class ShellFollowing(unittest.TestCase):
    def test_is_the_share_of_the_shells_speed(self):
        for share in (1.0, 0.3, 0.0):
            charge = charge_map(below(lambda x: 0 * x), turning(5 * share, (0, 0)))
            self.assertAlmostEqual(shell_following(charge, RADIUS, -5), share, places=2)

    def test_of_a_flow_that_goes_round_within_the_charge_is_read_at_the_shell(self):
        charge = charge_map(below(lambda x: 0 * x), lambda x, y: (
            np.where(np.hypot(x, y) > 0.12, -1, 1) * -5 * y, np.where(np.hypot(x, y) > 0.12, -1, 1) * 5 * x))
        self.assertAlmostEqual(shell_following(charge, RADIUS, -5), 1, places=2)

    def test_is_refused_of_a_mill_at_rest_and_of_one_without_balls_at_the_shell(self):
        with self.assertRaisesRegex(RuntimeError, "at rest"):
            shell_following(charge_map(below(lambda x: 0 * x), turning(5, (0, 0))), RADIUS, 0)
        ball = charge_map(lambda x, y: np.where(np.hypot(x, y) < 0.05, PHI, 0.0), turning(5, (0, 0)))
        with self.assertRaisesRegex(RuntimeError, "no dense charge at the shell"):
            shell_following(ball, RADIUS, -5)


class Centre(unittest.TestCase):
    def test_of_a_rigidly_turning_half_disc_is_where_it_turns_about(self):
        centre = (-0.03, -0.06)
        found = circulation_centre(charge_map(below(lambda x: 0 * x), turning(5, centre)), RADIUS)
        # Voxels cut by the surface have the velocity of their lower part only
        np.testing.assert_allclose(found, centre, atol=1e-5)

    def test_of_a_closed_stream_is_that_of_its_stream_function(self):
        for voxels in (33, 65):
            found = circulation_centre(charge_map(below(lambda x: 0 * x), cell, voxels), RADIUS)
            np.testing.assert_allclose(found, (0, -RADIUS / np.sqrt(3)), atol=1.5e-3)

    def test_is_found_in_noise(self):
        for voxels in (33, 65):
            found = circulation_centre(noisy(charge_map(below(lambda x: 0 * x), cell, voxels), 0.04), RADIUS)
            np.testing.assert_allclose(found, (0, -RADIUS / np.sqrt(3)), atol=5e-3)

    def test_stream_function_is_that_of_the_flux(self):
        charge = charge_map(below(lambda x: 0 * x), cell)
        x, y = np.meshgrid(*charge.centres())
        exact = np.where((y < 0) & (np.hypot(x, y) < RADIUS), 300 * PHI * y * (RADIUS**2 - x**2 - y**2), 0)
        apart = np.abs(stream_function(charge) - exact) / np.abs(exact).max()
        self.assertAlmostEqual(stream_function(charge).min() / exact.min(), 1, delta=0.02)
        # Where the flux ends within a voxel, at shell and surface, only its share of the depth is known
        self.assertLess(apart.max(), 2 / 33)

    def test_there_is_none_where_nothing_turns_with_the_mill(self):
        half = below(lambda x: 0 * x)
        for velocity in (lambda x, y: (0 * x, 0 * y), turning(-5, (0, -0.06))):
            with self.assertRaisesRegex(RuntimeError, "no centre of circulation: .* turns with the mill"):
                circulation_centre(charge_map(half, velocity), RADIUS)
        with self.assertRaisesRegex(RuntimeError, "no centre of circulation"):
            circulation_centre(charge_map(half, lambda x, y: (1 + 0 * x, 0 * y)), RADIUS)

    def test_there_is_none_in_mere_noise(self):
        def noise(x, y):
            return np.random.default_rng(1).standard_normal((2, *x.shape))

        with self.assertRaisesRegex(RuntimeError, "no centre of circulation: .* turns with the mill, less than 30%"):
            circulation_centre(charge_map(below(lambda x: 0 * x), noise, part=1), RADIUS)

    def test_there_is_none_in_a_centrifuging_ring_or_an_empty_mill(self):
        ring = charge_map(lambda x, y: np.where(np.hypot(x, y) > 0.1, PHI, 0), turning(8, (0, 0)))
        with self.assertRaisesRegex(RuntimeError, "solidity is .*covers 100 % of the shell: it centrifuges"):
            circulation_centre(ring, RADIUS)
        with self.assertRaisesRegex(RuntimeError, "no charge: .*0.05"):
            circulation_centre(charge_map(lambda x, y: 0 * x, turning(8, (0, 0))), RADIUS)


class Surface(unittest.TestCase):
    def test_a_flat_one_meets_the_shell_at_the_angles_of_its_chord(self):
        # y = -0.05, and the same turned by 30 degrees clockwise: the left side is up
        for tilt in (0, 30):
            sine, cosine = np.sin(np.radians(tilt)), np.cos(np.radians(tilt))
            tilted = charge_map(lambda x, y: np.where(x * sine + y * cosine < -0.05, PHI, 0.0), turning(5, (0, 0)))
            half = np.degrees(np.arccos(0.05 / (RADIUS - WALL)))
            np.testing.assert_allclose(toe_and_shoulder(tilted, RADIUS, WALL), (tilt - half, tilt + half), atol=0.5)
            points = free_surface(tilted, RADIUS, WALL).points
            np.testing.assert_allclose(points @ (sine, cosine), -0.05, atol=1e-3)
            self.assertLess(points[0, 0], points[-1, 0])

    def test_a_charge_over_the_top_keeps_its_shoulder_on_the_rising_side(self):
        over = charge_map(lambda x, y: np.where(x < -0.02, PHI, 0.0), turning(5, (0, 0)))
        half = np.degrees(np.arccos(0.02 / (RADIUS - WALL)))
        np.testing.assert_allclose(toe_and_shoulder(over, RADIUS, WALL), (90 - half, 90 + half), atol=0.5)

    def test_a_charge_thrown_to_the_top_has_both_ends_there(self):
        up = charge_map(lambda x, y: np.where(y - 0.2 * x > 0.05, PHI, 0.0), turning(5, (0, 0)))
        tilt = np.degrees(np.arctan(0.2))
        half = np.degrees(np.arccos(0.05 * np.cos(np.radians(tilt)) / (RADIUS - WALL)))
        toe, shoulder = toe_and_shoulder(up, RADIUS, WALL)
        np.testing.assert_allclose((toe, shoulder % 360), (180 - tilt - half, 180 - tilt + half), atol=0.5)

    def test_a_logistic_one_is_fitted(self):
        parameters = (-0.12, 0.6, 40.0, 0.04)
        surface = free_surface(charge_map(below(lambda x: logistic(x, *parameters)), turning(5, (0, 0))), RADIUS, WALL)
        x = np.linspace(-0.12, 0.1, 50)
        np.testing.assert_allclose(surface.fitted(x), logistic(x, *parameters), atol=2.5e-3)
        np.testing.assert_allclose(surface.height(x), logistic(x, *parameters), atol=2.5e-3)
        self.assertLess(surface.rmsd, 1e-3)
        self.assertTrue(np.isnan(surface.height(0.145)[0]))

    def test_a_logistic_through_its_own_points_is_itself(self):
        x = np.linspace(-0.1, 0.12, 60)
        for parameters in ((-0.12, 0.6, 40.0, 0.04), (0.1, 3.0, 25.0, -0.08)):
            found, rmsd = fit_logistic(x, logistic(x, *parameters), RADIUS)
            np.testing.assert_allclose(found, parameters, rtol=1e-3)
            self.assertLess(rmsd, 1e-7)
        zigzag = 1e-3 * (-1) ** np.arange(60)
        self.assertAlmostEqual(fit_logistic(x, logistic(x, *parameters) + zigzag, RADIUS)[1], 1e-3, delta=2e-5)

    def test_a_loop_is_cut_by_the_circle_wherever_it_begins(self):
        square = np.array([(-0.5, 0), (0.5, 0), (0.5, 3), (-0.5, 3)])
        height = np.sqrt(1 - 0.25)
        for first in range(4):
            loop = np.roll(square, -first, axis=0)
            piece, = pieces_within(np.concatenate([loop, loop[:1]]), 1)
            np.testing.assert_allclose(piece, [(-0.5, height), (-0.5, 0), (0.5, 0), (0.5, height)])
        self.assertEqual(pieces_within(np.concatenate([square, square[:1]]), 5), [])

    def test_balls_in_flight_do_not_move_it(self):
        thin = charge_map(lambda x, y: np.where(y < -0.05, PHI, np.where(x < 0.1, 0.1, 0.0)), turning(5, (0, 0)))
        points = free_surface(thin, RADIUS, WALL).points
        np.testing.assert_allclose(points[:, 1], -0.05, atol=3e-3)

    def test_a_ring_has_none(self):
        ring = charge_map(lambda x, y: np.where(np.hypot(x, y) > 0.1, PHI, 0), turning(8, (0, 0)))
        with self.assertRaisesRegex(RuntimeError, "no free surface.*covers 100 % of the shell: it centrifuges"):
            free_surface(ring, RADIUS, WALL)

    def test_a_thin_charge_has_none_and_does_not_centrifuge(self):
        thin = charge_map(lambda x, y: np.where((np.hypot(x, y) > 0.144) & (y < -0.1), PHI, 0), turning(5, (0, 0)))
        with self.assertRaisesRegex(RuntimeError, "no free surface.*the charge covers 2[5-9] % of the shell: it is too "
                                                  "thin") as caught:
            free_surface(thin, RADIUS, WALL)
        self.assertNotIn("centrifug", str(caught.exception))
        with self.assertRaisesRegex(RuntimeError,
                                    "no centre of circulation.*the charge covers 2[5-9] % of the shell") as caught:
            circulation_centre(thin, RADIUS)
        self.assertNotIn("centrifug", str(caught.exception))


class Tangential(unittest.TestCase):
    def setUp(self):
        # Straight layers, along x, with a cubic in the depth; the centre is straight below the mill's
        self.cubic = np.array([-800.0, -60.0, 20.0, 0.1])
        self.charge = charge_map(below(lambda x: -0.02 + 0 * x), lambda x,
                                 y: (-np.polyval(self.cubic, -y - 0.09), -4.0 * x))
        self.profile = tangential_profile(self.charge, RADIUS, WALL)

    def test_it_is_from_the_surface_to_the_wall_straight_down(self):
        self.assertAlmostEqual(self.profile.angle, 0, delta=0.5)
        self.assertAlmostEqual(self.profile.distance[0], 0.02, delta=1e-3)
        self.assertAlmostEqual(self.profile.distance[-1], RADIUS - WALL)

    def test_a_cubic_is_found_with_its_shear_rate(self):
        depth = self.profile.distance - 0.09
        np.testing.assert_allclose(self.profile.fitted(self.profile.distance), np.polyval(self.cubic, depth),
                                   atol=0.015)
        np.testing.assert_allclose(self.profile.shear_rate, np.polyval(np.polyder(self.cubic), depth), atol=1.0)
        self.assertLess(self.profile.rmsd, 6e-3)

    def test_rigid_rotation_has_the_speed_of_the_mill(self):
        profile = tangential_profile(charge_map(below(lambda x: 0 * x), turning(5, (0, -0.06))), RADIUS, WALL)
        np.testing.assert_allclose(profile.shear_rate, 5, atol=0.15)
        # Voxels that the surface halves have the velocity of their lower half
        np.testing.assert_allclose(profile.velocity, 5 * (profile.distance - 0.06), atol=5 * 2 * RADIUS / 65 / 2)

    def test_the_mills_sense_is_positive_along_any_line(self):
        centre = (-0.06, -0.05)
        profile = tangential_profile(charge_map(below(lambda x: 0.03 - x), turning(5, centre)), RADIUS, WALL)
        self.assertAlmostEqual(profile.angle, np.degrees(np.arctan2(0.06, 0.05)), delta=0.1)
        np.testing.assert_allclose(profile.velocity, 5 * (profile.distance - np.hypot(*centre)), atol=1e-3)
        # The charge covers the mill's centre
        self.assertEqual(profile.distance[0], 0)

    def test_all_readings_are_those_of_the_single_ones(self):
        readings = read_charge(self.charge, RADIUS, WALL)
        self.assertEqual(readings.centre, circulation_centre(self.charge, RADIUS))
        self.assertEqual((readings.toe, readings.shoulder), toe_and_shoulder(self.charge, RADIUS, WALL))
        self.assertEqual(readings.tangential.rmsd, self.profile.rmsd)

    def test_a_mill_that_turns_the_other_way_is_the_mirror_image(self):
        tilted = charge_map(below(lambda x: -0.02 - 0.4 * x), turning(5, (-0.03, -0.06)))
        mirrored = replace(tilted, solidity=tilted.solidity[:, ::-1], sense=ANTICLOCKWISE,
                           velocity=tilted.velocity[:, ::-1] * (-1, 1, 1))
        here, there = read_charge(tilted, RADIUS, WALL), read_charge(mirrored, RADIUS, WALL)
        np.testing.assert_allclose(there.centre, (-here.centre[0], here.centre[1]), atol=1e-9)
        np.testing.assert_allclose((there.toe, there.shoulder), (here.toe, here.shoulder), atol=1e-6)
        np.testing.assert_allclose(there.surface.points, here.surface.points * (-1, 1), atol=1e-9)
        self.assertAlmostEqual(there.surface.rmsd, here.surface.rmsd, delta=1e-3 * here.surface.rmsd)
        self.assertAlmostEqual(there.tangential.angle, here.tangential.angle)
        np.testing.assert_allclose(there.tangential.velocity, here.tangential.velocity, atol=1e-9)
        with self.assertRaisesRegex(RuntimeError, "turns with the mill"):
            circulation_centre(replace(mirrored, sense=tilted.sense), RADIUS)


if __name__ == "__main__":
    unittest.main()
