#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The first lines of a report, and its texts about the mill that was run."""
import re
import unittest

import h5py
import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.report.build import compare_cases, report_case
from millfoam.report.case_readings import Readings, key_numbers, load_numbers
from millfoam.report.checks import all_checks
from millfoam.report.headline import first_lines, summary
from millfoam.report.stages import programs
from report_cases import DURATION, OMEGA, change_json, write_dry, write_flow
from report_test import Case

FINES = {"fines_share": 0.52, "load": 0.179, "load_asked": 0.375, "classes": [
    {"diameter_m": 0.005, "count": 1000, "mass_asked_kg": 2.0, "mass_kg": 2.0, "simulated": True},
    {"diameter_m": 0.003, "count": 0, "mass_asked_kg": 2.2, "mass_kg": 0.0, "simulated": False}]}


def change_derived(folder, section, **entries):
    for key, value in entries.items():
        change_json(folder / "mill.json", "derived", section, key, to=value)


def mirrored(folder):
    """Of a case its mirror image: a mill that turns anticlockwise."""
    change_derived(folder, "speed", angular_velocity_rad_s=-OMEGA, sense="anticlockwise")
    with h5py.File(folder / "solids.h5", "a") as file:
        file.attrs["angular_velocity"] = -OMEGA
        for name in ("solidity", "solidity_deviation", "velocity", "grid/insideFraction"):
            values = file[name][:][:, :, :, ::-1]
            file[name][...] = values * (-1, 1, 1) if name == "velocity" else values
    table = folder / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat"
    head, *rows = table.read_text().splitlines()
    rows = np.array([row.split("\t") for row in rows], dtype=float)
    rows[:, head.split("\t").index("x_m")] *= -1
    np.savetxt(table, rows, "%.9g", "\t", header=head[2:], comments="# ")
    return folder


class First(Case):
    def lines(self, folder):
        case = MillCase(folder)
        return first_lines(case, all_checks(case))

    def first_line(self, folder):
        """The first words of a page after its head."""
        self.undrawn()
        text = report_case(folder)
        self.assert_whole(text)
        return re.sub(r"<[^>]*>", "", re.search(r"<body>(.*?)(</li>|</h1>)", text, re.S).group(1))

    def test_of_a_whole_and_steady_flow_is_its_title(self):
        flow = write_flow(self.folder / "flow")
        self.assertEqual(self.lines(flow), [])
        self.assertEqual(self.first_line(flow), "A mill – flow")

    def test_of_a_flow_that_was_cut_short_says_that_its_numbers_describe_the_start(self):
        flow = write_flow(self.folder / "flow")
        for duration, reported in ((DURATION / 0.995, False), (DURATION / 0.985, True), (None, False)):
            change_derived(flow, "flow", duration_s=duration)
            self.assertEqual(bool(self.lines(flow)), reported, duration)
        change_derived(flow, "flow", duration_s=2.5)
        self.assertEqual(self.first_line(flow), "The flow was cut short: it ends at 0.8 s of 2.5 s. Its numbers "
                                                "describe the start of the flow.")

    def test_of_a_flow_that_does_not_say_that_it_is_complete_says_so_too(self):
        flow = write_flow(self.folder / "flow")
        change_json(flow / "postProcessing" / "flow" / "0" / "flow.json", "complete", to=False)
        self.assertRegex(self.lines(flow)[0], "^The flow was cut short: .*Its numbers describe the start of the flow")

    def test_of_a_flow_that_is_not_steady_says_that_its_numbers_describe_the_start(self):
        flow = write_flow(self.folder / "flow")
        table = flow / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat"
        head, *rows = table.read_text().splitlines()
        rows = np.array([row.split("\t") for row in rows], dtype=float)
        for drift, line in ((0.0, None), (0.012, "It is doubtful whether the flow is steady: .*describe the start"),
                            (0.1, "The flow is not steady: its numbers describe the start of the flow")):
            moved = rows.copy()
            moved[:, head.split("\t").index("y_m")] += drift * (rows[:, 0] - 0.4)
            np.savetxt(table, moved, "%.9g", "\t", header=head[2:], comments="# ")
            found = self.lines(flow)
            self.assertEqual(len(found), line is not None, found)
            if line:
                self.assertRegex(found[0], line)

    def test_a_repeated_charge_is_reported(self):
        flow = write_flow(self.folder / "flow")
        change_json(flow / "postProcessing" / "flow" / "0" / "flow.json", "solids", "repeated", to=2)
        self.assertRegex(" ".join(self.lines(flow)), "record of the dry charge .* was repeated 2 times")

    def test_a_verdict_that_no_longer_run_can_change_says_what_it_means(self):
        flow = write_flow(self.folder / "flow")
        for time in ("0.4", "0.6", "0.8"):
            path = flow / time / "forceOverWeight"
            path.write_text(path.read_text().replace("\n0.1\n", "\n0.9\n").replace("\n0.1\n", "\n0.9\n"))
        found = self.lines(flow)
        self.assertEqual(len(found), 1)
        self.assertRegex(found[0], "“The slurry would not move the balls” fails, and a longer run does not change "
                                   "that: the numbers "
                                   "hold for a charge that the slurry does not move; .*")
        self.assertEqual(self.first_line(flow), found[0])

    def test_stages_of_two_mills_are_reported(self):
        flow = write_flow(self.folder / "flow")
        change_json(flow / "dumps" / "run.json", "mill", "charge", to="f" * 16)
        self.assertRegex(self.lines(flow)[0], "Stages of different mills are mixed")

    def test_of_several_cases_names_the_one_that_it_is_about(self):
        self.undrawn()
        one, other = write_flow(self.folder / "one"), write_flow(self.folder / "other")
        change_derived(other, "flow", duration_s=2.5)
        text = compare_cases([one, other])
        self.assertRegex(text, r'<body><header><div><ul class="first"><li>other: The flow was cut short: '
                               r'[^<]*</li></ul><h1>')


