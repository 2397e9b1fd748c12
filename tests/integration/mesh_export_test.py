#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""foamMeshToH5: the same mesh.h5 for any format and decomposition, moving points, refused input."""
import gzip
import re
import shutil
import unittest
from pathlib import Path

import h5py
import numpy as np

from millfoam.files import foam
from openfoam_case import OpenFoamTest, require_environment, rotating_mesh

TOPOLOGY = ("face_begin", "face_points", "owner", "neighbour", "patch/name", "patch/first", "patch/faces")


def read(path):
    """All data sets of a mesh file by name, and its attributes."""
    with h5py.File(path) as file:
        sets = {}
        file.visititems(lambda name, item: sets.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        return sets, dict(file.attrs)


class ExportTest(OpenFoamTest):
    def export(self, case, *options, file="mesh.h5"):
        self.assert_runs(case, "foamMeshToH5", *options)
        return read(case.path / file)

    def assert_refused_export(self, case, *words, options=()):
        self.assert_refused(case, *words, program="foamMeshToH5", options=options)
        self.assertFalse((case.path / "mesh.h5").exists())

    def assert_same_mesh(self, found, expected):
        for name in TOPOLOGY:
            np.testing.assert_array_equal(found[name], expected[name], name)

    def skewed(self, **options):
        """A periodic box of unequal sides whose middle points are displaced: no two cells are alike."""
        case = self.box(lower=(-0.1, 0.2, 0), upper=(0.5, 0.5, 0.4), cells=(6, 4, 3), periodic=True, **options)
        self.write_points(case, "constant", self.displaced(case, 0.01))
        return case

    @staticmethod
    def displaced(case, size):
        points = foam.read_mesh(case.path).points
        inner = np.all((points > points.min(axis=0) + 1e-9) & (points < points.max(axis=0) - 1e-9), axis=1)
        return points + size * inner[:, None] * np.sin(np.arange(points.size)).reshape(points.shape)

    @staticmethod
    def write_points(case, time, points):
        rows = "\n".join("(" + " ".join(repr(float(x)) for x in row) + ")" for row in points)
        case.write(f"{time}/polyMesh/points", f"{len(points)}\n(\n{rows}\n)", "vectorField")


class Content(ExportTest):
    def test_is_the_mesh_that_the_files_tell(self):
        case = self.skewed()
        found, attributes = self.export(case)
        mesh = foam.read_mesh(case.path)
        np.testing.assert_array_equal(found["points"], [mesh.points])
        faces = np.split(found["face_points"], found["face_begin"][1:-1])
        self.assertEqual([list(face) for face in faces], [list(face) for face in mesh.faces])
        np.testing.assert_array_equal(found["owner"], mesh.owner)
        np.testing.assert_array_equal(found["neighbour"], mesh.neighbour)
        patches = {name.decode(): foam.Patch(first, size) for name, first, size in
                   zip(found["patch/name"], found["patch/first"], found["patch/faces"])}
        self.assertEqual(patches, mesh.patches)
        self.assertEqual(list(found["times"]), [0])
        self.assertEqual((attributes["time0"], attributes["complete"]), (0, 1))

    def test_is_written_where_it_is_asked_for(self):
        case = self.skewed()
        found, _ = self.export(case, "-o", str(case.path / "other.h5"), file="other.h5")
        self.assertEqual(len(found["owner"]), len(foam.read_mesh(case.path).owner))
        self.assertFalse((case.path / "mesh.h5").exists())

    def test_time0_is_that_of_millProperties(self):
        case = self.skewed()
        case.write("constant/millProperties", "time0 1.25;")
        self.assertEqual(self.export(case)[1]["time0"], 1.25)

    def test_time0_is_the_option_where_millProperties_has_none(self):
        case = self.skewed()
        case.write("constant/millProperties", "omega -3;")
        self.assertEqual(self.export(case, "-time0", "0.75")[1]["time0"], 0.75)

    def test_a_file_of_another_kind_is_not_overwritten(self):
        case = self.skewed()
        case.write("notes.txt", "all that I know")
        notes = (case.path / "notes.txt").read_text()
        self.assert_refused_export(case, "notes.txt: this file exists and is not a millfoam-mesh file",
                                   options=("-o", str(case.path / "notes.txt")))
        self.assertEqual((case.path / "notes.txt").read_text(), notes)
        for _ in range(2):  # its own kind is
            self.export(case)

    def test_another_time0_than_that_of_millProperties_is_refused(self):
        case = self.skewed()
        case.write("constant/millProperties", "time0 1.25;")
        self.assert_refused_export(case, "-time0 is 0.75 s", "millProperties", "time0 1.25 s",
                                   options=("-time0", "0.75"))

    def test_a_time0_that_is_no_number_is_refused(self):
        for word in ("nan", "soon", "1s"):
            self.assert_refused_export(self.skewed(), f"-time0 is '{word}'; expected a finite number",
                                       options=("-time0", word))

    def refined(self, *options):
        """A box whose middle cell is cut into eight, which are the last ones: the last one owns no face."""
        case = self.box(lower=(0, 0, 0), upper=(1, 1, 1), cells=(5, 5, 5))
        case.write("system/topoSetDict", """
            actions ( { name middle; type cellSet; action new; source boxToCell;
                        box (0.45 0.45 0.45) (0.55 0.55 0.55); } );""")
        self.assert_runs(case, "topoSet")
        self.assert_runs(case, "refineHexMesh", "middle", *options)
        return case

    def test_a_last_cell_that_owns_no_face_counts(self):
        case = self.refined("-overwrite")
        mesh = foam.read_mesh(case.path)
        self.assertEqual((mesh.owner.max(), mesh.neighbour.max(), mesh.cells), (130, 131, 132))
        self.assertAlmostEqual(mesh.centres_and_volumes()[1].sum(), 1, places=12)
        found, attributes = self.export(case)
        self.assertEqual(attributes["cells"], 132)
        case.decompose_into(2, 2, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_same_mesh(self.export(case, "-decomposed")[0], found)

    def test_a_mesh_that_was_refined_at_a_later_time_is_refused(self):
        self.assert_refused_export(self.refined(), "topology changes at time 0.001")

    def test_a_cell_with_too_few_faces_is_refused(self):
        case = self.skewed()
        path = case.path / "constant/polyMesh/neighbour"
        path.write_text(path.read_text().replace("\n71\n", "\n80\n", 1))
        self.assert_refused_export(case, "cell 72 has 0 faces", "whose largest label is 80", "expected 4 faces or more")


class Formats(ExportTest):
    def assert_format_changes_nothing(self, binary, compressed):
        expected, _ = self.export(self.skewed())
        case = self.skewed()
        folder = case.path / "constant/polyMesh"
        if binary:
            control = (case.path / "system/controlDict").read_text()
            (case.path / "system/controlDict").write_text(control.replace("writeFormat ascii", "writeFormat binary"))
            self.assert_runs(case, "foamFormatConvert", "-constant")
            self.assertIn(b"faceCompactList", (folder / "faces").read_bytes()[:1000])
        if compressed:
            for path in list(folder.iterdir()):
                Path(f"{path}.gz").write_bytes(gzip.compress(path.read_bytes()))
                path.unlink()
        found, _ = self.export(case)
        self.assert_same_mesh(found, expected)
        np.testing.assert_array_equal(found["points"], expected["points"])

    def test_binary(self):
        self.assert_format_changes_nothing(binary=True, compressed=False)

    def test_compressed(self):
        self.assert_format_changes_nothing(binary=False, compressed=True)

    def test_binary_and_compressed(self):
        self.assert_format_changes_nothing(binary=True, compressed=True)


class Decomposed(ExportTest):
    """Three parts in a row: along the periodic axis the last one is the first one's neighbour across a cyclic pair."""

    def decomposed(self, *parts):
        case = self.skewed()
        case.decompose_into(*parts)
        self.assert_runs(case, "decomposePar")
        return case

    def assert_put_together(self, case):
        expected, _ = self.export(case)
        shutil.rmtree(case.path / "constant/polyMesh")
        found, _ = self.export(case)
        self.assert_same_mesh(found, expected)
        # decomposePar writes 15 digits
        np.testing.assert_allclose(found["points"], expected["points"], rtol=1e-14)

    def test_is_put_together_as_it_was(self):
        for parts in ((2, 1, 1), (3, 1, 1), (2, 2, 1)):
            with self.subTest(parts):
                case = self.decomposed(*parts)
                self.assertIn("processorCyclic", (case.path / "processor0/constant/polyMesh/boundary").read_text())
                self.assert_put_together(case)

    def test_is_taken_from_the_parts_when_asked_for(self):
        case = self.decomposed(2, 1, 1)
        whole, _ = self.export(case)
        # Only the whole mesh has changed since
        self.write_points(case, "constant", 2 * foam.read_mesh(case.path).points)
        np.testing.assert_allclose(self.export(case, "-decomposed")[0]["points"], whole["points"], rtol=1e-14)
        np.testing.assert_allclose(self.export(case)[0]["points"], 2 * whole["points"], rtol=1e-14)

    def test_a_missing_part_is_refused(self):
        case = self.decomposed(3, 1, 1)
        shutil.rmtree(case.path / "processor2")
        self.assert_refused_export(case, "face", "lacks a cell or a patch in the 2 parts", options=("-decomposed",))

    def test_addressing_of_another_mesh_is_refused(self):
        case = self.decomposed(2, 1, 1)
        shutil.copy(case.path / "processor1/constant/polyMesh/cellProcAddressing", self.folder)
        other = self.box(cells=(3, 1, 1))
        other.decompose_into(2, 1, 1)
        self.assert_runs(other, "decomposePar")
        shutil.copy(self.folder / "cellProcAddressing", other.path / "processor1/constant/polyMesh")
        self.assert_refused_export(other, "processor1/constant/polyMesh/cellProcAddressing", "has 36 entries",
                                   options=("-decomposed",))

    def test_neither_mesh_nor_parts(self):
        case = self.skewed()
        shutil.rmtree(case.path / "constant/polyMesh")
        self.assert_refused_export(case, str(case.path), "neither constant/polyMesh nor processor*")
        self.assert_refused_export(self.skewed(), "nor processor*", "-decomposed", options=("-decomposed",))


class Times(ExportTest):
    """A mesh whose points move."""

    def moving(self):
        case = self.skewed()
        self.points = {0: foam.read_mesh(case.path).points}
        for time in (0.1, 0.25, 0.5):
            self.points[time] = self.points[0] * (1 + time)
            self.write_points(case, time, self.points[time])
        # A time without its own points
        case.write("0.3/U", "", "volVectorField")
        return case

    def assert_times(self, found, *times):
        self.assertEqual(list(found["times"]), list(times))
        np.testing.assert_array_equal(found["points"], [self.points[time] for time in times])

    def test_without_times_the_points_are_those_of_constant(self):
        case = self.moving()
        result = self.assert_runs(case, "foamMeshToH5")
        self.assertIn("not of 3 later times that have polyMesh/points (-times)", result.log)
        self.assert_times(read(case.path / "mesh.h5")[0], 0)

    def test_all_times_begin_with_the_points_of_constant(self):
        self.assert_times(self.export(self.moving(), "-times", "all")[0], 0, 0.1, 0.25, 0.5)

    def test_points_of_time_0_go_before_those_of_constant(self):
        case = self.moving()
        self.points[0] = 3 * self.points[0]
        self.write_points(case, "0", self.points[0])
        self.assert_times(self.export(case, "-times", "all")[0], 0, 0.1, 0.25, 0.5)

    def test_ranges(self):
        self.assert_times(self.export(self.moving(), "-times", "0.05:0.3,0.5")[0], 0.1, 0.25, 0.5)

    def test_ranges_that_hold_no_time_are_refused(self):
        self.assert_refused_export(self.moving(), "-times 2:3 selects none", "0.25", options=("-times", "2:3"))

    def test_the_same_topology_written_again_is_accepted(self):
        case = self.moving()
        for name in ("faces", "owner", "neighbour", "boundary"):
            shutil.copy(case.path / "constant/polyMesh" / name, case.path / "0.25/polyMesh")
        self.assert_times(self.export(case, "-times", "all")[0], 0, 0.1, 0.25, 0.5)

    def test_a_change_of_topology_is_refused(self):
        case = self.moving()
        owner = (case.path / "constant/polyMesh/owner").read_text()
        (case.path / "0.25/polyMesh/owner").write_text(owner.replace("\n0\n", "\n1\n", 1))
        self.assert_refused_export(case, "topology changes at time 0.25", options=("-times", "all"))

    def test_another_number_of_points_is_refused(self):
        case = self.moving()
        self.write_points(case, 0.25, self.points[0.25][:-1])
        self.assert_refused_export(case, "0.25/polyMesh/points", f"has {len(self.points[0]) - 1} points",
                                   f"expected the {len(self.points[0])}", options=("-times", "all"))

    def test_a_coordinate_that_is_not_finite_is_refused(self):
        case = self.moving()
        self.points[0.25][7, 1] = np.inf
        self.write_points(case, 0.25, self.points[0.25])
        self.assert_refused_export(case, "0.25/polyMesh/points", "'inf'", options=("-times", "all"))

    def test_a_decomposed_mesh_that_moves_is_put_together_at_each_time(self):
        def run(ranks):
            case = self.skewed(end_time=0.02, delta_t=0.01)
            case.write("constant/dynamicMeshDict", rotating_mesh(5))
            case.decompose_into(2, 1, 1)
            if ranks > 1:
                self.assert_runs(case, "decomposePar")
                self.assert_runs(case, "moveDynamicMesh", ranks=ranks)
                return self.export(case, "-decomposed", "-times", "all")[0]
            self.assert_runs(case, "moveDynamicMesh")
            return self.export(case, "-times", "all")[0]
        whole, parts = run(1), run(2)
        self.assertEqual(list(parts["times"]), [0, 0.01, 0.02])
        self.assert_same_mesh(parts, whole)
        np.testing.assert_allclose(parts["points"], whole["points"], rtol=0, atol=1e-14)
        self.assertGreater(np.abs(whole["points"][2] - whole["points"][0]).max(), 0.02)


class WrongFiles(ExportTest):
    def test_a_file_cut_short(self):
        case = self.skewed()
        path = case.path / "constant/polyMesh/faces"
        path.write_text(path.read_text()[:2000])
        self.assert_refused_export(case, "constant/polyMesh/faces")

    def test_a_face_with_a_point_that_is_not_there(self):
        case = self.skewed()
        path = case.path / "constant/polyMesh/faces"
        path.write_text(re.sub(r"4\(\d+ ", "4(999999 ", path.read_text(), count=1))
        self.assert_refused_export(case, "constant/polyMesh/faces", "holds the label 999999",
                                   f"expected 0 to {len(foam.read_mesh(case.path).points) - 1}")

    def test_a_folder_that_cannot_be_written(self):
        case = self.skewed()
        self.assert_refused_export(case, "nowhere/mesh.h5", options=("-o", str(case.path / "nowhere/mesh.h5")))


if __name__ == "__main__":
    require_environment()
    unittest.main()
