# SPDX-License-Identifier: GPL-3.0-or-later
"""Coupling of balls and slurry by passes: forces of a flow for the next run of the balls, and whether the passes still
change."""
