#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""particleDrag with solids on the cells of the flow's mesh: which cell gets what, and whose mesh is refused."""
import unittest

import numpy as np

import solids
from millfoam.files import foam
from openfoam_case import OpenFoamTest, require_environment, rotating_mesh

FIELDS = ("solidity", "solidsVelocity", "solidsDiameter")


def volumes(mesh):
    """Volumes of cells whose faces are fans of triangles about the mean of their points, [cells] in m^3."""
    volume = np.zeros(mesh.cells)
    for number, face in enumerate(mesh.faces):
        corner = mesh.points[face]
        cone = np.cross(corner, np.roll(corner, -1, axis=0)).sum(axis=0) @ corner.mean(axis=0) / 6
        volume[mesh.owner[number]] += cone
        if number < len(mesh.neighbour):
            volume[mesh.neighbour[number]] -= cone
    return volume


class CellsTest(OpenFoamTest):
    """A box of 6 x 4 x 2 cells with displaced points, so that their faces are warped, that turns about z."""

    delta_t, steps, windows = 2e-3, 6, 3

    def setUp(self):
        super().setUp()
        random = np.random.default_rng(1)
        cells = (self.windows, 48)
        self.written = {"solidity": random.uniform(0.1, 0.6, cells), "velocity": random.normal(size=(*cells, 3)),
                        "diameter": random.uniform(0.002, 0.008, cells)}

    def cells_case(self, entries="", *, ranks=1, measure=lambda volume: volume, **options):
        case = self.box(lower=(-0.02, -0.03, 0), upper=(0.04, 0.02, 0.02), cells=(6, 4, 2), delta_t=self.delta_t,
                        end_time=self.steps * self.delta_t)
        points = foam.read_mesh(case.path).points
        points += 8e-4 * np.sin(np.arange(points.size)).reshape(points.shape)
        rows = "\n".join("(" + " ".join(repr(float(x)) for x in row) + ")" for row in points)
        case.write("constant/polyMesh/points", f"{len(points)}\n(\n{rows}\n)", "vectorField")
        case.write("constant/dynamicMeshDict", rotating_mesh(-20))
        self.volumes = volumes(foam.read_mesh(case.path))
        solids.write_cells(case.path / "solids.h5", measure(self.volumes),
                           **{"window": 0.004, **self.written, **options})
        case.drag(f'law Ergun; solids "solids.h5"; {entries}')
        if ranks > 1:
            case.decompose_into(2, 1, 1)
            self.assert_runs(case, "decomposePar")
        return case

    def found(self, case, ranks=1):
        """Fields that the flow felt, after each step."""
        self.assert_runs(case, "millInterFoam", ranks=ranks)
        if ranks > 1:
            self.assert_runs(case, "reconstructPar")
        return {name: [case.field(name, self.delta_t * (n + 1)) for n in range(self.steps)] for name in FIELDS}


class Values(CellsTest):
    def assert_as_written(self, found):
        # Flow times 2, 4, ... 12 ms; windows of 4 ms, the last one to its very end
        windows = [0, 1, 1, 2, 2, 2]
        for name, of in zip(FIELDS, ("solidity", "velocity", "diameter")):
            # OpenFOAM writes 15 digits
            np.testing.assert_allclose(found[name], self.written[of][windows], rtol=1e-14, err_msg=name)

    def test_are_those_of_the_cells_labels_window_by_window_on_a_turning_mesh(self):
        self.assert_as_written(self.found(self.cells_case()))

    def test_are_the_same_to_the_last_bit_on_two_ranks(self):
        one, two = self.found(self.cells_case()), self.found(self.cells_case(ranks=2), ranks=2)
        for name in FIELDS:
            np.testing.assert_array_equal(two[name], one[name], name)
        self.assert_as_written(two)

    def test_interpolation_cell_is_accepted_and_changes_nothing(self):
        self.assert_as_written(self.found(self.cells_case("interpolation cell;")))

    def test_a_restart_on_the_turned_mesh_takes_up_the_cells(self):
        case = self.cells_case()
        case.control(end_time=0.004, delta_t=self.delta_t)
        self.assert_runs(case, "millInterFoam")
        case.control(end_time=self.steps * self.delta_t, delta_t=self.delta_t, start_time=0.004)
        self.assert_as_written(self.found(case))

    def test_the_log_says_that_they_are_on_cells(self):
        self.assertIn("on the mesh's cells", self.assert_runs(self.cells_case(), "millInterFoam").log)


