# SPDX-License-Identifier: GPL-3.0-or-later
"""Mills that the project does not have, from their YAML alone to the report: `new_mill`, `Allrun`, and what came of it.

Each mill is at most a few hundred balls, some tenths of a second and a coarse mesh. What is expected of it is
computed here from its numbers. `-k Slice`, `-k Whole`, `-k Ranks`: groups that ctest runs on several cores."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from math import asin, pi, sqrt
from pathlib import Path
from unittest.mock import patch

import h5py
import numpy as np

from millfoam.files import foam
from millfoam.files.data_files import read_csv, read_json
from millfoam.files.tables import read_columns
from millfoam.readings.residence import read_tracer
from millfoam.run import run

NEW_MILL = Path(__file__).resolve().parents[2] / "scripts" / "new_mill"
GRAVITY = 9.81  # m/s2; the critical speed is sqrt(g/R)
STEEL = "{density: 7800, youngs_modulus: 2.0e11, poisson_ratio: 0.3}"


def ball(diameter):
    """Volume of a ball, m3."""
    return pi / 6 * diameter ** 3


def section(radius, count=0, height=0.0, width=0.0, top=None):
    """Area of a mill's cross-section, m2: the circle without lifters, each of which is on an arc of the shell."""
    half = asin(width / 2 / radius)
    arc = radius ** 2 * (half - np.sin(2 * half) / 2)
    trapezoid = (width + (width if top is None else top)) / 2 * (sqrt(radius ** 2 - width ** 2 / 4) - radius + height)
    return pi * radius ** 2 - count * (arc + trapezoid)


