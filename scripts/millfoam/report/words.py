# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as the report's texts show them: minus signs, powers of ten, as many digits as their errors allow."""
import re
from typing import Any

import numpy as np

from ..readings.means import Mean

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

ROUND_OFF = 1e-12  # of a value, an error that is none
SMALLEST = -3  # power of ten below which values with errors have it written
# Degrees of freedom of an error; with fewer, the 95 % interval is wider than 2.3 errors (with many: 2.0), and is shown
FREEDOM = 8.0

# Ends of keys that are units, longer ones first
UNITS = {"_kg_m3": "kg/m³", "_rad_s": "rad/s", "_Pa_s": "Pa s", "_m3_s": "m³/s", "_N_m": "N m", "_m_s": "m/s",
         "_deg": "degrees",
         "_m3": "m³", "_m2": "m²", "_kg": "kg", "_Pa": "Pa", "_m": "m", "_s": "s", "_W": "W", "_J": "J"}


class Name(str):
    """A name, a setting or a path, of which typeset changes nothing."""


def typeset(words: Any) -> str:
    """Text with minus signs before single numbers, none before zero, 1.2e-06 as 1.2·10⁻⁶, and m^3 as m³. Numbers within
    a name (dt_1e-05) stay; those that are a name need Name."""
    if isinstance(words, Name):
        return words
    words = re.sub(r"(?<![\w./])(\d+(?:\.\d+)?)e([+-]\d+)",
                   lambda found: f"{found.group(1)}·10{str(int(found.group(2))).translate(SUPERSCRIPT)}", str(words))
    words = re.sub(r"(?<![\w.\-/])-(?=\d)", "−", words)
    words = re.sub(r"(?<=m)\^([23])(?!\d)", lambda found: "²³"[int(found.group(1)) - 2], words)
    return re.sub(r"[−+](0(?:\.0+)?)(?![\d.·])", r"\1", words)


def decimals(error: float) -> int:
    """Digits after the point of a value with this error: the error has one digit, or two if it begins with 1 or 2."""
    exponent = int(np.floor(np.log10(error)))
    return max(0, -exponent + (1 if round(error / 10.0**exponent, 9) < 3 else 0))


def uncertain(value: float, error: float, unit: str, form: str = ".3g") -> str:
    """A value with its standard error and unit, if it has one; the value in a format if the error is unknown, zero or
    round-off."""
    gap = gap_before(unit)
    if not (np.isfinite(error) and error > ROUND_OFF * abs(value)):
        return f"{value:{form}}{gap}{unit}"
    size = int(np.floor(np.log10(max(abs(value), error))))
    if size < SMALLEST:
        power = str(size).translate(SUPERSCRIPT)
        return f"({uncertain(value / 10.0**size, error / 10.0**size, '')})·10{power}{gap}{unit}"
    digits = decimals(error)
    return f"{value:.{digits}f} ± {error:.{digits}f}{gap}{unit}"


def reach_words(mean: Mean, unit: str, scale: float = 1.0) -> str:
    """How far a mean may be from its value, times `scale`, in a unit, if its error has fewer degrees of freedom than
    FREEDOM; empty otherwise, and for an error that is unknown, zero or round-off."""
    if not (mean.freedom < FREEDOM and mean.error > ROUND_OFF * abs(mean.value)):
        return ""
    reach = abs(scale) * mean.reach
    shown = f"{reach:.2g}" if reach < 99.5 else f"{reach:.0f}"
    freedom = f"{mean.freedom:.2g}"
    return (f" (95 % within ± {shown}{gap_before(unit)}{unit}: the error has {freedom} "
            f"degree{'' if freedom == '1' else 's'} of freedom)")


def gap_before(unit: str) -> str:
    """What stands between a number and its unit."""
    return "" if unit in ("°", "") else " "


def millilitres(volume: float, digits: int = 3, error: float = np.nan) -> str:
    """A volume (m3) in ml with its standard error (m3); if this is unknown, zero or round-off, with `digits` digits,
    and with all digits before the point."""
    value = 1e6 * volume
    return uncertain(value, 1e6 * error, "ml", ".0f" if abs(value) >= 10.0 ** (digits - 1) else f".{digits}g")


def quantity(key: str, value: Any) -> tuple[str, str]:
    """(name, text) of an entry of a JSON result, whose key ends with its unit: volume_m3 = 0.1 as ("volume", "0.1
    m³")."""
    unit = next((end for end in UNITS if key.endswith(end)), "")
    name = key.removesuffix(unit).replace("_", " ")
    if value is None:
        return name, "not known"
    if isinstance(value, bool):
        return name, "yes" if value else "no"
    if isinstance(value, int) or not isinstance(value, float):
        return name, f"{value} {UNITS.get(unit, '')}".strip()
    return name, f"{value:.4g} {UNITS.get(unit, '')}".strip()


def span_of_time(seconds: float) -> str:
    """Seconds below one minute, otherwise minutes. The logs round to whole seconds."""
    if seconds < 1:
        return "below 1 s"
    return f"{seconds:.0f} s" if seconds < 60 else f"{seconds / 60:.1f} min"
