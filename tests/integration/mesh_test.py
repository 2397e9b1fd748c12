# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenFOAM's own checkMesh finds nothing wrong with the meshes of millMesh, those that it makes out of faces too."""
import random
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from millfoam.run import RunError, run

ROOT = Path(__file__).resolve().parents[2]
MILLS = ROOT / "cases" / "mills"
SLICE, LARGE = (MILLS / name / "mill.yaml" for name in ("mill_12cm", "mill_30cm"))
SYSTEM = ROOT / "scripts" / "mill_case" / "system"
CONTROL = """FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
application checkMesh; startTime 0; endTime 1; deltaT 1; writeInterval 1;
"""
WHOLE = "geometry.slice=~"
NO_PULP_LIFTERS = "geometry.pulp_lifters=~"
CLOSED = ("geometry.inlet=~", "geometry.grates=~", NO_PULP_LIFTERS)
NINE_LAYERS = ("resolution.layers=9", "geometry.pulp_lifters.layers=2")


def counts(gap, lifter, height, ring, layers):
    """The numbers of cells instead of the mill's resolution."""
    return f"resolution={{counts: {{gap: {gap}, lifter: {lifter}, height: {height}, ring: {ring}}}, layers: {layers}}}"


def settings(changes):
    """Options `--set` of a list of changes."""
    return [word for change in changes for word in ("--set", change)]


