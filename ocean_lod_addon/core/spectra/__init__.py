# SPDX-License-Identifier: GPL-3.0-or-later
"""Omnidirectional wave spectra, one file per family; `table` lists them all."""
