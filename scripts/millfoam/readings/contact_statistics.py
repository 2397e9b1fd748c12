# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts of a dry run that followed each of them in every step (`dem.contact_statistics`)."""
from pathlib import Path

import numpy as np

from ..files.data_files import DataError, read_csv
from ..files.wall_forces import WallForces
from .contact_spectra import PARTS, Spectra, energy_edges

LOWEST, HIGHEST = 1e-15, 1e3  # J, edges of the bins of millDem, five per decade


def binned(dumps: Path | str) -> tuple[np.ndarray, dict[str, np.ndarray], np.ndarray]:
    """Edges of the bins [n] (J), columns of `contact_spectra.csv` in a folder dumps/, and the bin of each row: 0 below
    the first edge, n above the last. DataError for a file with other bins."""
    path = Path(dumps) / "contact_spectra.csv"
    table = read_csv(path)
    edges = energy_edges(LOWEST, HIGHEST)
    to = table["energy_to_J"]
    # The bin below an edge has the edge's number, the last one that of all edges
    bins = np.where(np.isinf(to), len(edges), np.rint(5 * np.log10(np.where(np.isinf(to), 1.0, to) / LOWEST)))
    if np.any((bins < 0) | (bins > len(edges))):
        raise DataError(f"{path}: energies beyond the bins from {LOWEST:g} to {HIGHEST:g} J")
    return edges, table, bins.astype(int)


def read_statistics(dumps: Path | str, begin: float, end: float) -> Spectra:
    """Spectra of `contact_spectra.csv` in a folder dumps/; begin, end: DEM times (s) of `contacts` in results.json.

    `collisions` are by energy at first touch. `damping`, `friction` and `rolling` are the power of the normal and the
    tangential force and of rolling friction, by the energy that the whole collision dissipates; `spring` is 0.
    `sliding` is not known. DataError for a file with other bins."""
    edges, table, bins = binned(dumps)
    small, large = np.sort([table["first_m"], table["second_m"]], axis=0)
    classes = np.unique(np.concatenate([[0.0], small, large]))
    place = np.searchsorted(classes, small), np.searchsorted(classes, large), bins

    def collect(values: np.ndarray) -> np.ndarray:
        field = np.zeros((len(classes), len(classes), len(edges) + 1))
        np.add.at(field, place, values)
        return field
    columns = {"damping": "normal_W", "friction": "tangential_W", "rolling": "rolling_W"}
    power = {part: collect(table[columns[part]]) if part in columns else collect(np.zeros(len(bins))) for part in PARTS}
    return Spectra(edges, classes, collect(table["touches_per_s"]), power, np.nan, 0, end - begin)


def section_means(walls: WallForces, outline: np.ndarray, sectors: int, fields: tuple[str, ...],
                  longest: float) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Means of fields per area along the outline of a mill's section, over the axis and over its equal sectors.

    outline [n, 2] (m): of one sector, about the angle 0; sectors: their number in a turn; longest (m): of the pieces
    of the outline. Returns the pieces' ends [m, 2, 2] (m) and {field: means [m], NaN where there is no wall}. Each wall
    cell counts, with its area, for the piece whose middle is nearest to the cell's. Cells across the axis do not
    count."""
    ends = []
    for first, second in zip(outline[:-1], outline[1:]):
        count = max(1, int(np.ceil(np.linalg.norm(second - first) / longest)))
        points = first + (second - first) * np.linspace(0, 1, count + 1)[:, None]
        ends += list(np.stack([points[:-1], points[1:]], axis=1))
    pieces = np.array(ends)
    middles = pieces.mean(axis=1)
    along = np.abs(walls.normals()[:, 2]) < 0.5
    areas = walls.areas()[along]
    place = walls.corners[along].mean(axis=1)
    pitch = 2 * np.pi / sectors
    angle = np.angle(np.exp(1j * np.arctan2(place[:, 1], place[:, 0])))
    angle -= pitch * np.round(angle / pitch)
    radius = np.hypot(place[:, 0], place[:, 1])
    folded = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    nearest = np.concatenate([np.argmin(np.linalg.norm(part[:, None] - middles, axis=2), axis=1)
                              for part in np.array_split(folded, max(1, len(folded) // 2000))])
    whole = np.bincount(nearest, areas, len(pieces))
    with np.errstate(invalid="ignore"):
        means = {name: np.bincount(nearest, areas * walls.fields[name][along], len(pieces)) / whole for name in fields}
    return pieces, means