class Mesh(unittest.TestCase):
    def check(self, *changes, mill=SLICE, turned_to=0):
        """Meshes a mill with the changes `path=value` and returns what checkMesh says."""
        case = Path(tempfile.mkdtemp(prefix="mesh-"))
        self.addCleanup(shutil.rmtree, case)
        shutil.copytree(SYSTEM, case / "system")
        run(case, "millMesh", mill, *settings(changes), "--case", ".", "--at-time", turned_to)
        report = run(case, "checkMesh", "-constant", "-allTopology", "-allGeometry")
        self.assertIn("\nMesh OK.\n", report, report[-2000:])
        self.assertLessEqual(float(re.search(r"non-orthogonality Max: (\S+)", report).group(1)), 45)
        self.assertLessEqual(float(re.search(r"Max skewness = (\S+)", report).group(1)), 1)
        self.assertGreaterEqual(float(re.search(r"Face volume ratio : minimum: (\S+)", report).group(1)), 1 / 3)
        return report

    def test_walls_of_another_origin_are_not_replaced_silently(self):
        case = Path(tempfile.mkdtemp(prefix="walls-"))
        self.addCleanup(shutil.rmtree, case)
        self.assertNotIn("replaced", run(case, "millMesh", SLICE, "--case", "."))
        shell, lifters = case / "walls" / "shell.stl", case / "walls" / "lifters.stl"
        drawn = shell.read_text().replace("solid shell", "solid cad")
        shell.write_text(drawn)
        (case / "walls" / "feedEnd.stl").write_text(drawn)
        output = run(case, "millMesh", SLICE, "--case", ".")
        self.assertIn(f"replaced: {shell.relative_to(case)}, which held another surface", output.replace("./", ""))
        self.assertIn("removed: walls/feedEnd.stl, which is not a wall of this mill", output.replace("./", ""))
        self.assertNotIn(lifters.name, output)

    def test_walls_without_walls_json_are_only_replaced_with_walls_alone(self):
        case = Path(tempfile.mkdtemp(prefix="walls-"))
        self.addCleanup(shutil.rmtree, case)
        (case / "walls").mkdir()
        shell = case / "walls" / "shell.stl"
        shell.write_text("solid cad\nendsolid cad\n")
        with self.assertRaisesRegex(RunError, "walls/shell.stl: millMesh has not written this file, .*--walls"):
            run(case, "millMesh", SLICE, "--case", ".")
        self.assertEqual(shell.read_text(), "solid cad\nendsolid cad\n")
        self.assertFalse((case / "constant").exists())
        self.assertIn("replaced: ", run(case, "millMesh", SLICE, "--case", ".", "--walls"))

    def refused(self, command, words):
        """A command in an empty folder fails with these words and leaves nothing but its log."""
        case = Path(tempfile.mkdtemp(prefix="refused-"))
        self.addCleanup(shutil.rmtree, case)
        with self.assertRaisesRegex(RunError, words):
            run(case, *command)
        self.assertEqual([path.name for path in case.iterdir()], [f"log.{command[0]}"])

    def test_a_time_that_is_none_is_refused(self):
        for time in ("nan", "1e300", "-1"):
            self.refused(("millMesh", SLICE, "--case", ".", f"--at-time={time}"),
                         f"--at-time: '{time}': expected a DEM time in s, from 0 to 1e5")

    def test_a_folder_that_cannot_be_made_is_named_with_its_option(self):
        self.refused(("millMesh", SLICE, "--case", "/proc/none"),
                     "--case /proc/none: /proc/none/walls/.*: its folder cannot be made: No such file")

    def test_a_full_disk_fails(self):
        for options in (("--quality",), ("--resolved", "-")):
            self.refused(("sh", "-c", '"$0" "$@" > /dev/full', "millMesh", SLICE, *options),
                         "millMesh: error: .*cannot be written")

    def test_periodic_slice(self):
        self.check()

    def test_periodic_slice_turned(self):
        self.check(turned_to=1.0)

    def test_plain_ends(self):
        self.check(WHOLE, "resolution.layers=12")

    def test_smooth_drum(self):
        self.check("geometry.lifters={count: 0}")

    def test_fine_and_coarse_cells(self):
        for size in (0.002, 0.006):
            with self.subTest(size=size):
                self.check(f"resolution.cell_size={size}")

    def test_published_resolutions_of_the_12_cm_mill(self):
        for resolution in ((11, 3, 5, 9), (24, 6, 8, 19)):
            with self.subTest(resolution=resolution):
                self.check(counts(*resolution, layers=5))
                self.check(counts(*resolution, layers=12), WHOLE)

    def test_published_resolutions_of_the_30_cm_mill_with_and_without_pulp_lifters(self):
        for number, changes in ((9, NINE_LAYERS), (33, ())):
            with self.subTest(layers=number):
                report = self.check(*changes, mill=LARGE)
                self.assertRegex(report, r"inlet +\d+ .* ok")
                self.assertRegex(report, r"outlet +\d+ .* ok")
                self.assertIn("Number of regions: 1 (OK)", report)
                report = self.check(f"resolution.layers={number}", NO_PULP_LIFTERS, mill=LARGE)
                self.assertRegex(report, r"grates +\d+ .* ok")

    def test_half_of_the_columns_inside_the_smallest_opening(self):
        self.check("resolution.counts.ring=17", "resolution.counts.core=10", mill=LARGE)

    def test_layers_that_are_thinner_at_the_grates(self):
        report = self.check("resolution.last_layer=0.010", *NINE_LAYERS, mill=LARGE)
        self.assertIn("Number of regions: 1 (OK)", report)

    def test_plain_ends_of_the_30_cm_mill(self):
        for number in (9, 33):
            with self.subTest(layers=number):
                self.check(*CLOSED, "flow.feed=0", counts(5, 1, 1, 5, layers=number), mill=LARGE)

    def test_periodic_slice_of_the_30_cm_mill(self):
        self.check("geometry.slice=0.0165", mill=LARGE)

    def test_trapezoidal_lifters(self):
        for mill, width, top, changes in ((SLICE, 0.006, 0.003, (WHOLE, "resolution.layers=9")),
                                          (LARGE, 0.010, 0.006, NINE_LAYERS)):
            with self.subTest(mill=mill.parent.name):
                self.check(f"geometry.lifters.width={width}", f"geometry.lifters.top_width={top}", *changes, mill=mill)

    def assemble(self, lines):
        """Makes a mesh out of the lines of an OBJ file and returns what checkMesh says."""
        case = Path(tempfile.mkdtemp(prefix="mesh-"))
        self.addCleanup(shutil.rmtree, case)
        shutil.copytree(SYSTEM, case / "system")
        (case / "system" / "controlDict").write_text(CONTROL)  # the mills' controlDict needs numbers of a mill
        (case / "faces.obj").write_text("\n".join(lines) + "\n")
        run(case, "millMesh", "assemble", "faces.obj", "--case", ".")
        return run(case, "checkMesh", "-constant", "-allTopology", "-allGeometry")

    def test_faces_taken_apart_and_assembled(self):
        self.assertIn("\nMesh OK.\n", self.assemble(self.shuffled_faces(SLICE, WHOLE, "resolution.layers=9")))

    def test_faces_of_a_mill_with_pulp_lifters_taken_apart_and_assembled(self):
        report = self.assemble(self.shuffled_faces(LARGE, *NINE_LAYERS))
        self.assertIn("\nMesh OK.\n", report)
        self.assertRegex(report, r"outlet +\d+ .* ok")
        self.assertIn("Number of regions: 1 (OK)", report)

    def shuffled_faces(self, mill, *changes):
        """Lines of an OBJ file of a mill's faces, which are in any order and every third turned."""
        with tempfile.TemporaryDirectory() as folder:
            run(Path(folder), "millMesh", "faces", mill, *settings(changes), "-o", "faces.obj")
            lines = Path(folder, "faces.obj").read_text().splitlines()
        points, faces, group = [line for line in lines if line.startswith("v")], [], ""
        for line in lines:
            if line.startswith("g"):
                group = line
            elif line.startswith("f"):
                corners = line.split()[1:]
                faces.append(f"{group}\nf {' '.join(corners[::-1] if len(faces) % 3 else corners)}")
        random.Random(1).shuffle(faces)
        return points + faces

    def test_faces_of_few_cells(self):
        """No solver's choice, but of sound topology."""
        def square(low, high):
            return [(low, low), (high, low), (high, high), (low, high)]

        for name, cells, lines in (
                ("wedge", 1, prism([(0, 0), (1, 0), (1, 0.5)], 0, 1)),
                ("concave", 1, prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 0, 1)),
                ("nested", 2, prism(square(0, 4), 0, 4) + prism(square(0.5, 1.5), 1, 2, 8))):
            with self.subTest(name):
                topology = self.assemble(lines).split("Checking geometry...")[0]
                self.assertRegex(topology, rf"\n +cells: +{cells}\n")
                self.assertIn("Topological cell zip-up check OK", topology)
                self.assertNotIn("***", topology)


def prism(section, low, high, points_before=0):
    """Points and faces of a prism over a polygon [(x, y)], as lines of an OBJ file."""
    n = len(section)
    points = [f"v {x} {y} {z}" for z in (low, high) for x, y in section]
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)] + [range(n), range(n, 2 * n)]
    return points + ["f " + " ".join(str(1 + points_before + i) for i in side) for side in sides]


if __name__ == "__main__":
    unittest.main(verbosity=2)
