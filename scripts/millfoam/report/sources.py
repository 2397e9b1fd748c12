# SPDX-License-Identifier: GPL-3.0-or-later
"""What a case folder holds of a mill's run, whatever of it is there: mill, charge, flow, tables, logs."""
import re
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np
import yaml

from .. import solids, tables
from ..contacts import contact_steps
from ..dem_tracks import read_notes
from ..dry_runs import read_results
from ..foam import times
from ..mill_flow import MillFlow
from ..mill_plots import circle


class NoMill(RuntimeError):
    """A folder that is no mill's case; the message says what was looked for."""


def read_mill(folder):
    """Text and content of a case's mill.yaml; NoMill where it is none."""
    path = folder / "mill.yaml"
    if not path.is_file():
        raise NoMill(f"{folder}: no mill.yaml; expected the folder of a mill's case that was run")
    text = path.read_text()
    try:
        mill = yaml.safe_load(text)
    except yaml.YAMLError as error:
        where = f", line {error.problem_mark.line + 1}" if getattr(error, "problem_mark", None) else ""
        raise NoMill(f"{path}{where}: no YAML: {getattr(error, 'problem', error)}") from None
    missing = [key for key in ("geometry", "speed", "charge") if not isinstance(mill, dict) or key not in mill]
    if missing:
        raise NoMill(f"{path}: no {missing[0]}; expected the description of a mill (meshing/README.md)")
    return text, mill


def usual_width(radius, count, height, trapezoid):
    """Width (m) of lifters' feet where mill.yaml leaves it open, as millMesh has it: their height, or half of what chord and
    pitch leave."""
    tips = radius - height
    pitch = 2 * radius
    if trapezoid and count > 1:
        pitch = 2 * radius * np.sin(np.pi / count)
    if not trapezoid and count > 2:
        pitch = 2 * tips * np.tan(np.pi / count)
    return min(height, np.sqrt(radius**2 - tips**2), pitch / 2)


