#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What balls feel, in slurry.h5 of slurryFoam, compared with closed forms: buoyancy, the pressure drop of a bed, the
drag law's coefficient, and the written fields of a mesh that turns. It is the same after a restart and on two ranks."""
import subprocess
import unittest

import h5py
import numpy as np

import solids
from millfoam.files.slurry_file import read_ball_forces
from millfoam.readings.fluid_on_balls import fluid_on_balls
from openfoam_case import require_environment, rotating_mesh
from slurry_case import AIR, SLURRY, SlurryTest

SHAPE, UPPER = (14, 10, 2), (0.14, 0.1, 0.02)
GRAVITY = np.array([0, -9.81, 0])
VISCOSITY, DIAMETER, SOLIDITY = 1.4e-3, 0.005, 0.5
NAMES = ("solidity", "pressure_force", "exchange", "drag_force", "fluid_density", "diameter")
EVERYWHERE = (f"block {{ box (-9 -9 -9) (9 9 9); solidity {SOLIDITY}; diameter {DIAMETER}; velocity (0.2 0.1 0); }} "
              "ledgerCorrection no;")


def law_beta(law, phi, slip, density=SLURRY, viscosity=VISCOSITY):
    """Exchange coefficient of the table of millDrag at an interstitial slip (m/s), kg/(m3 s)."""
    reynolds = density * (1 - phi) * slip * DIAMETER / viscosity
    command = ["millDrag", "--law", law, "--phi", repr(phi), "--re", repr(reynolds), "--d", repr(DIAMETER), "--rho",
               repr(density), "--mu", repr(viscosity)]
    rows = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return float(dict(zip(rows[0].split(","), rows[1].split(",")))["beta"])


def darcy(phi):
    """Darcy's exchange coefficient, which does not depend on the slip, kg/(m3 s)."""
    return 150 * VISCOSITY * phi**2 / ((1 - phi) * DIAMETER**2)


