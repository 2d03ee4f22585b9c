# SPDX-License-Identifier: GPL-3.0-or-later
"""From spectra to linear Rec. 709 colours."""

import numpy as np

DAYLIGHT_WAVELENGTHS = np.arange(380.0, 721.0, 10.0)

DAYLIGHT = np.array(
    [
        49.98, 54.65, 82.75, 91.49, 93.43, 86.68, 104.86, 117.01, 117.81, 114.86, 115.92, 108.81, 109.35,
        107.80, 104.79, 107.69, 104.41, 104.05, 100.00, 96.33, 95.79, 88.69, 90.01, 89.60, 87.70, 83.29,
        83.70, 80.03, 80.21, 82.28, 78.28, 69.72, 71.61, 74.35, 61.60,
    ]
)
"""Relative spectral power of daylight, CIE illuminant D65, on `DAYLIGHT_WAVELENGTHS`."""

REC709_FROM_XYZ = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def _lobe(wavelength, height, peak, below, above):
    width = np.where(wavelength < peak, below, above)
    return height * np.exp(-0.5 * ((wavelength - peak) * width) ** 2)


def color_matching(wavelength) -> np.ndarray:
    """The CIE 1931 colour matching functions x, y, z, shape (3, n), at `wavelength` in nm.

    Sums of Gaussian lobes (Wyman, Sloan and Shirley 2013, table 1).
    """
    w = np.asarray(wavelength, dtype=np.float64)
    x = (
        _lobe(w, 0.362, 442.0, 0.0624, 0.0374)
        + _lobe(w, 1.056, 599.8, 0.0264, 0.0323)
        + _lobe(w, -0.065, 501.1, 0.0490, 0.0382)
    )
    y = _lobe(w, 0.821, 568.8, 0.0213, 0.0247) + _lobe(w, 0.286, 530.9, 0.0613, 0.0322)
    z = _lobe(w, 1.217, 437.0, 0.0845, 0.0278) + _lobe(w, 0.681, 459.0, 0.0385, 0.0725)
    return np.array([x, y, z])


def daylight_sensitivity(wavelength) -> np.ndarray:
    """Shape (3, n): what each wavelength of a reflectance adds to linear Rec. 709 under daylight.

    Each row sums to 1, so that a white surface is (1, 1, 1); some entries are negative.
    """
    daylight = np.interp(wavelength, DAYLIGHT_WAVELENGTHS, DAYLIGHT)
    sensitivity = REC709_FROM_XYZ @ (color_matching(wavelength) * daylight)
    return sensitivity / sensitivity.sum(axis=1, keepdims=True)


def reflectance_to_rec709(wavelength, reflectance) -> np.ndarray:
    """Linear Rec. 709 colour, shape (3,), of a reflectance spectrum under daylight.

    `wavelength` in nm, `reflectance` of the same shape (n,). Colours outside Rec. 709, such as the blue of the
    clearest ocean, are clamped at 0 per channel.
    """
    return np.maximum(daylight_sensitivity(wavelength) @ reflectance, 0.0)
