# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers of the files that millFoam's stages leave. They use no other part of this package."""
