# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads DIR/mill.json, the resolved mill: every key of mill.yaml with its default, and every number derived from them.

The tools write it (layout: FORMATS.md). This module computes nothing."""
import json
from functools import cached_property
from pathlib import Path
from typing import Any

from .data_files import DataError, entry, number, read_json

PARTS = ("walls", "charge", "averages", "flow")  # that have a fingerprint of their own
SECTIONS = ("geometry", "speed", "charge")


class NoMill(RuntimeError):
    """A folder that is not a mill's case; the message names the missing file."""


def fnv1a(content: bytes) -> str:
    """FNV-1a hash of 64 bits of bytes, as 16 hex digits (G. Fowler, L. C. Noll, K.-P. Vo,
    www.isthe.com/chongo/tech/comp/fnv)."""
    value = 0xCBF29CE484222325
    for byte in content:
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return f"{value:016x}"


def read_mill(folder: Path | str, machine: str | None = "tumbling") -> "Mill":
    """The Mill of a case's folder; NoMill if its mill.json is missing, not JSON, of another format or incomplete, or if
    the mill is another machine (tumbling or stirred; None: any) than the reader knows."""
    path = Path(folder) / "mill.json"
    if not path.is_file():
        raise NoMill(f"{folder}: no mill.json; expected the folder of a mill's case that was run: run Allrun, or "
                     "millMesh mill.yaml --case DIR")
    try:
        content = read_json(path, "mill")
        found = entry(content, path, "derived").get("machine", "tumbling")
        if machine and found != machine:
            raise NoMill(f"{path}: the mill is {found}; expected a {machine} one")
        return Mill(path, content)
    except DataError as error:
        raise NoMill(f"{error}; run Allrun, or millMesh mill.yaml --case DIR, to write it again") from None


