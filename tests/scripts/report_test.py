#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of small cases are complete pages that need no network, name what is missing, and refuse folders that are no
mill's case."""
import json
import re
import subprocess
import tempfile
import unittest
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.mill import NoMill
from millfoam.files.mill_case import MillCase
from millfoam.files.outline import circle, lifter_outline
from millfoam.plots.mill_plots import plot_strip
from millfoam.readings import free_surface, models
from millfoam.readings.axial import Humps, drop, drop_over_turns, mean_profile
from millfoam.readings.maps_of_times import mean_flow, mean_of_times
from millfoam.readings.means import Mean, angle_mean, time_mean, turns_mean
from millfoam.readings.mill_power import power_begin
from millfoam.readings.power_models import hogg_fuerstenau
from millfoam.readings.slurry_on_maps import pool
from millfoam.readings.slurry_over_time import Way, slurry_blocks, slurry_way
from millfoam.report import comparison, figures, slurry_sections
from millfoam.report.build import compare_cases, report_case
from millfoam.report.case_readings import Readings, humps_words, key_numbers
from millfoam.report.power_section import net_note
from millfoam.report.sections import run_section, spans, stage_costs
from millfoam.report.words import uncertain
from report_cases import (OMEGA, PRINTS, TIME0, change_json, make_slice, write_dry, write_flow, write_fluid_only,
                          write_mill, write_slurry, write_solids, write_steps)

REPORT = Path(__file__).resolve().parents[2] / "scripts" / "report"
VOID = {"meta", "link", "img", "input", "br"}


class Page(HTMLParser):
    """Content of a page: ids, links, sources of images, text; errors: tags that are not balanced, ids given twice."""

    def __init__(self, text):
        super().__init__()
        self.open, self.errors, self.ids, self.links, self.images, self.words = [], [], [], [], [], []
        self.feed(text)
        self.close()
        self.errors += [f"{tag} was not closed" for tag in self.open]
        self.errors += [f"id {name} was given twice" for name in self.ids if self.ids.count(name) > 1]
        self.text = " ".join(self.words)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag not in VOID:
            self.open.append(tag)
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.links += [attributes["href"]] if "href" in attributes else []
        self.images += [attributes["src"]] if tag == "img" else []
        if tag == "img" and not attributes.get("alt"):
            self.errors.append("an image without words")

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append(f"{tag} was closed where {self.open[-1:]} was open")

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.words.append(data)


def undrawn(figure, **_):
    """In place of page.encode: a figure that was made, but not drawn, which is what takes the time."""
    plt.close(figure)
    return "data:image/png;base64,"


def keep(function, kept):
    """The function, which computes what it returns only once for the same arguments."""
    def found(*arguments, **options):
        key = (*(value.tobytes() if isinstance(value, np.ndarray) else value for value in arguments),
               *sorted(options.items()))
        if key not in kept:
            kept[key] = function(*arguments, **options)
        return kept[key]

    return found


# The cases of these tests have few surfaces, which are fitted in every report
FITS = {"free_surface.fit_logistic": keep(free_surface.fit_logistic, {}),
        "models.fit_free_surface": keep(models.fit_free_surface, {})}


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="report-")))
        for name, fit in FITS.items():
            self.enterContext(mock.patch(f"millfoam.readings.{name}", fit))

    def undrawn(self):
        self.enterContext(mock.patch("millfoam.report.page.encode", undrawn))
        self.enterContext(mock.patch("matplotlib.figure.Figure.draw_without_rendering"))
        # They make ticks, which takes half of the rest
        for name in ("set_clip_path", "set_tick_params", "grid"):
            self.enterContext(mock.patch(f"matplotlib.axis.Axis.{name}"))
        self.enterContext(mock.patch("millfoam.report.sections.FRAMES", 2))

    def assert_whole(self, text):
        """A page that is balanced, has its links' goals within it and its images in it; returns it."""
        found = Page(text)
        self.assertEqual(found.errors, [])
        # A name space is no reference, and there is none either
        self.assertNotRegex(text, r"https?://")
        self.assertNotRegex(text, r"(?:src|href)=\"(?!data:|#)")
        self.assertNotRegex(text, r"@import|url\(")
        goals = [link[1:] for link in found.links if link.startswith("#")]
        self.assertTrue(goals)
        self.assertLessEqual(set(goals), set(found.ids))
        self.assertTrue(all(image.startswith("data:image/png;base64,") for image in found.images))
        self.assertNotRegex(found.text, r"\bnan\b|\bNone\b|\binf\b")
        return found

    def command(self, *arguments):
        return subprocess.run([REPORT, *map(str, arguments)], capture_output=True, text=True)


