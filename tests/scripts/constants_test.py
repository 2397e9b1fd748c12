#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The package's physical constants are those of the programs, and are written once."""
import re
import unittest
from subprocess import PIPE, run
from unittest import mock

import numpy as np

from millfoam.files.constants import GRAVITY
from millfoam.readings import models, power_models
from millstudies.mill_runs import resolved
from study_scripts import CASES

SCRIPTS = CASES.parent / "scripts"


class Gravity(unittest.TestCase):
    def test_is_that_of_every_mill(self):
        for mill in (CASES / "mills").glob("*/mill.yaml"):
            self.assertEqual(resolved(mill).derived("gravity_m_s2"), GRAVITY, mill)

    def test_is_written_in_no_other_script_or_dictionary(self):
        # Not the files of mills that were run here
        kept = run(["git", "ls-files", "-z", "*.py", "**/constant/*"], cwd=SCRIPTS.parent, check=True, text=True,
                   stdout=PIPE).stdout.split("\0")
        files = [SCRIPTS.parent / path for path in kept if path.startswith(("scripts/", "cases/"))]
        self.assertEqual([path for path in files if re.search(r"\b9\.8\d*\b", path.read_text(errors="replace"))],
                         [SCRIPTS / "millfoam" / "files" / "constants.py"])

    def test_models_follow_it(self):
        def read():
            return np.array([models.surface_number(2.0, 0.005, 0.15, 0.3),
                             power_models.morrell(3, 4, 0.7, 0.3, 5000).net])

        usual = read()
        with mock.patch.object(models, "GRAVITY", 4 * GRAVITY), mock.patch.object(power_models, "GRAVITY", 4 * GRAVITY):
            # The number goes with the root of the root of 1/g; power with g at a speed, and the speed with the root
            np.testing.assert_allclose(read() / usual, [4**-0.25, 8], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
