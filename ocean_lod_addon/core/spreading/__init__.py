# SPDX-License-Identifier: GPL-3.0-or-later
"""How the energy of a frequency is spread over directions, one file per law; `table` lists them all."""
