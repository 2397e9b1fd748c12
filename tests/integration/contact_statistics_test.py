#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every contact in every step: single collisions against the energy that the balls lose, and a drum against its drive,
on one and two ranks, also resumed."""
import json
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_csv
from millfoam.files.wall_forces import read_wall_forces
from millfoam.run import run

DENSITY, RADIUS, RESTITUTION, TIMESTEP = 2500.0, 0.002, 0.7, 1e-6
MASS = DENSITY * 4 / 3 * np.pi * RADIUS ** 3
# Two triangles of the plane y = 0, as the wall "floor"
FLOOR = """solid floor
facet normal 0 1 0
outer loop
vertex -0.02 0 0
vertex -0.02 0 0.04
vertex 0.02 0 0
endloop
endfacet
facet normal 0 1 0
outer loop
vertex 0.02 0 0
vertex -0.02 0 0.04
vertex 0.02 0 0.04
endloop
endfacet
endsolid floor
"""
DECK = """units si
atom_style granular
atom_modify map array
newton off
communicate single vel yes
processors 1 1 RANKS
boundary f f f
region box block -0.02 0.02 -0.01 0.03 0 0.04 units box
create_box 2 box
neighbor 0.001 bin
neigh_modify delay 0
fix youngs all property/global youngsModulus peratomtype 1e8 1e8
fix poisson all property/global poissonsRatio peratomtype 0.25 0.25
fix restitution all property/global coefficientRestitution peratomtypepair 2 0.7 0.7 0.7 0.7
fix friction all property/global coefficientFriction peratomtypepair 2 0.4 0.4 0.4 0.4
fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0.02 0.02 0.02 0.02
pair_style gran model hertz tangential history rolling_friction cdt surface watched
pair_coeff * *
timestep 1e-6
fix floor all mesh/surface/stress file walls/floor.stl type 2
fix walls all wall/gran model hertz tangential history rolling_friction cdt surface watched mesh n_meshes 1 meshes floor
BALLS
set group all density 2500 diameter 0.004
fix motion all nve/sphere
run 0
watch_contacts
dump balls all custom STEPS dump.*.txt id vx vy vz omegax omegay omegaz
dump_modify balls format "%d %.15g %.15g %.15g %.15g %.15g %.15g"
run STEPS
"""
DRUM = """
geometry: {diameter: 0.06, length: 0.03, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.7, sense: clockwise}
charge: {classes: [{diameter: 0.004, mass: 0.014}, {diameter: 0.003, mass: 0.006}], start_radius: 0.02}
materials: {ball: glass, wall: HDPE}
dem: {youngs_modulus: 5e6, settle_time: 0.1, duration: 0.3, record_interval: 0.005, seed: 3,
      contact_statistics: true}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
