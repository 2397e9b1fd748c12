# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of the slurry in a stirred mill: written fields, frames, medians, what the impeller takes, means in the r-z
plane; dumps of the last turn, columns of a dump."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.quiver import Quiver, QuiverKey

from millfoam.files.dumps import read_balls
from millfoam.files.mill import read_mill
from millfoam.plots.stirred_slurry_plots import maps_figure, vortex_figure
from millfoam.readings.stirred_slurry import (SECTORS, SlurryFlow, along_cylinder, dumps_of_last_turn, in_impeller,
                                              median, meridian_means, read_slurry_flow)
from report_cases import DIAMETER, OMEGA, hexahedra, write_field, write_json, write_mesh, write_mill


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


class WrittenFlow(unittest.TestCase):
    """Fields on a mesh about the axis with the mill of report_cases: 1500 kg/m3, 0.01 Pa s, balls of 5 mm."""
    TIME0, SHAPE = 0.35, (4, 4, 5)  # DEM time (s) of flow time 0, cells

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_mill(self.folder)
        write_json(self.folder / "mesh.json", "mesh", ("flow",), time0_s=self.TIME0)
        points = hexahedra.box((-0.1, -0.1, 0), (0.1, 0.1, 0.1), self.SHAPE)
        write_mesh(self.folder / "constant" / "polyMesh", points)
        self.centre = (points[:-1, :-1, :-1] / 2 + points[1:, 1:, 1:] / 2).reshape(-1, 3)
        self.radius = np.hypot(self.centre[:, 0], self.centre[:, 1])

    def write(self, time, share, solidity=None, turning=1.0, slip=(0.0, 0.0), rising=0.0):
        """A written time; share, solidity, slip: numbers, or of each layer [5]; no balls without solidity. The slurry
        turns with `turning` times the impeller's speed and rises (m/s). The velocity of the balls is slip[0] less
        around the axis and slip[1] less along it (m/s)."""
        angle = np.arctan2(self.centre[:, 1], self.centre[:, 0]) + OMEGA * time
        around, along = turning * OMEGA * self.radius, rising + 0 * self.radius
        slip = [self.cells(part) for part in slip]
        fields = {"alpha.slurry": self.cells(share), "U": self.in_lab(angle, around, along)}
        if solidity is not None:
            fields |= {"solidity": self.cells(solidity),
                       "solidsVelocity": self.in_lab(angle, around - slip[0], along - slip[1])}
        for name, values in fields.items():
            write_field(self.folder / f"{time:g}" / name, values)

    def cells(self, values):
        return np.broadcast_to(values, self.SHAPE).reshape(-1)

    def in_lab(self, angle, around, along):
        return np.stack([-np.sin(angle) * around, np.cos(angle) * around, along], axis=1)

    def read(self, begin=0.0):
        return read_slurry_flow(self.folder, read_mill(self.folder), begin)

    def test_a_rigid_rotation_with_the_impeller_has_no_slip(self):
        for time in (0.2, 0.5):
            self.write(time, 1.0, 0.4)
        found = self.read()
        # The impeller's frame is that of DEM time 0, in which no cell has turned yet
        angle = np.arctan2(self.centre[:, 1], self.centre[:, 0]) - OMEGA * self.TIME0
        back = np.stack([self.radius * np.cos(angle), self.radius * np.sin(angle), self.centre[:, 2]], axis=1)
        np.testing.assert_allclose(found.centre, back, atol=1e-12)
        np.testing.assert_allclose(found.volume, 0.05 * 0.05 * 0.02)
        np.testing.assert_allclose(found.share, 1)
        np.testing.assert_allclose(found.solidity, 0.4)
        around = np.stack([0 * self.radius, OMEGA * self.radius, 0 * self.radius], axis=1)
        np.testing.assert_allclose(found.velocity, around, atol=1e-8)  # nine digits are written
        np.testing.assert_allclose(found.slips + found.reynolds, 0, atol=1e-4)
        self.assertEqual(found.times, [0.2, 0.5])

    def test_slip_and_its_reynolds_number_are_those_of_each_time(self):
        self.write(0.2, 1.0, 0.4, slip=(0.03, 0.04))
        self.write(0.5, 1.0, 0.3, slip=(0.06, -0.08))
        found = self.read()
        np.testing.assert_allclose(found.slips, [0.05, 0.1], rtol=1e-6)
        # By the slip times the voidage: the drag laws' superficial velocity
        np.testing.assert_allclose(found.reynolds, [1500 * 0.05 * DIAMETER * 0.6 / 0.01, 1500 * 0.1 * DIAMETER * 0.7
                                                    / 0.01], rtol=1e-6)
        np.testing.assert_allclose(found.solidity, 0.35)

    def test_slip_counts_by_the_volume_of_balls_and_where_they_are_in_slurry(self):
        # At the first time a layer has hardly any slurry; at the second one, four have hardly any balls
        self.write(0.2, [1, 1, 1, 0.4, 1], [0.4, 0.1, 0.1, 0.7, 0], slip=([0.2, 0.1, 0.1, 3, 3], 0.0))
        self.write(0.5, 1.0, [0.06, 0.04, 0.04, 0.04, 0.04], slip=([0.3, 3, 3, 3, 3], 0.0))
        found = self.read()
        np.testing.assert_allclose(found.slips, [0.2, 0.3], rtol=1e-6)
        np.testing.assert_allclose(found.reynolds, [1500 * 0.2 * DIAMETER * 0.6 / 0.01, 1500 * 0.3 * DIAMETER * 0.94
                                                    / 0.01], rtol=1e-6)

    def test_means_are_from_the_begin_on_and_velocities_are_weighted_by_slurry(self):
        for time, share, solidity, turning, rising in ((0.1, 1.0, 0.6, 9.0, 9.0), (0.2, 1.0, 0.4, 1.0, 0.1),
                                                       (0.5, 0.5, 0.2, 0.4, 0.4)):
            self.write(time, share, solidity, turning, rising=rising)
        found = self.read(begin=0.2)
        self.assertEqual(found.times, [0.2, 0.5])
        np.testing.assert_allclose(found.share, 0.75)
        np.testing.assert_allclose(found.solidity, 0.3)
        np.testing.assert_allclose(found.velocity[:, 1], 0.8 * OMEGA * self.radius, atol=1e-8)
        np.testing.assert_allclose(found.velocity[:, 2], 0.2, atol=1e-8)
        self.assertEqual(self.read(begin=0.6).times, [0.5])

    def test_a_flow_without_balls_has_no_slip_and_one_of_time_0_alone_is_refused(self):
        self.write(0, 1.0)
        with self.assertRaisesRegex(RuntimeError, "no written time after 0; expected one"):
            self.read()
        self.write(0.2, 1.0)
        found = self.read()
        self.assertEqual(found.times, [0.2])
        self.assertTrue(np.isnan(found.slips + found.reynolds).all())


