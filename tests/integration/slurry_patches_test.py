#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""slurryFoam where the box is not closed and rigid: a piston under a pool (deforming mesh), feed and overflow, grates
of porous cells, a flow that gets out of hand, and turbulence. Columns of cells along y; expected is what one can write
down."""
import shutil
import unittest

import numpy as np

from openfoam_case import require_environment, rotating_mesh
from slurry_case import AIR, SLURRY, SlurryTest

WIDTH, HEIGHT, ROWS = 0.02, 0.1, 20
AREA = WIDTH * WIDTH
SLIP = "type slip;"
NEWTONIAN = "yieldStress 0; plasticViscosity 1.4e-3; regularisation biviscosity; viscosityRatio 1000;"


class ColumnTest(SlurryTest):
    def column(self, *, level, across=2, **options):
        case = self.slurry_case(upper=(WIDTH, HEIGHT, WIDTH), cells=(across, ROWS, across),
                                level=lambda x: level + 0 * x, **options)
        for side in ("left", "right", "back", "front"):
            case.at_patch(side, U=SLIP)
        return case


class Outlet(ColumnTest):
    """A column at rest with a bed at its floor, under an outlet with a pressure: the fluid's balance of momentum needs
    the pressure there."""

    half, end, depth, solidity = 0.01, 0.02, 0.05, 0.5

    def at_rest(self, level, pressure):
        case = self.column(level=level, across=1, end_time=self.end, delta_t=0.001)
        case.control(self.end, 0.001, write_interval=10)
        case.open_top()
        top = case.path / "0" / "p_rgh"
        top.write_text(top.read_text().replace("p uniform 0;", f"p uniform {pressure};"))
        case.bed(f"block {{ box (-1 0 -1) (1 {self.depth} 1); solidity {self.solidity}; velocity (0 0 0); "
                 "diameter 0.005; }", drag="law Ergun;")
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text()
                           + 'functions { balance { type slurryBalance; libs ("libmillFoam.so"); speed 0; } }')
        return case

    def assert_carries_the_balls(self, case, start="0"):
        self.assert_runs(case, "slurryFoam")
        lines = (case.path / "postProcessing" / "balance" / start / "slurryBalance.dat").read_text().splitlines()
        names = [line for line in lines if line.startswith("#")][-1][1:].split()
        found = dict(zip(names, np.array(lines[-1].split(), float)))
        buoyancy = SLURRY * 9.81 * self.solidity * self.depth * AREA
        for force in ("balls", "balance"):
            self.assertAlmostEqual(found[f"force_{force}_y_N"] / buoyancy, 1, delta=1e-4, msg=force)

    def test_a_pressure_that_is_not_0(self):
        self.assert_carries_the_balls(self.at_rest(0.085, 1e5))

    def test_a_flow_that_resumes(self):
        # Also of a column that is full up to the outlet
        for level in (0.085, HEIGHT):
            with self.subTest(level=level):
                case = self.at_rest(level, 0)
                self.assert_carries_the_balls(case)
                shutil.rmtree(case.folder(self.end))
                control = case.path / "system" / "controlDict"
                control.write_text(control.read_text().replace("startTime 0;", f"startTime {self.half};"))
                self.assert_carries_the_balls(case, f"{self.half}")


class Piston(ColumnTest):
    """The bottom of an open column moves by A sin(omega t) and with it the mesh up to the top, which stays."""

    amplitude, omega, level, end, step = 0.004, 15, 0.052, 0.08, 0.002

    def moved(self, time):
        return self.amplitude * np.sin(self.omega * time)

    def piston(self):
        case = self.column(level=self.level, end_time=self.end, delta_t=self.step, motion="""
            dynamicFvMesh dynamicMotionSolverFvMesh;
            motionSolverLibs ("libfvMotionSolvers.so");
            motionSolver displacementLaplacian;
            diffusivity uniform;""")
        case.control(self.end, self.step, write_interval=20)
        case.open_top()
        # The sides' points follow, without a force on them
        case.field_file("pointDisplacement", "pointVectorField", "0 1 0 0 0 0 0", "(0 0 0)", f"""
            bottom {{ type oscillatingDisplacement; amplitude (0 {self.amplitude} 0); omega {self.omega};
                value uniform (0 0 0); }}
            top {{ type fixedValue; value uniform (0 0 0); }}
            "left|right|back|front" {{ type slip; }}""")
        return case

    def assert_carried(self, case, tolerance, solidity=0, level_tolerance=1e-5):
        """In the last step, the slurry's superficial velocity is the piston's. Its surface is flat and as high above
        the piston as before, because the balls' volume stays in it: the four columns' mean height to 1e-5 of a cell,
        that of each column to `level_tolerance`."""
        slurry = case.steps()["slurry_m3"]
        np.testing.assert_allclose(slurry, slurry[0], rtol=1e-8)

        mesh_centres = case.centres(self.end)
        alpha = case.field("alpha.slurry", self.end)
        speed = (self.moved(self.end) - self.moved(self.end - self.step)) / self.step
        wet = alpha > 1 - 1e-6
        self.assertGreater(wet.sum(), 4 * ROWS / 3)
        superficial = case.field("U", self.end)[:, 1] * (1 - solidity)
        np.testing.assert_allclose(superficial[wet], speed, rtol=tolerance)
        edge = (HEIGHT - self.moved(self.end)) / ROWS
        bottom = mesh_centres[:, 1] - edge / 2
        expected = np.clip((self.level + self.moved(self.end) - bottom) / edge, 0, 1)
        np.testing.assert_allclose(alpha, expected, atol=level_tolerance)
        self.assertAlmostEqual((alpha - expected).sum() / 4, 0, delta=1e-5)

    def test_carries_a_pool(self):
        case = self.piston()
        self.assert_runs(case, "slurryFoam")
        self.assert_carried(case, 3e-3)

    def test_pushes_a_pool_through_a_bed_at_rest(self):
        case = self.piston()
        case.bed(f"block {{ box (-1 0.021 -1) (1 0.036 1); cells overlap; solidity 0.4; velocity (0 0 0);"
                 f" diameter 0.005; volume {0.4 * 0.015 * AREA}; }}", drag="law Beetstra;")
        self.assert_runs(case, "slurryFoam")
        # Cells that the bed's sharp ends pass change their voidage: their velocity lags behind their fluxes. What the
        # faces sweep is found there to a hundredth only, column by column (found: 2.4e-5).
        self.assert_carried(case, 0.08, case.field("solidity", self.end), level_tolerance=1e-4)


class Feed(ColumnTest):
    """Slurry comes in below; above there is air, and an open top."""

    speed, level, step, end = 0.05, 0.082, 0.01, 0.5

    def test_fills_the_column_and_overflows(self):
        # One cell across: side by side, columns do not leave through the top evenly
        case = self.column(level=self.level, across=1, delta_t=self.step, end_time=self.end)
        case.open_top()
        case.at_patch("bottom", U=f"type fixedValue; value uniform (0 {self.speed} 0);",
                      alpha="type fixedValue; value uniform 1;")
        self.assert_runs(case, "slurryFoam")
        columns = case.steps()
        found = columns["slurry_m3"]
        self.assertLess(max(-columns["alpha_min"].min(), columns["alpha_max_minus_1"].max()), 1e-6)
        steps = np.arange(1, len(found) + 1)
        expected = AREA * (self.level + self.speed * self.step * steps)
        row = HEIGHT / ROWS
        inside = expected <= AREA * (HEIGHT - row) * (1 + 1e-9)
        below = expected <= AREA * (HEIGHT - 2 * row) * (1 + 1e-9)
        self.assertGreater(below.sum(), 10)
        np.testing.assert_allclose(found[below], expected[below], rtol=1e-8)
        # Once the surface is in the row below, traces of slurry are ahead of it in the last: half a hundredth of a row
        trace = 0.01 * AREA * row
        np.testing.assert_allclose(found[inside], expected[inside], atol=trace)
        # The top passes on what the last row holds in the mean: explicit steps of d(alpha)/dt = (1 - alpha) speed/row
        later = steps[~inside] - inside.sum()
        lacking = (1 - self.speed * self.step / row) ** later
        np.testing.assert_allclose(found[~inside], AREA * (HEIGHT - row * lacking), atol=trace)
        np.testing.assert_allclose(case.field("U", self.end)[:, 1], self.speed, rtol=1e-6)


class Reversal(ColumnTest):
    """A full column rises a little and sinks again: at its open top air comes in from the first step on that sinks."""

    speed, step, up, down = 0.05, 0.002, 3, 4

    def test_lets_air_in_at_once(self):
        case = self.column(level=2 * HEIGHT, across=1, delta_t=self.step, end_time=self.step * (self.up + self.down))
        case.open_top()
        turn = self.step * (self.up + 0.5)
        case.at_patch("bottom", U="type uniformFixedValue; uniformValue table "
                                  f"((0 (0 {self.speed} 0)) ({turn - 1e-6} (0 {self.speed} 0))"
                                  f" ({turn} (0 -{self.speed} 0)) (1 (0 -{self.speed} 0)));",
                      alpha="type inletOutlet; inletValue uniform 1; value uniform 1;")
        self.assert_runs(case, "slurryFoam")
        found = case.steps()["slurry_m3"]
        below = np.clip(np.arange(1, len(found) + 1) - self.up, 0, None)
        np.testing.assert_allclose(found, AREA * (HEIGHT - self.speed * self.step * below), rtol=1e-9)


class Grate(ColumnTest):
    """Cells of a grate resist by Darcy and Forchheimer, faces of a plate by its loss; the slurry is pushed through."""

    speed, darcy, forchheimer, loss = 0.1, 2e7, 400.0, 1800.0

    def pushed(self, way=1, slurry=1):
        case = self.column(level=slurry * HEIGHT, delta_t=0.01, end_time=0.1, bingham=NEWTONIAN)
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        given, opened = ("bottom", "top") if way > 0 else ("top", "bottom")
        case.at_patch(given, U=f"type fixedValue; value uniform (0 {way * self.speed} 0);",
                      alpha=f"type fixedValue; value uniform {slurry};")
        case.at_patch(opened, U="type pressureInletOutletVelocity; value uniform (0 0 0);",
                      p_rgh="type prghPressure; p uniform 0; value uniform 0;",
                      alpha="type inletOutlet; inletValue uniform 0; value uniform 0;")
        return case

    def with_plate(self, source, grates="discharge { faces plate; loss LOSS; }", way=1, slurry=1):
        """The pressure of the rows from the bottom to the top, with a plate of the faces that topoSet finds; slurry:
        its share of the fluid."""
        case = self.pushed(way, slurry)
        case.write("system/topoSetDict", f"""
            actions ( {{ name found; type faceSet; action new; {source} }}
                      {{ name plate; type faceZoneSet; action new; source setToFaceZone; faceSet found; }} );""")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties", grates.replace("LOSS", str(self.loss)))
        self.assert_runs(case, "slurryFoam")
        return case.field("p_rgh", 0.1).reshape(2, ROWS, 2).mean(axis=(0, 2))

    @property
    def plate_drop(self):
        return self.loss * 1239 * self.speed**2 / 2

    def test_costs_its_pressure(self):
        case = self.pushed()
        case.write("system/topoSetDict", """
            actions ( { name grate; type cellZoneSet; action new; source boxToCell;
                        box (-1 0.04 -1) (1 0.06 1); } );""")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties",
                   f"discharge {{ cellZone grate; darcy {self.darcy}; forchheimer {self.forchheimer}; }}")
        self.assert_runs(case, "slurryFoam")
        rows = case.field("p_rgh", 0.1).reshape(2, ROWS, 2).mean(axis=(0, 2))
        thickness = 0.02
        expected = (1.4e-3 * self.darcy + 1239 * self.speed * self.forchheimer / 2) * self.speed * thickness
        # 6e-5 are left of the start
        self.assertAlmostEqual(rows[0] - rows[-1], expected, delta=1e-4 * expected)

    middle = f"source boxToFace; box (-1 {HEIGHT / 2 - 1e-6} -1) (1 {HEIGHT / 2 + 1e-6} 1);"

    def test_as_a_plate_costs_its_pressure_at_its_faces(self):
        for way in (1, -1):
            steps = -way * np.diff(self.with_plate(self.middle, way=way))
            self.assertAlmostEqual(steps[ROWS // 2 - 1], self.plate_drop, delta=1e-4 * self.plate_drop)
            self.assertLess(np.abs(np.delete(steps, ROWS // 2 - 1)).max(), 1e-4 * self.plate_drop)

    def test_as_a_plate_costs_air_what_its_density_gives(self):
        steps = -np.diff(self.with_plate(self.middle, slurry=0))
        drop = self.loss * AIR * self.speed**2 / 2
        self.assertAlmostEqual(steps[ROWS // 2 - 1], drop, delta=1e-4 * drop)
        self.assertLess(np.abs(np.delete(steps, ROWS // 2 - 1)).max(), 1e-4 * drop)

    def test_as_two_plates_at_the_same_faces_costs_both(self):
        rows = self.with_plate(self.middle, "one { faces plate; loss LOSS; } other { faces plate; loss LOSS; }")
        self.assertAlmostEqual(rows[0] - rows[-1], 2 * self.plate_drop, delta=1e-4 * self.plate_drop)

    def test_as_a_plate_at_an_opening_costs_its_pressure_there(self):
        rows = self.with_plate(self.middle, "outlet { faces top; loss LOSS; }")
        np.testing.assert_allclose(rows, self.plate_drop, rtol=1e-4)

    def test_as_a_plate_where_the_velocity_is_given_changes_nothing(self):
        rows = self.with_plate(self.middle, "inlet { faces bottom; loss LOSS; }")
        self.assertLess(np.abs(rows).max(), 1e-4 * self.plate_drop)

    def test_as_a_plate_resists_no_flow_along_it(self):
        rows = self.with_plate("source normalToFace; normal (1 0 0); cos 0.1;")
        self.assertLess(np.abs(rows - rows[-1]).max(), 1e-4 * self.plate_drop)

    def test_turns_with_the_mesh(self):
        # Everywhere, and so dense that the slurry is carried within a step
        omega, end = 3, 0.02
        case = self.slurry_case(end_time=end, level=lambda x: 1 + 0 * x, motion=rotating_mesh(omega), bingham=NEWTONIAN)
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        case.write("system/topoSetDict", """
            actions ( { name grate; type cellZoneSet; action new; source boxToCell; box (-9 -9 -9) (9 9 9); } );""")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties", "everywhere { cellZone grate; darcy 1e10; }")
        self.assert_runs(case, "slurryFoam")
        x, y, _ = case.centres(end).T
        carried = omega * np.stack([-y, x, 0 * x], axis=1)
        np.testing.assert_allclose(case.field("U", end), carried, atol=0.01 * np.abs(carried).max())


class Divergence(ColumnTest):
    def test_is_reported_and_ends_the_run(self):
        case = self.column(level=HEIGHT, end_time=0.2)
        case.open_top()
        case.adjusted(0.2, 0.2)
        case.at_patch("bottom", U="type uniformFixedValue; uniformValue table ((0 (0 0.05 0)) (0.1 (0 0.05 0))"
                                  " (0.1001 (0 1e7 0)) (1 (0 1e7 0))); value uniform (0 0.05 0);",
                      alpha="type fixedValue; value uniform 1;")
        result = case.run("slurryFoam")
        self.assertNotEqual(result.code, 0, result.tail())
        for words in ("because of the flow", "has diverged at 0.1", "earlier written time"):
            self.assertIn(words, " ".join(result.log.split()))


class Turbulence(ColumnTest):
    def test_decays_as_the_model_says(self):
        # Without flow: k = k0 (1 + (C2 - 1) e0 t/k0)^(-1/(C2 - 1)); first order in time
        k0, e0, c2, end, step = 0.01, 0.05, 1.92, 0.1, 0.001
        case = self.column(level=HEIGHT, delta_t=step, end_time=end)
        case.control(end, step, write_interval=100)
        case.write("constant/turbulenceProperties", "simulationType RAS; RAS { RASModel kEpsilon; turbulence on; }")
        schemes = case.path / "system/fvSchemes"
        schemes.write_text(schemes.read_text().replace(
            "default none;", "default none; div(phi,k) Gauss upwind; div(phi,epsilon) Gauss upwind;"))
        everywhere = '".*" { type zeroGradient; }'
        case.field_file("k", "volScalarField", "0 2 -2 0 0 0 0", k0, everywhere)
        case.field_file("epsilon", "volScalarField", "0 2 -3 0 0 0 0", e0, everywhere)
        case.field_file("nut", "volScalarField", "0 2 -1 0 0 0 0", 0, '".*" { type calculated; value uniform 0; }')
        self.assert_runs(case, "slurryFoam")
        expected = k0 * (1 + (c2 - 1) * e0 * end / k0) ** (-1 / (c2 - 1))
        np.testing.assert_allclose(case.field("k", end), expected, rtol=5e-3)
        np.testing.assert_allclose(case.field("nut", end),
                                   0.09 * case.field("k", end) ** 2 / case.field("epsilon", end), rtol=1e-10)


if __name__ == "__main__":
    require_environment()
    unittest.main()
