#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""No file that is missing or cut short, and no option, ends in a traceback: report and plot_mill say what they lack."""
import shutil
import subprocess
import unittest
from unittest import mock

import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.report.build import report_case
from report_cases import write_flow, write_fluid_only, write_steps
from report_test import REPORT, Case


class Damaged(Case):
    """Every file of a case is missing, or was cut short: there is a report that says so, or one sentence."""

    def setUp(self):
        super().setUp()
        self.undrawn()
        # What takes the time and reads no file
        for name in ("charge.charge_with_errors", "models.fit_free_surface"):
            self.enterContext(mock.patch(f"millfoam.readings.{name}", side_effect=RuntimeError("left out")))
        self.enterContext(mock.patch("millfoam.readings.free_surface.fit_logistic",
                                     return_value=((-0.1, 1.0, 20.0, 0.0), 1e-3)))

    def outcome(self, folder):
        try:
            return self.assert_whole(report_case(folder)).text
        except (RuntimeError, OSError) as error:
            self.assertNotIn("\n", str(error))
            return str(error)

    @staticmethod
    def like_another(folder):
        """Times that are like another."""
        return [folder / time for time in ("0", "0.2", "0.4", "0.6")]

    def files(self, folder):
        """All but those of times that are like another."""
        like = self.like_another(folder)
        return [path for path in sorted(folder.rglob("*")) if path.is_file() and path.parent not in like]

    def test_files_that_are_cut_short(self):
        flow = write_flow(self.folder / "flow")
        for path in self.files(flow):
            whole = path.read_bytes()
            path.write_bytes(whole[:len(whole) // 2])
            words = self.outcome(flow)
            # A table loses its last lines; velocity and pressure are read from voxels and tables; that the balls'
            # dictionary is there is all that counts
            if path.suffix not in (".csv", ".dat") and path.name not in ("U", "p_rgh", "bedProperties"):
                self.assertIn(path.name, words, path)
            path.write_bytes(whole)

    def test_tables_that_end_before_the_flow_are_named(self):
        for table, name in (("flow/0/steps.csv", "steps.csv of postProcessing/flow"),
                            ("slurryBalance/0/slurryBalance.dat", "the table of slurryBalance")):
            flow = write_flow(self.folder / table.split("/")[0])
            path = flow / "postProcessing" / table
            lines = path.read_text().splitlines(keepends=True)
            path.write_text("".join(lines[:len(lines) // 2]))
            case = MillCase(flow)
            self.assertTrue(case.balance and case.record.steps)
            self.assertEqual(len(case.unusable), 1, case.unusable)
            self.assertRegex(case.unusable[0], rf"^{name} ends at [\d.]+ s, and the flow's fields at {case.last:.3g} s")

    def test_files_and_folders_that_are_missing(self):
        flow = write_flow(self.folder / "flow")
        like = self.like_another(flow)
        folders = [path for path in flow.iterdir() if path.is_dir() and path not in like]
        for path in [*folders, *self.files(flow)]:
            path.rename(self.folder / "away")
            self.outcome(flow)
            (self.folder / "away").rename(path)

    def test_a_flow_without_times_or_without_constant(self):
        flow = write_flow(self.folder / "flow")
        shutil.move(flow / "constant", self.folder / "constant")
        self.assertRegex(self.outcome(flow), "The flow is not shown: .*constant/millProperties: no such file")
        shutil.move(self.folder / "constant", flow / "constant")
        for time in ("0", "0.2", "0.4", "0.6", "0.8"):
            shutil.rmtree(flow / time)
        self.assertRegex(self.outcome(flow), "The flow is not shown: .*no flow was written")
        shutil.rmtree(flow / "postProcessing")
        self.assertNotIn("The flow is not shown", self.outcome(flow))

    def test_the_command_refuses_a_begin_that_cannot_be(self):
        write_fluid_only(self.folder / "flow")
        ended = self.command(self.folder / "flow", "--begin", "-1")
        self.assertEqual((ended.returncode, ended.stdout), (1, ""))
        self.assertRegex(ended.stderr, r"^report: error: .*from -1 s on; expected 0 or more and less than the flow's "
                                       r"last written "
                                       r"time, 0.8 s\n$")

    def test_steps_of_a_killed_flow_that_was_begun_again_count_once(self):
        flow = write_flow(self.folder / "flow")
        write_steps(flow, 0.4, np.linspace(0.41, 0.8, 40))
        self.assertEqual(len(MillCase(flow).record.steps["time_s"]), 50 + 40)


class Pictures(Case):
    def plot(self, *arguments):
        return subprocess.run([REPORT.with_name("plot_mill"), *map(str, arguments)], capture_output=True, text=True)

    def assert_one_sentence(self, ended, words):
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, rf"^plot_mill: error: .*{words}.*\n$")

    def test_without_averages_of_the_balls_are_those_of_the_slurry(self):
        flow = write_flow(self.folder / "flow")
        (flow / "solids.h5").unlink()
        ended = self.plot(flow)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("solids.h5: no such file; no maps.png", ended.stdout)
        self.assertIn("the mill turns clockwise: its rising side is x < 0", ended.stdout)
        self.assertEqual(sorted(path.name for path in (flow / "pictures").iterdir()),
                         ["force_on_balls.png", "slurry.gif", "slurry_frames.png"])

    def test_averages_from_the_start_on_leave_out_what_knows_no_balls_yet(self):
        flow = write_flow(self.folder / "flow")
        self.assertFalse((flow / "0" / "solidity").exists())
        ended = self.plot(flow, "--begin", "0")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn("force of the fluid on the balls over their weight: mean 0.1,", ended.stdout)

    def test_what_cannot_be_is_refused_in_one_sentence(self):
        flow = write_flow(self.folder / "flow")
        self.assert_one_sentence(self.plot(flow, "--begin", "-1"), "--begin -1: expected 0 or more and less than .* "
                                                                   "0.8 s")
        self.assert_one_sentence(self.plot(self.folder / "none"), "none/constant/millProperties: no such file")
        (flow / "solids.h5").write_bytes((flow / "solids.h5").read_bytes()[:3000])
        self.assert_one_sentence(self.plot(flow), "solids.h5: .*")

    def test_what_cannot_be_written_is_named(self):
        flow = write_flow(self.folder / "flow")
        (flow / "pictures").write_text("a file where the folder should be\n")
        self.assert_one_sentence(self.plot(flow), "pictures")
        (flow / "pictures").unlink()
        # Root, who may write anywhere, cannot write this either
        (flow / "pictures" / "maps.png").mkdir(parents=True)
        self.assert_one_sentence(self.plot(flow), "pictures/maps.png")


if __name__ == "__main__":
    unittest.main()
