#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages for people: their links lead somewhere, and the mills that they show are accepted."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

from millfoam.run import run

ROOT = Path(__file__).resolve().parents[2]
PAGES = [path for path in (*ROOT.glob("*.md"), *(p for room in ("averaging", "cases", "dem_driver", "meshing",
         "openfoam_module", "scripts") for p in (ROOT / room).rglob("README.md")))]


def prose(page):
    """Lines of a page outside of its blocks of code: between fences, or indented by four where no list is open."""
    found, fence, in_list, after_blank, in_code = [], "", False, True, False
    for line in page.read_text(encoding="utf-8").splitlines():
        mark = re.match(r" *(`{3,}|~{3,})", line)
        if fence:
            if mark and mark[1].startswith(fence):
                fence = ""
            continue
        if mark:
            fence = mark[1]
            continue
        if line.strip():
            if re.match(r" {0,3}([-*+]|\d+[.)]) ", line):
                in_list = True
            elif after_blank and not line.startswith(" "):
                in_list = False
            # In the middle of a paragraph it is text
            in_code = line.startswith("    ") and not in_list and (after_blank or in_code)
        after_blank = not line.strip()
        if not in_code:
            found.append(line)
    return "\n".join(found)


def anchors(page):
    """Names by which the headings of a page are linked, as GitHub makes them: repeated ones end with -1, -2 …"""
    found = Counter()
    for heading in re.findall(r"^#{1,6} +(.*?) *$", prose(page), re.M):
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        count = found[name]
        found[name] += 1
        if count:
            found[f"{name}-{count}"] += 1
    return set(found)


class Pages(unittest.TestCase):
    """What of a page is text and what are its headings."""

    def setUp(self):
        self.page = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="readme-"))) / "README.md"

    def links(self, text):
        self.page.write_text(text)
        return re.findall(r"\]\((\w+)\)", prose(self.page))

    def test_nested_items_of_lists_are_text(self):
        self.assertEqual(self.links("- [a](a)\n    - [b](b),\n      [c](c)\n\n    [d](d)\n10. [e](e)\n    [f](f)\n"),
                         list("abcdef"))
        self.assertEqual(self.links("a line\n    [b](b)\n"), ["b"])

    def test_code_is_no_text(self):
        self.assertEqual(self.links("A:\n\n    f[a](a)\n\n    f[b](b)\n\n[c](c)\n"), ["c"])
        self.assertEqual(self.links("- item\n\nA:\n\n    f[a](a)\n"), [])
        for fence in ("```", "~~~", "````"):
            self.assertEqual(self.links(f"{fence}sh\nf[a](a)\n\nf[b](b)\n{fence}\n[c](c)\n"), ["c"])
        self.assertEqual(self.links("- item:\n\n  ```sh\n  f[a](a)\n  ```\n  [b](b)\n"), ["b"])

    def test_headings_are_numbered_when_repeated_and_are_not_comments_in_code(self):
        self.page.write_text("# A page: `x.json`\n\n```sh\n# build it\n```\n\n## New\n## Fixed\n## New\n### New\n")
        self.assertEqual(anchors(self.page), {"a-page-xjson", "new", "fixed", "new-1", "new-2"})


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

    def test_the_begin_of_averages_has_the_same_words_as_in_the_help_of_the_commands(self):
        words = "or at half of the flow's time where at most half of the planned averaged time was computed"
        page = (ROOT / "scripts" / "README.md").read_text(encoding="utf-8")
        self.assertIn(f"`flow.averages.start`, {words}", " ".join(page.split()))
        for package in ("millfoam.plots", "millfoam.report"):
            done = subprocess.run([sys.executable, "-m", package, "--help"], capture_output=True, text=True, check=True)
            self.assertIn(f"at the mill's flow.averages.start, {words}", " ".join(done.stdout.split()))

    def test_the_mills_of_the_pages_are_accepted(self):
        for page in (ROOT / "README.md", ROOT / "meshing" / "README.md"):
            mill = re.search(r"^```yaml\n(geometry:.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S).group(1)
            with self.subTest(page=str(page)), tempfile.TemporaryDirectory(prefix="readme-") as folder:
                (Path(folder) / "my.yaml").write_text(mill)
                resolved = json.loads(run(folder, "millMesh", "my.yaml", "--resolved", "-"))
                self.assertEqual(resolved["derived"]["geometry"]["radius_m"], 0.3)


if __name__ == "__main__":
    unittest.main()
