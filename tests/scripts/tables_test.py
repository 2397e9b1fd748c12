#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of function objects: over restarts, after a kill, and their means over time."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.tables import TableError, read_columns, read_table
from millfoam.readings.means import time_mean


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tables-")
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)

    def write(self, time, begun, rows, end="\n"):
        path = self.case / "postProcessing" / "balance" / time / "balance.dat"
        path.parent.mkdir(parents=True, exist_ok=True)
        lines = ["# Balance", f"# Begun\t: {begun}", "# Time_s\tholdUp_m3", *("\t".join(map(str, row)) for row in rows)]
        path.write_text("\n".join(lines) + end)

    def test_a_restart_replaces_what_the_killed_run_wrote_beyond(self):
        self.write("0", 100, [(0.1, 1), (0.2, 2), (0.3, 3)])
        self.write("0.2", 200, [(0.3, 30), (0.4, 40)])
        names, rows = read_table(self.case, "balance")
        self.assertEqual(names, ["Time_s", "holdUp_m3"])
        np.testing.assert_array_equal(rows, [(0.1, 1), (0.2, 2), (0.3, 30), (0.4, 40)])

    def test_a_restart_from_an_earlier_time_counts_more_than_an_older_one_from_a_later(self):
        self.write("0", 100, [(0.1, 1), (0.2, 2), (0.3, 3)])
        self.write("0.2", 200, [(0.3, 30), (0.4, 40)])
        self.write("0.1", 300, [(0.2, 200), (0.3, 300), (0.4, 400), (0.5, 500)])
        np.testing.assert_array_equal(read_columns(self.case, "balance")["holdUp"], [1, 200, 300, 400, 500])

    def test_a_line_that_was_being_written_is_left_out(self):
        for half in ("0.2\t2.5e-", "0.2\t2", "0.2"):
            self.write("0", 100, [(0.1, 1)], end="\n" + half)
            np.testing.assert_array_equal(read_columns(self.case, "balance")["holdUp"], [1])

    def test_other_lines_that_are_no_numbers_are_refused_by_their_place(self):
        self.write("0", 100, [(0.1, 1), (0.2, "x"), (0.3, 3)])
        with self.assertRaisesRegex(TableError, "balance.dat: line 5"):
            read_table(self.case, "balance")
        self.write("0", 100, [(0.1, 1), (0.2,), (0.3, 3)])
        with self.assertRaisesRegex(TableError, "line 5 has 1 numbers"):
            read_table(self.case, "balance")

    def test_a_missing_table_is_reported(self):
        with self.assertRaisesRegex(TableError, "did the flow run"):
            read_table(self.case, "balance")


class TimeMean(unittest.TestCase):
    def test_weighs_by_the_time_that_a_value_stands_for(self):
        self.assertAlmostEqual(time_mean([0.1, 0.2, 0.5], [1, 1, 4], 0), (0.1 + 0.1 + 0.3 * 4) / 0.5)

    def test_begins_where_it_is_asked(self):
        self.assertAlmostEqual(time_mean([0.1, 0.2, 0.5], [9, 1, 4], 0.15), (0.1 + 1.2) / 0.4)
        self.assertTrue(np.isnan(time_mean([0.1, 0.2], [1, 1], 0.5)))

    def test_a_value_at_the_begin_is_that_of_the_time_before(self):
        self.assertAlmostEqual(time_mean([1.0, 2.0, 3.0], [9, 1, 4], 1.0), 2.5)


if __name__ == "__main__":
    unittest.main()
