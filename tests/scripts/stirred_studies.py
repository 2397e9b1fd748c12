# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the studies of stirred mills have in common."""
import subprocess

from millfoam.run import set_options
from millstudies.stirred_settings import FILE


def assert_are_mills(test, runs):
    """Each of the runs, name -> run, is a mill that can be made, in both forms, without a warning."""
    for name, run in runs.items():
        for quick in (False, True):
            with test.subTest(run=name, quick=quick):
                done = subprocess.run(["millMesh", FILE, *set_options(run.settings(quick)), "--resolved", "-"],
                                      capture_output=True, text=True)
                test.assertEqual((done.returncode, done.stderr), (0, ""))
