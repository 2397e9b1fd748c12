# SPDX-License-Identifier: GPL-3.0-or-later
"""Small cases of slurryFoam: a pool with a bed of balls in a box."""
import copy
import json
import shutil
import tempfile
from pathlib import Path

import numpy as np

from openfoam_case import BoxCase, OpenFoamTest

SLURRY, AIR = 1239.0, 1.2
BINGHAM = ("yieldStress 0.16; plasticViscosity 1.4e-3; regularisation biviscosity; viscosityRatio 1000;")

# All 16 digits: what differs after a restart is then not the file's.
CONTROL = """
    application slurryFoam;
    libs ("libmillFoam.so");
    startFrom startTime; startTime {start_time}; stopAt endTime; endTime {end_time};
    deltaT {delta_t}; {steps}
    writeFormat ascii; writePrecision 17; timePrecision 12; runTimeModifiable no;"""

SOLUTION = """
    solvers
    {{
        "alpha.slurry.*" {{ nLimiterIter 10; extremaCoeff 1; }}
        "p_rgh.*" {{ solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; maxIter 1000; }}
        "(U|k|epsilon|omega).*"
            {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-12; relTol 0; maxIter 1000; }}
        cellDisplacement {{ solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; }}
    }}
    PIMPLE
    {{
        {pimple} nOuterCorrectors 1; nCorrectors 1; nNonOrthogonalCorrectors {non_orthogonal};
    }}
    slurrySurface {{ {surface} }}"""


class SlurryCase(BoxCase):
    """A closed box, gravity along -y, with a pool whose surface is tilted, and no bed yet."""

    def __init__(self, folder, *, upper=(0.14, 0.1, 0.02), cells=(14, 10, 2), delta_t=0.002, end_time=0.02,
                 level=lambda x: 0.045 + 0.2 * (x - 0.07), bingham=BINGHAM, motion="dynamicFvMesh staticFvMesh;",
                 **options):
        self.shape, self.upper = np.array(cells), np.array(upper)
        super().__init__(folder, upper=upper, cells=cells, gravity=(0, -9.81, 0), alpha=self.below(level),
                         delta_t=delta_t, end_time=end_time, write_interval=5,
                         slurry=f"transportModel Bingham; rho {SLURRY}; BinghamCoeffs {{ {bingham} }}", **options)
        self.write("system/fvSolution", SOLUTION.format(non_orthogonal=0, surface="", pimple=""))
        self.write("constant/dynamicMeshDict", motion)

    def below(self, level):
        """Share of each cell below level(x), m, taken at the cell's middle."""
        k, j, i = np.indices(self.shape[::-1]).reshape(3, -1)
        edge = self.upper / self.shape
        return np.clip(level((i + 0.5) * edge[0]) / edge[1] - j, 0, 1)

    def control(self, end_time, delta_t, write_interval=1, start_time=0):
        """Fixed time-step delta_t (s); fields are written every `write_interval` steps."""
        self.write("system/controlDict", CONTROL.format(
            start_time=start_time, end_time=end_time, delta_t=delta_t,
            steps=f"adjustTimeStep no; writeControl timeStep; writeInterval {write_interval};"))

    def adjusted(self, end_time, write_interval, *, start_time=0, delta_t=0.002, courant=0.5, voidage_change=0.05):
        """Time-steps within bounds; fields are written every `write_interval` seconds."""
        self.write("system/controlDict", CONTROL.format(
            start_time=start_time, end_time=end_time, delta_t=delta_t,
            steps=f"""adjustTimeStep yes; maxCo {courant}; maxAlphaCo {courant}; maxVoidageChange {voidage_change};
                maxDeltaT 0.004; writeControl adjustableRunTime; writeInterval {write_interval};"""))

    def bed(self, solids, drag="law Beetstra;", entries=""):
        """bedProperties; solids: the entry of solids or blocks."""
        self.write("constant/bedProperties", f"{solids} drag {{ {drag} }} {entries}")

    def copied(self, folder):
        """The same case in another folder."""
        shutil.copytree(self.path, folder)
        other = copy.copy(self)
        other.path = Path(folder)
        return other

    def steps(self, start="0"):
        """Rows of steps.csv [steps], by columns, of the run that began at the time of this name."""
        path = self.path / "postProcessing" / "flow" / start / "steps.csv"
        # Of a killed run the last line may be cut
        whole = path.read_text().rpartition("\n")[0].split("\n")
        return np.atleast_1d(np.genfromtxt(whole, delimiter=",", names=True))

    def record(self, start="0"):
        """flow.json of the run that began at the time of this name."""
        return json.loads((self.path / "postProcessing" / "flow" / start / "flow.json").read_text())

    def written(self, time):
        """Names of the fields at a time (s)."""
        return sorted(entry.name for entry in self.folder(time).iterdir() if entry.is_file())

    def at_patch(self, patch, **fields):
        """Boundary conditions of fields at a patch; alpha: of the slurry's share."""
        for name, entries in fields.items():
            path = self.path / "0" / {"alpha": "alpha.slurry"}.get(name, name)
            path.write_text(path.read_text().replace("boundaryField {", f"boundaryField {{ {patch} {{ {entries} }}", 1))

    def open_top(self):
        """Air above the top at pressure 0: it comes in, and what there is goes out."""
        self.at_patch("top", U="type pressureInletOutletVelocity; value uniform (0 0 0);",
                      p_rgh="type prghPressure; p uniform 0; value uniform 0;",
                      alpha="type inletOutlet; inletValue uniform 0; value uniform 0;")

    def field_file(self, name, kind, dimensions, value, patches):
        """A further field at time 0; patches: its boundaryField."""
        self.write(f"0/{name}",
                   f"dimensions [{dimensions}]; internalField uniform {value}; boundaryField {{ {patches} }}", kind)


class SlurryTest(OpenFoamTest):
    """A test on small cases of slurryFoam."""

    def slurry_case(self, **options):
        case = SlurryCase(tempfile.mkdtemp(prefix="case", dir=self.folder), **options)
        self.assert_runs(case, "blockMesh")
        return case

    def copy_of(self, case):
        return case.copied(Path(tempfile.mkdtemp(prefix="copy", dir=self.folder)) / "case")

    def assert_kept(self, case, *, slurry=1e-8, alpha=1e-6):
        """Slurry and fluid of every step are the first one's to a share, and alpha is in [0, 1]."""
        found = case.steps()
        self.assertGreater(len(found), 1)
        for column in ("slurry_m3", "fluid_m3"):
            np.testing.assert_allclose(found[column], found[column][0], rtol=slurry, err_msg=column)
        self.assertGreaterEqual(found["alpha_min"].min(), -alpha)
        self.assertLessEqual(found["alpha_max_minus_1"].max(), alpha)