class Models(Case):
    def test_moys_hold_up_stands_along_the_axis_and_adds_up_to_its_volume(self):
        slurry = {"plastic_viscosity_Pa_s": 0.01, "density_kg_m3": 1200.0}
        mill = SimpleNamespace(sauter_diameter=0.005, discharge_radius=0.05, slurry=slurry.get)
        case = SimpleNamespace(folder=self.folder, mill=mill, radius=0.15, length=0.3, feed=5e-5, begin=0.0, turn=1.0,
                               charge=SimpleNamespace(solidity=np.full((3, 3), 0.6)),
                               balance={"Time": np.array([0.0, 1.0]), "holdUp": np.array([2e-3, 2e-3])})
        profile = SimpleNamespace(z=np.linspace(0.05, 0.25, 5), holdup=np.full(5, 4e-4))
        with mock.patch.object(figures, "holdup_along", wraps=figures.holdup_along) as drawn:
            cards = slurry_sections.moys(case, profile)
        self.assertEqual(len(cards), 2)
        _, z, model = drawn.call_args.args
        shown = float(re.search(r"hold-up by the model.*?(\d+) ml", cards[0]).group(1))
        self.assertAlmostEqual(1e6 * np.trapz(model, z), shown, delta=1)
        self.assertEqual(len(slurry_sections.moys(case, "no profile")), 1)


