#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh's way round: foamMeshToH5, millAverage --mesh, particleDrag on the same mesh as it turns."""
import subprocess
import unittest

import numpy as np

from millfoam.files import foam
from openfoam_case import OpenFoamTest, require_environment, rotating_mesh

OMEGA, DELTA_T, STEPS, TIME0 = 20.0, 2e-3, 5, 1.0
RADIUS = 0.001


class BallInATurningMesh(OpenFoamTest):
    """A ball that flies through a box that turns about z; the flow's steps end where records were made."""

    start, velocity = np.array([0.0149, -0.0152, 0.006]), np.array([0.9, 0.5, 0.1])

    def setUp(self):
        super().setUp()
        self.case = self.box(lower=(-0.02, -0.03, 0), upper=(0.04, 0.02, 0.02), cells=(6, 5, 2), delta_t=DELTA_T,
                             end_time=STEPS * DELTA_T)
        self.case.write("constant/dynamicMeshDict", rotating_mesh(OMEGA))
        self.case.write("constant/millProperties", f"time0 {TIME0};")
        (self.case.path / "dumps").mkdir()
        for step in range(STEPS + 1):
            place = " ".join(f"{x:.12g}" for x in (*self.place(step * DELTA_T), *self.velocity))
            time_step = round((TIME0 + step * DELTA_T) / 1e-5)
            (self.case.path / f"dumps/{time_step}.txt").write_text(
                f"ITEM: TIMESTEP\n{time_step}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
                f"ITEM: ATOMS id x y z vx vy vz radius\n1 {place} {RADIUS}\n")

    def place(self, time):
        return self.start + self.velocity * time

    def average(self):
        self.assert_runs(self.case, "foamMeshToH5")
        path = self.case.path
        done = subprocess.run(
            ["millAverage", "--dumps", f"{path}/dumps/*.txt", "--dt", "1e-5", "--mesh", str(path / "mesh.h5"),
             "--motion", f"rotation speed {OMEGA}", "--window", str(DELTA_T), "-o", str(path / "solids.h5")],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_is_felt_in_the_cells_that_it_is_in_with_its_velocity_in_the_lab_frame(self):
        self.average()
        self.case.drag('law Ergun; solids "solids.h5";')
        self.assert_runs(self.case, "millInterFoam")
        volume = 4 / 3 * np.pi * RADIUS**3
        volumes = foam.read_mesh(self.case.path).centres_and_volumes()[1]
        cells = set()
        for step in range(1, STEPS + 1):
            time = step * DELTA_T
            # Cells are equal boxes: the one that holds the ball has the nearest centre
            distance = np.linalg.norm(self.case.centres(time) - self.place(time), axis=1)
            cell = int(np.argmin(distance))
            solidity = self.case.field("solidity", time)
            self.assertAlmostEqual((solidity * volumes).sum() / volume, 1, delta=1e-9)
            self.assertEqual(int(np.argmax(solidity * volumes)), cell)
            np.testing.assert_allclose(self.case.field("solidsVelocity", time)[cell], self.velocity, rtol=1e-9)
            cells.add(cell)
        self.assertGreater(len(cells), 1)


if __name__ == "__main__":
    require_environment()
    unittest.main()
