# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a mill: one HTML file that needs no network."""
