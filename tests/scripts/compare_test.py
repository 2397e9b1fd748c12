#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two maps of a charge are apart, on maps whose difference is known."""
import unittest

import numpy as np

from millfoam.compare import CLOSEST, difference
from millfoam.solids import SolidsMap


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

    def test_maps_on_other_voxels_are_refused(self):
        other = uniform(0.5, 2)
        other.x = other.x + 0.1
        with self.assertRaisesRegex(ValueError, "same voxels"):
            difference(uniform(0.5, 2), other)


if __name__ == "__main__":
    unittest.main()
