# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of the energy of a charge's contacts: collisions and dissipated power, by class of balls and by energy.

Limits by the interval between the contacts' dumps: a contact is a collision if its pair was not in touch at the dump
before. Pairs that separate and touch again within an interval count once. A touch shorter than the interval is in a
dump with the probability duration / interval. So a touch that is not in the next dump counts interval / duration times,
with the duration of a Hertz contact of its energy. The energy is that at the dump: between the energy at first touch
and, at the end of the touch, e^2 of it. Powers need no weights: they are means over the dumps, in which every
contact appears in proportion to its duration."""
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..files.contact_dumps import contact_interval, contact_steps, read_materials
from ..files.dumps import read_timestep
from .contacts import Contacts, read_contacts

HERTZ_DURATION = 2.943  # of a contact, over its largest overlap / its speed at first touch
PARTS = ("damping", "friction", "rolling", "spring")


@dataclass
class Spectra:
    """edges [n] (J): bins of energy are below the first, between two, and above the last, so that all are counted.

    classes: diameters (m), ascending, the first 0 for the wall; collisions [c, c, n + 1] (1/s): of a ball of class i <=
    j with one of class j, by energy at first touch; power: {part: [c, c, n + 1]} (W) by the energy of the relative
    motion at the contact, 1/2 m* (approach^2 + slip^2): damping, of the normal dampers; friction, of the tangential
    forces, by sliding and tangential damping, and of the tangential springs; rolling, of rolling
    friction; spring, into the normal springs, whose mean over a long time is zero. sliding: share of the friction at
    contacts at Coulomb's limit. dumps: their number; interval (s): between them."""
    edges: np.ndarray
    classes: np.ndarray
    collisions: np.ndarray
    power: dict[str, np.ndarray]
    sliding: float
    dumps: int
    interval: float

    def dissipation(self) -> np.ndarray:
        """Power [c, c, n + 1] (W) of damping, friction and rolling friction."""
        return np.asarray(sum(self.power[part] for part in PARTS if part != "spring"))

    def total_power(self) -> float:
        """Power of all contacts, springs included, W: in a steady state it is the drive's power."""
        return float(sum(self.power[part].sum() for part in PARTS))


def energy_edges(lowest: float = 1e-12, highest: float = 1e-2, per_decade: int = 5) -> np.ndarray:
    """Edges of bins equally wide in the logarithm of energy, J."""
    return np.logspace(np.log10(lowest), np.log10(highest), round(np.log10(highest / lowest) * per_decade) + 1)


def read_spectra(folder: Path | str, begin: float = 0.0, end: float = np.inf,
                 edges: ArrayLike | None = None) -> Spectra:
    """Spectra of the contacts that a run wrote into DIR/contacts from `begin` to `end` (DEM time, s); folder: DIR.

    RuntimeError for fewer than three dumps in that time."""
    edges = energy_edges() if edges is None else np.asarray(edges, dtype=float)
    materials, interval = read_materials(Path(folder) / "dem" / "in.mill"), contact_interval(folder)
    timestep = read_timestep(Path(folder) / "dumps")
    steps = [step for step in contact_steps(folder) if begin - timestep / 2 <= step * timestep <= end + timestep / 2]
    if len(steps) < 3:
        raise RuntimeError(f"{folder}/contacts: {len(steps)} dumps from {begin} to {end} s, expected 3 or more")
    return spectra((read_contacts(folder, step, materials) for step in steps), interval, edges)


def spectra(records: Iterable[tuple[Contacts, Contacts]], interval: float, edges: np.ndarray) -> Spectra:
    """Spectra of successive records, pairs (Contacts of balls, Contacts at walls) `interval` (s) apart."""
    collected: dict[tuple, np.ndarray] = {}
    window: list[tuple[Contacts, Contacts]] = []
    sliding, dumps = 0.0, 0
    for record in records:
        dumps += 1
        window = [*window[-2:], record]
        for kind, contacts in enumerate(record):
            motion = contacts.reduced_mass * (contacts.approach ** 2 + contacts.slip ** 2) / 2
            sliding += contacts.friction[contacts.sliding].sum()
            _collect(collected, contacts, motion, {part: getattr(contacts, part) for part in PARTS}, edges)
            if len(window) == 3:
                _collect_collisions(collected, [moment[kind] for moment in window], interval, edges)
    classes = np.unique(np.array([0.0] + [diameter for _, *pair in collected for diameter in pair]))
    fields = {part: np.zeros((len(classes), len(classes), len(edges) + 1)) for part in (*PARTS, "collisions")}
    for (part, first, second), counts in collected.items():
        records_counted = (dumps - 2) * interval if part == "collisions" else dumps
        fields[part][np.searchsorted(classes, first), np.searchsorted(classes, second)] = counts / records_counted
    collisions, friction = fields.pop("collisions"), fields["friction"].sum() * dumps
    return Spectra(edges, classes, collisions, fields, float(sliding / friction) if friction else np.nan, dumps,
                   interval)


