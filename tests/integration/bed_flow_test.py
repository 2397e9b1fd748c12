#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""slurryFoam compared with closed forms in small boxes: friction at the walls of a bed, given inflow, drops,
menisci, suction of pores, the pressure of a closed box."""
import re
import unittest

import numpy as np

from openfoam_case import require_environment
from slurry_case import SLURRY, SOLUTION, SlurryTest

SLIP = "type slip;"


def with_tension_alone(case, sigma):
    """Gives a case this surface tension (N/m), no gravity, and sides without friction."""
    properties = case.path / "constant/transportProperties"
    properties.write_text(properties.read_text().replace("sigma 0;", f"sigma {sigma};"))
    case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
    for side in ("front", "back"):
        case.at_patch(side, U=SLIP)


class Channel(SlurryTest):
    """A flat channel full of slurry between plates, along x; a uniform bed fills it."""

    length, half_gap, viscosity = 0.02, 0.005, 10.0  # m, m, Pa s
    solidity, diameter = 0.5, 0.04

    @property
    def beta(self):
        """Darcy's 150 mu phi^2/(e d^2), kg/(m3 s)."""
        return 150 * self.viscosity * self.solidity**2 / ((1 - self.solidity) * self.diameter**2)

    def channel(self, rows, end_time, motion="dynamicFvMesh staticFvMesh;"):
        case = self.slurry_case(
            upper=(self.length, 2 * self.half_gap, 0.005), cells=(2, rows, 1), level=lambda x: 1 + 0 * x, motion=motion,
            bingham=f"yieldStress 0; plasticViscosity {self.viscosity}; regularisation biviscosity; viscosityRatio 1;")
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        for side in ("front", "back"):
            case.at_patch(side, U=SLIP)
        case.bed(f"block {{ box (-9 -9 -9) (9 9 9); solidity {self.solidity}; diameter {self.diameter};"
                 " velocity (0 0 0); }", drag="law Darcy;")
        case.control(end_time, end_time / 100, 100)
        return case

    def test_the_friction_of_the_bed_and_of_the_walls_is_brinkmans(self):
        """e mu u'' - beta u + e G = 0: u = e G/beta (1 - cosh(y/l)/cosh(h/l)) with l^2 = e mu/beta. Its mean over
        e G/beta is 0.405; with the stress of a fluid that fills all space, l^2 = mu/beta, it would be 0.266."""
        gradient = 1000.0  # Pa/m
        case = self.channel(40, 0.05)
        for side, pressure in (("left", gradient * self.length), ("right", 0)):
            case.at_patch(side, U="type zeroGradient;", alpha="type zeroGradient;",
                          p_rgh=f"type fixedValue; value uniform {pressure};")
        self.assert_runs(case, "slurryFoam")
        found = case.field("U", 0.05)[:, 0] * self.beta / ((1 - self.solidity) * gradient)
        layer = np.sqrt((1 - self.solidity) * self.viscosity / self.beta)
        y = case.centres()[:, 1] - self.half_gap
        expected = 1 - np.cosh(y / layer) / np.cosh(self.half_gap / layer)
        self.assertAlmostEqual(found.mean(), 0.405, delta=1e-3)
        np.testing.assert_allclose(found, expected, atol=2e-3)

    def test_a_given_velocity_comes_in_also_where_the_pressure_has_no_gradient(self):
        speed = 0.05
        case = self.channel(4, 0.01)
        case.at_patch("left", U=f"type fixedValue; value uniform ({speed} 0 0);", p_rgh="type zeroGradient;",
                      alpha="type fixedValue; value uniform 1;")
        case.at_patch("right", U="type zeroGradient;", p_rgh="type fixedValue; value uniform 0;",
                      alpha="type zeroGradient;")
        for side in ("bottom", "top"):
            case.at_patch(side, U=SLIP)
        self.assert_runs(case, "slurryFoam")
        np.testing.assert_allclose(case.field("U", 0.01)[:, 0], speed, rtol=1e-6)


