#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The bed that a flow sees: solids between windows, their volume corrected to the ledger's, cells that they do not
cover, and beds from the dictionary that move, grow and turn."""
import re
import unittest

import numpy as np

import solids
from openfoam_case import OpenFoamTest, require_environment

BOX = {"lower": (0, 0, 0), "upper": (0.04, 0.04, 0.04)}
STEP = 0.002


class RecordTest(OpenFoamTest):
    """A closed box of 4 x 1 x 1 cells under voxels of the same size, with windows of 0.01 s."""

    def record_case(self, solidity, *, end_time=STEP, entries="", **options):
        case = self.box(cells=(4, 1, 1), delta_t=STEP, end_time=end_time)
        solids.write(case.path / "solids.h5", **{**BOX, **options}, solidity=solidity)
        case.drag(f'law Ergun; solids "solids.h5"; interpolation cell; {entries}')
        return case

    def fields(self, case, name, *times):
        self.assert_runs(case, "millInterFoam")
        return np.array([case.field(name, time) for time in times])


def spline_coefficients(means, repeats=False):
    """Of the quadratic B-spline that has these means over windows of one length; no bound is met."""
    count = len(means)
    matrix = 4 / 6 * np.eye(count)
    for k in range(count):
        for neighbour in (k - 1, k + 1):
            matrix[k, neighbour % count if repeats else np.clip(neighbour, 0, count - 1)] += 1 / 6
    return np.linalg.solve(matrix, means)


def spline_shares(x):
    """Of the window before, of the window of which the share x has passed, and of the one after."""
    return np.array([(1 - x) ** 2 / 2, 0.5 + x - x * x, x * x / 2])


class InTime(RecordTest):
    """Three windows with centres at 5, 15 and 25 ms, each uniform."""

    phi = np.array([0.2, 0.3, 0.4])
    speed = np.array([0.3, -0.1, 0.2])
    size = np.array([0.002, 0.004, 0.005])

    def three_windows(self, end_time, entries):
        def windows(values):
            return np.tile(values[:, None, None, None], (1, 1, 1, 4))
        velocity = windows(self.speed)[..., None] * [1, -2, 0.5]
        return self.record_case(windows(self.phi), end_time=end_time, entries=entries, velocity=velocity,
                                diameter=windows(self.size))

    def expected(self, windows, x, entries):
        """phi, u and d32 when the share x of the second of three windows has passed: quotients of the spline's phi,
        phi u and phi/d. Windows that do not change in time have their own phi."""
        smooth = "smooth" in entries
        phi = spline_coefficients(self.phi, "repeat" in entries) if smooth else self.phi
        share = (spline_shares(x) if smooth else np.array([0, 1, 0])) * phi[windows]
        return share.sum(), share @ self.speed[windows] / share.sum(), share.sum() / (share @ (1 / self.size[windows]))

    def assert_means(self, entries, end_time, expected):
        """expected: {time: ([window before, window, window after], share of the window that has passed)}"""
        case = self.three_windows(end_time, entries)
        self.assert_runs(case, "millInterFoam")
        for time, mean in expected.items():
            phi, speed, size = self.expected(*mean, entries)
            for name, value in (("solidity", phi), ("solidsVelocity", speed * np.array([1, -2, 0.5])),
                                ("solidsDiameter", size)):
                field = case.field(name, time)
                np.testing.assert_allclose(field, np.broadcast_to(value, field.shape), rtol=1e-12, err_msg=f"{time}")

    def test_smooth_keeps_means_and_holds_at_the_ends(self):
        self.assert_means("inTime smooth;", 0.03, {
            0.002: ([0, 0, 1], 0.2), 0.006: ([0, 0, 1], 0.6), 0.01: ([0, 1, 2], 0), 0.014: ([0, 1, 2], 0.4),
            0.016: ([0, 1, 2], 0.6), 0.024: ([1, 2, 2], 0.4), 0.03: ([1, 2, 2], 1)})

    def test_window_is_valid_from_begin_to_end_and_is_what_particleDrag_takes(self):
        windows = {0.004: ([0, 0, 0], 0), 0.008: ([0, 0, 0], 0), 0.01: ([1, 1, 1], 0), 0.018: ([1, 1, 1], 0),
                   0.024: ([2, 2, 2], 0)}
        for entries in ("", "inTime window;"):
            with self.subTest(entries=entries):
                self.assert_means(entries, 0.024, windows)

    def test_repeat_goes_across_the_seam(self):
        self.assert_means("inTime smooth; outOfRange repeat;", 0.05, {
            0.002: ([2, 0, 1], 0.2), 0.026: ([1, 2, 0], 0.6), 0.03: ([2, 0, 1], 0), 0.036: ([2, 0, 1], 0.6)})

    def test_hold_keeps_the_last_window(self):
        self.assert_means("inTime smooth; outOfRange hold;", 0.05, {0.024: ([1, 2, 2], 0.4), 0.04: ([2, 2, 2], 1)})

    def test_a_restart_takes_up_the_same_mean(self):
        case = self.three_windows(0.03, "inTime smooth;")
        whole = self.fields(case, "solidity", 0.012, 0.022)
        case.control(end_time=0.03, delta_t=STEP, start_time=0.01)
        np.testing.assert_array_equal(self.fields(case, "solidity", 0.012, 0.022), whole)

    def test_something_else_lists_the_known_ones(self):
        self.assert_refused(self.three_windows(STEP, "inTime cubic;"), "cubic", "window", "smooth")


class Ledger(RecordTest):
    """Volumes in units of a cell: the mesh shows sum(solidity), the ledger says something else."""

    phi = np.array([0.1, 0.5, 0.0, 0.6])
    cell = 0.04**3 / 4

    def ledger_case(self, *factors, phi=None, end_time=STEP, entries="ledgerCorrection yes; inTime smooth;"):
        """Windows of the same solids, in which the ledger says `factor` times their volume."""
        phi = self.phi if phi is None else np.array(phi)
        return self.record_case(np.tile(phi, (len(factors), 1, 1, 1)), end_time=end_time, entries=entries,
                                deposited=np.array(factors) * phi.sum() * self.cell)

    def test_scales_the_solidity_so_that_its_volume_is_the_ledgers(self):
        found, = self.fields(self.ledger_case(1.015), "solidity", STEP)
        np.testing.assert_allclose(found, 1.015 * self.phi, rtol=1e-12)

    def test_follows_the_ledger_in_time(self):
        found = self.fields(self.ledger_case(1, 1.01, end_time=0.02), "solidity", 0.004, 0.01, 0.018)
        volumes = spline_coefficients([1, 1.01])
        expected = [spline_shares(0.4)[2], 0.5, 1 - spline_shares(0.8)[0]]
        expected = volumes[0] + (volumes[1] - volumes[0]) * np.array(expected)
        np.testing.assert_allclose(found.sum(axis=1) / self.phi.sum(), expected, rtol=1e-12)

    def test_what_cells_at_the_largest_solidity_cannot_take_goes_to_the_others(self):
        phi = np.array([0.2, 0.895, 0.0, 0.88])
        found, = self.fields(self.ledger_case(1.015, phi=phi), "solidity", STEP)
        self.assertEqual(found[1], 0.9)
        self.assertEqual(found[2], 0)
        self.assertLess(found.max(), 0.9 + 1e-15)
        np.testing.assert_allclose(found.sum(), 1.015 * phi.sum(), rtol=1e-12)
        # The two below the bound keep their ratio unless the second one reaches the bound too
        self.assertEqual(found[3], 0.9)
        np.testing.assert_allclose(found[0], 1.015 * phi.sum() - 1.8, rtol=1e-12)

    def test_the_largest_solidity_may_be_given(self):
        found, = self.fields(self.ledger_case(1, entries="ledgerCorrection yes; largestSolidity 0.58;"), "solidity",
                             STEP)
        np.testing.assert_allclose(found, [0.62 / 6, 3.1 / 6, 0, 0.58], rtol=1e-12)

    def test_the_log_has_the_present_and_the_largest_correction(self):
        log = self.assert_runs(self.ledger_case(1.01, 0.995, end_time=0.02), "millInterFoam").log
        added = [tuple(map(float, pair)) for pair in re.findall(r"volume corrected by (\S+) %, at most (\S+) %", log)]
        ends = 100 * spline_coefficients([1.01, 0.995]) - 100
        np.testing.assert_allclose([added[0], added[-1]], [(ends[0], ends[0]), (ends[1], ends[0])], rtol=1e-9)

    def test_particleDrag_leaves_the_solids_as_they_are(self):
        found, = self.fields(self.ledger_case(1.5, entries=""), "solidity", STEP)
        np.testing.assert_array_equal(found, self.phi)

    def test_above_two_per_cent_is_refused(self):
        for factor in (1.0205, 0.9795):
            with self.subTest(factor=factor):
                self.assert_refused(self.ledger_case(factor), "the ledger says", "above 2 %", "--inside",
                                    "ledgerCorrection no")

    def assert_advice(self, *words, shape, cells=(4, 1, 1), **options):
        """The refusal of solids on uniform voxels, of which the ledger says 3 % more, holds the words."""
        phi = solids.uniform(0.3, shape=shape)
        case = self.box(cells=cells, delta_t=STEP, end_time=STEP)
        solids.write(case.path / "solids.h5", **BOX, solidity=phi, deposited=np.array([1.03 * 0.3 * 0.04 ** 3]),
                     **options)
        case.drag('law Ergun; solids "solids.h5"; interpolation cell; ledgerCorrection yes;')
        log = case.run("millInterFoam").log
        message = " ".join(log[log.index("FOAM FATAL"):].split())
        for word in ("the correction would be 3 %, in size above 2 %", *words):
            self.assertIn(word, message)

    def test_the_refusal_of_few_balls_names_the_voxels_that_hold_eight(self):
        # 0.6 V/(pi/6 d^3) = 2.29 balls of 2 cm in 2 x 2 x 4 cm; 8 balls take (8 pi/6 d^3/0.6)^(1/3) = 3.82 cm
        self.assert_advice("There are 5 balls of 0.02 m", "voxels are 0.02 m wide and 0.04 m long",
                           "holds 2.29 balls, and 8 make an average", "voxels of at least 0.04 m (averages.voxel_size",
                           shape=(1, 2, 2), diameter=0.02)

    def test_the_refusal_of_thick_layers_names_the_thickness_and_the_voxels(self):
        self.assert_advice("take layers of at most 0.01 m (resolution.layers, resolution.last_layer) or voxels of "
                           "at least 0.02 m"
                           " (averages.voxel_size", shape=(4, 2, 2), cells=(4, 4, 2), diameter=0.002)

    def test_the_refusal_of_wide_cells_names_their_width(self):
        self.assert_advice("take cells of at most 0.01 m (resolution.cell_size", "voxels of at least 0.02 m",
                           shape=(2, 4, 4), cells=(2, 2, 4), diameter=0.002)

    def test_the_refusal_of_coarse_voxels_names_how_small_they_may_be(self):
        self.assert_advice("take smaller ones, down to 0.00956 m (averages.voxel_size", "resolution.cell_size",
                           shape=(1, 1, 1), cells=(4, 4, 4), diameter=0.005)

    def test_the_refusal_of_voxels_with_eight_balls_asks_for_no_smaller_ones(self):
        self.assert_advice("take others (averages.voxel_size, averages.counts), or more balls", shape=(1, 1, 1),
                           cells=(4, 4, 4), diameter=0.018)

    def test_a_larger_correction_may_be_allowed(self):
        case = self.ledger_case(1.03, entries="ledgerCorrection yes; largestCorrection 0.04;")
        found, = self.fields(case, "solidity", STEP)
        np.testing.assert_allclose(found, 1.03 * self.phi, rtol=1e-12)
        self.assert_refused(self.ledger_case(1.05, entries="ledgerCorrection yes; largestCorrection 0.04;"),
                            "above 4 %")
        self.assert_refused(self.ledger_case(1, entries="ledgerCorrection yes; largestCorrection 2;"),
                            "largestCorrection is 2", "from 0 to 1")

    def test_below_two_per_cent_is_not(self):
        for factor in (1.0195, 0.9805):
            with self.subTest(factor=factor):
                self.assert_runs(self.ledger_case(factor), "millInterFoam")

    def test_no_room_is_refused(self):
        self.assert_refused(self.ledger_case(1, entries="ledgerCorrection yes; largestSolidity 0.35;"), "no room",
                            "largestSolidity 0.35")

    def test_a_ledger_that_is_no_number_is_refused(self):
        self.assert_refused(self.ledger_case(1, np.nan), "solids.h5", "/ledger/deposited is nan", "window 1")

    def test_a_largest_solidity_of_one_is_refused(self):
        self.assert_refused(self.ledger_case(1, entries="ledgerCorrection yes; largestSolidity 1;"),
                            "largestSolidity is 1")

    def test_is_the_same_on_two_ranks(self):
        phi = np.array([0.2, 0.895, 0.0, 0.88])
        case = self.ledger_case(1.015, phi=phi)
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_runs(case, "millInterFoam", ranks=2)
        self.assert_runs(case, "reconstructPar")
        np.testing.assert_allclose(case.field("solidity", STEP), [1.015 * phi.sum() - 1.8, 0.9, 0, 0.9], rtol=1e-12)


class Uncovered(RecordTest):
    """Voxels that leave out the last of four cells."""

    def case(self, entries):
        return self.record_case(solids.uniform(0.2), entries=entries, upper=(0.03, 0.04, 0.04))

    def test_are_named_by_a_warning(self):
        log = " ".join(self.assert_runs(self.case(""), "millInterFoam").log.split())
        self.assertIn("1 of 4 cells lie outside the grid of the solids: cell 3 at (0.035 0.02 0.02) m", log)

    def test_are_refused_when_they_are_an_error(self):
        self.assert_refused(self.case("uncovered error;"), "1 of 4 cells lie outside", "cell 3 at (0.035 0.02 0.02)",
                            "millAverage", "uncovered warn")


class EmptyZones(RecordTest):
    """A grate before the last of four cells, which the voxels do not see."""

    def case(self, entries="emptyZones (behind);", **options):
        phi = solids.uniform(0.1, 0.3, shape=(1, 1, 2))
        chamber = 0.75 * 0.04 ** 3 * phi[:, 0, 0, 0]
        case = self.record_case(phi, deposited=chamber, velocity=(0.1, 0, 0),
                                entries=f"ledgerCorrection yes; uncovered error; {entries}", **options)
        case.write("system/topoSetDict", """
            actions ( { name behind; type cellZoneSet; action new; source boxToCell; box (0.03 -9 -9) (9 9 9); } );""")
        self.assert_runs(case, "topoSet")
        return case

    def test_have_no_solids_and_the_others_have_all_of_the_ledgers(self):
        case = self.case(end_time=0.02)
        found = self.fields(case, "solidity", 0.008, 0.018)
        np.testing.assert_allclose(found, [[0.1, 0.1, 0.1, 0], [0.3, 0.3, 0.3, 0]], rtol=1e-12)
        np.testing.assert_array_equal(case.field("solidsVelocity", 0.018)[3], [0, 0, 0])

    def test_are_empty_on_two_ranks_too(self):
        case = self.case()
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_runs(case, "millInterFoam", ranks=2)
        self.assert_runs(case, "reconstructPar")
        np.testing.assert_allclose(case.field("solidity", STEP), [0.1, 0.1, 0.1, 0], rtol=1e-12)

    def test_need_no_voxels(self):
        found, = self.fields(self.case(upper=(0.03, 0.04, 0.04)), "solidity", STEP)
        np.testing.assert_allclose(found, [0.1, 0.1, 0.1, 0], rtol=1e-12)

    def test_that_the_mesh_has_not_are_refused(self):
        self.assert_refused(self.case("emptyZones (pulpLifters);"), "emptyZones names pulpLifters", "behind")

    def test_without_cells_are_refused(self):
        # A box in mm
        case = self.case()
        topo = case.path / "system/topoSetDict"
        topo.write_text(topo.read_text().replace("(0.03 -9 -9) (9 9 9)", "(30 -9 -9) (40 9 9)"))
        self.assert_runs(case, "topoSet")
        self.assert_refused(case, "emptyZones names behind", "no cells", "topoSet")


class BlockTest(OpenFoamTest):
    def block_case(self, *blocks, cells=(8, 6, 4), upper=(0.04, 0.03, 0.02), end_time=STEP, entries=""):
        case = self.box(cells=cells, upper=upper, delta_t=STEP, end_time=end_time)
        named = " ".join(f"b{i} {{ {block} }}" for i, block in enumerate(blocks))
        text = f"block {{ {blocks[0]} }}" if len(blocks) == 1 else f"blocks {{ {named} }}"
        case.drag(f"law Ergun; {text} {entries}")
        return case

    def fields(self, case, name, *times):
        self.assert_runs(case, "millInterFoam")
        return np.array([case.field(name, time) for time in times])


class MovingBlock(BlockTest):
    """A box of 12 x 8 x 7 mm that moves obliquely through cells of 5 mm and stays inside the mesh."""

    place = "box (0.0041 0.0083 0.0062) (0.0161 0.0163 0.0132);"
    motion = "velocity (0.37 -0.11 0.09); moves yes;"
    common = "solidity 0.5; diameter 0.005;"
    cell, volume = 0.005**3, 0.012 * 0.008 * 0.007
    times = STEP * np.arange(1, 21)

    def moved(self, entries="", volume=None):
        case = self.block_case(f"{self.place} {self.common} {self.motion} {entries}", end_time=self.times[-1])
        return case, self.fields(case, "solidity", *self.times)

    def test_keeps_its_volume_to_round_off(self):
        _, phi = self.moved()
        np.testing.assert_allclose(phi.sum(axis=1) * self.cell, 0.5 * self.volume, rtol=1e-13)

    def test_is_where_its_velocity_carries_it(self):
        case, phi = self.moved()
        centres = case.centres()
        for time, field in zip(self.times, phi):
            lower = np.array([0.0041, 0.0083, 0.0062]) + time * np.array([0.37, -0.11, 0.09])
            overlap = np.minimum(centres + 0.0025, lower + [0.012, 0.008, 0.007]) - np.maximum(centres - 0.0025, lower)
            share = np.clip(overlap, 0, None).prod(axis=1) / self.cell
            np.testing.assert_allclose(field, 0.5 * share, rtol=0, atol=1e-14)

    def test_keeps_its_volume_with_soft_edges(self):
        # A ramp over 2 mm at both sides takes as much as a sharp edge 1 mm further in
        volume = 0.010 * 0.006 * 0.007
        for shape in ("cosine", "linear"):
            with self.subTest(shape=shape):
                _, phi = self.moved(f"edge 0.002; edgeAxes (1 1 0); edgeShape {shape};")
                np.testing.assert_allclose(phi.sum(axis=1) * self.cell, 0.5 * volume, rtol=1e-13)

    def test_rests_when_its_time_is_up(self):
        case, phi = self.moved("until 0.02;")
        late = self.times > 0.02 - 1e-9
        for field in phi[late]:
            np.testing.assert_array_equal(field, phi[late][0])
        self.assertGreater(np.abs(phi[0] - phi[late][0]).max(), 0.1)
        self.assertGreater(np.abs(case.field("solidsVelocity", 0.018)).max(), 0.3)
        np.testing.assert_array_equal(case.field("solidsVelocity", 0.02), 0)

    def test_cells_centre_takes_whole_cells(self):
        _, phi = self.moved("cells centre;")
        self.assertEqual(set(phi.ravel()), {0, 0.5})


class Blocks(BlockTest):
    everywhere = "box (-9 -9 -9) (9 9 9);"
    common = "solidity 0.3; diameter 0.004;"

    def test_a_ramp_lets_the_solidity_grow_smoothly(self):
        case = self.block_case(f"{self.everywhere} {self.common} velocity (0 0 0); ramp {{ time (0.004 0.012); }}",
                               end_time=0.016)
        phi = self.fields(case, "solidity", 0.002, 0.006, 0.01, 0.012, 0.016)
        np.testing.assert_allclose(phi[:, 0], [0, 0.3 * 53 / 512, 0.3 * 459 / 512, 0.3, 0.3], rtol=1e-12)
        np.testing.assert_array_equal(phi, phi[:, :1] * np.ones_like(phi))

    def test_omega_turns_the_balls_about_an_axis(self):
        case = self.block_case(f"{self.everywhere} {self.common} velocity (0.1 0 0); omega 3; origin (0.01 0.02 0);"
                               " axis (0 0 2);")
        velocity, = self.fields(case, "solidsVelocity", STEP)
        from_origin = case.centres() - [0.01, 0.02, 0]
        np.testing.assert_allclose(velocity, np.cross([0, 0, 3], from_origin) + [0.1, 0, 0], rtol=0, atol=1e-14)

    def test_a_cylinder_holds_the_cells_whose_centres_lie_in_it(self):
        case = self.block_case("cylinder { centre (0.02 0.015 0.001); axis (0 0 1); radius 0.011; ends (0.005 0.016); }"
                               f" {self.common} velocity (0 0 0);")
        phi, = self.fields(case, "solidity", STEP)
        x, y, z = (case.centres() - [0.02, 0.015, 0.001]).T
        inside = (np.hypot(x, y) < 0.011) & (z > 0.005) & (z < 0.016)
        self.assertTrue(0 < inside.sum() < len(inside))
        np.testing.assert_array_equal(phi, np.where(inside, 0.3, 0))

    def test_soft_edges_rise_from_the_face(self):
        edges = {"linear": lambda s: s, "cosine": lambda s: (1 - np.cos(np.pi * s)) / 2}
        for shape, rise in edges.items():
            with self.subTest(shape=shape):
                case = self.block_case(f"box (0.002 -9 -9) (0.038 9 9); edge 0.01; edgeAxes (1 0 0); edgeShape {shape};"
                                       f" {self.common} velocity (0 0 0);")
                phi, = self.fields(case, "solidity", STEP)
                x = case.centres()[:, 0]
                depth = np.clip(np.minimum(x - 0.002, 0.038 - x) / 0.01, 0, 1)
                np.testing.assert_allclose(phi, 0.3 * rise(depth), rtol=1e-12)

    def test_several_add_up(self):
        case = self.block_case(f"box (-9 -9 -9) (0.025 9 9); {self.common} velocity (0.1 0 0);",
                               "box (0.015 -9 -9) (9 9 9); solidity 0.2; diameter 0.002; velocity (0 0.2 0);")
        self.assert_runs(case, "millInterFoam")
        x = case.centres()[:, 0]
        first, second = np.where(x < 0.025, 0.3, 0), np.where(x > 0.015, 0.2, 0)
        phi = first + second
        np.testing.assert_allclose(case.field("solidity", STEP), phi, rtol=1e-14)
        np.testing.assert_allclose(case.field("solidsVelocity", STEP),
                                   np.column_stack([first * 0.1, second * 0.2, 0 * phi]) / phi[:, None], rtol=1e-14)
        np.testing.assert_allclose(case.field("solidsDiameter", STEP), phi / (first / 0.004 + second / 0.002),
                                   rtol=1e-14)

    def test_a_volume_that_is_given_is_kept(self):
        # Half of the second cell is in the block but not its centre
        case = self.block_case(f"box (0 -9 -9) (0.0151 9 9); {self.common} velocity (0 0 0); volume {{}};".format(
            0.3 * 0.0151 * 0.03 * 0.02), entries="ledgerCorrection yes;")
        phi, = self.fields(case, "solidity", STEP)
        np.testing.assert_allclose(phi.sum() * 0.005**3, 0.3 * 0.0151 * 0.03 * 0.02, rtol=1e-12)


class RefusedBlocks(BlockTest):
    good = "box (0 0 0) (0.02 0.02 0.02); solidity 0.5; diameter 0.005; velocity (0.1 0 0);"
    cylinder = "cylinder { centre (0 0 0); axis (0 0 1); radius 0.01; ends (0 0.1); }"

    def assert_block_refused(self, block, *words):
        self.assert_refused(self.block_case(block, cells=(2, 1, 1)), *words)

    def test_neither_box_nor_cylinder(self):
        self.assert_block_refused(self.good.replace("box", "ball"), "neither", "'box'", "'cylinder'")

    def test_both_box_and_cylinder(self):
        self.assert_block_refused(self.good + self.cylinder, "both", "'box'", "'cylinder'")

    def test_edges_wider_than_the_box(self):
        self.assert_block_refused(self.good + "edge 0.011;", "edges along the axes are (0.011 0.011 0.011)")

    def test_a_cylinder_inside_out(self):
        bad = self.cylinder.replace("ends (0 0.1)", "ends (0.1 0)")
        self.assert_block_refused(bad + "solidity 0.5; diameter 0.005; velocity (0 0 0);", "ends are 0.1 and 0")

    def test_a_cylinder_that_moves(self):
        self.assert_block_refused(self.cylinder + "solidity 0.5; diameter 0.005; velocity (0.1 0 0); moves yes;",
                                  "moves is yes", "box")

    def test_a_ramp_backwards(self):
        self.assert_block_refused(self.good + "ramp { time (1 0.5); }", "the ramp's time is (1 0.5)")

    def test_blocks_that_leave_no_room(self):
        self.assert_refused(self.block_case(self.good, self.good, cells=(2, 1, 1)), "together have the solidity 1")


class Law(BlockTest):
    """A bed everywhere in slurry at rest: the slip is the balls' velocity."""

    bed = "box (-9 -9 -9) (9 9 9); solidity 0.5; diameter 0.005; velocity (0.1 0 0);"

    def run_log(self, entries):
        case = self.box(cells=(2, 1, 1), delta_t=1e-5, end_time=2e-5, periodic=True)
        case.drag(f"block {{ {self.bed} }} {entries}")
        return self.assert_runs(case, "millInterFoam")

    def test_out_of_its_range_is_warned_of_once_counted_and_summed_up(self):
        log = " ".join(self.run_log("law WenYu;").log.split())
        self.assertEqual(log.count("is used beyond its range"), 1)
        self.assertIn("WenYu is used beyond its range in 100 % of the slurry in the bed (2 cells): solidity above 0.2",
                      log)
        self.assertEqual(log.count("beyond WenYu's range 2 cells, 100 % of the slurry in the bed"), 2)
        self.assertIn("beyond WenYu's range: at most 100 % of the slurry in the bed, in the mean over 2e-05 s 100 %",
                      log)

    def test_within_its_range_is_not_warned_of(self):
        log = self.run_log("law Ergun;").log
        self.assertNotIn("is used beyond its range", log)
        self.assertIn("beyond Ergun's range 0 cells", log)

    def test_polydispersity_is_a_factor_of_the_diameters(self):
        # One size: d43 = d32
        own, plain = (self.run_log(f"law Ergun;{more}").forces()[0, 0] for more in (" polydispersity yes;", ""))
        ratio = own / plain
        self.assertAlmostEqual(ratio, 1 + 0.064 * 0.5, delta=2e-5)

    def test_pore_viscosity_without_a_yield_stress_is_the_plastic_one(self):
        np.testing.assert_array_equal(self.run_log("law Ergun; viscosity pore;").forces(),
                                      self.run_log("law Ergun;").forces())

    def test_an_unknown_viscosity_lists_the_known_ones(self):
        case = self.box(cells=(2, 1, 1))
        case.drag(f"law Ergun; viscosity mean; block {{ {self.bed} }}")
        self.assert_refused(case, "mean", "plastic", "pore")


if __name__ == "__main__":
    require_environment()
    unittest.main()
