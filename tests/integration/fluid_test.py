#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""millDem with a fluid: single balls and a bed at rest against closed forms, runs that are killed, and runs that
continue from the last state of another case."""
import json
import os
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from millfoam.run import RunError, run
from waiting import wait_for

GRAVITY = 9.81
BALL, SLURRY = 2700, 1239  # kg/m3, of glass and of the slurry
RADIUS, LENGTH = 0.03, 0.03  # m, of the drum
MILL = """
geometry: {diameter: 0.06, length: 0.03, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.7, sense: clockwise}
charge: {classes: [{diameter: 0.004, mass: MASS}], start_radius: 0.02}
materials: {ball: glass, wall: HDPE}
dem: {youngs_modulus: 1e7, settle_time: 0.1, duration: 0.2, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {voxel_size: 0.006, window: 0.05, start: 0.1}
resolution: {cell_size: 0.003, layers: 4}
"""
ONE_BALL = BALL * np.pi / 6 * 0.004 ** 3  # kg
# A ball that is put near the axis and falls freely until it reaches a wall, 0.07 s later
FALLING = MILL.replace("MASS", "9e-5").replace("start_radius: 0.02", "start_radius: 0.004").replace(
    "settle_time: 0.1, duration: 0.2", "settle_time: 0, duration: 0.06").replace(
        "averages: {voxel_size: 0.006, window: 0.05, start: 0.1}\n", "")
BALLS = 216
BED = MILL.replace("MASS", str(BALLS * ONE_BALL)).replace("youngs_modulus: 1e7", "youngs_modulus: 5e6")
SHORT_BED = BED.replace("averages: {voxel_size: 0.006, window: 0.05, start: 0.1}\n", "")


def read_json(path):
    return json.loads(path.read_text())


def read_table(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def read_dumps(case):
    """{step: columns id type x y z vx vy vz radius, sorted by id} of all dumps."""
    dumps = {}
    for path in (case / "dumps").glob("dump.*.txt"):
        table = np.loadtxt(path, skiprows=9, ndmin=2)
        dumps[int(path.name.split(".")[1])] = table[np.argsort(table[:, 0])]
    return dict(sorted(dumps.items()))


def write_slurry(path, pressure_force=(0, SLURRY * GRAVITY, 0), exchange=0.0, velocity=(0, 0, 0), flow="", version=2):
    """A slurry.h5 of one window with uniform fields on 5 x 5 x 3 voxels over the drum."""
    shape = (3, 5, 5)
    ones = np.ones(shape)
    fields = {"pressure_force": ones[..., None] * np.array(pressure_force, dtype=float), "exchange": exchange * ones,
              "drag_force": exchange * ones[..., None] * np.array(velocity, dtype=float),
              "fluid_density": SLURRY * ones, "solidity": 0 * ones, "diameter": 0.004 * ones}
    with h5py.File(path, "w") as file:
        file.attrs.update(format=np.bytes_("millfoam-slurry"), version=version, complete=1, time0=0.0, window=1.0)
        if flow:
            file.attrs["mill_flow"] = np.bytes_(flow)
        grid = file.create_group("grid")
        grid.attrs.update(kind=np.bytes_("box"), lower=[-RADIUS, -RADIUS, 0.0], upper=[RADIUS, RADIUS, LENGTH],
                          shape=[5, 5, 3], periodic=[0, 0, 1])
        grid["insideFraction"] = ones[None]
        file["window/begin"], file["window/end"] = [0.0], [1.0]
        file["mean/insideFraction"] = ones
        file["mean"].attrs.update(begin=0.0, end=1.0)
        balls = file.create_group("balls")
        balls.attrs.update(law=np.bytes_("Beetstra"), polydispersity=0, slurry_density=float(SLURRY), air_density=1.2,
                           gravity=[0, -GRAVITY, 0])
        for name, values in fields.items():
            balls[name] = values[None]
            file[f"mean/balls/{name}"] = values


class FluidCase(unittest.TestCase):
    def make_case(self, text):
        case = Path(tempfile.mkdtemp(prefix="fluid-"))
        self.addCleanup(shutil.rmtree, case)
        (case / "mill.yaml").write_text(text)
        run(case, "millMesh", "mill.yaml", "--case", ".", "--walls")
        return case

    def run_mill(self, case, *options):
        return run(case, "millDem", "mill.yaml", "--case", ".", *options)

    def velocities(self, case):
        """Times, s, and velocities of the one ball at the records, m/s."""
        step = read_json(case / "dumps" / "run.json")["timestep_s"]
        dumps = read_dumps(case)
        return np.array(list(dumps)) * step, np.array([table[0, 5:8] for table in dumps.values()])


class OneBall(FluidCase):
    """The time-step is 18 us, so that a ball's speed is that of the closed form to half of K dt/rho, 4e-4; without drag
    to the digits of the dumps and of the time of its insertion, one step."""

    def test_in_a_resting_pool_it_falls_with_its_buoyant_weight(self):
        expected = (1 - SLURRY / BALL) * GRAVITY
        case = self.make_case(FALLING)
        pool = ("--set", "dem.fluid=buoyancy", "--set", "dem.fluid_level=0.03")
        write_slurry(case / "slurry.h5")
        for options in (pool, ("--fluid", "slurry.h5")):
            self.run_mill(case, *options)
            times, speeds = self.velocities(case)
            fall = np.polyfit(times, speeds[:, 1], 1)
            self.assertAlmostEqual(-fall[0], expected, delta=1e-6 * expected)
            np.testing.assert_allclose(speeds[:, [0, 2]], 0, atol=1e-9)
            force = read_table(case / "dumps" / "fluid.csv")["force_y_N"]
            np.testing.assert_allclose(force, SLURRY / BALL * ONE_BALL * GRAVITY, rtol=1e-7)
            found = read_json(case / "dumps" / "results.json")["fluid"]
            self.assertAlmostEqual(found["force_N"][1] / force[0], 1, delta=1e-7)
            self.assertEqual(found["balls_without_field"], 0)

    def test_half_out_of_the_pool_it_feels_the_part_that_is_below(self):
        case = self.make_case(FALLING.replace("duration: 0.06, record_interval: 0.005",
                                              "duration: 0.001, record_interval: 0.0001"))
        self.run_mill(case, "--set", "dem.fluid=buoyancy", "--set", "dem.fluid_level=0.03")
        height = next(iter(read_dumps(case).values()))[0, 3]
        self.run_mill(case, "--set", "dem.fluid=buoyancy", "--set", f"dem.fluid_level={height:.9f}")
        force = read_table(case / "dumps" / "fluid.csv")["force_y_N"]
        # It sinks by 3 um in this time, of a radius of 2 mm
        self.assertAlmostEqual(force[0] / (SLURRY / BALL * ONE_BALL * GRAVITY), 0.5, delta=2e-3)

    def test_in_moving_fluid_it_follows_the_closed_form_on_one_and_two_ranks(self):
        exchange, wind = BALL / 0.02, np.array([0.05, -0.1, 0.2])
        weight = np.array([0, -(1 - SLURRY / BALL) * GRAVITY, 0])
        end = wind + weight * BALL / exchange
        case = self.make_case(FALLING)
        write_slurry(case / "slurry.h5", exchange=exchange, velocity=wind)
        for ranks in (1, 2):
            self.run_mill(case, "--fluid", "slurry.h5", "-np", ranks)
            times, speeds = self.velocities(case)
            left = np.exp(-exchange / BALL * times)[:, None]
            expected = end + (speeds[0] - end) * left
            np.testing.assert_allclose(speeds, expected, atol=1e-3 * np.abs(end).max())
            table = read_table(case / "dumps" / "fluid.csv")
            self.assertEqual(len(table), 12)
            # Means over the records
            middle = (times[1:] + times[:-1]) / 2
            drag = exchange * np.pi / 6 * 0.004 ** 3 * (wind[1] - np.interp(middle, times, speeds[:, 1]))
            np.testing.assert_allclose(table["drag_y_N"], drag, atol=0.02 * np.abs(drag).max())
            impulse = np.sum(table["force_y_N"] - ONE_BALL * GRAVITY) * 0.005
            self.assertAlmostEqual(impulse / (ONE_BALL * (speeds[-1] - speeds[0])[1]), 1, delta=1e-3)

    def test_what_cannot_push_the_balls_is_refused(self):
        case = self.make_case(FALLING)
        for options, message in (
                ({"version": 1}, "slurry.h5: is of version 1, which has no forces on balls .*run the flow again"),
                ({"flow": "0123456789abcdef"}, r"slurry.h5: the flow is of another mill \(flow 0123456789abcdef, this"),
                ({"exchange": float("nan")},
                 r"'mean/balls/exchange' is not finite in voxel x y z = \(0, 0, 0\), whose centre is \(-0.024,"),
                ({"exchange": 1e8}, r"K = 1e.08 .* expected at most 0.05: lower dem.rayleigh_fraction")):
            write_slurry(case / "slurry.h5", **options)
            with self.assertRaisesRegex(RunError, message):
                self.run_mill(case, "--fluid", "slurry.h5")
        write_slurry(case / "slurry.h5")
        with h5py.File(case / "slurry.h5", "a") as file:
            file["grid"].attrs["upper"] = [0.02, RADIUS, LENGTH]
        with self.assertRaisesRegex(RunError, "the voxels reach from .* expected the period of the mill, from"):
            self.run_mill(case, "--fluid", "slurry.h5")
        self.assertFalse((case / "dumps").exists())
        with self.assertRaisesRegex(RunError, r"key 'dem.fluid_level' .*expected a height in m"):
            self.run_mill(case, "--set", "dem.fluid=buoyancy")


class Bed(FluidCase):
    def test_a_bed_at_rest_presses_on_the_walls_with_its_buoyant_weight(self):
        text = SHORT_BED.replace("fraction_of_critical: 0.7", "fraction_of_critical: 0.001").replace(
            "settle_time: 0.1, duration: 0.2", "settle_time: 0.6, duration: 0.1, contact_interval: 0.0002")
        case = self.make_case(text)
        self.run_mill(case, "--set", "dem.fluid=buoyancy", "--set", "dem.fluid_level=0.03")
        results = read_json(case / "dumps" / "results.json")
        weight = (1 - SLURRY / BALL) * results["simulated_mass_kg"] * GRAVITY
        forces = []
        for path in (case / "contacts").glob("walls.*.txt"):
            table = np.loadtxt(path, skiprows=9, ndmin=2)
            forces.append(table[:, 15:18].sum(axis=0))
        force = np.mean(forces, axis=0)
        self.assertEqual(results["balls"], BALLS)
        dumps = list(read_dumps(case).values())
        gained = ONE_BALL * (dumps[-1][:, 5:8] - dumps[0][:, 5:8]).sum(axis=0) / 0.1
        print(f"force on the floor over the buoyant weight: {force[1] / weight:.6f}, momentum {gained[1] / weight:.1e}")
        self.assertAlmostEqual(force[1] / weight, 1, delta=1e-3)
        self.assertLess(abs(force[0]) / weight, 1e-3)


class Passes(FluidCase):
    def start_and_kill(self, case, *options):
        """Starts the run and kills millDem when a restart file of its own is there."""
        process = subprocess.Popen(["millDem", "mill.yaml", *map(str, options)], cwd=case,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        folder = case / options[options.index("--case") + 1]
        begun = {path.name for path in (folder / "dem").glob("restart.*")}

        def written():
            marks = [line for line in (folder / "dem" / "log.liggghts").read_text().splitlines()
                     if line.startswith("millFoam restart")] if (folder / "dem" / "log.liggghts").exists() else []
            return len(marks) >= 2
        self.assertTrue(wait_for(written, 60), begun)
        process.send_signal(signal.SIGKILL)
        process.wait()

    def test_a_run_with_a_fluid_that_is_killed_resumes_to_the_same_numbers(self):
        case = self.make_case(SHORT_BED)
        write_slurry(case / "slurry.h5", exchange=1e4, velocity=(0.1, 0.05, 0))
        run(case, "millMesh", "mill.yaml", "--case", "whole", "--walls")
        options = ("--case", ".", "--fluid", "slurry.h5")
        self.start_and_kill(case, *options)
        self.assertIn("resumed at step", run(case, "millDem", "mill.yaml", *options, "--resume"))
        run(case, "millDem", "mill.yaml", "--case", "whole", "--fluid", "slurry.h5")
        killed, expected = (read_table(folder / "dumps" / "fluid.csv") for folder in (case, case / "whole"))
        self.assertEqual(len(killed), 40)
        for name in killed.dtype.names:
            np.testing.assert_array_equal(killed[name], expected[name], err_msg=name)
        dumps, others = read_dumps(case), read_dumps(case / "whole")
        self.assertEqual(list(dumps), list(others))
        for at, table in dumps.items():
            np.testing.assert_array_equal(table, others[at])
        with self.assertRaisesRegex(RunError, "other walls, another fluid, other averages or another begin"):
            run(case, "millDem", "mill.yaml", "--case", ".", "--resume")

    def test_a_run_continues_from_the_last_state_of_another_case_and_its_averages_follow(self):
        case = self.make_case(BED)
        for name in ("pass_1", "pass_2"):
            run(case, "millMesh", "mill.yaml", "--case", name, "--walls")
        run(case, "millDem", "mill.yaml", "--case", "pass_1")
        shutil.copytree(case / "pass_1", case / "longer")
        run(case, "millDem", "mill.yaml", "--case", "longer", "--set", "dem.duration=0.4", "--resume")
        log = run(case, "millDem", "mill.yaml", "--case", "pass_2", "--continue", "pass_1")
        second = read_json(case / "pass_2" / "dumps" / "run.json")
        self.assertAlmostEqual(second["begin_s"], 0.2, delta=1e-9)
        self.assertAlmostEqual(second["duration_s"], 0.2, delta=1e-9)
        begin, interval = 40 * second["interval"], second["interval"]
        self.assertIn(f"continues from step {begin}", log)
        # Just what a run that is made longer does, walls' angle and springs of contacts with it
        dumps, longer = read_dumps(case / "pass_2"), read_dumps(case / "longer")
        self.assertEqual(list(dumps), [begin + k * interval for k in range(41)])
        for at, table in dumps.items():
            np.testing.assert_array_equal(table, longer[at])
        energy, expected = (read_table(case / name / "dumps/energy.csv") for name in ("pass_2", "longer"))
        for name in energy.dtype.names:
            np.testing.assert_array_equal(energy[name], expected[name][40:], err_msg=name)

        for name in ("pass_1", "pass_2"):
            run(case, "millAverage", "mill.yaml", "--case", name)
        windows = [read_json(case / name / "solids.json")["per_window"] for name in ("pass_1", "pass_2")]
        np.testing.assert_allclose(windows[0]["begin_s"], [0.1, 0.15], rtol=1e-6)
        np.testing.assert_allclose(windows[1]["begin_s"], [0.3, 0.35], rtol=1e-6)
        self.assertEqual(windows[0]["records"], windows[1]["records"])

    def test_a_pass_with_forces_that_is_killed_resumes_and_what_it_cannot_begin_with_is_refused(self):
        case = self.make_case(BED)
        for name in ("pass_1", "pass_2"):
            run(case, "millMesh", "mill.yaml", "--case", name, "--walls")
        options = ("--case", "pass_2", "--continue", "pass_1", "--fluid", "pass_1/slurry.h5")
        with self.assertRaisesRegex(RunError, "No such file|there is no such file"):
            run(case, "millDem", "mill.yaml", *options)
        write_slurry(case / "pass_1" / "slurry.h5", exchange=1e4)
        with self.assertRaisesRegex(RunError, "run.json: no such file, expected that of a complete run"):
            run(case, "millDem", "mill.yaml", *options)
        run(case, "millDem", "mill.yaml", "--case", "pass_1")
        with self.assertRaisesRegex(RunError, "run.json: the run is of another mill"):
            run(case, "millDem", "mill.yaml", *options[:4], "--set", "dem.seed=4")
        with self.assertRaisesRegex(RunError, "is the folder of this run, expected another case"):
            run(case, "millDem", "mill.yaml", "--case", "pass_1", "--continue", "pass_1")
        self.start_and_kill(case, *options)
        log = run(case, "millDem", "mill.yaml", *options, "--resume", "--or-anew")
        self.assertIn("resumed at step", log)
        steps = read_json(case / "pass_1" / "dumps" / "run.json")["interval"] * np.arange(40, 81)
        self.assertEqual(list(read_dumps(case / "pass_2")), list(steps))
        table = read_table(case / "pass_2" / "dumps" / "fluid.csv")
        self.assertEqual(len(table), 40)
        np.testing.assert_allclose(table["time_s"], 0.2 + 0.005 * np.arange(1, 41), rtol=1e-6)
        np.testing.assert_allclose(table["pressure_y_N"], BALLS * ONE_BALL * SLURRY / BALL * GRAVITY, rtol=1e-6)
        self.assertIn("nothing to do", run(case, "millDem", "mill.yaml", *options, "--resume", "--or-anew"))
        # A third pass
        run(case, "millMesh", "mill.yaml", "--case", "pass_3", "--walls")
        run(case, "millDem", "mill.yaml", "--case", "pass_3", "--continue", "pass_2")
        self.assertEqual(list(read_dumps(case / "pass_3"))[0], steps[-1])
        self.assertAlmostEqual(read_json(case / "pass_3" / "dumps" / "run.json")["begin_s"], 0.4, delta=1e-9)
        self.assertFalse((case / "pass_3" / "dumps" / "fluid.csv").exists())
        # Complete, it needs no restart file
        for path in (case / "pass_2" / "dem").glob("restart.*"):
            path.unlink()
        self.assertIn("nothing to do", run(case, "millDem", "mill.yaml", *options, "--resume", "--or-anew"))
        # Without a usable restart file of its own it begins again with the other's, if asked
        (case / "pass_2" / "dumps" / "run.json").unlink()
        (case / "pass_2" / "dem" / f"restart.{steps[-1]}").write_bytes(b"cut")
        with self.assertRaisesRegex(RunError, "expected one from which the interrupted run is resumed"):
            run(case, "millDem", "mill.yaml", *options, "--resume")
        log = run(case, "millDem", "mill.yaml", *options, "--resume", "--or-anew")
        self.assertIn(". The dry run starts from the beginning", log)
        self.assertEqual(list(read_dumps(case / "pass_2")), list(steps))


class Program(FluidCase):
    @unittest.skipUnless(shutil.which("liggghts"), "the program liggghts is not installed")
    def test_the_program_liggghts_runs_the_deck_of_a_dry_run_to_the_same_bytes(self):
        case = self.make_case(SHORT_BED.replace("duration: 0.2", "duration: 0.05"))
        self.run_mill(case)
        dumps = {path.name: path.read_bytes() for path in (case / "dumps").glob("dump.*.txt")}
        for path in (case / "dumps").glob("dump.*.txt"):
            path.unlink()
        subprocess.run(["liggghts", "-in", "in.mill", "-log", "none"], cwd=case / "dem", check=True,
                       stdout=subprocess.DEVNULL)
        self.assertEqual({path.name: path.read_bytes() for path in (case / "dumps").glob("dump.*.txt")}, dumps)

    def test_with_a_fluid_the_deck_says_what_it_needs(self):
        case = self.make_case(BED)
        write_slurry(case / "slurry.h5")
        self.run_mill(case, "--fluid", "slurry.h5", "--deck-only")
        self.assertRegex((case / "dem" / "in.mill").read_text(),
                         r"# forces of a flow \(slurry.h5 [0-9a-f]{16}, mean\): needs millLiggghts and fluid.json\n"
                         r"fix fluid all external pf/callback 1 1\n")
        os.remove(case / "dem" / "fluid.json")
        done = subprocess.run([Path(shutil.which("millDem")).parent / "millLiggghts", "-in", "in.mill", "-log", "none"],
                              cwd=case / "dem", capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("ERROR: fluid.json: cannot be read, expected the file that millDem writes", done.stdout)


if __name__ == "__main__":
    os.environ.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
    unittest.main(verbosity=2)