class Drop(SlurryTest):
    """A drop without gravity keeps its shape, and its pressure is sigma times its curvature."""

    radius, per_radius, sigma = 0.01, 8, 0.07  # m, cells, N/m

    def share(self, cells, centre):
        """Share of each cell in the drop, of 8 points along each axis; in one layer of cells it is a cylinder."""
        points = [(np.arange(8 * n) + 0.5) / 8 * self.radius / self.per_radius - c for n, c in zip(cells, centre)]
        z, y, x = np.meshgrid(*points[::-1], indexing="ij")
        inside = x**2 + y**2 + (0 if cells[2] == 1 else z**2) < self.radius**2
        return inside.reshape(cells[2], 8, cells[1], 8, cells[0], 8).mean(axis=(1, 3, 5)).ravel()

    def jump(self, cells, end):
        """Pressure (Pa) in the drop less that outside, mean over the later half of 10 times; largest speed (m/s)."""
        edge = self.radius / self.per_radius
        case = self.slurry_case(
            upper=tuple(edge * np.array(cells)), cells=cells, level=lambda x: 0 * x,
            bingham="yieldStress 0; plasticViscosity 0.05; regularisation biviscosity; viscosityRatio 1;")
        with_tension_alone(case, self.sigma)
        centre = edge * (np.array(cells) / 2 + [0.3, 0.2, 0.1])
        alpha = case.path / "0/alpha.slurry"
        values = " ".join(map(repr, self.share(cells, centre).tolist()))
        alpha.write_text(re.sub(r"internalField [^;]*;", f"internalField nonuniform List<scalar> {np.prod(cells)} "
                                f"({values});", alpha.read_text()))
        # Neither the flow nor maxDeltaT bounds the steps: the surface tension does
        case.adjusted(end, end / 10, delta_t=1e-5, courant=0.5)
        self.assert_runs(case, "slurryFoam")
        jumps, speeds = [], []
        distance = np.linalg.norm((case.centres() - centre)[:, :2 if cells[2] == 1 else 3], axis=1)
        for time in end * np.arange(6, 11) / 10:
            p = case.field("p", time)
            jumps.append(p[distance < 0.6 * self.radius].mean() - p[distance > 1.4 * self.radius].mean())
            speeds.append(np.linalg.norm(case.field("U", time), axis=1).max())
        limit = 0.25 * np.sqrt((SLURRY + 1.2) * edge**3 / (np.pi * self.sigma))
        # Steps are stretched to end at written times
        self.assertAlmostEqual(case.steps()["deltaT_s"].max() / limit, 1, delta=0.1)
        return np.mean(jumps), max(speeds)

    def test_cylinder(self):
        jump, speed = self.jump((26, 26, 1), 0.1)
        self.assertAlmostEqual(jump, self.sigma / self.radius, delta=0.03 * self.sigma / self.radius)
        self.assertLess(speed, 0.03)

    def test_sphere(self):
        jump, speed = self.jump((22, 22, 22), 0.024)
        self.assertAlmostEqual(jump, 2 * self.sigma / self.radius, delta=0.05 * 2 * self.sigma / self.radius)
        self.assertLess(speed, 0.08)


