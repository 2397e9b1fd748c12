# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of the slurry in a stirred mill: frames, medians, what the impeller takes; columns of a dump."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.quiver import Quiver, QuiverKey

from millfoam.files.dumps import read_balls
from millfoam.plots.stirred_slurry_plots import maps_figure, vortex_figure
from millfoam.readings.stirred_slurry import SlurryFlow, along_cylinder, in_impeller, median


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
        for text, reason in (("ITEM: ATOMS id x\n1 2\n3", "expected a number for each ball in each column"),
                             ("ITEM: ATOMS id x\n1 2\n3 a", "expected a number for each ball in each column"),
                             ("ITEM: NUMBER OF ATOMS\n3\nITEM: ATOMS id x\n1 2\n3 4\n",
                              "4 values of balls; expected 3 balls of 2 columns each: the dump is not complete")):
            self.path.write_text(text)
            with self.assertRaisesRegex(RuntimeError, f"{self.path}: .*{reason}"):
                read_balls(self.path, "x")


if __name__ == "__main__":
    unittest.main()
