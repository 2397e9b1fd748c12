# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as the report's texts show them: minus signs, powers of ten, as many digits as their errors allow."""
import re

import numpy as np

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def typeset(words):
    """Text with minus signs before numbers that stand alone, none before nought, 1.2e-06 as 1.2·10⁻⁶, and m^3 as m³."""
    words = re.sub(r"(?<=\d)e([+-]\d+)", lambda found: "·10" + str(int(found.group(1))).translate(SUPERSCRIPT), str(words))
    words = re.sub(r"(?<![\w.\-/])-(?=\d)", "−", words)
    words = re.sub(r"(?<=m)\^([23])(?!\d)", lambda found: "²³"[int(found.group(1)) - 2], words)
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


def millilitres(volume, digits=3):
    """A volume (m3) in ml with so many digits, and with all before the point."""
    value = 1e6 * volume
    return f"{value:.0f} ml" if abs(value) >= 10.0 ** (digits - 1) else f"{value:.{digits}g} ml"


def short_shares(words):
    """Text in which shares in per cent have three digits at most: 51.676534 % as 51.7 %."""
    return re.sub(r"\d+\.\d+(?:e[+-]?\d+)?(?= %)", lambda found: f"{float(found.group(0)):.3g}", words)


def span_of_time(seconds):
    """Seconds below a minute, else minutes; logs round to whole seconds."""
    if seconds < 1:
        return "below 1 s"
    return f"{seconds:.0f} s" if seconds < 60 else f"{seconds / 60:.1f} min"