class TheMill(Case):
    def test_fines_that_are_left_out_are_in_the_title_and_with_the_load(self):
        self.undrawn()
        dry = write_dry(self.folder / "dry", "Mill of 37.5 % load")
        change_derived(dry, "charge", **FINES)
        found = self.assert_whole(report_case(dry))
        words = re.sub(r"\s+", " ", found.text)
        self.assertIn("Mill of 37.5 % load – dry, without balls of 3 mm and less (52 % of the mass)", words)
        self.assertIn("load of balls, as simulated 17.9 % load of balls, as requested 37.5 %", words)
        self.assertIn("left out: balls of 3 mm and less 52 % of the mass", words)

    def test_all_balls_that_are_simulated_have_one_load(self):
        mill = MillCase(write_dry(self.folder / "dry")).mill
        self.assertIsNone(mill.asked("charge", "classes"))  # of one size by fill, as in all reports here
        self.assertEqual(load_numbers(mill), [("load of balls", "30 %")])

    def test_that_was_run_is_shown_with_its_fingerprint_and_settings(self):
        self.undrawn()
        dry = write_dry(self.folder / "dry")
        words = re.sub(r"\s+", " ", self.assert_whole(report_case(dry)).text)
        self.assertIn("fingerprint: charge 0000000000000002", words)
        self.assertIn("changed by --set flow.law=Beetstra", words)
        self.assertIn("The resolved mill (mill.json)", words)
        self.assertNotIn("was changed after this run", words)
        for stage, program in (("mill.json", "millMesh"), ("solids.h5", "millAverage"),
                               ("dumps/results.json", "chargeTool")):
            self.assertIn(f"{stage} {program} 1.2.3", words)
        (dry / "mill.yaml").write_text("geometry: {diameter: 2}\n")
        words = re.sub(r"\s+", " ", self.assert_whole(report_case(dry)).text)
        self.assertIn("mill.yaml was changed after this run; the report shows the run's mill", words)
        self.assertIn("300 × 60 mm", words)

    def test_programs_are_those_of_the_files(self):
        flow = write_flow(self.folder / "flow")
        rows = dict(programs(MillCase(flow)))
        self.assertEqual(rows["postProcessing/flow/0/flow.json"], "flowTool 1.2.3")
        self.assertEqual(rows["OpenFOAM of the flow"], "version v1912, build abc-1")
        self.assertEqual(rows["LIGGGHTS of the balls"], "Version 3.8")

    def test_that_turns_the_other_way_has_the_numbers_of_its_mirror_image(self):
        here, there = (MillCase(make(write_flow(self.folder / name))) for name,
                       make in (("a", lambda one: one), ("b", mirrored)))
        numbers = [dict(key_numbers(case, Readings(case))) for case in (here, there)]
        for name in ("centre of circulation, x to the falling side", "centre of the slurry, x to the falling side",
                     "shoulder of the charge", "toe of the charge"):
            self.assertEqual(*(one[name] for one in numbers))
        self.assertRegex(numbers[0]["centre of circulation, x to the falling side"], "^-30")
        self.assertAlmostEqual(there.charge.centroid()[0], -here.charge.centroid()[0])
        self.assertIn(", clockwise at 74.2 %", summary(here))
        self.assertIn(", anticlockwise at 74.2 %", summary(there))

    def test_has_the_time_at_which_the_averages_of_its_flow_begin(self):
        flow = write_flow(self.folder / "flow")
        # Start of the averages, duration: where less than half of what was to be averaged is there, the half of what is
        for start, duration, begin in ((0.5, 0.8, 0.5), (0.5, 1.0, 0.5), (0.5, 1.2, 0.4), (0.9, 2.0, 0.4),
                                       (None, None, 0.4)):
            change_derived(flow, "flow", averages_start_s=start, duration_s=duration)
            self.assertEqual(MillCase(flow).begin, begin)


if __name__ == "__main__":
    unittest.main()
