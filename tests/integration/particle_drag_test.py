#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What particleDrag does to a flow: the force, its implicitness, decomposition, and meshes that rotate."""
import csv
import subprocess
import unittest

import numpy as np

import solids
from openfoam_case import DENSITY, VISCOSITY, OpenFoamTest, require_environment, rotating_mesh

EVERYWHERE = "box (-9 -9 -9) (9 9 9)"


def exchange(law, solidity, reynolds, diameter):
    """Exchange coefficient beta, kg/(m3 s), from millDrag."""
    table = subprocess.run(
        ["millDrag", "--law", law, "--phi", str(solidity), "--re", str(reynolds), "--mu", str(VISCOSITY), "--rho",
         str(DENSITY), "--d", str(diameter), "--format", "csv"], check=True, capture_output=True, text=True).stdout
    return float(next(csv.DictReader(table.splitlines()))["beta"])


class Force(OpenFoamTest):
    """On a fluid at rest, in the first time-step, the slip is the balls' velocity and the force is known."""

    def first_force(self, law="Ergun", multiplier=1.0):
        case = self.box(periodic=True)
        case.drag(f"law {law}; multiplier {multiplier}; "
                  f"block {{ {EVERYWHERE}; solidity 0.5; velocity (0.1 0 0); diameter 0.005; }}")
        return self.assert_runs(case, "millInterFoam").forces()[0]

    def test_is_beta_slip_over_voidage_times_volume(self):
        reynolds = DENSITY * 0.5 * 0.1 * 0.005 / VISCOSITY
        for law in ("Ergun", "Beetstra"):
            expected = exchange(law, 0.5, reynolds, 0.005) * 0.1 / 0.5 * 0.04**3
            found = self.first_force(law)
            # The log has six digits
            np.testing.assert_allclose(found, [expected, 0, 0], rtol=1e-5, atol=1e-12)

    def test_doubles_with_multiplier_2(self):
        np.testing.assert_allclose(self.first_force(multiplier=2), 2 * self.first_force(), rtol=1e-5, atol=1e-12)

    def test_is_gone_with_multiplier_0(self):
        np.testing.assert_array_equal(self.first_force(multiplier=0), [0, 0, 0])


class FluidInAPeriodicBed(OpenFoamTest):
    """Fluid in a bed that fills a periodic box is dragged along: du/dt = k (u_s - u), k = beta/(e rho), which implicit
    Euler solves as u_n = u_s (1 - (1 + k dt)^-n)."""

    solidity, speed, diameter = 0.5, 1e-5, 1e-3

    def speeds(self, k_dt, steps):
        """Speeds after each step over the balls' speed, expected and found."""
        reynolds = DENSITY * (1 - self.solidity) * self.speed * self.diameter / VISCOSITY
        # Re 0.005: Ergun is linear in the slip to 1e-4
        rate = exchange("Ergun", self.solidity, reynolds, self.diameter) / ((1 - self.solidity) * DENSITY)
        delta_t = round(k_dt / rate, 9)
        case = self.box(periodic=True, delta_t=delta_t, end_time=steps * delta_t)
        case.drag(f"law Ergun; block {{ {EVERYWHERE}; solidity {self.solidity}; velocity ({self.speed} 0 0);"
                  f" diameter {self.diameter}; }}")
        self.assert_runs(case, "millInterFoam")
        number = np.arange(1, steps + 1)
        found = np.array([case.field("U", n * delta_t) for n in number]) / self.speed
        np.testing.assert_allclose(found[:, :, 1:], 0, atol=1e-9)
        return (1 - (1 + rate * delta_t) ** -number)[:, None], found[:, :, 0]

    def test_relaxes_to_the_balls_velocity_as_implicit_euler_does(self):
        expected, found = self.speeds(k_dt=0.2, steps=8)
        np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), rtol=3e-4)

    def test_stays_bounded_with_a_time_step_of_a_thousand_relaxation_times(self):
        expected, found = self.speeds(k_dt=1000, steps=5)
        np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), rtol=3e-4)
        self.assertLessEqual(found.max(), 1 + 1e-9)


