# SPDX-License-Identifier: GPL-3.0-or-later
"""The standardised two-parameter spectra: ISSC 1964 (T1), ITTC 1978 (Tz), Bretschneider 1959 (Tp).

One form, S = (Hs^2 B / 4) omega^-5 exp(-B omega^-4), with B from whichever period is known. THEORY section 3.
"""

import math

from .pierson_moskowitz import ExponentialFifth


def decay_from_mean_period(period: float) -> float:
    """ISSC: B = (2 pi / (Gamma(3/4) T1))^4 in s^-4, from the mean period T1 in s."""
    return (2.0 * math.pi / (math.gamma(0.75) * period)) ** 4


def decay_from_zero_crossing_period(period: float) -> float:
    """ITTC: B = 16 pi^3 / Tz^4 in s^-4, from the zero-crossing period Tz in s."""
    return 16.0 * math.pi**3 / period**4


def decay_from_peak_period(period: float) -> float:
    """Bretschneider: B = (5/4) (2 pi / Tp)^4 in s^-4, from the peak period Tp in s."""
    return 1.25 * (2.0 * math.pi / period) ** 4


DECAY_FROM_PERIOD = {
    "mean": decay_from_mean_period,
    "zero_crossing": decay_from_zero_crossing_period,
    "peak": decay_from_peak_period,
}


def two_parameter(significant_wave_height: float, decay: float) -> ExponentialFifth:
    """The spectrum of this height in m and decay B in s^-4."""
    return ExponentialFifth(0.25 * significant_wave_height**2 * decay, decay)