class MillRun:
    """What must hold of every mill; a subclass is a mill.

    YAML; RANKS of the solver; RADIUS, LENGTH (m, of what is computed, pulp lifters too); SECTION (m2); OMEGA (rad/s,
    signed); BALLS, number of balls simulated by diameter (m); SOLIDS_SHAPE, SLURRY_SHAPE, numbers of voxels; PAST, what
    voxels reach beyond the mill where their size does not divide it (share of the mill); DENSITY of the balls (kg/m3);
    FRICTION of ball on ball and ball on wall; SLURRY, volume (m3) or None with LEVEL (m); FED (m3/s); DRY, RECORD,
    START (s) of the dry run, its records and its averages; FLOW (s); CALLS, options of each Allrun, in turn."""
    RANKS = 1
    CALLS: tuple[tuple[str, ...], ...] = ((),)
    SLURRY = LEVEL = None
    FED = 0.0
    PAST = 1e-9

    @classmethod
    def setUpClass(cls):
        folder = Path(tempfile.mkdtemp(prefix="mills-"))
        cls.addClassCleanup(shutil.rmtree, folder)
        cls.case = folder / "case"
        (folder / "mine.yaml").write_text(cls.YAML)
        environment = {**os.environ, "MILLFOAM_NP": str(cls.RANKS)}
        cls.outputs = []
        for command in ([NEW_MILL, folder / "mine.yaml", cls.case],
                        *([cls.case / "Allrun", *options] for options in cls.CALLS)):
            done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            cls.outputs.append(done.stdout)
            if done.returncode:
                raise AssertionError(f"{command[0].name} of {cls.__name__} ended with {done.returncode}:\n"
                                     f"{done.stdout[-3000:]}")
        cls.output = "".join(cls.outputs)
        cls.mesh = foam.read_mesh(cls.case)
        cls.steps = read_csv(cls.case / "postProcessing" / "flow" / "0" / "steps.csv")

    def json(self, name, kind):
        return read_json(self.case / name, kind)

    def dumps(self):
        """[(step, file)] of the dumps in order of time."""
        return sorted((int(path.name.split(".")[1]), path) for path in (self.case / "dumps").glob("dump.*.txt"))

    def rows(self, dump):
        """Columns of a dump, name -> [balls]."""
        lines = dump.read_text().split("\n")
        head = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        table = np.array([line.split() for line in lines[head + 1:] if line.strip()], dtype=float)
        return dict(zip(lines[head].split()[2:], table.T))

    def test_no_stage_failed_and_none_was_left_out(self):
        steps = re.findall(r"^Running (\w+):", self.output, re.M)
        parallel = [["flow"], ["decompose", "flow", "reconstruct"]][self.RANKS > 1]
        self.assertEqual(steps, ["walls", "charge", "average", "mesh", "check", "start", *parallel, "pictures",
                                 "report"])
        self.assertNotIn("Traceback", self.output)

    def test_the_report_is_of_this_mill(self):
        text = (self.case / "report.html").read_text()
        title = re.search("title: (.*)", self.YAML).group(1)
        self.assertIn(f"<h1>{title}", text)
        self.assertRegex(text, r'<li class="holds">[^/]*</span><span><b>All stages belong to this mill')
        self.assertIn("data:image/png", text)
        self.assertNotIn("Traceback", text)

    def test_the_mill_is_the_one_asked_for(self):
        radii = np.hypot(*self.mesh.points[:, :2].T)
        self.assertAlmostEqual(radii.max(), self.RADIUS, delta=1e-9 * self.RADIUS)
        self.assertAlmostEqual(np.ptp(self.mesh.points[:, 2]), self.LENGTH, delta=1e-9)
        _, volumes = self.mesh.centres_and_volumes()
        self.assertAlmostEqual(volumes.sum() / (self.SECTION * self.LENGTH), 1, delta=0.005)
        properties = foam.read_dictionary(self.case / "constant" / "millProperties")
        self.assertAlmostEqual(float(properties["omega"]) / self.OMEGA, 1, delta=1e-9)
        with h5py.File(self.case / "solids.h5") as file:
            self.assertAlmostEqual(file.attrs["angular_velocity"] / self.OMEGA, 1, delta=1e-9)

    def test_the_charge_is_the_one_asked_for(self):
        derived = self.json("mill.json", "mill")["derived"]["charge"]["classes"]
        self.assertEqual({one["diameter_m"]: one["count"] for one in derived if one["simulated"]}, self.BALLS)
        self.assertEqual(self.json("dumps/results.json", "charge")["balls"], sum(self.BALLS.values()))
        for _, dump in (self.dumps()[0], self.dumps()[-1]):
            diameters, counts = np.unique(np.round(2 * self.rows(dump)["radius"], 9), return_counts=True)
            self.assertEqual(dict(zip(diameters.tolist(), counts.tolist())), self.BALLS, dump.name)

    def test_materials_are_those_asked_for(self):
        deck = (self.case / "dem" / "in.mill").read_text()
        self.assertEqual({float(value) for value in re.findall(r"density constant (\S+)", deck)}, {self.DENSITY})
        friction = re.search(r"coefficientFriction peratomtypepair \d (.*)", deck).group(1).split()
        self.assertEqual((float(friction[0]), float(friction[-1])), self.FRICTION)

    def test_the_charge_is_carried_to_the_rising_side(self):
        # In a smooth drum it swings, about a place on that side
        places = [np.average(rows["x"], weights=rows["radius"] ** 3)
                  for rows in map(self.rows, dict(self.dumps()).values())]
        self.assertGreater(np.mean(places) * np.sign(self.OMEGA), 0.02 * self.RADIUS)

    def test_the_dry_run_lasts_as_asked(self):
        run = self.json("dumps/run.json", "dumps")
        steps = [step for step, _ in self.dumps()]
        self.assertEqual(steps[0], 0)
        self.assertAlmostEqual(steps[-1] * run["timestep_s"] / self.DRY, 1, delta=1e-6)
        self.assertEqual(len(steps), round(self.DRY / self.RECORD) + 1)

    def test_the_charge_is_averaged_on_the_voxels_and_times_asked_for(self):
        with h5py.File(self.case / "solids.h5") as file:
            self.assertEqual(tuple(file["grid"].attrs["shape"]), self.SOLIDS_SHAPE)
            np.testing.assert_allclose(file["grid"].attrs["upper"] - file["grid"].attrs["lower"],
                                       [2 * self.RADIUS, 2 * self.RADIUS, self.LENGTH], rtol=self.PAST)
            self.assertAlmostEqual(file["window/begin"][0], self.START, delta=1e-9)
            self.assertGreater(file["solidity"][:].max(), 0.1)
        self.assertAlmostEqual(self.json("solids.json", "averages")["volume_in_m3"],
                               sum(count * ball(size) for size, count in self.BALLS.items()),
                               delta=1e-6 * self.RADIUS ** 3)

    def test_the_flow_lasts_as_asked(self):
        self.assertAlmostEqual(foam.times(self.case)[-1][0], self.FLOW, delta=1e-9)
        self.assertAlmostEqual(self.steps["time_s"][-1], self.FLOW, delta=1e-9)
        summary = self.json("postProcessing/flow/0/flow.json", "flow")
        self.assertTrue(summary["complete"])
        self.assertEqual(summary["rotation"]["sense"], "clockwise" if self.OMEGA < 0 else "anticlockwise")

    def test_the_slurry_starts_as_asked(self):
        alpha = foam.read_field(self.case / "0" / "alpha.slurry", self.mesh.cells)
        if self.SLURRY is not None:
            start = float(re.search(r"m: (\S+) m3", (self.case / "log.start").read_text()).group(1))
            self.assertAlmostEqual(start / self.SLURRY, 1, delta=1e-6)
        else:
            start = self.steps["slurry_m3"][0] - self.FED * self.steps["time_s"][0]
            centres, volumes = self.mesh.centres_and_volumes()
            reach = 2 * np.cbrt(volumes)  # half of a cell's diagonal, amply
            y = centres[:, 1]
            self.assertEqual(set(alpha[y + reach < self.LEVEL]), {1.0})
            self.assertEqual(set(alpha[y - reach > self.LEVEL]), {0.0})
        now = self.steps["slurry_m3"] - self.FED * self.steps["time_s"]
        np.testing.assert_allclose(now, start, rtol=1e-6 if not self.FED else 2e-3)

    def test_the_slurry_is_the_one_asked_for(self):
        properties = foam.read_dictionary(self.case / "constant" / "millProperties")
        for key, words in (("slurryDensity", "density"), ("slurryViscosity", "plastic_viscosity"),
                           ("yieldStress", "yield_stress")):
            asked = re.search(rf"slurry:.*\b{words}: ([^,}}]+)", self.YAML).group(1)
            self.assertEqual(float(properties[key]), float(asked), key)

    def test_the_slurry_is_averaged_on_the_voxels_asked_for(self):
        with h5py.File(self.case / "slurry.h5") as file:
            self.assertEqual(tuple(file["grid"].attrs["shape"]), self.SLURRY_SHAPE)
            share = file["slurry"][:] * file["grid/insideFraction"][:]
            voxel = np.prod((file["grid"].attrs["upper"] - file["grid"].attrs["lower"]) / self.SLURRY_SHAPE)
        np.testing.assert_allclose(share.sum(axis=(1, 2, 3)) * voxel, self.steps["slurry_m3"].mean(), rtol=0.02)


