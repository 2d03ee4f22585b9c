# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of ripples: the waves of the spectrum, each at its own speed, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from ocean_lod_addon.core.dispersion import angular_frequency
from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.ripple_settings import Ripples
from ocean_lod_addon.core.ripples import synthesis as synthesis_module
from ocean_lod_addon.core.ripples.layout import (
    SLACK,
    TEXELS_PER_WAVE,
    WAVES_PER_TILE,
    Band,
    Tile,
    band_ratio,
    ripple_bands,
    ripple_tiles,
)
from ocean_lod_addon.core.ripples.spectrum import ripple_spectrum, slope_tensor_between
from ocean_lod_addon.core.ripples.synthesis import (
    TileSynthesis,
    band_waves,
    ripple_water,
    tile_syntheses,
)
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.waves import TWO_PI

SEA = Sea(systems=(WaveSystem(wind_speed=10.0, direction=0.7),), seed=5)
TILE = Tile(0.384, 128, (Band(0.048, 0.096), Band(0.024, 0.048)))
DENSITY = ripple_spectrum(SEA, 0.4).density


def image_of(synthesis, time):
    out = np.empty((synthesis.tile.texels, synthesis.tile.texels, 4), np.float32)
    synthesis.image(time, out)
    return out


def synthesis_of(sea=SEA, tile=TILE, seed=3):
    return TileSynthesis(ripple_spectrum(sea, 0.4).density, tile, ripple_water(sea), sea.loop_period, seed)


@pytest.mark.parametrize("band", [0, 1])
def test_texels_are_the_direct_sum_of_the_waves(band):
    """Truth: slope = -sum A k sin(k.x - omega t + eps) in float64; float32 keeps six digits of it."""
    time = 2.75
    waves = band_waves(DENSITY, TILE, TILE.bands[band], ripple_water(SEA), 0.0, seed=11)
    synthesis = TileSynthesis(DENSITY, replace(TILE, bands=(TILE.bands[band],)), ripple_water(SEA), 0.0, 0)
    synthesis._fields[0] = type(synthesis._fields[0])(waves, TILE.texels)
    image = image_of(synthesis, time)
    x, y = 17, 101
    step = TWO_PI / TILE.size
    phase = (
        step * (waves.column * x + waves.row * y) * TILE.size / TILE.texels
        + waves.waves.phase
        - waves.waves.angular_frequency * time
    )
    slope = waves.waves.amplitude * np.sin(phase)
    expected = [-np.sum(slope * step * waves.column), -np.sum(slope * step * waves.row)]
    assert image[y, x, :2] == pytest.approx(expected, abs=1e-5)
    assert not image[:, :, 2:].any(), "the second band is absent"


@pytest.mark.parametrize("texels_at_a_time", [1, 1000, 128 * 40, 1 << 17])
def test_pieces_that_threads_take_make_the_whole_image(monkeypatch, texels_at_a_time):
    """Truth: rows and columns are transformed one by one, so to the bit."""
    whole = image_of(synthesis_of(), 1.5)
    monkeypatch.setattr(synthesis_module, "_TEXELS_AT_A_TIME", texels_at_a_time)
    np.testing.assert_array_equal(image_of(synthesis_of(), 1.5), whole)


def test_small_images_are_left_to_one_thread_and_large_ones_shared_out():
    assert len(synthesis_module.line_pieces(256, 256)) == 1
    pieces = synthesis_module.line_pieces(1024, 1024)
    assert len(pieces) == 8
    assert [row for piece in pieces for row in range(piece.start, piece.stop)] == list(range(1024))


def test_texels_have_the_slope_variance_of_the_band():
    """Truth: the spectrum's tensor between the band's wavelengths. 3 %: the lattice has few hundred waves, whose
    directions are not those of the quadrature. The sum of both axes is scaled to be exact, but at one moment the
    few pairs of waves that run against each other are in step or not: 1 %."""
    image = image_of(synthesis_of(), 0.4).astype(np.float64)
    for number, band in enumerate(TILE.bands):
        expected = slope_tensor_between(DENSITY, band.shortest, band.longest)
        x, y = image[..., 2 * number], image[..., 2 * number + 1]
        assert np.mean(x * x) + np.mean(y * y) == pytest.approx(expected[:2].sum(), rel=0.01)
        measured = [np.mean(x * x), np.mean(y * y), np.mean(x * y)]
        assert measured == pytest.approx(expected, abs=0.03 * expected[:2].sum())
        assert synthesis_of().tensors[number] == pytest.approx(measured, abs=0.01 * expected[:2].sum())


