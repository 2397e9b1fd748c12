#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of balls and slurry in turn: forces for the next pass, changes and their limits, the report of a coupled
mill."""
import json
import shutil
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

from millfoam.coupling import passes
from millfoam.coupling.__main__ import judge, judge_direct, make_forces
from millfoam.coupling.ball_forces import FIELDS, disagreement, relaxed
from millfoam.files.mill_case import MillCase
from millfoam.files.slurry_file import BallForces, read_ball_forces
from millfoam.readings.fluid_on_balls import force_density
from millfoam.readings.means import Mean
from millfoam.report.build import report_case
from millfoam.report.case_readings import Readings
from millfoam.report.coupling_section import (coupling_checks, coupling_section, forces_exchanged, torques_balance,
                                              voxels_are_small)
from report_cases import BALANCE, LENGTH, RADIUS, change_json, write_flow
from report_test import undrawn

SHAPE = (2, 8, 8)
LOWER, UPPER = np.array([-RADIUS, -RADIUS, 0]), np.array([RADIUS, RADIUS, LENGTH])


def uniform(up, exchange=1e4, fluid=0.1, upper=UPPER, shape=SHAPE):
    """Forces on balls of one solidity: upwards of pressure (N/m3), and of drag towards a fluid's velocity along x."""
    pressure, drag, one = np.zeros((*shape, 3)), np.zeros((*shape, 3)), np.ones(shape)
    pressure[..., 1], drag[..., 0] = up, exchange * fluid
    return BallForces(LOWER, upper, one, 0.5 * one, pressure, exchange * one, drag, 0 * drag, 1000 * one, 5e-3 * one,
                      1.0, 1.8, "Beetstra", False, np.array([0, -9.81, 0]))


def add_forces(path, forces, mode="w"):
    """Writes a slurry.h5 with these forces on its balls; with mode "a", adds them to an older one."""
    with h5py.File(path, mode) as file:
        file.attrs.update(format="millfoam-slurry", version=2, complete=1, time0=1.0, window=0.1)
        grid = file.require_group("grid")
        grid.attrs.update(kind="box", lower=forces.lower, upper=forces.upper, shape=forces.inside.shape[::-1],
                          periodic=[0, 0, 0])
        file.require_group("balls").attrs.update(law="Beetstra", polydispersity=0, slurry_density=1500.0,
                                                 air_density=1.2, gravity=forces.gravity)
        mean = file.require_group("mean")
        mean.attrs.update(begin=forces.begin, end=forces.end)
        mean.require_dataset("insideFraction", forces.inside.shape, float)[...] = forces.inside
        for name in FIELDS:
            file[f"mean/balls/{name}"] = getattr(forces, name)
            file[f"mean/balls/{name}"].attrs["units"] = "SI"


