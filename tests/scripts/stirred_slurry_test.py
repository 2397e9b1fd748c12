# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of the slurry in a stirred mill: frames, medians, what the impeller takes; columns of a dump."""
import json
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.quiver import Quiver, QuiverKey

from millfoam.files.dumps import read_balls
from millfoam.plots.stirred_slurry_plots import maps_figure, vortex_figure
from millfoam.readings import stirred_slurry
from millfoam.readings.stirred_slurry import (SlurryFlow, along_cylinder, dumps_of_last_turn, in_impeller, median,
                                              meridian_means, read_slurry_flow)


class Impeller:
    """What in_impeller reads of a mill."""
    impeller = {"shaft_diameter_m": 0.02, "shaft_end_m": 0.01,
                "pins": [{"height_m": 0.03, "length_m": 0.1, "thickness_m": 0.01, "angle_deg": 90, "arms": 1}],
                "discs": [{"height_m": 0.06, "diameter_m": 0.08, "thickness_m": 0.004}]}


class Frames(unittest.TestCase):
    def test_a_rigid_rotation_has_a_tangential_velocity_alone_at_any_angle(self):
        centre = np.array([[0.02, 0, 0.1], [0, -0.03, 0.2], [0.01, 0.02, 0]])
        angle, omega = 0.7, 5.0
        turn = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        x, y, _ = (centre @ turn).T
        velocity = np.stack([-omega * y, omega * x, np.full(3, 0.3)], axis=1)
        radius = np.hypot(centre[:, 0], centre[:, 1])
        expected = np.stack([np.zeros(3), omega * radius, np.full(3, 0.3)], axis=1)
        np.testing.assert_allclose(along_cylinder(centre, velocity, angle), expected, atol=1e-14)

    def test_a_median_is_by_weight(self):
        self.assertEqual(median(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 5.0])), 2)
        self.assertEqual(median(np.array([3.0, 1.0, 2.0]), np.array([9.0, 1.0, 1.0])), 3)
        self.assertTrue(np.isnan(median(np.array([]), np.array([]))))


class Fields(unittest.TestCase):
    """A slurry that turns rigidly with the impeller, and balls that turn half as fast."""
    OMEGA, TIME0 = 5.0, 0.1
    RADII = np.array([0.02, 0.03, 0.04])
    DERIVED = {"angular_velocity_rad_s": OMEGA, "density_kg_m3": 1500.0, "plastic_viscosity_Pa_s": 0.01,
               "sauter_diameter_m": 0.005}

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "mesh.json").write_text(json.dumps({"format": "millfoam-mesh", "time0_s": self.TIME0}))
        self.angles = np.array([0.3, 1.5, 4.0])  # of the cells at flow time 0
        self.fields = {}
        for time, solidity in ((0.2, 0.4), (0.4, 0.2)):
            place = self.folder / f"{time:g}"
            place.mkdir()
            (place / "solidity").touch()
            azimuth = self.angles + self.OMEGA * time
            rigid = self.OMEGA * self.RADII[:, None] * np.stack([-np.sin(azimuth), np.cos(azimuth), 0 * azimuth], 1)
            self.fields |= {place / "alpha.slurry": np.ones(3), place / "U": rigid, place / "solidsVelocity": rigid / 2,
                            place / "solidity": np.full(3, solidity)}
        mesh = SimpleNamespace(cells=3, centres_and_volumes=lambda: (np.stack(
            [self.RADII * np.cos(self.angles), self.RADII * np.sin(self.angles), 0 * self.RADII], 1), np.full(3, 1e-6)))
        times = [(0.0, self.folder / "0"), (0.2, self.folder / "0.2"), (0.4, self.folder / "0.4")]
        self.enterContext(mock.patch.multiple(
            stirred_slurry.foam, read_mesh=lambda case: mesh, times=lambda case: times,
            read_field=lambda path, cells: self.fields[path]))
        self.mill = SimpleNamespace(derived=lambda *keys: self.DERIVED[keys[-1]])

    def test_are_in_the_impellers_frame_and_means_over_the_times(self):
        flow = read_slurry_flow(self.folder, self.mill, 0.1)
        self.assertEqual(flow.times, [0.2, 0.4])
        at_dem_zero = self.angles - self.OMEGA * self.TIME0
        np.testing.assert_allclose(flow.centre, np.stack([
            self.RADII * np.cos(at_dem_zero), self.RADII * np.sin(at_dem_zero), 0 * self.RADII], 1), atol=1e-15)
        zero = 0 * self.RADII
        np.testing.assert_allclose(flow.velocity, np.stack([zero, self.OMEGA * self.RADII, zero], 1), atol=1e-14)
        np.testing.assert_allclose(flow.share, 1)
        np.testing.assert_allclose(flow.solidity, 0.3)

    def test_slip_and_its_reynolds_number_are_medians_of_each_time(self):
        flow = read_slurry_flow(self.folder, self.mill, 0.1)
        np.testing.assert_allclose(flow.slips, 5.0 / 2 * 0.03)
        np.testing.assert_allclose(flow.reynolds, 1500 * 0.075 * 0.005 / 0.01 * np.array([0.6, 0.8]))
        for place in ("0.2", "0.4"):
            self.fields[self.folder / place / "solidsVelocity"] = self.fields[self.folder / place / "U"]
        np.testing.assert_allclose(read_slurry_flow(self.folder, self.mill, 0.1).slips, 0, atol=1e-15)

    def test_are_of_the_last_time_where_none_is_late_enough(self):
        self.assertEqual(read_slurry_flow(self.folder, self.mill, 9.0).times, [0.4])

    def test_the_slurrys_velocity_is_weighted_by_its_share(self):
        self.fields[self.folder / "0.4" / "alpha.slurry"] = np.full(3, 0.25)
        self.fields[self.folder / "0.4" / "U"] = 0 * self.fields[self.folder / "0.4" / "U"]
        flow = read_slurry_flow(self.folder, self.mill, 0.1)
        np.testing.assert_allclose(flow.velocity[:, 1], self.OMEGA * self.RADII / 1.25)
        np.testing.assert_allclose(flow.share, 0.625)


