#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a step of an Allrun says when it fails, in a small shell with the functions of scripts/case_functions."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

FUNCTIONS = (Path(__file__).resolve().parents[2] / "scripts" / "case_functions").read_text()
STEP = FUNCTIONS[FUNCTIONS.index("report_little_room() {"):FUNCTIONS.index("\nwritten() {")]
ROOM = 'df() { printf "Avail\\n %s\\n" "$left"; }\n'


class Step(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="step-")))

    def step(self, command, left):
        """Runs a step `flow` on a disk with so many megabytes left; its exit code and messages."""
        done = subprocess.run(["bash", "-c", f"set -eu -o pipefail\n{STEP}\n{ROOM}step flow {command}"], text=True,
                              cwd=self.folder, capture_output=True, env={**os.environ, "left": str(left)})
        return done.returncode, done.stderr

    def test_a_step_that_works_keeps_its_output_and_time(self):
        code, errors = self.step("sh -c 'echo result; echo progress >&2'", 1)
        self.assertEqual((code, errors), (0, "progress\n"))
        self.assertEqual((self.folder / "log.flow").read_text(), "result\nprogress\n")
        self.assertRegex((self.folder / "log.costs").read_text(), r"^flow,\d+\n$")

    def test_a_failure_with_room_shows_the_log_alone(self):
        code, errors = self.step("sh -c 'echo wrong; exit 3'", 20)
        self.assertEqual(code, 1)
        self.assertEqual(errors, f"{self.folder.name}: step 'flow' failed; {self.folder}/log.flow ends with:\nwrong\n")

    def test_a_failure_on_a_full_disk_names_the_disk(self):
        code, errors = self.step("false", 3)
        self.assertEqual(code, 1)
        self.assertIn(f"The disk of {self.folder} has 3 MB left: make room and start again", errors)

    def test_no_room_for_the_costs_fails_the_step(self):
        (self.folder / "log.costs").symlink_to("/dev/full")
        code, errors = self.step("true", 0)
        self.assertEqual(code, 1)
        self.assertIn("step 'flow' failed", errors)
        self.assertIn("has 0 MB left", errors)

    def test_an_unknown_room_is_not_reported(self):
        for left in ("-", "", "twenty"):
            code, errors = self.step("false", left)
            self.assertEqual(code, 1)
            self.assertEqual(errors, f"{self.folder.name}: step 'flow' failed; {self.folder}/log.flow ends with:\n")

    def test_a_log_that_cannot_be_made_fails_the_step(self):
        (self.folder / "log.flow").mkdir()
        code, errors = self.step("true", 0)
        self.assertEqual(code, 1)
        self.assertIn("step 'flow' failed", errors)
        self.assertIn("has 0 MB left", errors)


if __name__ == "__main__":
    unittest.main()
