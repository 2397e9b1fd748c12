# SPDX-License-Identifier: GPL-3.0-or-later
"""Predictions of time, disk and memory of every stage of a mill's case."""
