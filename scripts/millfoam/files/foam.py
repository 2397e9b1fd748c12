# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads OpenFOAM cases: times, fields and points as text or binary, the other lists of a mesh as text."""
import gzip
import re
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np


COMPONENTS = {b"scalar": 1, b"vector": 3, b"symmTensor": 6, b"tensor": 9}


class FoamError(RuntimeError):
    """A case that cannot be read; the message names the file and the reason."""


def times(case: Path | str) -> list[tuple[float, Path]]:
    """Time directories of a case, sorted: list of (time in s, Path). Those of `0.orig` kind are left out. FoamError
    where the case is not a folder."""
    if not Path(case).is_dir():
        raise FoamError(f"{case}: not a folder; expected an OpenFOAM case")
    found = []
    for entry in Path(case).iterdir():
        if entry.is_dir() and re.fullmatch(r"\d+(\.\d+)?(e-?\d+)?", entry.name):
            found.append((float(entry.name), entry))
    return sorted(found)


def is_there(path: Path | str) -> bool:
    """Whether OpenFOAM's file is there, as it is or compressed (writeCompression)."""
    return Path(path).is_file() or Path(f"{path}.gz").is_file()


def _read(path: Path | str) -> bytes:
    if Path(path).is_file():
        return Path(path).read_bytes()
    if not is_there(path):
        raise FoamError(f"{path}: no such file")
    try:
        return gzip.decompress(Path(f"{path}.gz").read_bytes())
    except (EOFError, OSError, zlib.error) as error:
        raise FoamError(f"{path}.gz: cannot be decompressed, or is cut short: {error}") from None


def _head(content: bytes) -> bytes:
    """The entries of a file's FoamFile."""
    return content.partition(b"}")[0]


def _is_binary(content: bytes) -> bool:
    return re.search(rb"format\s+binary", _head(content)) is not None


def _body(path: Path | str) -> str:
    content = _read(path)
    if _is_binary(content):
        raise FoamError(f"{path}: binary; expected format ascii")
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise FoamError(f"{path}: not UTF-8 text (byte {error.start})") from None
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def _binary_numbers(path: Path | str, content: bytes, head: re.Match, each: int) -> np.ndarray:
    """The numbers of a binary list of `each` numbers an entry, [count * each]; `head` has matched its count and opening
    bracket."""
    if b"LSB" not in _head(content) or b"scalar=64" not in _head(content):
        raise FoamError(f"{path}: binary of another machine; expected arch LSB and scalar=64")
    count = int(head.group("count"))
    end = head.end() + 8 * each * count
    if content[end:end + 1] != b")":
        raise FoamError(f"{path}: {(len(content) - head.end()) // 8} numbers for {count} entries of {each}; "
                        "the file is cut short")
    return np.frombuffer(content[head.end():end], "<f8")


def _numbers(text: str, path: Path | str) -> np.ndarray:
    try:
        return np.array(text.replace("(", " ").replace(")", " ").split(), dtype=float)
    except ValueError as error:
        raise FoamError(f"{path}: {error}") from None


def _text_field(path: Path | str, text: str, cells: int | None) -> np.ndarray:
    uniform = re.search(r"internalField\s+uniform\s+([^;]+);", text)
    if uniform:
        value = _numbers(uniform.group(1), path)
        if cells is None:
            raise FoamError(f"{path}: uniform; the number of cells is needed")
        return np.tile(value, (cells, 1)) if len(value) > 1 else np.full(cells, value[0])
    head = re.search(r"internalField\s+nonuniform\s+List<(\w+)>\s*(\d+)\s*\(", text)
    if not head:
        raise FoamError(f"{path}: no internalField was found, or it is cut short")
    count = int(head.group(2))
    end = text.find(";", head.end())
    values = _numbers(text[head.end():end], path)
    if end < 0 or count == 0 or len(values) == 0 or len(values) % count:
        raise FoamError(f"{path}: {len(values)} numbers for {count} cells; the file is cut short")
    return values if len(values) == count else values.reshape(count, -1)


def read_field(path: Path | str, cells: int | None = None) -> np.ndarray:
    """Internal field of a vol*Field: array [cells] or [cells, components].

    The file is text, or binary of 64-bit little-endian numbers. A uniform field is spread over `cells`, which must then
    be given. FoamError if the file is missing, cut short or of another kind, or if a value is not finite."""
    content = _read(path)
    if not _is_binary(content):
        field = _text_field(path, _body(path), cells)
    elif head := re.search(rb"internalField\s+nonuniform\s+List<(?P<type>\w+)>\s*(?P<count>\d+)\s*\(", content):
        if head.group("type") not in COMPONENTS:
            raise FoamError(f"{path}: binary list of {head.group('type').decode()}; expected one of "
                            f"{', '.join(map(bytes.decode, COMPONENTS))}")
        each = COMPONENTS[head.group("type")]
        field = _binary_numbers(path, content, head, each)
        field = field if each == 1 else field.reshape(-1, each)
    else:
        field = _text_field(path, content.decode("latin-1"), cells)
    if not np.all(np.isfinite(field)):
        raise FoamError(f"{path}: a value is not finite")
    return field


def _list(path: Path | str) -> tuple[int, str]:
    """Text between the outer brackets of a mesh file, and the count before it."""
    text = _body(path).partition("}")[2]
    head, end = re.search(r"(\d+)\s*\(", text), text.rfind(")")
    if not head or end < head.end():
        raise FoamError(f"{path}: no list was found, or it is cut short")
    return int(head.group(1)), text[head.end():end]


