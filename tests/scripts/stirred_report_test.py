#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings and report of a stirred mill's dry run, of files written by hand."""
import json
import re
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import DataError
from millfoam.files.mill import NoMill
from millfoam.files.mill_case import MillCase
from millfoam.files.stirred_case import StirredCase
from millfoam.readings.partner_spectra import read_partner_spectra
from millfoam.readings.stirred_flow import read_stirred_flow
from millfoam.readings.stirred_power import (averaged_span, balls_span, mean_speed, power_number, read_stirred,
                                             torque_coefficient)
from millfoam.readings.stirred_slurry import SlurryFlow
from millfoam.report import figures, stirred_figures, stirred_sections
from millfoam.report.build import compare_cases, report_case
from millfoam.report.checks import all_checks
from millfoam.report.flow_checks import slurry_torques
from report_cases import PRINTS, RESULTS, change_json, write_dry, write_json

OMEGA, TURN, RADIUS, MASS = 10 * np.pi, 0.2, 0.07, 1.5
PARTS = ("impeller", "shell", "base", "lid")
TORQUES = {"impeller": -0.8, "shell": 0.6, "base": 0.192, "lid": 0.0}
HEAD = ("first_m,second_m,wall,energy_from_J,energy_to_J,touches_per_s,collisions_per_s,normal_W,tangential_W,"
        "rolling_W\n")
SPECTRA = ("0.005,0.005,-1,1e-06,1.584893e-06,500,400,3,4,0\n0.005,0.005,-1,1.584893e-06,2.511886e-06,50,40,1,2,0\n"
           "0.005,0,0,1e-05,1.584893e-05,70,60,2,3,0\n0.005,0,1,1e-06,1.584893e-06,20,10,1,8,0\n")
STEADY = 0.4


def contacts():
    """Entry `contacts` of results.json: partners' powers sum to 25 W."""
    powers = {"balls": (4, 6), "impeller": (2, 3), "shell": (1, 8), "base": (0.5, 0.5), "lid": (0, 0)}
    return {"begin_s": STEADY, "end_s": 2.0, "collisions_per_s": 640.0, "dissipated_W": 25.0, "drive_W": 25.2,
            "gain_W": 0.1, "dissipated_over_drive": 25 / 25.1, "torque_Nm": -0.8,
            "power": {name: {"normal_W": normal, "tangential_W": tangential, "rolling_W": 0.0}
                      for name, (normal, tangential) in powers.items()}}


def write_stirred(folder, power=25.0, **changed):
    """A dry run of two seconds, ten turns: mill.json, dumps/; power: of the steady charge, W, more before; changed:
    values of results.json."""
    folder.mkdir(parents=True, exist_ok=True)
    impeller = {"shaft_diameter_m": 0.025, "shaft_end_m": 0.02, "radius_m": RADIUS, "top_m": 0.0775, "gap_m": 0.0075,
                "volume_below_top_m3": 1e-4, "pins": []}
    derived = {
        "machine": "stirred",
        "geometry": {"radius_m": 0.0775, "length_m": 0.3, "section_m2": 0.018, "volume_m3": 5e-3, "impeller": impeller},
        "speed": {"angular_velocity_rad_s": OMEGA, "sense": "anticlockwise", "tip_speed_m_s": OMEGA * RADIUS,
                  "turn_s": TURN},
        "charge": {"balls": 4, "mass_kg": MASS, "resting_solidity": 0.6, "fines_share": 0.0},
        "materials": {"ball": {"density_kg_m3": 2500.0}}, "gravity_m_s2": 9.81}
    content = {"format": "millfoam-mill", "version": 1, "program": "millMesh 1.2.3", "file": "mill.yaml",
               "fingerprint": {**PRINTS, "flow": ""},
               "mill": {"title": "A stirred mill", "geometry": {}, "speed": {}, "charge": {}}, "derived": derived}
    (folder / "mill.json").write_text(json.dumps(content))
    results = {**RESULTS, "balls": 4, "steady_from_s": STEADY, "power_from_s": 0.0, "begin_s": 0.0, "duration_s": 2.0,
               "power_W": 28.0, "power_error_W": 0.3, "part_torques_Nm": TORQUES,
               "part_torques_error_Nm": {part: 0.004 for part in PARTS}, **changed}
    write_json(folder / "dumps" / "results.json", "charge", ("charge",), **results)
    write_json(folder / "dumps" / "run.json", "dumps", ("charge",), timestep_s=1e-3, interval=10,
               angular_velocity_rad_s=OMEGA)
    time = np.arange(1, 201) * 0.01
    ripple = 0.1 * np.sin(2 * np.pi * (time - 0.005) / TURN)
    # One turn is above the mean, the next below: over eight turns the error is a root of seven smaller
    apart = np.sqrt(7) * np.where(np.ceil(time / TURN - 1e-9) % 2, -1, 1)
    power = np.where(time > STEADY + 1e-9, power - ripple + 0.2 * apart, power + 15)
    np.savetxt(folder / "dumps" / "energy.csv", np.column_stack([time, -power / OMEGA, power, 0.1 + 0 * time,
                                                                 0.2 + 0 * time]), "%.9g", ",", comments="",
               header="time_s,torque_Nm,power_W,kinetic_J,potential_J")
    torques = [TORQUES[part] + ripple + (0.004 * apart if part == "impeller" else 0) for part in PARTS]
    np.savetxt(folder / "dumps" / "torques.csv", np.column_stack([time, *torques]),
               "%.9g", ",", comments="", header="time_s," + ",".join(f"{part}_Nm" for part in PARTS))
    # Speeds 3, 4, 5 and 8 m/s after the begin, other ones before, with a ripple that repeats with the turns
    for step in range(0, 2001, 10):
        speeds = np.array([3, 4, 5, 8]) + np.sin(2 * np.pi * step / 200) if step >= 400 else np.full(4, 100)
        rows = "".join(f"{k} 1 0 0 0 {0.6 * speed:.9g} 0 {-0.8 * speed:.9g} 0.0025\n" for k, speed in enumerate(speeds))
        (folder / "dumps" / f"dump.{step}.txt").write_text(
            f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n4\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
            f"ITEM: ATOMS id type x y z vx vy vz radius\n{rows}")
    if results.get("contacts"):
        (folder / "dumps" / "contact_spectra.csv").write_text(HEAD + SPECTRA)
    return folder


