# SPDX-License-Identifier: GPL-3.0-or-later
"""The colour of water: absorption and backscattering of what is in it, and the light that comes back out.

All spectra are per metre on `WAVELENGTHS`. Water is described by three numbers (`WaterContents`): chlorophyll
with everything that varies with it in the open sea, dissolved humic matter, and suspended minerals.
"""

from dataclasses import dataclass

import numpy as np

from .color import daylight_sensitivity

WAVELENGTHS = np.arange(400.0, 701.0, 10.0)
"""Where the spectra are given, nm."""

WATER_ABSORPTION = np.array(
    [
        663, 473, 454, 495, 635, 922, 979, 1060, 1270, 1500, 2040, 3250, 4090, 4340, 4740, 5650, 6190, 6950,
        8960, 13510, 22240, 26440, 27550, 29160, 31080, 34000, 41000, 43900, 46500, 51600, 62400,
    ]
) * 1e-5
"""Absorption of pure water, 1/m (Pope and Fry 1997, table 3)."""

CHLOROPHYLL_ABSORPTION = np.array(
    [
        687, 828, 913, 973, 1000, 944, 917, 870, 798, 750, 668, 618, 528, 474, 416, 357, 294, 276, 291, 282,
        236, 252, 276, 317, 334, 356, 441, 595, 502, 329, 215,
    ]
) * 1e-3
"""Specific absorption of phytoplankton, 1 at 440 nm (Prieur and Sathyendranath 1981, table)."""


@dataclass(frozen=True)
class WaterContents:
    """What is in the water.

    chlorophyll    mg/m^3, > 0; plankton, its detritus and the yellow substance that comes with it
    humic          1/m, absorption of further dissolved organic matter at 440 nm
    minerals       g/m^3, suspended minerals
    """

    chlorophyll: float
    humic: float = 0.0
    minerals: float = 0.0


WATER_TYPES = {
    "clear_ocean": WaterContents(0.03),
    "ocean": WaterContents(0.5),
    "coastal": WaterContents(3.0, humic=0.1, minerals=0.5),
    "river": WaterContents(5.0, humic=1.0, minerals=15.0),
}
"""The contents that the material's water types stand for: Jerlov's classes IA and II of the open ocean, green
coastal water, and a turbid river."""


def absorption(contents: WaterContents) -> np.ndarray:
    """a(lambda), 1/m: Morel's model of the open sea plus humic matter and minerals.

    Open sea: [a_w + 0.06 a*_c C^0.65] [1 + 0.2 exp(-0.014 (lambda - 440))] (Morel 1991, Eq. 18). Humic matter
    falls off as exp(-0.0176 (lambda - 440)), minerals absorb 0.031 m^2/g at 443 nm with a slope of 0.0123
    per nm (Babin et al. 2003a).
    """
    beyond = WAVELENGTHS - 440.0
    plankton = 0.06 * CHLOROPHYLL_ABSORPTION * contents.chlorophyll**0.65
    open_sea = (WATER_ABSORPTION + plankton) * (1.0 + 0.2 * np.exp(-0.014 * beyond))
    humic = contents.humic * np.exp(-0.0176 * beyond)
    minerals = 0.031 * contents.minerals * np.exp(-0.0123 * (beyond - 3.0))
    return open_sea + humic + minerals


def water_scattering() -> np.ndarray:
    """b_w(lambda) of sea water, 1/m: 0.00288 (lambda/500)^-4.32 (Morel 1974)."""
    return 0.00288 * (WAVELENGTHS / 500.0) ** -4.32


def backscattering(contents: WaterContents) -> np.ndarray:
    """b_b(lambda), 1/m: half of what the water scatters, plankton and minerals.

    Plankton: [0.002 + 0.01 (0.5 - 0.25 log10 C) (lambda/550)^nu] 0.416 C^0.766, nu = (log10 C - 0.3)/2 up to
    C = 2 and 0 above (Morel and Maritorena 2001, Eqs. 12 to 14). Minerals scatter 0.51 m^2/g at 555 nm
    (Babin et al. 2003b), 2 % of it backwards.
    """
    log_chlorophyll = np.log10(contents.chlorophyll)
    slope = min(0.5 * (log_chlorophyll - 0.3), 0.0)
    share = 0.002 + 0.01 * (0.5 - 0.25 * log_chlorophyll) * (WAVELENGTHS / 550.0) ** slope
    plankton = np.maximum(share, 0.0) * 0.416 * contents.chlorophyll**0.766
    return 0.5 * water_scattering() + plankton + 0.02 * 0.51 * contents.minerals


def water_leaving_reflectance(contents: WaterContents) -> np.ndarray:
    """pi L_w/E_d(lambda): the reflectance of a matt surface as bright as the water seen from straight above.

    u = b_b/(a + b_b), r = (0.089 + 0.1245 u) u, R_rs = 0.52 r/(1 - 1.7 r) (Lee et al. 2002, Eqs. 1 to 4), times
    pi. The 0.52 holds the two passages through the surface and the widening of the light cone.
    """
    b_b = backscattering(contents)
    u = b_b / (absorption(contents) + b_b)
    r = (0.089 + 0.1245 * u) * u
    return np.pi * 0.52 * r / (1.0 - 1.7 * r)


TRANSMITTANCE_FLOOR = 1e-4
"""Keeps the logarithm finite for a channel whose light is gone within the distance that it is judged by."""


def rgb_absorption(contents: WaterContents) -> np.ndarray:
    """Absorption of each channel of linear Rec. 709, 1/m, shape (3,).

    The one that dims daylight as the spectrum does over the length after which half of it is gone, on average.
    """
    a = absorption(contents)
    length = np.log(2.0) / np.mean(a)
    transmittance = daylight_sensitivity(WAVELENGTHS) @ np.exp(-a * length)
    return -np.log(np.clip(transmittance, TRANSMITTANCE_FLOOR, 1.0)) / length


def rgb_backscattering(contents: WaterContents) -> np.ndarray:
    """Backscattering of each channel of linear Rec. 709, 1/m, shape (3,); smooth in the spectrum, so a mean."""
    return np.maximum(daylight_sensitivity(WAVELENGTHS) @ backscattering(contents), 0.0)
