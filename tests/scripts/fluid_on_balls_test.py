#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The force on the balls out of a slurry.h5 whose fields are known, and files of other versions."""
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from millfoam.files.slurry_file import FEW_BALLS, read_ball_forces, read_slurry_map
from millfoam.readings.fluid_on_balls import fluid_on_balls

LOWER, UPPER, SHAPE = np.zeros(3), np.array([0.4, 0.2, 0.1]), (4, 2, 1)
VOXEL = 0.1 * 0.1 * 0.1
SPEED = np.array([0.3, 0, 0.1])  # of all balls, m/s
DENSITY, GRAVITY = 2700.0, np.array([0, -9.81, 0])


def write_slurry(path, version=2, balls=True):
    """Two windows of 0.5 s from 1 s on; in the second the pressure's force is twice as large, with half of the
    balls."""
    cells = SHAPE[::-1]
    x = np.broadcast_to((np.arange(4) + 0.5) * 0.1, cells)
    inside = np.where(x > 0.3, 0.5, 1.0)
    solidity = np.stack([np.where(x < 0.2, 0.5, 0.0), np.where(x < 0.2, 0.25, 0.0)])
    pressure = np.stack([1.0 + 0 * x, 2.0 + 0 * x])[..., None] * [10.0, 12000.0, 0]
    exchange = np.stack([4000 + 0 * x, 8000 + 0 * x])
    velocity = np.stack([1.0 + 0 * x, 2.0 + 0 * x])[..., None] * SPEED
    drag = exchange[..., None] * [0.2, 0, 0]
    with h5py.File(path, "w") as file:
        file.attrs.update(format="millfoam-slurry", version=version, complete=1, time0=1.0, window=0.5)
        file.create_group("grid").attrs.update(lower=LOWER, upper=UPPER, shape=SHAPE, periodic=[0, 0, 0])
        file["grid/insideFraction"] = np.stack([inside, inside])
        file["window/begin"], file["window/end"] = [1.0, 1.5], [1.5, 2.0]
        for name, values in (("slurry", 1.0), ("voidage", 1.0), ("pressure", 5.0)):
            file[name] = np.full((2, *cells), values)
        file["velocity"] = np.zeros((2, *cells, 3))
        mean = file.create_group("mean")
        mean.attrs.update(begin=1.0, end=2.0)
        mean["insideFraction"] = inside
        if balls:
            file.create_group("balls").attrs.update(law=np.bytes_("Hill"), polydispersity=0, slurry_density=1239.0,
                                                    air_density=1.2, gravity=GRAVITY)
            weight = solidity + FEW_BALLS
            for name, values in (("solidity", solidity), ("pressure_force", pressure), ("exchange", exchange),
                                 ("drag_force", drag), ("velocity", velocity),
                                 ("fluid_density", 1000 + 0 * exchange),
                                 ("diameter", 0.005 + 0 * exchange)):
                file[f"balls/{name}"] = values
                if name == "drag_force":
                    values = values - exchange[..., None] * velocity
                over = weight if values.ndim == 4 else weight[..., None]
                mean[f"balls/{name}"] = values.mean(axis=0) if name == "solidity" else (
                    (over * values).sum(axis=0) / over.sum(axis=0))
            mean["balls/drag_force"][...] += mean["balls/exchange"][()][..., None] * mean["balls/velocity"][()]


class FluidOnBalls(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.slurry = Path(folder.name) / "slurry.h5"
        write_slurry(self.slurry)

    def test_the_force_is_what_all_balls_feel(self):
        # Four voxels have 0.5 and 0.25 of balls: a third of what acts is of the second window
        volume = 4 * VOXEL * 0.375
        fluid = np.array([0.2, 0, 0])
        drag = volume * (2 / 3 * 4000 * (fluid - SPEED) + 1 / 3 * 8000 * (fluid - 2 * SPEED))
        for times in ({}, {"begin": 1.0, "end": 2.0}):
            found = fluid_on_balls(self.slurry, DENSITY, **times)
            self.assertAlmostEqual(found.volume, volume, delta=1e-15)
            np.testing.assert_allclose(found.pressure, volume * 4 / 3 * np.array([10.0, 12000.0, 0]), rtol=2e-6)
            np.testing.assert_allclose(found.drag, drag, rtol=2e-6, atol=1e-12)
            np.testing.assert_allclose(found.force, found.pressure + found.drag)
            self.assertAlmostEqual(found.weight, volume * DENSITY * 9.81, delta=1e-9)
            self.assertAlmostEqual(found.over_weight, np.linalg.norm(found.force) / found.weight, delta=1e-12)

    def test_a_window_is_that_of_its_time(self):
        found = fluid_on_balls(self.slurry, DENSITY, 1.5, 2.0)
        self.assertAlmostEqual(found.pressure[1], 4 * VOXEL * 0.25 * 24000, delta=1e-9)
        forces = read_ball_forces(self.slurry, 1.5, 2.0)
        self.assertEqual((forces.begin, forces.end, forces.law, forces.polydispersity), (1.5, 2.0, "Hill", False))
        np.testing.assert_allclose(forces.inside[..., 3], 0.5)
        np.testing.assert_allclose(forces.fluid_density, 1000)

    def test_the_torque_is_about_the_axis(self):
        found = fluid_on_balls(self.slurry, DENSITY)
        # Balls from x = 0 to 0.2 and y = 0 to 0.2 m
        self.assertAlmostEqual(found.torque, 0.1 * found.force[1] - 0.1 * found.force[0], delta=1e-9)

    def test_files_of_version_1_have_maps_but_no_forces(self):
        write_slurry(self.slurry, version=1, balls=False)
        np.testing.assert_allclose(read_slurry_map(self.slurry, 1.0, 2.0).share, 1)
        with self.assertRaisesRegex(RuntimeError, "slurry.h5: no group /balls: it is of version 1"):
            read_ball_forces(self.slurry)

    def test_files_of_version_2_have_maps(self):
        np.testing.assert_allclose(read_slurry_map(self.slurry, 1.0, 2.0).share, 1)

    def test_flows_without_balls_and_newer_files_are_refused(self):
        write_slurry(self.slurry, balls=False)
        with self.assertRaisesRegex(RuntimeError, "no group /balls: .* a flow without balls"):
            read_ball_forces(self.slurry)
        write_slurry(self.slurry, version=3)
        for read in (read_ball_forces, read_slurry_map):
            with self.assertRaisesRegex(RuntimeError, r"slurry.h5: version 3; expected one of \(1, 2\)"):
                read(self.slurry)


if __name__ == "__main__":
    unittest.main()