class MeshTime(CellsTest):
    """The mesh must be turned to the time at which the solids begin."""

    warning = "the flow's mesh is not where the solids' was"

    def log(self, **options):
        # OpenFOAM breaks long lines at will
        return " ".join(self.assert_runs(self.cells_case(time0=1.5, **options), "millInterFoam").log.split())

    def test_another_one_is_warned_of(self):
        log = self.log(mesh_time=1.0)
        self.assertIn(self.warning, log)
        self.assertIn("millMesh --at-time 1.5", log)

    def test_the_same_gives_no_warning(self):
        self.assertNotIn(self.warning, self.log(mesh_time=1.5))

    def test_of_a_mesh_at_rest_does_not_matter(self):
        for motion in ("", "at rest"):
            self.assertNotIn(self.warning, self.log(mesh_time=1.0, motion=motion))


class BeyondTheRecord(CellsTest):
    """The windows turn with the cells, and the charge would turn with them."""

    def outlasting(self, entries, **options):
        return self.cells_case(f"outOfRange {entries};", **options)

    def test_hold_is_refused(self):
        self.assert_refused(self.outlasting("hold"), "fvOptions", "outOfRange is hold", "solids.h5",
                            "rotation speed -20", "expected error, or solids on a box")

    def test_one_mean_over_the_whole_run_is_refused(self):
        self.written = {name: values[:1] for name, values in self.written.items()}
        self.assert_refused(self.cells_case(whole_run=True), "fvOptions", "solids.h5", "whole run",
                            "or solids on a box")

    def test_a_part_of_a_turn_is_not_repeated(self):
        # 12 ms of 20 rad/s
        self.assert_refused(self.outlasting("repeat"), "outOfRange is repeat", "solids.h5", "0.03819718",
                            "expected a whole number of turns")

    def test_whole_turns_are_repeated(self):
        # Three windows of four turns together
        case = self.outlasting("repeat", window=2 * np.pi / 15)
        self.assert_runs(case, "millInterFoam")

    def test_some_hundredths_of_a_turn_less_are_refused(self):
        self.assert_refused(self.outlasting("repeat", window=2 * np.pi / 15 * 0.995), "3.98 turns")

    def test_turns_of_a_speed_that_changes_are_not_repeated(self):
        case = self.outlasting("repeat", window=2 * np.pi / 15)
        case.write("constant/dynamicMeshDict", rotating_mesh("table ((0 0) (1 -20))"))
        self.assert_refused(case, "fvOptions", "outOfRange is repeat", "omega that is a function of time",
                            "expected a number for omega")

    def test_a_mesh_at_rest_holds_and_repeats(self):
        for motion in ("", "at rest"):
            for entries in ("hold", "repeat"):
                with self.subTest(motion=motion, entries=entries):
                    self.assert_runs(self.outlasting(entries, motion=motion), "millInterFoam")

    def test_a_mesh_that_deforms_repeats(self):
        case = self.outlasting("repeat", motion="points over time")
        case.write("constant/dynamicMeshDict", "dynamicFvMesh staticFvMesh;")
        self.assert_runs(case, "millInterFoam")


class Refused(CellsTest):
    def test_interpolation_linear(self):
        self.assert_refused(self.cells_case("interpolation linear;"), "interpolation is linear", "solids.h5",
                            "expected cell")

    def test_another_number_of_cells(self):
        self.written = {name: values[:, :-1] for name, values in self.written.items()}
        case = self.cells_case(measure=lambda volume: volume[:-1])
        self.assert_refused(case, "solids.h5", "on the 47 cells", "the flow's mesh has 48 cells", "foamMeshToH5")

    def test_a_cell_of_another_volume(self):
        def spoil(volume):
            return volume * np.where(np.isin(np.arange(48), (17, 29)), 1 + 3e-6, 1)
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                case = self.cells_case(ranks=ranks, measure=spoil)
                self.assert_refused(case, "solids.h5", "cell 17", "foamMeshToH5", ranks=ranks)

    def test_a_volume_off_by_half_a_millionth_is_accepted(self):
        self.assert_runs(self.cells_case(measure=lambda volume: volume * (1 + 5e-7)), "millInterFoam")

    def test_a_decomposition_of_a_case_that_writes_few_digits_is_accepted(self):
        case = self.cells_case()
        control = case.path / "system/controlDict"
        control.write_text(control.read_text().replace("writePrecision 15", "writePrecision 6"))
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_runs(case, "millInterFoam", ranks=2)

    def test_the_addressing_of_a_decomposition_is_missing(self):
        case = self.cells_case(ranks=2)
        (case.path / "processor1/constant/polyMesh/cellProcAddressing").unlink()
        self.assert_refused(case, "cellProcAddressing", ranks=2)


if __name__ == "__main__":
    require_environment()
    unittest.main()
