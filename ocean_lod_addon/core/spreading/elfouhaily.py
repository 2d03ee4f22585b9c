# SPDX-License-Identifier: GPL-3.0-or-later
"""Elfouhaily et al. 1997, Eqs. 49 and 57: the spreading law of their unified spectrum."""

import numpy as np

from ..dispersion import Water, wavenumber
from ..spectra.elfouhaily import upwind_crosswind_ratio
from .double_angle import DoubleAngleSpreading


def elfouhaily_spreading(wind_speed: float, peak_frequency: float, water: Water) -> DoubleAngleSpreading:
    """D = [1 + Delta cos 2 theta] / pi for |theta| <= pi/2; U10 in m/s, rad/s.

    Their law is symmetric up- and downwind because a still picture cannot tell the two apart. A sea in motion
    needs the side: all of it is downwind here, with the same slope variances.
    """
    peak_wavenumber = float(wavenumber(peak_frequency, water))

    def coefficients(omega):
        delta = upwind_crosswind_ratio(wavenumber(omega, water), wind_speed, peak_wavenumber)
        return delta, np.zeros_like(delta)

    return DoubleAngleSpreading(coefficients, 0.5 * np.pi)
