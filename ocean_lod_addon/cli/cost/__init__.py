# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs in time: the knobs, whole configurations, and a model that predicts their time."""
