# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of the contacts of a dry run by partner: ball on ball, and ball on each part of the walls."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.data_files import DataError
from .contact_statistics import binned

BALLS = "balls"  # the partner of two balls


@dataclass(frozen=True)
class Peak:
    """The bin with the largest power: its edges (J) and its power (W)."""
    low: float
    high: float
    power: float

    @property
    def energy(self) -> float:
        """Middle of the bin in the logarithm, J."""
        return float(np.sqrt(self.low * self.high))


@dataclass(frozen=True)
class PartnerSpectra:
    """edges [n] (J): bins of energy are below the first, between two, and above the last. partners [p]: `balls`, then
    the walls. collisions [p, n + 1] (1/s): by energy at first touch; normal, tangential, rolling [p, n + 1] (W): power
    of whole contacts by the energy that each dissipates."""
    edges: np.ndarray
    partners: tuple[str, ...]
    collisions: np.ndarray
    normal: np.ndarray
    tangential: np.ndarray
    rolling: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Power of all three [p, n + 1], W."""
        return np.asarray(self.normal + self.tangential + self.rolling)

    def peak(self, partner: str | None = None) -> Peak | None:
        """The modal peak of the total power of a partner, or of all; None if no bin between the edges has power."""
        power = self.total.sum(axis=0) if partner is None else self.total[self.partners.index(partner)]
        inner = power[1:-1]
        k = int(np.argmax(inner))
        return Peak(float(self.edges[k]), float(self.edges[k + 1]), float(inner[k])) if inner[k] > 0 else None


def read_partner_spectra(dumps: Path | str, walls: Sequence[str]) -> PartnerSpectra:
    """PartnerSpectra of `contact_spectra.csv` in a folder dumps/; walls: their names in the order of their numbers.
    DataError for a file with other bins or walls."""
    edges, table, bins = binned(dumps)
    wall = table["wall"].astype(int)
    if np.any((wall < -1) | (wall >= len(walls))):
        raise DataError(f"{Path(dumps) / 'contact_spectra.csv'}: wall {wall.max()}; expected -1 to {len(walls) - 1}")
    fields = []
    for name in ("touches_per_s", "normal_W", "tangential_W", "rolling_W"):
        field = np.zeros((len(walls) + 1, len(edges) + 1))
        np.add.at(field, (wall + 1, bins), table[name])
        fields.append(field)
    return PartnerSpectra(edges, (BALLS, *walls), *fields)
