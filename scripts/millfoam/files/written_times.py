# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the slurry/air flow of a mill case: fields averaged over the axis, in the lab frame.

The mesh is a cross-section extruded along the axis and turns rigidly. So its cells are in columns, and a column's
place at any time follows from its place at the start. Means over the axis are of the mill itself, without the
compartments of pulp lifters behind its grates."""
from pathlib import Path

import numpy as np
from matplotlib.path import Path as Outline
from scipy.spatial import cKDTree

from . import foam


class MillFlow:
    """The flow in the case folder `case`; `frames` are its written times [(s, Path)] with the initial one."""

    def __init__(self, case: Path | str) -> None:
        self.case = Path(case)
        path = self.case / "constant" / "millProperties"
        properties = foam.read_dictionary(path)
        try:
            self.omega, self.radius, self.time0, self.length = (float(properties[key])
                                                                for key in ("omega", "radius", "time0", "length"))
        except (KeyError, ValueError) as error:
            expected = "expected omega, radius, time0 and length, as millMesh writes them"
            raise RuntimeError(f"{path}: {error}; {expected}") from None
        # Balls of constant/bedProperties displace slurry; those of an fvOption do not
        self.displaced = (self.case / "constant" / "bedProperties").is_file()
        self.frames = [(time, path) for time, path in foam.times(self.case) if foam.is_there(path / "alpha.slurry")]
        if len(self.frames) < 2:
            apart = " in this folder (those of processor* are joined by reconstructPar, or by Allrun once more)" \
                if any(self.case.glob("processor*")) else ""
            raise RuntimeError(f"{self.case}: no flow was written; expected two times or more with alpha.slurry{apart}")
        self.mesh = foam.read_mesh(self.case)
        self.centres, self.volumes = self.mesh.centres_and_volumes()
        _, first, self.column = np.unique(np.round(self.centres[:, :2] / self.radius, 6), axis=0, return_index=True,
                                          return_inverse=True)
        self.column_centres = self.centres[first, :2]
        self.chamber = self.centres[:, 2] < self.length
        self.column_volume = np.bincount(self.column, self.volumes * self.chamber)
        self._tree = cKDTree(self.column_centres)
        self._outline: np.ndarray | None = None
        self._pixels: dict[tuple, np.ndarray] = {}

    def turned(self, points: np.ndarray, time: float) -> np.ndarray:
        """Positions at `time` of x-y points [n, 2] of the mesh at flow time 0."""
        c, s = np.cos(self.omega * time), np.sin(self.omega * time)
        return points @ np.array([[c, s], [-s, c]])

    def field(self, name: str, path: Path) -> np.ndarray:
        """A field of a written time as [cells] or [cells, components]."""
        return foam.read_field(path / name, self.mesh.cells)

    def over_axis(self, values: np.ndarray) -> np.ndarray:
        """Mean over each column of `values` [cells], weighted by volume; NaN where none of it is in the chamber."""
        weight = self.volumes * self.chamber
        total = np.bincount(self.column, weight)
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(total > 1e-9 * self.column_volume, np.bincount(self.column, weight * values) / total,
                            np.nan)

    def _end_faces(self) -> np.ndarray:
        """Numbers of the feed end's faces, with those of an inlet in it."""
        patches = [self.mesh.patches[name] for name in ("feedEnd", "inlet") if name in self.mesh.patches]
        return np.concatenate([np.arange(patch.start, patch.start + patch.size) for patch in patches])

    def end_wall(self) -> tuple[np.ndarray, np.ndarray]:
        """Quads of the feed end: [faces, 4, 2] (m) at flow time 0, and each one's column [faces]."""
        numbers = self._end_faces()
        quads = self.mesh.points[np.array([self.mesh.faces[face] for face in numbers])][:, :, :2]
        return quads, self.column[self.mesh.owner[numbers]]

    def outline(self) -> np.ndarray:
        """The mill's inner outline, shell and lifters, as a closed polygon [n + 1, 2] (m) at flow time 0."""
        if self._outline is None:
            self._outline = self._find_outline()
        return self._outline

    def _find_outline(self) -> np.ndarray:
        following = {}
        edges = [(face[i], face[(i + 1) % 4]) for face in (self.mesh.faces[number] for number in self._end_faces())
                 for i in range(4)]
        inner = {(b, a) for a, b in edges}
        for a, b in edges:
            if (a, b) not in inner:
                following[a] = b
        loop = [next(iter(following))]
        while len(loop) <= len(following):
            loop.append(following[loop[-1]])
        return self.mesh.points[loop][:, :2]

    def on_grid(self, column_values: np.ndarray, time: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Column values [columns] at pixels x [nx], y [ny] (m, lab frame) at `time`: [ny, nx], NaN outside the mill."""
        # Maps need several fields on the same pixels at the same times
        key = (time, len(x), x[0], x[-1], len(y), y[0], y[-1])
        if key not in self._pixels:
            self._pixels[key] = self._columns_of(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2), time)
        return np.append(column_values, np.nan)[self._pixels[key]].reshape(len(y), len(x))

    def _columns_of(self, points: np.ndarray, time: float) -> np.ndarray:
        """Column in which each point [n, 2] (m, lab frame) is at `time`; outside the mill, the number of columns."""
        back = self.turned(points, -time)
        inside = Outline(self.outline()).contains_points(back)
        columns = np.full(len(points), len(self.column_centres), dtype=np.int32)
        columns[inside] = self._tree.query(back[inside])[1]
        return columns

    def slurry(self, path: Path) -> np.ndarray:
        """Volume of slurry in each cell [cells] at a written time, m^3. If balls displace slurry, it is a share of the
        space between them. It is then not known at the initial time, which is written before the flow reads its
        balls."""
        volume = self.field("alpha.slurry", path) * self.volumes
        return volume * (1 - self.field("solidity", path)) if self.displaced else volume

    def frames_with_slurry(self, begin: float) -> list[tuple[float, Path]]:
        """The written times (s) and their folders from `begin` (s) on at which the volume of slurry is known."""
        return [(time, path) for time, path in self.frames
                if time >= begin - 1e-9 and (not self.displaced or foam.is_there(path / "solidity"))]

    def slurry_volumes(self) -> tuple[float, float]:
        """Volume of slurry at the first and the last written time at which it is known, m^3."""
        first = self.frames_with_slurry(0.0)[0][1]
        return float(self.slurry(first).sum()), float(self.slurry(self.frames[-1][1]).sum())

    def load(self, begin: float) -> tuple[float, float] | None:
        """Force of the fluid on the balls over their weight, at the written times from `begin` (s) on: its mean and its
        95th percentile over the balls' volume, or None if the flow did not write it."""
        paths = [path for time, path in self.frames
                 if time >= begin - 1e-9 and foam.is_there(path / "forceOverWeight")]
        if not paths:
            return None
        ratios = np.concatenate([self.field("forceOverWeight", path) for path in paths])
        balls = np.concatenate([self.field("solidity", path) * self.volumes for path in paths])
        order = np.argsort(ratios)
        share = np.cumsum(balls[order]) / balls.sum()
        return float(np.average(ratios, weights=balls)), float(ratios[order][np.searchsorted(share, 0.95)])

    def slurry_centroid(self, time: float, path: Path) -> tuple[float, float]:
        """Centre (x, y) of the slurry's volume at a written time, m."""
        weight = self.slurry(path)
        centre = (weight[:, None] * self.turned(self.centres[:, :2], time)).sum(axis=0) / weight.sum()
        return float(centre[0]), float(centre[1])
