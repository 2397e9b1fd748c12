#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields and points of an OpenFOAM case: text and binary give the same numbers; a damaged file is refused."""
import gzip
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files import foam

HEAD = """FoamFile
{{
    version     2.0;
    format      {form};
    arch        "LSB;label=32;scalar={scalar}";
    class       {kind};
    object      {name};
}}
// * * * * //

"""
VECTORS = np.array([[1 / 3, -2.5e-300, 7], [0, 40.5, 123456789.125], np.frombuffer(b";)(\n" * 6)])


def binary_field(values, kind="vector", scalar=64, before_end=b""):
    """A field as the solver writes it in binary; some bytes are the characters ; ( ) as well."""
    return (HEAD.format(form="binary", scalar=scalar, kind="volField", name="U").encode()
            + f"internalField   nonuniform List<{kind}> \n{len(values)}\n(".encode()
            + np.asarray(values, "<f8").tobytes() + before_end
            + b")\n;\n\nboundaryField\n{\n    shell\n    {\n        type zeroGradient;\n    }\n}\n")


class Fields(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "U"

    def written(self, content):
        self.path.write_bytes(content)
        return self.path

    def refusal(self, content):
        with self.assertRaises(foam.FoamError) as refused:
            foam.read_field(self.written(content), 3)
        return str(refused.exception)

    def test_binary_and_text_are_the_same(self):
        text = HEAD.format(form="ascii", scalar=64, kind="volVectorField", name="U") + "internalField nonuniform " \
            "List<vector>\n3\n(\n" + "\n".join(f"({a!r} {b!r} {c!r})" for a, b, c in VECTORS.tolist()) + "\n)\n;\n"
        np.testing.assert_array_equal(foam.read_field(self.written(text.encode())), VECTORS)
        np.testing.assert_array_equal(foam.read_field(self.written(binary_field(VECTORS))), VECTORS)
        scalars = VECTORS[:, 0]
        np.testing.assert_array_equal(foam.read_field(self.written(binary_field(scalars, "scalar"))), scalars)

    def test_uniform_in_a_binary_file(self):
        head = HEAD.format(form="binary", scalar=64, kind="volScalarField", name="p")
        content = (head + "internalField uniform 2.5;\n").encode()
        np.testing.assert_array_equal(foam.read_field(self.written(content), 3), [2.5] * 3)

    def test_compressed_files_are_read(self):
        packed = gzip.compress(binary_field(VECTORS))
        place = self.path.with_name("U.gz")
        self.assertFalse(foam.is_there(self.path))
        place.write_bytes(packed)
        self.assertTrue(foam.is_there(self.path))
        np.testing.assert_array_equal(foam.read_field(self.path), VECTORS)
        place.write_bytes(packed[:-20])
        with self.assertRaisesRegex(foam.FoamError, r"U.gz: cannot be decompressed, or is cut short"):
            foam.read_field(self.path)

    def test_damaged_binary_is_refused(self):
        whole = binary_field(VECTORS)
        self.assertIn("U: 6 numbers for 3 entries of 3; the file is cut short",
                      self.refusal(whole[:whole.index(b"(") + 1 + 50]))
        self.assertIn("no internalField was found, or it is cut short", self.refusal(whole[:whole.index(b"List")]))
        self.assertIn("cut short", self.refusal(binary_field(VECTORS, before_end=b"12345678")))
        self.assertIn("expected arch LSB and scalar=64", self.refusal(binary_field(VECTORS, scalar=32)))
        self.assertIn("binary list of sphericalTensor; expected one of scalar, vector",
                      self.refusal(binary_field(VECTORS, "sphericalTensor")))
        self.assertIn("a value is not finite", self.refusal(binary_field(VECTORS * np.nan)))

    def test_points(self):
        mesh = self.path.parent / "constant" / "polyMesh"
        mesh.mkdir(parents=True)
        lists = {"faces": "4\n(\n3(0 2 1)\n3(0 1 3)\n3(1 2 3)\n3(0 3 2)\n)\n", "owner": "4\n(\n0\n0\n0\n0\n)\n",
                 "neighbour": "0\n(\n)\n", "boundary": "1\n(\nwall { type wall; nFaces 4; startFace 0; }\n)\n",
                 "points": "4\n(\n(0 0 0)\n(1 0 0)\n(0 1 0)\n(0 0 1)\n)\n"}
        for name, text in lists.items():
            (mesh / name).write_text(HEAD.format(form="ascii", scalar=64, kind="list", name=name) + text)
        moved = self.path.parent / "0.5"
        (moved / "polyMesh").mkdir(parents=True)
        points = 2 * foam.read_mesh(self.path.parent).points
        (moved / "polyMesh" / "points").write_bytes(
            HEAD.format(form="binary", scalar=64, kind="vectorField", name="points").encode() + b"\n4\n("
            + points.tobytes() + b")\n")
        with self.assertRaisesRegex(foam.FoamError, "faces: binary; expected format ascii"):
            faces = mesh / "faces"
            faces.write_text(faces.read_text().replace("ascii", "binary"))
            foam.read_mesh(self.path.parent, moved)
        faces.write_text(faces.read_text().replace("binary", "ascii"))
        turned = foam.read_mesh(self.path.parent, moved)
        np.testing.assert_array_equal(turned.points, points)
        self.assertAlmostEqual(turned.centres_and_volumes()[1][0], 8 / 6)


if __name__ == "__main__":
    unittest.main()
