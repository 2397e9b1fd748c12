#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verification case repose: the slope of made-up piles, its balls, and its verdicts."""
import contextlib
import io
import math
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from millfoam.readings.means import Mean

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "verification" / "repose"))

import compare  # noqa: E402, in the case's folder
from compare import FAILS, HOLDS, UNDECIDED  # noqa: E402
from repose import DIAMETER, Ledge, Shape, place_balls, scaled_axes, slope  # noqa: E402

LEDGE = Ledge(16, 5, 10)


def heap(angle):
    """Balls in a wedge with a slope of `angle` degrees down to a lip of a diameter at the edge."""
    length = LEDGE.length * DIAMETER
    balls = np.random.default_rng(1).uniform((0, 0, 0), (length, LEDGE.width * DIAMETER, length), (200000, 3))
    return balls[balls[:, 2] < DIAMETER + (length - balls[:, 0]) * np.tan(np.radians(angle))]


class Slope(unittest.TestCase):
    def test_of_a_wedge_is_its_angle(self):
        for angle in (10, 25, 40):
            self.assertAlmostEqual(slope(heap(angle), LEDGE), angle, delta=1.0, msg=str(angle))

    def test_a_pile_that_is_too_low_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "diameters at the wall; expected 2.5 or more"):
            slope(heap(2), LEDGE)


class Balls(unittest.TestCase):
    def test_have_the_volume_of_a_sphere(self):
        for axes, blockiness in (((1, 1, 1), 2), ((2.7, 2.0, 1.7), 6), ((3, 2, 1), 4)):
            a, b, c = scaled_axes(Shape("one", axes, blockiness))
            part = 1 / blockiness
            volume = 8 * a * b * c * math.gamma(1 + part)**3 / math.gamma(1 + 3 * part)
            self.assertAlmostEqual(volume / (np.pi / 6 * DIAMETER**3), 1, delta=1e-12)
        np.testing.assert_allclose(scaled_axes(Shape("round", (1, 1, 1))), DIAMETER / 2, rtol=1e-12)

    def test_are_as_many_of_every_shape_and_at_the_same_places(self):
        def places(shape):
            return [line for line in place_balls(shape, LEDGE, 3)[0] if line.startswith("create_atoms")]
        self.assertEqual(len(places(Shape("spheres"))), 12 * 3 * 10)
        self.assertEqual(places(Shape("spheres")), places(Shape("round", (1, 1, 1))))


class Verdicts(unittest.TestCase):
    def verdicts(self, spheres, round_ones, blunt, error=0.2, freedom=np.inf):
        angles = zip(("spheres", "round", "blunt"), (spheres, round_ones, blunt))
        return [one for one, _ in compare.verdicts({name: Mean(value, error, freedom) for name, value in angles})]

    def test_round_bodies_are_spheres_and_blunt_ones_are_steeper(self):
        self.assertEqual(self.verdicts(25, 25.8, 30), [HOLDS, HOLDS])
        self.assertEqual(self.verdicts(25, 28, 26), [FAILS, FAILS])

    def test_scatter_alone_decides_nothing(self):
        # Three piles each: four degrees of freedom, 2.8 errors of 1.1 degrees
        self.assertEqual(self.verdicts(25, 25, 29, error=0.8, freedom=2), [UNDECIDED, UNDECIDED])
        self.assertEqual(self.verdicts(25, 29, 40, error=0.8, freedom=2), [UNDECIDED, HOLDS])
        self.assertEqual(self.verdicts(25, 25, 20, error=0.8, freedom=2), [UNDECIDED, FAILS])

    def test_a_difference_that_is_too_large_with_all_its_reach_fails(self):
        # A reach of 3.1 degrees does not reach from 6 or 15 to 2
        for round_ones in (31, 40, 10):
            self.assertEqual(self.verdicts(25, round_ones, 40, error=0.8, freedom=2), [FAILS, HOLDS])
        self.assertEqual(self.verdicts(25, 30, 40, error=0.8, freedom=2), [UNDECIDED, HOLDS])

    def test_single_piles_have_no_error(self):
        self.assertEqual(self.verdicts(25, 25, 40, error=np.nan), [UNDECIDED, UNDECIDED])


class Table(unittest.TestCase):
    def run_case(self, blunt):
        """Exit code and table, with piles of blunt bodies of this angle, degrees."""
        def pile(_, shape, ledge, seed):
            return heap((blunt if shape.name == "blunt" else 25) + 0.1 * seed)[::4]
        words = io.StringIO()
        with tempfile.TemporaryDirectory(prefix="repose-") as folder, contextlib.redirect_stdout(words), \
                mock.patch.multiple(compare, HERE=Path(folder), pile=pile, LEDGE=LEDGE), \
                mock.patch.object(sys, "argv", ["compare.py"]):
            code = compare.main()
            self.assertEqual((Path(folder) / "repose.txt").read_text(), words.getvalue())
            self.assertTrue((Path(folder) / "repose.png").exists())
        return code, words.getvalue().splitlines()

    def test_is_printed_and_fails_unless_all_holds(self):
        code, lines = self.run_case(30)
        self.assertEqual((code, [line.split(":")[0] for line in lines[3:]]), (0, [HOLDS, HOLDS]))
        code, lines = self.run_case(25)
        self.assertEqual((code, [line.split(":")[0] for line in lines[3:]]), (1, [HOLDS, FAILS]))


if __name__ == "__main__":
    unittest.main()
