# SPDX-License-Identifier: GPL-3.0-or-later
"""The stages' files of numbers: JSON with a format's name, and CSV with a unit in each column's name."""
import csv
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np


class DataError(RuntimeError):
    """A file of numbers that cannot be read; the message names the file, the line or key, and what was expected."""


def read_text(path: Path | str) -> str:
    """Text of a file in UTF-8; DataError if it is missing or has another encoding."""
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise DataError(f"{path}: not UTF-8 text (byte {error.start}); expected UTF-8") from None
    except OSError as error:
        raise DataError(f"{path}: {error.strerror or error}") from None


def read_json(path: Path | str, kind: str) -> dict[str, Any]:
    """Content of a JSON file of the format millfoam-`kind`; DataError names what is wrong with it."""
    try:
        content = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        where = f"{path}: line {error.lineno}, column {error.colno}"
        raise DataError(f"{where}: not JSON: {error.msg}; is it cut short?") from None
    except RecursionError:
        raise DataError(f"{path}: not JSON: too many brackets") from None
    found = content.get("format") if isinstance(content, dict) else None
    if found != f"millfoam-{kind}":
        raise DataError(f"{path}: format {found!r}; expected 'millfoam-{kind}'")
    return content


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Writes a JSON file, under another name until it is whole."""
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(content, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    part.replace(path)


def write_csv(path: Path, rows: Sequence[Mapping[str, object]], digits: int | None = None) -> None:
    """Writes rows, column -> text or number, as a CSV file, under another name until it is whole. It has the columns of
    all rows, in the order in which they first appear; None, or a column that a row does not have, is an empty place.
    digits: significant digits of floats, by default all of them."""
    def text(value: object) -> object:
        return f"{value:.{digits}g}" if digits and isinstance(value, float) else value
    part = path.with_name(path.name + ".part")
    with open(part, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(dict.fromkeys(name for row in rows for name in row)), lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: text(value) for name, value in row.items()} for row in rows)
    part.replace(path)


def entry(content: Any, path: Path | str, *keys: str) -> Any:
    """content[key][key]…; DataError names `path` and the first key that is missing."""
    for depth, key in enumerate(keys):
        if not isinstance(content, dict) or key not in content:
            raise DataError(f"{path}: no {'.'.join(keys[:depth + 1])}")
        content = content[key]
    return content


def number(content: Any, path: Path | str, *keys: str) -> float:
    """The number content[key]…, NaN for null; DataError names `path` and the key if there is no number."""
    value = entry(content, path, *keys)
    if value is None:
        return math.nan
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise DataError(f"{path}: {'.'.join(keys)} = {value!r}; expected a number")
    return value


def read_csv(path: Path | str) -> dict[str, np.ndarray]:
    """Columns of a CSV file, name -> values [rows]. A last line without a line end, from a killed program, is left
    out. DataError names a line that is not a row of numbers."""
    lines = read_text(path).split("\n")[:-1]
    if not lines:
        raise DataError(f"{path}: no complete line; expected the columns' names")
    names, rows = [name.strip() for name in lines[0].split(",")], []
    for count, line in enumerate(lines[1:], start=2):
        try:
            rows.append([float(word) for word in line.split(",")])
        except ValueError as error:
            raise DataError(f"{path}: line {count}: {error}") from None
        if len(rows[-1]) != len(names):
            raise DataError(f"{path}: line {count} has {len(rows[-1])} numbers; expected {len(names)}")
    return dict(zip(names, np.array(rows, dtype=float).reshape(-1, len(names)).T))
