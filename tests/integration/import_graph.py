# SPDX-License-Identifier: GPL-3.0-or-later
"""Which file of a source tree includes or imports which, and the cycles of such a graph."""
import ast
import re
from collections import defaultdict
from pathlib import Path

FOAM_SOURCES = {".H", ".C"}
SOURCES = {".hpp", ".cpp", *FOAM_SOURCES}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
PACKAGES = ("scripts", "cases/studies")  # folders of packages, which are on Python's path
FOAM = "openfoam_module/foam"  # its folders are on the compiler's path, as is OpenFOAM's way


def sources(root, *tops):
    """C++ sources (relative paths) below the folders `tops` of a tree, sorted."""
    return [path.relative_to(root) for top in tops for path in sorted((root / top).rglob("*"))
            if path.suffix in SOURCES]


def includes(root, file):
    """[(name, file that it means, or None for headers from elsewhere)] of a C++ source; paths are relative to the
    root."""
    found = []
    foam = {header.name: header.parent for header in (root / FOAM).glob("*/*.H")} if file.suffix in FOAM_SOURCES else {}
    for name in INCLUDE.findall((root / file).read_text()):
        bases = (root, (root / file).parent, *filter(None, [foam.get(name)]))
        places = ((base / name).resolve() for base in bases)
        place = next((place for place in places if place.is_file() and root in place.parents), None)
        found.append((name, place.relative_to(root) if place else None))
    return found


def python_files(root, *tops):
    """Python files (relative paths) below the folders `tops` of a tree, sorted."""
    return [path.relative_to(root) for top in tops for path in sorted((root / top).rglob("*.py"))]


class Modules:
    """Finds the files of Python's imports: in the file's folder, in PACKAGES, or anywhere if only one file has the
    name."""

    def __init__(self, root, files):
        self.root, self.by_name = root, defaultdict(list)
        for file in files:
            self.by_name[file.stem].append(file.parent)

    def imports(self, file):
        """Files (relative paths) of the tree that a file imports, anywhere in it."""
        found = set()
        for node in ast.walk(ast.parse((self.root / file).read_text())):
            if isinstance(node, ast.Import):
                found |= {self._module(self._base(file, alias.name), alias.name) for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                base = [file.parent, *file.parents[1:]][node.level - 1] if node.level else self._base(file, node.module)
                for alias in node.names:
                    longer = ".".join(filter(None, (node.module, alias.name)))
                    found.add(self._module(base, longer) or self._module(base, node.module or ""))
        return found - {None, file}

    def _base(self, file, name):
        """Folder that an absolute import begins from, or None for a package from elsewhere."""
        first = name.split(".")[0]
        alone = self.by_name[first] if len(self.by_name[first]) == 1 else []
        places = (file.parent, *map(Path, PACKAGES), *alone)
        return next((place for place in places if self._module(place, first)), None)

    def _module(self, base, name):
        """File of a module `a.b` below a folder, a package's __init__.py, or None."""
        if base is None:
            return None
        place = base / name.replace(".", "/")
        return next((path for path in (place.with_suffix(".py") if name else place, place / "__init__.py")
                     if (self.root / path).is_file()), None)


def folders(graph):
    """The graph of the folders of a graph of files: {folder: {other folder: (file, file), an example}}."""
    found = defaultdict(dict)
    for file, others in graph.items():
        for other in others:
            if other.parent != file.parent:
                found[file.parent].setdefault(other.parent, (file, other))
    return dict(found)


def cycles(graph):
    """Sets of two nodes or more of a graph {node: nodes} that all lead to each other, by R. Tarjan, SIAM J. Comput. 1
    (1972) 146."""
    index, lowest, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = lowest[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                lowest[node] = min(lowest[node], lowest[other])
            elif other in stack:
                lowest[node] = min(lowest[node], index[other])
        if lowest[node] == index[node]:
            place = stack.index(node)
            if len(stack) - place > 1:
                found.append(set(stack[place:]))
            del stack[place:]

    for node in graph:
        if node not in index:
            visit(node)
    return found
