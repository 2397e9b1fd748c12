#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Residence times out of tracer tables: distributions whose moments are known, and records that are cut short."""
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.special import gammainc

from millfoam.files.tables import TableError
from millfoam.readings.residence import closed_spread, read_tracer, residence

MEAN, STEP, FEED = 4.0, 0.01, 2e-3  # s, s, m3/s
BEGIN = 1.0  # of the feed, s


def left_after(number, time):
    """Share of a pulse that has left `number` equal stirred tanks of a mean time MEAN after a time (s)."""
    return gammainc(number, number * np.maximum(time, 0) / MEAN)


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)

    def write(self, time, into, out, every=1):
        """Table of a tracer with rates (m3/s) in steps that end at these times (s), with every nth row."""
        path = self.case / "postProcessing" / "tracer" / "0" / "slurryTracer.dat"
        path.parent.mkdir(parents=True, exist_ok=True)
        fed, left = STEP * np.cumsum(into), STEP * np.cumsum(out)
        full = np.full_like(time, FEED)
        rows = np.column_stack([time, fed - left, into, out, full, full, fed, left, 0 * time, 0 * time, 0 * time + 1])
        head = "Time_s\ttracer_m3\tin_m3/s\tout_m3/s\tslurryIn_m3/s\tslurryOut_m3/s\tallIn_m3\tallOut_m3\tmissing_m3" \
               "\tsmallest\tlargest"
        np.savetxt(path, rows[every - 1::every], "%.15g", "\t", header=head, comments="# ")
        return read_tracer(self.case)

    def pulse(self, number, end, every=1):
        """A short pulse at BEGIN through tanks."""
        time = np.arange(1, round(end / STEP) + 1) * STEP
        into = np.where(np.isclose(time, BEGIN), FEED, 0.0)
        age = time - BEGIN
        out = FEED * (left_after(number, age) - left_after(number, age - STEP))
        return self.write(time, into, out, every)

    def step(self, number, end):
        """From BEGIN on, through tanks."""
        table = self.pulse(number, end)
        younger = np.cumsum(table.out) / (FEED * STEP)
        into = np.where(table.time > BEGIN - STEP / 2, FEED, 0.0)
        return self.write(table.time, into, FEED * younger)


class Moments(Tables):
    def test_of_tanks_are_found_from_a_pulse_and_a_step(self):
        for number in (1, 3, 8):
            for feed in (self.pulse, self.step):
                found = residence(feed(number, 60.0))
                self.assertAlmostEqual(found.mean / MEAN, 1, delta=5e-3)
                self.assertAlmostEqual(found.tanks / number, 1, delta=2e-2)
                self.assertLess(found.left, 1e-3)

    def test_a_record_that_ends_early_continues_as_an_exponential(self):
        for number, end in ((1, 9.0), (1, 5.0), (3, 8.0)):
            found = residence(self.pulse(number, end))
            self.assertGreater(found.left, 0.05)
            self.assertAlmostEqual(found.mean / MEAN, 1, delta=0.05)

    def test_rows_between_which_steps_are_missing_change_little(self):
        for every in (7, 10, 50):
            found = residence(self.pulse(1, 60.0, every=every))
            # When within a row the pulse entered is not known, nor within a step
            self.assertAlmostEqual(found.mean, MEAN, delta=(every + 1) * STEP / 2 + 1e-3)
            self.assertAlmostEqual(found.variance / MEAN**2, 1, delta=0.01)

    def test_tracer_from_the_begin_on_is_as_later(self):
        time = np.arange(1, 6001) * STEP
        into = np.full_like(time, FEED)
        # Of a whole step, as the flow computes it
        found = residence(self.write(time, into, FEED * left_after(1, time - STEP / 2)))
        self.assertAlmostEqual(found.mean / MEAN, 1, delta=1e-3)

    def test_kind_and_begin_of_the_feed_are_found(self):
        pulse, step = self.pulse(3, 30.0), self.step(3, 30.0)
        self.assertTrue(pulse.pulse)
        self.assertFalse(step.pulse)
        self.assertAlmostEqual(step.begin, BEGIN - STEP, delta=1e-9)

    def test_dispersion_has_the_spread_of_its_peclet_number(self):
        self.assertAlmostEqual(closed_spread(1e-4), 1, delta=1e-4)
        self.assertAlmostEqual(closed_spread(0.01), closed_spread(0.0100001), delta=1e-6)
        self.assertAlmostEqual(closed_spread(1000), 2e-3, delta=1e-5)
        found = residence(self.pulse(5, 60.0))
        self.assertAlmostEqual(closed_spread(found.peclet), found.spread, delta=1e-9)
        self.assertLess(residence(self.pulse(1, 100.0)).peclet, 0.1)


class Refused(Tables):
    def test_what_has_no_residence_time(self):
        with self.assertRaisesRegex(TableError, "no slurryTracer.dat"):
            read_tracer(self.case)
        time = np.arange(1, 100) * STEP
        with self.assertRaisesRegex(RuntimeError, "no tracer was fed"):
            residence(self.write(time, 0 * time, 0 * time))
        with self.assertRaisesRegex(RuntimeError, "% of the tracer has not left.*let the flow run longer"):
            residence(self.pulse(1, 2.0))
        with self.assertRaisesRegex(RuntimeError, "4[0-9] % of the tracer has not left"):
            residence(self.pulse(1, 4.3))
        with self.assertRaisesRegex(RuntimeError, "100 % more tracer left than was fed"):
            residence(self.write(time, np.where(time < 0.05, FEED, 0), np.where(time < 0.09, FEED, 0)))


if __name__ == "__main__":
    unittest.main()
