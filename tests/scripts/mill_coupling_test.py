#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study mill_coupling: the turns that its runs average, and names of mills that are refused. Nothing is run."""
import subprocess
import tempfile
import unittest
from pathlib import Path

from millfoam.readings.batches import whole_turns
from millfoam.readings.mill_power import TURNS
from millstudies.mill_runs import resolved
from study_scripts import CASES

ALLRUN = CASES / "studies" / "mill_coupling" / "Allrun"


def mill_of(name):
    """The resolved Mill of a name, by the settings of Allrun."""
    begin = ALLRUN.read_text().partition("# shellcheck source")[0]
    done = subprocess.run(["bash", "-c", begin + 'settings "$1"; printf "%s\\n" "$file" "${changes[@]}"', ALLRUN, name],
                          capture_output=True, text=True, check=True)
    file, *changes = done.stdout.splitlines()
    return resolved(file, changes)


class Mills(unittest.TestCase):
    def test_average_whole_turns_of_the_flow(self):
        for name, turns in (("50_slurry", 5), ("75_slurry", 7), ("75_water", 7), ("30cm", TURNS)):
            with self.subTest(name):
                mill = mill_of(name)
                self.assertEqual(whole_turns(mill.flow("duration_s") - mill.flow("averages_start_s"), mill.turn), turns)

    def test_a_name_is_refused_before_the_first_run(self):
        with tempfile.TemporaryDirectory() as folder:
            # Without what runs a mill
            allrun = Path(folder) / "Allrun"
            allrun.write_text(ALLRUN.read_text())
            for words in (("50_slurry", "75_mud"), ("50_slurry", "60_slurry")):
                done = subprocess.run(["bash", allrun, *words], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr.splitlines()), (
                    1, [f"Allrun: '{words[1]}': expected 50_slurry, 50_water, 75_slurry, 75_water or 30cm"]))


if __name__ == "__main__":
    unittest.main()
