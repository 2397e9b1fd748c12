#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A report and a comparison in a browser, as wide as a desk's screen and as a telephone: nothing is cut off or broken,
and the report's player plays.

report_browser.html loads the page in a frame of each width and writes what it finds into itself; Chromium prints
that."""
import json
import re
import shutil
import subprocess
import tempfile
import unittest
from html import unescape
from pathlib import Path

from report_cases import write_dry, write_flow, write_fluid_only

ROOT = Path(__file__).resolve().parents[2]
WIDTHS = (1280, 390)
NAMES = ("chromium", "chromium-browser", "google-chrome")
# Without them a browser needs a display, a sandbox, a profile and the network
QUIET = ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--allow-file-access-from-files",
         "--hide-scrollbars", "--enable-logging=stderr", "--v=0")
PLAYER = """<div class="player"><img alt="a" src="{0}"><button>Play</button><input type="range" max="1" value="0">
<script type="application/json">["{0}", "{1}"]</script></div>"""
DOTS = [f"data:image/gif;base64,R0lGODlhAQABAIAAA{colour}///ywAAAAAAQABAAACAkQBADs=" for colour in ("AAAAP", "P8AAP")]
BAD = f"""<!DOCTYPE html><html><head><title>bad</title></head><body><p style="width: 2000px">wide</p>
<img alt="none" src="data:image/png;base64,AAAA">
{PLAYER.format("data:,0", "data:,1")}<script>nothing.at.all();</script></body></html>"""


def browser():
    """Chromium's path; RuntimeError where there is none."""
    found = next((path for path in map(shutil.which, NAMES) if path), None)
    if not found:
        raise RuntimeError(f"none of {', '.join(NAMES)} was found; scripts/setup --tools installs Chromium")
    return found


def measure(page, folder):
    """What report_browser.html finds in a page at WIDTHS: {width: values}, and errors of its scripts [texts]."""
    wrapper = shutil.copy(Path(__file__).with_name("report_browser.html"), folder)
    address = f"{Path(wrapper).as_uri()}?page={page.name}&widths={','.join(map(str, WIDTHS))}"
    ended = subprocess.run([browser(), *QUIET, f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=60000",
                            "--dump-dom", address], capture_output=True, text=True, timeout=250)
    found = re.search(r'<pre id="found">(.+?)</pre>', ended.stdout, re.S)
    if not found:
        raise RuntimeError(f"the browser found nothing: {ended.stdout[-500:]} {ended.stderr[-2000:]}")
    errors = re.findall(r"CONSOLE\S*\] \"(.*?)\", source", ended.stderr, re.S)
    return {entry["width"]: entry for entry in json.loads(unescape(found.group(1)))}, errors


class Whole:
    """What holds of every page; images: more than so many are in it."""
    images = 8

    @classmethod
    def setUpClass(cls):
        browser()
        cls.folder = Path(tempfile.mkdtemp(prefix="report-browser-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        page = cls.folder / "report.html"
        subprocess.run([ROOT / "scripts" / "report", *cls.cases(cls.folder), "-o", page], check=True)
        cls.prepare(page)
        cls.found, cls.errors = measure(page, cls.folder)

    @classmethod
    def prepare(cls, page):
        pass

    def each(self, *keys):
        """The values of these keys [widths]."""
        return [[self.found[width][key] for key in keys] for width in WIDTHS]

    def test_scripts_raise_no_error(self):
        self.assertEqual(self.errors, [])
        for errors, in self.each("errors"):
            self.assertEqual(errors, [])

    def test_nothing_is_wider_than_the_screen(self):
        for width, (inner, wide, beyond) in zip(WIDTHS, self.each("inner", "scroll", "beyond")):
            self.assertEqual(inner, width)
            self.assertLessEqual(wide, inner, beyond)
            self.assertEqual(beyond, [])

    def test_every_image_is_there(self):
        for images, broken in self.each("images", "broken"):
            self.assertGreater(images, self.images)
            self.assertEqual(broken, 0)


class Report(Whole, unittest.TestCase):
    @staticmethod
    def cases(folder):
        return [write_flow(folder / "mill")]

    def test_cards_stand_side_by_side_on_a_screen_and_below_each_other_on_a_telephone(self):
        self.assertEqual([columns for columns, in self.each("columns")], [2, 1])

    def test_the_player_plays_stops_at_its_slider_and_plays_again(self):
        for frames, player in self.each("frames", "player"):
            self.assertGreater(frames, 2)
            self.assertEqual(player, {"plays": True, "slides": True, "stays": True, "playsAgain": True, "pauses": True})


class Comparison(Whole, unittest.TestCase):
    images = 5

    @staticmethod
    def cases(folder):
        return [write_flow(folder / "with_balls_and_a_long_name"), write_fluid_only(folder / "without_balls"),
                write_dry(folder / "dry")]

    @classmethod
    def prepare(cls, page):
        # A comparison has no player, which report_browser.html looks for
        page.write_text(page.read_text().replace("</main>", PLAYER.format(*DOTS) + "</main>"))


class Faults(unittest.TestCase):
    def test_of_a_bad_page_are_found(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="report-faults-")))
        (folder / "bad.html").write_text(BAD)
        found, errors = measure(folder / "bad.html", folder)
        self.assertIn("nothing is not defined", " ".join(errors))
        for width in WIDTHS:
            entry = found[width]
            self.assertGreater(entry["scroll"], entry["inner"])
            self.assertTrue(entry["beyond"])
            self.assertGreaterEqual(entry["broken"], 1)
            self.assertFalse(entry["player"]["plays"] or entry["player"]["slides"] or entry["player"]["playsAgain"])


if __name__ == "__main__":
    unittest.main()
