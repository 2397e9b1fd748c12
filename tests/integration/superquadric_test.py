#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Superquadrics in the dry run: two bodies, a body on a plane, a small stirred mill against spheres, its averages and
contacts, and a killed run. Ends with 77 where LIGGGHTS with superquadrics is not built; the refusal in words is tested
anyway."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

from mill_case import force_difference, run_mill
from millfoam.files.data_files import read_csv, read_json
from millfoam.run import RunError, run
from stirred_mill import UPPER_PINS, small_mill

NOT_BUILT = 77  # CTest's SKIP_RETURN_CODE
PROGRAM = shutil.which("millLiggghtsSuperquadric")
os.environ["MILLFOAM_NP"] = "1"  # on one rank a resumed run is the same to round-off

DENSITY, DIAMETER = 2700.0, 0.0045
MASS = DENSITY * np.pi / 6 * DIAMETER ** 3
MILL = small_mill("""
dem: {youngs_modulus: 5.0e6, settle_time: 0.1, duration: 0.5, record_interval: 0.005}
averages: {start: 0.2, window: 0.3}
""", (UPPER_PINS, ""), ("length: 0.050", "length: 0.047"), ("level: 0.035", "level: 0.016"))
SLURRY_MILL = small_mill("""
dem: {youngs_modulus: 5.0e6, settle_time: 0.05, duration: 0.04, record_interval: 0.0025}
averages: {start: 0.02}
slurry: {density: 1379, plastic_viscosity: 0.1, yield_stress: 0, level: 0.036}
resolution: {cell_size: 0.0035}
flow: {law: HoelzerSommerfeld, duration: 0.015, write_interval: 0.0075, averages: {start: 0.005}, coupling: direct}
""", ("height: 0.025", "height: 0.033"), ("level: 0.035", "level: 0.036"))
ROUND = "charge.shape={half_axes: [1, 1, 1], blockiness: 2}"  # a sphere, computed as a superquadric
BLOCK = "charge.shape={half_axes: [2.55269, 2.04215, 2.04215], roundness: 0.571429}"

# A plane z = 0 of two triangles, and one or two bodies
PLANE = """solid plane
facet normal 0 0 1
outer loop
vertex -0.05 -0.05 0
vertex 0.05 -0.05 0
vertex -0.05 0.05 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 0.05 -0.05 0
vertex 0.05 0.05 0
vertex -0.05 0.05 0
endloop
endfacet
endsolid plane
"""
DECK = """units si
atom_style superquadric
atom_modify map array
newton off
communicate single vel yes
boundary f f f
region box block -0.02 0.02 -0.02 0.02 -0.001 0.03 units box
create_box 2 box
neighbor 0.002 bin
neigh_modify delay 0
fix youngs all property/global youngsModulus peratomtype 1e7 1e7
fix poisson all property/global poissonsRatio peratomtype 0.3 0.3
fix restitution all property/global coefficientRestitution peratomtypepair 2 0.6 0.5 0.5 0.5
fix friction all property/global coefficientFriction peratomtypepair 2 0.4 0.3 0.3 0.3
fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0 0 0 0
MODEL
pair_coeff * *
timestep TIMESTEP
fix gravity all gravity GRAVITY vector 0 0 -1
fix plane all mesh/surface/stress file plane.stl type 2
WALLS
BODIES
fix motion all nve/superquadric integration_scheme 1
dump balls all custom STEPS dump.*.txt id vx vy vz omegax omegay omegaz x y z quat1 quat2 quat3 quat4
dump_modify balls format "%d %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g"
run SETTLE
variable force equal f_plane[3]
fix force all ave/time 1 STEPS STEPS v_force file force.txt
run STEPS
"""
CONTACT = "gran model hertz tangential history rolling_friction cdt surface superquadric"
SETTINGS = "curvatureLimitFactor 10 meanCurvature yes"


def rotation(turn):
    """Matrix of a unit quaternion w, x, y, z."""
    w, x, y, z = turn
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def dirichlet(axes, blockiness):
    """Volume of a superquadric and the mean squares of its coordinates, by Dirichlet's integral."""
    part = 1 / blockiness
    volume = 8 * np.prod(axes) * math.gamma(1 + part) ** 3 / math.gamma(1 + 3 * part)
    mean = math.gamma(3 * part) * math.gamma(1 + 3 * part) / (math.gamma(part) * math.gamma(1 + 5 * part))
    return volume, mean * np.array(axes) ** 2