class Meridian(unittest.TestCase):
    RADII, HEIGHTS = np.array([0.005, 0.025, 0.045]), np.array([0.01, 0.03, 0.06])

    def setUp(self):
        azimuth = 2 * np.pi * (np.arange(SECTORS) + 0.5) / SECTORS
        self.radius, self.azimuth, height = (one.ravel() for one in np.meshgrid(self.RADII, azimuth, self.HEIGHTS,
                                                                                indexing="ij"))
        self.centre = np.stack([self.radius * np.cos(self.azimuth), self.radius * np.sin(self.azimuth), height], axis=1)

    def means(self, share, solidity, velocity, impeller):
        one = np.ones(len(self.centre))
        flow = SlurryFlow(self.centre, one, share * one, solidity * one, velocity, [np.nan], [np.nan], [1.0])
        return meridian_means(SimpleNamespace(impeller=impeller), flow, [self.RADII, self.HEIGHTS])

    def test_of_a_rigid_rotation_is_the_rotation_outside_the_impeller(self):
        around = np.stack([0 * self.radius, OMEGA * self.radius, 0 * self.radius], axis=1)
        share, solidity, velocity = self.means(1.0, 0.4, around, Impeller.impeller)
        # Shaft from 0.01 m up, and a disc of 0.04 m at the top; one pin leaves most of its circle
        free = np.array([[1, 0, 0], [1, 1, 0], [1, 1, 1]])
        np.testing.assert_array_equal(share, free)
        np.testing.assert_allclose(solidity, 0.4 * free)
        expected = free * OMEGA * self.RADII[:, None]
        np.testing.assert_allclose(velocity, np.stack([0 * expected, expected, 0 * expected], axis=-1), atol=1e-12)

    def test_around_the_axis_velocities_are_weighted_by_slurry(self):
        none = {**Impeller.impeller, "shaft_diameter_m": 0.0, "pins": [], "discs": []}
        half = np.sin(self.azimuth) > 0
        velocity = np.stack([0 * self.radius, 0 * self.radius, np.where(half, 0.1, 0.4)], axis=1)
        share, solidity, mean = self.means(np.where(half, 1.0, 0.5), np.where(half, 0.2, 0.6), velocity, none)
        np.testing.assert_allclose(share, 0.75)
        np.testing.assert_allclose(solidity, 0.4)
        np.testing.assert_allclose(mean[..., 2], 0.2)


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


class LastTurn(unittest.TestCase):
    def test_has_its_dumps_in_order_of_time_and_none_of_its_begin(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        mill = SimpleNamespace(turn=0.5)
        self.assertEqual(dumps_of_last_turn(folder, mill), [])
        write_json(folder / "dumps" / "run.json", "dumps", ("charge",), timestep_s=1e-3)
        self.assertEqual(dumps_of_last_turn(folder, mill), [])
        for step in range(0, 1201, 100):
            (folder / "dumps" / f"dump.{step}.txt").touch()
        times, paths = zip(*dumps_of_last_turn(folder, mill))
        np.testing.assert_allclose(times, [0.8, 0.9, 1.0, 1.1, 1.2])
        self.assertEqual([path.name for path in paths], [f"dump.{step}.txt" for step in range(800, 1201, 100)])


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
