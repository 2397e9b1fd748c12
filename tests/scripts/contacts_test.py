#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts out of dumps written by hand, whose powers and energies are known, and spectra of streams of collisions."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from millfoam.files.contact_dumps import read_materials
from millfoam.files.mill_case import MillCase
from millfoam.readings.contact_spectra import energy_edges, hertz_duration, power_to_dissipate, read_spectra, spectra
from millfoam.readings.contacts import Contacts, read_contacts
from millfoam.report.contact_cards import contact_span
from report_cases import write_json

RADIUS, DENSITY, OVERLAP = 0.01, 2500.0, 1e-4
MASS = DENSITY * 4 / 3 * np.pi * RADIUS ** 3
ARM = RADIUS - OVERLAP / 2
DECK = """fix youngs all property/global youngsModulus peratomtype 10000000 40000000
fix poisson all property/global poissonsRatio peratomtype 0.25 0.4
fix restitution all property/global coefficientRestitution peratomtypepair 2 0.8 0.7 0.7 0.7
fix friction all property/global coefficientFriction peratomtypepair 2 0.5 0.4 0.4 0.4
fix ball1 all particletemplate/sphere 20011 atom_type 1 density constant 2500 radius constant 0.01
"""
BALLS = "ATOMS id type x y z vx vy vz omegax omegay omegaz radius"
PAIRS = "ENTRIES " + " ".join(f"c_ballOverlaps[{number}]" for number in range(1, 11))
WALLS = "ENTRIES " + " ".join(f"c_wallOverlaps[{number}]" for number in range(1, 23))


def stiffness(radius, *solids):
    """k of F = k overlap^1.5 of solids (modulus, Poisson's ratio)."""
    return 4 / 3 / sum((1 - ratio ** 2) / modulus for modulus, ratio in solids) * np.sqrt(radius)


BALL_BALL = stiffness(RADIUS / 2, (1e7, 0.25), (1e7, 0.25))
BALL_WALL = stiffness(RADIUS, (1e7, 0.25), (4e7, 0.4))
# Ball 1 to the right of ball 2, which lies across the periodic end; ball 3 on the floor
AT_REST = [(2, 1, -ARM, 0, 0.999, 0, 0, 0, 0, 0, 0, RADIUS), (1, 1, ARM, 0, -0.001, 0, 0, 0, 0, 0, 0, RADIUS),
           (3, 1, 0.5, 0, 0.5, 0, 0, 0, 0, 0, 0, RADIUS)]


class Case(unittest.TestCase):
    def setUp(self):
        self.case = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for folder in ("dem", "dumps", "contacts"):
            (self.case / folder).mkdir()
        (self.case / "dem" / "in.mill").write_text(DECK)
        write_json(self.case / "dumps" / "run.json", "dumps", timestep_s=1e-5, interval=100, angular_velocity_rad_s=-6)

    def write(self, kind, head, rows, step=100):
        lines = ["ITEM: TIMESTEP", step, "ITEM: NUMBER OF ENTRIES", len(rows), "ITEM: BOX BOUNDS ff ff pp", "-1 1",
                 "-1 1", "0 1", "ITEM: " + head + " "]
        text = [" ".join(f"{float(value):.9g}" for value in row) + " " for row in rows]
        (self.case / "contacts" / f"{kind}.{step}.txt").write_text("\n".join(map(str, lines + text)) + "\n")

    def contacts(self, balls=AT_REST, pairs=(), walls=(), step=100):
        for kind, head, rows in (("balls", BALLS, balls), ("pairs", PAIRS, pairs), ("walls", WALLS, walls)):
            self.write(kind, head, rows, step)
        return read_contacts(self.case, step, read_materials(self.case / "dem" / "in.mill"))


