#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What verification cases call a miss, on made-up results. Nothing is run."""
import contextlib
import io
import itertools
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
from scipy.integrate import solve_ivp

from millfoam.run import copy_case, limit_table, marked
from study_scripts import CASES, load


def load_case(name, script="compare.py"):
    """The script of a verification case as a module; it imports what is in its folder."""
    folder = str(CASES / "verification" / name)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return load(f"verification/{name}/{script}", f"{name}_{Path(script).stem}")


class Dictionaries(unittest.TestCase):
    """Templates of cases."""

    def test_none_is_there_twice(self):
        found = {}
        for path in (CASES / "verification").rglob("*"):
            if path.parent.name in ("0", "constant", "system") and "/runs" not in str(path):
                self.assertEqual(found.setdefault(path.read_text(), path), path)
        self.assertTrue(found)

    def test_a_later_folder_replaces_files_of_earlier_ones(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="verification-")))
        for name, files in (("shared", ("g", "U")), ("own", ("U", "p"))):
            (folder / name / "constant").mkdir(parents=True)
            for file in files:
                (folder / name / "constant" / file).write_text(name)
        copy_case(folder / "case", folder / "shared", folder / "own")
        self.assertEqual({path.name: path.read_text() for path in (folder / "case" / "constant").iterdir()},
                         {"g": "shared", "U": "own", "p": "own"})


class Printed(unittest.TestCase):
    """Cases whose report prints a table and writes it into a file."""

    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="verification-")))

    def report(self, function, results):
        """Number of missed limits, and the table."""
        with contextlib.redirect_stdout(io.StringIO()):
            missed = function(results, self.folder / "table.txt")
        return missed, (self.folder / "table.txt").read_text()


class Limits(unittest.TestCase):
    ROWS = [("at its limit", 0.2, 0.2), ("beyond", 0.20004, 0.2), ("none", np.nan, 1e-14), ("within", -7.125e-16, 1.0)]

    def test_what_is_beyond_its_limit_or_no_number_is_marked_and_counted(self):
        lines, missed = limit_table(self.ROWS)
        self.assertEqual(missed, 2)
        self.assertEqual(lines, ["                  found    allowed",
                                 "at its limit        0.2        0.2",
                                 "beyond              0.2        0.2  MISSED",
                                 "none                nan      1e-14  MISSED",
                                 "within       -7.125e-16          1"])

    def test_aims_have_other_words(self):
        lines, missed = limit_table(self.ROWS[:2], "aim", "above the aim")
        self.assertEqual(([line.split()[-1] for line in lines], missed), (["aim", "0.2", "aim"], 1))
        self.assertTrue(lines[2].endswith("0.2  above the aim"), lines[2])

    def test_a_line_names_the_limits_that_it_missed(self):
        for missed, end in ((False, ""), (True, "  MISSED"), ([], ""), (["mean", "spread"], "  MISSED: mean, spread")):
            self.assertEqual(marked("tank  1.0", missed), "tank  1.0" + end)

    def test_a_table_without_rows_has_its_head_alone(self):
        self.assertEqual(limit_table([]), (["      found    allowed"], 0))


class RotatingDrum(unittest.TestCase):
    def setUp(self):
        self.case = load("verification/rotating_drum/compare.py", "rotating_drum")

    def missed(self, rms, angle=27.0, zero=0.059):
        value = np.array([angle, 0.03, zero, rms, 0.4, 0.95])
        return self.case.Found("run", (), value, 0 * value, 0.012, None, None, 0.12, -1.2).missed

    def test_the_velocity_is_judged_beyond_what_no_charge_can_meet(self):
        # 0.0156 is the root of 0.012 squared plus 0.01 squared
        for rms, missed in ((0.012, []), (0.0156, []), (0.0157, ["velocity"]), (np.nan, ["velocity"])):
            self.assertEqual(self.missed(rms), missed)
        self.assertEqual(self.missed(0.012, angle=29.0, zero=np.nan), ["angle", "zero"])

    def test_the_best_charge_that_the_drum_drags_has_the_least_rms(self):
        depth, omega = np.linspace(0.061, 0.12, 40), -1.2
        drum = omega * depth
        measured = depth, np.where(depth > 0.09, 1.2, 0.8) * drum
        least = self.case.least_rms(measured, omega)
        best = np.maximum(measured[1], drum)
        self.assertAlmostEqual(np.sqrt(np.mean((best - measured[1])**2)), least)
        for slower in (0.9, 0.7):
            # A charge that is slower: its excess is at least its difference from the best one
            rms = np.sqrt(np.mean((slower * best - measured[1])**2))
            found = self.case.Found("run", (), np.array([27, 0.03, 0.059, rms]), 0, least, None, None, 0.12, omega)
            self.assertGreaterEqual(found.excess, np.sqrt(np.mean((slower * best - best)**2)))

    def test_options_that_replace_each_others_runs_are_refused(self):
        for words in (("scan", "--quick"), ("full", "--read", "a"), ("--quick", "--read", "a")):
            errors = io.StringIO()
            with mock.patch.object(sys, "argv", ["compare.py", *words]), contextlib.redirect_stderr(errors), \
                    mock.patch.object(self.case, "run_jobs", side_effect=AssertionError), \
                    self.assertRaises(SystemExit) as end:
                self.case.main()
            self.assertEqual(end.exception.code, 2)
            self.assertIn("expected only one of the three", errors.getvalue())


