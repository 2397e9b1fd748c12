#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Bingham viscosity at rest, and the entries that it refuses. Its flow: cases/verification/bingham_poiseuille."""
import re
import unittest

import numpy as np

from openfoam_case import OpenFoamTest, require_environment

ENTRIES = "yieldStress 0.16; plasticViscosity 0.0014; viscosityRatio 1000; m 50;"
DENSITY = 1239


class Bingham(OpenFoamTest):
    def slurry_box(self, entries):
        return self.box(cells=(2, 1, 1),
                        slurry=f"transportModel Bingham; rho {DENSITY}; BinghamCoeffs {{ {entries} }}")

    def assert_entry_refused(self, old, new, *words):
        self.assert_refused(self.slurry_box(ENTRIES.replace(old, new)), *words)

    def viscosity_at_rest(self, regularisation):
        """Dynamic viscosity, Pa s, that the solver writes for the slurry at rest."""
        case = self.slurry_box(f"{ENTRIES} regularisation {regularisation};")
        self.assert_runs(case, "millInterFoam")
        written = [path for path in case.folder(0.001).iterdir() if re.fullmatch(r"nu1?|nu\.?slurry", path.name)]
        self.assertEqual(len(written), 1, list(case.folder(0.001).iterdir()))
        return case.field(written[0].name, 0.001) * DENSITY

    def test_biviscosity_at_rest_is_the_cap(self):
        np.testing.assert_allclose(self.viscosity_at_rest("biviscosity"), 1.4, rtol=1e-12)

    def test_papanastasiou_at_rest_is_plastic_viscosity_plus_yield_stress_times_m(self):
        np.testing.assert_allclose(self.viscosity_at_rest("Papanastasiou"), 0.0014 + 0.16 * 50, rtol=1e-6)

    def test_a_negative_yield_stress_is_refused(self):
        self.assert_entry_refused("yieldStress 0.16", "yieldStress -0.16", "yieldStress is -0.16")

    def test_a_plastic_viscosity_of_zero_is_refused(self):
        self.assert_entry_refused("plasticViscosity 0.0014", "plasticViscosity 0", "plasticViscosity is 0")

    def test_a_missing_yield_stress_is_refused(self):
        self.assert_entry_refused("yieldStress 0.16;", "", "yieldStress")

    def test_a_misspelt_entry_is_refused(self):
        self.assert_entry_refused("m 50;", "m 50; regularization Papanastasiou;", "transportProperties",
                                  "unknown entry 'regularization'", "regularisation")

    def test_a_misspelt_entry_of_the_phase_is_refused(self):
        entries = f"transportModel Bingham; rho {DENSITY}; {ENTRIES}"
        self.assert_refused(self.box(cells=(2, 1, 1), slurry=f"{entries} regularization Papanastasiou;"),
                            "'regularization'", "'regularisation'")
        # Other entries of the phase are not those of the model
        self.assert_runs(self.box(cells=(2, 1, 1), slurry=f"{entries} nu 1e-6; mu 1e-3;"), "millInterFoam")

    def test_an_unknown_regularisation_lists_the_known_ones(self):
        self.assert_entry_refused("m 50;", "m 50; regularisation Bercovier;", "Bercovier", "biviscosity",
                                  "Papanastasiou")


if __name__ == "__main__":
    require_environment()
    unittest.main()
