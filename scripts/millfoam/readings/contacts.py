# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts of a dry run that wrote them (`dem.contact_interval`): relative motion, forces and powers of every contact.

Laws of force: dem_driver/README.md."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.contact_dumps import BALL_COLUMNS, PAIR_COLUMNS, WALL_COLUMNS, Materials, read_table

Table = dict[str, np.ndarray]  # of a contact dump: column -> values


@dataclass
class Contacts:
    """The contacts of one instant [m], of two balls or of a ball and the wall.

    key [m, 2]: the ball's id and the other's, the smaller first, or the ball's and -1 - the wall's number; diameters
    [m, 2] (m), the smaller first, 0 for a wall; reduced_mass (kg), the ball's own at a wall; approach: speed at which
    the centres near each other, or the ball and the wall's point (m/s); slip: speed of the surfaces past each other
    (m/s); normal, tangential: forces (N), the normal one positive where it pushes apart; overlap (m); stiffness: k of
    the normal spring's force k overlap^1.5.

    Powers that the contact takes from the balls and the drive (W): damping, of the normal damper; spring, into the
    normal spring, which returns it later; friction, of the tangential force: sliding, tangential damper and tangential
    spring; rolling, of the rolling torque. sliding: whether the tangential force is at Coulomb's limit."""
    key: np.ndarray
    diameters: np.ndarray
    reduced_mass: np.ndarray
    approach: np.ndarray
    slip: np.ndarray
    normal: np.ndarray
    tangential: np.ndarray
    overlap: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    spring: np.ndarray
    friction: np.ndarray
    rolling: np.ndarray
    sliding: np.ndarray

    def power(self) -> np.ndarray:
        """Total power [m] (W) of each contact."""
        return self.damping + self.spring + self.friction + self.rolling

    def elastic_energy(self) -> np.ndarray:
        """Energy [m] (J) of each normal spring."""
        return 2 / 5 * self.stiffness * self.overlap ** 2.5

    def normal_energy(self) -> np.ndarray:
        """Energy [m] (J) of the motion along the normal and of the spring. During the contact, damping reduces it from
        1/2 m v^2 to e^2 times this value."""
        return self.reduced_mass * self.approach ** 2 / 2 + self.elastic_energy()


def read_contacts(folder: Path | str, step: int, materials: Materials) -> tuple[Contacts, Contacts]:
    """Contacts of two balls, and of balls and the wall, at a step of a case DIR: (Contacts, Contacts)."""
    folder = Path(folder) / "contacts"
    balls, periods = read_table(folder / f"balls.{step}.txt", BALL_COLUMNS)
    order = np.argsort(balls["id"])
    balls = {key: values[order] for key, values in balls.items()}
    pairs, _ = read_table(folder / f"pairs.{step}.txt", PAIR_COLUMNS)
    walls, _ = read_table(folder / f"walls.{step}.txt", WALL_COLUMNS)
    first, second, ball = (_index(folder, step, balls["id"], ids)
                           for ids in (pairs["ball"], pairs["other"], walls["ball"]))
    return ball_contacts(balls, pairs, first, second, periods, materials), wall_contacts(balls, walls, ball, materials)


