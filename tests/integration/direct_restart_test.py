#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A flow that tells balls its forces tells them the same after a restart: `direct_restart_test.py FIXED_BALLS`."""
import shutil
import subprocess
import sys
import unittest

import numpy as np

from millfoam.files import foam
from slurry_case import SlurryTest

FIXED_BALLS = sys.argv.pop(1)
BED = 'exchange "exchange"; outOfRange hold;'
DELTA_T, STOP, END = 0.002, 0.04, 0.06  # s


def told(case):
    """Runs a case's flow next to balls that stay; what it told them [messages, numbers], times first."""
    (case.path / "exchange").mkdir(exist_ok=True)
    out = case.path / "told.txt"
    with subprocess.Popen([FIXED_BALLS, case.path / "exchange", out]) as balls:
        result = case.run("slurryFoam")
        if result.code != 0:
            balls.kill()
            raise AssertionError(result.tail())
    shutil.rmtree(case.path / "exchange")
    return np.loadtxt(out)


class DirectRestart(SlurryTest):
    def test_balls_are_told_what_they_were_told(self):
        case = self.slurry_case(end_time=END)
        case.bed(BED)
        whole = told(case)
        resumed = self.copy_of(case)
        for time, folder in foam.times(resumed.path):
            if time > STOP + 1e-9:
                shutil.rmtree(folder)
        resumed.control(END, DELTA_T, 5, start_time=STOP)
        after = told(resumed)
        self.assertEqual(len(after), round((END - STOP) / DELTA_T))
        same = whole[-len(after):]
        np.testing.assert_allclose(after[:, 0], same[:, 0], rtol=1e-14)
        np.testing.assert_array_equal(after[:, 1:], same[:, 1:])
        self.assertGreater(np.abs(after[0, 1:]).max(), 100)
        for name in ("toldPressure", "toldExchange", "uniform/toldForces"):
            with self.subTest(name=name):
                half = self.copy_of(resumed)
                for time, folder in foam.times(half.path):
                    if time > STOP + 1e-9:
                        shutil.rmtree(folder)
                (half.folder(STOP) / name).unlink()
                self.assertRaisesRegex(AssertionError, f'{name}": no such file', told, half)


if __name__ == "__main__":
    unittest.main()