class ResidenceTime(unittest.TestCase):
    def missed(self, mean=1.0, spread=1.0, missing=0.0, lowest=0.0, highest=1.0):
        case = load("verification/residence_time/compare.py", "residence_time")
        vessel = case.Vessel("tank", 1, 0.0, 0.1, 0.0, "upwind", 8.0, 1.0, 1e-2)
        return case.Run(vessel, SimpleNamespace(missing=missing, lowest=lowest, highest=highest),
                        SimpleNamespace(mean=mean * vessel.mean, spread=spread)).missed

    def test_what_is_not_a_number_misses_its_limit(self):
        self.assertEqual(self.missed(), [])
        self.assertEqual(self.missed(mean=1.02, spread=1.1, missing=1e-9, highest=1.01),
                         ["mean", "spread", "conserved", "bounded"])
        self.assertEqual(self.missed(mean=np.nan), ["mean"])
        self.assertEqual(self.missed(spread=np.nan), ["spread"])
        self.assertEqual(self.missed(missing=np.nan, lowest=np.nan), ["conserved", "bounded"])


class Displacement(Printed):
    def setUp(self):
        super().setUp()
        self.case = load("verification/displacement/compare.py", "displacement")

    def result(self, name, pressure=0.0):
        """An exact result of a box, with an error of the pressure over the largest one."""
        case, (kind, step) = self.case, self.case.RUNS[name]
        times = np.array([0.02, case.END])
        levels = np.array([case.expected_level(kind, time) for time in times])
        share = np.clip(levels[:, None] / case.LAYER - np.arange(case.LAYERS), 0, 1)[..., None].repeat(case.COLUMNS, 2)
        exact = case.bottom_pressure(times)
        return case.Displacement(name, kind, times, share, 0.0, times, exact + pressure * exact.max(),
                                 step)

    def test_an_exact_result_holds_and_one_that_is_not_a_number_does_not(self):
        self.assertFalse(self.result("open").misses())
        self.assertTrue(self.result("open", pressure=0.03).misses())
        self.assertTrue(self.result("open", pressure=np.nan).misses())
        one = self.result("open")
        one.share[-1, 3, 0] = np.nan
        self.assertTrue(one.misses())

    def test_the_table_marks_what_missed(self):
        _, table = self.report(self.case.print_table, [self.result("open"), self.result("open", pressure=0.03)])
        self.assertEqual([line.endswith("  MISSED") for line in table.splitlines()[1:3]], [False, True])

    def test_of_the_closed_box_no_pressure_is_judged(self):
        self.assertFalse(self.result("closed").misses())
        self.assertFalse(self.result("closed", pressure=np.nan).misses())