class Mill:
    """A resolved mill; lengths in m, angles in rad, times in s. DataError if mill.json lacks a section."""

    def __init__(self, path: Path | str, content: dict[str, Any]) -> None:
        self.path, self.content = Path(path), content
        for section in SECTIONS:
            entry(content, path, "derived", section)
            entry(content, path, "mill", section)

    def derived(self, *keys: str) -> float:
        """A derived number; NaN for null. DataError names a missing key."""
        return number(self.content, self.path, "derived", *keys)

    def asked(self, *keys: str) -> Any:
        """A key of mill.yaml with its default, or None if this mill has none."""
        try:
            return entry(self.content, self.path, "mill", *keys)
        except DataError:
            return None

    @property
    def title(self) -> str:
        """The mill's title, empty without one."""
        return self.asked("title") or ""

    @property
    def machine(self) -> str:
        """`tumbling` or `stirred`."""
        return self.content["derived"].get("machine", "tumbling")

    @property
    def fingerprint(self) -> dict[str, str]:
        """Fingerprints of its parts: walls, charge, averages, flow -> 16 hex digits."""
        return self.content.get("fingerprint") or {}

    @property
    def settings(self) -> list[str]:
        """Changes by `--set`: list of `path=value`."""
        return self.content.get("set") or []

    @cached_property
    def radius(self) -> float:
        """Inner radius of the shell, m."""
        return self.derived("geometry", "radius_m")

    @cached_property
    def length(self) -> float:
        """Length of the computed part, which may be a slice, m."""
        return self.derived("geometry", "length_m")

    @cached_property
    def whole_length(self) -> float:
        """Length of the whole mill, m."""
        return self.derived("geometry", "whole_length_m")

    @cached_property
    def is_slice(self) -> bool:
        """Whether the mill is a periodic slice."""
        return bool(entry(self.content, self.path, "derived", "geometry", "is_slice"))

    @property
    def lifters(self) -> tuple[int, float, float, float]:
        """(count, height, width of the foot, width of the top)."""
        count = int(self.derived("geometry", "lifters", "count"))
        height, width, top_width = (self.derived("geometry", "lifters", key) if count else 0.0
                                    for key in ("height_m", "width_m", "top_width_m"))
        return count, height, width, top_width

    @property
    def impeller(self) -> dict[str, Any]:
        """A stirred mill's impeller, as in `derived.geometry.impeller`; DataError without one."""
        found: dict[str, Any] = entry(self.content, self.path, "derived", "geometry", "impeller")
        return found

    @property
    def discharge_radius(self) -> float | None:
        """Radius over which pulp lifters discharge, m; None without pulp lifters."""
        found = entry(self.content, self.path, "derived", "geometry").get("pulp_lifters")
        return found["discharge_radius_m"] if found else None

    @cached_property
    def omega(self) -> float:
        """Angular speed about z, right-handed, rad/s."""
        return self.derived("speed", "angular_velocity_rad_s")

    @property
    def sense(self) -> str:
        """`clockwise` or `anticlockwise`, seen with x to the right and y up."""
        return "clockwise" if self.omega < 0 else "anticlockwise"

    @cached_property
    def turn(self) -> float:
        """Time of one turn, s."""
        return self.derived("speed", "turn_s")

    @property
    def critical_share(self) -> float:
        """Speed over the critical speed."""
        return self.derived("speed", "fraction_of_critical")

    @property
    def sauter_diameter(self) -> float:
        """Sauter diameter d32 of the charge, m."""
        return self.derived("charge", "sauter_diameter_m")

    @property
    def fines_share(self) -> float:
        """Share of the charge's mass in classes that are not simulated."""
        return self.derived("charge", "fines_share")

    @property
    def load(self) -> float:
        """Share of the mill that the bulk of the simulated charge fills."""
        return self.derived("charge", "load")

    @property
    def load_asked(self) -> float:
        """The same, with the fines that are left out."""
        return self.derived("charge", "load_asked")

    @property
    def largest_fines(self) -> float:
        """Largest diameter of a class that is not simulated."""
        classes = entry(self.content, self.path, "derived", "charge", "classes")
        return max((one["diameter_m"] for one in classes if not one["simulated"]), default=0.0)

    @property
    def ball_density(self) -> float:
        """Of the balls, kg/m3."""
        return number(entry(self.content, self.path, "derived", "materials", "ball"), self.path, "density_kg_m3")

    def slurry(self, key: str) -> float:
        """A number of the slurry: density_kg_m3, plastic_viscosity_Pa_s, yield_stress_Pa."""
        return self.derived("slurry", key)

    @property
    def viscosity_ratio(self) -> float:
        """Of the slurry's largest viscosity and the plastic one; that of a mill.json before the key is 1000."""
        slurry = entry(self.content, self.path, "derived", "slurry")
        return number(slurry, self.path, "viscosity_ratio") if "viscosity_ratio" in slurry else 1000.0

    def flow(self, key: str, default: Any = None) -> Any:
        """A derived value of the flow, or the default if the mill has none."""
        return (self.content["derived"].get("flow") or {}).get(key, default)

    @property
    def file_name(self) -> str:
        """Name of the file that this mill was read from."""
        return Path(self.content.get("file") or "mill.yaml").name

    def changed_since(self) -> bool | None:
        """Whether the file that this mill was read from, in the folder of mill.json, has changed; None if that is not
        known."""
        fingerprint, file = self.content.get("file_fingerprint"), self.path.parent / self.file_name
        if not fingerprint or not file.is_file() or file == self.path:
            return None
        return fnv1a(file.read_bytes()) != fingerprint

    def text(self) -> str:
        """The resolved mill as text for reading: keys and derived numbers, one on each line; short lists and groups on
        one line."""
        shown = {key: self.content[key] for key in ("mill", "derived")}
        return "\n".join(lines_of({"fingerprint": self.fingerprint, **shown}))


def lines_of(values: dict[str, Any], indent: str = "") -> list[str]:
    """Lines `key: value` of nested dictionaries."""
    lines = []
    for key, value in values.items():
        text = json.dumps(value, ensure_ascii=False)
        if isinstance(value, dict) and len(indent) + len(text) > 100 or isinstance(value, dict) and len(value) > 3:
            lines += [f"{indent}{key}:", *lines_of(value, indent + "  ")]
        elif isinstance(value, list) and value and len(indent) + len(text) > 100:
            lines += [f"{indent}{key}:", *(f"{indent}  - {json.dumps(one, ensure_ascii=False)}" for one in value)]
        else:
            lines.append(f"{indent}{key}: {value if isinstance(value, str) else text}")
    return lines
