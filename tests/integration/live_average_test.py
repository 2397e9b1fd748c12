#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Averages that millDem makes while the mill turns, compared with those of dumps; runs without dumps that are killed,
resumed and made longer; what is refused."""
import json
import os
import shlex
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

import mesh
from millfoam.files.dumps import numbered_dumps
from millfoam.files.mill_case import MillCase
from millfoam.run import RunError, run
from waiting import wait_for

MILL = """
geometry: {diameter: 0.06, length: 0.03, ends: periodic, lifters: {count: 6, height: 0.005, width: 0.005}}
speed: {fraction_of_critical: 0.7, sense: clockwise}
charge: {classes: [{diameter: 0.004, mass: 0.015}, {diameter: 0.003, mass: 0.004}], start_radius: 0.02}
materials: {ball: glass, wall: HDPE}
dem: {youngs_modulus: 5e6, settle_time: 0.1, duration: 0.2, record_interval: 0.005, seed: 3}
slurry: {density: 1239, plastic_viscosity: 0.0014, yield_stress: 0.16}
averages: {voxel_size: 0.006, window: 0.03, start: 0.05}
resolution: {cell_size: 0.003, layers: 4}
"""
LIVE = ("--set", "averages.live=yes")
NO_DUMPS = (*LIVE, "--set", "dem.dumps=no")
TURNED = "--mesh mesh.h5 --motion 'rotation table turning.txt' --period 0.03 --window 0.02 --start 0.06 --end 0.1"
RINGS = "--cylinder 0 0.03 0 0.03 --shape 5 12 2 --periodic z --window 0.04 whole -o rings.h5"
CELLS = "--mesh mesh.h5 --period 0.03 --window 0.05 --start 0.02 -o cells.h5 --smooth"
FILES = ("solids.h5", "rings_0.04.h5", "rings_whole.h5", "cells.h5")
# Dumps with all digits of the balls' numbers. Every rank runs it.
ALL_DIGITS = """#!/bin/sh
sed 's/%.10g/%.17g/g' "$2" > "$2.$$" && deck=$2.$$ && shift 2 && exec millLiggghts -in "$deck" "$@"
"""


def read_json(path):
    return json.loads(path.read_text())


def read_solids(path):
    """({data set: values}, {attribute: value}) of a solids file; of the grid, too."""
    fields = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: fields.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        return fields, {**dict(file.attrs), **{f"grid {key}": value for key, value in file["grid"].attrs.items()}}


class LiveAverages(unittest.TestCase):
    def make_case(self, text=MILL, folder=".", table=0.09):
        """A case with walls, a mesh, and the speed of its turning up to a time (s) within the run."""
        case = Path(tempfile.mkdtemp(prefix="live-"))
        self.addCleanup(shutil.rmtree, case)
        (case / "mill.yaml").write_text(text)
        run(case, "millMesh", "mill.yaml", "--case", folder, "--walls")
        mesh.write(case / "mesh.h5", mesh.drum((6, 6, 3)) * 0.03)
        (case / "turning.txt").write_text(f"0 -10\n{table} -10\n")
        return case

    def run_mill(self, case, *options):
        return run(case, "millDem", "mill.yaml", "--case", ".", *options)

    def assert_same(self, found, expected, tolerance, but=("program",)):
        """Two solids files: all attributes but those named, and all fields to a share of each one's largest value."""
        fields, attributes = read_solids(found)
        others, other_attributes = read_solids(expected)
        self.assertEqual(attributes.keys(), other_attributes.keys())
        for name in attributes.keys() - set(but):
            values, others_values = attributes[name], other_attributes[name]
            if isinstance(values, float):  # the width of smoothing follows from a sum over the balls
                self.assertAlmostEqual(values, others_values, delta=1e-14 * abs(values), msg=name)
            else:
                np.testing.assert_array_equal(values, others_values, err_msg=name)
        self.assertEqual(fields.keys(), others.keys())
        for name in fields:
            scale = others["ledger/volume_in"].max() if name.startswith("ledger") else np.abs(others[name]).max()
            np.testing.assert_allclose(fields[name], others[name], rtol=0, atol=tolerance * scale, err_msg=name)

    def average_dumps(self, case):
        """Averages the dumps as the run did; its own files become live_NAME."""
        for name in FILES:
            (case / name).rename(case / f"live_{name}")
        run(case, "millAverage", "mill.yaml", "--case", ".", *LIVE)
        for options in (RINGS, CELLS):
            run(case, "millAverage", "--dumps", "dumps/dump.*.txt", *options.split())

    def test_they_are_those_of_dumps_with_all_digits_on_one_and_two_ranks(self):
        case = self.make_case()
        program = case / "all_digits"
        program.write_text(ALL_DIGITS)
        program.chmod(0o755)
        for ranks in (1, 2):
            with mock.patch.dict(os.environ, MILLFOAM_LIGGGHTS=str(program)):
                log = self.run_mill(case, *LIVE, "-np", ranks, "--average", RINGS, "--average", CELLS)
            self.assertIn("the mesh turns with the mill", log)
            self.average_dumps(case)
            for name in FILES:
                with self.subTest(name, ranks=ranks):
                    self.assert_same(case / f"live_{name}", case / name, 1e-12)
            self.assertEqual(read_solids(case / "live_solids.h5")[1]["program"].split()[0], b"millDem")
            self.assertGreater(read_solids(case / "solids.h5")[0]["solidity"].max(), 0.3)
        # All other readers take it for the same file
        os.replace(case / "live_solids.h5", case / "solids.h5")
        self.assertIn("solids.h5\nwindow", run(case, "millAverage", "--report", "solids.h5"))
        self.assertTrue((case / "solids.xdmf").exists())

    def test_they_are_those_of_the_usual_dumps_to_their_digits(self):
        case = self.make_case()
        self.run_mill(case, *LIVE, "--average", RINGS, "--average", CELLS)
        self.average_dumps(case)
        for name in FILES:
            with self.subTest(name):
                self.assert_same(case / f"live_{name}", case / name, 1e-7)
        with self.assertRaises(AssertionError, msg="the dumps have ten digits"):
            self.assert_same(case / "live_solids.h5", case / "solids.h5", 1e-12)

    def start_and_kill(self, case, *options):
        """Starts a run in case/killed, and kills it when it has two restart files behind it."""
        process = subprocess.Popen(["millDem", "mill.yaml", "--case", "killed", *options], cwd=case,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        log = case / "killed" / "dem" / "log.liggghts"
        self.assertTrue(wait_for(lambda: log.exists() and log.read_text().count("\nmillFoam restart") >= 2, 60))
        process.send_signal(signal.SIGKILL)
        process.wait()

    def test_a_run_without_dumps_that_is_killed_and_one_that_is_made_longer_give_the_same(self):
        case = self.make_case(folder="killed")
        for folder in ("in_two", "whole"):
            shutil.copytree(case / "killed", case / folder)
        rings = RINGS.replace("-o rings.h5", "-o {}/rings.h5")
        options = [*NO_DUMPS, "--average", rings.format("killed")]
        self.start_and_kill(case, *options)
        self.assertFalse((case / "killed" / "solids.h5").exists())
        log = run(case, "millDem", "mill.yaml", "--case", "killed", *options, "--resume")
        self.assertIn("resumed at step", log)
        self.assertIn("no dumps (dem.dumps: no), 41 records", log)
        notes = read_json(case / "killed" / "dumps" / "run.json")
        step = int(next((case / "killed" / "dem").glob("torque.[1-9]*.txt")).name.split(".")[1])

        # A run that was to end where the killed one resumed, and is made longer
        options[-1] = rings.format("in_two")
        short = f"dem.duration={step * notes['timestep_s']:.12g}"
        run(case, "millDem", "mill.yaml", "--case", "in_two", *options, "--set", short)
        run(case, "millDem", "mill.yaml", "--case", "in_two", *options, "--resume")
        for name in FILES[:3]:
            self.assert_same(case / "killed" / name, case / "in_two" / name, 1e-12)
        self.assertEqual(read_json(case / "killed" / "solids.json")["per_window"]["records"], [6] * 5)

        # Until the restart file, just that of an uninterrupted run
        options[-1] = rings.format("whole")
        run(case, "millDem", "mill.yaml", "--case", "whole", *options)
        killed, whole = (read_solids(case / name / "rings_0.04.h5")[0] for name in ("killed", "whole"))
        until = np.searchsorted(whole["window/end"], step * notes["timestep_s"] * (1 + 1e-9))
        self.assertGreater(until, 0)
        for name in ("solidity", "velocity", "granular_temperature"):
            np.testing.assert_allclose(killed[name][:until], whole[name][:until], rtol=0, atol=1e-13)

        for folder in ("killed", "in_two", "whole"):
            self.assertEqual(list((case / folder / "dumps").glob("dump.*")), [])
        with self.assertRaisesRegex(RunError, "another mill.yaml, .* other averages or another begin"):
            run(case, "millDem", "mill.yaml", "--case", "killed", *NO_DUMPS, "--resume", "--set",
                "averages.window=0.04")

    def test_a_complete_run_writes_its_file_again_and_says_that_there_are_no_dumps(self):
        case = self.make_case(MILL.replace("duration: 0.2", "duration: 0.1"))
        self.run_mill(case, *NO_DUMPS)
        shutil.copy(case / "solids.h5", case / "kept.h5")
        self.assertEqual(read_json(case / "dumps" / "run.json")["dumps"], 0)
        self.assertEqual(read_json(case / "dumps" / "results.json")["dumps"], 0)
        for name in ("solids.h5", "solids.json"):
            (case / name).unlink()
        log = self.run_mill(case, *NO_DUMPS, "--resume")
        self.assertIn("nothing to do", log)
        self.assert_same(case / "solids.h5", case / "kept.h5", 0, but=())
        self.assertNotIn("solids.h5", self.run_mill(case, *NO_DUMPS, "--resume"))
        for name in ("solids.json", "solids.xdmf"):
            (case / name).unlink()
            self.run_mill(case, *NO_DUMPS, "--resume")
            self.assertTrue((case / name).is_file())
        # As of an earlier run of the same plan, where this one was killed before it wrote its own
        os.utime(case / "solids.h5", (0, 0))
        self.assertIn("solids.h5", self.run_mill(case, *NO_DUMPS, "--resume"))
        # It is kept whatever has become of the files from which it would resume
        kept = {path: path.read_bytes() for path in (case / "dem").glob("*[0-9]") if path.suffix[1:].isdigit()}
        self.assertEqual({path.stem for path in kept}, {"restart", "averages_1"})
        for path in kept:
            path.unlink()
        self.assertIn("nothing to do", self.run_mill(case, *NO_DUMPS, "--resume"))
        with self.assertRaisesRegex(RunError, "no complete restart file with the averages of its step"):
            self.run_mill(case, *NO_DUMPS, "--resume", "--set", "dem.duration=0.2")
        self.assertTrue((case / "dumps" / "run.json").exists())
        for path, content in kept.items():
            path.write_bytes(content)
        with self.assertRaisesRegex(RunError, r"run.json: the run wrote no dumps \(dem.dumps: no\): its averages"):
            run(case, "millAverage", "mill.yaml", "--case", ".")
        with self.assertRaisesRegex(RuntimeError, r"no dump.<step>.txt, because the run wrote none \(dem.dumps: no\)"):
            numbered_dumps(case / "dumps")
        found = MillCase(case)
        self.assertEqual((found.averages["records"], found.result("lost_balls")), (6, 0))
        # Another run continues from its last state
        run(case, "millMesh", "mill.yaml", "--case", "next", "--walls")
        run(case, "millDem", "mill.yaml", "--case", "next", "--continue", ".", *NO_DUMPS)
        self.assertAlmostEqual(read_json(case / "next" / "solids.json")["time0_s"], 0.15, delta=1e-6)

    def test_averages_beyond_their_tolerance_fail_each_time(self):
        case = self.make_case(MILL.replace("duration: 0.2", "duration: 0.06").replace("start: 0.05", "start: 0"))
        part = "--box -0.03 -0.03 0 0.01 0.03 0.03 --shape 5 10 5 --window 0.02 --tolerance 0.01 -o part.h5"
        for options in ((), ("--resume",), ("--resume",)):
            with self.assertRaisesRegex(RunError, "the averages are beyond their --tolerance"):
                self.run_mill(case, "--average", part, *options)
        self.assertTrue((case / "part.h5").is_file())

    def test_averages_of_a_steady_charge_have_whole_windows_since_it_is_steady(self):
        case = self.make_case(MILL.replace("start: 0.05", "start: steady"))
        self.run_mill(case, *NO_DUMPS)
        steady, summary = (read_json(case / name) for name in ("dumps/results.json", "solids.json"))
        begins = np.array(summary["per_window"]["begin_s"])
        np.testing.assert_allclose(begins / 0.03, np.round(begins / 0.03), atol=1e-3)
        self.assertGreater(begins[0], steady["steady_from_s"] - 1e-9)
        self.assertLess(begins[0] - 0.03, steady["steady_from_s"])
        self.assertGreater(steady["steady_from_s"], 0)

    def test_records_in_no_window_need_no_cells(self):
        case = self.make_case(table=0.12)
        self.run_mill(case, "--average", f"{TURNED} -o live_turned.h5")
        run(case, "millAverage", "--dumps", "dumps/dump.*.txt", *shlex.split(TURNED), "-o", "turned.h5")
        self.assert_same(case / "live_turned.h5", case / "turned.h5", 1e-7)

    def test_what_cannot_be_averaged_is_refused_before_anything_is_made(self):
        case = self.make_case()
        (case / "notes.h5").write_text("mine")
        for options, message in (
                (("--set", "dem.dumps=no"), "key 'dem.dumps' = no: expected yes, or averages.live: yes"),
                (("--average", "--dumps x"), "--average '--dumps x': .*not expected"),
                (("--average", "--box 0 0 0 1 1 1"), "--shape is missing"),
                (("--average", "--mesh none.h5 --window 0.05 -o cells.h5"), "none.h5"),
                (("--average", "--window 0.001"), "0.001 s is less than the 0.005"),
                (("--average", "-o notes.h5"), "notes.h5: this file exists and is not a millfoam-solids file"),
                ((*LIVE, "--average", "--window whole"), "solids.h5 would be written twice"),
                ((*LIVE, "--set", "averages.window=0.2"), "key 'averages.start' = 0.05: .*less averages.window, 0 s"),
                (("--average", f"{TURNED} -o turned.h5"), "time 0.09.* s is outside the table of the motion")):
            with self.subTest(options), self.assertRaisesRegex(RunError, message):
                self.run_mill(case, *options)
        self.assertFalse((case / "dumps").exists())
        # Only the balls show that it is in millimetres
        with self.assertRaisesRegex(RunError, "LIGGGHTS stopped: ERROR: .* 100 % of the balls' volume lies outside"):
            self.run_mill(case, "--average", "--box 30 30 0 60 60 30 --shape 9 9 9 --window 0.05 -o box.h5")
        self.assertFalse((case / "box.h5").exists())

    def test_a_wall_that_is_not_one_of_the_run_is_refused_before_anything_is_made(self):
        case = self.make_case()
        shutil.copy(case / "walls" / "shell.stl", case / "walls" / "other.stl")
        with self.assertRaisesRegex(RunError, "walls/other.stl: is not a wall of the dry run"):
            self.run_mill(case, *LIVE)
        self.assertFalse((case / "dumps").exists())

    def test_allrun_takes_them_for_the_stage_of_the_averages(self):
        case = self.make_case(MILL.replace("duration: 0.2", "duration: 0.1"))
        command = (f"export MILLFOAM_NP=1; . {os.environ['MILLFOAM_DIR']}/scripts/case_functions; "
                   f". {os.environ['MILLFOAM_DIR']}/scripts/mill_stages; run_mill . mill.yaml --until average")
        for changes, made in ((NO_DUMPS, True), (NO_DUMPS, False),
                              ((*NO_DUMPS, "--set", "averages.window=0.04"), True)):
            log = run(case, "bash", "-c", f"set -eu; {command} {' '.join(changes)}")
            self.assertEqual("Keeping charge" not in log and "Keeping average" not in log, made, log)
        self.assertAlmostEqual(read_json(case / "solids.json")["window_s"], 0.04, delta=1e-4)
        mill = read_json(case / "mill.json")["fingerprint"]
        self.assertEqual(read_json(case / "solids.json")["mill"], {key: mill[key] for key in ("charge", "averages")})
        self.assertTrue(read_json(case / "solids.json")["program"].startswith("millDem "))


if __name__ == "__main__":
    unittest.main()
