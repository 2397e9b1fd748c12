# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a stirred mill's dry run in a case folder."""
from functools import cached_property
from pathlib import Path

import numpy as np

from .data_files import entry
from .mill import NoMill
from .mill_case import MillCase
from .rings_file import Rings, read_rings


class StirredCase(MillCase):
    """A stirred mill's case in a folder; missing parts are None. begin: time at which the averages begin, s, of the
    flow or, without one, of the dry run; None: the mill's own, or when the dry run is steady. NoMill for another
    machine, or a run without results."""

    machine = "stirred"

    @cached_property
    def solids(self) -> Path | None:
        """None: the maps of a tumbling mill, which are across its axis, have no meaning here."""
        return None

    @cached_property
    def charge_folders(self) -> list[Path]:
        """Folders in which the charge may have been made: the case's, and that of solids.h5 if this is a link."""
        averages = (self.folder / "solids.h5").resolve()
        return list(dict.fromkeys([self.folder.resolve()] + ([averages.parent] if averages.is_file() else [])))

    @cached_property
    def rings(self) -> Rings | None:
        """Averages of the balls in solids.h5, over all its windows; None without them, or if `unusable` reports that
        they cannot be read."""
        path = self.folder / "solids.h5"
        return self._reported(lambda: read_rings(path)) if path.is_file() else None

    @cached_property
    def dumps(self) -> Path:
        """The folder dumps/ of the dry run's results; NoMill without them."""
        if self.dry is None:
            raise NoMill(f"{self.folder}: no dumps/results.json; has the dry run come to its end?")
        return self.dry

    @cached_property
    def torques(self) -> dict[str, np.ndarray] | None:
        """torques.csv: time_s and, of each part, torque of the balls about +z, N m."""
        return self._columns("torques.csv")

    @property
    def parts(self) -> list[str]:
        """Names of the walls in the order of their numbers: impeller, shell, base, lid. DataError without torques."""
        return list(entry(self.results, self.dumps / "results.json", "part_torques_Nm"))

    @property
    def tip_radius(self) -> float:
        """Largest radius of the impeller, m."""
        return float(self.mill.impeller["radius_m"])

    @property
    def tip_speed(self) -> float:
        """Speed of the impeller's tips, m/s."""
        return self.mill.derived("speed", "tip_speed_m_s")

    @property
    def slurry_volume(self) -> float | None:
        """Volume of the slurry, m3; None if the mill has none."""
        return (self.mill.flow("start") or {}).get("volume_m3")