class Powers(Case):
    def test_of_two_balls_that_near_each_other_go_into_damper_and_spring(self):
        balls = [list(row) for row in AT_REST]
        balls[0][5], balls[1][5] = 0.7, -0.3
        elastic = BALL_BALL * OVERLAP ** 1.5
        pairs, walls = self.contacts(balls, [(2, 1, 1, -(elastic + 0.2), 0, 0, 0, 0, 0, OVERLAP)])
        self.assertAlmostEqual(pairs.approach[0], 1.0, places=6)
        self.assertAlmostEqual(pairs.damping[0], 0.2, places=6)
        self.assertAlmostEqual(pairs.spring[0], elastic, places=6)
        self.assertAlmostEqual(pairs.power()[0], elastic + 0.2, places=6)
        self.assertAlmostEqual(pairs.friction[0], 0, places=9)
        self.assertAlmostEqual(pairs.normal_energy()[0] / (MASS / 4 + 0.4 * BALL_BALL * OVERLAP ** 2.5), 1, places=5)
        np.testing.assert_array_equal(pairs.key, [[1, 2]])
        self.assertEqual(len(walls.key), 0)

    def test_of_spinning_balls_go_into_friction_and_rolling(self):
        balls = [list(row) for row in AT_REST]
        balls[1][10], balls[0][10] = 10.0, -4.0
        force, torque = 0.3, 0.001
        pairs, _ = self.contacts(balls, [(1, 2, 1, 0.6, force, 0, 0, 0, -ARM * force - torque, OVERLAP)])
        self.assertAlmostEqual(pairs.slip[0], 6 * ARM, places=7)
        self.assertAlmostEqual(pairs.friction[0], force * 6 * ARM, places=7)
        self.assertAlmostEqual(pairs.rolling[0], torque * 14, places=7)
        self.assertTrue(pairs.sliding[0])
        pairs, _ = self.contacts(balls, [(1, 2, 1, 0.61, force, 0, 0, 0, -ARM * force, OVERLAP)])
        self.assertFalse(pairs.sliding[0])

    def test_of_a_sliding_contact_lack_the_damper_that_the_dump_adds(self):
        balls = [list(row) for row in AT_REST]
        balls[0][10], balls[1][10] = -4.0, 10.0
        shear_modulus = 1 / (4 * (2 - 0.25) * 1.25 / 1e7)
        damper = 2 * np.sqrt(5 / 6) * -np.log(0.8) / np.hypot(np.log(0.8), np.pi) * np.sqrt(
            8 * shear_modulus * np.sqrt(RADIUS / 2 * OVERLAP) * MASS / 2)
        for limit, dumped in ((0.3, 0.3 + damper * 6 * ARM), (0.3, 0.3)):
            pairs, _ = self.contacts(balls, [(1, 2, 1, 0.6, dumped, 0, 0, 0, -ARM * dumped, OVERLAP)])
            self.assertTrue(pairs.sliding[0])
            self.assertAlmostEqual(pairs.friction[0], limit * 6 * ARM, places=7)
            self.assertAlmostEqual(pairs.rolling[0], 0, places=9)

    def test_of_a_wall_that_slides_below_a_ball_go_into_friction(self):
        elastic = BALL_WALL * OVERLAP ** 1.5
        limit = 0.4 * elastic
        point, centre, ids = [0.5, -(RADIUS - OVERLAP), 0.5], [0.5, 0, 0.5], [1, 17, 3]
        row = [*point, *centre, 0.4, 0, 0, 0, 0, 0, *ids, limit, elastic, 0, 0, 0, ARM * limit, OVERLAP]
        _, walls = self.contacts(walls=[row])
        self.assertAlmostEqual(walls.friction[0], 0.4 * limit, places=7)
        self.assertAlmostEqual(walls.damping[0], 0, places=7)
        self.assertAlmostEqual(walls.rolling[0], 0, places=9)
        np.testing.assert_array_equal(walls.key, [[3, -2]])
        np.testing.assert_allclose(walls.diameters, [[0, 2 * RADIUS]])
        self.assertAlmostEqual(walls.reduced_mass[0], MASS)


class Refused(Case):
    def test_a_table_that_is_cut_or_lacks_columns_or_balls_is_named(self):
        self.contacts()
        path = self.case / "contacts" / "pairs.100.txt"
        whole = path.read_text()
        materials = read_materials(self.case / "dem" / "in.mill")
        one = whole.replace("ENTRIES\n0", "ENTRIES\n1")
        for text, message in ((whole.replace("ENTRIES\n0", "ENTRIES\n2"),
                               "pairs.100.txt: 9 lines, expected a dump of 2"),
                              (whole.replace("[10]", "[11]"), r"pairs.100.txt:9: .*expected 10 among"),
                              (one + "1 2 3\n", "pairs.100.txt:10: '1 2 3', expected 10"),
                              (one + "1 9 0 1 0 0 0 0 0 1e-4\n", "balls.100.txt: no ball 9")):
            path.write_text(text)
            with self.assertRaisesRegex(RuntimeError, message):
                read_contacts(self.case, 100, materials)

    def test_a_deck_without_a_property_is_named(self):
        (self.case / "dem" / "in.mill").write_text(DECK.replace("coefficientFriction", "other"))
        with self.assertRaisesRegex(RuntimeError, "in.mill: no coefficientFriction"):
            read_materials(self.case / "dem" / "in.mill")


def moments(keys, speed=1.0):
    """Contacts of equal balls without overlap that near each other at one speed, slide, and take 1, 2, 3 and 0 W."""
    count = len(keys)
    same = np.ones(count)
    key = np.array(keys, dtype=int).reshape(count, 2)
    return Contacts(key, np.full((count, 2), 0.02), MASS / 2 * same, speed * same, 0 * same, same, same, 0 * same,
                    BALL_BALL * same, same, 0 * same, 2 * same, 3 * same, np.zeros(count, dtype=bool))


