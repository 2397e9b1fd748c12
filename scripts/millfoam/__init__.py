# SPDX-License-Identifier: GPL-3.0-or-later
"""What millFoam's stages leave: readers (files), readings, plots, the report, and the plan of a run."""