class Meridian(unittest.TestCase):
    def test_is_the_mean_around_the_axis_and_has_no_slurry_in_the_impeller(self):
        edges = np.arange(-0.05, 0.0501, 0.0025)
        x, y, z = np.meshgrid(edges, edges, np.arange(0, 0.0901, 0.005), indexing="ij")
        centre = np.stack([x, y, z], axis=-1).reshape(-1, 3)
        wet = (centre[:, 0] > 1e-9).astype(float)  # one half around the axis
        radius, speed = np.hypot(centre[:, 0], centre[:, 1]), 5.0
        velocity = np.stack([0 * radius, np.where(wet > 0, speed * radius, 9.0), 0 * radius], axis=1)
        flow = SlurryFlow(centre, 0 * wet + 1, wet, 0 * wet + 0.4, velocity, [np.nan], [np.nan], [1.0])
        shaft = SimpleNamespace(impeller={**Impeller.impeller, "pins": [], "discs": []})
        middle = [np.array([0.005, 0.02, 0.04]), np.array([0.02, 0.05])]
        share, solidity, mean = meridian_means(shaft, flow, middle)
        np.testing.assert_array_equal(share[0], 0)
        np.testing.assert_allclose(share[1:], 0.5, atol=0.05)
        np.testing.assert_allclose(solidity[1:], 0.4)
        # Of the slurry, not of the dry half
        np.testing.assert_allclose(mean[1:, :, 1], speed * np.array([[0.02], [0.04]]) * [1, 1], rtol=0.03)


