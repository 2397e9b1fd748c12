#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""When a flow with flow.steady ends: at which times it is judged, and for which reason it ends."""
import json
import tempfile
import unittest
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_json
from millfoam.files.mill import SECTIONS, Mill
from millfoam.report.steady import End, main, next_time

TURN, FEED = 2.0, 1e-4  # s, m3/s
HEAD = "# Time_s\tholdUp_m3\tx_m\ty_m\tfed_m3\tdischarged_m3\tdischarge_m3/s\n"


def mill(turns=4, hours=None, duration=40.0, feed=0.0, machine="tumbling"):
    """A mill whose flow ends by itself."""
    sections = dict.fromkeys(SECTIONS, {})
    return Mill(Path("mill.json"), {
        "mill": sections, "derived": {
            **sections, "machine": machine, "geometry": {"radius_m": 0.1},
            "speed": {"angular_velocity_rad_s": -2 * np.pi / TURN, "turn_s": TURN},
            "flow": {"steady": {"turns": turns, "hours": hours}, "duration_s": duration, "feed_m3_s": feed}},
        "fingerprint": {"flow": "ab"}, "program": "millMesh 1"})


def balance(end, drift=0.0, feed=0.0, leaves=1.0):
    """Columns of a hold-up of 1 l that drifts by a share of itself in a turn; leaves: discharge over feed."""
    time = np.arange(0, end + 1e-9, 0.01)
    noise = np.random.default_rng(3).normal(0, 1, (3, len(time)))
    return {"Time": time, "holdUp": 1e-3 * (1 + drift * time / TURN + 1e-4 * noise[0]), "x": 1e-5 * noise[1],
            "y": 1e-5 * noise[2], "fed": feed * time, "discharged": leaves * feed * time,
            "discharge": np.full_like(time, leaves * feed)}


class NextTime(unittest.TestCase):
    def test_a_flow_first_runs_its_start_and_as_many_turns_as_are_judged(self):
        self.assertEqual(next_time(mill(), None, 0), 12)
        self.assertEqual(next_time(mill(), balance(9.0), 0), 12)
        self.assertEqual(next_time(mill(duration=10), None, 0), 10)

    def test_a_steady_flow_ends_with_its_last_turns(self):
        found = next_time(mill(), balance(16.0), 0)
        self.assertEqual((found.reason, found.begin, found.end), ("steady", 8.0, 16.0))
        self.assertIn("from 8 s on (4 turns)", found.found)

    def test_one_that_drifts_continues_by_half_of_them(self):
        self.assertEqual(next_time(mill(), balance(12.0, drift=0.05), 0), 16)
        self.assertEqual(next_time(mill(duration=13), balance(12.0, drift=0.05), 0), 13)

    def test_it_ends_at_its_duration_and_after_its_hours(self):
        self.assertEqual(next_time(mill(duration=12), balance(12.0, drift=0.05), 0).reason, "duration")
        self.assertEqual(next_time(mill(hours=2), balance(12.0, drift=0.05), 2.5).reason, "hours")
        self.assertEqual(next_time(mill(hours=2), balance(12.0, drift=0.05), 1.5), 16)

    def test_discharge_must_be_the_feed(self):
        for leaves, ends in ((1.0, True), (0.99, True), (0.9, False), (1.1, False)):
            found = next_time(mill(feed=FEED), balance(12.0, feed=FEED, leaves=leaves), 0)
            self.assertEqual(isinstance(found, End), ends, leaves)

    def test_turns_whose_errors_are_too_large_do_not_end_it_until_there_are_more_of_them(self):
        # The discharge of single turns scatters by 10 %: three errors are 11 % of the feed over 8 turns, 5 % over 36
        columns, of_turns = balance(200.0, feed=FEED), np.random.default_rng(5).normal(0, 0.1, 101)
        columns["discharge"] = FEED * (1 + of_turns[(columns["Time"] / TURN + 1e-9).astype(int)])
        columns["discharged"] = np.cumsum(columns["discharge"]) * 0.01

        def ended(duration):
            found = 24.0
            while not isinstance(found, End):
                part = columns["Time"] <= found + 1e-6
                found = next_time(mill(turns=8, duration=duration, feed=FEED),
                                  {key: one[part] for key, one in columns.items()}, 0)
            return found
        found = ended(200.0)
        self.assertEqual(found.reason, "steady")
        self.assertGreater(found.end, 48)  # 24 s are the first 12 turns
        # Averages are over what was judged
        self.assertAlmostEqual(found.begin, found.end - TURN * int(found.end / TURN / 2))
        short = ended(60.0)
        self.assertEqual((short.reason, short.begin), ("duration", 44))
        self.assertIn("undecided: 3 standard errors of feed less discharge", short.found)

    def test_the_feed_must_have_replaced_the_slurry(self):
        # 1 l of it, by 0.05 l/s: in 20 s
        for end, ends in ((12.0, False), (19.0, False), (21.0, True)):
            found = next_time(mill(feed=FEED / 2), balance(end, feed=FEED / 2), 0)
            self.assertEqual(isinstance(found, End), ends, end)

    def test_a_stirred_mill_waits_for_its_surface_and_its_torque(self):
        for late, ends in ((100.0, False), (0.1, True)):  # s, in which they become steady
            columns = balance(12.0)
            rest = np.exp(-columns["Time"] / late)
            columns |= {"z": 0.05 * (1 - 0.3 * rest), "torque_impeller": 0.01 * (1 + rest)}
            found = next_time(mill(machine="stirred"), columns, 0)
            self.assertEqual(isinstance(found, End), ends, late)


