#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""particleDrag's clock, its interpolation, and the solids files and dictionaries that it refuses."""
import re
import subprocess
import unittest

import h5py
import numpy as np

import solids
from openfoam_case import OpenFoamTest, require_environment

BOX = {"lower": (0, 0, 0), "upper": (0.04, 0.04, 0.04)}
STEP = 0.002


class SolidsTest(OpenFoamTest):
    """A closed box of 4 x 1 x 1 cells with a solids.h5 of windows of 0.01 s that begins at DEM time 1 s."""

    def solids_case(self, solidity, *, end_time=STEP, entries="interpolation cell;", **options):
        case = self.box(cells=(4, 1, 1), delta_t=STEP, end_time=end_time)
        solids.write(case.path / "solids.h5", **{**BOX, "time0": 1.0, **options}, solidity=solidity)
        case.drag(f'law Ergun; solids "solids.h5"; {entries}')
        return case


class Clock(SolidsTest):
    def solidity_at(self, case, *times):
        """The (uniform) solidity written at flow times."""
        self.assert_runs(case, "millInterFoam")
        fields = [case.field("solidity", time) for time in times]
        for field in fields:
            np.testing.assert_array_equal(field, field[0])
        return [field[0] for field in fields]

    def three_windows(self, end_time, entries=""):
        return self.solids_case(solids.uniform(0.1, 0.2, 0.3), end_time=end_time,
                                entries="interpolation cell; " + entries)

    def test_flow_time_0_is_dem_time0_and_a_window_holds_from_its_begin_to_its_end(self):
        found = self.solidity_at(self.three_windows(0.03), 0.002, 0.008, 0.01, 0.018, 0.02, 0.028, 0.03)
        self.assertEqual(found, [0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.3])

    def test_a_flow_that_outlasts_the_solids_is_refused(self):
        self.assert_refused(self.three_windows(0.04), "solids.h5", "records DEM times 1 to 1.03 s",
                            "the flow needs 0.04 s", "endTime", "outOfRange")

    def test_the_refusal_comes_before_the_first_step(self):
        result = self.assert_refused(self.three_windows(0.04, "outOfRange error;"), "solids.h5")
        self.assertNotIn("Starting time loop", result.log)

    def test_a_last_step_that_ends_after_the_end_time_has_the_last_window(self):
        # The ninth step of 3.5 ms ends at 31.5 ms
        case = self.three_windows(0.03)
        case.control(end_time=0.03, delta_t=0.0035)
        self.assertEqual(self.solidity_at(case, 0.028, 0.0315), [0.3, 0.3])

    def test_hold_keeps_the_last_window(self):
        found = self.solidity_at(self.three_windows(0.05, "outOfRange hold;"), 0.008, 0.028, 0.03, 0.05)
        self.assertEqual(found, [0.1, 0.3, 0.3, 0.3])

    def test_repeat_starts_the_series_again(self):
        found = self.solidity_at(self.three_windows(0.062, "outOfRange repeat;"), 0.028, 0.03, 0.04, 0.058, 0.06)
        self.assertEqual(found, [0.3, 0.1, 0.2, 0.3, 0.1])

    def test_solids_of_the_whole_run_hold(self):
        case = self.solids_case(solids.uniform(0.4), end_time=0.03, whole_run=True)
        self.assertEqual(self.solidity_at(case, 0.002, 0.03), [0.4, 0.4])

    def test_a_restart_takes_up_the_window_of_its_time(self):
        case = self.three_windows(0.03)
        case.control(end_time=0.014, delta_t=STEP)
        self.assert_runs(case, "millInterFoam")
        case.control(end_time=0.03, delta_t=STEP, start_time=0.014)
        self.assertEqual(self.solidity_at(case, 0.016, 0.02), [0.2, 0.3])

    def test_the_right_time0_is_accepted(self):
        self.assertEqual(self.solidity_at(self.three_windows(0.002, "time0 1;"), 0.002), [0.1])

    def test_another_time0_is_refused(self):
        self.assert_refused(self.three_windows(0.002, "time0 1.05;"), "time0 is 1.05 s", "solids.h5",
                            "begins at DEM time 1 s", "millMesh --at-time 1")

    def test_an_unknown_outOfRange_lists_the_known_ones(self):
        self.assert_refused(self.three_windows(0.002, "outOfRange stay;"), "stay", "error", "hold", "repeat")