class GlassMill(MillRun):
    """0.6 m, named materials, anticlockwise, slurry by slurry.level. Again of mill_run_test makes this mill."""
    YAML = """
title: sixty centimetres of glass
geometry: {diameter: 0.6, length: 0.1, ends: periodic, lifters: {count: 12, height: 0.03, width: 0.03}}
speed: {fraction_of_critical: 0.7, sense: anticlockwise}
charge: {fill: 0.2, diameter: 0.04}
materials: {ball: glass, wall: HDPE, ball_ball: glass-glass, ball_wall: glass-HDPE}
dem: {settle_time: 0.3, duration: 0.4, record_interval: 0.01, seed: 42}
averages: {window: 0.1, start: 0.2}
slurry: {density: 1500, plastic_viscosity: 0.01, yield_stress: 1.0, level: -0.1}
resolution: {cell_size: 0.05, layers: 2}
flow: {duration: 0.05}
"""
    RADIUS, LENGTH, SECTION = 0.3, 0.1, section(0.3, 12, 0.03, 0.03)
    OMEGA = 0.7 * sqrt(GRAVITY / 0.3)
    BALLS = {0.04: round(0.2 * 0.6 * SECTION * 0.1 / ball(0.04))}
    DENSITY, FRICTION = 2700, (0.94, 0.287)
    DRY, RECORD, START, FLOW, LEVEL = 0.4, 0.01, 0.2, 0.05, -0.1
    SOLIDS_SHAPE, SLURRY_SHAPE = (8, 8, 1), (12, 12, 2)  # voxels of a quarter of the radius