class FallingHead(Printed):
    def setUp(self):
        super().setUp()
        self.case = load_case("falling_head")

    def fall(self, name, share=1.0):
        """An exact fall in a column, for a share of its duration."""
        column = next(column for column in self.case.COLUMNS if column.name == name)
        time = np.linspace(0, share * column.end, 41)
        return self.case.Fall(column, time, column.levels(time))

    def test_every_error_that_is_not_a_number_misses_its_limit(self):
        fall = self.fall("tailwater")
        self.assertFalse(fall.misses())
        for key in ("error", "closed_error", "fitted_time"):
            with self.subTest(key), mock.patch.object(self.case.Fall, key, np.nan):
                self.assertTrue(fall.misses())

    def test_a_run_that_ended_early_misses(self):
        self.assertFalse(self.fall("Ergun").misses())
        short = self.fall("Ergun", share=0.5)
        self.assertTrue(short.misses())
        _, table = self.report(self.case.print_table, [self.fall("Ergun"), short])
        end = short.column.end
        self.assertFalse(table.splitlines()[1].endswith("MISSED"))
        self.assertTrue(table.splitlines()[2].endswith(f"  ended at {end / 2:g} of {end:g} s  MISSED"))

    def test_a_grate_that_discharges_as_no_orifice_does_misses(self):
        for name, least, most in (("grate", 0.603, 0.651), ("pegged", 0.603, 0.630)):
            fall = self.fall(name)
            for coefficient, misses in ((least - 1e-3, True), (least + 1e-3, False), (most - 1e-3, False),
                                        (most + 1e-3, True), (np.nan, True)):
                with self.subTest(name, coefficient=coefficient), \
                        mock.patch.object(self.case.Fall, "errors", []), \
                        mock.patch.object(self.case.Fall, "discharge_coefficient", coefficient):
                    self.assertEqual(fall.misses(), misses)
            self.assertFalse(fall.misses())
            self.assertAlmostEqual(fall.discharge_coefficient,
                                   1 / (fall.column.open_share * np.sqrt(fall.column.loss)), delta=2e-3)


class GrateRing(Printed):
    def setUp(self):
        super().setUp()
        self.case = load_case("grate_ring")

    def drain(self, pool, factor=1.0, share=1.0):
        """A pool that drains by the closed form, for a share of the case's duration; factor: on its discharge alone."""
        time = np.linspace(0, share * self.case.END, 41)
        volume = solve_ivp(lambda _, v: [-pool.discharge(self.case.level_of(v[0]))], (0, time[-1]),
                           [self.case.hold_up(pool.level)], t_eval=time, rtol=1e-10, atol=1e-14).y[0]
        flow = np.array([pool.discharge(self.case.level_of(one)) for one in volume])
        return self.case.Drain(pool, time, volume, factor * flow)

    def test_far_below_the_surface_a_ring_is_a_hole_at_the_depth_of_its_centre(self):
        # sqrt(h) over a disc of radius r: pi r^2 sqrt(h) (1 - r^2/(32 h^2) - ...)
        def disc(radius, depth):
            return np.pi * radius**2 * np.sqrt(2 * 9.81 * depth) * (1 - radius**2 / (32 * depth**2))

        for depth in (0.5, 2.0):
            self.assertAlmostEqual(self.case.ring_orifice(depth, 0.09, 0.13) / (disc(0.13, depth) - disc(0.09, depth)),
                                   1, delta=1e-4)

    def test_a_shallow_pool_at_its_lower_end_is_a_segment_of_a_disc(self):
        # The chord 2 sqrt(2 r s) at a height s above the end, and the integral of sqrt(s (h - s)) ds, pi h^2/8
        height = 1e-5
        expected = 2 * np.sqrt(2 * 0.13) * np.sqrt(2 * 9.81) * np.pi * height**2 / 8
        self.assertAlmostEqual(self.case.ring_orifice(height - 0.13, 0.09, 0.13) / expected, 1, delta=1e-3)

    def test_a_level_holds_its_volume(self):
        self.assertAlmostEqual(self.case.hold_up(0.0), np.pi * 0.15**2 / 2 * 0.06)
        self.assertAlmostEqual(self.case.level_of(self.case.hold_up(-0.04)), -0.04)

    def test_each_limit_that_is_missed_is_named(self):
        for pool in self.case.POOLS:
            self.assertEqual(self.drain(pool).misses(), [])
            self.assertEqual(self.drain(pool, factor=1.03).misses()[0], "discharge")
        pool = self.case.POOLS[0]
        self.assertEqual(self.drain(pool, factor=np.nan).misses(), ["discharge", "orifice"])
        self.assertEqual(self.drain(pool, share=0.5).misses(), ["ended early"])
        slow = self.drain(pool)
        slow.volume = slow.volume[0] + 0.9 * (slow.volume - slow.volume[0])
        self.assertIn("what has left", slow.misses())

    def test_the_table_names_pools_and_misses(self):
        _, table = self.report(self.case.print_table, [self.drain(self.case.POOLS[0]),
                                                       self.drain(self.case.POOLS[1], factor=1.03)])
        self.assertTrue(table.splitlines()[1].startswith("open "))
        self.assertTrue(table.splitlines()[2].endswith("  MISSED: discharge"))


