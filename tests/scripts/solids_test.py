#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of windows, their mean and errors over time, on a file whose numbers are known."""
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from millfoam.files import solids_file
from millfoam.files.solids_file import mean_map, read_map, read_windows
from millfoam.readings.means import with_error


def write(path, solidity, speed, complete=1):
    """A solids.h5 of 2 x 2 x 2 voxels, half of each within the mill; windows of 0.05 s of uniform solidity and speed
    along x."""
    with h5py.File(path, "w") as file:
        file.attrs.update(complete=complete, timestep=1e-5)
        file.create_group("grid").attrs.update(lower=[0, 0, 0], upper=[1, 2, 1], shape=[2, 2, 2])
        windows = len(solidity)
        file["window/begin"], file["window/end"] = 0.05 * np.arange(windows), 0.05 * np.arange(1, windows + 1)
        file["grid/insideFraction"] = np.full((windows, 2, 2, 2), 0.5)
        file["solidity"] = np.broadcast_to(np.reshape(solidity, (-1, 1, 1, 1)), (windows, 2, 2, 2))
        velocity = np.zeros((windows, 2, 2, 2, 3))
        velocity[..., 0] = np.reshape(speed, (-1, 1, 1, 1))
        file["velocity"] = velocity


class Windows(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="solids-")
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "solids.h5"
        write(self.path, (0.1, 0.3, 0.2), (1, 2, 5))

    def test_each_has_its_own_map(self):
        maps = read_windows(self.path)
        self.assertEqual([one.begin for one in maps], [0, 0.05, 0.1])
        for one, solidity, speed in zip(maps, (0.1, 0.3, 0.2), (1, 2, 5)):
            np.testing.assert_allclose(one.solidity, solidity)
            np.testing.assert_allclose(one.velocity[..., 0], speed)

    def test_their_mean_weights_velocity_by_solidity(self):
        for mean in (read_map(self.path, end=0.1), mean_map(read_windows(self.path, end=0.1))):
            np.testing.assert_allclose(mean.solidity, 0.2)
            np.testing.assert_allclose(mean.inside, 0.5)
            np.testing.assert_allclose(mean.velocity[..., 0], (0.1 * 1 + 0.3 * 2) / 0.4)
            self.assertEqual((mean.begin, mean.end), (0, 0.1))

    def test_pictures_leave_out_the_velocity_of_rare_balls(self):
        write(self.path, (0.03, 0.02), (1, 1))
        for rare, shown in ((solids_file.RARE, [True, False]), (0.05, [False, False]), (0.01, [True, True])):
            with mock.patch.object(solids_file, "RARE", rare):
                self.assertEqual([bool(one.shown().all()) for one in read_windows(self.path)], shown)

    def test_none_in_that_time_or_a_file_that_is_not_whole_is_refused(self):
        with self.assertRaisesRegex(RuntimeError, "no window between 3 and inf s; the file has 0.0 to 0.15"):
            read_windows(self.path, 3)
        write(self.path, (0.1,), (1,), complete=0)
        with self.assertRaisesRegex(RuntimeError, "not complete"):
            read_windows(self.path)


class Errors(unittest.TestCase):
    def maps(self, solidities):
        folder = tempfile.TemporaryDirectory(prefix="solids-")
        self.addCleanup(folder.cleanup)
        write(Path(folder.name) / "solids.h5", solidities, np.ones(len(solidities)))
        return read_windows(Path(folder.name) / "solids.h5")

    def test_is_that_of_the_blocks_means(self):
        # Blocks of two windows have means 0.2, 0.3, 0.4: standard deviation 0.1
        found = with_error(lambda one: one.solidity[0, 0], self.maps((0.1, 0.3, 0.2, 0.4, 0.3, 0.5)), blocks=3)
        self.assertAlmostEqual(float(found.value), 0.3)
        self.assertAlmostEqual(float(found.error), 0.1 / np.sqrt(3))
        self.assertEqual((found.blocks, found.failed), (3, 0))

    def test_of_independent_windows_is_that_of_their_mean(self):
        random = np.random.default_rng(3)
        found = with_error(lambda one: one.solidity[0, 0], self.maps(0.3 + 0.05 * random.standard_normal(400)),
                           blocks=20)
        self.assertAlmostEqual(float(found.error), 0.05 / np.sqrt(400), delta=0.2 * 0.05 / np.sqrt(400))

    def test_blocks_without_the_reading_are_counted_and_left_out(self):
        def reading(one):
            if one.solidity[0, 0] < 0.2:
                raise RuntimeError("no charge")
            return np.array([one.solidity[0, 0], np.nan if one.solidity[0, 0] > 0.7 else 1])

        found = with_error(reading, self.maps((0.1, 0.4, 0.6, 0.8)), blocks=4)
        self.assertEqual((found.blocks, found.failed), (2, 2))
        np.testing.assert_allclose(found.value, (0.475, 1))
        np.testing.assert_allclose(found.error, (0.1, 0), atol=1e-12)
        alone = with_error(reading, self.maps((0.1, 0.6, 0.1)), blocks=3)
        self.assertEqual((alone.blocks, alone.failed), (1, 2))
        self.assertTrue(np.isnan(alone.error).all())

    def test_what_the_whole_map_does_not_have_is_refused(self):
        def reading(one):
            raise RuntimeError("no charge")

        with self.assertRaisesRegex(RuntimeError, "no charge"):
            with_error(reading, self.maps((0.1, 0.2)))
        with self.assertRaisesRegex(ValueError, "1 windows in 8 blocks"):
            with_error(lambda one: 1.0, self.maps((0.1,)))


if __name__ == "__main__":
    unittest.main()