class SliceOfTrapezoids(MillRun, unittest.TestCase):
    """1.8 m, 0.2 m out of 2 m as a slice, steel, trapezoids, overlap by its share, slurry by fill, counts."""
    YAML = f"""
title: trapezoids of 1.8 m
geometry:
  diameter: 1.8
  length: 2
  slice: 0.2
  ends: plain
  lifters: {{count: 8, height: 0.1, width: 0.2, top_width: 0.12}}
speed: {{fraction_of_critical: 0.72, sense: clockwise}}
charge: {{fill: 0.3, diameter: 0.1}}
materials:
  ball: {STEEL}
  wall: {STEEL}
  ball_ball: {{restitution: 0.6, friction: 0.4, rolling_friction: 0.01}}
  ball_wall: {{restitution: 0.5, friction: 0.6, rolling_friction: 0.01}}
dem: {{largest_overlap: 0.1, settle_time: 0.3, duration: 0.6, record_interval: 0.02}}
averages: {{counts: {{across: 9, along: 2}}, window: 0.1, start: 0}}
slurry: {{density: 1800, plastic_viscosity: 0.02, yield_stress: 2}}
resolution: {{cell_size: 0.15, layers: 20}}
flow: {{duration: 0.05, start: {{fill: 0.8}}, averages: {{counts: {{across: 11, along: 1}}}}}}
"""
    RADIUS, LENGTH, SECTION = 0.9, 0.2, section(0.9, 8, 0.1, 0.2, 0.12)
    OMEGA = -0.72 * sqrt(GRAVITY / 0.9)
    BALLS = {0.1: round(0.3 * 0.6 * SECTION * 0.2 / ball(0.1))}
    DENSITY, FRICTION = 7800, (0.4, 0.6)
    DRY, RECORD, START, FLOW = 0.6, 0.02, 0, 0.05
    SLURRY = 0.8 * BALLS[0.1] * ball(0.1) * 0.4 / 0.6
    SOLIDS_SHAPE, SLURRY_SHAPE = (9, 9, 2), (11, 11, 1)

    def test_balls_are_as_soft_as_their_overlap_asks(self):
        plan = self.json("dem/plan.json", "dem-plan")
        self.assertAlmostEqual(plan["expected_overlap"]["ratio"], 0.1, delta=1e-3)


class SliceOfFiveMetres(MillRun, unittest.TestCase):
    """5 m, two sizes, the smaller one softened; slurry by its volume; the length of the flow in turns."""
    YAML = f"""
title: five metres
geometry: {{diameter: 5, length: 0.6, ends: periodic, lifters: {{count: 20, height: 0.2, width: 0.25}}}}
speed: {{fraction_of_critical: 0.75, sense: anticlockwise}}
charge:
  classes:
    - {{diameter: 0.3, mass: 11000}}
    - {{diameter: 0.2, mass: 2000}}
materials:
  ball: {STEEL}
  wall: {STEEL}
  ball_ball: {{restitution: 0.6, friction: 0.5, rolling_friction: 0.01}}
  ball_wall: {{restitution: 0.6, friction: 0.5, rolling_friction: 0.01}}
dem: {{youngs_modulus: 5.0e7, soften_below: 0.25, settle_time: 0.8, duration: 0.8, record_interval: 0.04}}
averages: {{voxel_size: 0.5, window: 0.2, start: 0.4}}
slurry: {{density: 1700, plastic_viscosity: 0.05, yield_stress: 5}}
resolution: {{cell_size: 0.4, layers: 2}}
flow: {{turns: 0.02, start: {{volume: 1.5}}, law: Hill}}
"""
    RADIUS, LENGTH, SECTION = 2.5, 0.6, section(2.5, 20, 0.2, 0.25)
    OMEGA = 0.75 * sqrt(GRAVITY / 2.5)
    BALLS = {0.3: round(11000 / 7800 / ball(0.3)), 0.2: round(2000 / 7800 / ball(0.2))}
    DENSITY, FRICTION = 7800, (0.5, 0.5)
    DRY, RECORD, START, FLOW, SLURRY = 0.8, 0.04, 0.4, 0.02 * 2 * pi / OMEGA, 1.5
    SOLIDS_SHAPE, SLURRY_SHAPE = (10, 10, 1), (14, 14, 2)
    PAST = 0.15

    def test_only_balls_below_the_size_are_softened(self):
        deck = (self.case / "dem" / "in.mill").read_text()
        moduli = {float(word) for word in re.search(r"youngsModulus peratomtype(.*)", deck).group(1).split()}
        self.assertEqual(len(moduli), 2)
        self.assertAlmostEqual(max(moduli), 5e7)
        self.assertAlmostEqual(min(moduli) / max(moduli), (0.2 / 0.25) ** 2.5, delta=1e-6)

    def test_the_law_is_the_one_asked_for(self):
        self.assertIn("Hill", (self.case / "log.flow").read_text())

    def test_dictionaries_are_read_without_warnings(self):
        self.assertNotIn("IOstreams", (self.case / "log.flow").read_text())