def _index(folder: Path, step: int, ids: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    index = np.minimum(np.searchsorted(ids, wanted), len(ids) - 1)
    if not np.array_equal(ids[index], wanted):
        raise RuntimeError(f"{folder}/balls.{step}.txt: no ball {wanted[ids[index] != wanted][0]:g}, which is in "
                           "contact")
    return index


def ball_contacts(balls: Table, pairs: Table, first: np.ndarray, second: np.ndarray, periods: np.ndarray,
                  materials: Materials) -> Contacts:
    """Contacts of balls `first` [m] and `second` [m] (indices into the table of balls); periods [3] (m) of the box."""
    apart = balls["position"][first] - balls["position"][second]
    turns = np.where(np.isfinite(periods), np.round(apart / np.where(np.isfinite(periods), periods, 1.0)), 0.0)
    apart = apart - turns * np.where(np.isfinite(periods), periods, 0.0)
    normal = apart / np.linalg.norm(apart, axis=1)[:, None]
    radius, other = balls["radius"][first], balls["radius"][second]
    mass = [4 / 3 * np.pi * materials.density * size ** 3 for size in (radius, other)]
    types = [balls["type"][index].astype(int) - 1 for index in (first, second)]
    spin, other_spin = balls["spin"][first], balls["spin"][second]
    arm, other_arm = radius - pairs["overlap"] / 2, other - pairs["overlap"] / 2
    move = balls["velocity"][first] - balls["velocity"][second]
    past = move - np.cross(arm[:, None] * spin + other_arm[:, None] * other_spin, normal)
    ids = np.stack([pairs["ball"], pairs["other"]], axis=1).astype(int)
    return _contacts(pairs, normal, arm, move, past, spin - other_spin, np.sort(ids, axis=1),
                     2 * np.sort(np.stack([radius, other], axis=1), axis=1), radius * other / (radius + other),
                     mass[0] * mass[1] / (mass[0] + mass[1]), types, materials)


def wall_contacts(balls: Table, walls: Table, ball: np.ndarray, materials: Materials) -> Contacts:
    """Contacts of the wall and the balls `ball` [m] (indices into the table of balls)."""
    apart = walls["centre"] - walls["point"]
    normal = apart / np.linalg.norm(apart, axis=1)[:, None]
    radius, spin = balls["radius"][ball], balls["spin"][ball]
    arm = radius - walls["overlap"] / 2
    move = balls["velocity"][ball] - walls["wall_velocity"]
    past = move - np.cross(arm[:, None] * spin, normal)
    types = balls["type"][ball].astype(int) - 1
    key = np.stack([walls["ball"], -1 - walls["mesh"]], axis=1).astype(int)
    return _contacts(walls, normal, arm, move, past, spin, key, np.stack([np.zeros_like(radius), 2 * radius], axis=1),
                     radius, 4 / 3 * np.pi * materials.density * radius ** 3,
                     [types, np.full_like(types, len(materials.youngs_modulus) - 1)], materials)


def _contacts(table: Table, normal: np.ndarray, arm: np.ndarray, move: np.ndarray, past: np.ndarray, spin: np.ndarray,
              key: np.ndarray, diameters: np.ndarray, radius: np.ndarray, mass: np.ndarray, types: Sequence[np.ndarray],
              materials: Materials) -> Contacts:
    """Contacts from the motion of the first body against the second: of the centres (`move`), of the surfaces (`past`),
    and their difference of spin (all [m, 3]); radius, mass: effective ones."""
    push = np.sum(table["force"] * normal, axis=1)
    tangential = table["force"] - push[:, None] * normal
    approach = -np.sum(move * normal, axis=1)
    past = past - np.sum(past * normal, axis=1)[:, None] * normal
    # Rolling friction is the torque minus that of the tangential force at its arm
    rolling = table["torque"] + arm[:, None] * np.cross(normal, tangential)
    first, second = types
    stiffness = 4 / 3 * np.sqrt(radius) * _modulus((1 - materials.poisson_ratio ** 2) / materials.youngs_modulus, types)
    damper = _tangential_damping(radius, mass, table["overlap"], types, materials)
    tangential, sliding = tangential_forces(tangential, past, materials.friction[first, second] * np.abs(push), damper)
    elastic = stiffness * table["overlap"] ** 1.5
    return Contacts(key, diameters, mass, approach, np.linalg.norm(past, axis=1), push,
                    np.linalg.norm(tangential, axis=1), table["overlap"], stiffness, (push - elastic) * approach,
                    elastic * approach, -np.sum(tangential * past, axis=1), -np.sum(rolling * spin, axis=1), sliding)


def tangential_forces(dumped: np.ndarray, past: np.ndarray, limit: np.ndarray,
                      damper: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tangential forces [m, 3] (N) that acted, and whether contacts slide [m], from the dumped forces.

    past [m, 3] (m/s): velocity of the surfaces past each other; limit [m] (N): Coulomb's; damper [m] (N s/m). When a
    contact slides, LIGGGHTS leaves out its damper and shortens its spring to the limit. When it computes the force
    again for the dump, the spring is within the limit and it adds the damper, so that the force is too large. This
    function subtracts the damper again. The limit itself differs by half a step between the two velocities, so that a
    spring within 2 % of it counts as sliding."""
    size = np.linalg.norm(dumped, axis=1)
    at_limit = np.abs(size - limit) <= 1e-6 * limit
    spring = np.where(at_limit[:, None], dumped, dumped + damper[:, None] * past)
    length = np.linalg.norm(spring, axis=1)
    sliding = (length > 0.98 * limit) & (length > 0)
    shortened = spring * (limit / np.where(length > 0, length, 1.0))[:, None]
    return np.where(sliding[:, None], shortened, dumped), sliding


def _modulus(compliances: np.ndarray, types: Sequence[np.ndarray]) -> np.ndarray:
    """Modulus (Pa) of two bodies in series, from the compliances of the atom types (1/Pa)."""
    return 1 / (compliances[types[0]] + compliances[types[1]])


def _tangential_damping(radius: np.ndarray, mass: np.ndarray, overlap: np.ndarray, types: Sequence[np.ndarray],
                        materials: Materials) -> np.ndarray:
    """-2 sqrt(5/6) beta sqrt(k_t m), k_t = 8 G* sqrt(R overlap), in N s/m."""
    ratio = materials.poisson_ratio
    modulus = _modulus(2 * (2 - ratio) * (1 + ratio) / materials.youngs_modulus, types)
    stiffness = 8 * np.sqrt(radius * overlap) * modulus
    loss = np.log(materials.restitution[types[0], types[1]])
    return -2 * np.sqrt(5 / 6) * loss / np.hypot(loss, np.pi) * np.sqrt(stiffness * mass)
