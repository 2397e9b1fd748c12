# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the scripts of studies and verification cases for their tests."""
import importlib.util
import sys
from pathlib import Path

CASES = Path(__file__).resolve().parents[2] / "cases"


def load(path, name=None):
    """A script in cases/ as a module, by its path there; name: of the module, that of the file by default."""
    path = CASES / path
    name = name or path.stem
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # where dataclasses look their module up
    spec.loader.exec_module(module)
    return module