class Meniscus(SlurryTest):
    """Slurry between two plates without gravity, whose surface starts as a plane: an arc of a circle that meets the
    plates at the contact angle."""

    gap, cells, sigma, end = 0.01, (16, 26, 1), 0.07, 0.3  # m, of the box, N/m, s

    def settled(self, plates, tilt=0.0):
        """Pressure (Pa) in the slurry less that in the air, and height (m) of the surface in each column of cells, mean
        over the later half of 60 times; plates: the share's condition there; tilt: slope at the start."""
        edge = self.gap / self.cells[0]
        case = self.slurry_case(
            upper=tuple(edge * np.array(self.cells)), cells=self.cells,
            level=lambda x: 13.3 * edge + tilt * (x - self.gap / 2),
            bingham="yieldStress 0; plasticViscosity 0.1; regularisation biviscosity; viscosityRatio 1;")
        with_tension_alone(case, self.sigma)
        for side in ("left", "right"):
            case.at_patch(side, alpha=plates)
        case.adjusted(self.end, self.end / 60, delta_t=1e-5, courant=0.5)
        self.assert_runs(case, "slurryFoam")
        self.assert_kept(case)
        jumps, heights = [], []
        height = case.centres()[:, 1]
        for time in self.end * np.arange(31, 61) / 60:
            p = case.field("p", time)
            jumps.append(p[height < 0.3 * self.gap].mean() - p[height > edge * self.cells[1] - 0.3 * self.gap].mean())
            heights.append(edge * case.field("alpha.slurry", time).reshape(self.cells[1], self.cells[0]).sum(axis=0))
        return np.mean(jumps), np.mean(heights, axis=0)

    def test_has_the_angles_arc_and_pressure(self):
        for angle in (45, 90, 135):
            with self.subTest(angle=angle):
                cosine = np.cos(np.radians(angle))
                jump, height = self.settled(f"type constantAlphaContactAngle; theta0 {angle}; limit gradient;",
                                            tilt=0.3)
                scale = 2 * self.sigma / self.gap
                x = (np.arange(self.cells[0]) + 0.5) / self.cells[0] - 0.5
                arc = 0 * x if angle == 90 else (
                    np.sign(cosine) * self.gap * (0.5 / abs(cosine) - np.sqrt((0.5 / cosine) ** 2 - x**2)))
                error = height - height.mean() - arc + arc.mean()
                self.assertAlmostEqual(jump / scale, -cosine, delta=0.12)
                self.assertLess(np.abs(error).max(), 0.08 * self.gap)

    def test_without_an_angle_keeps_its_tilt(self):
        jump, height = self.settled("type zeroGradient;", tilt=0.3)
        self.assertLess(abs(jump), 0.04 * 2 * self.sigma / self.gap)
        edge = self.gap / self.cells[0]
        # A piece at the wall whose neighbours are small keeps a part of alpha's gradient, which is along the wall:
        # of the tilt 0.297 is left, on 20 cells 0.275
        self.assertAlmostEqual(np.polyfit(edge * np.arange(self.cells[0]), height, 1)[0], 0.3, delta=0.03)


class PoreSuction(SlurryTest):
    """A bed whose lower end is at the level of a large pool: its pores pull the slurry up by p_c/(rho g), at the speed
    that Darcy's drag allows (Washburn 1921)."""

    solidity, diameter, sigma, angle, viscosity = 0.5, 0.002, 0.07, 30, 0.02  # m, N/m, degrees, Pa s
    cells, height, first = 40, 0.025, 0.002  # m, of the column and of the slurry in it at the start

    @property
    def rise(self):
        """Height at the end, m."""
        suction = 6 * self.solidity * self.sigma * np.cos(np.radians(self.angle)) / (
            (1 - self.solidity) * self.diameter)
        return suction / (SLURRY * 9.81)

    def column(self, end, option="poreSuction {{ contactAngle {angle}; }}", first=None):
        edge = self.height / self.cells
        case = self.slurry_case(
            upper=(edge, self.height, edge), cells=(1, self.cells, 1), level=lambda x: first or self.first + 0 * x,
            bingham=f"yieldStress 0; plasticViscosity {self.viscosity}; regularisation biviscosity; viscosityRatio 1;")
        properties = case.path / "constant/transportProperties"
        properties.write_text(properties.read_text().replace("sigma 0;", f"sigma {self.sigma};"))
        for side in ("front", "back", "left", "right"):
            case.at_patch(side, U=SLIP)
        case.open_top()
        case.at_patch("bottom", U="type pressureInletOutletVelocity; value uniform (0 0 0);",
                      p_rgh="type prghPressure; p uniform 0; value uniform 0;",
                      alpha="type inletOutlet; inletValue uniform 1; value uniform 1;")
        case.bed(f"block {{ box (-9 -9 -9) (9 9 9); solidity {self.solidity}; diameter {self.diameter};"
                 " velocity (0 0 0); }", drag="law Darcy;", entries=option.format(angle=self.angle))
        case.adjusted(end, end / 20, delta_t=1e-4, courant=0.3)
        self.assert_runs(case, "slurryFoam")
        times = end * np.arange(1, 21) / 20
        return times, np.array([case.field("alpha.slurry", time).sum() * edge for time in times])

    @property
    def speed(self):
        """Speed of a front that falls through the bed by its weight alone, m/s: K = k rho g/(mu e), with Darcy's
        k = e^3 d^2/(150 phi^2)."""
        e = 1 - self.solidity
        return e**2 * self.diameter**2 / (150 * self.solidity**2) * SLURRY * 9.81 / self.viscosity

    def duration(self, height):
        """Time, s, of a rise from 0 to a height (m): of k (p_c - rho g h) = mu e h dh/dt."""
        share = height / self.rise
        return self.rise / self.speed * (-np.log(1 - share) - share)

    def test_pulls_the_slurry_up(self):
        end = self.duration(0.8 * self.rise) - self.duration(self.first)
        times, heights = self.column(end)
        levels = np.linspace(self.first, 0.99 * self.rise, 5000)
        expected = np.interp(times, self.duration(levels) - self.duration(self.first), levels)
        np.testing.assert_allclose(heights, expected, atol=2e-3 * self.rise)

    def test_is_off_by_default(self):
        times, heights = self.column(0.3, option="", first=self.rise)
        np.testing.assert_allclose(heights, self.rise - self.speed * times, atol=2e-3 * self.rise)


