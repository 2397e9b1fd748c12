# SPDX-License-Identifier: GPL-3.0-or-later
"""Which room may include what, and a walk over a source tree that lists every include that may not be."""
import re
from pathlib import Path

# Room (folder, the longest match counts) -> rooms that its sources may include besides itself.
MAY_USE = {
    "meshing/files": set(),
    "meshing/surface": {"meshing/files"},
    "meshing": {"meshing/files", "meshing/surface",
                "openfoam_module/drag"},  # the names of the laws, which stand in its table alone
    "dem_driver": {"meshing", "meshing/files", "meshing/surface"},
    "averaging": {"meshing/files", "meshing/surface"},
    # The tool reads a mill's section; the library knows no mills
    "averaging/tools": {"averaging", "meshing", "meshing/files", "meshing/surface"},
    "openfoam_module/drag": set(),
    "openfoam_module": {"openfoam_module/drag", "averaging"},
}
# Headers without a dot are the standard library's; a tool may also read its options.
STANDARD_LIBRARY_ONLY = "openfoam_module/drag"
OPTIONS_OF_TOOLS = ("CLI/CLI.hpp", "millfoam_version.hpp")

SOURCES = {".hpp", ".cpp", ".H", ".C"}
PURE = {".hpp", ".cpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


def room_of(path):
    """The room of a path relative to the root, or None outside the rooms (tests, cases)."""
    found = [room for room in MAY_USE if Path(room) in Path(path).parents]
    return max(found, key=len, default=None)


def violations(root):
    """Sentences, one for each include (or use of OpenFOAM) in the tree that crosses a border the wrong way."""
    root = Path(root).resolve()
    result = []
    for top in ("meshing", "dem_driver", "averaging", "openfoam_module", "tests"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix in SOURCES:
                result += _check(root, file)
    return result


def _check(root, file):
    here = file.relative_to(root)
    room = room_of(here)
    text = file.read_text()
    for include in INCLUDE.findall(text):
        reason = _reason(root, file, room, include)
        if reason:
            yield f"{here}: includes {include}: {reason}"
    if file.suffix in PURE and re.search(r"\bFoam::", text):
        yield f"{here}: names Foam::, which only .H and .C may know"


def _reason(root, file, room, include):
    """Why this file may not include that, or None."""
    if file.suffix in PURE and Path(include).suffix in {".H", ".C"}:
        return "only .H and .C may include OpenFOAM"
    if room is None:
        return None
    other = _included_room(root, file, include)
    if other is not None and other != room and other not in MAY_USE[room]:
        return f"{room} must not know {other}"
    if room == STANDARD_LIBRARY_ONLY and other is None and "." in include:
        if not (include in OPTIONS_OF_TOOLS and file.parent.name == "tools"):
            return f"{room} may use the standard library only"
    return None


def _included_room(root, file, include):
    """The room that an include names, from the root or relative to the file; None for other headers."""
    for base in (root, file.parent):
        target = (base / include).resolve()
        if target.is_file() and root in target.parents:
            return room_of(target.relative_to(root))
    # Not there (yet), or found through another include folder: the name still tells
    return room_of(include)
