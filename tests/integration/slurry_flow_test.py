#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""slurryFoam gives the same after a restart and on two ranks, and loses nothing: in a closed box with a
moving bed, on meshes that stand still and turn."""
import re
import shutil
import unittest
from pathlib import Path

import numpy as np

import solids
from millfoam.files import foam
from openfoam_case import require_environment, rotating_mesh
from slurry_case import AIR, SLURRY, SlurryTest

MILL = Path(__file__).resolve().parents[2] / "scripts" / "mill_case"
# Soft edges and a way that goes through the surface; it stays inside the box.
BALLS = ("block { box (0.02 0.01 -1) (0.06 0.05 1); edge 0.01; edgeAxes (1 1 0); solidity 0.5; diameter 0.005;"
         " velocity (0.3 0.3 0); moves yes; }")
# Reaches into the walls wherever the box has turned to; as soft as the cells that pass through its edge.
PILE = ("block { box (-1 -1 -1) (1 0.05 1); edge 0.03; edgeAxes (0 1 0); solidity 0.5; diameter 0.005; "
        "velocity (0.1 0 0); }")
# Rests in space, and no wall of the box comes near it in an eighth of a radian. Its volume is known.
HEAP_VOLUME = 0.5 * (0.07 - 0.02) * (0.06 - 0.02) * 0.02
HEAP = ("block { box (0.035 0.02 -1) (0.105 0.08 1); edge 0.02; edgeAxes (1 1 0); solidity 0.5; diameter 0.005; "
        f"velocity (0 0 0); volume {HEAP_VOLUME!r}; }}")


class Restart(SlurryTest):
    """A run of 20 ms against one that is taken up at 10 ms: the same to the last bit."""

    first, last = 0.01, 0.02

    def restarted(self, case):
        """The case run through, and a copy that was taken up between."""
        self.assert_runs(case, "slurryFoam")
        other = self.copy_of(case)
        shutil.rmtree(other.folder(self.last))
        control = other.path / "system/controlDict"
        control.write_text(control.read_text().replace("startTime 0;", f"startTime {self.first};"))
        self.assert_runs(other, "slurryFoam")
        self.assertGreater(np.abs(case.field("U", self.last) - case.field("U", self.first)).max(), 0.01)
        return other

    def assert_restarts(self, case):
        other = self.restarted(case)
        names = case.written(self.last)
        for name in ("U", "alpha.slurry", "p_rgh", "phi"):
            self.assertIn(name, names)
        for name in names:
            np.testing.assert_array_equal(other.field(name, self.last), case.field(name, self.last), name)

    def test_with_fixed_time_steps(self):
        case = self.slurry_case(end_time=self.last)
        case.bed(BALLS)
        self.assert_restarts(case)

    def test_with_time_steps_that_the_courant_number_bounds(self):
        case = self.slurry_case()
        case.bed(BALLS)
        case.adjusted(self.last, self.first, courant=0.03, voidage_change=1)
        self.assert_restarts(case)

    def test_with_time_steps_that_the_change_of_voidage_bounds(self):
        case = self.slurry_case()
        case.bed(BALLS)
        case.adjusted(self.last, self.first, voidage_change=0.02)
        self.assert_restarts(case)

    def test_on_a_turning_mesh(self):
        case = self.slurry_case(end_time=self.last, motion=rotating_mesh(3))
        self.assert_restarts(case)

    def test_on_a_mesh_that_turns_through_a_bed(self):
        case = self.slurry_case(end_time=self.last, motion=rotating_mesh(3))
        case.bed(PILE)
        self.assert_restarts(case)

    def test_on_an_upright_mesh_that_begins_to_turn(self):
        # Its speed is 0 at first; what it is then does not say that it rests
        case = self.slurry_case(end_time=self.last, motion=rotating_mesh("table ((0 0) (1 300))"))
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);")
        self.assert_restarts(case)
        self.assertIn("stepAcceleration", case.written(self.last))

    def test_on_a_turning_mesh_with_the_plate_of_a_grate(self):
        case = self.slurry_case(end_time=self.last, motion=rotating_mesh(3))
        case.write("system/topoSetDict", """
            actions ( { name found; type faceSet; action new; source boxToFace; box (0.069 -1 -1) (0.071 1 1); }
                      { name plate; type faceZoneSet; action new; source setToFaceZone; faceSet found; } );""")
        self.assert_runs(case, "topoSet")
        self.assert_runs(case, "slurryFoam")
        open_flow = case.field("U", self.last)
        case.write("constant/grateProperties", "middle { faces plate; loss 1000; }")
        self.assert_restarts(case)
        self.assertGreater(np.abs(case.field("U", self.last) - open_flow).max(), 0.01)


class ShippedRestart(Restart):
    """The same with the files that the mills of cases/ write: binary."""

    def assert_restarts(self, case):
        shipped = foam.read_dictionary(MILL / "system" / "controlDict")
        control = case.path / "system" / "controlDict"
        text = control.read_text()
        for key in ("writeFormat", "writePrecision", "timePrecision"):
            text = re.sub(rf"{key} [^;]*;", f"{key} {shipped[key]};", text)
        control.write_text(text)
        self.assertEqual(shipped["writeFormat"], "binary")
        other = self.restarted(case)
        for name in ("U", "alpha.slurry"):
            found, expected = other.field(name, self.last), case.field(name, self.last)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max(), err_msg=name)


class Ranks(SlurryTest):
    def run_case(self, ranks, bed=BALLS, **options):
        case = self.slurry_case(end_time=0.02, **options)
        case.bed(bed)
        solution = case.path / "system/fvSolution"
        solution.write_text(solution.read_text().replace('"p_rgh.*"', '"(p_rgh|sweptPotential).*"'))
        case.decompose_into(2, 1, 1)
        self.assert_flows(case, ranks)
        names = ("U", "p_rgh", "alpha.slurry", "phi", "solidity", "solidsVelocity")
        return {name: case.field(name, 0.02) for name in names}

    def test_two_change_nothing_but_the_solvers_round_off(self):
        one, two = self.run_case(1), self.run_case(2)
        for name in ("solidity", "solidsVelocity"):
            np.testing.assert_array_equal(two[name], one[name], name)
        self.assertGreater(np.linalg.norm(one["U"], axis=1).max(), 0.01)
        for name in ("U", "p_rgh", "alpha.slurry", "phi"):
            scale = np.abs(one[name]).max()
            np.testing.assert_allclose(two[name], one[name], rtol=0, atol=1e-7 * scale, err_msg=name)

    def test_nor_do_they_on_a_mesh_that_turns_through_a_bed(self):
        one, two = (self.run_case(ranks, PILE, motion=rotating_mesh(3)) for ranks in (1, 2))
        for name in ("U", "p_rgh", "alpha.slurry", "phi"):
            scale = np.abs(one[name]).max()
            np.testing.assert_allclose(two[name], one[name], rtol=0, atol=1e-6 * scale, err_msg=name)


class DividedCyclic(SlurryTest):
    """Cyclic patches whose two sides are on different ranks: decomposePar writes there the values of each rank's own
    cells. Slurry that is deeper on one side runs through a bed, without gravity."""
    end = 0.01

    def setUp(self):
        super().setUp()
        self.whole = self.slurry_case(periodic=True, level=lambda x: 0.05 + 0.2 * (x - 0.07))
        self.whole.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        self.whole.bed("block { box (-9 -9 -9) (9 9 9); solidity 0.5; diameter 0.002; velocity (0.1 0 0); }")
        self.whole.decompose_into(2, 1, 1)
        self.whole.control(self.end, 0.001, write_interval=5)
        self.begun = self.copy_of(self.whole)
        self.assert_runs(self.whole, "slurryFoam")

    def assert_same(self, split, start="0"):
        self.assert_runs(split, "slurryFoam", ranks=2)
        self.assert_runs(split, "reconstructPar", "-latestTime")
        self.assertLess(split.steps(start)["alpha_max_minus_1"].max(), 1e-12)
        np.testing.assert_allclose(split.steps(start)["slurry_m3"], self.whole.steps()["slurry_m3"][0], rtol=1e-13)
        for name in ("U", "alpha.slurry"):
            expected = self.whole.field(name, self.end)
            np.testing.assert_allclose(split.field(name, self.end), expected, atol=1e-5 * np.abs(expected).max())

    def test_begin_as_on_one_rank(self):
        self.assert_runs(self.begun, "decomposePar")
        self.assert_same(self.begun)

    def test_resume_what_one_rank_has_computed(self):
        split = self.copy_of(self.whole)
        shutil.rmtree(split.folder(self.end))
        split.control(self.end, 0.001, write_interval=5, start_time=0.005)
        self.assert_runs(split, "decomposePar", "-latestTime")
        self.assert_same(split, "0.005")


class SurfaceTension(SlurryTest):
    """A pool at rest: of the bounds of the time-step only that of the surface tension counts."""

    def longest_step(self, thickness):
        case = self.slurry_case(upper=(0.014, 0.01, thickness), cells=(14, 10, 1), level=lambda x: 0.0045 + 0 * x)
        properties = case.path / "constant/transportProperties"
        properties.write_text(properties.read_text().replace("sigma 0;", "sigma 0.07;"))
        case.adjusted(0.02, 0.02, delta_t=2e-4)
        self.assert_runs(case, "slurryFoam")
        return case.steps()["deltaT_s"].max()

    def test_bounds_the_step_by_volume_and_shortest_side_of_the_cells(self):
        # The step of Brackbill, Kothe & Zemach (1992) with cells of 1 mm; half of it for cubes
        stable = np.sqrt((SLURRY + AIR) * 1e-9 / (4 * np.pi * 0.07))
        for thickness, share in ((0.001, 0.5), (0.002, 0.5 * np.sqrt(2)), (0.05, 1)):
            self.assertAlmostEqual(self.longest_step(thickness) / stable, share, delta=0.03)


class VoidageRate(SlurryTest):
    """A bed without drag that moves through slurry displaces it, or, with `voidageRate no`, does not."""

    def largest_speed(self, entries, motion):
        case = self.slurry_case(end_time=0.02, level=lambda x: 1 + 0 * x, motion=motion)
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        for side in ("left", "right", "bottom", "top", "front", "back"):
            case.at_patch(side, U="type slip;")
        case.bed(BALLS, drag="law Beetstra; multiplier 0;", entries=entries)
        self.assert_runs(case, "slurryFoam")
        return np.abs(case.field("U", 0.02)).max()

    def test_is_what_moves_slurry_without_drag(self):
        self.assertGreater(self.largest_speed("", "dynamicFvMesh staticFvMesh;"), 0.05)
        self.assertLess(self.largest_speed("voidageRate no;", "dynamicFvMesh staticFvMesh;"), 1e-12)

    def test_is_that_in_space_where_the_mesh_turns(self):
        # The box's corners stir too where it turns: less than balls at 0.4 m/s do
        moving = self.largest_speed("", rotating_mesh(0.3))
        self.assertLess(self.largest_speed("voidageRate no;", rotating_mesh(0.3)), 0.1 * moving)


class RecordedBed(SlurryTest):
    """A bed without drag that grows and shrinks from window to window of a solids.h5, in a pool under an open top."""

    def pressures(self, steps_per_ms):
        """p at the bottom at each millisecond of 70 (Pa), with steps of a part of it."""
        case = self.slurry_case(upper=(0.01, 0.1, 0.01), cells=(1, 40, 1), level=lambda x: 0.06 + 0 * x,
                                bingham="yieldStress 0; plasticViscosity 1e-6; regularisation biviscosity; "
                                        "viscosityRatio 1000;")
        case.open_top()
        for side in ("left", "right", "bottom", "front", "back"):
            case.at_patch(side, U="type slip;")
        bed = np.array([0, 0, 0.1, 0.3, 0.3, 0.2, 0.2])
        solids.write(case.path / "solids.h5", (0, 0, 0), (0.01, 0.1, 0.01),
                     np.stack([bed, 0 * bed], axis=1)[:, None, :, None], window=0.01)
        case.bed('solids "solids.h5"; interpolation cell;', drag="law Beetstra; multiplier 0;")
        case.control(0.07, 1e-3 / steps_per_ms, steps_per_ms)
        self.assert_runs(case, "slurryFoam")
        return np.array([case.field("p", time)[0] for time in np.arange(1, 71) * 1e-3])

    def test_the_pressure_does_not_depend_on_the_time_step(self):
        coarse, fine = self.pressures(1), self.pressures(8)
        # 200 1/s2 of solidity times 50 mm push 2 to 4 cm of slurry; a jump of the rate would push 8 times as strongly
        # in steps of an eighth
        self.assertGreater(np.abs(fine).max(), 5000)
        self.assertLess(np.abs(fine).max(), 15000)
        np.testing.assert_allclose(np.abs(coarse).max(), np.abs(fine).max(), rtol=0.1)


class Volumes(SlurryTest):
    """Slurry and air of a closed box."""

    def test_are_kept_while_a_bed_goes_through_the_surface(self):
        case = self.slurry_case()
        case.bed(BALLS)
        case.adjusted(0.1, 0.1)
        self.assert_runs(case, "slurryFoam")
        self.assert_kept(case)
        self.assertGreater(len(case.steps()), 10)

        # Again from what was written: 14 x 10 x 2 equal cells
        cell = case.upper.prod() / case.cells
        voidage = 1 - case.field("solidity", 0.1)
        slurry = voidage @ case.field("alpha.slurry", 0.1) * cell
        start = 1 - case.below(lambda x: 0 * x)
        self.assertLess(abs(voidage.sum() * cell - (start.sum() * cell - 0.5 * 0.03 * 0.03 * 0.02)), 1e-8 * slurry)
        self.assertAlmostEqual(slurry, case.steps()["slurry_m3"][0], delta=1e-8 * slurry)

    def test_are_kept_where_a_step_passes_more_than_a_cell(self):
        # A column of slurry that collapses
        for motion in ({}, {"motion": rotating_mesh(3)}):
            case = self.slurry_case(end_time=0.36, delta_t=0.012, level=lambda x: np.where(x < 0.05, 0.08, 0.005),
                                    **motion)
            self.assert_runs(case, "slurryFoam")
            self.assertGreater(case.steps()["courant"].max(), 1.4)
            self.assert_kept(case, alpha=1e-8)

    def test_are_kept_in_a_turning_box(self):
        case = self.slurry_case(end_time=0.1, motion=rotating_mesh(3))
        self.assert_runs(case, "slurryFoam")
        self.assert_kept(case)

    def test_are_kept_in_a_box_that_turns_through_a_bed(self):
        for omega in (3, -3):
            with self.subTest(omega=omega):
                case = self.slurry_case(end_time=0.04, motion=rotating_mesh(omega))
                case.bed(HEAP)
                self.assert_runs(case, "slurryFoam")
                self.assert_kept(case)
                found = case.steps()
                # The same balls, wherever the cells are
                np.testing.assert_allclose(found["fluid_m3"], case.upper.prod() - HEAP_VOLUME, rtol=1e-10)
                # Again from what was written
                volume = foam.read_mesh(case.path, case.folder(0.04)).centres_and_volumes()[1]
                fluid = (1 - case.field("solidity", 0.04)) * volume
                self.assertAlmostEqual(fluid.sum(), case.upper.prod() - HEAP_VOLUME, delta=1e-10 * volume.sum())
                self.assertAlmostEqual(fluid @ case.field("alpha.slurry", 0.04), found["slurry_m3"][0],
                                       delta=1e-8 * found["slurry_m3"][0])
                self.assertLess(np.abs(found["without_room_m3"]).max(), 1e-12 * found["fluid_m3"][0])

    def test_and_what_walls_push_into_a_bed_is_counted(self):
        # The pile reaches through the walls, which take more of it into the box or out of it
        for omega in (3, -3):
            with self.subTest(omega=omega):
                case = self.slurry_case(end_time=0.04, motion=rotating_mesh(omega))
                case.bed(PILE)
                self.assert_runs(case, "slurryFoam")
                found = case.steps()
                np.testing.assert_allclose(found["slurry_m3"], found["slurry_m3"][0], rtol=1e-12)
                self.assertGreaterEqual(found["alpha_min"].min(), -1e-12)
                volume = foam.read_mesh(case.path, case.folder(0.04)).centres_and_volumes()[1]
                balls = case.field("solidity", 0.04) @ volume
                self.assertAlmostEqual(found["fluid_m3"][-1], case.upper.prod() - balls, delta=1e-10 * volume.sum())
                grown = np.diff(found["fluid_m3"])
                self.assertGreater(np.abs(grown.sum()), 0.02 * found["fluid_m3"][0])
                # There is room that no fluid fills, not fluid without room
                np.testing.assert_allclose(np.diff(found["without_room_m3"]), -grown, rtol=1e-6)


if __name__ == "__main__":
    require_environment()
    unittest.main()