class Interpolation(SolidsTest):
    """Voxels of 2 cm with solidity 0.2 and 0.4 under cells with centres at 5, 15, 25 and 35 mm."""

    def found(self, name, entries, **options):
        case = self.solids_case([[[[0.2, 0.4]]]], entries=entries, **options)
        result = self.assert_runs(case, "millInterFoam")
        return case.field(name, STEP), result.log

    def test_cell_takes_the_voxel_that_holds_the_centre(self):
        solidity, _ = self.found("solidity", "interpolation cell;")
        np.testing.assert_allclose(solidity, [0.2, 0.2, 0.4, 0.4], rtol=1e-14)

    def test_linear_goes_straight_between_voxel_centres_and_is_constant_beyond(self):
        solidity, _ = self.found("solidity", "interpolation linear;")
        np.testing.assert_allclose(solidity, [0.2, 0.25, 0.35, 0.4], rtol=1e-14)

    def test_linear_weights_velocities_by_solidity(self):
        velocity, _ = self.found("solidsVelocity", "interpolation linear;",
                                 velocity=np.array([[[[[1.0, 0, 0], [-2.0, 3, 0]]]]]))
        share = np.array([0, 0.25, 0.75, 1])
        solidity = 0.2 + 0.2 * share
        np.testing.assert_allclose(velocity[:, 0], (0.2 * (1 - share) - 0.8 * share) / solidity, rtol=1e-13)
        np.testing.assert_allclose(velocity[:, 1], 1.2 * share / solidity, rtol=1e-13)

    def test_linear_weights_inverse_diameters_by_solidity(self):
        diameter, _ = self.found("solidsDiameter", "interpolation linear;", diameter=np.array([[[[0.002, 0.008]]]]))
        share = np.array([0, 0.25, 0.75, 1])
        expected = (0.2 + 0.2 * share) / (0.2 * (1 - share) / 0.002 + 0.4 * share / 0.008)
        np.testing.assert_allclose(diameter, expected, rtol=1e-13)

    def test_cells_outside_the_grid_are_counted_and_feel_no_drag(self):
        solidity, log = self.found("solidity", "interpolation linear;", upper=(0.03, 0.04, 0.04))
        np.testing.assert_allclose(solidity[3], 0)
        self.assertTrue(np.all(solidity[:3] > 0))
        self.assertIn("1 of 4 cells lie outside", log)

    def test_a_grid_that_covers_every_cell_gives_no_warning(self):
        _, log = self.found("solidity", "interpolation linear;")
        self.assertNotIn("lie outside", log)

    def test_an_unknown_interpolation_lists_the_known_ones(self):
        self.assert_refused(self.solids_case(solids.uniform(0.1), entries="interpolation cubic;"), "cubic", "cell",
                            "linear")


class Cylinder(OpenFoamTest):
    """Cells with centres on the x axis at 5, 15, 25 and 35 mm in a cylinder of two voxels along its radius of 3 cm."""

    def solidity(self, interpolation):
        case = self.box(lower=(0, -0.01, 0), upper=(0.04, 0.01, 0.02), cells=(4, 1, 1), delta_t=STEP, end_time=STEP)
        solids.write_cylinder(case.path / "solids.h5", (0, 0.03), (0, 0.02), [[[[0.2, 0.4]] * 3]])
        case.drag(f'law Ergun; solids "solids.h5"; interpolation {interpolation};')
        result = self.assert_runs(case, "millInterFoam")
        self.assertIn("1 of 4 cells lie outside", result.log)
        return case.field("solidity", STEP)

    def test_cell_takes_the_voxel_that_holds_the_centre(self):
        np.testing.assert_allclose(self.solidity("cell"), [0.2, 0.4, 0.4, 0], rtol=1e-14)

    def test_linear_goes_straight_along_the_radius_between_voxel_centres(self):
        # Centres at 7.5 and 22.5 mm
        np.testing.assert_allclose(self.solidity("linear"), [0.2, 0.3, 0.4, 0], rtol=1e-13)


class RefusedFile(SolidsTest):
    def changed(self, change, **options):
        """A case whose solids.h5 went through change(file)."""
        case = self.solids_case(solids.uniform(0.1, 0.2, shape=(2, 2, 2)), **options)
        with h5py.File(case.path / "solids.h5", "r+") as file:
            change(file)
        return case

    def test_missing(self):
        case = self.solids_case(solids.uniform(0.1))
        (case.path / "solids.h5").unlink()
        self.assert_refused(case, "solids.h5", "no such file")

    def test_not_hdf5(self):
        case = self.solids_case(solids.uniform(0.1))
        (case.path / "solids.h5").write_text("solidity 0.1\n")
        self.assert_refused(case, "solids.h5", "not an HDF5 file")

    def test_incomplete(self):
        case = self.changed(lambda file: file.attrs.modify("complete", 0))
        self.assert_refused(case, "solids.h5", "not complete")

    def test_of_another_version(self):
        case = self.changed(lambda file: file.attrs.modify("version", 99))
        self.assert_refused(case, "solids.h5", "'version' is 99")

    def test_of_another_format(self):
        case = self.changed(lambda file: file.attrs.modify("format", "slurry"))
        self.assert_refused(case, "solids.h5", "'format' is 'slurry'")

    def test_a_data_set_is_missing(self):
        case = self.changed(lambda file: file.__delitem__("velocity"))
        self.assert_refused(case, "solids.h5", "velocity")

    def test_not_a_number(self):
        def spoil(file):
            file["solidity"][0, 1, 0, 1] = np.nan
        self.assert_refused(self.changed(spoil), "solids.h5", "solidity is nan", "voxel (1 0 1)", "window 0")

    def test_not_a_number_in_a_later_window_stops_the_flow_when_it_gets_there(self):
        def spoil(file):
            file["velocity"][1, 0, 0, 0, 2] = np.nan
        result = self.assert_refused(self.changed(spoil, end_time=0.02), "solids.h5", "velocity is nan", "window 1")
        self.assertIn("Time = 0.008", result.log)

    def test_a_negative_diameter(self):
        def spoil(file):
            file["diameter"][0, 0, 0, 0] = -0.005
        self.assert_refused(self.changed(spoil), "solids.h5", "diameter is -0.005")

    def test_more_solids_than_room(self):
        def spoil(file):
            file["solidity"][0, 0, 0, 0] = 1.2
        self.assert_refused(self.changed(spoil), "solids.h5", "solidity is 1.2")

    def test_a_gap_between_windows(self):
        def spoil(file):
            file["window/begin"][1] += 0.003
        self.assert_refused(self.changed(spoil), "solids.h5", "no solids between DEM times 1.01 s and 1.013 s")


