#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a charge are written, and are not blank; errors of all readings over windows that are alike are
zero."""
import io
import unittest

import numpy as np
from PIL import Image

from charge_test import RADIUS, below, charge_map, turning
from millfoam.files.outline import circle
from millfoam.plots.charge_plots import charge_figure, tangential_figure
from millfoam.plots.mill_plots import save
from millfoam.readings.charge import charge_with_errors, read_charge


class Pictures(unittest.TestCase):
    def test_are_written(self):
        charge = charge_map(below(lambda x: -0.02 - 0.5 * x), turning(5, (-0.03, -0.06)), voxels=33)
        readings = read_charge(charge, RADIUS)
        for figure in (charge_figure(charge, readings, RADIUS), tangential_figure(readings.tangential)):
            picture = io.BytesIO()
            save(figure, picture)
            self.assertGreater(np.asarray(Image.open(picture).convert("L"), float).std(), 10)

    def test_show_the_outline_that_is_given_or_the_circle(self):
        charge = charge_map(below(lambda x: -0.02 - 0.5 * x), turning(5, (-0.03, -0.06)), voxels=33)
        readings = read_charge(charge, RADIUS)
        square = RADIUS * np.array([[1, 0], [0, 1], [-1, 0], [0, -1], [1, 0]])
        for outline, points in ((square, square), (None, circle(RADIUS))):
            figure = charge_figure(charge, readings, RADIUS, outline)
            lines = [line.get_xydata() for line in figure.axes[0].lines]
            self.assertTrue(any(line.shape == points.shape and np.allclose(line, 1e3 * points) for line in lines))

    def test_errors_of_windows_that_are_alike_are_nought(self):
        maps = [charge_map(below(lambda x: -0.02 - 0.5 * x), turning(5, (-0.03, -0.06)), voxels=33)] * 4
        for name, reading in charge_with_errors(maps, RADIUS).items():
            with self.subTest(name):
                self.assertEqual((reading.blocks, reading.failed), (4, 0))
                np.testing.assert_allclose(reading.error, 0, atol=1e-9)
        np.testing.assert_allclose(charge_with_errors(maps, RADIUS)["centre"].value, (-0.03, -0.06), atol=1e-4)


if __name__ == "__main__":
    unittest.main()
