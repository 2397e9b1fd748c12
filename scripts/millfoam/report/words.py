# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as the report's texts show them: minus signs, powers of ten, as many digits as their errors allow."""
import re

import numpy as np

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def typeset(words):
    """Text with minus signs before numbers that stand alone, none before nought, and 1.2e-06 as 1.2·10⁻⁶."""
    words = re.sub(r"(?<=\d)e([+-]\d+)", lambda found: "·10" + str(int(found.group(1))).translate(SUPERSCRIPT), str(words))
    words = re.sub(r"(?<![\w.\-/])-(?=\d)", "−", words)
    return re.sub(r"[−+](0(?:\.0+)?)(?![\d.·])", r"\1", words)


def decimals(error):
    """Digits after the point that a value with this error has: the error keeps one digit, two where it begins with 1 or 2."""
    exponent = int(np.floor(np.log10(error)))
    return max(0, -exponent + (1 if round(error / 10.0**exponent, 9) < 3 else 0))


def uncertain(value, error, unit):
    """A value with its standard error and unit; three digits where the error is not known or nought."""
    gap = "" if unit == "°" else " "
    if not (np.isfinite(error) and error > 0):
        return f"{value:.3g}{gap}{unit}"
    digits = decimals(error)
    return f"{value:.{digits}f} ± {error:.{digits}f}{gap}{unit}"
