# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels at the horizon cover hundreds of waves: what they show of them does not flicker as the camera moves."""

import pytest

from tools.sea_checks.flicker import LIMIT, Band, change, dolly

pytestmark = pytest.mark.render


def test_frames_flicker_no_more_than_supersampled_ones():
    """Truth: frames of 64 times as many pixels, scaled down. Noise is taken off both; what is left of it, and that
    this is one change of few pixels, makes either uncertain by a fifth. The reference shows that the water moves,
    and that its changes are not lost in noise."""
    band = Band(width=96, rows=5, columns=32, frames=2)
    scene = dolly("CYCLES", band)
    frames, reference = (change(scene, band, samples, factor) for factor, samples in ((1, 32), (8, 1)))
    assert reference.water > 0.5 * reference.with_noise
    assert frames.mean == pytest.approx(reference.mean, rel=0.2)
    assert frames.water <= LIMIT * reference.water
