#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the same runs of two machines, compared number by number: which differ, when a run does, and what is
refused. By `Allrun --against` of the study mill_30cm_published."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.data_files import DataError, write_csv
from millfoam.readings.means import Mean, block_mean
from millstudies.compared_tables import ComparedRun, Number, compared, read_table, require_same
from millstudies.mean_columns import freedom_columns, mean_of

STUDY = Path(__file__).resolve().parents[2] / "cases" / "studies" / "mill_30cm_published"


def row(name, version="0.3.0+a", feed=65.3, **means):
    """A line of flows.csv: `discharge` of the keywords is column `discharge, mm`."""
    return {"run": name, "version": version, "speed, %": 75, "solids, %": 20, "law": "–", "turns": 2,
            "feed, ml/s": feed, "hold-up at last, l": 3.4, **{key: value for column, mean in means.items()
                                                              for key, value in freedom_columns(f"{column}, mm", mean
                                                                                                ).items()}}


def numbers(count, differing):
    """So many numbers, of which the first ones differ."""
    return [Number(f"{k}", Mean(1.0 + 9 * (k < differing), 0.1, 2), Mean(1.0, 0.1, 2)) for k in range(count)]


class Numbers(unittest.TestCase):
    def test_a_difference_needs_welchs_degrees_of_freedom(self):
        # Equal errors of two turns: two degrees of freedom, 4.3 errors of 0.14
        for apart, differs in ((0.55, False), (0.65, True)):
            one = Number("a, mm", Mean(1.0 + apart, 0.1, 1), Mean(1.0, 0.1, 1))
            self.assertEqual(one.difference.sign != 0, differs)
            self.assertEqual("differs" in one.line, differs)
            self.assertIn(f"{apart / 0.1 / np.sqrt(2):.2f} of 4.3", one.line)
        self.assertIn("1.60 ± 0.10 (1)", Number("a, mm", Mean(1.6, 0.1, 1), Mean(1.0, 0.1, 1)).line)

    def test_a_number_that_one_does_not_know_is_not_compared(self):
        for other in (Mean(np.nan, np.nan), Mean(1.0, np.nan, 0)):
            one = Number("a, mm", Mean(1.0, 0.1, 1), other)
            self.assertFalse(one.is_known)
            self.assertIn("not compared", one.line)
        # Both without an error, of turns that are equal
        self.assertFalse(Number("a, mm", Mean(1.0, 0.0, 1), Mean(2.0, 0.0, 1)).is_known)

    def test_a_run_differs_in_more_numbers_than_chance_gives(self):
        # Of 22 numbers, five or more have a probability of 0.4 %, four or more of 2.2 %
        for differing, expected in ((0, False), (4, False), (5, True)):
            run = ComparedRun("seed", ("a", "b"), numbers(22, differing))
            self.assertEqual((run.differing, run.most, run.differs), (differing, 4, expected))
        self.assertEqual(run.line, "seed: 5 of 22 numbers differ; by chance 1.1, at most 4: the run differs")
        self.assertFalse(ComparedRun("seed", ("a", "b"), []).differs)
        # Two of two: 0.25 %. A single number of one, by its difference: with two degrees of freedom, 4.6 errors have a
        # probability of 4.4 %, and 14 errors of 0.5 %
        self.assertTrue(ComparedRun("seed", ("a", "b"), numbers(2, 2)).differs)
        for apart, expected in ((0.65, False), (2.0, True)):
            one = Number("a, mm", Mean(1.0 + apart, 0.1, 1), Mean(1.0, 0.1, 1))
            self.assertEqual(ComparedRun("seed", ("a", "b"), [one]).differs, expected)
            # Of ten runs, each has a tenth of the chance
            self.assertFalse(ComparedRun("seed", ("a", "b"), [one], 0.001).differs)

    def test_the_same_run_is_seldom_called_different(self):
        # 22 numbers of three turns, independent, and with a correlation of a half as numbers of a flow may have
        random = np.random.default_rng(4)

        def turns(correlation):
            return (np.sqrt(correlation) * random.standard_normal((3, 1))
                    + np.sqrt(1 - correlation) * random.standard_normal((3, 22)))

        def differs(correlation):
            pairs = zip(*(map(block_mean, turns(correlation).T) for _ in range(2)))
            return ComparedRun("a", ("", ""), [Number("a", *pair) for pair in pairs]).differs
        for correlation, most in ((0.0, 0.01), (0.5, 0.06)):
            self.assertLessEqual(np.mean([differs(correlation) for _ in range(400)]), most)

    def test_a_number_that_is_another_one_is_counted_once(self):
        here = row("seed", first=Mean(1.0, 0.1, 1), last=Mean(1.0, 0.1, 1), none=Mean(np.nan, np.nan))
        there = row("seed", first=Mean(1.2, 0.1, 1), last=Mean(1.2, 0.1, 1), none=Mean(np.nan, np.nan))
        self.assertEqual([one.column for one in compared("seed", here, there).numbers], ["first, mm"])
        there["last, mm"] = 1.3
        self.assertEqual(len(compared("seed", here, there).numbers), 2)


