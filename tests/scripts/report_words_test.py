#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and texts of the report are typeset as one writes them, with as many digits as their errors allow, and
escaped."""
import unittest

from millfoam.readings.means import Mean
from millfoam.report import page
from millfoam.report.sections import last_turn
from millfoam.report.words import Name, decimals, millilitres, quantity, reach_words, span_of_time, typeset, uncertain


class Words(unittest.TestCase):
    def test_minus_signs_and_powers_of_ten_are_typeset_but_not_names(self):
        self.assertEqual(typeset("-1.5 mm (-3 to -2), 1.2e-06 of runs_9-2, 2026-01-02, --begin"),
                         "−1.5 mm (−3 to −2), 1.2·10⁻⁶ of runs_9-2, 2026-01-02, --begin")
        self.assertEqual(typeset("-0.0 ml/s, +0 mm, -0.02, +0.5, -0.0·10"), "0.0 ml/s, 0 mm, −0.02, +0.5, −0.0·10")

    def test_names_are_escaped_and_otherwise_as_they_are(self):
        for name in ("runs/dt_1e-05", "flow.max_time_step=1e-05", "1e-05", "a^3/-5", "m^3"):
            self.assertEqual(page.text(Name(name)), name)
            self.assertIn(f"<td>{name}</td>", page.table(None, [(Name(name), "1e-05")]))
            self.assertIn(f"<h3>{name}</h3>", page.table(None, [], title=Name(name)))
        self.assertEqual(page.text(Name("<1e-05>")), "&lt;1e-05&gt;")
        self.assertEqual(typeset("of runs/dt_1e-05, 2e-05 s, -1.5e+03"), "of runs/dt_1e-05, 2·10⁻⁵ s, −1.5·10³")

    def test_units_shares_volumes_and_times_are_as_one_writes_them(self):
        self.assertEqual(typeset("0.0232 m^3, 128.7 cm^2, m^35"), "0.0232 m³, 128.7 cm², m^35")
        self.assertEqual([quantity(*one) for one in (("volume_m3", 0.123456), ("plastic_viscosity_Pa_s", 0.01),
                                                     ("cells", 400),
                                                     ("complete", True), ("end_s", None), ("law", "Hill"),
                                                     ("top_width_m", 0.5))],
                         [("volume", "0.1235 m³"), ("plastic viscosity", "0.01 Pa s"), ("cells", "400"),
                          ("complete", "yes"),
                          ("end", "not known"), ("law", "Hill"), ("top width", "0.5 m")])
        self.assertEqual([millilitres(volume) for volume in (1.2345e-2, 1.04e-5, 9.651e-6, 0)],
                         ["12345 ml", "10.4 ml", "9.65 ml", "0 ml"])
        self.assertEqual([span_of_time(seconds) for seconds in (0, 45, 59.9, 90)],
                         ["below 1 s", "45 s", "60 s", "1.5 min"])
        self.assertEqual([last_turn(seconds, 1.0) for seconds in (1.05, 0.48)],
                         ["The last turn", "The last 0.48 of a turn"])

    def test_digits_are_those_that_the_error_allows(self):
        self.assertEqual([decimals(error) for error in (0.0123, 0.03, 0.5, 1.7, 4, 25)], [3, 2, 1, 1, 0, 0])
        self.assertEqual(uncertain(33.193095, 0.029591, "W"), "33.193 ± 0.030 W")
        self.assertEqual(uncertain(-37.42, 1.23, "°"), "-37.4 ± 1.2°")
        self.assertEqual(uncertain(0.0087123, float("nan"), "m/s"), "0.00871 m/s")
        self.assertEqual(uncertain(-1.2e-5, 2e-7, "N m"), "(-1.200 ± 0.020)·10⁻⁵ N m")
        self.assertEqual(uncertain(1234.5, float("nan"), "ml", ".0f"), "1234 ml")
        self.assertEqual(millilitres(1.2345e-3, 4, 1.2e-5), "1234 ± 12 ml")

    def test_an_error_of_few_degrees_of_freedom_has_the_interval_that_follows_from_it(self):
        self.assertEqual(reach_words(Mean(0.75, 0.05, 1), "W"),
                         " (95 % within ± 0.64 W: the error has 1 degree of freedom)")
        # 4.3 errors of 1.2 mm to the other side, 12.7 of 100 ml, 2.4 of 1 degree
        self.assertEqual(reach_words(Mean(-0.03, 0.0012, 2), "mm", -1e3),
                         " (95 % within ± 5.2 mm: the error has 2 degrees of freedom)")
        self.assertIn("± 1271 ml:", reach_words(Mean(5e-3, 1e-4, 1), "ml", 1e6))
        self.assertIn("± 2.4°: the error has 6.8 degrees", reach_words(Mean(30.0, 1.0, 6.8), "°"))
        self.assertIn("± 2.4: the", reach_words(Mean(30.0, 1.0, 6.8), ""))
        for known in (Mean(0.75, 0.05, 8), Mean(0.75, 0.05), Mean(0.75, 0.0, 1), Mean(0.75, 1e-17, 1),
                      Mean(0.75, float("nan"), 0)):
            self.assertEqual(reach_words(known, "W"), "")

    def test_what_is_written_into_a_page_is_escaped(self):
        for made in (page.text("a < b & \"c\""), page.paragraph("a < b & c"),
                     page.table(["<"], [("&", 1.0)], title="<", note="&"), page.folded("<&>", "<script>&")):
            self.assertNotRegex(made, r"&(?!amp;|lt;|gt;|quot;)|<script|<&|< ")


if __name__ == "__main__":
    unittest.main()
