#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What slurryFoam leaves behind in numbers, steps.csv and flow.json, against its fields, a restart and two ranks; one
flow at a time in a case; and what the tools say of themselves."""
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

import solids
from openfoam_case import require_environment, rotating_mesh
from slurry_case import SlurryTest

BALLS = ("block { box (0.02 0.01 -1) (0.06 0.05 1); edge 0.01; edgeAxes (1 1 0); solidity 0.5; diameter 0.005;"
         " velocity (0.3 0.3 0); moves yes; }")
BALANCE = 'functions { slurryBalance { type slurryBalance; libs ("libmillFoam.so"); } }'
COLUMN_OF = {"maxCo": "courant", "maxAlphaCo": "courant_surface", "maxAirCo": "courant_air",
             "maxVoidageChange": "voidage_change"}


class Steps(SlurryTest):
    """A pool with balls that move through it, by steps within bounds, with two written times."""

    half, end, courant = 0.01, 0.02, 0.01

    def pool(self, **options):
        case = self.slurry_case(**options)
        case.bed(BALLS, entries="ballDensity 2500;")
        case.adjusted(self.end, self.half, courant=self.courant, voidage_change=0.05)
        return case

    def run_pool(self, **options):
        case = self.pool(**options)
        result = self.assert_runs(case, "slurryFoam")
        return case, case.steps(), case.record(), result.log

    def test_there_is_a_row_for_every_step(self):
        _, steps, record, log = self.run_pool()
        self.assertGreater(len(steps), 10)
        self.assertEqual(len(steps), log.count("\nTime = "))
        self.assertEqual(record["steps"], len(steps))
        np.testing.assert_allclose(np.cumsum(steps["deltaT_s"]), steps["time_s"], rtol=1e-9)
        self.assertAlmostEqual(steps["time_s"][-1], self.end, delta=1e-9)
        self.assertTrue(np.all(np.diff(steps["wall_s"]) >= 0))

    def test_courant_numbers_of_a_step_and_the_limits_give_the_next_step(self):
        _, steps, record, _ = self.run_pool()
        limits = record["limits"]
        self.assertEqual(limits, {"maxCo": self.courant, "maxAlphaCo": self.courant, "maxAirCo": self.courant,
                                  "maxVoidageChange": 0.05, "maxDeltaT_s": 0.004})
        allowed = np.min([0.004 + 0 * steps["deltaT_s"]] + [
            steps["deltaT_s"] * np.minimum(1.2, limits[key] / np.maximum(steps[column], 1e-15))
            for key, column in COLUMN_OF.items()], axis=0)[:-1]
        found = steps["deltaT_s"][1:]
        # Before a written time steps are shortened, or stretched a little, to meet it
        self.assertTrue(np.all(found <= 1.1 * allowed))
        self.assertGreater((np.abs(found / allowed - 1) < 0.01).sum(), 3)

    def test_volumes_are_those_of_the_written_fields(self):
        case, steps, record, _ = self.run_pool()
        cell = case.upper.prod() / case.cells
        phi, alpha = case.field("solidity", self.end), case.field("alpha.slurry", self.end)
        for column, expected in (("slurry_m3", (1 - phi) @ alpha * cell), ("fluid_m3", (1 - phi).sum() * cell),
                                 ("solids_m3", phi.sum() * cell), ("alpha_min", alpha.min())):
            self.assertAlmostEqual(steps[column][-1], expected, delta=1e-12, msg=column)
        self.assertEqual(record["slurry_m3"], {"first": steps["slurry_m3"][0], "last": steps["slurry_m3"][-1]})
        self.assertEqual(record["alpha"]["max_minus_1"], steps["alpha_max_minus_1"].max())

    def test_share_beyond_the_law_is_that_of_the_slurry_in_the_bed(self):
        case, steps, record, _ = self.run_pool()
        self.assertEqual(record["drag"]["law"], "Beetstra")
        phi, alpha = case.field("solidity", self.end), case.field("alpha.slurry", self.end)
        slip = np.linalg.norm(case.field("solidsVelocity", self.end) - case.field("U", self.end), axis=1)
        bed = (phi > 0) & (alpha > 0.5)
        low, high = record["drag"]["reynolds_range"]
        thin, dense = record["drag"]["solidity_range"]
        reynolds = 1239 * (1 - phi) * slip * case.field("solidsDiameter", self.end) / 1.4e-3
        beyond = (phi < thin) | (phi > dense) | (reynolds < low) | (reynolds > high)
        weight = (1 - phi)[bed]
        self.assertAlmostEqual(steps["beyond_law"][-1], weight[beyond[bed]].sum() / weight.sum(), delta=1e-9)
        self.assertAlmostEqual(steps["solidity_below"][-1], weight[(phi < thin)[bed]].sum() / weight.sum(), delta=1e-9)
        self.assertAlmostEqual(steps["largest_reynolds"][-1] / reynolds[bed].max(), 1, delta=1e-9)
        mean = np.average(steps["beyond_law"], weights=steps["deltaT_s"])
        self.assertAlmostEqual(record["beyond_law"]["mean"], mean, delta=1e-12)

    def test_force_on_the_balls_is_written_at_written_times(self):
        case, steps, record, _ = self.run_pool()
        known = np.isfinite(steps["force_mean"])
        np.testing.assert_allclose(steps["time_s"][known], [self.half, self.end], rtol=1e-9)
        mean = np.average(case.field("forceOverWeight", self.end), weights=case.field("solidity", self.end))
        self.assertAlmostEqual(steps["force_mean"][-1], mean, delta=1e-9)
        self.assertAlmostEqual(record["force_on_balls"]["mean"], steps["force_mean"][known].mean(), delta=1e-12)
        self.assertEqual(record["force_on_balls"]["times"], 2)

    def test_the_solver_of_the_pressure_is_counted(self):
        _, steps, _, log = self.run_pool()
        iterations = [int(line.rsplit(" ", 1)[1]) for line in log.splitlines() if "Solving for p_rgh" in line]
        self.assertEqual(steps["pressure_iterations"].sum(), sum(iterations))
        self.assertLess(steps["pressure_residual"].max(), 1e-11)

    def test_two_ranks_leave_the_same(self):
        _, alone, of_one, _ = self.run_pool()
        case = self.pool()
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_runs(case, "slurryFoam", ranks=2)
        self.assertEqual(case.record()["ranks"], 2)
        # Of so few cells, libraries and MPI take nearly all of it
        self.assertGreater(of_one["memory_bytes"], 3e7)
        self.assertGreater(case.record()["memory_bytes"], 1.5 * of_one["memory_bytes"])
        for column in ("time_s", "courant", "courant_surface", "slurry_m3", "fluid_m3", "solids_m3", "beyond_law",
                       "force_mean"):
            np.testing.assert_allclose(case.steps()[column], alone[column], rtol=1e-4, err_msg=column)

    def test_a_flow_that_goes_on_adds_its_steps_to_those_before(self):
        case, whole, _, _ = self.run_pool()
        shutil.rmtree(case.folder(self.end))
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text().replace("startTime 0;", f"startTime {self.half};"))
        self.assert_runs(case, "slurryFoam")
        later, record = case.steps(f"{self.half}"), case.record(f"{self.half}")
        self.assertEqual(record["begin_s"], self.half)
        self.assertTrue(record["complete"])
        before = case.steps()
        joined = np.concatenate([before[before["time_s"] - before["deltaT_s"] / 2 < record["begin_s"]], later])
        for column in whole.dtype.names:
            if column != "wall_s":
                np.testing.assert_allclose(joined[column], whole[column], rtol=1e-9, err_msg=column)


class Summary(SlurryTest):
    """flow.json"""

    def summary(self, **options):
        case = self.slurry_case(end_time=0.004, **options)
        return case, lambda: (self.assert_runs(case, "slurryFoam"), case.record())[1]

    def test_of_a_flow_without_balls(self):
        _, run = self.summary()
        record = run()
        self.assertEqual(record["format"], "millfoam-flow")
        self.assertRegex(record["program"], r"^slurryFoam \d+\.\d+\.\d+")
        api = Path(os.environ["WM_PROJECT_DIR"], "META-INFO", "api-info").read_text().split()[0]
        self.assertEqual("api=" + record["openfoam"]["version"], api)
        self.assertEqual([record[key] for key in ("begin_s", "end_s", "asked_end_s", "steps")], [0, 0.004, 0.004, 2])
        self.assertTrue(record["complete"])
        self.assertEqual(record["rotation"], {"angular_velocity_rad_s": 0, "sense": "none", "words": "does not turn"})
        for key in ("limits", "solids", "drag"):
            self.assertIsNone(record[key], key)
        self.assertIsNone(record["beyond_law"]["mean"])

    def test_of_a_flow_that_is_stopped_early(self):
        case, run = self.summary()
        case.control(0.01, 0.002, write_interval=2)
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text().replace("stopAt endTime", "stopAt nextWrite"))
        record = run()
        self.assertFalse(record["complete"])
        self.assertEqual([record[key] for key in ("end_s", "asked_end_s", "steps")], [0.004, 0.01, 2])

    def test_says_in_which_sense_the_mesh_turns(self):
        for omega, sense in ((-3, "clockwise"), (3, "anticlockwise")):
            case, run = self.summary(motion=rotating_mesh(omega))
            case.write("constant/millProperties", f"omega {omega};")
            control = case.path / "system" / "controlDict"
            control.write_text(control.read_text() + BALANCE)
            self.assertEqual(run()["rotation"], {"angular_velocity_rad_s": omega, "sense": sense,
                                                 "words": f"{sense}, seen with x to the right and y up"})
            words = f"{sense}, seen with x to the right and y up"
            self.assertIn(f"Mesh: {words}, omega {omega} rad/s", self.assert_runs(case, "slurryFoam").log)
            table = (case.path / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat").read_text()
            self.assertRegex(table, rf"# Mill\s*: {words}\n")

    def test_names_the_mill_and_the_solids_with_theirs(self):
        case, run = self.summary()
        case.write("constant/millProperties",
                   'flowFingerprint "00ff"; averagesFingerprint "aa11"; chargeFingerprint "bb22";')
        solids.write(case.path / "solids.h5", (0, 0, 0), case.upper, solids.uniform(0.1, 0.2), window=0.001, time0=2,
                     program="millAverage 9.9", mill_averages="aa11", angular_velocity=-6.1)
        case.bed('solids "solids.h5"; interpolation linear; outOfRange repeat; fingerprint "aa11"; omega -6.1;')
        record = run()
        self.assertEqual(record["mill"], {"charge": "bb22", "averages": "aa11", "flow": "00ff"})
        found = record["solids"]
        self.assertEqual(found["file"], str(case.path / "solids.h5"))
        self.assertEqual((found["begin_s"], found["windows"], found["out_of_range"]), (2, 2, "repeat"))
        self.assertEqual(found["repeated"], 1)  # 4 ms by 2 ms
        self.assertEqual((found["program"], found["mill"], found["angular_velocity_rad_s"]),
                         ("millAverage 9.9", {"averages": "aa11"}, -6.1))
        self.assertLess(abs(record["volume_correction"]["largest"]), 1e-9)


class AtItsEnd(SlurryTest):
    """A flow that has reached endTime, and slurryFoam again."""

    def ended(self):
        case = self.slurry_case(end_time=0.01)
        case.write("constant/millProperties", "omega 0;")
        control = case.path / "system" / "controlDict"
        control.write_text(control.read_text().replace("startFrom startTime", "startFrom latestTime") + BALANCE)
        self.assert_runs(case, "slurryFoam")
        return case

    @staticmethod
    def results(case):
        return {path: path.read_bytes() for path in sorted(case.path.glob("postProcessing/**/*"))
                if path.is_file() and path.name != ".lock"}

    def test_nothing_is_added_to_a_complete_flow(self):
        case = self.ended()
        folders, before = sorted(case.path.glob("postProcessing/**")), self.results(case)
        self.assertIn("nothing is left to compute", self.assert_runs(case, "slurryFoam").log)
        self.assertEqual(sorted(case.path.glob("postProcessing/**")), folders)
        self.assertEqual(self.results(case), before)

    def test_a_flow_that_was_killed_at_its_end_becomes_complete(self):
        case = self.ended()
        record = case.path / "postProcessing/flow/0/flow.json"
        record.write_text(record.read_text().replace('"complete": true', '"complete": false'))
        self.assert_runs(case, "slurryFoam")
        self.assertTrue(case.record("0.01")["complete"])
        self.assertEqual(case.record("0.01")["steps"], 0)


class OneAtATime(SlurryTest):
    """A flow that runs until it is killed."""

    def started(self):
        case = self.slurry_case(end_time=1000)
        case.control(1000, 0.002, write_interval=5)
        case.write("system/slurryStartDict", "start pool; level 0.02;")
        # pylint: disable=consider-using-with
        process = subprocess.Popen(["slurryFoam", "-case", str(case.path)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.STDOUT)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        record = case.path / "postProcessing" / "flow" / "0" / "flow.json"
        for _ in range(600):
            if record.is_file() and json.loads(record.read_text())["steps"] > 0:
                return case, process
            time.sleep(0.1)
        self.fail("no step was recorded within a minute")
        return None

    def test_a_second_is_refused_and_a_killed_one_blocks_nobody(self):
        case, process = self.started()
        words = ("works in this case", "one flow at a time", f"slurryFoam (process {process.pid})")
        for program in ("slurryFoam", "slurryStart"):
            result = case.run(program)
            self.assertNotEqual(result.code, 0)
            for word in words:
                self.assertIn(word, " ".join(result.log.split()))
        self.assertIsNone(process.poll())
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        record = case.record()
        self.assertFalse(record["complete"])
        self.assertGreaterEqual(len(case.steps()), record["steps"])
        case.control(0.004, 0.002)
        self.assert_runs(case, "slurryFoam")
        self.assertTrue(case.record()["complete"])


class Help(unittest.TestCase):
    """--help and --version, which OpenFOAM itself refuses."""

    reads_and_writes = {"slurryFoam": ("constant/bedProperties", "solids.h5", "flow.json"),
                        "slurryStart": ("system/slurryStartDict", "0/alpha.slurry"),
                        "foamMeshToH5": ("constant/polyMesh", "mesh.h5")}

    def test_help_says_what_a_tool_reads_and_writes(self):
        for tool, words in self.reads_and_writes.items():
            done = subprocess.run([tool, "--help"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), tool)
            for word in ("Usage: " + tool, "Reads:", "Writes:", *words):
                self.assertIn(word, done.stdout)

    def test_neither_needs_a_case_or_a_shell_that_knows_of_openfoam(self):
        folder = tempfile.mkdtemp(prefix="millfoam_test_")
        self.addCleanup(os.rmdir, folder)
        for tool in self.reads_and_writes:
            for option, words in (("--version", tool + " "), ("--help", "Usage: " + tool)):
                done = subprocess.run([shutil.which(tool), option], capture_output=True, text=True, check=False,
                                      cwd=folder, env={"PATH": "/usr/bin:/bin"})
                self.assertEqual((done.returncode, done.stderr), (0, ""), (tool, option))
                self.assertIn(words, done.stdout)

    def test_version_is_that_of_the_program(self):
        for tool in self.reads_and_writes:
            done = subprocess.run([tool, "--version"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), tool)
            self.assertRegex(done.stdout, rf"^{tool} \d+\.\d+\.\d+\S*\n$")


if __name__ == "__main__":
    require_environment()
    unittest.main()