resolution: {cell_size: 0.003, layers: 4}
averages: {start: 0.1}
"""


def numbers(path):
    return np.loadtxt(path, ndmin=2)


def last_segment(case, kind, step=0):
    return numbers(case / "dem" / f"{kind}.{step}.txt")


def read_state(path):
    """(number of contacts, their work) of a contactState file."""
    lines = path.read_text().splitlines()
    count = int(lines[0])
    return count, sum(sum(map(float, line.split()[3:])) for line in lines[1:count + 1])


class ContactCase(unittest.TestCase):
    def new_folder(self):
        case = Path(tempfile.mkdtemp(prefix="contacts-"))
        self.addCleanup(shutil.rmtree, case)
        return case


class OneCollision(ContactCase):
    """Balls of mass m in free flight; the deck is written here, with the wall `floor` at y = 0."""

    def collide(self, balls, ranks=1, steps=4000):
        """balls: (position, velocity, spin) of each. (work [kinds, 3], touches, loss of the balls' kinetic energy)"""
        case = self.new_folder()
        (case / "walls").mkdir()
        (case / "walls" / "floor.stl").write_text(FLOOR)
        lines = []
        for number, (place, velocity, spin) in enumerate(balls, start=1):
            lines += [f"create_atoms 1 single {' '.join(map(str, place))} units box",
                      f"set atom {number} vx {velocity[0]} vy {velocity[1]} vz {velocity[2]}",
                      f"set atom {number} omegax {spin[0]} omegay {spin[1]} omegaz {spin[2]}"]
        deck = DECK.replace("BALLS", "\n".join(lines)).replace("RANKS", str(ranks)).replace("STEPS", str(steps))
        (case / "in.deck").write_text(deck)
        order = {"format": "millfoam-contacts", "diameters_m": [2 * RADIUS], "parts": ["floor"], "turning_parts": [],
                 "walls": "walls", "timestep_s": TIMESTEP, "angular_velocity_rad_s": 0.0, "cell_edge_m": 0.002,
                 "end_step": steps, "block_steps": steps, "wall_steps": steps}
        (case / "contacts.json").write_text(json.dumps(order))
        run(case, "mpirun", "--allow-run-as-root", "--oversubscribe", "-np", ranks, "millLiggghts", "-in", "in.deck")
        before, after = (self.energy(np.loadtxt(case / f"dump.{step}.txt", skiprows=9, ndmin=2)) for step in (0, steps))
        work, bins = numbers(case / "contactWork.0.txt"), numbers(case / "contactBins.0.txt")
        self.assertAlmostEqual(work[0, 2], self.spin(np.loadtxt(case / f"dump.{steps}.txt", skiprows=9, ndmin=2)),
                               delta=1e-8 * before)
        self.assertEqual(read_state(case / f"contactState.{steps}.txt")[0], 0)
        np.testing.assert_allclose(bins[:, 5:].sum(axis=0), work[:, 4:].sum(axis=0), rtol=1e-6, atol=1e-20)
        self.assertEqual(bins[:, 4].sum(), bins[:, 3].sum())
        self.walls = numbers(case / "wallCells.0.txt")
        return work[:, 4:], bins[:, 3].sum(), before - after

    @staticmethod
    def energy(table):
        return MASS / 2 * np.sum(table[:, 1:4] ** 2) + OneCollision.spin(table)

    @staticmethod
    def spin(table):
        return MASS * RADIUS ** 2 / 5 * np.sum(table[:, 4:7] ** 2)

    def test_two_balls_head_on_lose_what_restitution_says(self):
        speed = 0.5
        for ranks in (1, 2):
            # On two ranks the border is z = 0.02, which the balls cross in touch
            work, touches, loss = self.collide([((0, 0.01, 0.0177), (0, 0, speed), (0, 0, 0)),
                                                ((0, 0.01, 0.0220), (0, 0, 0), (0, 0, 0))], ranks)
            self.assertEqual(touches, 1)
            self.assertAlmostEqual(work[0, 0] / loss, 1, delta=1e-7)
            self.assertAlmostEqual(loss / ((1 - RESTITUTION ** 2) * MASS / 4 * speed ** 2), 1, delta=0.01)
            np.testing.assert_allclose(work[0, 1:], 0, atol=1e-9 * loss)

    def test_two_balls_that_graze_lose_it_by_friction_and_rolling_too(self):
        for ranks in (1, 2):
            work, touches, loss = self.collide([((0, 0.010, 0.0178), (0, 0, 0.5), (100, 30, 50)),
                                                ((0, 0.012, 0.0218), (0, 0, 0), (40, 0, 0))], ranks)
            self.assertEqual(touches, 1)
            self.assertAlmostEqual(work.sum() / loss, 1, delta=1e-6)
            self.assertTrue(np.all(work[0] > 1e-4 * loss))

    def test_an_oblique_impact_on_a_wall_loses_the_work_of_its_contact(self):
        # Onto the edge of the two triangles of the floor
        work, touches, loss = self.collide([((0, 0.0023, 0.02), (0.3, -0.5, 0.1), (0, 20, -60))])
        self.assertEqual(touches, 1)
        self.assertAlmostEqual(work.sum() / loss, 1, delta=1e-6)
        np.testing.assert_array_equal(work[0], 0)
        self.assertTrue(np.all(work[1] > 1e-4 * loss))
        cells = self.walls[self.walls[:, 3] > 0]
        np.testing.assert_allclose(cells[:, 10:].sum(axis=0), work[1, :2], rtol=1e-6)
        # The impulse: forces are sums over the steps, N
        self.assertAlmostEqual(-cells[:, 7].sum() * TIMESTEP / (MASS * 0.5 * (1 + RESTITUTION)), 1, delta=0.01)


class Drum(ContactCase):
    def make_drum(self):
        case = self.new_folder()
        (case / "mill.yaml").write_text(DRUM)
        run(case, "millMesh", "mill.yaml", "--case", ".", "--walls")
        return case

    def run_mill(self, case, *options):
        return run(case, "millDem", "mill.yaml", "--case", ".", *options)

    def assert_books(self, case, start, before, end):
        """Work of the steps = that of the contacts that have ended + that of the open ones, less what these had."""
        bins, work = last_segment(case, "contactBins", start), last_segment(case, "contactWork", start)
        count, open_work = read_state(case / "dem" / f"contactState.{end}.txt")
        self.assertAlmostEqual((bins[:, 5:].sum() + open_work - before[1]) / work[:, 4:].sum(), 1, delta=1e-6)
        return count - before[0] - (bins[:, 3].sum() - bins[:, 4].sum())

    def assert_books_from_the_start(self, case):
        # Contacts that were there at step 0 are not touches
        self.assertGreater(self.assert_books(case, 0, (0, 0), max(self.states(case))), 0)

    @staticmethod
    def states(case):
        """Steps of the files with the open contacts."""
        return [int(path.name.split(".")[1]) for path in (case / "dem").glob("contactState.*.txt")]

    def assert_balance(self, case):
        contacts = json.loads((case / "dumps" / "results.json").read_text())["contacts"]
        self.assertAlmostEqual(contacts["dissipated_over_drive"], 1, delta=0.005)
        energy = np.genfromtxt(case / "dumps" / "energy.csv", delimiter=",", names=True)
        walls = contacts["walls"]
        inside = (energy["time_s"] > walls["begin_s"] + 1e-9) & (energy["time_s"] <= walls["end_s"] + 1e-9)
        self.assertAlmostEqual(walls["torque_Nm"] / energy["torque_Nm"][inside].mean(), 1, delta=1e-5)
        # The same torque from the forces of the wall cells at their middles
        cells = read_wall_forces(case / "dumps" / "wall_forces.vtp")
        middle, force = cells.corners.mean(axis=1), cells.fields["force_N"]
        moment = np.sum(middle[:, 0] * force[:, 1] - middle[:, 1] * force[:, 0])
        self.assertAlmostEqual(moment / walls["torque_Nm"], 1, delta=0.01)
        powers = read_csv(case / "dumps" / "contact_spectra.csv")
        whole = sum(powers[part].sum() for part in ("normal_W", "tangential_W", "rolling_W"))
        self.assertAlmostEqual(whole / contacts["dissipated_W"], 1, delta=0.05)
        self.assertAlmostEqual(powers["touches_per_s"].sum() / contacts["collisions_per_s"], 1, delta=1e-6)
        return contacts

    def test_contacts_dissipate_what_the_drive_gives_on_one_rank_and_resumed_on_two(self):
        whole = self.make_drum()
        self.run_mill(whole)
        rate = self.assert_balance(whole)["collisions_per_s"]
        self.assert_books_from_the_start(whole)
        case = self.make_drum()
        self.run_mill(case, "--set", "dem.duration=0.15")
        (step,) = self.states(case)
        before = read_state(case / "dem" / f"contactState.{step}.txt")
        self.run_mill(case, "--resume", "-np", 2)
        self.assertAlmostEqual(self.assert_balance(case)["collisions_per_s"] / rate, 1, delta=0.1)
        # The open contacts continue
        self.assertEqual(self.assert_books(case, step, before, max(self.states(case))), 0)

    def test_two_ranks_have_the_books_of_a_run_from_its_start(self):
        case = self.make_drum()
        self.run_mill(case, "-np", 2, "--set", "dem.duration=0.02", "--set", "averages.start=0")
        self.assert_books_from_the_start(case)

    def test_statistics_do_not_change_the_motion_and_ranks_do_not_change_the_statistics(self):
        first = self.make_drum()
        self.run_mill(first, "--set", "dem.duration=0.02", "--set", "averages.start=0", "--set",
                      "dem.contact_statistics=false")
        self.assertFalse((first / "dumps" / "contact_power.csv").exists())
        self.assertEqual(list((first / "dem").glob("contact*")), [])
        dumps, works = [], []
        for watched, ranks in (("true", 1), ("true", 2), ("false", 1)):
            case = self.make_drum()
            self.run_mill(case, "--continue", first, "-np", ranks, "--set", "dem.duration=0.02", "--set",
                          "averages.start=0", "--set", f"dem.contact_statistics={watched}")
            dumps.append({path.name: path.read_bytes() for path in (case / "dumps").glob("dump.*.txt")})
            if watched == "true":
                (segment,) = (case / "dem").glob("contactWork.*.txt")
                works.append(numbers(segment)[:, 4:])
        self.assertEqual(dumps[0], dumps[2])
        # Chaos lets the motion on two ranks differ from its rounding errors on
        np.testing.assert_allclose(works[1], works[0], rtol=1e-5, atol=1e-5 * works[0].max())

    def test_a_run_with_statistics_can_be_planned(self):
        case = self.make_drum()
        run(case, "millDem", "plan", "mill.yaml", "--json", "plan.json")
        self.assertGreater(json.loads((case / "plan.json").read_text())["wall_time_s"], 0)


if __name__ == "__main__":
    unittest.main()
