# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes as code: the graph builder, one file per node group, and the material."""
