#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages for people: their links lead somewhere, and the mills that they show are accepted."""
import json
import re
import tempfile
import unittest
from pathlib import Path

from millfoam.run import run

ROOT = Path(__file__).resolve().parents[2]
PAGES = [path for path in (*ROOT.glob("*.md"), *(p for room in ("averaging", "cases", "dem_driver", "meshing",
         "openfoam_module", "scripts") for p in (ROOT / room).rglob("README.md")))]


def prose(page):
    """Text of a page without its blocks of code."""
    return re.sub(r"^```.*?^```|^    .*?$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)


def anchors(page):
    """Names by which the headings of a page are linked, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Readme(unittest.TestCase):
    def test_every_relative_link_leads_to_a_file_and_a_heading(self):
        self.assertGreater(len(PAGES), 20)
        for page in PAGES:
            links = re.findall(r"\]\(([^)\s]+)\)|^\[[^\]]+\]: (\S+)", prose(page), re.M)
            for link in filter(lambda link: not link.startswith("http"), ("".join(pair) for pair in links)):
                with self.subTest(page=str(page.relative_to(ROOT)), link=link):
                    name, _, heading = link.partition("#")
                    target = (page.parent / name).resolve() if name else page
                    self.assertTrue(target.exists(), "no such file")
                    if heading:
                        self.assertIn(heading, anchors(target))

    def test_the_mills_of_the_pages_are_accepted(self):
        for page in (ROOT / "README.md", ROOT / "meshing" / "README.md"):
            mill = re.search(r"^```yaml\n(geometry:.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S).group(1)
            with self.subTest(page=str(page)), tempfile.TemporaryDirectory(prefix="readme-") as folder:
                (Path(folder) / "my.yaml").write_text(mill)
                resolved = json.loads(run(folder, "millMesh", "my.yaml", "--resolved", "-"))
                self.assertEqual(resolved["derived"]["geometry"]["radius_m"], 0.3)


if __name__ == "__main__":
    unittest.main()