class Forces(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_balls_at_rest_feel_pressure_and_drag(self):
        np.testing.assert_allclose(force_density(uniform(9810), np.zeros((*SHAPE, 3)))[1, 3, 4], [1e3, 9810, 0])

    def test_balls_that_move_with_the_fluid_feel_no_drag(self):
        np.testing.assert_allclose(force_density(uniform(0), np.array([0.1, 0, 0])), 0, atol=1e-9)

    def test_relaxation_takes_a_share_of_the_latest(self):
        mixed = relaxed(uniform(1000, 2e4), uniform(2000, 1e4), 0.7)
        np.testing.assert_allclose(mixed.pressure_force[..., 1], 1300)
        np.testing.assert_allclose(mixed.exchange, 1.7e4)

    def test_a_voxel_that_the_mesh_did_not_reach_takes_the_latest(self):
        before = uniform(2000)
        before.inside[0, 3, 4] = 0
        before.pressure_force[0, 3, 4] = 0
        mixed = relaxed(uniform(1000), before, 0.7)
        self.assertEqual(mixed.pressure_force[0, 3, 4, 1], 1000)
        self.assertEqual(mixed.pressure_force[1, 3, 4, 1], 1300)

    def test_forces_on_other_voxels_are_refused(self):
        with self.assertRaisesRegex(ValueError, "expected the same voxels"):
            relaxed(uniform(1), uniform(1, upper=1.1 * UPPER), 0.5)

    def test_disagreement_is_over_the_forces_that_the_flow_gives(self):
        self.assertAlmostEqual(disagreement(uniform(800, 0), uniform(1000, 0)), 0.2)
        self.assertEqual(disagreement(uniform(800), uniform(800)), 0)

    def test_the_first_forces_are_not_relaxed_and_the_next_are(self):
        dry, second, third = (self.folder / name for name in ("dry", "pass_2", "pass_3"))
        for place, up in ((dry, 1000), (second, 2000)):
            write_flow(place)
            change_json(place / "mill.json", "derived", "flow", to={"relaxation": 0.6})
            add_forces(place / "slurry.h5", uniform(up))
        third.mkdir()
        shutil.copy(second / "mill.json", third)
        make_forces(second, dry)
        np.testing.assert_allclose(read_ball_forces(second / "forces.h5").pressure_force[..., 1], 1000)
        make_forces(third, second)
        np.testing.assert_allclose(read_ball_forces(third / "forces.h5").pressure_force[..., 1], 1600)
        with h5py.File(third / "forces.h5") as file:
            self.assertEqual(file.attrs["relaxation"], 0.6)
            self.assertEqual(file["mean/balls/exchange"].attrs["units"], "SI")

    def test_a_force_that_is_not_finite_is_refused_with_its_voxel(self):
        forces = uniform(1)
        forces.exchange[1, 2, 3] = np.nan
        add_forces(self.folder / "slurry.h5", forces)
        with self.assertRaisesRegex(RuntimeError, "exchange is not finite in the voxel z, y, x = 1, 2, 3"):
            read_ball_forces(self.folder / "slurry.h5")


def one_pass(number, toe, charge, error=1.0, noise=0.02):
    quantities = {key: Mean(0.0, 1.0) for key in passes.QUANTITIES} | {"toe": Mean(toe, error)}
    return passes.Pass(number, Path(f"pass_{number}"), quantities, charge, noise, 0.5, 0.05)


class Settling(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.charge = passes.MillCase(write_flow(Path(folder.name) / "case")).charge

    def changes(self, *toes, error=1.0):
        found = [one_pass(number, toe, self.charge, error) for number, toe in enumerate(toes, start=1)]
        return [passes.change(*pair) for pair in zip(found, found[1:])]

    def test_takes_two_passes_without_a_change(self):
        last = one_pass(4, -50, self.charge)
        self.assertFalse(passes.settled(self.changes(-39, -51), last))
        self.assertFalse(passes.settled(self.changes(-39, -51, -50), last))
        self.assertTrue(passes.settled(self.changes(-39, -51, -50, -50), last))
        # Nothing changes either where the balls are hardly given the forces
        self.assertFalse(passes.settled(self.changes(-39, -51, -50, -50), replace(last, disagreement=0.2)))

    def test_a_change_of_more_than_three_errors_counts(self):
        one = self.changes(0.0, 3 * np.sqrt(2) * 1.01)[0]
        self.assertFalse(one.within)
        self.assertEqual(one.largest, "toe of the charge")
        self.assertTrue(self.changes(0.0, 3 * np.sqrt(2) * 0.99)[0].within)

    def test_an_unknown_error_counts_as_a_change(self):
        self.assertFalse(self.changes(0.0, 0.0, error=np.nan)[0].within)

    def test_solidity_may_differ_by_its_noise(self):
        first = one_pass(1, 0.0, self.charge)
        moved = replace(self.charge, solidity=self.charge.solidity + 0.634 * 0.04)
        apart = passes.change(first, one_pass(2, 0.0, moved))
        self.assertAlmostEqual(apart.solidity, 0.04, places=3)
        self.assertFalse(apart.within)
        self.assertEqual(apart.largest, "solidity of the charge")

    def test_noise_is_that_of_maps_over_the_whole_time(self):
        with tempfile.TemporaryDirectory() as folder:
            case = passes.MillCase(write_flow(Path(folder) / "case"))
            windows = case.charge_windows
            noise = passes.map_noise(windows)
        # Each voxel of write_flow's windows has a factor of normal noise of 0.02; a map is the mean of its two layers
        phi = np.nan_to_num(case.charge.solidity) * case.charge.inside
        deviation = 0.02 / np.sqrt(2) * np.sqrt(2 / len(windows))
        expected = np.sqrt(2 / np.pi) * deviation * phi.sum() / case.charge.inside.sum() / 0.634
        self.assertAlmostEqual(noise / expected, 1, delta=0.1)


class Judging(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.case = Path(folder.name) / "case"
        for place in (cls.case, cls.case / "pass_2", cls.case / "pass_3"):
            write_flow(place)
            change_json(place / "mill.json", "derived", "flow", "passes", to=6)
            change_json(place / "mill.json", "derived", "flow", "coupling", to="iterated")
            change_json(place / "mill.json", "derived", "flow", "relaxation", to=0.7)
        for place, up in ((cls.case / "pass_2", 9000), (cls.case / "pass_3", 10000)):
            with h5py.File(place / "slurry.h5") as file:
                shape = tuple(int(count) for count in file["grid"].attrs["shape"][::-1])
                box = {name: file["grid"].attrs[name] for name in ("lower", "upper")}
            add_forces(place / "slurry.h5", replace(uniform(up, 0, shape=shape), **box), "a")
        make_forces(cls.case / "pass_3", cls.case / "pass_2")
        judge(cls.case, 3)

    def test_writes_a_row_per_pass(self):
        lines = (self.case / "coupling.csv").read_text().splitlines()
        self.assertEqual(len(lines), 4)
        self.assertTrue(lines[0].startswith("pass,toe_deg,toe_error_deg,shoulder_deg"), lines[0])

    def test_passes_and_their_forces_are_in_the_result(self):
        content = json.loads((self.case / "coupling.json").read_text())
        self.assertEqual((content["passes"], content["folders"]), (3, [".", "pass_2", "pass_3"]))
        self.assertAlmostEqual(content["force_disagreement"], 0.1, places=6)
        # The flows are shorter than two turns, so that errors of the slurry are not known
        self.assertEqual((content["settled"], content["largest_change"]), (False, "centre of the slurry, x"))

    def test_a_thin_charge_without_a_centre_of_circulation_is_judged_by_the_rest(self):
        def too_thin(*_):
            raise RuntimeError("no centre of circulation")
        with mock.patch.object(passes, "circulation_centre", too_thin):
            thin = passes.read_pass(2, self.case / "pass_2")
        whole = passes.read_pass(2, self.case / "pass_2")
        self.assertTrue(np.isnan(thin.quantities["charge_x"].value) and np.isnan(thin.quantities["charge_y"].error))
        self.assertEqual(thin.quantities["toe"], whole.quantities["toe"])
        self.assertNotIn("charge_x", passes.change(thin, thin).over_limit)
        # One of two passes without it is a change
        self.assertTrue(np.isnan(passes.change(thin, whole).over_limit["charge_x"]))
        self.assertFalse(passes.change(thin, whole).within)

    @mock.patch("millfoam.report.page.encode", undrawn)
    def test_the_report_of_the_last_pass_shows_the_passes_and_their_verdicts(self):
        page = report_case(self.case / "pass_3")
        for words in ("Balls and slurry in turn", "Balls and slurry have settled", "feel the slurry’s force",
                      "differ by 10.0"):
            self.assertIn(words.replace("’", "&#x27;") if words not in page else words, page)
        self.assertNotIn("The slurry would not move the balls", page)

    @mock.patch("millfoam.report.page.encode", undrawn)
    def test_the_report_of_a_mill_that_is_one_way_again_does_not_show_them(self):
        page = report_case(self.case / "pass_2")
        self.assertIn("Balls and slurry have settled", page)
        change_json(self.case / "pass_2" / "mill.json", "derived", "flow", "coupling", to="one_way")
        page = report_case(self.case / "pass_2")
        self.assertNotIn("Balls and slurry have settled", page)
        self.assertIn("The slurry would not move the balls", page)


class AtTheSameTime(unittest.TestCase):
    """Balls and flow that ran at the same time; before the averaged time, forces and torques are other ones."""
    BEGIN, TIME0 = 0.4, 1.0

    @classmethod
    def series(cls, times, *values):
        """Columns [n, 1 + values] of flow times: 9 up to BEGIN, then the values."""
        return np.column_stack([times, *(np.where(times > cls.BEGIN + 1e-9, value, 9.0) for value in values)])

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.case = Path(folder.name) / "case"
        write_flow(cls.case / "direct")
        for keys, value in ((("coupling",), "direct"), (("averages_start_s",), cls.BEGIN)):
            change_json(cls.case / "direct" / "mill.json", "derived", "flow", *keys, to=value)
        place = cls.case / "direct" / "postProcessing" / "flow" / "0" / "steps.csv"
        names, *rows = place.read_text().splitlines()
        more = [f"given_force_{axis}_N" for axis in "xyz"] + ["given_torque_Nm"]
        # What a step gives acts until the next one
        ends = [float(row.split(",")[0]) for row in rows[1:]] + [np.inf]
        given = cls.series(np.array(ends), 3, 4, 0, -0.02)[:, 1:]
        place.write_text("\n".join([",".join([names, *more]), *(
            ",".join([row, *(f"{number:g}" for number in numbers)]) for row, numbers in zip(rows, given))]) + "\n")
        times = np.arange(1, 81) * 0.01
        table = cls.series(times, 3.0, 4.03, 0.0, -0.024, -0.003) + [cls.TIME0, 0, 0, 0, 0, 0]
        np.savetxt(cls.case / "direct" / "dumps" / "fluid.csv", table, "%.8g", ",", comments="",
                   header="time_s,force_x_N,force_y_N,force_z_N,torque_Nm,balance_torque_Nm")
        drive = cls.series(times, 0.5, 3.0) + [cls.TIME0, 0, 0]
        np.savetxt(cls.case / "direct" / "dumps" / "energy.csv", drive, "%.8g", ",", comments="",
                   header="time_s,torque_Nm,power_W")

    def judge(self):
        with mock.patch("builtins.print"):
            judge_direct(self.case)
        return json.loads((self.case / "coupling.json").read_text())

    def test_force_and_torque_by_both_are_compared(self):
        content = self.judge()
        self.assertAlmostEqual(content["force_by_flow_N"], 5, places=9)
        self.assertAlmostEqual(content["force_disagreement"], 0.03 / 5, places=6)
        self.assertAlmostEqual(content["torque_by_flow_Nm"], -0.02, places=9)
        self.assertAlmostEqual(content["torque_by_balls_Nm"], -0.024, places=9)
        self.assertAlmostEqual(content["torque_added"], 0.003 / 0.5, places=9)
        # Over the drive's torque on the balls, not over their own, which may be 0
        self.assertAlmostEqual(content["torque_disagreement"], 0.004 / 0.5, places=9)

    def test_the_report_shows_what_is_not_known(self):
        self.judge()
        for key in ("force_over_weight", "force_disagreement", "torque_by_flow_Nm"):
            change_json(self.case / "coupling.json", key, to=None)
        case = MillCase(self.case / "direct")
        self.assertEqual("".join(coupling_section(case, Readings(case))).count("<td>–</td>"), 3)
        found = forces_exchanged(case)
        self.assertEqual((found.state, found.found),
                         ("unknown", "the mean force of the flow on the balls is 0 or not known"))

    def test_a_flow_that_gives_no_force_is_not_compared(self):
        with mock.patch.object(passes, "given", lambda case: (np.zeros(3), None)):
            self.assertIsNone(self.judge()["force_disagreement"])

    def test_the_torque_that_balls_take_is_compared_with_the_balance_of_the_slurry(self):
        # Of slurryBalance: 0.5 W in all, of which the walls give 0.06 and 0.42 W; the balls give 0.02 W
        self.assertAlmostEqual(self.judge()["torque_unbalanced"], (0.02 + 0.024 * 6) / (3.0 + 0.48), places=3)

    def test_the_balance_counts_up_to_the_last_written_time_as_the_balls_do(self):
        whole = self.judge()["torque_unbalanced"]
        table = self.case / "direct" / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat"
        text = table.read_text()
        self.addCleanup(table.write_text, text)
        # A flow that was killed before it wrote these steps
        last = float(MillCase(self.case / "direct").last)
        after = np.loadtxt(table)[-40:]
        after[:, 0] += last
        after[:, BALANCE.index("power_W")] = 9.0
        with open(table, "a") as file:
            np.savetxt(file, after, "%.9g", "\t")
        self.assertEqual(self.judge()["torque_unbalanced"], whole)

    def test_its_error_is_that_of_the_sum_in_each_turn(self):
        times = np.arange(1, 301) * 0.01  # three turns of 1 s
        swing = np.repeat([-0.3, 0.1, 0.2], 100)
        balance = {"Time": times, "power": 2.0 + swing, "power_shell": 0 * times + 1.0}
        case = SimpleNamespace(machine=MillCase.machine, balance=balance, begin=0.0, last=3.0, turn=1.0, omega=-2.0,
                               flow=SimpleNamespace(time0=self.TIME0))
        # The balls take what the slurry gives, in every turn: only its mean is unbalanced
        alike = passes.unbalanced(case, (times + self.TIME0, (1.0 + swing) / 2), 3.0)
        self.assertAlmostEqual(alike.value, 0, places=9)
        self.assertAlmostEqual(alike.error, 0, places=9)
        apart = passes.unbalanced(case, (times + self.TIME0, (1.0 - swing) / 2), 3.0)
        self.assertAlmostEqual(apart.error, 2 * np.std([-0.3, 0.1, 0.2], ddof=1) / np.sqrt(3) / 4, places=9)
        self.assertEqual(apart.freedom, 2)
        case.turn = 2.0
        self.assertTrue(np.isnan(passes.unbalanced(case, (times + self.TIME0, swing), 3.0).error))

    def test_the_force_is_compared_with_the_flow_s_balance_of_momentum(self):
        self.assertIsNone(self.judge()["force_unbalanced"])
        times = np.arange(1, 301) * 0.01  # three turns of 1 s
        swing = np.repeat([-0.3, 0.1, 0.2], 100)
        balance = {"Time": times, **{f"force_balance_{axis}": value + 0 * times for axis, value in
                                     (("x", 3.0 + swing), ("y", 4.2), ("z", 0.0))}}
        steps = {"time_s": times, **{f"given_force_{axis}_N": value + 0 * times for axis, value in
                                     (("x", 3.0 + swing), ("y", 4.0), ("z", 0.0))}}
        case = SimpleNamespace(balance=balance, begin=0.0, last=3.0, turn=1.0, record=SimpleNamespace(steps=steps))
        # Both swing alike
        apart = passes.unbalanced_force(case, np.array([3.0, 4.0, 0.0]))
        self.assertAlmostEqual(apart.value, 0.2 / 5, places=9)
        self.assertAlmostEqual(apart.error, 0, places=9)
        steps["given_force_y_N"] = 4.0 + swing
        apart = passes.unbalanced_force(case, np.array([3.0, 4.0, 0.0]))
        self.assertAlmostEqual(apart.error, np.std([-0.3, 0.1, 0.2], ddof=1) / np.sqrt(3) / 5, places=9)
        self.assertEqual(apart.freedom, 2)

    def test_a_force_that_momentum_does_not_have_is_judged(self):
        content = self.judge()
        self.addCleanup(self.judge)
        case = MillCase(self.case / "direct")
        for value, reach, state, undecided in ((0.004, 0.015, "holds", False), (0.004, 0.021, "look", True),
                                               (0.05, 0.001, "look", False), (0.2, 0.001, "fails", False)):
            (self.case / "coupling.json").write_text(json.dumps(content | {
                "force_unbalanced": value, "force_unbalanced_error": 0.003, "force_unbalanced_reach": reach}))
            (found,) = (check for check in (make(case) for make in coupling_checks(case))
                        if check.name == "The flow's momentum balances")
            self.assertEqual((found.state, found.undecided), (state, undecided), value)
            self.assertIn(f"by {100 * value:.1f} ± 0.3 % (limit 2 %)", found.found)
        self.assertIn("20.0 ± 0.3 %", "".join(coupling_section(case, Readings(case))))

    def test_an_error_that_hides_the_limit_leaves_it_undecided(self):
        content = self.judge()
        self.assertIsNone(content["torque_unbalanced_error"])
        self.addCleanup(self.judge)
        for reach, state, undecided in ((0.019, "holds", False), (0.021, "look", True)):
            (self.case / "coupling.json").write_text(json.dumps(content | {
                "torque_unbalanced": 0.004, "torque_unbalanced_error": 0.003, "torque_unbalanced_reach": reach}))
            found = torques_balance(MillCase(self.case / "direct"))
            self.assertEqual((found.state, found.undecided), (state, undecided))
            self.assertIn("balance by 0.4 ± 0.3 % of the drive's torque", found.found)

    def test_the_report_judges_both(self):
        self.judge()
        case = passes.MillCase(self.case / "direct")
        checks = {check.name: check for check in (make(case) for make in coupling_checks(case))}
        self.assertEqual(checks["The balls feel the force that the flow gives"].state, "holds")
        torque = checks["The torque between balls and slurry balances"]
        self.assertEqual(torque.state, "look")
        self.assertIn("it differs by 0.8 % of the drive's torque", torque.found)
        self.assertIn("balance by +4.7 % of the drive's torque", torque.found)
        self.assertIn("resolution.cell_size", torque.advice)
        voxels = checks["The voxels are small enough for the balls' torque"]
        self.assertEqual(voxels.state, "holds")
        self.assertIn("0.6 % of the drive's torque", voxels.found)

    def test_the_advice_is_for_the_larger_of_two_differences(self):
        content = self.judge()
        self.addCleanup(self.judge)
        case = passes.MillCase(self.case / "direct")
        for added, words in ((0.01, "shorter time-steps"), (None, "Compute it again")):
            (self.case / "coupling.json").write_text(json.dumps(
                content | {"torque_disagreement": 0.06, "torque_added": added}))
            self.assertIn(words, torques_balance(case).advice)

    def test_voxels_that_add_much_to_the_torque_are_named(self):
        content = self.judge()
        self.addCleanup(self.judge)
        case = passes.MillCase(self.case / "direct")
        for added, state in ((0.09, "holds"), (0.2, "look"), (0.4, "fails")):
            (self.case / "coupling.json").write_text(json.dumps(content | {"torque_added": added}))
            voxels = voxels_are_small(case)
            self.assertEqual(voxels.state, state)
        self.assertIn("averages.voxel_size", voxels.advice)

    def test_runs_without_torques_are_judged_by_the_force_alone(self):
        content = self.judge()
        self.addCleanup(self.judge)
        for key in [key for key in content if key.startswith("torque")]:
            del content[key]
        (self.case / "coupling.json").write_text(json.dumps(content))
        case = passes.MillCase(self.case / "direct")
        self.assertEqual([make(case).name for make in coupling_checks(case)],
                         ["The balls feel the force that the flow gives"])


if __name__ == "__main__":
    unittest.main()
