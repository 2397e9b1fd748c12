#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of numbers are read by their names, units and format; the resolved mill and the record of a flow are read out
of them."""
import json
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.data_files import DataError, number, read_csv, read_json, write_csv
from millfoam.files.flow_record import read_flow_record
from millfoam.files.mill import fnv1a, read_mill
from millfoam.readings.axial import discharge, slurry_volumes
from millfoam.readings.slurry_in_cells import count_steps
from report_cases import OMEGA, PRINTS, change_json, write_mill, write_steps


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="data-")))
        self.file = self.folder / "file"


class Json(Folder):
    def test_null_is_no_number_and_other_things_are_refused(self):
        content = {"a": {"b": 1.5, "c": None, "d": "1", "e": True}}
        self.assertEqual(number(content, "f.json", "a", "b"), 1.5)
        self.assertTrue(np.isnan(number(content, "f.json", "a", "c")))
        for key, words in (("d", "a.d = '1'; expected a number"), ("e", "a.e = True; expected"),
                           ("f", "f.json: no a.f")):
            with self.assertRaisesRegex(DataError, words):
                number(content, "f.json", "a", key)

    def test_a_file_that_is_not_there_cut_short_or_of_another_format_is_named(self):
        whole = '{"format": "millfoam-mesh", "cells": 4}'
        for text, words in ((None, "file: No such file"), (whole[:-1], "file: line 1, column .* not JSON: .*cut short"),
                            (whole.replace("mesh", "flow"), "file: format 'millfoam-flow'; expected 'millfoam-mesh'"),
                            ("3", "file: format None")):
            if text is not None:
                self.file.write_text(text)
            with self.assertRaisesRegex(DataError, words):
                read_json(self.file, "mesh")
        self.file.write_text(whole)
        self.assertEqual(read_json(self.file, "mesh")["cells"], 4)


class Csv(Folder):
    def test_columns_go_by_their_names(self):
        self.file.write_text("time_s,power_W\n0.5,3\n1,nan\n1.5")  # the last line is being written
        found = read_csv(self.file)
        self.assertEqual(list(found), ["time_s", "power_W"])
        np.testing.assert_array_equal(found["power_W"], [3, np.nan])
        self.file.write_text("time_s,power_W\n")
        self.assertEqual(len(read_csv(self.file)["time_s"]), 0)

    def test_a_line_that_is_no_row_of_numbers_is_named(self):
        for text, words in (("a,b\n1,2\n3\n", "line 3 has 1 numbers; expected 2"),
                            ("a,b\n1,much\n", "line 2: .*much"), ("", "no complete line")):
            self.file.write_text(text)
            with self.assertRaisesRegex(DataError, words):
                read_csv(self.file)

    def test_written_rows_are_read_again(self):
        write_csv(self.file, [{"a": 1 / 3, "b_m": 2}, {"a": np.nan, "b_m": 3}])
        columns = read_csv(self.file)
        self.assertEqual(list(columns), ["a", "b_m"])
        np.testing.assert_array_equal(columns["a"], [1 / 3, np.nan])
        np.testing.assert_array_equal(columns["b_m"], [2, 3])
        self.assertEqual([one.name for one in self.folder.iterdir()], ["file"])

    def test_a_row_without_a_column_has_an_empty_place(self):
        write_csv(self.file, [{"a": 1 / 3, "b": "x, y"}, {"c": None, "a": np.float64(2e6)}], digits=3)
        self.assertEqual(self.file.read_text(), 'a,b,c\n0.333,"x, y",\n2e+06,,\n')

    def test_a_table_that_cannot_be_written_keeps_the_older_one(self):
        self.file.write_text("a\n1\n")
        with self.assertRaises(UnicodeEncodeError):
            write_csv(self.file, [{"a": 1}, {"a": "\ud800"}])
        self.assertEqual(self.file.read_text(), "a\n1\n")


class Mill(Folder):
    def test_has_what_was_derived_and_what_was_asked_for(self):
        classes = [{"diameter_m": diameter, "simulated": diameter > 0.004} for diameter in (0.003, 0.005, 0.002)]
        lifters = {"depth_m": 0.02, "layers": 2, "discharge_radius_m": 0.04}
        write_mill(self.folder, "Küchenmühle", geometry={"pulp_lifters": lifters},
                   charge={"fines_share": 0.5, "load": 0.2, "load_asked": 0.4, "classes": classes})
        mill = read_mill(self.folder)
        self.assertEqual((mill.title, mill.radius, mill.length, mill.omega, mill.sense),
                         ("Küchenmühle", 0.15, 0.06, OMEGA, "clockwise"))
        self.assertEqual((mill.lifters, mill.discharge_radius, mill.is_slice), ((8, 0.01, 0.01, 0.01), 0.04, False))
        self.assertEqual((mill.load, mill.load_asked, mill.largest_fines), (0.2, 0.4, 0.003))
        self.assertEqual((mill.asked("charge", "fill"), mill.asked("charge", "seed")), (0.3, None))
        self.assertEqual((mill.flow("law"), mill.flow("turns")), ("Beetstra", None))

    def test_that_turns_the_other_way_says_so(self):
        write_mill(self.folder, speed={"angular_velocity_rad_s": 6.0})
        self.assertEqual(read_mill(self.folder).sense, "anticlockwise")

    def test_tells_whether_its_file_was_changed_since(self):
        write_mill(self.folder)
        self.assertIs(read_mill(self.folder).changed_since(), False)
        with open(self.folder / "mill.yaml", "a") as file:
            file.write("# later\n")
        self.assertIs(read_mill(self.folder).changed_since(), True)
        (self.folder / "mill.yaml").unlink()
        self.assertIsNone(read_mill(self.folder).changed_since())
        # A resolved mill that was read again and resolved into the same file
        change_json(self.folder / "mill.json", "file", to="mill.json")
        self.assertIsNone(read_mill(self.folder).changed_since())

    def test_the_hash_is_fowler_nolls_and_vos(self):
        # Values of the authors' list
        for text, value in ((b"", "cbf29ce484222325"), (b"a", "af63dc4c8601ec8c"), (b"foobar", "85944171f73967e8")):
            self.assertEqual(fnv1a(text), value)

    def test_as_text_every_key_and_number_stands_in_it(self):
        write_mill(self.folder)
        text = read_mill(self.folder).text()

        def leaves(values):
            return [leaf for one in (values.values() if isinstance(values, dict) else values) for leaf in (
                leaves(one) if isinstance(one, (dict, list)) else [one])]

        content = json.loads((self.folder / "mill.json").read_text())
        for leaf in leaves(content["derived"]) + leaves(content["mill"]) + list(PRINTS.values()):
            self.assertIn(leaf if isinstance(leaf, str) else json.dumps(leaf), text)
        self.assertLess(max(map(len, text.splitlines())), 130)


class Flow(Folder):
    def test_restarts_are_joined_and_what_was_computed_twice_counts_once(self):
        write_steps(self.folder, 0, np.array([0.1, 0.2, 0.3, 0.4]), complete=False)
        write_steps(self.folder, 0.2, np.array([0.25, 0.35]), complete=False)
        write_steps(self.folder, 0.35, np.array([0.5, 1.5]), limits={"maxCo": 0.3})
        (self.folder / "postProcessing" / "flow" / "notes").mkdir()
        record = read_flow_record(self.folder)
        np.testing.assert_allclose(record.steps["time_s"], [0.1, 0.2, 0.25, 0.35, 0.5, 1.5])
        self.assertEqual((record.complete, record.last["limits"]["maxCo"], len(record.summaries)), (True, 0.3, 3))
        self.assertEqual(count_steps(self.folder), 6)

    def test_starts_go_by_their_time_and_not_their_name(self):
        write_steps(self.folder, 10, np.array([10.5]))
        write_steps(self.folder, 9, np.array([9.5, 10.2]), complete=False)
        record = read_flow_record(self.folder)
        np.testing.assert_allclose(record.steps["time_s"], [9.5, 10.5])
        self.assertTrue(record.complete)

    def test_steps_are_read_without_a_summary(self):
        for start, times in ((0, [0.5, 1.0, 1.5, 2.0]), (1, [1.2])):
            write_steps(self.folder, start, np.array(times))
            (self.folder / "postProcessing" / "flow" / str(start) / "flow.json").unlink()
        np.testing.assert_allclose(slurry_volumes(self.folder)[0], (0.5, 1.0, 1.2))

    def test_a_flow_that_left_nothing_has_no_steps(self):
        record = read_flow_record(self.folder)
        self.assertEqual((record.steps, record.last, record.complete), (None, {}, None))
        self.assertEqual(count_steps(self.folder), 0)
        with self.assertRaisesRegex(RuntimeError, "no postProcessing/flow/START/steps.csv"):
            slurry_volumes(self.folder)

    def test_files_that_do_not_fit_together_are_named(self):
        write_steps(self.folder, 0, np.array([0.1, 0.2]))
        write_steps(self.folder, 0.2, np.array([0.3]))
        path = self.folder / "postProcessing" / "flow" / "0.2" / "steps.csv"
        for text, words in (("time_s,other\n0.3,1\n", "start at 0.2 s: its columns"),
                            ("other\n1\n", "start at 0.2 s has no column time_s")):
            path.write_text(text)
            with self.assertRaisesRegex(DataError, words):
                read_flow_record(self.folder)

    def test_discharge_is_the_feed_less_what_the_mill_keeps(self):
        write_steps(self.folder, 0, np.linspace(0.1, 2, 20))
        times, volumes = slurry_volumes(self.folder)
        self.assertAlmostEqual(discharge(times, volumes + 1e-5 * times, 3e-5, 1.0), 2e-5, delta=1e-12)
        with self.assertRaisesRegex(RuntimeError, "no two steps from 2 s on"):
            discharge(times, volumes, 3e-5, 2)

    def test_a_record_cut_short_is_reported(self):
        write_steps(self.folder, 0, np.array([0.1]))
        path = self.folder / "postProcessing" / "flow" / "0" / "flow.json"
        change_json(path, "complete", to=False)
        path.write_text(path.read_text()[:40])
        with self.assertRaisesRegex(DataError, "flow.json: line 1.* not JSON"):
            read_flow_record(self.folder)


if __name__ == "__main__":
    unittest.main()
