#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of a plane through balls: areas of closed form."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.plots.ball_sections import inside, rotations, section

PLACES = np.linspace(-0.01, 0.01, 801)  # m
PIXEL = (PLACES[1] - PLACES[0])**2
ALONG = np.array([1.0, 0.0, 0.0])


class Sections(unittest.TestCase):
    def area(self, columns, *balls):
        """Area (m2) that the plane y = 0 cuts from balls, one line of a dump each, and the speeds there."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        rows = "\n".join(" ".join(f"{value:.12g}" for value in ball) for ball in balls)
        (folder / "dump.0.txt").write_text(f"ITEM: TIMESTEP\n0\nITEM: ATOMS {columns}\n{rows}\n")
        found = section(folder / "dump.0.txt", ALONG, PLACES, PLACES)
        return np.isfinite(found).sum() * PIXEL, set(np.unique(found[np.isfinite(found)]))

    def test_sphere_is_cut_in_a_circle(self):
        area, speeds = self.area("x y z vx vy vz radius", (0.001, 0.003, 0.002, 0, 3, 4, 0.005))
        self.assertAlmostEqual(area / (np.pi * 0.004**2), 1, delta=2e-3)
        self.assertEqual(speeds, {5.0})

    def test_ball_beyond_its_radius_is_not_cut(self):
        self.assertEqual(self.area("x y z vx vy vz radius", (0, 0.006, 0, 0, 0, 0, 0.005))[0], 0)

    def test_turned_ellipsoid_is_cut_in_an_ellipse(self):
        a, b, c = 0.006, 0.004, 0.002
        half = np.sqrt(0.5)
        columns = "x y z vx vy vz radius shapex shapey shapez quat1 quat2 quat3 quat4"
        for quaternion, axes in (((1, 0, 0, 0), (a, c)), ((half, 0, 0, half), (b, c)), ((half, half, 0, 0), (a, b)),
                                 # about y: the ellipse turns in the plane
                                 ((np.cos(0.3), 0, np.sin(0.3), 0), (a, c))):
            with self.subTest(quaternion=quaternion):
                area, _ = self.area(columns, (0, 0, 0, 1, 0, 0, a, a, b, c, *quaternion))
                self.assertAlmostEqual(area / (np.pi * axes[0] * axes[1]), 1, delta=5e-3)

    def test_blockiness_fills_the_box(self):
        points = np.array([[0.9, 0.9, 0.9], [1.1, 0, 0]])
        self.assertEqual(inside(points, np.ones(3), (100.0, 100.0)).tolist(), [True, False])
        self.assertEqual(inside(points, np.ones(3), (2.0, 2.0)).tolist(), [False, False])

    def test_rotation_of_a_quaternion(self):
        half = np.sqrt(0.5)
        turned = rotations(np.array([[half, 0, 0, half]]))[0] @ [1, 0, 0]  # a quarter about z
        np.testing.assert_allclose(turned, [0, 1, 0], atol=1e-12)

    def test_dump_without_a_column_is_named(self):
        with self.assertRaisesRegex(RuntimeError, r"dump\.0\.txt: no column radius"):
            self.area("x y z vx vy vz", (0, 0, 0, 0, 0, 0))


if __name__ == "__main__":
    unittest.main()
