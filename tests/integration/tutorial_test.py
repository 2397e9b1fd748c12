#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tutorial's mill and its commands as on the page, with shorter runs."""
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from PIL import Image

from millfoam.files.data_files import read_json
from millfoam.run import run

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "cases" / "tutorial" / "README.md"
# Soft balls with long time-steps
SHORT = ("dem={youngs_modulus: 5e6, settle_time: 0.1, duration: 0.2, record_interval: 0.01}",
         "averages={window: 0.1, start: 0.1}",
         "flow.duration=0.02")


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ["MILLFOAM_NP"] = "1"
        cls.folder = Path(tempfile.mkdtemp(prefix="tutorial-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.page = PAGE.read_text(encoding="utf-8")
        (cls.folder / "my.yaml").write_text(re.search(r"^```yaml\n(.*?)^```", cls.page, re.M | re.S).group(1))
        cls.commands = "".join(re.findall(r"^```sh\n(.*?)^```", cls.page, re.M | re.S)).splitlines()
        for command in cls.commands:
            words = command.split()
            if words[0].startswith("scripts/"):
                words[0] = ROOT / words[0]
            if words[0] == "my_mill/Allrun" or str(words[0]).endswith("/Allrun"):
                words += [word for change in SHORT for word in ("--set", change)]
            run(cls.folder, *words)

    def test_every_run_is_what_the_page_asks_for(self):
        self.assertEqual(len(self.commands), 8)
        mills = {name: read_json(self.folder / name / "mill.json", "mill") for name in ("my_mill", "fine", "hill")}
        self.assertEqual(mills["my_mill"]["derived"]["flow"]["law"], "Beetstra")
        self.assertEqual(mills["hill"]["derived"]["flow"]["law"], "Hill")
        self.assertEqual(mills["fine"]["derived"]["resolution"]["cell_size_m"], 0.0055)
        self.assertLess(mills["fine"]["derived"]["resolution"]["cell_size_m"], 0.1 / 13)
        self.assertEqual(mills["hill"]["fingerprint"]["averages"], mills["my_mill"]["fingerprint"]["averages"])

    def test_the_page_names_lines_and_numbers_that_the_report_has(self):
        text = re.sub(r"<[^>]+>", "", (self.folder / "my_mill" / "report.html").read_text(encoding="utf-8"))
        for words in ("The charge is steady where it is averaged", "The flow is steady", "Slurry is conserved",
                      "The slurry would not move the balls", "power for the slurry", "Can it be believed?",
                      "Ledger and mesh"):
            self.assertIn(words, text)
            self.assertIn(words, self.page)

    def test_what_the_page_shows_is_there(self):
        for picture in (self.folder / "my_mill" / "pictures" / "maps.png", PAGE.with_name("maps.png")):
            with Image.open(picture) as found:
                self.assertGreater(len(set(found.convert("RGB").getdata())), 100)
        comparison = (self.folder / "comparison.html").read_text(encoding="utf-8")
        for name in ("my_mill", "fine", "hill", "Hill"):
            self.assertIn(name, comparison)


if __name__ == "__main__":
    unittest.main(verbosity=2)