class Decomposition(OpenFoamTest):
    """A pool with a bed that moves in it, on one rank and on two."""

    shape, lower, upper = (5, 4, 3), (-0.01, -0.01, 0.0), (0.07, 0.05, 0.04)
    steps, delta_t = 20, 5e-4

    def run_case(self, ranks):
        x, y, z = solids.centres(self.lower, self.upper, self.shape)
        solidity = [0.2 + 3 * x - y + z, 0.3 - x + 2 * y]
        case = self.box(upper=(0.06, 0.05, 0.04), cells=(12, 10, 8), gravity=(0, -9.81, 0),
                        alpha=np.tile(np.repeat(np.where(np.arange(10) < 6, 1.0, 0.0), 12), 8),
                        delta_t=self.delta_t, end_time=self.steps * self.delta_t, write_interval=self.steps)
        solids.write(case.path / "solids.h5", self.lower, self.upper, solidity, velocity=(0.1, 0.05, -0.02),
                     window=0.006)
        case.drag('law Beetstra; solids "solids.h5"; interpolation linear;')
        case.decompose_into(2, 1, 1)
        if ranks > 1:
            self.assert_runs(case, "decomposePar")
        result = self.assert_runs(case, "millInterFoam", ranks=ranks)
        if ranks > 1:
            self.assert_runs(case, "reconstructPar")
        names = ("U", "p_rgh", "alpha.slurry", "solidity", "solidsVelocity", "solidsDiameter")
        return {field: case.field(field, self.steps * self.delta_t) for field in names}, result.forces()

    def test_changes_nothing_but_the_solvers_round_off(self):
        one, force_one = self.run_case(1)
        two, force_two = self.run_case(2)
        for name in ("solidity", "solidsVelocity", "solidsDiameter"):
            np.testing.assert_array_equal(two[name], one[name], name)
        self.assertGreater(np.linalg.norm(one["U"], axis=1).max(), 0.01)
        for name in ("U", "p_rgh", "alpha.slurry"):
            scale = np.abs(one[name]).max()
            np.testing.assert_allclose(two[name], one[name], rtol=0, atol=1e-7 * scale, err_msg=name)
        np.testing.assert_allclose(force_two, force_one, rtol=1e-5, atol=1e-9)


class RotatingMesh(OpenFoamTest):
    """A box of walls that turns about z through solids that stay in the lab frame."""

    omega, delta_t, steps = -20.0, 2e-3, 15

    @staticmethod
    def solidity(x, y):
        return 0.3 + 2 * x - 3 * y

    def setUp(self):
        super().setUp()
        # Offset and of unequal sides: a wrong frame, sense or axis gives other centres
        self.case = self.box(lower=(-0.02, -0.03, 0), upper=(0.04, 0.02, 0.01), cells=(6, 5, 2), delta_t=self.delta_t,
                             end_time=self.steps * self.delta_t, write_interval=5)
        self.case.write("constant/dynamicMeshDict", rotating_mesh(self.omega))
        # The outermost voxel centres, +-0.055 m, enclose all that the box sweeps: linear interpolation is exact
        lower, upper, shape = (-0.06, -0.06, 0), (0.06, 0.06, 0.01), (12, 12, 1)
        x, y, _ = solids.centres(lower, upper, shape)
        solids.write(self.case.path / "solids.h5", lower, upper, [self.solidity(x, y)], velocity=(0.1, 0.2, 0.05),
                     window=0.1)
        self.case.drag('law Ergun; solids "solids.h5"; interpolation linear;')
        self.assert_runs(self.case, "millInterFoam")
        self.times = [5 * self.delta_t, 10 * self.delta_t, 15 * self.delta_t]

    def test_sees_the_lab_frame_solidity_at_the_moved_centres(self):
        for time in self.times:
            moved = self.case.centres(time)
            np.testing.assert_allclose(self.case.field("solidity", time), self.solidity(moved[:, 0], moved[:, 1]),
                                       rtol=0, atol=1e-12)

    def test_has_centres_that_turned_by_the_angle_of_the_motion(self):
        x, y, z = self.case.centres().T
        angle = self.omega * self.times[-1]
        turned = np.column_stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z])
        np.testing.assert_allclose(self.case.centres(self.times[-1]), turned, rtol=0, atol=1e-12)

    def test_does_not_turn_the_balls_velocity(self):
        velocity = self.case.field("solidsVelocity", self.times[-1])
        np.testing.assert_allclose(velocity, np.broadcast_to([0.1, 0.2, 0.05], velocity.shape), rtol=1e-12)


if __name__ == "__main__":
    require_environment()
    unittest.main()