class Tables(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.here, self.there = self.folder / "here", self.folder / "there"
        for folder in (self.here, self.there):
            folder.mkdir()
        self.write(self.here, [row("seed", length=Mean(1.0, 0.1, 1)), row("layers_17", length=Mean(2.0, 0.1, 1))])

    @staticmethod
    def write(folder, rows, name="flows.csv"):
        write_csv(folder / name, rows)

    def against(self, *words):
        return subprocess.run([sys.executable, STUDY / "against.py", *(words or (self.there / "flows.csv", self.here))],
                              capture_output=True, text=True, check=False)

    def test_a_table_is_read_as_it_was_written(self):
        found = read_table(self.here / "flows.csv", ("seed", "layers_17"))
        self.assertEqual(list(found), ["seed", "layers_17"])
        self.assertEqual(mean_of(found["seed"], "length, mm"), Mean(1.0, 0.1, 1))
        self.assertEqual((found["seed"]["version"], found["seed"]["law"]), ("0.3.0+a", "–"))

    def test_tables_that_agree_pass_and_name_what_only_one_has(self):
        self.write(self.there, [row("seed", "0.3.0+b", length=Mean(1.1, 0.1, 1)),
                                row("layers_66", length=Mean(2.0, 0.1, 1))])
        self.write(self.here, [{"run": "dry_75", "version": "0.3.0+a", "speed, %": 75}], "charges.csv")
        done = self.against()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for words in ("== seed (version 0.3.0+a here, 0.3.0+b there)", "seed: 0 of 1 numbers differ; by chance 0.1",
                      "all: 0 of 1 numbers differ", "not there: layers_17", "not here: layers_66",
                      "not there: charges.csv, so dry runs are not compared"):
            self.assertIn(words, done.stdout)

    def test_dry_runs_are_compared_where_both_have_them(self):
        for folder, power in ((self.here, 33.24), (self.there, 33.60)):
            self.write(folder, [row("seed", length=Mean(1.0, 0.1, 1))])
            self.write(folder, [{"run": "dry_75", "version": "0.3.0+a", "speed, %": 75,
                                 **freedom_columns("power, W", Mean(power, 0.02, 8)),
                                 **freedom_columns("toe, deg", Mean(-power, 0.02, 8))}], "charges.csv")
        done = self.against(self.there, self.here)  # a folder
        self.assertEqual(done.returncode, 1)
        self.assertIn("dry_75: 1 of 1 numbers differ", done.stdout)
        self.assertNotIn("toe", done.stdout)  # its error is a lower bound
        self.assertIn("error: more numbers than chance gives in 99% of cases differ with 95% confidence: dry_75",
                      done.stderr)

    def test_without_a_common_run_it_fails(self):
        self.write(self.there, [row("layers_66", length=Mean(2.0, 0.1, 1))])
        done = self.against()
        self.assertEqual(done.returncode, 1)
        self.assertIn("no run is in both", done.stdout)

    def refused(self, words, text=None):
        """Whether the other table, with this text, is refused with these words, before and by the comparison."""
        if text is not None:
            (self.there / "flows.csv").write_text(text)
        with self.assertRaisesRegex(DataError, words):
            there = read_table(self.there / "flows.csv", ("seed", "layers_17"))
            require_same(read_table(self.here / "flows.csv", ("seed", "layers_17")), there, self.there / "flows.csv",
                         ("feed, ml/s", "law"))

    def test_what_is_not_such_a_table_is_refused_with_its_place(self):
        text = (self.here / "flows.csv").read_text()
        self.refused("flows.csv: No such file or directory")
        for words, other in (
                ("flows.csv: no column 'run' in ''", ""),
                ("flows.csv: no column 'run' in 'time,height'; expected a table of this study", "time,height\n1,2\n"),
                ("no column 'version' in .*--read", text.replace("version,", "", 1)),
                # Tables of versions before the degrees of freedom
                ("no column 'length, mm, freedom' in", text.replace('"length, mm, freedom"', "freedom")),
                ("flows.csv: no run; expected a line for each run", text.split("\n", 1)[0] + "\n"),
                ("line 2, column run: 'sead'; expected the name of a run of this study", text.replace("seed", "sead")),
                ("line 3, column run: 'seed'; expected .* once", text.replace("layers_17", "seed")),
                ("line 2, column 'length, mm': 'high'; expected a number", text.replace("3.4,1.0", "3.4,high")),
                ("line 2, column 'length, mm ±': -0.1; expected 0 or more", text.replace("1.0,0.1", "1.0,-0.1")),
                ("line 3: 10 places; expected 11, one for each column", text.rstrip()[:-2] + "\n"),
                ("no column 'hold-up at last, l'; expected the columns of the table here",
                 text.replace("hold-up at last, l", "hold-up, l")),
                ("a column 'more'; expected the columns of the table here",
                 "\n".join(line + ("" if not line else ",more" if line.startswith("run") else ",1")
                           for line in text.split("\n"))),
                ("run seed, column 'feed, ml/s': 93.2; expected 65.3, as here: it is another run",
                 text.replace("65.3", "93.2", 1)),
                ("run seed, column 'law': Hill; expected –", text.replace("–", "Hill", 1))):
            with self.subTest(words):
                self.assertNotEqual(other, text)
                self.refused(words, other)

    def test_a_table_that_cannot_be_compared_fails_before_all_is_read(self):
        for words in ((self.there / "flows.csv",), (self.there, self.here)):
            done = self.against(*words)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"^against: error: .*flows.csv: No such file or directory\n$")
        self.assertEqual(self.against(self.here).returncode, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