@unittest.skipUnless(PROGRAM, "not built: scripts/setup --superquadrics")
class Bodies(unittest.TestCase):
    """One or two bodies whose deck is written here."""

    def fly(self, bodies, steps, settle=0, gravity=0.0, timestep=2e-6):
        """bodies: words of LIGGGHTS' `set` of each, its place and velocity. Rows of the last dump; the mean force on
        the plane."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="bodies-")))
        (folder / "plane.stl").write_text(PLANE)
        lines = []
        for number, (words, place, velocity) in enumerate(bodies, start=1):
            lines += [f"create_atoms 1 single {' '.join(map(str, place))} units box", f"set atom {number} {words}",
                      f"set atom {number} density {DENSITY}", f"group body{number} id {number}",
                      f"velocity body{number} set {' '.join(map(str, velocity))} units box"]
        deck = DECK.replace("BODIES", "\n".join(lines)).replace("STEPS", str(steps)).replace("SETTLE", str(settle))
        deck = deck.replace("MODEL", f"pair_style {CONTACT} {SETTINGS}")
        deck = deck.replace("WALLS", f"fix walls all wall/{CONTACT} mesh n_meshes 1 meshes plane {SETTINGS}")
        (folder / "in.bodies").write_text(deck.replace("TIMESTEP", str(timestep)).replace("GRAVITY", str(gravity)))
        run(folder, PROGRAM, "-in", "in.bodies", "-log", "none")
        last = np.loadtxt(folder / f"dump.{settle + steps}.txt", skiprows=9, ndmin=2)
        return last[np.argsort(last[:, 0])], np.loadtxt(folder / "force.txt", ndmin=2)[-1, 1]

    @staticmethod
    def words(axes, blockiness, turn=(1, 0, 0, 0)):
        return (f"shape {' '.join(map(str, axes))} blockiness {blockiness} {blockiness} "
                f"quat_direct {' '.join(map(str, turn))}")

    def test_bodies_that_meet_head_on_lose_what_restitution_says(self):
        axes = (0.0026, 0.0020, 0.0021)
        for blockiness in (2, 4, 6):
            shape = self.words(axes, blockiness)
            balls, _ = self.fly([(shape, (-0.0027, 0, 0.01), (0.2, 0, 0)), (shape, (0.0027, 0, 0.01), (-0.2, 0, 0))],
                                3000)
            velocity = balls[:, 1:4]
            self.assertAlmostEqual((velocity[1, 0] - velocity[0, 0]) / 0.4, 0.6, delta=0.006, msg=str(blockiness))
            # No sideways motion or spin from the symmetry's axis, and momentum is kept
            np.testing.assert_allclose(velocity[:, 1:], 0, atol=1e-4)
            self.assertAlmostEqual(velocity[:, 0].sum(), 0, delta=1e-9)

    def test_bodies_that_meet_askew_keep_momentum_and_spin_and_lose_energy(self):
        axes = (0.0027, 0.0020, 0.0017)
        places, speed = np.array([(-0.004, 0, 0.01), (0.004, 0.001, 0.0105)]), np.array([(0.3, 0, 0), (-0.3, 0, 0)])
        turns = ((0.8, 0.36, 0.48, 0), (0.6, 0, 0.64, 0.48))
        balls, _ = self.fly([(self.words(axes, 6, turn), place, velocity)
                             for turn, place, velocity in zip(turns, places, speed)], 10000)
        _, square = dirichlet(axes, 6)
        moments = np.array([square[1] + square[2], square[2] + square[0], square[0] + square[1]])  # over the mass
        velocity, spin, places_after = balls[:, 1:4], balls[:, 4:7], balls[:, 7:10]
        turned = [rotation(turn) for turn in balls[:, 10:14]]
        own_spin = [matrix.T @ omega for matrix, omega in zip(turned, spin)]
        energy = (velocity ** 2).sum() + sum((moments * omega ** 2).sum() for omega in own_spin)
        self.assertLess(energy, 0.95 * (speed ** 2).sum())
        self.assertGreater(energy, 0.36 * (speed ** 2).sum())  # what is left head-on
        self.assertGreater(sum((moments * omega ** 2).sum() for omega in own_spin), 0.01 * energy)
        np.testing.assert_allclose(velocity.sum(axis=0), 0, atol=1e-9)
        momentum = np.cross(places_after, velocity).sum(axis=0) + sum(
            matrix @ (moments * omega) for matrix, omega in zip(turned, own_spin))
        before = np.cross(places, speed).sum(axis=0)
        np.testing.assert_allclose(momentum, before, atol=2e-3 * np.linalg.norm(before))

    def test_a_body_on_a_plane_comes_to_rest_on_a_flat_side_and_weighs_on_it(self):
        axes = (0.0027, 0.0020, 0.0017)
        balls, force = self.fly([(self.words(axes, 6, (0.99, 0.1, 0.0994987, 0)), (0, 0, 0.0021), (0, 0, 0))], 10000,
                                settle=140000, gravity=9.81, timestep=1e-5)
        np.testing.assert_allclose(balls[0, 1:4], 0, atol=1e-5)
        # One of its axes is upright, and the overlap is some micrometres
        upright = np.abs(rotation(balls[0, 10:14])[2])
        self.assertGreater(upright.max(), 0.9999)
        self.assertAlmostEqual(balls[0, 9], axes[upright.argmax()], delta=3e-6)
        self.assertAlmostEqual(-force / (dirichlet(axes, 6)[0] * DENSITY * 9.81), 1, delta=1e-3)


@unittest.skipUnless(PROGRAM, "not built: scripts/setup --superquadrics")
class StirredMill(unittest.TestCase):
    """Spheres, spheres as superquadrics, and blocks."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="superquadrics-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "mill.yaml").write_text(MILL)
        for name, changes in (("spheres", ()), ("round", (ROUND,))):
            run_mill(cls.folder / name, cls.folder / "mill.yaml", *changes, until="charge")
        cls.short = ("dem.settle_time=0.02", "dem.duration=0.05", "dem.record_interval=0.0025", "averages.start=0.025",
                     "averages.window=0.025", "dem.contact_statistics=true")
        run_mill(cls.folder / "block", cls.folder / "mill.yaml", BLOCK, *cls.short)

    def results(self, name):
        return read_json(self.folder / name / "dumps" / "results.json", "charge")

    def mean_speed(self, name):
        """Mean speed of the balls from 0.2 s on, and its standard error from eight batches of records."""
        files = sorted((self.folder / name / "dumps").glob("dump.*.txt"), key=lambda path: int(path.name.split(".")[1]))
        speeds = [np.linalg.norm(np.loadtxt(file, skiprows=9)[:, 5:8], axis=1).mean() for file in files[41:]]
        return np.mean(speeds), np.std([batch.mean() for batch in np.array_split(speeds, 8)], ddof=1) / np.sqrt(8)

    def test_round_superquadrics_have_the_spheres_torque_and_speed(self):
        spheres, rounds = self.results("spheres"), self.results("round")
        self.assertEqual((rounds["balls"], rounds["lost_balls"]), (spheres["balls"], 0))
        for quantity, (value, error), (other, its_error) in (
                ("power", *((result["power_W"], result["power_error_W"]) for result in (spheres, rounds))),
                ("speed", self.mean_speed("spheres"), self.mean_speed("round"))):
            self.assertAlmostEqual(other / value, 1, delta=0.03 + np.hypot(error, its_error) / value, msg=quantity)

    def test_torque_of_the_impeller_is_that_of_the_walls_at_rest(self):
        torques = self.results("round")["part_torques_Nm"]
        self.assertAlmostEqual(-torques["impeller"] / sum(torques[part] for part in ("shell", "base", "lid")), 1,
                               delta=0.03)

    def test_overlaps_are_those_of_spheres(self):
        overlaps = [read_csv(self.folder / name / "dumps" / "overlaps.csv") for name in ("spheres", "round")]
        for kind in ("ball_contacts", "wall_contacts"):
            means = [(table["overlap_m"] * table[kind]).sum() / table[kind].sum() for table in overlaps]
            self.assertAlmostEqual(means[1] / means[0], 1, delta=0.15)

    def test_contacts_of_blocks_dissipate_what_the_impeller_gives(self):
        contacts = self.results("block")["contacts"]
        self.assertAlmostEqual(contacts["dissipated_over_drive"], 1, delta=0.01)
        for partner in ("balls", "impeller", "shell", "base"):
            self.assertGreater(contacts["power"][partner]["tangential_W"], 0)
            self.assertAlmostEqual(contacts["power"][partner]["rolling_W"], 0, delta=1e-9 * contacts["dissipated_W"])
        spectra = read_csv(self.folder / "block" / "dumps" / "contact_spectra.csv")
        self.assertEqual({*spectra["first_m"], *spectra["second_m"]} - {0.0}, {DIAMETER})

    def test_averages_have_all_of_the_blocks_volume(self):
        case = self.folder / "block"
        run(case, "millAverage", "--dumps", "dumps/dump.*.txt", "--box", -0.035, -0.035, -0.005, 0.035, 0.035, 0.095,
            "--shape", 14, 14, 20, "--start", 0.025, "--window", 0.025, "-o", "box.h5")
        with h5py.File(case / "box.h5") as file:
            volume = file["ledger/deposited"][0]
        self.assertAlmostEqual(volume / (self.results("block")["balls"] * MASS / DENSITY), 1, delta=1e-3)

    def test_averages_that_the_run_makes_have_it_too(self):
        with h5py.File(self.folder / "block" / "solids.h5") as file:
            volume = file["ledger/volume_in"][0]
        self.assertAlmostEqual(volume / (self.results("block")["balls"] * MASS / DENSITY), 1, delta=1e-3)

    def test_a_killed_run_resumes_with_balls_walls_and_contacts(self):
        case = self.folder / "killed"
        run_mill(case, self.folder / "mill.yaml", BLOCK, *self.short, until="walls")
        process = subprocess.Popen(["millDem", "mill.json", "--case", "."], cwd=case, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        end = time.monotonic() + 120
        while not list((case / "dem").glob("restart.[1-9]*")) and time.monotonic() < end:
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.assertFalse((case / "dumps" / "run.json").exists())
        self.assertIn("resumed at step", run(case, "millDem", "mill.json", "--case", ".", "--resume"))
        whole, parts = (read_csv(self.folder / name / "dumps" / "energy.csv") for name in ("block", "killed"))
        self.assertEqual(len(whole["time_s"]), len(parts["time_s"]))
        resumed = int(next((case / "dem").glob("torque.[1-9]*.txt")).name.split(".")[1])
        record = int(round(resumed / read_json(case / "dem" / "plan.json", "dem-plan")["interval"]))
        # LIGGGHTS searches the points of contact once more where a run resumes, so that round-off grows from there
        for column in ("kinetic_J", "torque_Nm"):
            np.testing.assert_allclose(parts[column][:record + 3], whole[column][:record + 3], rtol=1e-3)


@unittest.skipUnless(PROGRAM, "not built: scripts/setup --superquadrics")
class InSlurry(unittest.TestCase):
    """Balls of two shapes and slurry at the same time, by the law that knows shapes."""
    CHARGE = ("charge={classes: [{diameter: 0.0036, number: 200}, {diameter: 0.0036, number: 600, shape: {half_axes: "
              "[2.70274, 2.00172, 1.67844], roundness: 0.333333}}]}")

    @classmethod
    def setUpClass(cls):
        cls.case = Path(tempfile.mkdtemp(prefix="superquadrics-in-slurry-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        (cls.case / "mill.yaml").write_text(SLURRY_MILL)
        run_mill(cls.case, cls.case / "mill.yaml", cls.CHARGE)
        cls.direct = cls.case / "direct"

    def test_the_balls_take_what_the_flow_gives(self):
        # The balls feel each of the flow's steps one step later: 0.048. With the drag of spheres it would be 0.091
        self.assertLess(force_difference(self.direct, 0.04 + 0.005), 0.07)
        self.assertEqual(np.max(read_csv(self.direct / "dumps" / "fluid.csv")["balls_without_field"]), 0)

    def test_the_balls_know_all_shapes_and_the_slurry(self):
        order = read_json(self.direct / "dem" / "fluid.json", "fluid")
        self.assertEqual(order["slurry"], {"density_kg_m3": 1379, "viscosity_Pa_s": 0.1})
        np.testing.assert_allclose([part["share"] for part in order["shapes"]], [0.25, 0.75], rtol=1e-12)
        charge = read_json(self.case / "mill.json", "mill")["derived"]["charge"]
        np.testing.assert_allclose([part["sphericity"] for part in order["shapes"]],
                                   [1, charge["classes"][1]["shape"]["sphericity"]], rtol=1e-12)

    def test_the_flow_sees_the_volume_of_the_balls(self):
        steps = read_csv(self.direct / "postProcessing" / "flow" / "0" / "steps.csv")
        # But for what the spheres that stand for flat balls reach into the walls
        np.testing.assert_allclose(steps["solids_m3"] - steps["without_room_m3"], 800 * np.pi / 6 * 0.0036 ** 3,
                                   rtol=0.01)


class WithoutTheProgram(unittest.TestCase):
    def test_shapes_are_refused_with_the_way_to_get_it(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="no-superquadrics-")))
        (folder / "mill.yaml").write_text(MILL)
        shutil.copy(shutil.which("millDem"), folder / "millDem")
        run(folder, "millMesh", "mill.yaml", "--case", ".", "--walls", "--set", ROUND)
        with self.assertRaisesRegex(RunError, "which the key 'shape' of the charge needs.*scripts/setup --superquad"):
            run(folder, folder / "millDem", "mill.yaml", "--case", ".", "--set", ROUND)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if not PROGRAM:
        print("not built: scripts/setup --superquadrics")
        sys.exit(NOT_BUILT)
