# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact dumps of a dry run that wrote them (`dem.contact_interval`) and the materials of its deck.

Files and columns: dem_driver/README.md."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .dumps import numbered_dumps, read_timestep

# Columns that are used of each table: numbers of those of a compute, or names
PAIR_COLUMNS = {"ball": 1, "other": 2, "force": (4, 5, 6), "torque": (7, 8, 9), "overlap": 10}
WALL_COLUMNS = {"point": (1, 2, 3), "centre": (4, 5, 6), "wall_velocity": (7, 8, 9), "mesh": 13, "ball": 15,
                "force": (16, 17, 18), "torque": (19, 20, 21), "overlap": 22}
BALL_COLUMNS = {"id": "id", "type": "type", "position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"),
                "spin": ("omegax", "omegay", "omegaz"), "radius": "radius"}


@dataclass
class Materials:
    """Properties of the deck's atom types (the last one is the wall): youngs_modulus [n] (Pa), poisson_ratio [n],
    restitution [n, n], friction [n, n]; density of the balls (kg/m^3)."""
    youngs_modulus: np.ndarray
    poisson_ratio: np.ndarray
    restitution: np.ndarray
    friction: np.ndarray
    density: float


def read_materials(deck: Path | str) -> Materials:
    """Materials of a run's deck, DIR/dem/in.mill; RuntimeError names a missing property."""
    text = Path(deck).read_text()
    found: dict[str, Any] = {}
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["fix"] and words[3:4] == ["property/global"]:
            numbers = words[6:] if words[5] == "peratomtype" else words[7:]
            found[words[4]] = np.array(numbers, dtype=float)
        elif "density constant" in line:
            found["density"] = float(words[words.index("density") + 2])
    for name in ("youngsModulus", "poissonsRatio", "coefficientRestitution", "coefficientFriction", "density"):
        if name not in found:
            raise RuntimeError(f"{deck}: no {name}, expected a deck of millDem")
    types = len(found["youngsModulus"])
    return Materials(found["youngsModulus"], found["poissonsRatio"],
                     found["coefficientRestitution"].reshape(types, types),
                     found["coefficientFriction"].reshape(types, types), found["density"])


def read_table(path: Path | str, columns: dict[str, Any]) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """A LIGGGHTS dump as ({key: values [m], or [m, n] for n columns}, the box's periods [3] (m), inf where it has
    walls).

    columns: for each key the number of a compute's column, or a column's name, or a tuple of these. RuntimeError names
    the file, the line and what was expected."""
    lines = Path(path).read_text().splitlines()
    if len(lines) < 9 or not lines[8].startswith("ITEM: ") or not lines[3].isdigit() or len(lines) != 9 + int(lines[3]):
        expected = lines[3] if len(lines) > 3 else "?"
        raise RuntimeError(f"{path}: {len(lines)} lines, expected a dump of {expected} lines and 9 above")
    # The columns of a compute are called c_<its name>[<number>]
    names = [name.split("[")[1].rstrip("]") if "[" in name else name for name in lines[8].split()[2:]]
    table = _numbers(path, lines[9:], len(names))
    chosen = {}
    for key, wanted in columns.items():
        for name in np.atleast_1d(wanted).astype(str):
            if name not in names:
                raise RuntimeError(f"{path}:9: columns {' '.join(names)}, expected {name} among them")
        index = [names.index(name) for name in np.atleast_1d(wanted).astype(str)]
        chosen[key] = table[:, index] if isinstance(wanted, tuple) else table[:, index[0]]
    box = np.array([line.split() for line in lines[5:8]], dtype=float)
    periodic = np.array([kind == "pp" for kind in lines[4].split()[3:6]])
    return chosen, np.where(periodic, box[:, 1] - box[:, 0], np.inf)


def _numbers(path: Path | str, lines: list[str], columns: int) -> np.ndarray:
    for number, line in enumerate(lines, 10):
        if line.count(" ") + 1 < columns or len(line.split()) != columns:
            raise RuntimeError(f"{path}:{number}: '{line}', expected {columns} numbers")
    try:
        return np.array(" ".join(lines).split(), dtype=float).reshape(len(lines), columns)
    except ValueError as error:
        raise RuntimeError(f"{path}: {error}, expected numbers only") from error


def contact_steps(folder: Path | str) -> list[int]:
    """Steps of the contact dumps of a case DIR; RuntimeError if there are none."""
    return [step for step, _ in numbered_dumps(Path(folder) / "contacts", "pairs")]


def contact_interval(folder: Path | str) -> float:
    """Time between two contact dumps of a case DIR, s."""
    steps = contact_steps(folder)
    if len(steps) < 2 or len(set(np.diff(steps))) != 1:
        raise RuntimeError(f"{folder}/contacts: {len(steps)} dumps, expected 2 or more at equal intervals")
    return (steps[1] - steps[0]) * read_timestep(Path(folder) / "dumps")
