# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of one row: a CSV file, and lines on the screen."""
from pathlib import Path

import numpy as np

from millfoam.files.data_files import write_csv


def write_numbers(path: Path, numbers: dict[str, float]) -> None:
    """Writes {key: number} as a CSV file with a line of keys and one of numbers, and prints them; a number that is not
    known is NaN, and a dash on the screen."""
    write_csv(path, [numbers])
    for name, value in numbers.items():
        print(f"{name:<28}" + ("–" if np.isnan(value) else f"{value:.5g}"))