@dataclass
class Patch:
    """A boundary patch: its faces are [start, start + size)."""
    start: int
    size: int


@dataclass
class Mesh:
    """A polyMesh: points [n, 3] in m, faces as lists of point numbers, owner [faces], neighbour [internal faces]."""
    points: np.ndarray
    faces: list[np.ndarray]
    owner: np.ndarray
    neighbour: np.ndarray
    patches: dict[str, Patch]

    @property
    def cells(self) -> int:
        """Number of cells. The last one may own no face: the owner of a face is the cell of the lower number."""
        return int(max(self.owner.max(), self.neighbour.max(initial=-1))) + 1

    def centres_and_volumes(self) -> tuple[np.ndarray, np.ndarray]:
        """Cell centres [cells, 3] (m) and volumes [cells] (m^3), by the pyramids over each cell's faces."""
        centre, area = self._face_geometry()
        estimate = np.zeros((self.cells, 3))
        count = np.zeros(self.cells)
        sides = [(self.owner, 1.0, slice(None)), (self.neighbour, -1.0, slice(len(self.neighbour)))]
        for cell, _, faces in sides:
            np.add.at(estimate, cell, centre[faces])
            np.add.at(count, cell, 1)
        estimate /= count[:, None]
        volume = np.zeros(self.cells)
        moment = np.zeros((self.cells, 3))
        for cell, sign, faces in sides:
            pyramid = sign * np.einsum("ij,ij->i", area[faces], centre[faces] - estimate[cell]) / 3
            np.add.at(volume, cell, pyramid)
            np.add.at(moment, cell, pyramid[:, None] * (0.75 * centre[faces] + 0.25 * estimate[cell]))
        return moment / volume[:, None], volume

    def _face_geometry(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres [faces, 3] (m) and area vectors [faces, 3] (m^2): faces with equally many corners are taken
        together."""
        centre, area = np.empty((len(self.faces), 3)), np.empty((len(self.faces), 3))
        counts = np.array([len(face) for face in self.faces])
        for count in np.unique(counts):
            chosen = np.flatnonzero(counts == count)
            corner = self.points[np.array([self.faces[face] for face in chosen])]
            middle = corner.mean(axis=1, keepdims=True)
            after = np.roll(corner, -1, axis=1)
            normal = np.cross(corner - middle, after - middle) / 2
            third = (corner + after + middle) / 3
            size = np.linalg.norm(normal, axis=2, keepdims=True)
            centre[chosen] = (third * size).sum(axis=1) / size.sum(axis=1)
            area[chosen] = normal.sum(axis=1)
        return centre, area


def read_mesh(case: Path | str, time: Path | str | None = None) -> Mesh:
    """Mesh of a case; with the moved points of time directory `time` (a Path) where it has them."""
    folder = Path(case) / "constant" / "polyMesh"
    moved = Path(time) / "polyMesh" / "points" if time else None
    points = _points(moved if moved and is_there(moved) else folder / "points")
    count, text = _list(folder / "faces")
    faces = [np.array(found.split(), dtype=int) for found in re.findall(r"\d+\(([\d\s]*)\)", text)]
    if len(faces) != count:
        raise FoamError(f"{folder / 'faces'}: {len(faces)} faces for a count of {count}")
    owner, neighbour = (_numbers_of(folder / name).astype(int) for name in ("owner", "neighbour"))
    return Mesh(points, faces, owner, neighbour, read_patches(folder / "boundary"))


def _points(path: Path) -> np.ndarray:
    content = _read(path)
    if not _is_binary(content):
        return _numbers_of(path, 3).reshape(-1, 3)
    head = re.search(rb"\}[^(]*?(?P<count>\d+)\s*\(", content)
    if not head:
        raise FoamError(f"{path}: no list was found, or it is cut short")
    return _binary_numbers(path, content, head, 3).reshape(-1, 3)


def _numbers_of(path: Path | str, each: int = 1) -> np.ndarray:
    """The numbers of a mesh file's list with so many of them in an entry; FoamError where some are missing."""
    count, text = _list(path)
    values = _numbers(text, path)
    if len(values) != each * count:
        raise FoamError(f"{path}: {len(values)} numbers for {count} entries; the file is cut short")
    return values


def read_patches(path: Path | str) -> dict[str, Patch]:
    """Patches of a polyMesh/boundary file: name -> Patch; FoamError where some are missing."""
    count, text = _list(path)
    patches = {}
    for name, entries in re.findall(r"(\w+)\s*\{([^{}]*startFace[^{}]*)\}", text):
        start, size = (re.search(rf"{key}\s+(\d+)", entries) for key in ("startFace", "nFaces"))
        if not start or not size:
            raise FoamError(f"{path}: patch {name} lacks startFace or nFaces")
        patches[name] = Patch(int(start.group(1)), int(size.group(1)))
    if len(patches) != count:
        raise FoamError(f"{path}: {len(patches)} patches for a count of {count}; the file is cut short")
    return patches


def read_dictionary(path: Path | str) -> dict[str, str]:
    """Flat `key value;` entries of a dictionary file: name -> text; sub-dictionaries are left out."""
    text = re.sub(r"FoamFile\s*\{[^}]*\}", "", _body(path))
    return dict(re.findall(r"^\s*(\w+)\s+([^;{}]+);", text, flags=re.M))
