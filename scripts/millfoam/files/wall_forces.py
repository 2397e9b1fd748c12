# SPDX-License-Identifier: GPL-3.0-or-later
"""The forces and the work on the wall cells of a dry run, `dumps/wall_forces.vtp`. Fields: FORMATS.md."""
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class WallForces:
    """corners [cells, 3, 3] (m) of the wall cells, in the frame of the wall files; fields: {name: [cells] or [cells,
    3]}; parts: names, to which the field `part` points; begin, end: DEM times (s) between which the means are taken."""
    corners: np.ndarray
    fields: dict[str, np.ndarray]
    parts: list[str]
    begin: float
    end: float

    def areas(self) -> np.ndarray:
        """Areas [cells], m2."""
        first, second = self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        return np.asarray(np.linalg.norm(np.cross(first, second), axis=1) / 2)

    def normals(self) -> np.ndarray:
        """Unit normals [cells, 3]; their sign is that of the wall file."""
        first, second = self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        normals = np.cross(first, second)
        return np.asarray(normals / np.linalg.norm(normals, axis=1)[:, None])


def read_wall_forces(path: Path | str) -> WallForces:
    """Reads the file. RuntimeError for one that millDem has not written."""
    text = Path(path).read_text()
    head = re.search(r"<!-- parts:([^;]*); DEM time (\S+) to (\S+) s -->", text)
    if not head:
        raise RuntimeError(f"{path}: expected the wall forces that millDem writes")
    arrays = {}
    for element in ElementTree.fromstring(text).iter("DataArray"):
        values = np.array((element.text or "").split(), dtype=float)
        columns = int(element.get("NumberOfComponents", "1"))
        arrays[element.get("Name", "")] = values.reshape(-1, columns) if columns > 1 else values
    corners = arrays.pop("Points").reshape(-1, 3, 3)
    for name in ("connectivity", "offsets"):
        arrays.pop(name)
    return WallForces(corners, arrays, head[1].split(), float(head[2]), float(head[3]))