class Sloshing(Printed):
    def setUp(self):
        super().setUp()
        self.case = load_case("sloshing")

    def missed(self, *histories):
        return self.report(self.case.report, histories)[0]

    def test_a_deviation_in_a_bed_that_is_not_a_number_misses(self):
        run = self.case.Run("box", "slurryFoam", bed=True)
        wave = self.case.theory(run)
        time = np.linspace(0, self.case.BED_DECAY / wave.slow_rate, 81)
        history = self.case.History(run, time, 0.003 * wave.from_rest(time), 0.0)
        self.assertEqual(self.missed(history), 0)
        history.elevation[1] = np.nan  # before the time from which on the rate is fitted
        self.assertEqual(self.missed(history), 1)

    def free(self, solver, decay):
        run = self.case.Run("box", solver, periods=2)
        omega = self.case.theory(run).omega
        time = np.linspace(0, 4 * np.pi / omega, 41)
        noise = 1e-6 * np.sin(50 * time)  # without any, the fit has no covariance
        return self.case.History(run, time, 0.003 * np.exp(-decay * time) * np.cos(omega * time) + noise, 0.0)

    def test_a_wave_is_not_damped_more_than_by_interfoam(self):
        self.assertEqual(self.missed(self.free("slurryFoam", 0.008)), 0)
        self.assertEqual(self.missed(self.free("slurryFoam", 0.04)), 1)
        self.assertEqual(self.missed(self.free("slurryFoam", 0.04), self.free("interFoam", 0.05)), 0)
        self.assertEqual(self.missed(self.free("slurryFoam", 0.02), self.free("interFoam", 0.01)), 1)


class ThroughFlow(unittest.TestCase):
    def setUp(self):
        self.case = load_case("through_flow")

    def flow(self, mesh, bed, cells, error=0.0):
        """A steady, exact flow, or one with an error of the velocity."""
        x = (np.arange(cells) + 0.5) * self.case.LENGTH / cells
        own = self.case.BEDS[bed]
        pressure = np.where((own.begin < x) & (x < own.end), 0, own.dynamic)
        return self.case.Flow(mesh, bed, cells, 0, x, own.velocity(x), 0.0, pressure, 0.0, error, 0.0)

    def test_a_jump_that_is_not_a_number_misses(self):
        for begin, _ in self.case.PLATEAUS:
            flow = self.flow("aligned", "edges", self.case.EDGE_CELLS)
            self.assertEqual(list(self.case.misses([flow])), [])
            flow.p[np.argmax(flow.x > begin)] = np.nan
            with self.subTest(begin=begin):
                self.assertEqual(list(self.case.misses([flow])), ["edges, aligned, 64 cells: jump"])

    def test_an_order_from_an_error_that_is_not_a_number_misses(self):
        # On slanted meshes the errors themselves have no limits
        for coarse, missed in ((0.04, False), (0.02, True), (np.nan, True)):
            found = list(self.case.misses([self.flow("slanted", "ramps", 64, coarse),
                                           self.flow("slanted", "ramps", 128, 0.01)]))
            self.assertEqual(found, ["ramps, slanted, 128 cells: order of the velocity"] * missed)


class Bingham(unittest.TestCase):
    def converges(self, case, *errors):
        """Of three plugs of either regularisation, of which one has these errors."""
        flows = [SimpleNamespace(solver="slurryFoam", regularisation=name, stiffness=stiffness, profile_error=error)
                 for name, row in zip(case.REGULARISATIONS, ((0.3, 0.2, 0.1), errors))
                 for stiffness, error in zip((0.1, 0.3, 1), row)]
        return case.converges(flows)

    def test_errors_that_are_not_numbers_or_not_there_do_not_converge(self):
        for name in ("bingham_couette", "bingham_poiseuille"):
            case = load_case(name)
            with self.subTest(name):
                self.assertTrue(self.converges(case, 0.3, 0.2, 0.1))
                self.assertTrue(self.converges(case, 0.3))
                for errors in ((0.3, 0.1, 0.2), (0.3, 0.2, 0.2), (0.3, np.nan, 0.1), (0.3, 0.2, np.nan), ()):
                    self.assertFalse(self.converges(case, *errors))


