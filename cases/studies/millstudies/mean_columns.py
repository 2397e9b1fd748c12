# SPDX-License-Identifier: GPL-3.0-or-later
"""Means with their errors in the tables of studies: two or three columns of a CSV file, one of a printed table."""
from typing import Any

import numpy as np

from millfoam.readings.means import Mean

Row = dict[str, Any]


def mean_columns(column: str, mean: Mean, scale: float = 1.0) -> Row:
    """Two columns of a row, `NAME, UNIT` and `NAME, UNIT ±`: a mean and its error, both times `scale`."""
    return {column: scale * mean.value, f"{column} ±": scale * mean.error}


def value_text(value: float, error: float, digits: int = 2, sign: str = "") -> str:
    """`1.20 ± 0.10`, both with this number of digits after the point; sign `+`: the value always has one."""
    return f"{value:{sign}.{digits}f} ± {error:.{digits}f}"


def mean_text(row: Row, column: str, digits: int = 2) -> str:
    """The text of a row's two mean_columns; a dash for a number that is not there or not known."""
    if row.get(column) is None or row[column] != row[column]:
        return "–"
    return value_text(row[column], row[f"{column} ±"], digits)


def freedom_columns(column: str, mean: Mean, scale: float = 1.0) -> Row:
    """mean_columns, and `NAME, UNIT, freedom`: the error's degrees of freedom, infinite where it is exact."""
    return mean_columns(column, mean, scale) | {f"{column}, freedom": mean.freedom}


def mean_of(row: Row, column: str) -> Mean:
    """The mean of a row's three freedom_columns."""
    return Mean(*(row[f"{column}{end}"] for end in ("", " ±", ", freedom")))


def freedom_text(row: Row, column: str, digits: int = 2) -> str:
    """mean_text, with the error's degrees of freedom in brackets where it is not exact: `1.20 ± 0.10 (4)`."""
    words, freedom = mean_text(row, column, digits), row.get(f"{column}, freedom", np.inf)
    return words if np.isinf(freedom) or np.isnan(row.get(f"{column} ±", np.nan)) else f"{words} ({freedom:.0f})"
