# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a frame takes, before it is computed: work counted, time predicted, quality chosen by it."""