def _collect(collected: dict[tuple, np.ndarray], contacts: Contacts, energy: np.ndarray, weights: dict[str, np.ndarray],
             edges: np.ndarray) -> None:
    """Adds weights {part: [m]} to the bins of energy [m] of their classes: collected[part, diameter, diameter]."""
    # To a nanometre: the dumps' radii carry nine digits
    nanometres = np.rint(1e9 * contacts.diameters).astype(np.int64)
    pairs = nanometres[:, 0] * (1 << 31) + nanometres[:, 1]
    bins = np.searchsorted(edges, energy, side="right")
    for pair in np.unique(pairs):
        chosen = np.flatnonzero(pairs == pair)
        diameters = nanometres[chosen[0]] / 1e9
        for part, weight in weights.items():
            key = (part, *map(float, diameters))
            collected[key] = collected.get(key, 0.0) + np.bincount(bins[chosen], weight[chosen], len(edges) + 1)


def _collect_collisions(collected: dict[tuple, np.ndarray], window: Sequence[Contacts], interval: float,
                        edges: np.ndarray) -> None:
    """Contacts of the middle one of three moments that the first did not have, weighted as the sampling asks."""
    before, now, after = (_codes(contacts.key) for contacts in window)
    new = np.flatnonzero(~np.isin(now, before))
    # A ball can touch two triangles of one wall
    new = new[np.unique(now[new], return_index=True)[1]]
    contacts = window[1]
    energy = contacts.normal_energy()
    brief = ~np.isin(now, after)
    duration = hertz_duration(contacts.reduced_mass, contacts.stiffness, energy)
    weight = np.where(brief, np.maximum(1.0, interval / duration), 1.0)
    chosen = np.zeros(len(now), dtype=bool)
    chosen[new] = True
    _collect(collected, contacts, energy, {"collisions": np.where(chosen, weight, 0.0)}, edges)


def _codes(key: np.ndarray) -> np.ndarray:
    """One number for each pair of ids."""
    return key[:, 0] * (1 << 32) + key[:, 1]


def hertz_duration(mass: np.ndarray, stiffness: np.ndarray, energy: np.ndarray) -> np.ndarray:
    """Duration (s) of an undamped Hertz contact with the force stiffness x overlap^1.5 (N/m^1.5), from its reduced mass
    (kg) and energy (J): 2.943 d / v with the largest overlap d = (5 energy / (2 stiffness))^(2/5) and v = sqrt(2 energy
    / mass)."""
    return HERTZ_DURATION * (2.5 * energy / stiffness) ** 0.4 / np.sqrt(2 * energy / mass)


def power_to_dissipate(folder: Path | str, begin: float = 0.0, end: float = np.inf) -> float:
    """Mean of the drive's power in DIR/dumps/energy.csv from `begin` to `end` (s) minus the gain of the charge's
    kinetic energy of translation and potential energy, W. The contacts take this power, except for the small energy of
    spin."""
    table: Any = np.genfromtxt(Path(folder) / "dumps" / "energy.csv", delimiter=",", names=True)
    table = table[(table["time_s"] >= begin) & (table["time_s"] <= end)]
    if len(table) < 2:
        raise RuntimeError(f"{folder}/dumps/energy.csv: {len(table)} records from {begin} to {end} s, expected 2 or "
                           "more")
    stored = table["kinetic_J"] + table["potential_J"]
    # The power of a record is the mean over the time before it
    return float(table["power_W"][1:].mean() - (stored[-1] - stored[0]) / (table["time_s"][-1] - table["time_s"][0]))
