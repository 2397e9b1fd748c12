#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""plane_cut_test.py PROGRAM: runs plane_cut_test on the mesh of a box."""
import sys
import tempfile

from slurry_case import SlurryCase


def main():
    with tempfile.TemporaryDirectory(prefix="millfoam_test_") as folder:
        case = SlurryCase(folder, upper=(0.05, 0.04, 0.03), cells=(5, 4, 3))
        for program in ("blockMesh", sys.argv[1]):
            result = case.run(program)
            print(result.tail())
            if result.code:
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