class Command(unittest.TestCase):
    def setUp(self):
        self.case = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.asked = self.case / "asked"
        self.write(mill(), 12.0)

    def write(self, found, end, drift=0.0):
        """A case of a Mill whose flow has come to a time (s)."""
        (self.case / "mill.json").write_text(json.dumps({"format": "millfoam-mill", **found.content}))
        table = self.case / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat"
        table.parent.mkdir(parents=True, exist_ok=True)
        columns = balance(end, drift)
        with open(table, "w") as file:
            file.write(HEAD)
            np.savetxt(file, np.column_stack([columns[name] for name in (
                "Time", "holdUp", "x", "y", "fed", "discharged", "discharge")]), "%.15g", "\t")

    def start(self, name, wall, complete=True):
        """A start of the flow at a time, with the wall time (s) of two steps."""
        folder = self.case / "postProcessing" / "flow" / name
        folder.mkdir(parents=True)
        rows = [f"{float(name) + step:g},{share * wall:g}" for step, share in ((1, 0.5), (2, 1))]
        (folder / "steps.csv").write_text("\n".join(["time_s,wall_s", *rows, ""]))
        (folder / "flow.json").write_text(json.dumps({"format": "millfoam-flow", "complete": complete}))

    def said(self):
        """What the command prints."""
        with redirect_stdout(StringIO()) as out:
            main(self.case, self.asked)
        return out.getvalue().strip()

    def test_writes_why_it_ends_and_where_the_averages_begin(self):
        self.assertEqual(self.said(), "end")
        found = read_json(self.case / "steady.json", "steady")
        self.assertEqual((found["reason"], found["begin_s"], found["end_s"]), ("steady", 4, 12))
        self.assertEqual(found["mill"], {"flow": "ab"})

    def test_hours_are_those_of_all_starts(self):
        self.write(mill(hours=2), 12.0, drift=0.05)
        self.start("0", 3600)
        self.start("6", 3500)
        self.assertEqual(self.said(), "16")
        self.start("9", 200)
        self.assertEqual(self.said(), "end")
        self.assertEqual(read_json(self.case / "steady.json", "steady")["reason"], "hours")

    def test_an_interrupted_piece_is_computed_to_its_end(self):
        self.write(mill(), 13.0)
        self.asked.write_text("flowDuration 16.00000001;\n")
        self.assertEqual(self.said(), "16.00000001")
        self.write(mill(), 16.0)
        self.start("0", 1, complete=False)
        self.assertEqual(self.said(), "16.00000001")
        self.start("12", 1)
        self.assertEqual(self.said(), "end")


if __name__ == "__main__":
    unittest.main()