class SliceWithOneLifter(MillRun, unittest.TestCase):
    """0.1 m, one lifter, rad/s instead of a share of the critical speed, water."""
    YAML = """
title: one lifter in water
geometry: {diameter: 0.1, length: 0.02, ends: periodic, lifters: {count: 1, height: 0.01, width: 0.008}}
speed: {angular_velocity: -9}
charge: {fill: 0.35, diameter: 0.006}
materials: {ball: glass, wall: perspex}
dem: {settle_time: 0.1, duration: 0.3, record_interval: 0.01}
averages: {voxel_size: 0.0125, window: 0.05, start: 0.1}
slurry: {density: 998, plastic_viscosity: 0.001, yield_stress: 0}
resolution: {cell_size: 0.006, layers: 1}
flow: {duration: 0.03, write_interval: 0.01, start: {level: -0.015}}
"""
    RADIUS, LENGTH, SECTION = 0.05, 0.02, section(0.05, 1, 0.01, 0.008)
    OMEGA = -9
    BALLS = {0.006: round(0.35 * 0.6 * SECTION * 0.02 / ball(0.006))}
    DENSITY, FRICTION = 2700, (0.94, 0.424)
    DRY, RECORD, START, FLOW, LEVEL = 0.3, 0.01, 0.1, 0.03, -0.015
    SOLIDS_SHAPE, SLURRY_SHAPE = (8, 8, 2), (18, 18, 1)
    PAST = 0.1


class WholeSmoothDrum(MillRun, unittest.TestCase):
    """0.1 m, closed and smooth, three sizes, the smallest left out; own and named materials; a volume of slurry."""
    YAML = """
title: smooth drum with fines
geometry: {diameter: 0.1, length: 0.06, ends: plain, lifters: {count: 0}}
speed: {fraction_of_critical: 0.6, sense: clockwise}
charge:
  classes:
    - {diameter: 0.01, mass: 0.15}
    - {diameter: 0.008, mass: 0.08}
    - {diameter: 0.001, mass: 0.03}
  fines_below: 0.005
materials:
  ball: {density: 3700, youngs_modulus: 3.0e11, poisson_ratio: 0.22}
  wall: nylon
  ball_ball: {restitution: 0.7, friction: 0.3, rolling_friction: 0.02}
  ball_wall: glass-nylon
dem: {youngs_modulus: 1.0e7, settle_time: 0.15, duration: 0.25, record_interval: 0.01}
averages: {voxel_size: 0.0125, window: 0.05, start: 0.1}
slurry: {density: 1200, plastic_viscosity: 0.003, yield_stress: 0.2}
resolution: {cell_size: 0.008, layers: 6}
flow: {duration: 0.04, write_interval: 0.01, start: {volume: 6.0e-5}}
"""
    RADIUS, LENGTH, SECTION = 0.05, 0.06, section(0.05)
    OMEGA = -0.6 * sqrt(GRAVITY / 0.05)
    BALLS = {0.01: round(0.15 / 3700 / ball(0.01)), 0.008: round(0.08 / 3700 / ball(0.008))}
    DENSITY, FRICTION = 3700, (0.3, 0.532)
    DRY, RECORD, START, FLOW, SLURRY = 0.25, 0.01, 0.1, 0.04, 6e-5
    SOLIDS_SHAPE, SLURRY_SHAPE = (8, 8, 5), (14, 14, 6)
    PAST = 0.15

    def test_fines_are_in_the_books(self):
        books = read_csv(self.case / "dumps" / "charge.csv")
        fines = books["simulated"] == 0
        self.assertEqual(books["diameter_m"][fines].tolist(), [0.001])
        self.assertAlmostEqual(books["mass_kg"][fines].sum(), 0.03, delta=1e-5)
        self.assertIn("fines", (self.case / "report.html").read_text())


