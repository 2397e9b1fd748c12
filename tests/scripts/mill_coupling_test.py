#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study mill_coupling: the turns that its runs average, names of mills that are refused, and rows of the table.
Nothing is run."""
import subprocess
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from millfoam.coupling.passes import QUANTITIES
from millfoam.readings.batches import whole_turns
from millfoam.readings.means import Mean
from millfoam.readings.mill_power import TURNS, UNKNOWN
from millstudies.mill_runs import resolved
from study_scripts import CASES, load

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

    def test_a_row_has_the_drives_power_of_its_pass_whatever_the_way(self):
        study = load("studies/mill_coupling/mill_coupling.py")
        ways = {name: SimpleNamespace(quantities=dict.fromkeys(QUANTITIES, Mean(0.2, 0.01)) | {"drive_power": drive},
                                      noise=0.003, load=0.4)
                for name, drive in (("one way", Mean(0.3, 0.01)), ("buoyancy", UNKNOWN), ("direct", Mean(0.5, 0.02)))}
        with mock.patch.object(study, "change", lambda *_: SimpleNamespace(solidity=0.01)):
            rows = list(study.rows_of("75_slurry", ways))
            ways["buoyancy"].quantities["drive_power"] = Mean(0.4, 0.01)
            self.assertEqual([row["power of the drive, W"] for row in study.rows_of("75_slurry", ways)],
                             [0.3, 0.4, 0.5])
        line = next(line for line in study.lines_of(rows) if line.startswith("power of the drive"))
        self.assertEqual(line.split("W", 1)[1].split(), ["0.3000", "±", "0.0100", "–", "0.5000", "±", "0.0200"])


if __name__ == "__main__":
    unittest.main()
