# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks on rendered pictures of the sea: `python -m tools.sea_checks --help`."""
