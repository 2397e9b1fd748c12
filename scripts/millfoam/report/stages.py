# SPDX-License-Identifier: GPL-3.0-or-later
"""The stages of a case by the files that they wrote: the mill that each belongs to, and the program that wrote it."""
from dataclasses import dataclass
from typing import Any

import h5py

from ..files.mill import PARTS
from ..files.mill_case import MillCase
from .verdict import Check
from .words import Name

NAME = "All stages belong to this mill"
# Of files in the folder in which the charge was made, and of those in the case's own: kind of JSON, what to run again
CHARGE_FILES = (("walls/walls.json", "walls", "millMesh"), ("dumps/run.json", "dumps", "millDem"),
                ("dumps/results.json", "charge", "millDem"), ("solids.json", "averages", "millAverage"))
CASE_FILES = (("mesh.json", "mesh", "millMesh"),)


@dataclass
class Stage:
    """A file of a stage: its name, the program with its version (None: not known), fingerprints part -> 16 hex digits,
    and the program that makes it again."""
    file: str
    program: str | None
    mill: dict[str, str]
    again: str


def stages(case: MillCase) -> list[Stage]:
    """Stage of each file of a MillCase that names its program or mill."""
    found = []
    for folders, files in ((case.charge_folders, CHARGE_FILES), ([case.folder], CASE_FILES)):
        for name, kind, again in files:
            path = next((folder / name for folder in folders if (folder / name).is_file()), None)
            content = case.json(path, kind) if path else None
            if content:
                found.append(Stage(name, content.get("program"), content.get("mill") or {}, again))
    for path, content in case.record.summaries:
        name, balls = str(path.relative_to(case.folder)), content.get("solids") or {}
        found.append(Stage(name, content.get("program"), content.get("mill") or {}, "the flow"))
        found.append(Stage(f"the charge in {name}", None, balls.get("mill") or {}, "the flow"))
    for path, again in ((case.solids, "millAverage"), (case.slurry, "the flow")):
        if path:
            with h5py.File(path) as file:
                head = {key: text_of(value) for key, value in file.attrs.items()}
            mill = {part: head[f"mill_{part}"] for part in PARTS if head.get(f"mill_{part}")}
            found.append(Stage(path.name, head.get("program"), mill, again))
    return found


def text_of(value: Any) -> Any:
    """An attribute of an HDF5 file: texts as text."""
    return value.decode(errors="replace") if isinstance(value, bytes) else value


def same_mill(case: MillCase) -> Check:
    """Whether the stages' files belong to mill.json's mill; unknown if no stage names a fingerprint."""
    wrong, known = [], 0
    for stage in stages(case):
        for part, fingerprint in stage.mill.items():
            mine = case.mill.fingerprint.get(part)
            if not fingerprint or not mine:
                continue
            known += 1
            if fingerprint != mine:
                wrong.append(f"{stage.file} has the fingerprint {part} {fingerprint}, mill.json has {mine}: run "
                             f"{stage.again} again")
    if wrong:
        return Check(NAME, "fails", "; ".join(wrong), "Run Allrun: it makes the stages of another mill again.")
    if not known:
        return Check(NAME, "unknown", "no stage names its mill",
                     "Run the stages again: millMesh, millDem, millAverage and slurryFoam write the name.")
    return Check(NAME, "holds", f"{known} fingerprints of the stages are those of mill.json")


def programs(case: MillCase) -> list[tuple[str, str]]:
    """(files, program and version) of the files that name them, each program once; also OpenFOAM's build and
    LIGGGHTS' version."""
    found = [("mill.json", case.mill.content.get("program"))]
    found += [(stage.file, stage.program) for stage in stages(case)]
    by_program: dict[str, list[str]] = {}
    for name, program in found:
        if program:
            by_program.setdefault(program, []).append(name)
    rows: list[tuple[str, str]] = [(Name(", ".join(names)), Name(program)) for program, names in by_program.items()]
    openfoam = case.record.last.get("openfoam") or {}
    words = [f"{key} {openfoam[key]}" for key in ("version", "patch", "build") if openfoam.get(key)]
    rows += [("OpenFOAM of the flow", Name(", ".join(words)))] if words else []
    liggghts = (case.results or {}).get("liggghts")
    return rows + ([("LIGGGHTS of the balls", Name(liggghts))] if liggghts else [])
