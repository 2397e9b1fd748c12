#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Charge of a stirred mill on rings: maps, slices, profiles, box plots and pictures, on fields whose numbers are
known."""
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib
import numpy as np
from matplotlib.colors import to_rgba

from millfoam.files.mill import Mill
from millfoam.files.rings_file import read_rings
from millfoam.plots.stirred_plots import DARK, boxes_figure, halves, meridian_figure, profiles_figure, slices_figure
from millfoam.readings.stirred import (ball_boxes, bands, box_numbers, charge_boxes, filled_height, meridian, near_arms,
                                       radial_profile, slice_around)

matplotlib.use("Agg")
R, HEIGHT, SHAPE = 0.08, 0.2, (4, 8, 5)  # m; rings, sectors, layers
THETA = 2 * np.pi * (np.arange(8) + 0.5) / 8


def write(path, solidity, velocity, components="cylindrical", temperature=0.0, inside=1.0, ends=(1.0,)):
    """A solids.h5 of windows from 0 to the first of `ends`, and so on; fields broadcast to [windows, 5, 8, 4]."""
    size = (len(ends), *SHAPE[::-1])
    with h5py.File(path, "w") as file:
        file.attrs.update(complete=1, timestep=1e-5)
        grid = file.create_group("grid")
        grid.attrs.update(radii=[0, R], ends=[0, HEIGHT], shape=SHAPE, components=np.bytes_(components))
        if components == "cylindrical":
            grid.attrs.update(frame="turning", angular_velocity=20.0)
        file["window/begin"], file["window/end"] = [0.0, *ends[:-1]], ends
        file["grid/insideFraction"] = np.broadcast_to(inside, size)
        file["solidity"] = np.broadcast_to(solidity, size)
        file["granular_temperature"] = np.broadcast_to(temperature, size)
        file["velocity"] = np.broadcast_to(velocity, (*size, 3))


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="rings-")
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "solids.h5"

    def rings(self, *args, **more):
        write(self.path, *args, **more)
        return read_rings(self.path)


class Reading(InFolder):
    def test_volumes_are_those_of_the_cylinder(self):
        rings = self.rings(0.3, [0, 1, 0], inside=0.5)
        self.assertAlmostEqual(rings.room.sum() / (np.pi * R**2 * HEIGHT / 2), 1)
        self.assertAlmostEqual(rings.balls.sum() / rings.room.sum(), 0.3)
        self.assertEqual(rings.angular_velocity, 20)

    def test_cartesian_velocities_are_turned(self):
        rings = self.rings(0.3, [2, 0, 1], components="cartesian")
        np.testing.assert_allclose(rings.velocity[0, :, 0, 0], 2 * np.cos(THETA), atol=1e-15)
        np.testing.assert_allclose(rings.velocity[0, :, 0, 1], -2 * np.sin(THETA), atol=1e-15)
        np.testing.assert_allclose(rings.velocity[..., 2], 1)
        self.assertEqual(rings.angular_velocity, 0)

    def test_windows_count_by_their_length_and_velocities_by_the_balls(self):
        solidity, speed = np.reshape([0.1, 0.4], (2, 1, 1, 1)), np.reshape([[0, 1, 0], [0, 3, 0]], (2, 1, 1, 1, 3))
        rings = self.rings(solidity, speed, ends=(3.0, 4.0))
        np.testing.assert_allclose(rings.solidity, 0.75 * 0.1 + 0.25 * 0.4)
        np.testing.assert_allclose(rings.velocity[..., 1], (0.3 * 1 + 0.4 * 3) / 0.7)
        self.assertEqual((rings.begin, rings.end), (0, 4))
        np.testing.assert_allclose(read_rings(self.path, begin=3).solidity, 0.4)

    def test_the_speed_has_what_balls_of_a_voxel_differ_by(self):
        rings = self.rings(0.3, [0, 3, 0], temperature=16 / 3)
        np.testing.assert_allclose(rings.speed, 5)

    def test_other_files_are_refused(self):
        with h5py.File(self.path, "w") as file:
            file.attrs.update(complete=1, timestep=1e-5)
            file.create_group("grid").attrs.update(lower=[0, 0, 0])
        with self.assertRaisesRegex(RuntimeError, "not on a cylinder"):
            read_rings(self.path)
        write(self.path, 0.3, [0, 1, 0])
        with self.assertRaisesRegex(RuntimeError, "no window between 5 and inf s; the file has 0.0 to 1.0"):
            read_rings(self.path, 5)


class Readings(InFolder):
    def test_halves_of_the_azimuth_are_those_near_the_arms_and_the_others(self):
        near = near_arms(THETA, 0, 2)  # within 45 degrees of +x and -x: sectors 0, 3, 4 and 7
        np.testing.assert_array_equal(near, [1, 0, 0, 1, 1, 0, 0, 1])
        rings = self.rings(np.where(near, 0.5, 0.1)[:, None], [0, 1, 0])
        np.testing.assert_allclose(meridian(rings, near).solidity, 0.5)
        np.testing.assert_allclose(meridian(rings, ~near).solidity, 0.1)
        np.testing.assert_allclose(meridian(rings).solidity, 0.3)

    def test_means_weight_velocities_by_the_balls_and_solidity_by_the_room(self):
        solidity = np.reshape([0.2] * 4 + [0.4] * 4, (8, 1))
        inside = np.reshape([1.0] * 4 + [0.5] * 4, (8, 1))
        velocity = np.zeros((8, 1, 3))
        velocity[:4, :, 0], velocity[4:, :, 0] = 1, 4
        mean = meridian(self.rings(solidity, velocity, inside=inside))
        np.testing.assert_allclose(mean.solidity, (0.2 + 0.4 / 2) / 1.5)
        np.testing.assert_allclose(mean.velocity[..., 0], 2.5)
        np.testing.assert_allclose(mean.speed, np.sqrt((1 + 16) / 2))

    def test_slices_count_cut_layers_by_their_share(self):
        layers = np.arange(5).reshape(5, 1, 1) / 10  # of 40 mm
        rings = self.rings(layers, [0, 1, 0])
        found = slice_around(rings, 0.06, 0.12)  # half of layer 1, all of layer 2
        np.testing.assert_allclose(found.solidity, (0.1 / 2 + 0.2) / 1.5)
        self.assertEqual(found.solidity.shape, (8, 4))
        np.testing.assert_allclose(radial_profile(rings, 0.06, 0.12).solidity, (0.1 / 2 + 0.2) / 1.5)

    def test_bands_are_below_at_and_above_the_impeller(self):
        speed = np.zeros((5, 1, 1, 3))
        speed[:, 0, 0, 1] = np.arange(5)
        mill = mill_of([], [{"height_m": 0.08, "thickness_m": 0.08, "diameter_m": 0.12}], top=0.12)
        found = bands(mill, self.rings(0.2, speed))
        for name, expected in (("below", 0), ("impeller", 1.5), ("above", 3.5)):
            np.testing.assert_allclose(found[name].velocity[:, 1], expected, atol=1e-15)

    def test_where_there_are_no_balls_velocities_are_not_known(self):
        solidity = np.reshape([0.3, 0.3, 0.02, 1e-5, 0], (5, 1, 1))
        mean = meridian(self.rings(solidity, [0, 1, 0]))
        self.assertTrue(np.isnan(mean.velocity[3:]).all() and np.isfinite(mean.velocity[:3]).all())
        self.assertAlmostEqual(filled_height(mean, np.linspace(0, HEIGHT, 6)), 0.12)

    def test_boxes_are_those_of_the_values_as_often_as_their_weights_say(self):
        random = np.random.default_rng(5)
        values, times = random.normal(2, 1, 300), random.integers(1, 5, 300)
        one, other = box_numbers(values, times), box_numbers(np.repeat(values, times))
        for part in ("low", "first", "median", "third", "high", "mean", "deviation"):
            self.assertAlmostEqual(getattr(one, part), getattr(other, part), places=12)
        box = box_numbers(np.array([*range(1, 101), 1000.0, np.nan]))
        self.assertEqual((box.low, box.first, box.median, box.third, box.high), (1, 26, 51, 76, 100))
        with self.assertRaisesRegex(ValueError, "no values"):
            box_numbers(np.array([np.nan]))

    def test_boxes_of_the_charge_leave_out_empty_voxels(self):
        solidity = np.reshape([0.3, 0.3, 0.3, 0, 0], (5, 1, 1))
        found = charge_boxes(self.rings(solidity, [-1, 2, 0]))
        self.assertAlmostEqual(found["solidity"].median, 0.3)
        self.assertEqual((found["radial"].mean, found["tangential"].mean, found["axial"].mean), (-1, 2, 0))
        self.assertAlmostEqual(found["speed"].mean, np.sqrt(5))

    def test_boxes_of_balls_that_orbit(self):
        angle = np.linspace(0, 6, 50)
        positions = np.stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), angle], axis=1)
        velocities = np.stack([-3 * np.sin(angle), 3 * np.cos(angle), np.full(50, 4)], axis=1)
        found = ball_boxes(positions, velocities)
        for name, expected in (("speed", 5), ("radial", 0), ("tangential", 3), ("axial", 4)):
            self.assertAlmostEqual(found[name].median, expected)
            self.assertAlmostEqual(found[name].deviation, 0)


PINS = [{"height_m": 0.03, "thickness_m": 0.02, "length_m": 0.14, "angle_deg": 0.0, "arms": 2},
        {"height_m": 0.1, "thickness_m": 0.02, "length_m": 0.14, "angle_deg": 90.0, "arms": 2}]


def mill_of(pins, discs=(), top=0.11):
    """What the pictures read of a mill."""
    derived = {"geometry": {"radius_m": R, "length_m": HEIGHT, "impeller": {
        "shaft_diameter_m": 0.02, "shaft_end_m": 0.015, "top_m": top, "pins": pins,
        "discs": list(discs)}}, "speed": {}, "charge": {}}
    return Mill("mill.json", {"derived": derived, "mill": {name: {} for name in ("geometry", "speed", "charge")}})


def dark(axis):
    """Boxes about the dark patches of an axis, in its data."""
    return [patch.get_window_extent().transformed(axis.transData.inverted()) for patch in axis.patches
            if patch.get_fill() and patch.get_facecolor() == to_rgba(DARK)]


class Pictures(InFolder):
    def test_maps_have_each_half_with_its_pins(self):
        near = near_arms(THETA, 0, 2)
        rings = self.rings(np.where(near, 0.5, 0.1)[:, None], [0.1, 1, 0.2])
        mill = mill_of(PINS)
        figure = meridian_figure(mill, rings, ["solidity"])
        figure.canvas.draw()
        axis = figure.axes[0]
        values = axis.collections[0].get_array().reshape(5, 8)
        np.testing.assert_allclose(values[:, :4], 0.5)
        np.testing.assert_allclose(values[:, 4:], 0.1)
        _, *pins = sorted(dark(axis), key=lambda box: -box.height)
        lower, upper = sorted(pins, key=lambda box: box.y0)
        np.testing.assert_allclose([lower.x0, lower.x1, lower.y0, lower.y1], [-0.875, 0, 20, 40], atol=1e-6)
        np.testing.assert_allclose([upper.x0, upper.x1, upper.y0, upper.y1], [0, 0.875, 90, 110], atol=1e-6)

    def test_without_a_frame_that_turns_both_sides_are_the_mean(self):
        rings = self.rings(0.3, [0.1, 1, 0.2], components="cartesian")
        self.assertTrue(all(sectors.all() for sectors in halves(mill_of(PINS), rings)))
        figure = meridian_figure(mill_of(PINS), rings, ["tangential"])
        figure.canvas.draw()
        self.assertEqual(len(dark(figure.axes[0])), 1 + 2 * 2)

    def test_discs_are_on_both_sides_and_limit_the_bands(self):
        rings = self.rings(np.reshape([0.1, 0.2, 0.2, 0.4, 0.4], (5, 1, 1)), [0, 1, 0])
        mill = mill_of([], [{"height_m": 0.075, "thickness_m": 0.07, "diameter_m": 0.12}])
        figure = meridian_figure(mill, rings, ["speed"])
        figure.canvas.draw()
        disc = dark(figure.axes[0])[1]
        np.testing.assert_allclose([disc.x0, disc.x1, disc.y0, disc.y1], [-0.75, 0.75, 40, 110], atol=1e-6)
        below, impeller, _ = (line.get_ydata() for line in profiles_figure(mill, rings).axes[0].lines)
        np.testing.assert_allclose(below, 0.1)
        np.testing.assert_allclose(impeller, 0.2)

    def test_slices_show_their_own_pins_from_tip_to_tip(self):
        rings = self.rings(0.3, [0.1, 1, 0.2])
        figure = slices_figure(mill_of(PINS), rings, ["axial"])
        figure.canvas.draw()
        upper, lower = (sorted(dark(axis), key=lambda box: box.y0) for axis in figure.axes[:2])
        self.assertAlmostEqual(min(box.y0 for box in upper), -0.875, places=6)
        self.assertAlmostEqual(max(box.x1 for box in lower), 0.875, places=6)
        self.assertAlmostEqual(max(box.y1 for box in lower), 0.125, places=6)

    def test_profiles_and_boxes_are_those_of_the_readings(self):
        rings = self.rings(0.3, [0.1, 1, 0.2])
        axes = profiles_figure(mill_of(PINS), rings).axes
        for axis, expected in zip(axes, (0.3, 0.1, 1, 0.2)):
            for line in axis.lines[:3]:
                np.testing.assert_allclose(line.get_ydata(), expected)
        figure = boxes_figure(charge_boxes(rings))
        self.assertEqual([label.get_text() for label in figure.axes[0].get_xticklabels()],
                         ["speed", "radial", "tangential", "axial"])


if __name__ == "__main__":
    unittest.main()
