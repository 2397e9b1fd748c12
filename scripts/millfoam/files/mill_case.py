# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mill's run in a case folder, if they exist: mill, charge, flow, tables, results of its stages."""
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from . import solids_file, tables
from .contact_dumps import contact_steps
from .data_files import number, read_csv, read_json
from .dumps import read_timestep
from .flow_record import FlowRecord, read_flow_record
from .foam import times
from .mill import NoMill, read_mill
from .outline import lifter_outline
from .solids_file import SolidsMap
from .written_times import MillFlow

CUT = 0.01  # share of a flow's duration that may be missing


class MillCase:
    """A mill's run in a folder; missing parts are None.

    begin: flow time at which the averages begin, s. None: the mill's flow.averages.start, or half of the flow's time
    where at most half of the planned averaged time was computed. The averages of a dry run begin at the same DEM time,
    or when it is steady.
    unusable: why files cannot be used, in words."""

    machine = "tumbling"  # that mill.json must have

    def __init__(self, folder: Path | str, begin: float | None = None) -> None:
        self.folder = Path(folder)
        self.asked_begin = begin
        self.unusable: list[str] = []
        self.mill = read_mill(self.folder, self.machine)
        if self.flow is None and self.solids is None and self.dry is None:
            raise NoMill("; ".join([f"{self.folder}: no flow (times with alpha.slurry), no complete solids.h5, no "
                                    "dumps/results.json; has the case run to its end?", *self.unusable]))
        if begin is None:
            return
        last = self.last if self.flow else self.solids_span[1] if self.solids else np.inf
        if not 0 <= begin < last:
            what = "the flow's last written time" if self.flow else "the end of solids.h5"
            raise RuntimeError(f"{self.folder}: averages from {begin:g} s on; expected 0 or more and less than {what}, "
                               f"{last:g} s")

    @property
    def name(self) -> str:
        """Name of the case's folder."""
        return self.folder.resolve().name

    @property
    def title(self) -> str:
        """The mill's title, or the folder's name."""
        return self.mill.title or self.name

    @property
    def radius(self) -> float:
        """Inner radius of the shell, m."""
        return self.mill.radius

    @property
    def length(self) -> float:
        """Length of the computed part, m."""
        return self.mill.length

    @property
    def is_slice(self) -> bool:
        """Whether the mill is a periodic slice."""
        return self.mill.is_slice

    @property
    def lifter_height(self) -> float:
        """m; 0 for a smooth drum."""
        return self.mill.lifters[1]

    @property
    def omega(self) -> float:
        """Angular speed about z, right-handed, rad/s."""
        return self.mill.omega

    @cached_property
    def turn(self) -> float:
        """Time of a turn of the mill, s."""
        return self.mill.turn

    @cached_property
    def has_balls(self) -> bool:
        """Whether the flow has balls, or there is no flow."""
        return bool(not self.flow or self.law or self.flow.displaced)

    @cached_property
    def outline(self) -> np.ndarray:
        """The mill's outline [n, 2] (m) at the end of the averaged time."""
        if self.flow:
            return self.flow.turned(self.flow.outline(), self.last)
        return self.outline_at(self.charge_span[1] if self.solids else 0)

    def outline_at(self, time: float) -> np.ndarray:
        """The outline [n, 2] (m) at DEM time `time` (s): lifter 1 is at +x at time 0."""
        return lifter_outline(self.radius, *self.mill.lifters, self.omega * time)

    def json(self, path: Path, kind: str) -> dict[str, Any] | None:
        """Content of a JSON file millfoam-`kind`, or None; `unusable` reports a file that cannot be read."""
        if not path.is_file():
            return None
        return self._reported(lambda: read_json(path, kind))

    def _reported(self, read: Callable[[], Any], none: Any = None) -> Any:
        """The result of read(); if it raises an error, `none`, with the error's text in `unusable`."""
        try:
            return read()
        except (RuntimeError, OSError, ValueError, KeyError) as error:
            words = str(error)
            if words not in self.unusable:
                self.unusable.append(words)
            return none

    # The charge

    @cached_property
    def solids(self) -> Path | None:
        """solids.h5, with links followed, if it is complete and has a box's voxels."""
        path = self.folder / "solids.h5"
        if not self._whole(path, "average the dumps again (millAverage)"):
            return None
        if not solids_file.has_voxels(path):
            self.unusable.append(f"{path}: its cells are not a box's voxels, which maps need")
            return None
        return path.resolve()

    @cached_property
    def averages(self) -> dict[str, Any] | None:
        """solids.json next to solids.h5."""
        return self.json(self.solids.with_suffix(".json"), "averages") if self.solids else None

    def _whole(self, path: Path, advice: str) -> bool:
        """Whether a file of averages exists and is complete."""
        if not path.is_file():
            return False
        try:
            with h5py.File(path) as file:
                if file.attrs.get("complete", 0) == 1:
                    return True
                reason = "it is not complete"
        except OSError:
            reason = "it is cut short or not an HDF5 file"
        self.unusable.append(f"{path}: not used, because {reason}; {advice}")
        return False

    @cached_property
    def charge_folders(self) -> list[Path]:
        """Folders in which the charge may have been made: the case's, and that of solids.h5 if this is a link."""
        return list(dict.fromkeys([self.folder.resolve()] + ([self.solids.parent] if self.solids else [])))

    @cached_property
    def dry(self) -> Path | None:
        """The folder dumps/ of the dry run's results."""
        return next((place / "dumps" for place in self.charge_folders if (place / "dumps" / "results.json").is_file()
                     and self.json(place / "dumps" / "results.json", "charge")), None)

    @cached_property
    def results(self) -> dict[str, Any] | None:
        """results.json of the dry run."""
        return self.json(self.dry / "results.json", "charge") if self.dry else None

    def result(self, *keys: str) -> float:
        """A number of results.json, NaN for null; DataError if it is missing."""
        return number(self.results, self.dry / "results.json", *keys)

    @cached_property
    def energy(self) -> dict[str, np.ndarray] | None:
        """energy.csv of the dry run: column -> values over its records."""
        return self._columns("energy.csv")

    @cached_property
    def fluid_on_balls(self) -> dict[str, np.ndarray] | None:
        """fluid.csv of balls that felt a fluid: column -> values over their records."""
        return self._columns("fluid.csv")

    @cached_property
    def overlaps(self) -> dict[str, np.ndarray] | None:
        """overlaps.csv: overlap_m, contacts of balls and with walls."""
        return self._columns("overlaps.csv")

    def _columns(self, name: str) -> dict[str, np.ndarray] | None:
        path = self.dry / name if self.dry else None
        found = self._reported(lambda: read_csv(path)) if path and path.is_file() else None
        return found if found and len(next(iter(found.values()))) > 1 else None

    @cached_property
    def solids_span(self) -> tuple[float, float]:
        """DEM times that solids.h5 covers, s."""
        with h5py.File(self.solids) as file:
            return float(file["window/begin"][0]), float(file["window/end"][-1])

    @cached_property
    def charge_span(self) -> tuple[float, float]:
        """DEM times between which the charge is averaged, s."""
        first, last = self.solids_span
        if self.flow:
            return solids_file.span_of_flow(first, last, self.flow.time0 + self.begin, self.flow.time0 + self.last)
        if self.asked_begin is not None:
            return self.asked_begin, last
        steady = self.result("steady_from_s") if self.results else first
        return min(max(first, steady), (first + last) / 2), last

    @cached_property
    def charge_windows(self) -> list[SolidsMap]:
        """SolidsMap of each window of charge_span."""
        return solids_file.read_windows(self.solids, *self.charge_span) if self.solids else []

    @cached_property
    def charge(self) -> SolidsMap | None:
        """SolidsMap of the charge over charge_span."""
        return solids_file.mean_map(self.charge_windows) if self.solids else None

    @cached_property
    def contacts(self) -> Path | None:
        """The folder with the dry run's contacts/ and dumps/, or None without contacts."""
        folder = self.dry.parent if self.dry else None
        return folder if folder and any((folder / "contacts").glob("pairs.*.txt")) else None

    @cached_property
    def contact_times(self) -> list[float]:
        """DEM times of the dumps of contacts, s."""
        timestep = read_timestep(self.contacts / "dumps")
        return [step * timestep for step in contact_steps(self.contacts)]

    @cached_property
    def coupled(self) -> Path | None:
        """The folder with coupling.json, if this case's mill is coupled both ways and it is one of the passes of balls
        and slurry that are compared there."""
        if self.mill.flow("coupling", "one_way") == "one_way":
            return None
        for place, name in ((self.folder, "."), (self.folder.resolve().parent, self.name)):
            content = self.json(place / "coupling.json", "coupling")
            if content and name in content.get("folders", ()) and content["mill"] == self.mill.fingerprint:
                return place
        return None

    # The flow

    @cached_property
    def flow(self) -> MillFlow | None:
        """MillFlow of the written times; None without a flow, or if `unusable` reports that it cannot be used."""
        # An earlier flow of a mill that has none now belongs to another mill
        if self.mill.content.get("derived", {}).get("flow", {}) is None:
            return None
        # millMesh writes the mill's mesh and numbers for a dry run, too
        record = self.folder / "postProcessing" / "flow"
        if not (times(self.folder) or any(self.folder.glob("processor*")) or record.is_dir()):
            return None
        try:
            return MillFlow(self.folder)
        except (RuntimeError, OSError, ValueError) as error:
            self.unusable.append(f"The flow is not shown: {error}")
            return None

    @cached_property
    def record(self) -> FlowRecord:
        """FlowRecord of the flow's steps and summaries, empty if there is none."""
        found = self._reported(lambda: read_flow_record(self.folder), FlowRecord(None, []))
        if found.steps:
            self._require_end("steps.csv of postProcessing/flow", found.steps["time_s"])
        return found

    @cached_property
    def last(self) -> float:
        """Flow time of the last written fields, s."""
        return self.flow.frames[-1][0]

    @cached_property
    def own_end(self) -> dict[str, Any] | None:
        """steady.json of a flow that ended by itself."""
        found = self.json(self.folder / "steady.json", "steady")
        return found if found and found["mill"]["flow"] == self.mill.fingerprint["flow"] else None

    @cached_property
    def duration(self) -> float:
        """Duration of the flow by the mill, or by its own end, s; NaN if the mill has none."""
        if self.own_end:
            return number(self.own_end, self.folder / "steady.json", "end_s")
        return float(self.mill.flow("duration_s") or np.nan)

    @cached_property
    def is_cut_short(self) -> bool:
        """Whether the flow has not reached the mill's end time."""
        return self.record.complete is False or self.last < (1 - CUT) * self.duration

    @cached_property
    def begin(self) -> float:
        """Flow time at which the averages begin, s: the mill's flow.averages.start, or half of the flow's time where at
        most half of the planned averaged time, from there to the flow's duration, was computed. With flow.steady, that
        of steady.json or, before the flow's end, of its last turns, at most its second half."""
        if self.asked_begin is not None:
            return self.asked_begin
        if self.own_end:
            return number(self.own_end, self.folder / "steady.json", "begin_s")
        if steady := self.mill.flow("steady"):
            return max(self.last - steady["turns"] * self.turn, self.last / 2)
        start = self.mill.flow("averages_start_s")
        if start is None:
            return self.last / 2
        planned = max(self.duration - start, 0) if np.isfinite(self.duration) else 0
        return start if self.last - start > planned / 2 else self.last / 2

    @cached_property
    def load(self) -> tuple[float, float] | None:
        """Mean and 95th percentile of the fluid's force on the balls over their weight, or None."""
        return self.flow.load(self.begin) if self.flow else None

    @cached_property
    def balance(self) -> dict[str, np.ndarray] | None:
        """Columns of slurryBalance."""
        found = self._table("slurryBalance", lambda: tables.read_columns(self.folder, "slurryBalance"))
        if found:
            self._require_end("the table of slurryBalance", found["Time"])
        return found

    @cached_property
    def is_open(self) -> bool:
        """Whether slurry enters or leaves, by more than round-off."""
        columns = self.balance
        through = max(np.abs(columns["feed"]).max(), np.abs(columns["discharge"]).max()) * np.ptp(columns["Time"])
        return through > 1e-6 * columns["holdUp"].max()

    @property
    def met_balls(self) -> bool:
        """Whether slurryBalance has Reynolds numbers of balls in slurry."""
        return "Re_mean" in self.balance and bool((self.balance["Re_mean"] > 0).any())

    def axial(self, quantity: str) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Places (m) [slices], times (s) [n] and values [n, slices] of axialProfiles, or None."""
        found = self._table("axialProfiles", lambda: tables.read_table(self.folder, "axialProfiles", quantity))
        if found is None:
            return None
        names, rows = found
        return np.array(names[1:], dtype=float), rows[:, 0], rows[:, 1:]

    def _require_end(self, name: str, times: np.ndarray) -> None:
        """Reports in `unusable` a table whose last time (s) is before that of the written fields."""
        end = float(times[-1]) if len(times) else 0.0
        if self.flow and self.flow.frames and end < (1 - CUT) * self.last:
            self.unusable.append(f"{name} ends at {end:.3g} s, and the flow's fields at {self.last:.3g} s: numbers "
                                 "from the table are of a part of the flow")

    def _table(self, name: str, read: Callable[[], Any]) -> Any:
        """The result of read() of a function object's table; None without a flow or table, or if `unusable` reports
        that it cannot be read."""
        return self._reported(read) if self.flow and (self.folder / "postProcessing" / name).is_dir() else None

    @cached_property
    def slurry(self) -> Path | None:
        """slurry.h5, if it is complete."""
        path = self.folder / "slurry.h5"
        return path if self._whole(path, "let the flow run to its end (voxelAverages.H)") else None

    @property
    def feed(self) -> float | None:
        """Feed rate, m3/s, or None."""
        return self.mill.flow("feed_m3_s") or None

    @cached_property
    def law(self) -> str | None:
        """The drag law's name from the solver's summary, or otherwise from the mill; None without balls or flow."""
        if not self.flow:
            return None
        if self.record.summaries:
            return (self.record.last.get("drag") or {}).get("law")
        return self.mill.flow("law") if self.mill.flow("balls", self.flow.displaced) else None