def test_slopes_are_a_gradient():
    """Slopes of a surface have no curl: k_x s_y = k_y s_x for every wave, up to the rounding of float32."""
    image = image_of(synthesis_of(), 1.0).astype(np.float64)
    k = np.fft.fftfreq(TILE.texels)
    for first in (0, 2):
        s_x, s_y = np.fft.fft2(image[:, :, first]), np.fft.fft2(image[:, :, first + 1])
        curl = k[None, :] * s_y - k[:, None] * s_x
        assert np.abs(curl).max() < 1e-5 * np.abs(k[None, :] * s_x).max()


def test_every_wave_advances_by_its_own_dispersion():
    """Truth: omega^2 = (g k + T k^3), surface tension included, whatever the sea's own setting."""
    time, later = 3.0, 3.004
    before, after = (np.fft.fft2(image_of(synthesis_of(), t)[:, :, 0].astype(np.float64)) for t in (time, later))
    i = np.fft.fftfreq(TILE.texels, 1.0 / TILE.texels)
    k = TWO_PI / TILE.size * np.hypot(i[None, :], i[:, None])
    strong = np.abs(before) > 0.05 * np.abs(before).max()
    assert strong.sum() > 40
    turned = np.abs(np.angle(after[strong] / before[strong]))
    expected = angular_frequency(k[strong], ripple_water(SEA)) * (later - time)
    assert turned == pytest.approx(expected, abs=1e-3)
    assert np.all(np.abs(angular_frequency(k[strong]) * (later - time) - turned) > 1e-3), "gravity alone differs"


def test_an_image_depends_on_time_alone():
    synthesis = synthesis_of()
    first = image_of(synthesis, 7.0)
    image_of(synthesis, 123.0)
    assert np.array_equal(image_of(synthesis, 7.0), first)
    assert np.array_equal(image_of(synthesis_of(), 7.0), first)
    assert not np.array_equal(image_of(synthesis, 7.1), first)
    assert not np.array_equal(image_of(synthesis_of(seed=4), 7.0), first)


def test_a_looping_sea_has_looping_ripples_bit_for_bit():
    looping = synthesis_of(replace(SEA, loop_period=2.5))
    assert np.array_equal(image_of(looping, 1.1), image_of(looping, 3.6))
    assert not np.array_equal(image_of(looping, 1.1), image_of(looping, 2.35))


def test_a_sea_without_wind_gives_black_images():
    calm = synthesis_of(replace(SEA, systems=(replace(SEA.systems[0], wind_speed=0.0),)))
    assert not image_of(calm, 1.0).any()
    assert not np.any(calm.tensors)


def test_tiles_of_a_sea_are_different():
    tiles = (TILE, TILE)
    first, second = tile_syntheses(DENSITY, SEA, tiles)
    assert not np.array_equal(image_of(first, 0.0), image_of(second, 0.0))


@pytest.mark.parametrize("resolution", ["256", "512", "1024"])
@pytest.mark.parametrize("shortest_resolved", [0.02, 0.12, 0.4, 3.0, 40.0])
def test_bands_cover_the_range_once_and_begin_anew_where_the_mesh_ends(resolution, shortest_resolved):
    settings = Ripples(resolution=resolution)
    bands = ripple_bands(settings, shortest_resolved)
    edges = [bands[0].longest, *(band.shortest for band in bands)]
    assert [band.longest for band in bands] == edges[:-1]
    assert edges[0] == pytest.approx(settings.longest_wavelength)
    assert edges[-1] == pytest.approx(settings.shortest_wavelength)
    widest = max(band.longest / band.shortest for band in bands)
    assert widest < band_ratio(settings.texels) ** (1.0 + SLACK), "one band is never wider by more than the slack"
    if settings.shortest_wavelength * 3 < shortest_resolved < settings.longest_wavelength / 4:
        assert shortest_resolved in edges


@pytest.mark.parametrize("resolution", ["256", "512", "1024"])
def test_tiles_resolve_their_shortest_wave_and_hold_enough_of_the_longest(resolution):
    for tile in ripple_tiles(Ripples(resolution=resolution), 0.12):
        assert tile.size / tile.texels == pytest.approx(tile.bands[-1].shortest / TEXELS_PER_WAVE)
        assert tile.size >= (WAVES_PER_TILE - 1) * tile.bands[0].longest, "one less for the slack"


def test_settings_that_do_not_go_together_are_refused():
    with pytest.raises(OceanError, match="longest_wavelength is"):
        Ripples(shortest_wavelength=0.09, longest_wavelength=0.1)
