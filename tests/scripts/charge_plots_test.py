#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a charge show its map, readings and curves; errors of all readings over windows that are alike are
zero."""
import io
import unittest

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import QuadMesh
from matplotlib.quiver import Quiver
from PIL import Image

from charge_test import RADIUS, below, charge_map, turning
from millfoam.files.outline import circle
from millfoam.plots.charge_plots import charge_figure, tangential_figure
from millfoam.plots.drawing import drawn
from millfoam.plots.mill_plots import save
from millfoam.readings.charge import charge_with_errors, read_charge


def lines_of(axis):
    """Label -> points [n, 2] of an axis' curves."""
    return {line.get_label(): line.get_xydata() for line in axis.lines}


class Pictures(unittest.TestCase):
    def setUp(self):
        self.charge = charge_map(below(lambda x: -0.02 - 0.5 * x), turning(5, (-0.03, -0.06)), voxels=33)
        self.readings = read_charge(self.charge, RADIUS)
        self.addCleanup(plt.close, "all")

    def test_the_map_has_solidity_surface_centre_and_arrows(self):
        axis = charge_figure(self.charge, self.readings, RADIUS).axes[0]
        image = next(one for one in axis.collections if isinstance(one, QuadMesh))
        shown = np.ma.filled(np.ma.masked_invalid(image.get_array()), -1).reshape(self.charge.solidity.shape)
        within = self.charge.inside > 0.01
        np.testing.assert_allclose(shown[within], self.charge.solidity[within])
        self.assertTrue(np.all(shown[~within] == -1))
        curves = lines_of(axis)
        surface = next(points for label, points in curves.items() if label.startswith("free surface, shoulder"))
        np.testing.assert_allclose(surface, 1e3 * self.readings.surface.points)
        # The charge is what lies below y = -0.02 - x / 2
        np.testing.assert_allclose(surface[:, 1], -20 - 0.5 * surface[:, 0], atol=5)
        centre = curves["centre of circulation (−30.0, −60.0) mm and line"]
        np.testing.assert_allclose(centre, [[-30, -60]], atol=0.1)
        arrows = next(one for one in axis.collections if isinstance(one, Quiver))
        # It turns about its centre at 5 1/s; voxels at the charge's edge have the mean of their filled part
        x, y = (arrows.XY / 1e3 - [-0.03, -0.06]).T
        self.assertGreater(len(x), 10)
        np.testing.assert_allclose(np.hypot(arrows.U, arrows.V), 5 * np.hypot(x, y), rtol=0.1)

    def test_the_velocity_has_its_curve_cubic_difference_and_slope(self):
        profile = self.readings.tangential
        upper, middle, lower = (lines_of(axis) for axis in tangential_figure(profile).axes)
        np.testing.assert_allclose(upper["map"], np.column_stack([1e3 * profile.distance, profile.velocity]))
        cubic = next(points for label, points in upper.items() if label.startswith("cubic, RMSD"))
        np.testing.assert_allclose(cubic[:, 1], profile.fitted(profile.distance))
        for curves, values in ((middle, profile.velocity - cubic[:, 1]), (lower, profile.shear_rate)):
            self.assertTrue(any(len(points) == len(values) and np.allclose(points[:, 1], values)
                                for points in curves.values()))

    def test_are_written(self):
        picture = io.BytesIO()
        save(tangential_figure(self.readings.tangential), picture)
        self.assertEqual(Image.open(picture).format, "PNG")

    def test_are_drawn_once_as_matplotlib_writes_them(self):
        figure, axis = plt.subplots(layout="constrained")
        figure.colorbar(axis.pcolormesh([[0, 1], [2, 3]]), label="of a layout that is computed")
        written = io.BytesIO()
        figure.savefig(written, dpi=60)
        for _ in range(2):  # the second time as redrawn_figures', without a layout engine
            np.testing.assert_array_equal(np.asarray(drawn(figure, 60)), np.asarray(Image.open(written)))
        self.assertEqual(figure.dpi, plt.rcParams["figure.dpi"])
        plt.close(figure)

    def test_show_the_outline_that_is_given_or_the_circle(self):
        square = RADIUS * np.array([[1, 0], [0, 1], [-1, 0], [0, -1], [1, 0]])
        for outline, points in ((square, square), (None, circle(RADIUS))):
            figure = charge_figure(self.charge, self.readings, RADIUS, outline)
            lines = [line.get_xydata() for line in figure.axes[0].lines]
            self.assertTrue(any(line.shape == points.shape and np.allclose(line, 1e3 * points) for line in lines))

    def test_errors_of_windows_that_are_alike_are_nought(self):
        maps = [self.charge] * 4
        for name, reading in charge_with_errors(maps, RADIUS).items():
            with self.subTest(name):
                self.assertEqual((reading.blocks, reading.failed), (4, 0))
                np.testing.assert_allclose(reading.error, 0, atol=1e-9)
        np.testing.assert_allclose(charge_with_errors(maps, RADIUS)["centre"].value, (-0.03, -0.06), atol=1e-4)


if __name__ == "__main__":
    unittest.main()