class WholeFedMill(MillRun, unittest.TestCase):
    """0.6 m, plain ends with inlet, grates and pulp lifters, a feed; slurry to the level flow.start.level."""
    YAML = """
title: fed mill
geometry:
  diameter: 0.6
  length: 0.4
  ends: plain
  lifters: {count: 12, height: 0.03, width: 0.04}
  inlet: {radius: 0.1}
  grates: {inner_radius: 0.15, outer_radius: 0.24, sectors: 6, sector_share: 0.7, open_fraction: 0.4}
  pulp_lifters: {depth: 0.08, layers: 2, discharge_radius: 0.1}
speed: {fraction_of_critical: 0.65, sense: clockwise}
charge: {fill: 0.15, diameter: 0.05}
materials: {ball: glass, wall: aluminium}
dem: {settle_time: 0.3, duration: 0.3, record_interval: 0.01}
averages: {voxel_size: 0.1, window: 0.1, start: 0.1}
slurry: {density: 1300, plastic_viscosity: 0.005, yield_stress: 0.5}
resolution: {cell_size: 0.05, layers: 4}
flow: {duration: 0.03, feed: 0.003, start: {level: -0.12}, tracer: {begin: 0.01, pulse: 0.01}}
"""
    RADIUS, LENGTH, SECTION = 0.3, 0.48, section(0.3, 12, 0.03, 0.04)
    OMEGA = -0.65 * sqrt(GRAVITY / 0.3)
    BALLS = {0.05: round(0.15 * 0.6 * SECTION * 0.4 / ball(0.05))}
    DENSITY, FRICTION = 2700, (0.94, 0.306)
    DRY, RECORD, START, FLOW, LEVEL, FED = 0.3, 0.01, 0.1, 0.03, -0.12, 0.003
    SOLIDS_SHAPE, SLURRY_SHAPE = (6, 6, 5), (12, 12, 5)

    def test_openings_are_those_asked_for(self):
        mesh = self.json("mesh.json", "mesh")
        self.assertAlmostEqual(mesh["inlet_area_m2"] / (pi * 0.1 ** 2), 1, delta=0.01)
        self.assertAlmostEqual(mesh["grate_area_m2"] / (0.7 * pi * (0.24 ** 2 - 0.15 ** 2)), 1, delta=0.1)
        self.assertAlmostEqual(mesh["outlet_area_m2"] / (pi * 0.1 ** 2), 1, delta=0.01)

    def test_no_balls_are_behind_the_grates(self):
        # Although the last voxels reach from 0.384 to 0.48 m, through the grates at 0.4 m
        time, path = foam.times(self.case)[-1]
        solidity = foam.read_field(path / "solidity", self.mesh.cells)
        centres, volumes = self.mesh.centres_and_volumes()
        behind = centres[:, 2] > 0.4
        self.assertEqual(np.abs(solidity[behind]).max(), 0)
        self.assertGreater(solidity[~behind].max(), 0.4)
        balls = self.BALLS[0.05] * ball(0.05)
        self.assertAlmostEqual((solidity * volumes).sum() / balls, 1, delta=1e-5)
        self.assertLess(np.abs(self.steps["volume_correction"]).max(), 0.02)

    def test_the_feed_enters(self):
        balance = read_columns(self.case, "slurryBalance")
        np.testing.assert_allclose(balance["feed"], self.FED, rtol=0.01)

    def test_the_tracer_of_the_feed_enters(self):
        tracer = read_tracer(self.case)
        self.assertTrue(tracer.pulse)
        # The step of the flow in which it begins began before it
        self.assertAlmostEqual(tracer.begin, 0.01, delta=0.003)
        self.assertAlmostEqual(tracer.tracer[-1] / (self.FED * 0.01), 1, delta=1e-6)
        self.assertLess(tracer.missing, 1e-10)
        self.assertIn("Residence time: tracer", (self.case / "report.html").read_text())