class LastTurn(unittest.TestCase):
    def test_has_the_dumps_of_one_turn_once(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        mill = SimpleNamespace(turn=1.0)
        self.assertEqual(dumps_of_last_turn(folder, mill), [])
        (folder / "dumps").mkdir()
        (folder / "dumps" / "run.json").write_text(json.dumps({"format": "millfoam-dumps", "timestep_s": 0.01}))
        for step in range(0, 201, 25):
            (folder / "dumps" / f"dump.{step}.txt").touch()
        found = dumps_of_last_turn(folder, mill)
        np.testing.assert_allclose([time for time, _ in found], [1.25, 1.5, 1.75, 2.0])
        self.assertEqual(found[-1][1].name, "dump.200.txt")


class Solid(unittest.TestCase):
    def test_shaft_pins_and_discs_are_solid(self):
        inside = [[0.009, 0, 0.2], [0, 0.049, 0.03], [0.004, 0.03, 0.031], [-0.039, 0, 0.061]]
        outside = [[0.009, 0, 0.009], [0, 0.051, 0.03], [0, -0.03, 0.03], [0.004, 0.03, 0.034], [0.039, 0, 0.063]]
        self.assertTrue(in_impeller(Impeller(), np.array(inside)).all())
        self.assertFalse(in_impeller(Impeller(), np.array(outside)).any())


class Section(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.addCleanup(plt.close, "all")
        self.mill = SimpleNamespace(radius=0.05, length=0.1, impeller={**Impeller.impeller, "pins": [], "discs": []},
                                    turn=1.0, derived=lambda *_: np.pi / 2)
        edges = np.linspace(-0.0475, 0.0475, 20)
        x, y, z = np.meshgrid(edges, edges, edges + 0.0475, indexing="ij")
        self.centre = np.stack([x, y, z], axis=-1).reshape(-1, 3)

    def flow(self, velocity):
        one = np.ones(len(self.centre))
        return SlurryFlow(self.centre, one, one, 0 * one, np.broadcast_to(velocity, self.centre.shape), [np.nan],
                          [np.nan], [1.0])

    def test_shows_balls_with_their_own_sizes_where_they_have_turned_to(self):
        # At 1 s the impeller has turned by 90 degrees: what was along x is along y. The last ball is off the section
        dump = self.folder / "dump.100.txt"
        dump.write_text("ITEM: ATOMS id x y z vx vy vz radius\n1 0 0.02 0.03 0 0 0 0.008\n2 0 -0.03 0.06 1 0 0 0.002\n"
                        "3 0.009 -0.02 0.03 0 0 0 0.008\n4 0 0.04 0.07 0 2 0 0.004\n")
        axis = vortex_figure(self.mill, self.flow([0.0, 1.0, 0.0]), (1.0, dump)).axes[0]
        image = axis.images[0]
        low, high, bottom, top = image.get_extent()
        shown = np.asarray(image.get_array())[..., 3] > 0
        area = shown.mean() * (high - low) * (top - bottom)
        self.assertAlmostEqual(area / (np.pi * (8**2 + 2**2 + 4**2)), 1, delta=0.02)
        heights, places = (np.linspace(bottom, top, len(shown)), np.linspace(low, high, shown.shape[1]))
        self.assertTrue(shown[np.argmin(np.abs(heights - 30)), np.argmin(np.abs(places - 20))])
        self.assertFalse(shown[np.argmin(np.abs(heights - 30)), np.argmin(np.abs(places + 20))])

    def test_arrows_are_as_long_as_their_size_and_have_a_key(self):
        for speed in (0.02, 3.0):
            axis = maps_figure(self.mill, self.flow([0.0, 0.0, speed])).axes[1]
            arrows = next(one for one in axis.collections if isinstance(one, Quiver))
            np.testing.assert_allclose(arrows.scale, 12 * speed)
            key = next(one for one in axis.artists if isinstance(one, QuiverKey))
            self.assertEqual(key.text.get_text(), f"{speed:g} m/s")


class Dumps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "dump.1.txt"

    def test_columns_are_found_by_name(self):
        self.path.write_text("ITEM: TIMESTEP\n1\nITEM: ATOMS id vz x\n1 2 3\n4 5 6\n")
        np.testing.assert_array_equal(read_balls(self.path, "x", "vz"), [[3, 2], [6, 5]])

    def test_what_is_missing_is_named(self):
        self.path.write_text("ITEM: ATOMS id x\n1 2\n")
        with self.assertRaisesRegex(RuntimeError, "no column vx, vy; it has id, x"):
            read_balls(self.path, "vx", "vy")

        self.path.write_text("text")
        with self.assertRaisesRegex(RuntimeError, "no line 'ITEM: ATOMS'"):
            read_balls(self.path, "x")

    def test_a_dump_that_is_not_complete_is_refused(self):
        for text, reason in (("ITEM: ATOMS id x\n1 2\n3 0.01", "no end of the last line: the dump is not complete"),
                             ("ITEM: ATOMS id x\n1 2\n3\n", "expected a number for each ball in each column"),
                             ("ITEM: ATOMS id x\n1 2\n3 a\n", "expected a number for each ball in each column"),
                             ("ITEM: NUMBER OF ATOMS\n3\nITEM: ATOMS id x\n1 2\n3 4\n",
                              "4 values of balls; expected 3 balls of 2 columns each: the dump is not complete")):
            self.path.write_text(text)
            with self.assertRaisesRegex(RuntimeError, f"{self.path}: .*{reason}"):
                read_balls(self.path, "x")


if __name__ == "__main__":
    unittest.main()
