# SPDX-License-Identifier: GPL-3.0-or-later
"""Which room may include or import what, and a walk over a source tree that lists what may not be: borders that are
crossed, cycles of folders and of Python modules, scripts that name a case."""
import re
from pathlib import Path

from import_graph import Modules, cycles, folders, includes, python_files, sources

PACKAGE = "scripts/millfoam"
FILES, READINGS, PLOTS, COUPLING, REPORT, PLAN = (
    f"{PACKAGE}/{part}" for part in ("files", "readings", "plots", "coupling", "report", "plan"))
WHOLE_PACKAGE = {PACKAGE, FILES, READINGS, PLOTS, COUPLING, REPORT, PLAN}
# Room (folder, the longest match counts) -> rooms that its sources may use besides itself.
MAY_USE = {
    "meshing/files": set(),
    "meshing/surface": {"meshing/files"},
    "meshing": {"meshing/files", "meshing/surface",
                "openfoam_module/drag"},  # names of the laws, which are only in its table; usual viscosities
    # A flow's file, out of which balls take their forces; the drag of each shape
    "dem_driver": {"averaging", "meshing", "meshing/files", "meshing/surface", "openfoam_module/drag"},
    # millDem takes the options of millAverage
    "dem_driver/tools": {"dem_driver", "averaging", "averaging/tools", "meshing", "meshing/files", "meshing/surface"},
    "averaging": {"meshing/files", "meshing/surface"},
    # The tool reads a mill's section; the library does not depend on mills
    "averaging/tools": {"averaging", "meshing", "meshing/files", "meshing/surface"},
    "openfoam_module/drag": set(),
    "openfoam_module/drag/tools": {"openfoam_module/drag", "meshing/files"},
    "openfoam_module": {"openfoam_module/drag", "averaging"},
    "scripts": set(),
    PACKAGE: set(),
    FILES: set(),
    READINGS: {FILES},
    PLOTS: {FILES, READINGS},
    COUPLING: {FILES, READINGS},
    REPORT: {FILES, READINGS, PLOTS, COUPLING},
    PLAN: {FILES, PACKAGE},
    "cases/mills": WHOLE_PACKAGE,
    "cases/studies": WHOLE_PACKAGE,
    "cases/verification": WHOLE_PACKAGE,
}
# Headers without a dot are the standard library's; a tool may also read its options.
STANDARD_LIBRARY_ONLY = "openfoam_module/drag"
OPTIONS_OF_TOOLS = ("CLI/CLI.hpp", "millfoam_version.hpp")

CPP_FOLDERS = ("meshing", "dem_driver", "averaging", "openfoam_module", "tests")
PYTHON_FOLDERS = ("scripts", "cases", "tests")
PURE = {".hpp", ".cpp"}


def room_of(path):
    """The room of a path relative to the root, or None outside the rooms (tests)."""
    found = [room for room in MAY_USE if Path(room) in Path(path).parents]
    return max(found, key=len, default=None)


def violations(root):
    """Sentences, one for each include, import or name (also of OpenFOAM) in the tree that crosses a border the wrong
    way, and for each cycle of folders or modules."""
    root = Path(root).resolve()
    cpp, python = cpp_graph(root), python_graph(root)
    result = [sentence for file in cpp for sentence in _check_cpp(root, file)]
    result += [sentence for file, others in python.items() for sentence in _check_python(file, others)]
    result += [_folder_sentence(found, graph) for graph in (cpp, python) for found in folder_cycles(graph)]
    result += [f"{', '.join(sorted(map(str, found)))}: modules import each other" for found in cycles(python)]
    return result + [sentence for file in sorted((root / "scripts").rglob("*"))
                     for sentence in _cases_named(root, file)]


def cpp_graph(root):
    """Which C++ source of a tree (a resolved path) includes which: {file: files}, relative paths."""
    return {file: {place for _, place in includes(root, file) if place} for file in sources(root, *CPP_FOLDERS)}


def python_graph(root):
    """Which Python file of a tree imports which: {file: files}, relative paths."""
    files = python_files(root, *PYTHON_FOLDERS)
    modules = Modules(root, files)
    return {file: modules.imports(file) for file in files}


def folder_cycles(graph):
    """Sets of folders (names) of a graph of files that use each other."""
    return [set(map(str, found)) for found in cycles(folders(graph))]


def _folder_sentence(found, graph):
    """Of folders that use each other, with an example of each way."""
    ways = (f"{file} uses {other}" for folder, others in folders(graph).items() if str(folder) in found
            for goal, (file, other) in others.items() if str(goal) in found)
    return f"{', '.join(sorted(found))}: folders use each other: {'; '.join(ways)}"


def _check_cpp(root, file):
    room = room_of(file)
    for include, place in includes(root, file):
        reason = _reason(file, room, include, place)
        if reason:
            yield f"{file}: includes {include}: {reason}"
    if file.suffix in PURE and re.search(r"\bFoam::", (root / file).read_text()):
        yield f"{file}: names Foam::, which only .H and .C may know"


def _reason(file, room, include, place):
    """Why this file may not include that, or None."""
    if file.suffix in PURE and Path(include).suffix in {".H", ".C"}:
        return "only .H and .C may include OpenFOAM"
    if room is None:
        return None
    # Not there (yet), or found through another include folder: the name still shows the room
    other = room_of(place or include)
    if other is not None and other != room and other not in MAY_USE[room]:
        return f"{room} must not know {other}"
    if room == STANDARD_LIBRARY_ONLY and other is None and "." in include:
        if not (include in OPTIONS_OF_TOOLS and file.parent.name == "tools"):
            return f"{room} may use the standard library only"
    return None


def _check_python(file, others):
    room = room_of(file)
    for other in sorted(others) if room else ():
        theirs = room_of(other)
        if theirs != room and theirs not in MAY_USE[room]:
            yield f"{file}: imports {other}: {room} must not know {theirs or other.parent}"


def _cases_named(root, file):
    """A sentence for each case that a file of the scripts names; pages for people may."""
    if not file.is_file() or file.suffix in (".md", ".pyc"):
        return
    names = {path.name for path in root.glob("cases/*/*") if path.is_dir() and "_" in path.name}
    found = set(re.findall(r"cases/\w+/\w+", file.read_text())) | names & set(re.findall(r"\w+", file.read_text()))
    for name in sorted(found):
        yield f"{file.relative_to(root)}: names {name}: scripts must not know cases"