def text_of(page):
    return re.sub(r"<[^>]*>", "|", page)


class StirredReport(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.case = write_stirred(self.folder / "one", contacts=contacts())

    def test_a_disc_of_fluid_in_rigid_rotation_has_the_numbers_of_its_definition(self):
        # 2 W at two turns per second in a fluid of 1000 kg/m3 with an impeller of 0.1 m
        self.assertAlmostEqual(power_number(2.0, 1000.0, -4 * np.pi, 0.1), 2 / (1000 * 8 * 1e-5))
        self.assertAlmostEqual(torque_coefficient(-2.0, 1000.0, 4.0, 0.1), 2 / (1000 * 16 * 0.05**5))

    def test_the_mean_speed_is_that_of_all_balls_from_the_begin_on_and_a_turns_ripple_is_no_error(self):
        speed = mean_speed(self.case / "dumps", STEADY, TURN)
        self.assertAlmostEqual(speed.value, 5, delta=0.01)
        self.assertLess(speed.error, 0.01)
        with self.assertRaisesRegex(RuntimeError, "no dump from 3 s on"):
            mean_speed(self.case / "dumps", 3.0, TURN)

    def test_power_and_torques_are_of_the_same_time_that_of_a_steady_charge_or_that_is_asked_for(self):
        found = read_stirred(StirredCase(self.case))
        self.assertAlmostEqual(found.power.value, 25, delta=1e-6)
        self.assertAlmostEqual(found.power.error, 0.2, delta=1e-6)
        self.assertAlmostEqual(found.torques["impeller"].error, 0.004, delta=1e-6)
        self.assertAlmostEqual(found.balance, 0.99)
        self.assertAlmostEqual(found.density, 1500)
        self.assertAlmostEqual(found.power_number.value, 25 / (1500 * 125 * 0.14**5), places=5)
        self.assertAlmostEqual(found.torque_over_weight.value, 0.8 / (MASS * 9.81 * RADIUS))
        self.assertAlmostEqual(found.per_mass.value, 25 / MASS)
        self.assertIsNone(found.per_slurry)
        later = read_stirred(StirredCase(self.case, 1.01))
        self.assertAlmostEqual(later.torques["shell"].value, 0.6, delta=1e-6)
        self.assertLess(later.torques["shell"].error, 1e-6)
        with self.assertRaisesRegex(RuntimeError, "averages from 7 s on; expected less than the end"):
            read_stirred(StirredCase(self.case, 7.0))

    def test_numbers_of_balls_that_move_with_the_flow_are_of_the_flows_averages(self):
        change_json(self.case / "dumps" / "results.json", "fluid", to={"kind": "flow"})
        case = StirredCase(self.case)
        # The flow's time 0 is that of the balls at 0.6 s; its averages are three turns, and the balls go on after it
        case.__dict__ |= {"flow": SimpleNamespace(time0=0.6), "begin": 0.4, "last": 1.0}
        self.assertEqual(balls_span(case), (1.0, 1.6))
        found = read_stirred(case)
        self.assertAlmostEqual(found.power.value, 25 + 0.2 * np.sqrt(7) / 3, delta=1e-6)
        self.assertAlmostEqual(found.torques["impeller"].value, -0.8 + 0.004 * np.sqrt(7) / 3, delta=1e-6)
        self.assertEqual(found.power.freedom, 2)
        figure = stirred_figures.torques(case)
        self.assertIn([1.0, 1.0], [list(line.get_xdata()) for line in figure.axes[0].lines])
        plt.close(figure)

    def test_means_over_no_whole_turns_are_of_the_last_whole_ones_and_named_so(self):
        case = StirredCase(self.case, 1.08)  # to 2 s: 4.6 turns
        np.testing.assert_allclose(averaged_span(case), (1.2, 2.0))
        self.assertIn("Means of DEM time 1.2 to 2 s, 4 turns.", text_of("".join(stirred_sections.overview(case))))
        figure = stirred_figures.torques(case)
        marks = [line.get_xdata()[0] for line in figure.axes[0].lines if line.get_linestyle() == "--"]
        plt.close(figure)
        np.testing.assert_allclose(marks, [1.2])
        # Of four turns, in which the power is above and below by turns
        self.assertAlmostEqual(read_stirred(case).power.value, 25, delta=1e-6)
        np.testing.assert_allclose(averaged_span(StirredCase(self.case, 1.7)), (1.7, 2.0))

    def test_curves_of_the_torques_begin_where_their_mean_is_over_a_turn(self):
        figure = stirred_figures.torques(StirredCase(self.case))
        first = {line.get_xdata()[0] for line in figure.axes[0].lines if line.get_label() in PARTS}
        plt.close(figure)
        np.testing.assert_allclose(list(first), 0.01 + TURN)
        case = StirredCase(self.case)
        with mock.patch.object(figures, "lines_against", wraps=figures.lines_against) as drawn:
            stirred_sections.compared_torques([case], ["one"])
        self.assertAlmostEqual(drawn.call_args.args[0][0][1][0], (0.01 + TURN) / TURN)

    def test_spectra_are_by_partner_and_have_their_peaks(self):
        found = read_partner_spectra(self.case / "dumps", PARTS)
        self.assertEqual(found.partners, ("balls", *PARTS))
        np.testing.assert_allclose(found.collisions.sum(axis=1), [550, 70, 20, 0, 0])
        np.testing.assert_allclose(found.total.sum(axis=1), [10, 5, 9, 0, 0])
        self.assertAlmostEqual(found.peak().power, 16)
        self.assertAlmostEqual(found.peak("balls").power, 7)
        self.assertAlmostEqual(found.peak("impeller").energy / 1.2589e-5, 1, delta=1e-3)
        self.assertIsNone(found.peak("lid"))
        with self.assertRaisesRegex(DataError, "wall 1; expected -1 to 0"):
            read_partner_spectra(self.case / "dumps", PARTS[:1])

    def test_an_earlier_flow_of_a_mill_without_slurry_is_not_read(self):
        content = json.loads((self.case / "mill.json").read_text())
        content["derived"]["flow"] = None
        (self.case / "mill.json").write_text(json.dumps(content))
        (self.case / "postProcessing" / "flow").mkdir(parents=True)
        (self.case / "0.1").mkdir()
        text = text_of(report_case(self.case))
        self.assertIn("25.00 ± 0.20 W", text)
        self.assertNotIn("The flow is not shown", text)

    def test_the_report_shows_numbers_checks_and_contacts(self):
        text = text_of(report_case(self.case))
        for words in ("25.00 ± 0.20 W", "−0.800 ± 0.004 N m", "0.9900", "power number", "W/kg", "5 m/s",
                      "stirred mill, 155 × 300 mm", "ball on shell", "all contacts over it", "Torque on each part"):
            self.assertIn(words, text)
        self.assertNotIn("ball on lid", text)
        states = {check.name: check.state for check in all_checks(StirredCase(self.case))}
        self.assertEqual(set(states.values()), {"holds"})
        self.assertIn("Contacts dissipate what the drive gives", states)

    def test_missing_torque_and_missing_dissipation_are_seen(self):
        change_json(self.case / "dumps" / "results.json", "part_torques_Nm", "shell", to=0.5)
        change_json(self.case / "dumps" / "results.json", "contacts", "dissipated_over_drive", to=0.9)
        states = {check.name: check.state for check in all_checks(StirredCase(self.case))}
        self.assertEqual(states["Walls at rest take the impeller's torque"], "fails")
        self.assertEqual(states["Contacts dissipate what the drive gives"], "fails")

    def test_torque_on_the_slurry_that_nothing_takes_is_seen(self):
        case = StirredCase(self.case, begin=1.0)
        time = np.linspace(0, 3, 301)
        # Walls and balls give 0.03 N m, which is 3 % of 1 N m on balls and slurry
        torques = {"impeller": 1 - 25 / OMEGA, "shell": -0.15, "base": 0.0, "lid": 0.0,
                   "balls": 0.03 + 0.15 - (1 - 25 / OMEGA), "all": 0.0}
        for scale, state, words in ((1, "holds", r"give 30 mN m more .* 3 % of"), (-2, "fails", "give 60 mN m less")):
            shift = {"balls": 0.03 * (scale - 1)}
            case.__dict__["balance"] = {"Time": time} | {
                f"torque_{part}": np.full_like(time, torque + shift.get(part, 0)) for part, torque in torques.items()}
            check = slurry_torques(case)
            self.assertEqual(check.state, state)
            self.assertRegex(check.found, words)
            # The page puts a full stop after it
            self.assertFalse(check.meaning.endswith("."))

    def test_slip_froude_and_reynolds_number_have_errors_of_blocks_of_written_times(self):
        for keys, value in ((("slurry",), {"density_kg_m3": 1000.0}), (("charge", "sauter_diameter_m"), 0.002)):
            change_json(self.case / "mill.json", "derived", *keys, to=value)
        case = StirredCase(self.case, begin=1.0)
        time = np.linspace(0, 3, 301)
        names = [f"torque_{part}" for part in (*PARTS, "balls", "all")]
        names += ["power", "missing", "holdUp", "z"]
        case.__dict__["balance"] = {"Time": time} | {name: 0 * time + 1 for name in names}
        # Of five blocks of two times; within a block times differ, but not its mean
        blocks = np.array([0.1, 0.2, 0.3, 0.2, 0.2])
        slips = list(np.repeat(blocks, 2) + np.tile([0.05, -0.05], 5))
        one = np.ones(1)
        flow = SlurryFlow(np.zeros((1, 3)), one, one, one, np.zeros((1, 3)), slips, [20 * slip for slip in slips],
                          list(range(10)))
        found = read_stirred_flow(case, flow)
        error, root = blocks.std(ddof=1) / np.sqrt(5), np.sqrt(9.81 * 0.002 * 1.5)
        for mean, scale in ((found.slip, 1), (found.froude, 1 / root), (found.reynolds, 20)):
            np.testing.assert_allclose((mean.value, mean.error), (0.2 * scale, error * scale))
        # Half a watt and one of 25 W
        self.assertAlmostEqual(found.slurry_share.value, 1 / 26, places=3)
        self.assertAlmostEqual(found.slurry_share.error, found.ball_power.error / found.ball_power.value / 26, places=4)

    def test_a_run_without_contacts_or_with_a_damaged_file_has_a_report(self):
        self.assertNotIn("Spectra of energy", report_case(write_stirred(self.folder / "plain")))
        (self.case / "dumps" / "contact_spectra.csv").write_text(HEAD + "0.005,0\n")
        self.assertIn("Contacts cannot be shown", report_case(self.case))

    def test_the_power_for_the_slurry_is_shown_if_there_is_slurry(self):
        change_json(self.case / "mill.json", "derived", "flow", to={"start": {"volume_m3": 1e-3}})
        self.assertIn("25.00 ± 0.20 kW/m³", report_case(self.case))

    def test_stirred_mills_are_compared_with_each_other_only(self):
        other = write_stirred(self.folder / "other", power=30.0)
        text = text_of(compare_cases([self.case, other]))
        for words in ("other compared with one", "30.00 ± 0.20 W", "25.00 ± 0.20 W", "Spectra of energy"):
            self.assertIn(words, text)
        tumbling = write_dry(self.folder / "tumbling")
        with self.assertRaisesRegex(RuntimeError, "expected mills of one machine: .*one is stirred, .* is tumbling"):
            compare_cases([self.case, tumbling])
        with self.assertRaisesRegex(NoMill, "the mill is stirred; expected a tumbling one"):
            MillCase(self.case)
        with self.assertRaisesRegex(RuntimeError, "expected a tumbling one with --measured and --tracer"):
            report_case(self.case, measured=Path("map.csv"))


if __name__ == "__main__":
    unittest.main()