class CarriedAlong(Printed):
    def test_a_run_that_ended_early_misses(self):
        case = load_case("carried_along")
        run = case.Run(False, False, 0, 1e-3, case.FULL_END)
        radius = np.linspace(0.01, 0.14, 20)
        for times, missed in ((np.linspace(0, run.end, 21), 0), (np.zeros(1), 1)):
            flow = case.SpinUp(times, radius, np.zeros((len(times), 20)), np.ones(20), False)
            flow.speed = flow.exact
            self.assertEqual(self.report(case.report, {run: flow})[0], missed)


class DiscThroughJumps(unittest.TestCase):
    def test_a_time_without_a_number_or_not_written_misses(self):
        case = load_case("disc_through_jumps")
        run = case.Run("at rest", "aligned", 128)
        discs = [case.Disc(time, None, None, None, 0, 0, 0, 0, 0) for time in range(case.RECORDS + 1)]
        self.assertFalse(case.missed(run, discs))
        self.assertTrue(case.missed(run, discs[:-1]))
        discs[3].shape = np.nan
        self.assertTrue(case.missed(run, discs))


class Rest(Printed):
    def test_a_run_that_ended_early_or_moves_misses(self):
        case = load_case("rest")
        time = np.linspace(0, case.POOL_END, 21)

        def missed(steps=case.FLUID_STEPS, records=21, fluid=1e-15, air=1.0):
            speeds = np.column_stack([1e-3 * np.arange(steps), np.full(steps, fluid)])
            pool = case.Pool(time, air + 0 * time, 0.04 + 0 * time, 0.01 + 0 * time, 1 + 0 * time)
            for name, values in vars(pool).items():
                setattr(pool, name, values[:records])
            return self.report(lambda found, out: case.report(found, pool, out), {"slice": speeds})[0]

        self.assertEqual(missed(), 0)
        for one in (dict(steps=case.FLUID_STEPS - 1), dict(steps=case.FLUID_STEPS + 1), dict(records=20),
                    dict(fluid=1e-13), dict(fluid=np.nan),
                    dict(air=3.0), dict(air=np.nan)):
            self.assertEqual(missed(**one), 1, one)


class Transport(unittest.TestCase):
    def test_what_is_not_a_number_misses_its_limit(self):
        case = load_case("rest", "transport.py")
        for moved, change, missed in ((4e-4, 1e-9, ""), (6e-4, 1e-9, "distance"), (np.nan, 1e-9, "distance"),
                                      (4e-4, 1e-7, "volume"), (4e-4, np.nan, "volume"),
                                      (np.nan, np.nan, "distance, volume")):
            found = {"slurryFoam": (moved, change, 46, 45), "interFoam": (1e-3, 1e-3, 46, 92)}
            lines, count = case.judge("ogrid", found)
            self.assertEqual(len(lines), 3)
            self.assertEqual(count, len(missed.split()))
            self.assertTrue(lines[-1].endswith(f"  MISSED: {missed}" if missed else "allowed 0.5"), lines[-1])