class Spectra(Case):
    energy = MASS / 4
    duration = hertz_duration(MASS / 2, BALL_BALL, energy)

    def test_duration_is_that_of_an_integrated_contact(self):
        step, overlap, speed, time = self.duration / 5000, 0.0, 1.0, 0.0
        while overlap >= 0:
            speed -= step * BALL_BALL * overlap ** 1.5 / (MASS / 2)
            overlap, time = overlap + step * speed, time + step
        self.assertAlmostEqual(time / self.duration, 1, places=3)

    def stream(self, interval, number=1000, records=1000):
        """What `spectra` makes of collisions at random times, each of another pair."""
        begins = np.random.default_rng(3).uniform(0, records * interval, number)
        open_at = [[] for _ in range(records)]
        for ball, begin in enumerate(begins):
            for record in range(int(np.ceil(begin / interval)),
                                min(records, int((begin + self.duration) // interval) + 1)):
                open_at[record].append((ball, ball + number))
        found = spectra(((moments(keys), moments([])) for keys in open_at), interval, energy_edges())
        return found, number / (records * interval)

    def test_collisions_longer_or_shorter_than_the_interval_are_counted_as_often_as_they_are(self):
        for share, tolerance in ((0.3, 0.01), (4.0, 0.15)):
            found, rate = self.stream(share * self.duration)
            self.assertAlmostEqual(found.collisions.sum() / rate, 1, delta=tolerance)
            self.assertEqual(np.count_nonzero(found.collisions), 1)
            bin_ = np.searchsorted(found.edges, self.energy)
            np.testing.assert_array_equal(found.classes, [0, 0.02])
            self.assertGreater(found.collisions[1, 1, bin_], 0)

    def test_a_contact_that_lasts_is_one_collision_and_one_from_the_start_is_none(self):
        records = [(moments(keys), moments([]))
                   for keys in ([(1, 2)], [(1, 2), (3, 4)], [(1, 2), (3, 4)], [(1, 2), (3, 4)])]
        found = spectra(records, 1.0, energy_edges())
        self.assertAlmostEqual(found.collisions.sum(), 1 / 2)

    def test_powers_are_means_over_the_dumps_and_nothing_is_lost_beyond_the_bins(self):
        for edges in (energy_edges(), energy_edges(1e-9, 1e-8), energy_edges(1, 10)):
            found = spectra([(moments([(1, 2)]), moments([(5, -1)])), (moments([]), moments([]))] * 2, 1.0, edges)
            self.assertAlmostEqual(found.power["damping"].sum(), 1)
            self.assertAlmostEqual(found.dissipation().sum(), 6)
            self.assertAlmostEqual(found.total_power(), 6)

    def test_are_read_from_a_case_and_stand_beside_the_drives_power(self):
        balls = [list(row) for row in AT_REST]
        balls[0][5], balls[1][5] = 0.7, -0.3
        for step in range(0, 500, 100):
            self.contacts(balls, [(2, 1, 1, -(BALL_BALL * OVERLAP ** 1.5 + 0.2), 0, 0, 0, 0, 0, OVERLAP)], step=step)
        found = read_spectra(self.case, 0.001, 0.003)
        self.assertEqual((found.dumps, round(found.interval, 9)), (3, 0.001))
        self.assertAlmostEqual(found.dissipation().sum(), 0.2, places=6)
        (self.case / "dumps" / "energy.csv").write_text(
            "time_s,torque_Nm,power_W,kinetic_J,potential_J\n"
            "0.1,1,9,1,2\n0.2,1,5,1.1,2\n0.3,1,7,1.1,2.3\n")
        self.assertAlmostEqual(power_to_dissipate(self.case), 6 - 0.4 / 0.2)
        with self.assertRaisesRegex(RuntimeError, "1 records from 0.25"):
            power_to_dissipate(self.case, 0.25)
        with self.assertRaisesRegex(RuntimeError, "1 dumps from 0.004"):
            read_spectra(self.case, 0.004)


class Span(unittest.TestCase):
    def test_of_a_charge_that_becomes_steady_is_since_then(self):
        times = list(np.arange(1, 11) / 10)
        for steady, since, begin in ((True, 0.55, 0.55), (False, 0.55, 0.1), (True, 0.05, 0.1),
                                     # Fewer than three dumps are no span
                                     (True, 0.85, 0.1)):
            case = SimpleNamespace(contact_times=times, contacts=Path("case"), results={"steady": steady},
                                   result={"steady_from_s": since}.get)
            self.assertTrue(all(hasattr(MillCase, name) for name in vars(case)))
            self.assertEqual(contact_span(case), (begin, 1.0))


if __name__ == "__main__":
    unittest.main()