class OfAnotherMill(SolidsTest):
    """particleDrag compares its entries with what solids.h5 says of its mill."""

    def test_another_speed(self):
        case = self.solids_case(solids.uniform(0.1), entries="interpolation cell; omega 2;", angular_velocity=2.1)
        self.assert_refused(case, "omega is 2 rad/s", "2.1 rad/s", "millAverage again")

    def test_another_fingerprint(self):
        case = self.solids_case(solids.uniform(0.1), entries='interpolation cell; fingerprint "aa";',
                                mill_averages="bb")
        self.assert_refused(case, "fingerprint is aa", "solids.h5", "bb", "millAverage again")

    def test_the_same_are_accepted(self):
        case = self.solids_case(solids.uniform(0.1), entries='interpolation cell; omega 2; fingerprint "aa";',
                                angular_velocity=2.0, mill_averages="aa")
        self.assert_runs(case, "millInterFoam")


class RefusedDictionary(OpenFoamTest):
    BLOCK = "block { box (-9 -9 -9) (9 9 9); solidity 0.5; velocity (0.1 0 0); diameter 0.005; }"

    def assert_entries_refused(self, entries, *words):
        case = self.box(cells=(2, 1, 1))
        case.drag(entries)
        self.assert_refused(case, *words)

    def test_the_entries_that_the_others_are_made_from_are_accepted(self):
        case = self.box(cells=(2, 1, 1))
        case.drag(f"law Ergun; {self.BLOCK}")
        self.assert_runs(case, "millInterFoam")

    def test_an_unknown_law_lists_the_known_ones(self):
        table = subprocess.run(["millDrag", "--phi", "0.5", "--re", "1"], check=True, capture_output=True, text=True)
        known = [line.split(",")[0] for line in table.stdout.splitlines()[1:]]
        self.assertGreaterEqual(len(known), 6)
        self.assert_entries_refused(f"law Stokes; {self.BLOCK}", "Stokes", *known)

    def test_neither_block_nor_solids(self):
        self.assert_entries_refused("law Ergun;", "neither", "'solids'", "'block'")

    def test_both_block_and_solids(self):
        self.assert_entries_refused(f'law Ergun; solids "solids.h5"; {self.BLOCK}', "both", "'solids'", "'block'")

    def test_a_negative_diameter(self):
        self.assert_entries_refused("law Ergun;" + self.BLOCK.replace("diameter 0.005", "diameter -0.005"),
                                    "diameter is -0.005")

    def test_a_solidity_of_one(self):
        self.assert_entries_refused("law Ergun;" + self.BLOCK.replace("solidity 0.5", "solidity 1"), "solidity is 1")

    def test_a_box_turned_inside_out(self):
        self.assert_entries_refused("law Ergun;" + re.sub(r"box [^;]*", "box (9 9 9) (-9 -9 -9)", self.BLOCK), "box is")

    def test_a_negative_multiplier(self):
        self.assert_entries_refused(f"law Ergun; multiplier -1; {self.BLOCK}", "multiplier is -1")

    def test_a_missing_law(self):
        self.assert_entries_refused(self.BLOCK, "law")

    def test_a_misspelt_phase(self):
        case = self.box(cells=(2, 1, 1))
        case.drag(f"law Ergun; {self.BLOCK}")
        options = case.path / "constant/fvOptions"
        options.write_text(options.read_text().replace("alpha.slurry", "alpha.slury"))
        self.assert_refused(case, "alpha.slury")


if __name__ == "__main__":
    require_environment()
    unittest.main()