class FluidOnBalls(SlurryTest):
    def pool(self, level=lambda x: 1 + 0 * x, *, window=0.01,
             voxels="lower (0 0 0); upper (0.14 0.1 0.02); shape (14 10 2);", **options):
        """A box of 14 x 10 x 2 cm, full unless there is a level, with voxels as large as the cells."""
        case = self.slurry_case(level=level, **options)
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text() + f"""
            functions {{ voxelAverages {{ type voxelAverages; libs ("libmillFoam.so"); {voxels}
                window {window}; }} }}""")
        return case

    def forces(self, case, **times):
        self.assert_runs(case, "slurryFoam")
        return read_ball_forces(case.path / "slurry.h5", **times)

    def pushed(self, speed):
        """A full box without gravity, and slurry that is pushed through it along x at this speed (m/s)."""
        case = self.pool(end_time=0.4, window=0.1)
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        case.at_patch("left", U=f"type fixedValue; value uniform ({speed} 0 0);", p_rgh="type zeroGradient;",
                      alpha="type fixedValue; value uniform 1;")
        case.at_patch("right", U="type zeroGradient;", p_rgh="type fixedValue; value uniform 0;",
                      alpha="type zeroGradient;")
        for side in ("bottom", "top", "front", "back"):
            case.at_patch(side, U="type slip;")
        return case

    def bed_of(self, case, velocity, drag="law Beetstra;", entries=""):
        """A bed from 3 to 11 cm along the box, from a solids.h5."""
        phi = np.zeros((1, *SHAPE[::-1]))
        phi[..., 3:11] = SOLIDITY
        solids.write(case.path / "solids.h5", (0, 0, 0), UPPER, phi, velocity=velocity, window=1)
        case.bed('solids "solids.h5"; interpolation cell;', drag, entries)
        return phi[0]

    def test_a_pool_at_rest_carries_its_weight_of_the_balls(self):
        case = self.pool(lambda x: 0.05 + 0 * x)
        case.bed(f"block {{ box (0 0 0) (0.14 0.03 0.02); solidity {SOLIDITY}; diameter {DIAMETER};"
                 " velocity (0 0 0); }")
        found = self.forces(case)
        # The pool stays at rest to 1e-9 m/s or better; a steady -grad p has nothing else to balance than the weight
        for rows, density in ((slice(0, 5), SLURRY), (slice(5, 10), AIR)):
            expected = np.broadcast_to(-density * GRAVITY, found.pressure_force[:, rows].shape)
            np.testing.assert_allclose(found.pressure_force[:, rows], expected, atol=1e-6 * SLURRY)
            np.testing.assert_allclose(found.fluid_density[:, rows], density, rtol=1e-9)
        self.assertLess(np.abs(found.drag_force).max(), 1e-6 * SLURRY * 9.81)
        np.testing.assert_allclose(found.solidity[:, :3], SOLIDITY, rtol=1e-12)
        self.assertEqual(np.abs(found.solidity[:, 3:]).max(), 0)
        np.testing.assert_allclose(found.diameter, DIAMETER, rtol=1e-12)

    def test_slurry_carries_balls_that_its_surface_cuts_by_its_share(self):
        for share in (0.2, 0.51, 0.75, 0.99):
            with self.subTest(share):
                case = self.pool(lambda x: 0.04 + 0.01 * share + 0 * x, window=0.002, end_time=0.006)
                case.bed(EVERYWHERE, "law Darcy; multiplier 0;")
                found = self.forces(case)
                density = share * SLURRY + (1 - share) * AIR
                np.testing.assert_allclose(found.fluid_density[:, 4], density, rtol=1e-9)
                np.testing.assert_allclose(found.pressure_force[:, 4],
                                           np.broadcast_to(-density * GRAVITY, (2, 14, 3)), atol=1e-6 * SLURRY)

    def test_the_bed_takes_what_the_pressure_drops(self):
        """Balls drawn through a fluid at rest: F = beta/e u_s on each volume of them and of fluid, and buoyancy."""
        for entries, factor in (("", 1.0), ("polydispersity yes;", 1 + 0.064 * (1 - SOLIDITY))):
            with self.subTest(entries):
                speed = 0.2
                case = self.pool()
                phi = self.bed_of(case, (speed, 0, 0), f"law Beetstra; {entries}")
                found = self.forces(case)
                beta = law_beta("Beetstra", SOLIDITY, speed)
                drop = -factor * beta / (1 - SOLIDITY) * speed
                bed = phi > 0
                np.testing.assert_allclose(found.pressure_force[bed], [[drop, SLURRY * 9.81, 0]] * bed.sum(),
                                           atol=1e-9 * abs(drop))
                np.testing.assert_allclose(found.pressure_force[~bed], [[0, SLURRY * 9.81, 0]] * (~bed).sum(),
                                           atol=1e-9 * abs(drop))
                np.testing.assert_allclose(found.exchange[bed], beta / SOLIDITY, rtol=1e-9)
                self.assertEqual((found.law, found.polydispersity), ("Beetstra", bool(entries)))
                np.testing.assert_array_equal(found.gravity, GRAVITY)

                on_balls = fluid_on_balls(case.path / "slurry.h5", 2700)
                # Far ends of the box, over the pressure in the voxels
                with h5py.File(case.path / "slurry.h5") as file:
                    pressure = file["mean/pressure"][()]
                area = UPPER[1] * UPPER[2]
                along = (pressure[..., 0] - pressure[..., -1]).mean() * area
                volume = SOLIDITY * 0.08 * area
                # The mixture's factor is not in what single balls feel
                drag = (factor - 1) * beta * speed / SOLIDITY * volume
                self.assertAlmostEqual(on_balls.force[0] / (along + drag), 1, delta=1e-6)
                self.assertAlmostEqual(on_balls.force[1] / (SLURRY * 9.81 * volume), 1, delta=1e-6)
                self.assertAlmostEqual(on_balls.volume / volume, 1, delta=1e-9)
                self.assertAlmostEqual(on_balls.weight / (2700 * 9.81 * volume), 1, delta=1e-9)

    def test_the_pressure_of_fluid_that_speeds_up_between_balls_is_felt(self):
        """Bernoulli, into a bed without drag: p falls by rho U^2 (1/e^2 - 1)/2, and rises behind it."""
        speed = 0.5
        case = self.pushed(speed)
        self.bed_of(case, (0, 0, 0), "law Darcy; multiplier 0;")
        found = self.forces(case, begin=0.3)
        along = found.pressure_force[..., 0].mean(axis=(0, 1)) * UPPER[0] / SHAPE[0]
        fall = SLURRY * speed**2 / 2 * (1 / (1 - SOLIDITY)**2 - 1)
        self.assertAlmostEqual(along[:7].sum() / fall, 1, delta=0.01)
        self.assertAlmostEqual(along.sum() / fall, 0, delta=0.01)

    def through_a_plate(self):
        """Balls everywhere that the flow does not drag, and a plate across it in the middle."""
        speed, loss = 0.5, 100
        case = self.pushed(speed)
        case.bed(EVERYWHERE, "law Darcy; multiplier 0;")
        case.write("system/topoSetDict", """
            actions ( { name middle; type faceSet; action new; source boxToFace; box (0.0699 -1 -1) (0.0701 1 1); }
                      { name plate; type faceZoneSet; action new; source setToFaceZone; faceSet middle; } );""")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties", f"middle {{ faces plate; loss {loss}; }}")
        return case, loss * SLURRY * (speed * (1 - SOLIDITY))**2 / 2

    def test_a_plate_takes_its_pressure_itself(self):
        case, drop = self.through_a_plate()
        split = self.copy_of(case)
        found = self.forces(case, begin=0.3)
        with h5py.File(case.path / "slurry.h5") as file:
            pressure = file["pressure"][-1]
        self.assertAlmostEqual((pressure[..., 0] - pressure[..., -1]).mean() / drop, 1, delta=1e-3)
        # Half of the drop over 1 cm would be felt by the cells beside it
        self.assertLess(np.abs(found.pressure_force[..., 0]).max(), 1e-3 * drop / 0.02)

        # The plate between the ranks
        split.decompose_into(2, 1, 1)
        self.assert_runs(split, "decomposePar")
        self.assert_runs(split, "slurryFoam", ranks=2)
        with h5py.File(split.path / "slurry.h5") as file:
            np.testing.assert_allclose(file["pressure"][-1], pressure, rtol=0, atol=1e-6 * drop)

    def test_few_balls_feel_the_limit_of_the_law(self):
        case = self.pool()
        phi = self.bed_of(case, (0, 0, 0), "law Benyahia; multiplier 2;")
        found = self.forces(case)
        # The fluid rests: no slip anywhere
        np.testing.assert_allclose(found.exchange[phi == 0], 2 * law_beta("Benyahia", 1e-3, 0.0) / 1e-3, rtol=1e-6)
        np.testing.assert_allclose(found.exchange[phi > 0], 2 * law_beta("Benyahia", SOLIDITY, 0.0) / SOLIDITY,
                                   rtol=1e-6)
        np.testing.assert_allclose(found.diameter, DIAMETER, rtol=1e-12)

    def test_a_bed_that_drags_all_fluid_along_meets_no_pressure_but_the_weight(self):
        """Where nothing stops the fluid, its mass takes the drag: e rho du/dt = beta (u_s - u)."""
        case = self.pool(periodic=True, window=0.002)
        case.bed(EVERYWHERE, "law Darcy;")
        found = self.forces(case, begin=0.018)
        beta, balls = darcy(SOLIDITY), np.array([0.2, 0.1, 0])
        np.testing.assert_allclose(found.pressure_force, np.broadcast_to(-SLURRY * GRAVITY, (*SHAPE[::-1], 3)),
                                   atol=1e-8 * SLURRY * 9.81)
        # Ten implicit steps of 2 ms
        rate = 0.002 * beta / ((1 - SOLIDITY) * SLURRY)
        expected = beta / SOLIDITY * balls * (1 - (1 + rate)**-10)
        np.testing.assert_allclose(found.drag_force, np.broadcast_to(expected, found.drag_force.shape),
                                   atol=1e-8 * expected.max())

    def turning(self):
        """A full box that turns about z, and a bed everywhere that does not."""
        case = self.pool(motion=rotating_mesh(3.0), window=0.002, end_time=0.01,
                         voxels="lower (-0.2 -0.2 0.005); upper (0.2 0.2 0.025); shape (30 30 2);"
                                " periodic (no no yes);")
        case.bed(EVERYWHERE, "law Darcy;")
        return case

    def test_voxels_hold_what_the_cells_feel_on_a_mesh_that_turns(self):
        case = self.turning()
        # The last window is one step, which is written
        found = self.forces(case, begin=0.008)
        self.assertAlmostEqual(found.begin, 0.008, delta=1e-9)
        velocity, force = case.field("U", 0.01), case.field("forceAcceleration", 0.01)
        beta, balls = darcy(SOLIDITY), np.array([0.2, 0.1, 0])
        self.assertGreater(np.abs(velocity).max(), 0.05)
        pressure = SLURRY * (force - GRAVITY) + beta / (1 - SOLIDITY) * (velocity - balls)
        cell = np.prod(UPPER) / np.prod(SHAPE) * SOLIDITY
        volumes = found.volumes()
        np.testing.assert_allclose(volumes.sum(), cell * len(velocity), rtol=1e-9)
        for name, cells in (("pressure_force", pressure), ("drag_force", beta / SOLIDITY * velocity)):
            total = (volumes[..., None] * getattr(found, name)).sum(axis=(0, 1, 2))
            np.testing.assert_allclose(total, cell * cells.sum(axis=0), rtol=0,
                                       atol=1e-9 * cell * np.abs(cells).sum(), err_msg=name)
        np.testing.assert_allclose((volumes * found.exchange).sum(), cell * len(velocity) * beta / SOLIDITY, rtol=1e-9)

    def moving(self):
        """A pool with a slope, and a bed that is drawn through it."""
        case = self.pool(lambda x: 0.045 + 0.2 * (x - 0.07), window=0.008)
        case.bed(f"block {{ box (0.03 0 0) (0.09 0.06 0.02); edge 0.02; edgeAxes (1 1 0); solidity {SOLIDITY}; "
                 f"diameter {DIAMETER}; velocity (0.3 0 0); moves yes; }} ledgerCorrection no;")
        return case

    def assert_same(self, found, expected, tolerance):
        with h5py.File(found.path / "slurry.h5") as one, h5py.File(expected.path / "slurry.h5") as other:
            for name in [f"balls/{name}" for name in NAMES] + [f"mean/balls/{name}" for name in NAMES]:
                a, b = one[name][()], other[name][()]
                self.assertEqual(a.shape, b.shape)
                np.testing.assert_allclose(a, b, rtol=0, atol=tolerance * np.abs(b).max(), err_msg=name)

    def test_a_restart_and_two_ranks_change_nothing(self):
        case = self.moving()
        split, killed = self.copy_of(case), self.copy_of(case)
        self.assert_runs(case, "slurryFoam")
        control = killed.path / "system" / "controlDict"
        control.write_text(control.read_text().replace("endTime 0.02", "endTime 0.01"))
        self.assert_runs(killed, "slurryFoam")
        control.write_text(control.read_text().replace("endTime 0.01", "endTime 0.02").replace(
            "startFrom startTime", "startFrom latestTime"))
        self.assert_runs(killed, "slurryFoam")
        self.assert_same(killed, case, 1e-9)
        split.decompose_into(2, 1, 1)
        self.assert_runs(split, "decomposePar")
        self.assert_runs(split, "slurryFoam", ranks=2)
        # The pressure's solver stops at 1e-12
        self.assert_same(split, case, 1e-6)

    def test_a_flow_without_balls_has_no_forces(self):
        case = self.pool()
        self.assert_runs(case, "slurryFoam")
        with h5py.File(case.path / "slurry.h5") as file:
            self.assertEqual(file.attrs["version"], 2)
            self.assertNotIn("balls", file)
            self.assertNotIn("balls", file["mean"])
        with self.assertRaisesRegex(RuntimeError, "a flow without balls"):
            read_ball_forces(case.path / "slurry.h5")

    def test_segments_of_another_flow_are_refused(self):
        case = self.moving()
        self.assert_runs(case, "slurryFoam")
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text().replace("startFrom startTime", "startFrom latestTime"))
        without = self.copy_of(case)
        (without.path / "constant" / "bedProperties").unlink()
        self.assert_refused(without, "with balls, expected one without them", program="slurryFoam")
        for path in (case.path / "postProcessing" / "voxelAverages" / "segments").iterdir():
            with h5py.File(path, "r+") as file:
                file.attrs["version"] = np.int32(1)
        self.assert_refused(case, "'version' is 1, expected 2", "run the flow from its start", program="slurryFoam")


if __name__ == "__main__":
    require_environment()
    unittest.main()
