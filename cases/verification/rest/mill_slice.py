# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of the 12 cm mill's periodic slice, on which slurry and a pool rest."""
from pathlib import Path

MILL = Path(__file__).resolve().parents[2] / "mills" / "mill_12cm" / "mill.yaml"
FINE = ("resolution.cell_size=0.003", "resolution.layers=20")  # of the whole mill; its own are coarser
