# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers and plots for what millFoam's stages write."""
