#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What slurryFoam and slurryStart refuse, and what they say: a bed, its drag, a solids.h5, the slurry, the surface."""
import re
import shutil
import tempfile
import unittest

import h5py
import numpy as np

import solids
from openfoam_case import require_environment, rotating_mesh
from slurry_case import BINGHAM, SOLUTION, SlurryCase, SlurryTest

BLOCK = "box (-9 -9 -9) (9 9 9); solidity 0.5; velocity (0.1 0 0); diameter 0.005;"


class RefusedTest(SlurryTest):
    """The cases of a class share one mesh, 4 x 4 x 1 cells of 1 cm."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="millfoam_test_")
        cls.addClassCleanup(folder.cleanup)
        cls.meshed = cls.unmeshed(folder.name)
        result = cls.meshed.run("blockMesh")
        if result.code:
            raise RuntimeError(result.tail())

    @staticmethod
    def unmeshed(folder, **options):
        return SlurryCase(folder, **{"upper": (0.04, 0.04, 0.01), "cells": (4, 4, 1), "end_time": 0.002,
                                     "level": lambda x: 0.021 + 0 * x, **options})

    def small(self, **options):
        case = self.unmeshed(tempfile.mkdtemp(prefix="case", dir=self.folder), **options)
        shutil.copytree(self.meshed.path / "constant/polyMesh", case.path / "constant/polyMesh")
        return case

    def assert_says(self, case, *words, program="slurryFoam"):
        """Refused, and the message, whose lines OpenFOAM breaks at will, holds every one of the words."""
        result = case.run(program)
        self.assertNotEqual(result.code, 0, f"{program} was expected to refuse:\n{result.tail()}")
        at = result.log.find("FOAM FATAL")
        self.assertGreaterEqual(at, 0, f"no error sentence:\n{result.tail()}")
        message = " ".join(result.log[at:].split())
        for word in words:
            self.assertIn(word, message)
        return result


class Bed(RefusedTest):
    """constant/bedProperties"""

    def assert_bed_refused(self, solid, *words, drag="law Beetstra;", entries=""):
        case = self.small()
        case.bed(solid, drag, entries)
        return self.assert_says(case, "bedProperties", *words)

    def block(self, pattern="", new=""):
        return f"block {{ {re.sub(pattern, new, BLOCK) if pattern else BLOCK} }}"

    def test_what_the_others_are_made_from_is_accepted(self):
        case = self.small()
        case.bed(self.block())
        self.assert_runs(case, "slurryFoam")

    def test_an_unknown_law_lists_the_known_ones(self):
        self.assert_bed_refused(self.block(), "Stokes", "Beetstra", "Ergun", "WenYu", drag="law Stokes;")

    def test_no_law(self):
        self.assert_bed_refused(self.block(), "'law'", "drag", drag="multiplier 1;")

    def test_no_drag(self):
        case = self.small()
        case.write("constant/bedProperties", self.block())
        self.assert_says(case, "bedProperties", "drag")

    def test_a_misspelt_entry_of_the_drag(self):
        self.assert_bed_refused(self.block(), "multiplyer", "multiplier", drag="law Beetstra; multiplyer 2;")

    def test_a_misspelt_entry_of_the_bed(self):
        self.assert_bed_refused(self.block(), "voidageRates", "voidageRate", entries="voidageRates no;")

    def test_a_misspelt_block(self):
        self.assert_bed_refused(f"blok {{ {BLOCK} }}", "blok", "block")

    def test_a_file_without_a_header_is_not_taken_for_none(self):
        case = self.small()
        case.bed(self.block())
        path = case.path / "constant" / "bedProperties"
        path.write_text(re.sub(r"FoamFile\s*\{[^}]*\}", "", path.read_text()))
        self.assert_says(case, "bedProperties", "has no header 'FoamFile")

    def test_a_second_drag_of_the_same_balls(self):
        case = self.small()
        case.bed(self.block())
        case.drag(f"law Ergun; {self.block()}")
        self.assert_says(case, "bedProperties", "particleDrag bed", "again")

    def test_a_slurry_that_thickens_is_accepted_where_it_rests(self):
        case = self.small()
        case.control(0.004, 0.002, write_interval=2)
        case.bed(f"block {{ {BLOCK.replace('(0.1 0 0)', '(0 0 0)')} }}", drag="law Ergun; viscosity pore;")
        properties = case.path / "constant/transportProperties"
        properties.write_text(re.sub(r"transportModel Bingham; (.*?) BinghamCoeffs \{.*?\}",
                                     r"transportModel HerschelBulkley; \1 HerschelBulkleyCoeffs { tau0 0; k 1e-4; "
                                     r"n 1.5; nu0 1; }", properties.read_text()))
        control = case.path / "system/controlDict"
        control.write_text(control.read_text()
                           + 'functions { balance { type slurryBalance; libs ("libmillFoam.so"); speed 0; } }')
        self.assert_runs(case, "slurryFoam")
        self.assertLess(np.abs(case.field("U", 0.004)).max(), 1e-6)

    def test_an_entry_of_ones_own_is_accepted(self):
        case = self.small()
        case.bed(f"mySolidity 0.5; {self.block('solidity 0.5', 'solidity $mySolidity')}")
        self.assert_runs(case, "slurryFoam")

    def test_a_misspelt_entry_of_a_block(self):
        self.assert_bed_refused(self.block("$", " move yes;"), "move", "moves")

    def test_a_bed_that_has_neither_solids_nor_blocks(self):
        self.assert_bed_refused(f"bed {{ {BLOCK} }}", "'solids'", "'block'")

    def test_a_solidity_of_one(self):
        self.assert_bed_refused(self.block("solidity 0.5", "solidity 1"), "solidity is 1", "0 <= solidity < 1")

    def test_a_block_that_turns_about_nothing(self):
        self.assert_bed_refused(f"block {{ {BLOCK} omega 5; axis (0 0 0); origin (0 0 0); }}", "axis is (0 0 0)",
                                "a direction")

    def test_a_block_and_blocks(self):
        self.assert_bed_refused(f"{self.block()} blocks {{ one {{ {BLOCK} }} }}", "both of the entries 'block' and"
                                " 'blocks'")

    def test_blocks_without_one(self):
        self.assert_bed_refused("blocks { }", "blocks is empty")

    def test_a_ramp_that_is_no_dictionary(self):
        self.assert_bed_refused(f"block {{ {BLOCK} ramp (0 1); }}", "ramp")

    def test_an_end_of_the_motion_of_a_block_that_rests(self):
        self.assert_bed_refused(f"block {{ {BLOCK} until 0.1; }}", "until is 0.1 s", "'moves yes;'")

    def test_a_block_of_no_volume(self):
        self.assert_bed_refused(f"block {{ {BLOCK} volume -1e-5; }}", "volume is -1e-05", "above 0 m3")


class Controls(RefusedTest):
    """Dictionaries and meshes that slurryFoam cannot obey"""

    def test_another_scheme_in_time(self):
        case = self.small()
        schemes = case.path / "system/fvSchemes"
        schemes.write_text(schemes.read_text().replace("default Euler;", "default backward;"))
        self.assert_says(case, "fvSchemes", "default is backward", "Euler")

    def test_no_prediction_of_momentum(self):
        case = self.small()
        case.write("system/fvSolution", SOLUTION.format(non_orthogonal=0, surface="", pimple="momentumPredictor no;"))
        self.assert_says(case, "fvSolution", "momentumPredictor is no")

    def test_no_correction(self):
        for name in ("nCorrectors", "nOuterCorrectors"):
            with self.subTest(name=name):
                case = self.small()
                solution = case.path / "system/fvSolution"
                solution.write_text(solution.read_text().replace(f"{name} 1;", f"{name} 0;"))
                result = self.assert_says(case, "fvSolution", f"{name} is 0", "1 or more")
                self.assertNotIn("Time = ", result.log)

    def assert_control_refused(self, pattern, new, *words):
        case = self.small()
        case.adjusted(0.002, 0.002)
        control = case.path / "system/controlDict"
        control.write_text(re.sub(pattern, new, control.read_text()))
        self.assertIn(new, control.read_text())
        result = self.assert_says(case, "controlDict", *words)
        self.assertNotIn("Time = ", result.log)

    def test_bounds_of_the_time_step_that_are_not_above_0(self):
        for name in ("maxCo", "maxAlphaCo", "maxVoidageChange", "maxDeltaT"):
            with self.subTest(name=name):
                self.assert_control_refused(rf"{name} [^;]+;", f"{name} 0;", f"{name} is 0", "a number above 0")
        self.assert_control_refused("maxCo", "maxAirCo -2; maxCo", "maxAirCo is -2")

    def test_misspelt_bounds_of_the_time_step(self):
        for name, misspelt in (("maxVoidageChange", "maxVoidageChanges"), ("maxDeltaT", "maxDeltat"),
                               ("adjustTimeStep", "adjustTimestep")):
            with self.subTest(name=name):
                self.assert_control_refused(name, misspelt, f"'{misspelt}'", f"'{name}'")

    def test_steps_and_intervals_that_are_not_above_0(self):
        # With adjustTimeStep, and OpenFOAM's divisions by them
        for name in ("deltaT", "writeInterval"):
            for value in ("0", "-1"):
                with self.subTest(name=name, value=value):
                    self.assert_control_refused(rf"\b{name} [^;]+;", f"{name} {value};", f"{name} is {value}",
                                                "a number above 0")

    def test_an_end_before_the_start(self):
        self.assert_control_refused("endTime 0.002;", "endTime -1;", "endTime is -1 s", "the flow has reached 0 s")

    def test_an_end_before_what_the_flow_has_reached(self):
        case = self.small()
        shutil.copytree(case.path / "0", case.path / "0.15")
        control = case.path / "system/controlDict"
        control.write_text(control.read_text().replace("startFrom startTime", "startFrom latestTime").replace(
            "endTime 0.002", "endTime 0.1"))
        self.assert_says(case, "controlDict", "endTime is 0.1 s", "the flow has reached 0.15 s")
        self.assertEqual(list(case.path.glob("postProcessing/flow/[0-9]*")), [])

    def test_a_file_of_the_mesh_that_is_missing(self):
        for name in ("points", "faces", "owner", "neighbour", "boundary"):
            with self.subTest(name=name):
                case = self.small()
                (case.path / "constant/polyMesh" / name).unlink()
                self.assert_says(case, f'constant/polyMesh/{name}": no such file', "millMesh")

    def test_one_rank_in_a_case_that_several_have_computed(self):
        case = self.small()
        for name in ("processor0/0", "processor0/0.002"):
            shutil.copytree(case.path / "0", case.path / name)
        result = self.assert_says(case, "on several ranks", "0.002 s", "no time later than 0 s", "-parallel",
                                  "reconstructPar")
        self.assertNotIn("Time = ", result.log)
        shutil.copytree(case.path / "0", case.path / "0.002")
        self.assert_runs(case, "slurryFoam")

    def test_one_rank_in_a_case_of_collated_files(self):
        case = self.small()
        shutil.copytree(case.path / "0", case.path / "processors2/0.002")
        result = self.assert_says(case, "on several ranks has reached 0.002 s", "-parallel")
        self.assertNotIn("Time = ", result.log)

    def test_several_ranks_in_a_case_that_one_has_computed(self):
        case = self.small()
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        shutil.copytree(case.path / "0", case.path / "0.002")
        self.assert_refused(case, "on one rank has reached 0.002 s", program="slurryFoam", ranks=2)
        self.assertEqual(list(case.path.glob("postProcessing/flow/[0-9]*")), [])

    def written(self):
        """A case that has reached 0.002 s of 0.004 s."""
        case = self.small()
        case.control(0.002, 0.001, 2)
        self.assert_runs(case, "slurryFoam")
        case.control(0.004, 0.001, 2, start_time=0.002)
        return case

    def test_a_time_that_was_not_written_to_its_end(self):
        case = self.written()
        for name in ("phi", "forceAcceleration", "fluxDetail", "massMoved", "uniform/slurryFlow"):
            with self.subTest(name=name):
                half = self.copy_of(case)
                (half.path / "0.002" / name).unlink()
                result = self.assert_says(half, f"0.002/{name}", "no such file", "resumes at 0.002 s")
                self.assertNotIn("Time = ", result.log)
        self.assert_runs(case, "slurryFoam")

    def test_fields_alone_are_accepted(self):
        case = self.written()
        for path in (case.path / "0.002").iterdir():
            if path.name == "uniform":
                shutil.rmtree(path)
            elif path.name not in ("U", "p_rgh", "alpha.slurry"):
                path.unlink()
        self.assert_runs(case, "slurryFoam")

    def assert_object_refused(self, entries, *words, name="balance"):
        case = self.small()
        control = case.path / "system/controlDict"
        control.write_text(control.read_text() + f'functions {{ {name} {{ libs ("libmillFoam.so"); {entries} }} }}')
        result = self.assert_says(case, "controlDict", *words)
        self.assertNotIn("Time = ", result.log)

    def test_a_misspelt_type_of_a_function_object(self):
        for entries in ("type slurryBallance; speed 1;", "type slurryBallance; speed 1; enabled yes;"):
            self.assert_object_refused(entries, "type is slurryBallance", "function object balance")

    def test_an_interval_of_a_function_object_by_which_openfoam_would_divide(self):
        for what in ("write", "execute"):
            with self.subTest(what=what):
                self.assert_object_refused(f"type slurryBalance; speed 1; {what}Control runTime; {what}Interval 0;",
                                           f"{what}Interval is 0", "above 0")

    def test_slices_beyond_the_mesh(self):
        for ends in ("(1 2)", "(0 0.1)", "(-0.1 0.01)"):
            self.assert_object_refused(f"type axialProfiles; slices 4; ends {ends};", "slices from",
                                       "some have no cells", "from 0 to 0.01 m")

    def test_an_entry_that_writeEnd_does_not_have(self):
        self.assert_object_refused("type writeEnd; foo 1;", "foo")

    def test_averages_in_a_folder_that_is_not_there(self):
        self.assert_object_refused("type voxelAverages; lower (0 0 0); upper (0.04 0.04 0.01); shape (4 4 1); interval"
                                   ' 0.001; window 0.002; file "missing/x.h5";', "no folder", "missing")

    def test_averages_of_two_objects_in_one_file(self):
        case = self.small()
        control = case.path / "system/controlDict"
        box = "lower (0 0 0); upper (0.04 0.04 0.01); window 0.002;"
        averages = f'{{ type voxelAverages; libs ("libmillFoam.so"); {box} shape'
        control.write_text(control.read_text() + f"functions {{ fine {averages} (4 4 1); }}"
                                                 f" coarse {averages} (1 1 1); }} }}")
        result = self.assert_says(case, "controlDict", "slurry.h5", "fine and coarse")
        self.assertNotIn("Time = ", result.log)
        control.write_text(control.read_text().replace("(1 1 1);", '(1 1 1); file "coarse.h5";'))
        self.assert_runs(case, "slurryFoam")
        self.assertTrue((case.path / "slurry.h5").is_file() and (case.path / "coarse.h5").is_file())

    def test_windows_that_are_hardly_longer_than_an_instant(self):
        self.assert_object_refused("type voxelAverages; lower (0 0 0); upper (0.04 0.04 0.01); shape (4 4 1); interval"
                                   " 0.001; window 1e-12;", "window is 1e-12", "at least 1e-06 s")

    def test_a_tracer_without_its_solver(self):
        case = self.small()
        control = case.path / "system/controlDict"
        control.write_text(control.read_text() + 'functions { salt { type slurryTracer; libs ("libmillFoam.so"); } }')
        result = self.assert_says(case, "fvSolution", "no entry for the tracer salt")
        self.assertNotIn("Time = ", result.log)

    def test_a_tracer_without_the_iterations_of_its_limiter(self):
        case = self.small()
        solution = case.path / "system/fvSolution"
        solution.write_text(solution.read_text().replace('"(U|k', '"(salt|U|k'))
        schemes = case.path / "system/fvSchemes"
        schemes.write_text(schemes.read_text().replace("default none;",
                                                       "default none; div(alphaPhi,salt) Gauss upwind;"))
        control = case.path / "system/controlDict"
        control.write_text(control.read_text() + 'functions { salt { type slurryTracer; libs ("libmillFoam.so"); } }')
        result = self.assert_says(case, "fvSolution", "the tracer salt has no nLimiterIter", "nLimiterIter 10;")
        self.assertNotIn("Time = ", result.log)

    def test_a_misspelt_library_of_a_function_object(self):
        self.assert_object_refused('type scalarTransport; libs ("libsolverFunctionObject.so");',
                                   "type is scalarTransport", "libs")

    def test_a_function_object_that_is_not_enabled_is_accepted(self):
        case = self.small()
        control = case.path / "system/controlDict"
        control.write_text(control.read_text() + "functions { balance { type slurryBallance; enabled no; } }")
        self.assert_runs(case, "slurryFoam")

    def test_a_misspelt_wall_of_the_balance(self):
        for names in ("(left rihgt)", '(left "rihg.*")'):
            self.assert_object_refused(f"type slurryBalance; speed 1; walls {names};", "walls has", "rihg",
                                       "no patch has such a name", "right")

    def test_turbulence_between_balls(self):
        case = self.small()
        case.write("constant/turbulenceProperties", "simulationType RAS; RAS { RASModel kEpsilon; turbulence on; }")
        for name, dimensions in (("k", "0 2 -2 0 0 0 0"), ("epsilon", "0 2 -3 0 0 0 0"), ("nut", "0 2 -1 0 0 0 0")):
            case.field_file(name, "volScalarField", dimensions, 1, '".*" { type zeroGradient; }')
        schemes = case.path / "system/fvSchemes"
        schemes.write_text(schemes.read_text().replace("default none;", "default Gauss upwind;"))
        case.bed(f"block {{ {BLOCK} }}")
        self.assert_says(case, "turbulenceProperties", "kEpsilon", "expected simulationType laminar")

    def test_patches_whose_faces_do_not_match(self):
        case = self.small()
        boundary = case.path / "constant/polyMesh/boundary"
        text = boundary.read_text()
        for here, there in (("left", "right"), ("right", "left")):
            text = re.sub(rf"({here}\s*{{\s*type\s+)\w+;", rf"\1cyclicAMI; neighbourPatch {there}; "
                          "matchTolerance 1e-4; transform noOrdering;", text)
            case.at_patch(here, U="type cyclicAMI;", p_rgh="type cyclicAMI;", alpha="type cyclicAMI;")
        boundary.write_text(text)
        self.assert_says(case, "patch left is a cyclicAMI", "expected cyclic patches")


class Patches(RefusedTest):
    """What enters through patches"""

    FED = "type fixedValue; value uniform 1;"

    def fed(self, velocity, share=FED, top="", **options):
        case = self.small(**options)
        case.at_patch("bottom", U=velocity, alpha=share)
        if top == "open":
            case.open_top()
        return case

    def test_a_feed_into_a_mill_that_is_closed(self):
        for velocity in ("type fixedValue; value uniform (0 0.05 0);",
                         "type superficialInletVelocity; volumetricFlowRate constant 2e-5;"):
            with self.subTest(velocity=velocity):
                result = self.assert_says(self.fed(velocity), "0/U", "(bottom) 2e-05 m3/s more",
                                          "no patch gives a pressure", "prghPressure")
                self.assertNotIn("Time = ", result.log)
                self.assert_runs(self.fed(velocity, top="open"), "slurryFoam")

    def test_one_that_begins_later_stops_the_run(self):
        case = self.fed("type superficialInletVelocity; volumetricFlowRate table ((0 0) (0.01 0) (0.0101 2e-5));",
                        end_time=0.1)
        # A thousandth of 1.6e-5 m3 has come in after 0.8 ms
        result = self.assert_says(case, "time 0.012:", "4e-08 m3 of fluid", "0.25 %", "prghPressure")
        self.assertIn("Time = 0.01\n", result.log)

    def test_what_leaves_as_fast_as_it_enters_is_accepted(self):
        case = self.fed("type fixedValue; value uniform (0 0.05 0);")
        # The second one is not known before the first step
        for velocity in ("type fixedValue; value uniform (0 0.05 0);",
                         "type uniformFixedValue; uniformValue (0 0.05 0);"):
            with self.subTest(velocity=velocity):
                case.at_patch("top", U=velocity)
                self.assert_runs(case, "slurryFoam")

    def test_an_inlet_whose_share_of_slurry_is_none(self):
        velocity = "type fixedValue; value uniform (0 0.05 0);"
        for share in ("type fixedValue; value uniform 2;", "type fixedValue; value uniform -0.1;",
                      "type inletOutlet; inletValue uniform 2; value uniform 0;"):
            with self.subTest(share=share):
                result = self.assert_says(self.fed(velocity, share, top="open"), "0/alpha.slurry",
                                          "at the patch bottom", "is 2" if "2" in share else "is -0.1",
                                          "expected 0 to 1")
                self.assertNotIn("Time = ", result.log)

    def test_an_inlet_whose_share_becomes_none(self):
        share = "type uniformFixedValue; uniformValue table ((0 1) (0.003 1) (0.004 2));"
        case = self.fed("type fixedValue; value uniform (0 0.05 0);", share, top="open", end_time=0.02)
        result = self.assert_says(case, "alpha.slurry at the patch bottom", "is 2 at", "expected 0 to 1")
        self.assertIn("Time = 0.004\n", result.log)


class MeshSpeed(RefusedTest):
    """The speed of the mesh, in constant/dynamicMeshDict, and of the mill, in constant/millProperties"""

    STATIC = "dynamicFvMesh staticFvMesh;"

    def mill(self, motion, omega=-6.4):
        case = self.small(motion=motion)
        case.write("constant/millProperties", f"omega {omega};")
        return case

    def assert_speed_refused(self, case, *words):
        result = self.assert_says(case, "millProperties", *words)
        self.assertNotIn("Time = ", result.log)

    def test_the_speed_of_the_mill_is_accepted(self):
        self.assert_runs(self.mill(rotating_mesh(-6.4)), "slurryFoam")
        self.assert_runs(self.mill(self.STATIC, 0), "slurryFoam")

    def test_another_speed(self):
        for omega in (6.4, -6.1, "constant -6.1"):
            with self.subTest(omega=omega):
                self.assert_speed_refused(self.mill(rotating_mesh(omega)), "omega is -6.4 rad/s", "dynamicMeshDict",
                                          "turns the mesh with", "6.", "omega $omega;")

    def test_another_axis(self):
        case = self.mill(rotating_mesh(-6.4).replace("axis (0 0 1)", "axis (0 0 -1)"))
        self.assert_speed_refused(case, "omega is -6.4 rad/s", "turns the mesh with 6.4 rad/s")

    def test_walls_of_a_mesh_at_rest(self):
        for motion in (self.STATIC, rotating_mesh(0), self.STATIC + rotating_mesh(-6.4).split(";", 1)[1]):
            with self.subTest(motion=motion):
                self.assert_speed_refused(self.mill(motion), "omega is -6.4 rad/s", "mesh does not turn", "left right",
                                          "movingWallVelocity", "rotatingWallVelocity")

    def test_a_mill_without_dynamicMeshDict(self):
        case = self.mill(self.STATIC)
        (case.path / "constant/dynamicMeshDict").unlink()
        self.assert_speed_refused(case, "mesh does not turn", "movingWallVelocity")

    def test_walls_with_a_velocity_of_their_own_are_accepted(self):
        # The second one has more digits than writePrecision
        for omega in ("-6.4", "-1.2345678"):
            with self.subTest(omega=omega):
                case = self.mill(self.STATIC, omega)
                for patch in self.WALLS:
                    case.at_patch(patch, U=f"type rotatingWallVelocity; origin (0 0 0); axis (0 0 1); omega {omega};")
                case.write("system/controlDict", (case.path / "system/controlDict").read_text().replace(
                    "writePrecision", "// writePrecision"))
                self.assert_runs(case, "slurryFoam")

    WALLS = ("left", "right", "bottom", "top", "back", "front")

    def with_walls(self, motion, some, velocity, others="type noSlip;"):
        """Some of the walls have one condition of U, the others another."""
        case = self.mill(motion)
        for patch in self.WALLS:
            case.at_patch(patch, U=velocity if patch in some else others)
        return case

    def test_walls_that_turn_another_way(self):
        wall = "type rotatingWallVelocity; origin (0 0 0); axis {}; omega {};"
        for axis, omega in (("(0 0 1)", 6.4), ("(0 0 -1)", -6.4), ("(0 0 1)", -6.3), ("(0 1 0)", -6.4)):
            with self.subTest(axis=axis, omega=omega):
                case = self.with_walls(self.STATIC, self.WALLS[:1], wall.format(axis, omega))
                self.assert_speed_refused(case, "omega is -6.4 rad/s", "the wall left", "rotatingWallVelocity",
                                          "'omega -6.4;'")
        for axis, omega in (("(0 0 -2)", 6.4), ("(0 0 1)", 0)):
            case = self.with_walls(rotating_mesh(-6.4), self.WALLS[:1], wall.format(axis, omega))
            self.assert_runs(case, "slurryFoam")

    def test_a_mill_that_turns_while_all_its_walls_rest(self):
        for velocity in ("type noSlip;", "type fixedValue; value uniform (0 0 0);",
                         "type rotatingWallVelocity; origin (0 0 0); axis (0 0 1); omega 0;"):
            with self.subTest(velocity=velocity):
                case = self.with_walls(self.STATIC, self.WALLS[:2], velocity)
                self.assert_speed_refused(case, "omega is -6.4 rad/s", "neither the mesh turns nor any wall",
                                          "left right", "omega 0 of a mill at rest")

    def test_a_shell_that_rests_around_what_turns_is_accepted(self):
        turning = "type rotatingWallVelocity; origin (0 0 0); axis (0 0 1); omega -6.4;"
        self.assert_runs(self.with_walls(self.STATIC, self.WALLS[:1], turning), "slurryFoam")
        # And on the impeller's mesh
        moving = "type movingWallVelocity; value uniform (0 0 0);"
        case = self.with_walls(rotating_mesh(-6.4), self.WALLS[:1], moving, "type restingWallVelocity;")
        self.assert_runs(case, "slurryFoam")

    def test_an_axis_beside_that_of_an_upright_mill(self):
        for origin, accepted in (("(0.1 0 0)", False), ("(0 0 0.1)", True)):
            case = self.small(motion=rotating_mesh(-6.4).replace("origin (0 0 0)", f"origin {origin}"))
            case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);")
            if accepted:
                self.assert_runs(case, "slurryFoam")
            else:
                self.assert_says(case, "dynamicMeshDict", "origin is (0.1 0 0) m", "the z axis")

    def test_a_speed_that_is_a_function_of_time_is_accepted(self):
        self.assert_runs(self.mill(rotating_mesh("table ((0 0) (1 -6.4))")), "slurryFoam")


class Record(RefusedTest):
    """solids.h5, as bedProperties names it"""

    def record(self, change=None, upper=(0.04, 0.04, 0.01), entries="", attributes=None, **options):
        case = self.small(**options)
        solids.write(case.path / "solids.h5", (0, 0, 0), upper, solids.uniform(0.1, 0.2, shape=(2, 2, 2)),
                     **(attributes or {}))
        if change:
            with h5py.File(case.path / "solids.h5", "r+") as file:
                change(file)
        case.bed(f'solids "solids.h5"; interpolation linear; {entries}')
        return case

    def test_what_the_others_are_made_from_is_accepted(self):
        self.assert_runs(self.record(), "slurryFoam")

    def test_solids_that_jump_with_a_rate_of_the_voidage(self):
        self.assert_says(self.record(entries="inTime window;"), "inTime is window", "voidageRate no")
        self.assert_runs(self.record(entries="inTime window; voidageRate no;"), "slurryFoam")

    def test_missing(self):
        case = self.record()
        (case.path / "solids.h5").unlink()
        self.assert_says(case, "bedProperties", "solids.h5", "no such file")

    def test_still_being_written(self):
        self.assert_says(self.record(lambda file: file.attrs.modify("complete", 0)), "solids.h5", "not complete")

    def test_not_a_number(self):
        def spoil(file):
            file["velocity"][0, 1, 0, 1, 2] = np.nan
        self.assert_says(self.record(spoil), "solids.h5", "velocity is nan", "voxel (1 0 1)", "window 0")

    def test_a_gap_between_windows(self):
        def spoil(file):
            file["window/begin"][1] += 0.003
        self.assert_says(self.record(spoil), "bedProperties", "no solids between DEM times 0.01", "0.013")

    def test_cells_beyond_the_grid_are_counted_and_named(self):
        case = self.record(upper=(0.03, 0.04, 0.01))
        self.assert_says(case, "bedProperties", "4 of 16 cells lie outside", "cell 3 at (0.03", "uncovered warn")

    def test_a_flow_that_outlasts_it_is_refused_before_the_first_step(self):
        result = self.assert_says(self.record(end_time=0.03), "solids.h5", "records DEM times 0 to 0.02", "endTime",
                                  "outOfRange")
        self.assertNotIn("Time = ", result.log)

    def test_another_speed_of_the_mill(self):
        case = self.record(entries="omega -6.4;", attributes={"angular_velocity": -6.1})
        self.assert_says(case, "bedProperties", "omega is -6.4 rad/s", "solids.h5", "-6.1 rad/s", "millAverage again")

    def test_the_other_sense_of_rotation(self):
        case = self.record(entries="omega 6.4;", attributes={"angular_velocity": -6.4})
        self.assert_says(case, "omega is 6.4 rad/s", "-6.4 rad/s")

    def test_another_mill(self):
        case = self.record(entries='fingerprint "0123456789abcdef";', attributes={"mill_averages": "fedcba9876543210"})
        self.assert_says(case, "bedProperties", "0123456789abcdef", "solids.h5", "fedcba9876543210",
                         "Run millAverage again")

    def test_the_same_mill_and_speed_are_accepted(self):
        self.assert_runs(self.record(entries='omega -6.4; fingerprint "0123456789abcdef";', attributes={
            "angular_velocity": -6.4 * (1 + 1e-8), "mill_averages": "0123456789abcdef"}), "slurryFoam")

    def test_solids_that_do_not_know_their_mill_are_accepted(self):
        self.assert_runs(self.record(entries='omega -6.4; fingerprint "0123456789abcdef";'), "slurryFoam")


class Slurry(RefusedTest):
    def with_share(self, value):
        """A case with this share of slurry in its cell 5."""
        case = self.small()
        share = case.path / "0/alpha.slurry"
        share.write_text(share.read_text().replace("(1 1 1 1 1 1 ", f"(1 1 1 1 1 {value} "))
        self.assertIn(f" {value} ", share.read_text())
        return case

    def test_a_share_at_the_start_that_is_none(self):
        for value in (1.5, -0.5, 1.01, -0.01):
            with self.subTest(value=value):
                self.assert_says(self.with_share(value), "0/alpha.slurry",
                                 f"alpha.slurry is {value} in cell 5 at (0.015 0.015 0.005) m; expected 0 to 1")

    def test_a_share_that_is_0_or_1_to_round_off_is_accepted(self):
        for value in (1.0001, -0.0001):
            self.assert_runs(self.with_share(value), "slurryFoam")

    def assert_bingham_refused(self, pattern, new, *words):
        self.assert_says(self.small(bingham=re.sub(pattern, new, BINGHAM)), "transportProperties", *words)

    def test_a_negative_yield_stress(self):
        self.assert_bingham_refused("yieldStress 0.16", "yieldStress -0.16", "yieldStress is -0.16", "not below zero")

    def test_no_plastic_viscosity(self):
        self.assert_bingham_refused("plasticViscosity 1.4e-3", "plasticViscosity 0", "plasticViscosity is 0", "above")

    def test_a_largest_viscosity_below_the_plastic_one(self):
        self.assert_bingham_refused("viscosityRatio 1000", "viscosityRatio 0.5", "viscosityRatio is 0.5", "1 or more")

    def test_a_negative_entry_of_another_model_is_named_as_it_was_written(self):
        case = self.small()
        case.bed(f"block {{ {BLOCK} }}", drag="law Beetstra; viscosity pore;")
        properties = case.path / "constant/transportProperties"
        properties.write_text(re.sub(r"transportModel Bingham; (.*?) BinghamCoeffs \{.*?\}",
                                     r"transportModel HerschelBulkley; \1 HerschelBulkleyCoeffs { tau0 -1e-4; k 1e-5; "
                                     r"n 1; nu0 1e-3; }", properties.read_text()))
        self.assert_says(case, "transportProperties", "tau0 is -0.0001", "not below zero")

    def test_a_negative_surface_tension(self):
        case = self.small()
        properties = case.path / "constant/transportProperties"
        properties.write_text(properties.read_text().replace("sigma 0", "sigma -0.07"))
        self.assert_says(case, "transportProperties", "sigma is -0.07")


class Surface(RefusedTest):
    """The sub-dictionary slurrySurface of system/fvSolution"""

    def assert_surface_refused(self, entries, *words):
        case = self.small()
        case.write("system/fvSolution", SOLUTION.format(non_orthogonal=0, surface=entries, pimple=""))
        self.assert_says(case, "fvSolution", *words)

    def test_angles_in_the_wrong_order(self):
        self.assert_surface_refused("levelAngle (30 15);", "levelAngle is", "30", "15", "smaller first")

    def test_one_angle(self):
        self.assert_surface_refused("levelAngle 15;", "levelAngle")

    def test_a_negative_number_of_fits(self):
        self.assert_surface_refused("fits -1;", "fits is -1")

    def test_a_misspelt_entry(self):
        self.assert_surface_refused("levelAngles (15 30);", "levelAngles", "levelAngle")

    def assert_angle_refused(self, condition, *words):
        case = self.small()
        case.at_patch("left", alpha=condition)
        self.assert_says(case, "alpha.slurry at the patch left", *words)

    def test_a_contact_angle_beyond_a_half_turn(self):
        self.assert_angle_refused("type constantAlphaContactAngle; theta0 270; limit gradient;",
                                  "is 270", "above 0 and below 180")

    def test_a_contact_angle_that_changes(self):
        self.assert_angle_refused(
            "type dynamicAlphaContactAngle; uTheta 1; theta0 90; thetaA 110; thetaR 70; limit gradient;",
            "dynamicAlphaContactAngle", "expected constantAlphaContactAngle")


class Suction(RefusedTest):
    """The sub-dictionary poreSuction of constant/bedProperties"""

    def assert_suction_refused(self, entries, *words, sigma=0.07):
        case = self.small()
        properties = case.path / "constant/transportProperties"
        properties.write_text(properties.read_text().replace("sigma 0", f"sigma {sigma}"))
        case.bed(f"block {{ {BLOCK} }}", entries=f"poreSuction {{ {entries} }}")
        self.assert_says(case, *words)

    def test_without_a_surface_tension(self):
        self.assert_suction_refused("contactAngle 30;", "sigma of transportProperties is 0", "above 0", sigma=0)

    def test_balls_that_move_at_the_same_time(self):
        self.assert_suction_refused('contactAngle 30; } exchange "exchange"; outOfRange hold; other {',
                                    "poreSuction is there with exchange")

    def test_an_angle_that_is_none(self):
        self.assert_suction_refused("contactAngle -30;", "contactAngle is -30", "0 to 180")

    def test_a_misspelt_angle(self):
        self.assert_suction_refused("theta0 30;", "theta0", "contactAngle")


class Start(RefusedTest):
    """system/slurryStartDict"""

    def assert_start_refused(self, entries, *words, bed=False):
        case = self.small()
        if bed:
            case.bed(f"block {{ {BLOCK} }}")
        case.write("system/slurryStartDict", entries)
        self.assert_says(case, *words, program="slurryStart")

    def test_an_unknown_kind_lists_the_known_ones(self):
        self.assert_start_refused("start puddle; level 0.02;", "slurryStartDict", "puddle", "pool", "above", "feed")

    def test_both_level_and_volume(self):
        self.assert_start_refused("start pool; level 0.02; volume 1e-5;", "slurryStartDict", "'level'", "'volume'")

    def test_neither_level_nor_volume(self):
        self.assert_start_refused("start pool;", "slurryStartDict", "'level'", "'volume'")

    def test_a_level_beyond_the_mesh(self):
        self.assert_start_refused("start pool; level 0.05;", "slurryStartDict", "level is 0.05", "0.04")

    def test_more_than_there_is_room_for_between_the_balls(self):
        # 1.6e-5 m3 of which balls take half
        self.assert_start_refused("start pool; volume 9e-6;", "slurryStartDict", "volume is 9", "e-06", "room",
                                  bed=True)

    def test_no_room_above_the_balls(self):
        self.assert_start_refused("start above; volume 1e-6;", "slurryStartDict", "volume is", "room", bed=True)

    def test_above_no_balls(self):
        self.assert_start_refused("start above; volume 1e-6;", "slurryStartDict", "bedShare is 0.05", "the largest, 0")

    def test_a_share_of_balls_in_per_cent(self):
        self.assert_start_refused("start above; volume 1e-6; bedShare 5;", "slurryStartDict", "bedShare is 5",
                                  "the largest, 0.5", bed=True)

    def test_above_without_a_volume(self):
        self.assert_start_refused("start above; level 0.02;", "slurryStartDict", "volume")

    def test_an_entry_that_the_start_does_not_use(self):
        self.assert_start_refused("start feed; volume 1e-5;", "slurryStartDict", "start is feed", "no volume")
        self.assert_start_refused("start feed; level 0.02;", "slurryStartDict", "start is feed", "no level")
        self.assert_start_refused("start above; volume 1e-6; level 0.02;", "slurryStartDict", "start is above",
                                  "no level", bed=True)

    def test_without_gravity(self):
        case = self.small()
        case.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);")
        case.write("system/slurryStartDict", "start pool; level 0.02;")
        self.assert_says(case, "constant/g", "gravity", program="slurryStart")

    def begun(self, *times):
        case = self.small()
        case.write("system/slurryStartDict", "start pool; level 0.01;")
        for name in times:
            shutil.copytree(case.path / "0", case.path / name)
        return case

    def test_a_case_in_which_a_flow_has_begun_keeps_its_slurry(self):
        for start in ("startTime", "latestTime"):
            case = self.begun("0.001", "0.002")
            control = case.path / "system/controlDict"
            control.write_text(control.read_text().replace("startFrom startTime", f"startFrom {start}"))
            before = {name: (case.path / name / "alpha.slurry").read_text() for name in ("0", "0.002")}
            self.assert_says(case, "a flow has begun", "2 written times", "0.001", "0.002 s", "Allclean",
                             program="slurryStart")
            for name, text in before.items():
                self.assertEqual((case.path / name / "alpha.slurry").read_text(), text)

    def test_so_does_one_that_has_begun_on_several_ranks(self):
        for folder in ("processor0", "processors2"):
            case = self.begun(f"{folder}/0", f"{folder}/0.002")
            self.assert_says(case, "a flow has begun", "0.002", program="slurryStart")

    def test_the_first_time_alone_is_set(self):
        case = self.begun("processor0/0")
        self.assert_runs(case, "slurryStart")
        self.assertAlmostEqual(case.field("alpha.slurry", 0).mean(), 0.25, delta=1e-9)


class Grates(RefusedTest):
    """constant/grateProperties"""

    def assert_grate_refused(self, entries, *words):
        case = self.small()
        case.write("constant/grateProperties", f"discharge {{ {entries} }}")
        self.assert_says(case, "grateProperties", "discharge", *words)

    def test_a_zone_that_the_mesh_has_not(self):
        self.assert_grate_refused("cellZone grate; darcy 1e7;", "no cellZone grate", "topoSet")

    def test_no_zone(self):
        self.assert_grate_refused("darcy 1e7;", "cellZone")

    def test_a_misspelt_entry(self):
        self.assert_grate_refused("cellZone grate; darci 1e7;", "darci", "darcy")

    def test_a_plate_of_faces_that_the_mesh_has_not(self):
        self.assert_grate_refused("faces lattice; loss 18;", "no faceZone or patch lattice", "bottom")

    def test_a_plate_without_its_faces(self):
        self.assert_grate_refused("loss 18;", "faces")

    def test_a_plate_on_a_cyclic_patch(self):
        case = self.slurry_case(periodic=True)
        case.write("constant/grateProperties", "discharge { faces left; loss 18; }")
        self.assert_says(case, "grateProperties", "discharge", "faces are on left", "cyclic")

    def test_a_plate_on_a_cyclic_patch_that_is_divided_over_ranks(self):
        case = self.slurry_case(periodic=True)
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        case.write("constant/grateProperties", "discharge { faces left; loss 18; }")
        self.assert_refused(case, "faces are on left", "cyclic", program="slurryFoam", ranks=2)

    def test_a_zone_of_faces_of_such_a_patch(self):
        case = self.slurry_case(periodic=True)
        case.write("system/topoSetDict", """
            actions ( { name found; type faceSet; action new; source patchToFace; patch left; }
                      { name plate; type faceZoneSet; action new; source setToFaceZone; faceSet found; } );""")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties", "discharge { faces plate; loss 18; }")
        case.decompose_into(2, 1, 1)
        self.assert_runs(case, "decomposePar")
        self.assert_refused(case, "faces are on left", "cyclic", program="slurryFoam", ranks=2)

    def assert_empty_zone_refused(self, kind, actions, entries):
        case = self.small()
        # Boxes in mm
        case.write("system/topoSetDict", f"actions ( {actions} );")
        self.assert_runs(case, "topoSet")
        case.write("constant/grateProperties", f"discharge {{ {entries} }}")
        self.assert_says(case, "grateProperties", f"grate has no {kind}", "topoSet, in m")

    def test_a_zone_without_cells(self):
        zone = "{ name grate; type cellZoneSet; action new; source boxToCell; box (20 -9 -9) (30 9 9); }"
        self.assert_empty_zone_refused("cells", zone, "cellZone grate; darcy 1e7;")

    def test_a_zone_without_faces(self):
        zone = """
            { name found; type faceSet; action new; source boxToFace; box (20 -9 -9) (30 9 9); }
            { name grate; type faceZoneSet; action new; source setToFaceZone; faceSet found; }"""
        self.assert_empty_zone_refused("faces", zone, "faces grate; loss 18;")

    def test_a_plate_outside_of_a_grate(self):
        case = self.small()
        case.write("constant/grateProperties", "faces bottom; loss 18;")
        self.assert_says(case, "grateProperties", "faces", "braces")

    def test_a_plate_without_its_loss(self):
        self.assert_grate_refused("faces bottom;", "loss")

    def test_a_plate_with_a_negative_loss(self):
        self.assert_grate_refused("faces bottom; loss -1;", "loss is -1", "0 or above")

    def test_an_entry_outside_of_a_grate(self):
        case = self.small()
        case.write("constant/grateProperties", "thickness 0.01; darcy 1e7;")
        self.assert_says(case, "grateProperties", "darcy", "braces")


if __name__ == "__main__":
    require_environment()
    unittest.main()
