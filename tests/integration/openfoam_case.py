# SPDX-License-Identifier: GPL-3.0-or-later
"""Small OpenFOAM cases for the tests: a box, its dictionaries, running a program on it, reading its log and fields."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files import foam

DENSITY, VISCOSITY = 1000.0, 1e-3
FLUIDS = f"slurry {{ rho {DENSITY}; mu {VISCOSITY}; }} air {{ rho 1.2; mu 1.8e-5; }}"

NUMERICS = {
    "system/fvSchemes": """
        ddtSchemes { default Euler; }
        gradSchemes { default Gauss linear; }
        divSchemes
        {
            default none;
            div(rhoPhi,U) Gauss linearUpwind grad(U);
            div(phi,alpha) Gauss vanLeer;
            div(phirb,alpha) Gauss linear;
            div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;
        }
        laplacianSchemes { default Gauss linear corrected; }
        interpolationSchemes { default linear; }
        snGradSchemes { default corrected; }""",
    # Tight: what differs between two runs is then the difference that is looked for.
    "system/fvSolution": """
        solvers
        {
            "alpha.slurry.*" { nAlphaCorr 1; nAlphaSubCycles 1; cAlpha 1; }
            "pcorr.*|p_rgh.*" { solver PCG; preconditioner DIC; tolerance 1e-14; relTol 1e-12; maxIter 1000; }
            "U.*" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-14; relTol 1e-12; maxIter 1000; }
        }
        PIMPLE
        {
            momentumPredictor yes;
            nOuterCorrectors 1;
            nCorrectors 3;
            nNonOrthogonalCorrectors 0;
            correctPhi yes;
            pRefCell 0;
            pRefValue 0;
        }""",
}


def rotating_mesh(omega):
    """dynamicMeshDict of a mesh that turns rigidly about the z axis, omega in rad/s."""
    return f"""
        dynamicFvMesh dynamicMotionSolverFvMesh;
        motionSolverLibs ("libfvMotionSolvers.so");
        motionSolver solidBody;
        solidBodyMotionFunction rotatingMotion;
        origin (0 0 0);
        axis (0 0 1);
        omega {omega};"""


class BoxCase:
    """A case in `folder`: a box [lower, upper] (m) of cells (nx, ny, nz) full of slurry at rest, without gravity.

    `periodic` makes all six sides cyclic, otherwise they are walls that move with the mesh. `slurry` is the phase's
    sub-dictionary; `alpha` its share, [cells] or uniform. `write` replaces any file of the case."""

    def __init__(self, folder, lower=(0, 0, 0), upper=(0.04, 0.04, 0.04), cells=(4, 4, 4), *, periodic=False,
                 end_time=0.001, delta_t=0.001, write_interval=1, gravity=(0, 0, 0), alpha=1.0, fv_options="",
                 slurry=f"transportModel Newtonian; nu {VISCOSITY / DENSITY}; rho {DENSITY};"):
        self.path = Path(folder)
        self.cells = int(np.prod(cells))
        self._write_mesh(lower, upper, cells, periodic)
        for name, text in NUMERICS.items():
            self.write(name, text)
        self.control(end_time=end_time, delta_t=delta_t, write_interval=write_interval)
        self.write("constant/g", f"dimensions [0 1 -2 0 0 0 0]; value ({_numbers(gravity)});")
        self.write("constant/turbulenceProperties", "simulationType laminar;")
        self.write("constant/transportProperties", f"""
            phases (slurry air);
            slurry {{ {slurry} }}
            air {{ transportModel Newtonian; nu 1.5e-05; rho 1.2; }}
            sigma 0;""")
        self.write("constant/fvOptions", fv_options)
        self._write_fields(alpha, periodic)

    def write(self, name, text, kind="dictionary"):
        path = self.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {path.name}; }}\n{text}\n")

    def control(self, end_time, delta_t, write_interval=1, start_time=0):
        """Fixed time-step delta_t (s); fields are written every `write_interval` steps."""
        self.write("system/controlDict", f"""
            application millInterFoam;
            libs ("libmillFoam.so");
            startFrom startTime; startTime {start_time}; stopAt endTime; endTime {end_time};
            deltaT {delta_t}; adjustTimeStep no; maxCo 1; maxAlphaCo 1; maxDeltaT 1;
            writeControl timeStep; writeInterval {write_interval};
            writeFormat ascii; writePrecision 15; timePrecision 12; runTimeModifiable no;""")

    def decompose_into(self, x, y, z):
        """decomposeParDict of x by y by z parts."""
        self.write("system/decomposeParDict", f"numberOfSubdomains {x * y * z}; method simple;"
                                              f" simpleCoeffs {{ n ({x} {y} {z}); delta 0.001; }}")

    def drag(self, entries):
        """The fvOption `bed` of type particleDrag, with the fluids and these entries."""
        self.write("constant/fvOptions", f"bed {{ type particleDrag; phase alpha.slurry; {FLUIDS} {entries} }}")

    def run(self, *command, ranks=1):
        """Runs a program on the case; a failure is a result, not an exception."""
        command = [*command, "-case", str(self.path)]
        if ranks > 1:
            # Oversubscribe: a machine with one core must run the tests too.
            command = ["mpirun", "--oversubscribe", "-np", str(ranks), *command, "-parallel"]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              timeout=120)
        return Result(command[0], done.returncode, done.stdout)

    def field(self, name, time):
        """Internal field at a time (s)."""
        return foam.read_field(self.folder(time) / name, self.cells)

    def folder(self, time):
        """Time folder nearest to a time (s)."""
        found, path = min(foam.times(self.path), key=lambda entry: abs(entry[0] - time))
        if abs(found - time) > 1e-9:
            raise foam.FoamError(f"{self.path}: no fields at {time} s, the nearest are at {found} s")
        return path

    def centres(self, time=None):
        """Cell centres [cells, 3], of the moved mesh where a time is given."""
        return foam.read_mesh(self.path, self.folder(time) if time else None).centres_and_volumes()[0]

    def _write_mesh(self, lower, upper, cells, periodic):
        corners = [(x, y, z) for z in (lower[2], upper[2])
                   for x, y in ((lower[0], lower[1]), (upper[0], lower[1]), (upper[0], upper[1]), (lower[0], upper[1]))]
        sides = {"left": "0 4 7 3", "right": "1 2 6 5", "bottom": "0 1 5 4", "top": "3 7 6 2", "back": "0 3 2 1",
                 "front": "4 5 6 7"}
        opposite = dict(zip(sides, ("right", "left", "top", "bottom", "front", "back")))
        patches = "".join(
            f"{name} {{ type {f'cyclic; neighbourPatch {opposite[name]}' if periodic else 'wall'};"
            f" faces (({corner})); }}\n" for name, corner in sides.items())
        self.write("system/blockMeshDict", f"""
            vertices ({' '.join(f'({_numbers(corner)})' for corner in corners)});
            blocks (hex (0 1 2 3 4 5 6 7) ({_numbers(cells)}) simpleGrading (1 1 1));
            boundary ({patches});""")

    def _write_fields(self, alpha, periodic):
        walls = {"U": "type movingWallVelocity; value uniform (0 0 0);", "alpha.slurry": "type zeroGradient;",
                 "p_rgh": "type fixedFluxPressure; value uniform 0;"}
        share = f"uniform {alpha}" if np.ndim(alpha) == 0 else \
            f"nonuniform List<scalar> {len(alpha)} ({_numbers(alpha)})"
        for name, kind, dimensions, value in (("U", "Vector", "0 1 -1", "uniform (0 0 0)"),
                                              ("alpha.slurry", "Scalar", "0 0 0", share),
                                              ("p_rgh", "Scalar", "1 -1 -2", "uniform 0")):
            side = "type cyclic;" if periodic else walls[name]
            self.write(f"0/{name}", f"""dimensions [{dimensions} 0 0 0 0]; internalField {value};
                boundaryField {{ ".*" {{ {side} }} }}""", f"vol{kind}Field")


class Result:
    """How a program ended: exit code and what it said."""

    def __init__(self, program, code, log):
        self.program, self.code, self.log = program, code, log

    def tail(self):
        return "\n".join(self.log.splitlines()[-25:])

    def forces(self):
        """Drag force on the fluid, N, that particleDrag reported in each time-step: [steps, 3]."""
        found = re.findall(r"force on the fluid \(([^)]*)\) N", self.log)
        return np.array([text.split() for text in found], dtype=float)


class OpenFoamTest(unittest.TestCase):
    """A test with a temporary folder `self.folder` that goes when it is over."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="millfoam_test_")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def box(self, **options):
        """A meshed BoxCase in a new folder of the temporary one."""
        case = BoxCase(tempfile.mkdtemp(prefix="case", dir=self.folder), **options)
        self.assert_runs(case, "blockMesh")
        return case

    def assert_runs(self, case, *command, ranks=1):
        result = case.run(*command, ranks=ranks)
        self.assertEqual(result.code, 0, f"{result.program} failed:\n{result.tail()}")
        return result

    def assert_flows(self, case, ranks=1):
        """slurryFoam runs in a case that `decompose_into` has prepared, and its times are put together again."""
        if ranks > 1:
            self.assert_runs(case, "decomposePar")
        self.assert_runs(case, "slurryFoam", ranks=ranks)
        if ranks > 1:
            self.assert_runs(case, "reconstructPar")

    def assert_refused(self, case, *words, program="millInterFoam", options=(), ranks=1):
        """The program fails, and the message of its end holds every one of the words."""
        result = case.run(program, *options, ranks=ranks)
        self.assertNotEqual(result.code, 0, f"{result.program} was expected to refuse:\n{result.tail()}")
        at = result.log.find("FOAM FATAL")
        self.assertGreaterEqual(at, 0, f"no error sentence:\n{result.tail()}")
        for word in words:
            self.assertIn(word, result.log[at:])
        return result


def _numbers(values):
    return " ".join(repr(float(value)) if not float(value).is_integer() else str(int(value)) for value in values)


def require_environment():
    """Says clearly when the tests run outside with_env."""
    if "WM_PROJECT_DIR" not in os.environ:
        raise SystemExit("run this through tests/integration/with_env")