class RanksThickSlurry(MillRun, unittest.TestCase):
    """0.6 m, closed, thick slurry by its share of the pores, on two ranks."""
    RANKS = 2
    YAML = """
title: thick slurry
geometry: {diameter: 0.6, length: 0.3, ends: plain, lifters: {count: 8, height: 0.04, width: 0.05}}
speed: {fraction_of_critical: 0.8, sense: anticlockwise}
charge:
  classes:
    - {diameter: 0.06, mass: 18}
    - {diameter: 0.045, mass: 9}
materials: {ball: glass, wall: HDPE}
dem: {settle_time: 0.3, duration: 0.3, record_interval: 0.01}
averages: {voxel_size: 0.1, window: 0.1, start: 0.1, method: sample}
slurry: {density: 2000, plastic_viscosity: 0.5, yield_stress: 40}
resolution: {cell_size: 0.05, layers: 6}
flow: {duration: 0.03, start: {fill: 1.2}, viscosity: pore}
"""
    RADIUS, LENGTH, SECTION = 0.3, 0.3, section(0.3, 8, 0.04, 0.05)
    OMEGA = 0.8 * sqrt(GRAVITY / 0.3)
    BALLS = {0.06: round(18 / 2700 / ball(0.06)), 0.045: round(9 / 2700 / ball(0.045))}
    DENSITY, FRICTION = 2700, (0.94, 0.287)
    DRY, RECORD, START, FLOW = 0.3, 0.01, 0.1, 0.03
    SLURRY = 1.2 * sum(count * ball(size) for size, count in BALLS.items()) * 0.4 / 0.6
    SOLIDS_SHAPE, SLURRY_SHAPE = (6, 6, 3), (12, 12, 6)

    def test_a_time_that_was_joined_in_part_is_joined_again(self):
        case = self.case.with_name("joined")
        shutil.copytree(self.case, case, symlinks=True)
        self.addCleanup(shutil.rmtree, case)
        velocity = foam.times(case)[-1][1] / "U"
        before = velocity.read_bytes()
        velocity.unlink()
        (case / ".stages" / "reconstruct").unlink()
        (case / ".stages" / "reconstruct.begun").touch()
        with patch.dict(os.environ, MILLFOAM_NP="2"):
            self.assertIn("Running reconstruct", run(case, "./Allrun"))
        self.assertEqual(velocity.read_bytes(), before)


class RanksOnDefaults(MillRun, unittest.TestCase):
    """1.8 m, only what has no default, and the durations: the rest follows from them."""
    RANKS = 2
    YAML = """
title: 1.8 m on defaults
geometry: {diameter: 1.8, length: 0.5, ends: periodic, lifters: {count: 16}}
speed: {fraction_of_critical: 0.75, sense: clockwise}
charge: {fill: 0.25, diameter: 0.12}
materials: {ball: glass, wall: HDPE}
dem: {settle_time: 0.4, duration: 0.4, record_interval: 0.02}
averages: {window: 0.1, start: 0.1}
slurry: {density: 1500, plastic_viscosity: 0.01, yield_stress: 1}
flow: {duration: 0.04}
"""
    RADIUS, LENGTH, SECTION = 0.9, 0.5, section(0.9, 16, 0.06, 0.06)
    OMEGA = -0.75 * sqrt(GRAVITY / 0.9)
    BALLS = {0.12: round(0.25 * 0.6 * SECTION * 0.5 / ball(0.12))}
    DENSITY, FRICTION = 2700, (0.94, 0.287)
    DRY, RECORD, START, FLOW = 0.4, 0.02, 0.1, 0.04
    SLURRY = BALLS[0.12] * ball(0.12) * 0.4 / 0.6
    SOLIDS_SHAPE, SLURRY_SHAPE = (8, 8, 2), (26, 26, 3)  # a quarter of the radius; cells of R/13
    PAST = 0.17


if __name__ == "__main__":
    unittest.main(verbosity=2)