class Pool(unittest.TestCase):
    def setUp(self):
        self.table = load_case("rest", "pool_table.py")
        self.runs = load_case("rest", "pool_history.py")

    def history(self, end, rms):
        time = np.linspace(0, end, 41)
        flat = np.ones(41)
        return self.runs.History(time, rms * flat, rms * flat, rms * flat, 0 * flat, flat, 0 * flat, 1e3 * time)

    def judge(self, reached, rms, own=1e-9):
        """Judged are a run of slurryFoam and one of interFoam that reached this time."""
        return self.table.judge({self.runs.Run("ogrid", "slurryFoam", 0.07, False): self.history(1.0, own),
                                 self.runs.Run("ogrid", "interFoam", 0.07, False): self.history(reached, rms)}, 1.0)

    def test_a_run_that_diverged_is_no_reference(self):
        text, missed = self.judge(1.0, 0.04)
        self.assertEqual(missed, 0)
        self.assertIn("over interFoam's", "\n".join(text))
        text, missed = self.judge(0.3, 1e30)
        self.assertEqual(missed, 1)
        self.assertNotIn("over interFoam's", "\n".join(text))
        self.assertEqual([line.split() for line in text if line.endswith("MISSED")], [
            [*"ogrid, static, sigma 0.07: interFoam ended early and is no reference, s short".split(),
             "0.7", "1e-06", "MISSED"]])

    def test_a_speed_that_is_not_a_number_misses(self):
        self.assertEqual(self.judge(1.0, np.nan)[1], 1)
        self.assertGreater(self.judge(1.0, 0.04, own=np.nan)[1], 1)

    def test_what_is_aimed_at_is_reported_and_misses_nothing(self):
        with mock.patch.multiple(self.table, AIM_SLURRY=1e-10, AIM_AIR=1e-8):
            text, missed = self.judge(1.0, 0.04)
        self.assertEqual(missed, 0)
        aims = text[text.index("slurryFoam: aims"):]
        self.assertEqual([line.endswith("  above the aim") for line in aims], [False, False, True, False])

    def test_without_slurryfoam_nothing_is_judged(self):
        run = self.runs.Run("ogrid", "interFoam", 0.07, False)
        self.assertEqual(self.table.judge({run: self.history(1.0, 1.0)}, 1.0), ([], 0))


class StirredWalls(Printed):
    def test_the_table_is_printed_and_names_what_missed(self):
        case = load_case("stirred_walls")
        rows = [("within", 0.1, 0.2), ("beyond", 0.3, 0.2), ("no number", np.nan, 0.2)]
        words = io.StringIO()
        with mock.patch.multiple(case, HERE=self.folder, run_jobs=mock.Mock(return_value=[]), draw=mock.Mock(),
                                 table=lambda *_: (rows, {})), \
                mock.patch.object(sys, "argv", ["compare.py"]), contextlib.redirect_stdout(words):
            self.assertEqual(case.main(), 1)
        lines = words.getvalue().splitlines()
        self.assertEqual([line.endswith("  MISSED") for line in lines], [False, False, True, True])
        self.assertEqual((self.folder / "stirred_walls.txt").read_text(), words.getvalue())


class PressureDrop(unittest.TestCase):
    def setUp(self):
        self.case = load_case("pressure_drop")
        self.rows = list(itertools.product(self.case.published_laws.GRADIENTS, self.case.SOLIDITIES,
                                           self.case.REYNOLDS))

    def made(self, function):
        """What a function makes of these rows of millDrag."""
        table = "law,phi,Re,beta\n" + "".join(f"{law},{phi:g},{re:g},1\n" for law, phi, re in self.rows)
        with mock.patch.object(self.case.subprocess, "run", return_value=SimpleNamespace(stdout=table)):
            return function()

    def test_there_are_beds_of_every_published_law(self):
        for function, count in ((self.case.beds, 1820), (self.case.quick_beds, 42)):
            found = self.made(function)
            self.assertEqual(len(found), count)
            self.assertEqual({bed.law for bed in found}, set(self.case.published_laws.GRADIENTS))

    def test_a_row_that_milldrag_does_not_print_is_named(self):
        whole = self.rows
        without = [row for row in whole if row[0] != "Tang"]
        for self.rows, words in ((without, "not printed by millDrag: Tang, phi 0.15, Re 0.5; Tang, "),
                                 (whole[:-1], "not printed by millDrag: Tenneti, phi 0.5, Re 2000$"),
                                 ([*whole, ("Stokes", 0.5, 5)], "not in published_laws.py: Stokes, phi 0.5, Re 5$"),
                                 ([], "not printed by millDrag")):
            for function in (self.case.beds, self.case.quick_beds):
                with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                    self.made(function)

    def test_every_quick_entry_has_a_bed(self):
        for phi, re, laws in ((0.3, 50.0, ()), (0.5, 40.0, ()), (0.5, 50.0, ("Ergun", "Stokes"))):
            quick = (*self.case.QUICK, ("slurryFoam", phi, (8, 4), re, laws))
            with mock.patch.object(self.case, "QUICK", quick), self.assertRaisesRegex(ValueError, "QUICK: "):
                self.made(self.case.quick_beds)


if __name__ == "__main__":
    unittest.main()