class OneCase(Case):
    def test_a_dry_run_has_its_charge_and_no_slurry(self):
        self.undrawn()
        found = self.assert_whole(report_case(write_dry(self.folder / "dry", "Speed < 75 % & more")))
        self.assertIn("Speed < 75 % & more – dry", found.text)
        self.assertLessEqual({"overview", "checks", "charge", "ledger", "run"}, set(found.ids))
        self.assertFalse({"slurry", "axis", "balance", "contacts"} & set(found.ids))
        self.assertIn("3.210 ± 0.012 W", found.text)
        self.assertNotIn("✗ fails", found.text)

    def test_power_is_shown_for_length_and_balls_and_among_the_models(self):
        self.undrawn()
        words = re.sub(r"\s+", " ", self.assert_whole(report_case(write_dry(self.folder / "dry"))).text)
        self.assertIn("charge 3.210 ± 0.012 W 53.50 ± 0.21 W/m 1.605 ± 0.006 W/kg", words)
        # The models have no lifters: the bulk of 2 kg of balls is a larger share of the shell than of the mill, 0.3
        filling = 2.0 / 2500 / 0.6 / (np.pi * 0.15**2 * 0.06)
        self.assertGreater(filling, 0.31)
        model = hogg_fuerstenau(0.3, 0.06, 6 / 8.09, filling, 0.6 * 2500)
        self.assertIn(f"Hogg & Fuerstenau, 35°, dry {model:.3g} W {3.21 / model:.2f}", words)
        fast = write_dry(self.folder / "fast")
        change_json(fast / "mill.json", "derived", "speed", "fraction_of_critical", to=1.1)
        self.assertIn("speed is 1.1; expected a share above 0 and at most 1",
                      self.assert_whole(report_case(fast)).text)

    def test_a_dry_run_beside_the_mesh_of_a_flow_to_come_is_no_failed_flow(self):
        self.undrawn()
        dry = write_dry(self.folder / "dry")
        (dry / "constant").mkdir()
        (dry / "constant" / "millProperties").write_text("radius 0.15;\n")
        self.assertNotIn("The flow is not shown", self.assert_whole(report_case(dry)).text)
        write_steps(dry, 0, np.array([0.01, 0.02]), complete=False)
        self.assertRegex(self.assert_whole(report_case(dry)).text, "The flow is not shown: .*millProperties: "
                                                                   ".*expected omega")
        (dry / "constant" / "millProperties").write_text("radius 0.15;\nomega -6;\ntime0 0;\nlength 0.3;\n")
        self.assertIn("The flow is not shown", self.assert_whole(report_case(dry)).text)

    def test_a_flow_with_everything_has_all_sections(self):
        found = self.assert_whole(report_case(write_flow(self.folder / "flow")))
        self.assertLessEqual({"overview", "checks", "charge", "slurry", "axis", "balance", "ledger", "run"},
                             set(found.ids))
        self.assertIn("slurry.h5", found.text)
        self.assertNotIn("✗ fails", found.text)

    def test_a_flow_without_tables_and_voxels_is_read_from_its_written_times(self):
        self.undrawn()
        found = self.assert_whole(report_case(write_flow(self.folder / "flow", tables=False, voxels=False)))
        self.assertIn("the 3 written times", found.text)
        self.assertIn("slurry", found.ids)
        self.assertIn("axis", found.ids)
        self.assertNotIn("balance", found.ids)
        self.assertIn("– not known", found.text)

    def test_a_half_written_slurry_file_is_reported_and_not_used(self):
        self.undrawn()
        flow = write_flow(self.folder / "flow")
        write_slurry(flow / "slurry.h5", complete=0)
        found = self.assert_whole(report_case(flow))
        self.assertIn("slurry.h5: not used, because it is not complete", found.text)
        self.assertIn("written times", found.text)
        (flow / "slurry.h5").write_bytes((flow / "slurry.h5").read_bytes()[:3000])
        self.assertIn("slurry.h5: not used, because it is cut short", Page(report_case(flow)).text)

    def test_a_table_that_cannot_be_read_is_reported(self):
        flow = write_flow(self.folder / "flow", voxels=False)
        table = flow / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat"
        lines = table.read_text().splitlines()
        lines[40] = "much" + lines[40]
        table.write_text("\n".join(lines))
        case = MillCase(flow)
        self.assertIsNone(case.balance)
        self.assertRegex(" ".join(case.unusable), "slurryBalance.dat: line 41: .*much")

    def test_averages_begin_where_they_are_asked_to(self):
        case = MillCase(write_flow(self.folder / "flow"), 0.5)
        self.assertEqual((case.begin, case.charge_span[0]), (0.5, TIME0 + 0.5))
        for begin in (9, 0.8, -1, float("nan")):
            with self.assertRaisesRegex(RuntimeError, f"from {begin:g} s on; expected 0 or more and less than the "
                                                      f"flow's last "
                                                      "written time, 0.8 s"):
                MillCase(self.folder / "flow", begin)
        with self.assertRaisesRegex(RuntimeError, "from -1 s on; expected 0 or more and less than the end of "
                                                  "solids.h5, 2 s"):
            MillCase(write_dry(self.folder / "dry"), -1)

    def test_a_periodic_slice_has_no_ends(self):
        self.undrawn()
        found = self.assert_whole(report_case(make_slice(write_flow(self.folder / "flow"))))
        self.assertNotRegex(found.text, r"drop of p_rgh|\bfeed\b|\bdischarge\b")
        self.assertIn("toe of the slurry", found.text)

    def test_a_flow_without_balls_has_no_words_on_the_charge(self):
        self.undrawn()
        found = self.assert_whole(report_case(write_fluid_only(self.folder / "flow")))
        self.assertNotRegex(found.text, "orange|clear of the charge|batch means|balls give|load of balls")
        self.assertIn("drop of p_rgh", found.text)

    def test_power_by_wall_and_slip_are_shown_if_the_table_has_them(self):
        self.undrawn()
        found = self.assert_whole(report_case(write_flow(self.folder / "flow")))
        words = re.sub(r"\s+", " ", found.text)
        self.assertIn("shell −0.01 0.06 lifters −0.07 0.42 all −0.08 0.5", words)
        self.assertIn("Slip past the balls largest slip since 0.4 s 1.25 m/s", words)

    def test_numbers_of_the_slurry_have_errors_over_whole_turns(self):
        self.undrawn()
        case = self.short_turns(write_flow(self.folder / "flow"))
        columns, late = case.balance, case.balance["Time"] > case.begin + 1e-9
        case.balance["feed"] = 2e-5 + 0 * columns["Time"]
        readings = Readings(case)
        rows = dict(key_numbers(case, readings))
        for name, key, scale in (("hold-up of slurry", "holdUp", 1e6), ("discharge", "discharge", 1e6),
                                 ("feed minus discharge", "discharge", -1e6)):
            turns = columns[key][late].reshape(4, 10).mean(axis=1)
            error = turns.std(ddof=1) / 2
            value = scale * (time_mean(columns["Time"], columns[key], case.begin) - (2e-5 if scale < 0 else 0))
            self.assertEqual(rows[name], uncertain(value, abs(scale) * error, "ml" if key == "holdUp" else "ml/s"))
        self.assertEqual(rows["feed"], "20.0 ml/s")
        words = " ".join(re.sub(r"<[^>]*>", " ", card) for card in slurry_sections.balance_section(case, readings))
        turns = columns["power"][late].reshape(4, 10).mean(axis=1)
        power = time_mean(columns["Time"], columns["power"], case.begin)
        self.assertIn(uncertain(power, turns.std(ddof=1) / 2, ""), words)
        self.assertNotIn("20 ±", rows["drop of p_rgh in the slurry along the axis (straight line)"])

    def test_the_drop_of_pressure_and_the_pool_have_errors(self):
        case = self.short_turns(write_flow(self.folder / "flow"))
        readings = Readings(case)
        # Of successive turns of ten rows, whose pressures fall by 40, 50, 60 and 50 Pa
        series = readings.series
        falls = np.repeat([40.0, 50.0, 60.0, 50.0], 10)
        along = (series.z - series.z[0]) / np.ptp(series.z)
        pressure = 100 - falls[:, None] * along
        series = replace(series, times=series.times[-40:], pressure=pressure, height=series.height[-40:],
                         holdup=series.holdup[-40:])
        self.assertAlmostEqual(drop(mean_profile(series)), 50)
        self.assertAlmostEqual(drop_over_turns(series, case.begin, case.turn).error,
                               np.std([40, 50, 60, 50], ddof=1) / 2)
        blocks = [replace(readings.slurry, share=scale * readings.slurry.share) for scale in (0.8, 1.0, 0.9)]
        areas = [pool(one, np.zeros_like(one.share)).area for one in blocks]
        case.solids = None
        words = dict(slurry_sections.still_rows(case, blocks[1], blocks))["pool clear of the charge"]
        self.assertIn(uncertain(1e6 * case.length * areas[1], 1e6 * case.length * np.std(areas, ddof=1) / np.sqrt(3),
                                "ml"), words)

    def test_balls_that_move_with_the_flow_have_their_own_words(self):
        self.undrawn()
        flow = write_flow(self.folder / "flow")
        dry = self.assert_whole(report_case(flow)).text
        change_json(flow / "dumps" / "results.json", "fluid", to={"kind": "flow"})
        direct = self.assert_whole(report_case(flow)).text
        self.assertIn("one-way coupling does not hold", dry)
        self.assertNotRegex(direct, "one-way coupling does not hold|dry run|in turn")
        for words in ("the slurry carries the balls", "Power and energies of the balls", "LIGGGHTS of the balls"):
            self.assertIn(words, direct)

    def test_every_flow_explains_the_errors_of_its_numbers(self):
        for flow in (write_flow(self.folder / "flow"), write_fluid_only(self.folder / "fluid")):
            case = self.short_turns(flow)
            self.assertIn("± of the slurry: standard errors of the means of 4 whole turns. With 95 % confidence a mean "
                          "is known within 3.2 of them (two turns: 12.7, three: 4.3", spans(case, Readings(case)))
            case.turn = 0.3
            self.assertIn("no ±: it needs two whole turns of the flow, and this one was averaged over 1",
                          spans(case, Readings(case)))

    def test_numbers_of_many_turns_have_their_interval_where_it_is_wide(self):
        case = MillCase(write_flow(self.folder / "flow"))
        readings = Readings(case)
        times, names = case.balance["Time"], ("hold-up of slurry", "drop of p_rgh in the slurry along the axis "
                                              "(straight line)", "discharge", "feed")
        # Two of them rise from turn to turn, so that the turns hardly show their errors
        case.balance["holdUp"] = 8e-4 + 1e-5 * times
        rising = 1 + readings.series.times[:, None]
        readings.series = replace(readings.series, pressure=rising * readings.series.pressure)
        case.balance["feed"] = 2e-5 + 0 * times
        for turn, turns in ((0.02, 20), (0.04, 10)):
            case.turn = turn
            rows, words = dict(key_numbers(case, readings)), spans(case, readings)
            late = times > case.begin + 1e-9
            held = turns_mean(case.balance["holdUp"][late].reshape(turns, -1).mean(axis=1))
            self.assertIn(f"the means of {turns} whole turns", words)
            many = turns > 11
            self.assertEqual("known within" in words, not many)
            self.assertEqual("Neighbouring turns may be alike (correlated)" in words, many)
            self.assertEqual("the table has it" in words, many)
            found = [re.search(r" \(95 % within ± (\S+) (.*?): the error has (.*)\)$", rows[name]) for name in names]
            self.assertEqual([one is not None for one in found], [many, many, False, False])
            if many:
                self.assertEqual(found[0].groups(), (f"{1e6 * held.reach:.2g}", "ml", "1 degree of freedom"))

    def test_the_power_names_its_begin_and_the_figure_marks_it(self):
        flow = write_flow(self.folder / "flow")
        self.assertIn("power from DEM time 0.4 s on", spans(MillCase(flow), Readings(MillCase(flow))))
        change_json(flow / "dumps" / "results.json", "fluid", to={"kind": "flow"})
        case = self.short_turns(flow)
        case.energy["time_s"] += 0.8  # to the flow's end, and beyond
        self.assertIn(f"power from DEM time {TIME0 + case.begin:.3g} s on", spans(case, Readings(case)))
        figure = figures.energy(case, power_begin(case))
        marks = [[line.get_xdata()[0] for line in axis.lines if line.get_linestyle() == "--"] for axis in figure.axes]
        plt.close(figure)
        self.assertEqual(marks, [[TIME0 + case.begin], [1.0]])

    def test_the_drives_power_names_its_turns_and_what_its_torques_miss(self):
        case = self.short_turns(write_flow(self.folder / "flow"))
        self.assertIn("Both are means over 4 whole turns of the flow. ±", net_note(case))
        self.assertNotIn("does not balance", net_note(case))
        case.turn = 0.3
        self.assertIn("The power of slurry and drive needs two whole turns; this flow has 1. ±", net_note(case))
        case.turn = 0.1
        (self.folder / "coupling.json").write_text(json.dumps({"format": "millfoam-coupling", "coupling": "direct",
                                                               "torque_disagreement": 0.0143,
                                                               "torque_unbalanced": -0.0252}))
        case.coupled = self.folder
        self.assertIn("does not balance, by 1.4 % of the drive's torque on the balls (flow and balls) and 2.5 % of "
                      "the drive's torque (balls and the slurry's own balance); the drive's power has an error of this "
                      "size", net_note(case))

    def short_turns(self, flow):
        """MillCase of a flow whose averages are four turns of ten records."""
        case = MillCase(flow)
        case.turn = 0.1
        return case

    def test_a_tracer_shows_the_time_in_the_mill(self):
        self.undrawn()
        flow = write_flow(self.folder / "flow")
        table = flow / "postProcessing" / "tracer" / "0" / "slurryTracer.dat"
        table.parent.mkdir(parents=True)
        time = np.arange(1, 1001) * 0.02
        into, out = np.where(time < 0.03, 1e-3, 0.0), 1e-3 * 0.02 / 4 * np.exp(-time / 4)
        rows = np.column_stack([time, 2e-5 - 0.02 * np.cumsum(out), into, out, *[0 * time + 1e-3] * 2,
                                0 * time + 2e-5, 0.02 * np.cumsum(out), *[0 * time] * 3])
        np.savetxt(table, rows, "%.12g", "\t", header="Time_s\ttracer_m3\tin_m3/s\tout_m3/s\tslurryIn_m3/s\t"
                   "slurryOut_m3/s\tallIn_m3\tallOut_m3\tmissing_m3\tsmallest\tlargest", comments="# ")
        words = re.sub(r"\s+", " ", self.assert_whole(report_case(flow)).text)
        self.assertRegex(words, r"mean time in the mill (3\.9|4\.0)\d* s")
        self.assertRegex(words, r"stirred tanks in series (0\.9|1\.0)\d*")
        np.savetxt(table, rows[:20], "%.12g", "\t", header=table.read_text().splitlines()[0][2:], comments="# ")
        self.assertIn("of the tracer has not left at the end", self.assert_whole(report_case(flow)).text)

    def test_of_a_dry_run_the_lifters_stand_where_they_have_turned_to(self):
        case = MillCase(write_dry(self.folder / "dry"))
        angle = OMEGA * case.charge_span[1]
        turned = case.outline @ [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        np.testing.assert_allclose(turned, lifter_outline(0.15, 8, 0.01, 0.01, 0.01, 0), atol=1e-12)


class Outline(unittest.TestCase):
    def test_is_the_shell_less_the_lifters(self):
        outline = lifter_outline(0.15, 4, 0.02, 0.01, 0.006, 0)
        np.testing.assert_array_equal(outline[0], outline[-1])
        np.testing.assert_allclose(outline[:4], [[np.sqrt(0.15 ** 2 - 0.005 ** 2), -0.005], [0.13, -0.003],
                                                 [0.13, 0.003],
                                                 [np.sqrt(0.15 ** 2 - 0.005 ** 2), 0.005]])
        x, y = outline.T
        area = 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
        self.assertAlmostEqual(area, np.pi * 0.15 ** 2 - 4 * 0.02 * 0.008, delta=2e-5)

    def test_of_a_smooth_drum_is_a_circle(self):
        np.testing.assert_array_equal(lifter_outline(0.15, 0, 0.02, 0.01, 0.01, 1), circle(0.15))


class SlurryWay(Case):
    def test_circulates_with_95_percent_confidence(self):
        angle = Mean(0.0)
        for size, expected in ((3, "undecided"), (5, "yes")):  # 4.3 errors of three turns, by Student's distribution
            self.assertEqual(Way(angle, angle, Mean(size, 1, 2), Mean(-size, 1, 2)).circulates, expected)
        for toe, shoulder, expected in (((3, 1), (-3, 1), "yes"), ((3, 2), (-3, 1), "undecided"),
                                        ((3, 1), (-1, 1), "undecided"),
                                        ((3, 1), (3, 1), "no"), ((-3, 1), (-3, 9), "no"),
                                        ((3, np.nan), (-3, 1), "undecided")):
            self.assertEqual(Way(angle, angle, Mean(*toe), Mean(*shoulder)).circulates, expected)

    def test_angles_are_averaged_across_180_degrees(self):
        found = angle_mean([175, -175, 178, -178])
        self.assertAlmostEqual(abs(found.value), 180)
        self.assertAlmostEqual(found.error, np.std([-5, 5, -2, 2], ddof=1) / 2)

    def test_of_blocks_of_written_times_is_the_mean_of_all(self):
        case = MillCase(write_flow(self.folder / "flow", tables=False, voxels=False))
        whole, parts = mean_flow(case.flow, case.begin), mean_of_times(list(slurry_blocks(case)))
        np.testing.assert_allclose(parts.share, whole.share)
        np.testing.assert_allclose(parts.velocity, whole.velocity, atol=1e-12)
        self.assertEqual(parts.source, whole.source)
        np.testing.assert_allclose(parts.filled(), whole.filled())
        # Balls displace slurry
        flow = case.flow
        held = np.mean([flow.slurry(path)[flow.chamber].sum() for _, path in flow.frames_with_slurry(case.begin)])
        self.assertAlmostEqual(whole.filled().sum() * whole.pixel() * case.length / held, 1, delta=0.03)
        self.assertGreater(np.nansum(whole.share) * whole.pixel() * case.length / held, 1.1)

    def test_of_the_report_is_the_studys(self):
        self.undrawn()
        flow = write_flow(self.folder / "flow")
        case = MillCase(flow)
        self.assertEqual(Readings(case).way, slurry_way(list(slurry_blocks(case)), case.radius, 0.01))
        words = re.sub(r"\s+", " ", self.assert_whole(report_case(flow)).text)
        self.assertIn("on the circle 1.5 lifter heights (15 mm) from the shell", words)
        self.assertIn("to the discharge at the toe and back at the shoulder yes", words)

    def test_errors_of_blocks_shorter_than_a_turn_are_lower_bounds(self):
        case = MillCase(write_flow(self.folder / "flow"))
        self.assertIn("lower bounds of errors: the charge's of 0.1 s, the slurry's of 0.1 s",
                      Readings(case).short_blocks())
        case.turn = 0.1
        readings = Readings(case)
        self.assertEqual(readings.short_blocks(), "")
        readings.errors["ends"] = replace(readings.errors["ends"], blocks=1, failed=3)
        self.assertEqual(readings.short_blocks(), " 3 of 4 blocks have no reading of toe and shoulder.")

    def test_humps_at_the_profiles_end_are_named(self):
        z = np.linspace(0.01, 0.29, 15)
        for places, ended in (((0.01, 0.29), "2 of 2 at the profile's end"), ((0.1, 0.29), "1 of 2"),
                              ((0.1, 0.2), None)):
            words = humps_words(Humps(places, (1, 1), (0.05, 0.05), 0, 1e-3), z)
            self.assertIn(ended or "100 mm apart, RMSD 1 mm", words)
            self.assertEqual("end" in words, ended is not None)


class Curves(Case):
    def test_power_begins_after_the_start_up_and_sets_its_axis_late(self):
        case = MillCase(write_flow(self.folder / "flow"))
        case.balance["power"][:2] = 1e4
        times, power = figures.quarter_turns(case, "power")
        self.assertGreater(times[0], case.turn / 4)
        self.assertLess(power.max(), 0.6)
        times, power = figures.running_mean(np.arange(1, 11) / 10, np.arange(1, 11.0), 0.3)
        np.testing.assert_allclose((times, power), (np.arange(4, 11) / 10, np.arange(3, 10)))
        self.assertEqual(len(figures.running_mean(times, power, 3.0)[0]), 0)
        self.assertEqual(figures.late_limits(times[:0], power[:0]), (0, 1))
        for early, limits in (((99, 50, 9), (0, 3.3)), ((2.5, 1, 1), (0, 2.75)), ((-0.5, 0, 0), (-0.55, 2.2)),
                              ((-99, 0, 0), (-1.1, 2.2))):
            found = figures.late_limits(np.arange(10.0), np.array([*early, 1, 1, 1, 2, 1, 1, 1.0]))
            np.testing.assert_allclose(found, limits)

    def test_each_of_many_cases_has_a_line_of_its_own(self):
        x = np.linspace(0, 1, 5)
        for figure in (figures.lines_against([(str(k), x, k * x) for k in range(20)], "x", "y"),
                       figures.surfaces([(str(k), np.stack([x, k * x], axis=1)) for k in range(20)], 1.0, 1.0)):
            lines = {(line.get_color(), line.get_linestyle()) for line in figure.axes[0].lines
                     if line.get_label()[0] != "_"}
            self.assertEqual(len(lines), 20)

    def test_the_strip_of_frames_names_the_charge_where_it_is(self):
        for write, charge in ((write_flow, True), (write_fluid_only, False)):
            case = write(self.folder / write.__name__)
            for path in () if charge else case.glob("*/solidity"):
                path.unlink()
            with mock.patch.object(plt, "close"):
                plot_strip(MillCase(case).flow, self.folder / "strip.png", 2)
            labels = " ".join(axis.get_ylabel() for axis in plt.gcf().axes)
            plt.close("all")
            self.assertIn("slurry share over the axis", labels)
            self.assertEqual("orange: charge" in labels, charge)

    def test_reynolds_numbers_have_a_linear_axis_from_zero(self):
        axis = figures.reynolds(MillCase(write_flow(self.folder / "flow"))).axes[0]
        self.assertEqual((axis.get_yscale(), axis.get_ylim()[0]), ("linear", 0))
        plt.close(axis.figure)


class Refused(Case):
    def assert_refused(self, message):
        with self.assertRaisesRegex(NoMill, message):
            report_case(self.folder)

    def test_folders_that_are_no_mills_case(self):
        self.assert_refused("no mill.json; expected the folder of a mill's case that was run: run Allrun, or millMesh "
                            "mill.yaml")
        file = self.folder / "mill.json"
        write_mill(self.folder)
        whole = file.read_bytes()
        for content, message in ((whole[:300], "mill.json: line .* not JSON: .*cut short"),
                                 (b"", "mill.json: line 1.* not JSON"),
                                 ("{\"title\": \"Mühle\"}".encode("latin-1"), "mill.json: not UTF-8 text .byte 12.; "
                                                                              "expected UTF-8"),
                                 (whole.decode().encode("utf-16"), "mill.json: not UTF-8 text"),
                                 (b"[" * 10**5, "mill.json: not JSON: too many brackets"),
                                 (b"[]", "mill.json: format None; expected"),
                                 (b'{"format": "millfoam-mesh"}', "format 'millfoam-mesh'; expected 'millfoam-mill'"),
                                 (b'{"format": "millfoam-mill"}', "mill.json: no derived"),
                                 (whole.replace(b'"geometry"', b'"form"'), "mill.json: no derived.geometry")):
            file.write_bytes(content)
            self.assert_refused(f"{message}.*; run Allrun, or millMesh mill.yaml --case DIR, to write it again")
        ended = self.command(self.folder)
        self.assertRegex(ended.stderr, "^report: error: .*mill.json: no derived.geometry; run Allrun.*\n$")
        self.assertEqual(ended.returncode, 1)

    def test_a_case_that_was_not_run_or_whose_averages_are_not_whole(self):
        write_mill(self.folder)
        self.assert_refused("no flow .*, no complete solids.h5, no dumps/results.json")
        write_solids(self.folder / "solids.h5", complete=0)
        self.assert_refused("solids.h5: not used, because it is not complete; average the dumps again")

    def test_an_older_report_stays(self):
        dry = write_dry(self.folder / "dry")
        (dry / "report.html").write_text("older")
        (self.folder / "map.csv").write_text("x_m,y_m,solidity,vx,vy\n0,0,1.2,0,0\n")
        (self.folder / "track.csv").write_text("t x y z\n0 0 0 0\n1 0 much 0\n")
        for option, words in (("--measured", r"map.csv, line 2, column solidity: '1.2'; expected a number from 0 to 1"),
                              ("--tracer", r"track.csv:3: 'much', expected a finite number")):
            ended = self.command(dry, option, self.folder / ("map.csv" if option == "--measured" else "track.csv"))
            self.assertEqual((ended.returncode, ended.stdout), (1, ""))
            self.assertRegex(ended.stderr, rf"^report: error: .*{words}\n$")
            self.assertEqual(sorted(path.name for path in dry.glob("report*")), ["report.html"])
            self.assertEqual((dry / "report.html").read_text(), "older")


class Measured(Case):
    def setUp(self):
        super().setUp()
        self.undrawn()

    def test_a_measured_map_that_is_the_simulated_one_does_not_differ(self):
        dry, csv = write_dry(self.folder / "dry"), self.folder / "measured.csv"
        charge = MillCase(dry).charge
        x, y = np.meshgrid(*charge.centres())
        known = charge.inside > 0
        rows = [",".join("" if np.isnan(value) else f"{value:.9g}" for value in row) for row in np.column_stack(
            [values[known] for values in (x, y, charge.solidity, *np.moveaxis(charge.velocity, -1, 0)[:2])])]
        csv.write_text("\n".join(["x_m,y_m,solidity,vx,vy", *rows]))
        found = self.assert_whole(report_case(dry, measured=csv))
        self.assertIn("measured", found.ids)
        self.assertRegex(found.text, r"solidity \S+·10⁻\S+ % +velocity, x|solidity 0 % +velocity, x")

    def test_a_tracer_that_keeps_to_one_place_differs(self):
        dry, track = write_dry(self.folder / "dry"), self.folder / "track.txt"
        time = np.linspace(0, 5, 500)
        x, y = -0.03 + 0.03 * np.cos(OMEGA * time), -0.07 + 0.03 * np.sin(OMEGA * time)
        circle = np.column_stack([time, x, y, 0.03 + 0 * time])
        np.savetxt(track, circle)
        found = self.assert_whole(report_case(dry, tracers=[track, track]))
        self.assertIn("tracers", found.ids)
        self.assertIn("2, 10 s in total", found.text)
        self.assertGreater(float(re.search(r"solidity (\d+(?:\.\d+)?) %", found.text).group(1)), 20)


class Several(Case):
    def test_the_first_case_is_compared_with_the_others(self):
        self.undrawn()
        flows = [write_flow(self.folder / name / "case", f"Mill {name}", tables=name == "a") for name in "ab"]
        found = self.assert_whole(compare_cases([*flows, write_dry(self.folder / "dry")]))
        self.assertRegex(found.text, "b/case, .*dry compared with a/case")
        self.assertLessEqual({"numbers", "checks", "charge", "slurry"}, set(found.ids))
        self.assertIn("p_rgh", found.text)
        self.assertNotIn("Head", found.text)

    def test_a_case_that_cannot_be_compared_is_named_with_the_reason(self):
        self.undrawn()
        flow, dry = write_flow(self.folder / "flow"), write_dry(self.folder / "dry")
        other = write_dry(self.folder / "other")
        write_mill(other, diameter=0.32)
        words = re.sub(r"\s+", " ", self.assert_whole(compare_cases([flow, dry, other])).text)
        self.assertIn("other – – – not compared: another diameter, 320 mm instead of 300 mm", words)
        one, finer = (MillCase(path) for path in (flow, dry))
        finer.charge.x = np.linspace(-0.15, 0.15, 50)
        self.assertEqual(comparison.not_compared(finer, one, finer.charge, one.charge), "different voxels")
        self.assertIsNone(comparison.not_compared(one, one, one.charge, one.charge))
        mirrored = SimpleNamespace(radius=one.radius, omega=-one.omega)
        self.assertEqual(comparison.not_compared(mirrored, one, one.charge, one.charge), "turns the other way")

    def test_costs_of_a_stage_that_is_being_made_again_are_left_out(self):
        flow = write_flow(self.folder / "flow")
        (flow / "log.costs").write_text("charge,30\n~flow,12\nflow,3\n")
        self.assertEqual(dict(stage_costs(MillCase(flow))), {"charge": 30.0, "flow": 3.0})

    def test_costs_of_a_charge_from_another_case_are_those_of_its_charge(self):
        mine, other = write_flow(self.folder / "new"), write_flow(self.folder / "my_mill")
        (other / "log.costs").write_text("walls,1\ncharge,30\n~average,7\naverage,3\nmesh,5\nflow,90\nreport,9\n")
        (mine / "log.costs").write_text("mesh,6\nflow,40\nflow,2\nreport,8\n")
        (mine / "solids.h5").unlink()
        (mine / "solids.h5").symlink_to("../my_mill/solids.h5")
        case = MillCase(mine)
        self.assertEqual(list(stage_costs(case).items()), [
            ("my_mill: walls", 1.0), ("my_mill: charge", 30.0), ("my_mill: average", 3.0), ("mesh", 6.0),
            ("flow", 42.0), ("report", 8.0)])
        self.assertIn("Before a colon: another folder", " ".join(run_section(case, None)))
        self.assertNotIn("Before a colon", " ".join(run_section(MillCase(other), None)))

    def test_costs_of_a_coupled_mill_are_those_of_all_its_passes(self):
        for coupling, name in (("direct", "direct"), ("iterated", "pass_2")):
            whole = write_flow(self.folder / coupling)
            last = write_flow(whole / name)
            for folder in (whole, last):
                change_json(folder / "mill.json", "derived", "flow", "coupling", to=coupling)
            (whole / "log.costs").write_text("charge,30\ncoupling,2\n")
            (last / "log.costs").write_text("flow,40\n")
            self.assertEqual(stage_costs(MillCase(last)), {"flow": 40.0})  # not compared yet
            (whole / "coupling.json").write_text(json.dumps({"format": "millfoam-coupling", "coupling": coupling,
                                                             "folders": [".", name], "mill": PRINTS}))
            self.assertEqual(list(stage_costs(MillCase(last)).items()), [
                (f"{coupling}: charge", 30.0), (f"{coupling}: coupling", 2.0), ("flow", 40.0)])

    def test_measurements_are_compared_with_one_case_only(self):
        ended = self.command(self.folder, self.folder, "--measured", "map.csv")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("--measured and --tracer are for one case; 2 were given", ended.stderr)


if __name__ == "__main__":
    unittest.main()