class StrongDrag(SlurryTest):
    """Water between two given pressures, through balls whose drag grows with the square of the speed."""

    def test_comes_to_erguns_speed_in_steps_that_the_drag_would_stop_it_in(self):
        """150 mu phi^2/(e^3 d^2) q + 1.75 rho phi/(e^3 d) q^2 = G with q = e u, in steps of 30 e rho/beta."""
        length, phi, diameter, density, viscosity, q = 0.04, 0.5, 0.005, SLURRY, 1e-3, 0.5
        gradient = 150 * viscosity * phi**2 / ((1 - phi) ** 3 * diameter**2) * q \
            + 1.75 * density * phi / ((1 - phi) ** 3 * diameter) * q**2
        step = 30 * (1 - phi) * density / (gradient * (1 - phi) ** 2 / q)
        case = self.slurry_case(
            upper=(length, 0.02, 0.01), cells=(4, 2, 1), level=lambda x: 1 + 0 * x,
            bingham=f"yieldStress 0; plasticViscosity {viscosity}; regularisation biviscosity; viscosityRatio 1;")
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        for side in ("front", "back", "bottom", "top"):
            case.at_patch(side, U=SLIP)
        for side, pressure in (("left", gradient * length), ("right", 0)):
            case.at_patch(side, U="type zeroGradient;", alpha="type zeroGradient;",
                          p_rgh=f"type fixedValue; value uniform {pressure};")
        case.bed(f"block {{ box (-9 -9 -9) (9 9 9); solidity {phi}; diameter {diameter}; velocity (0 0 0); }}",
                 drag="law Ergun;")
        case.control(40 * step, step, 40)
        self.assert_runs(case, "slurryFoam")
        np.testing.assert_allclose(case.field("U", 40 * step)[:, 0], q / (1 - phi), rtol=1e-3)


class ClosedBox(SlurryTest):
    """The pressure of a closed box has a reference."""

    def pressures(self, pimple):
        case = self.slurry_case(upper=(0.04, 0.1, 0.01), cells=(4, 20, 1), level=lambda x: 0.052 + 0 * x)
        case.write("system/fvSolution", SOLUTION.format(non_orthogonal=0, surface="", pimple=pimple))
        case.control(0.002, 0.001, 2)
        self.assert_runs(case, "slurryFoam")
        return case.field("p", 0.002).reshape(20, 4), case.field("U", 0.002)

    def test_is_the_mean_over_the_air(self):
        p, _ = self.pressures("")
        air = np.clip(np.arange(1, 21) * 0.005 - 0.052, 0, 0.005)
        self.assertAlmostEqual((p.mean(axis=1) @ air) / air.sum(), 0, delta=1e-6)
        np.testing.assert_allclose(p[0] - p[9], SLURRY * 9.81 * 0.045, rtol=1e-6)

    def test_is_what_the_dictionary_gives(self):
        p, _ = self.pressures("pRefCell 6; pRefValue 1e5;")
        self.assertAlmostEqual(p[1, 2], 1e5, delta=1e-6)
        p, _ = self.pressures("pRefPoint (0.005 0.0975 0.005); pRefValue 101325;")
        self.assertAlmostEqual(p[-1, 0], 101325, delta=1e-6)


if __name__ == "__main__":
    require_environment()
    unittest.main()