def lifter_outline(radius, count, height, width, top_width, angle):
    """Closed outline [n, 2] (m) of a shell with `count` trapezoids of which the first stands at `angle` (rad) from +x; height
    from the shell to the middle of the flat top, width of the foot between its points on the shell."""
    if not count:
        return circle(radius)
    half, pitch = np.arcsin(width / 2 / radius), 2 * np.pi / count
    arc = radius * np.exp(1j * np.linspace(half, pitch - half, max(3, 360 // count)))
    lifter = [radius * np.exp(-1j * half), radius - height - 0.5j * top_width, radius - height + 0.5j * top_width]
    points = np.concatenate([np.exp(1j * (angle + number * pitch)) * np.concatenate([lifter, arc]) for number in range(count)])
    return np.column_stack([points.real, points.imag])[[*range(len(points)), 0]]


class MillCase:
    """A mill's run in a folder; parts that are not there are None.

    begin: flow time from which averages are taken, s; None: 2 s, or half of a flow of 3 s or less. A dry run is averaged
    from the same time of its own, or from when it is steady. unusable: what is there but cannot be used, in words."""

    def __init__(self, folder, begin=None):
        self.folder = Path(folder)
        self.asked_begin = begin
        self.unusable = []
        self.mill_text, self.mill = read_mill(self.folder)
        if self.flow is None and self.solids is None and self.dry is None:
            raise NoMill("; ".join([f"{self.folder}: neither a flow (times with alpha.slurry), nor a whole solids.h5, nor "
                                    "dumps/results.txt; has the case run to its end?", *self.unusable]))
        if begin is not None and self.flow and begin >= self.last:
            raise RuntimeError(f"{self.folder}: averages from {begin:g} s on, but the flow's last written time is "
                               f"{self.last:g} s")

    @property
    def name(self):
        return self.folder.resolve().name

    @property
    def radius(self):
        return self.mill["geometry"]["diameter"] / 2

    @cached_property
    def length(self):
        return self.flow.length if self.flow else self.mill["geometry"]["length"]

    @property
    def is_slice(self):
        """Whether the mill is a periodic slice."""
        return self.mill["geometry"].get("ends") == "periodic" or "slice" in self.mill["geometry"]

    @property
    def lifter_height(self):
        """m; 0 for a smooth drum."""
        lifters = self.mill["geometry"].get("lifters") or {}
        return float(lifters.get("height", self.radius / 15)) if lifters.get("count") else 0.0

    @cached_property
    def turn(self):
        """Time of a turn of the mill, s."""
        return 2 * np.pi / abs(self.omega)

    @cached_property
    def has_balls(self):
        """Whether the charge is in the flow, or there is no flow."""
        return bool(not self.flow or self.law or self.flow.displaced)

    @cached_property
    def outline(self):
        """The mill's outline [n, 2] (m) at the end of the averaged time."""
        if self.flow:
            return self.flow.turned(self.flow.outline(), self.last)
        return self.outline_at(self.charge_span[1] if self.solids else 0)

    def outline_at(self, time):
        """The outline [n, 2] (m) by mill.yaml at DEM time `time` (s): lifter 1 stands at +x at time 0."""
        lifters = self.mill["geometry"].get("lifters") or {}
        count = lifters.get("count", 0)
        width = lifters.get("width", usual_width(self.radius, count, self.lifter_height, "top_width" in lifters))
        return lifter_outline(self.radius, count, self.lifter_height, width, lifters.get("top_width", width),
                              self.omega * time)

    @cached_property
    def omega(self):
        """Angular speed about z, right-handed, rad/s."""
        if self.flow:
            return self.flow.omega
        run_file = self.dry / "run.txt" if self.dry else None
        if run_file and run_file.is_file():
            return float(read_results(run_file)["angular_velocity"])
        speed = self.mill["speed"]
        magnitude = speed.get("angular_velocity") or speed["fraction_of_critical"] * np.sqrt(9.81 / self.radius)
        return -magnitude if speed.get("sense", "clockwise") == "clockwise" else magnitude

    # The charge

    @cached_property
    def solids(self):
        """solids.h5, with links followed, where it is whole and of a box's voxels."""
        path = self.folder / "solids.h5"
        if not self._whole(path, "average the dumps again (millAverage)"):
            return None
        with h5py.File(path) as file:
            if "lower" not in file["grid"].attrs:
                self.unusable.append(f"{path}: its cells are not a box's voxels, which maps are made of")
                return None
        return path.resolve()

    def _whole(self, path, advice):
        """Whether a file of averages is there and whole."""
        if not path.is_file():
            return False
        try:
            with h5py.File(path) as file:
                if file.attrs.get("complete", 0) == 1:
                    return True
                reason = "it is half-written"
        except OSError:
            reason = "it is cut short, or no HDF5 file"
        self.unusable.append(f"{path}: not used, as {reason}; {advice}")
        return False

    @cached_property
    def dry(self):
        """The folder of the dry run's results."""
        places = [self.folder / "dumps"] + ([self.solids.parent / "dumps"] if self.solids else [])
        return next((place for place in places if (place / "results.txt").is_file()), None)

    @cached_property
    def results(self):
        """results.txt of the dry run: name -> text."""
        return read_results(self.dry / "results.txt") if self.dry else None

    @cached_property
    def energy(self):
        """energy.csv of the dry run: column -> values over its records."""
        if not self.dry or not (self.dry / "energy.csv").is_file():
            return None
        path = self.dry / "energy.csv"
        names = path.read_text().split("\n", 1)[0].split(",")
        return dict(zip(names, np.loadtxt(path, delimiter=",", skiprows=1, unpack=True, ndmin=2)))

    @cached_property
    def overlaps(self):
        """overlaps.csv: overlap (m), contacts of balls, contacts with walls."""
        path = self.dry / "overlaps.csv" if self.dry else None
        return np.loadtxt(path, delimiter=",", skiprows=1, unpack=True, ndmin=2) if path and path.is_file() else None

    @cached_property
    def charge_span(self):
        """DEM times between which the charge is averaged, s."""
        with h5py.File(self.solids) as file:
            first, last = file["window/begin"][0], file["window/end"][-1]
        if self.flow and self.flow.time0 + self.begin < last:
            return self.flow.time0 + self.begin, min(last, self.flow.time0 + self.last)
        if self.flow:  # through a charge that is held
            return first, last
        if self.asked_begin is not None:
            return self.asked_begin, last
        steady = float(self.results.get("steady_from", 0)) if self.results else 0
        return min(max(first, steady, 2.0 if last > 3 else 0), (first + last) / 2), last

    @cached_property
    def charge_windows(self):
        """SolidsMap of each window of charge_span."""
        return solids.read_windows(self.solids, *self.charge_span) if self.solids else []

    @cached_property
    def charge(self):
        """SolidsMap of the charge over charge_span."""
        return solids.mean_map(self.charge_windows) if self.solids else None

    @cached_property
    def contacts(self):
        """The folder that holds the dry run's contacts/ beside its dumps/, or None."""
        folder = self.dry.parent if self.dry else None
        return folder if folder and any((folder / "contacts").glob("pairs.*.txt")) else None

    @cached_property
    def contact_times(self):
        """DEM times of the dumps of contacts, s."""
        timestep = read_notes(self.contacts / "dumps")["timestep"]
        return [step * timestep for step in contact_steps(self.contacts)]

    # The flow

    @cached_property
    def flow(self):
        # millMesh writes the mill's mesh and numbers for a dry run too
        begun = times(self.folder) or any(self.folder.glob("processor*")) or any(self.folder.glob("log.flow*"))
        if not ((self.folder / "constant" / "millProperties").is_file() and begun):
            return None
        try:
            return MillFlow(self.folder)
        except RuntimeError as error:
            self.unusable.append(f"The flow is not shown: {error}")
            return None

    @cached_property
    def last(self):
        """Flow time of the last written fields, s."""
        return self.flow.frames[-1][0]

    @cached_property
    def begin(self):
        if self.asked_begin is not None:
            return self.asked_begin
        return 2.0 if self.last > 3 else self.last / 2

    @cached_property
    def load(self):
        """Mean and 95th percentile of the fluid's force on the balls over their weight, or None."""
        return self.flow.load(self.begin) if self.flow else None

    @cached_property
    def balance(self):
        """Columns of slurryBalance."""
        return self._table("slurryBalance", lambda: tables.read_columns(self.folder, "slurryBalance"))

    @cached_property
    def is_open(self):
        """Whether slurry is fed or let out: more than round-off."""
        told = self.balance
        through = max(np.abs(told["feed"]).max(), np.abs(told["discharge"]).max()) * np.ptp(told["Time"])
        return through > 1e-6 * told["holdUp"].max()

    @property
    def met_balls(self):
        """Whether slurryBalance told Reynolds numbers of balls in slurry."""
        return "Re_mean" in self.balance and bool((self.balance["Re_mean"] > 0).any())

    def axial(self, quantity):
        """Places (m) [slices], times (s) [n] and values [n, slices] of axialProfiles, or None."""
        found = self._table("axialProfiles", lambda: tables.read_table(self.folder, "axialProfiles", quantity))
        if found is None:
            return None
        names, rows = found
        return np.array(names[1:], dtype=float), rows[:, 0], rows[:, 1:]

    def _table(self, name, read):
        """What read() gives of a function object's table; None, told where there are such tables, if it cannot be read."""
        try:
            return read()
        except tables.TableError as error:
            if (self.folder / "postProcessing" / name).is_dir() and str(error) not in self.unusable:
                self.unusable.append(str(error))
            return None

    @cached_property
    def slurry(self):
        """slurry.h5, where it is whole."""
        path = self.folder / "slurry.h5"
        return path if self._whole(path, "let the flow run to its end (voxelAverages.H)") else None

    @cached_property
    def feed(self):
        """Feed rate that was asked for, m3/s, or None."""
        path = self.folder / "constant" / "operation"
        found = re.search(r"feedRate\s+([^;\s]+)", path.read_text()) if path.is_file() else None
        return float(found.group(1)) if found else None

    @cached_property
    def law(self):
        """The drag law's name, or None without balls."""
        found = re.search(r"^Drag: drag law (\w+)", self.log("flow"), re.M)
        return found.group(1) if found else None

    @cached_property
    def _logs(self):
        return {}

    def log(self, name):
        """Text of log.NAME, after what was kept of it before a restart; of the charge's stages where that was made. Empty where
        there is none."""
        if name not in self._logs:
            folders = [self.folder] + ([self.solids.parent] if self.solids else [])
            places = [[folder / f"log.{name}{end}" for end in (".before", "")] for folder in folders]
            found = next(([p for p in pair if p.is_file()] for pair in places if any(p.is_file() for p in pair)), [])
            self._logs[name] = "".join(path.read_text(errors="replace") for path in found)
        return self._logs[name]

    def summary(self):
        """One line: what was run."""
        geometry, speed = self.mill["geometry"], self.mill["speed"]
        share = abs(self.omega) / np.sqrt(9.81 / self.radius)
        words = [f"{1e3 * geometry['diameter']:.0f} × {1e3 * geometry['length']:.0f} mm",
                 f"{100 * speed.get('fraction_of_critical', share):.0f} % of critical ({abs(self.omega):.2f} rad/s)"]
        if self.results:
            words.append(f"{int(self.results['balls'])} balls")
        if self.flow:
            words.append(f"slurry {self.mill['slurry']['density']:.0f} kg/m³")
            unknown = "drag law not told" if self.flow.displaced else "no balls in the flow"
            words.append(f"drag: {self.law}" if self.law else unknown)
        return ", ".join(words)
