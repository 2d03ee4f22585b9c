# SPDX-License-Identifier: GPL-3.0-or-later
"""Any settings that the panel allows make a finite sea with the energy, symmetries and continuity of a sea.

Errors other than `OceanError` fail a test; so do NumPy's warnings of overflow and invalid operations in the
package (pyproject.toml).
"""

import dataclasses
import math

import numpy as np
from hypothesis import assume, example, given
from hypothesis import strategies as st

from ocean_lod_addon.core.camera_view import frame_planes, visible_tiles
from ocean_lod_addon.core.carried import Carried
from ocean_lod_addon.core.discretise import SMALLEST_BIN_ENERGY, band_layout, bin_edges, discretise, integrate_bins
from ocean_lod_addon.core.dispersion import angular_frequency
from ocean_lod_addon.core.errors import OceanError
from ocean_lod_addon.core.gerstner import surface_points
from ocean_lod_addon.core.lod import level_anchors, undisturbed_positions
from ocean_lod_addon.core.ocean import Ocean, Surface
from ocean_lod_addon.core.ocean_time import OceanTime, loop_period, sea_time
from ocean_lod_addon.core.placement import Placement, place
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.slope_budget import total_slope_variance, unresolved_slope_variance
from ocean_lod_addon.core.spectra.moments import spectrum_moments
from ocean_lod_addon.core.spectra.table import spectrum_of
from ocean_lod_addon.core.spreading.table import spreading_of
from ocean_lod_addon.core.waves import TWO_PI
from tests.core.plane_tiles import tiles
from tests.core.test_kernel import windowed_direct_sum
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, FLOAT64_ROUNDING
from tests.hard_cases.strategies import (
    angles,
    any_settings,
    cameras,
    framings,
    grids,
    places,
    rotated,
    seas,
    settings_of,
    shortest_wavelengths,
    times,
)

FLAT_BEHIND_THE_WIND = Sea(
    systems=(WaveSystem(spectrum="elfouhaily", spreading="mitsuyasu", wind_speed=80.0),),
    finite_depth=True,
    depth=0.05,
    directions=1,
)
"""The density of directions is a subnormal number at some angles."""


def some_points(seed, extent, count=12):
    return np.random.default_rng(seed).uniform(-extent, extent, (2, count))


def scale_of(waves, reach):
    """What rounding errors of the surface are relative to: sums of motions, times the largest phase's rounding."""
    motion = np.sum(waves.amplitude * (1.0 + waves.orbit_ratio))
    return motion * (1.0 + waves.wavenumber.max(initial=0.0) * reach) + reach


@any_settings
@given(seas(), shortest_wavelengths)
@example(Sea(systems=(WaveSystem(sized_by="height", significant_wave_height=1.4e-301),)), 1.0)
@example(FLAT_BEHIND_THE_WIND, 2e-4)
def test_waves_are_numbers(sea, shortest_wavelength):
    waves = discretise(sea, shortest_wavelength)
    for name in ("amplitude", "wavenumber", "angular_frequency", "direction", "phase", "orbit_ratio"):
        assert np.isfinite(getattr(waves, name)).all(), name
    assert (waves.amplitude >= 0.0).all()
    assert (waves.wavenumber > 0.0).all()
    assert (waves.angular_frequency > 0.0).all()
    assert (waves.orbit_ratio >= 0.0).all()
    wanted = sum(round(sea.wave_count * system.wave_share) for system in sea.systems)
    assert len(waves) <= wanted


@any_settings
@given(seas(), shortest_wavelengths)
def test_waves_have_the_energy_of_their_spectrum(sea, shortest_wavelength):
    """Truth: the variance of a system's waves is the integral of its spectrum over all of its bins.

    1e-10 is what two quadratures of the same function agree to. A cut-off far below the peak leaves a tail that
    grows by e^15 and more within a panel, of which they know fewer digits; all of it is below u of the whole sea.
    """
    waves = discretise(sea, shortest_wavelength)
    cutoff = float(angular_frequency(TWO_PI / shortest_wavelength, sea.water))
    for index, system in enumerate(sea.systems):
        own = 0.5 * np.sum(waves.amplitude[waves.system == index] ** 2)
        spectrum = spectrum_of(system, sea.water)
        per_band, bands = band_layout(sea, system)
        if spectrum is None or bands == 0:
            assert own == 0.0
            continue
        edges = bin_edges(spectrum.peak_frequency, cutoff, per_band * bands)[[0, -1]]
        spreading = spreading_of(system, spectrum, sea.water)
        whole = integrate_bins(spectrum, spreading, system.directional_cutoff, sea.water, edges).energy[0]
        lost = per_band * bands * SMALLEST_BIN_ENERGY
        assert abs(own - whole) <= 1e-10 * whole + FLOAT64_ROUNDING * spectrum_moments(spectrum)[0] + lost


@any_settings
@given(seas(), grids, framings, cameras, times)
def test_surfaces_are_numbers(sea, grid, framing, camera, time):
    try:
        surface = Surface(Ocean(sea, grid, framing))
        variance = surface.slope_variance().astype(np.float64)
    except OceanError:
        return
    out = np.full((surface.vertex_count, 3), np.nan, np.float32)
    surface.positions(time, surface.placement(camera, final=True), out)
    assert np.isfinite(out).all()
    assert np.isfinite(variance).all()


@any_settings
@given(seas(), grids)
def test_no_negative_slope_variance_is_left_to_shading(sea, grid):
    """Truth: geometry shows no more than there is. 8 u of the total: it and what shows are rounded to float32, and
    the sum of what shows accumulates some more."""
    waves = discretise(sea, grid.shortest_wavelength)
    try:
        left = unresolved_slope_variance(sea, grid, waves).astype(np.float64)
    except OceanError:
        return
    mean, half = 0.5 * (left[:, 0] + left[:, 1]), 0.5 * (left[:, 0] - left[:, 1])
    total = total_slope_variance(sea, waves)[:2].sum()
    assert (mean - np.hypot(half, left[:, 2])).min() >= -8 * FLOAT32_ROUNDING * total


@any_settings
@given(seas(), grids, places, times)
def test_the_kernel_is_the_direct_sum_across_all_levels(sea, grid, centre, time):
    """Truth: the float64 sum, each wave times its window, at every vertex: levels leave no trace.

    A coordinate is the sum of its level's anchor and its line, each rounded to float32.
    """
    try:
        surface = Surface(Ocean(sea, grid))
    except OceanError:
        return
    anchors, waves = level_anchors(grid, centre), surface.waves
    out = np.full((surface.vertex_count, 3), np.nan, np.float32)
    surface.positions(time, Placement(anchors), out)
    x, y = undisturbed_positions(grid, anchors)[::5].T
    truth = windowed_direct_sum(grid, waves, anchors, time, x, y)
    motion = np.sum(waves.amplitude * np.maximum(1.0, waves.orbit_ratio))
    phase = TWO_PI + waves.wavenumber.max(initial=0.0) * (np.abs(x).max() + np.abs(y).max())
    phase += waves.angular_frequency.max(initial=0.0) * abs(time)
    allowed = (8 * FLOAT32_ROUNDING + 4 * FLOAT64_ROUNDING * phase) * motion
    summands = np.array([1.0, 1.0, 0.0]) * (np.abs(anchors).max() + grid.half_extent)
    assert (np.abs(out[::5] - truth) <= allowed + FLOAT32_ROUNDING * (5 * np.abs(truth) + summands)).all()


@any_settings
@given(seas(), shortest_wavelengths, angles, times)
def test_turning_all_directions_turns_the_sea(sea, shortest_wavelength, angle, time):
    """Truth: nature has no x axis: the surface of the turned sea at turned points is the turned surface."""
    waves = discretise(sea, shortest_wavelength)
    turned = discretise(rotated(sea, angle), shortest_wavelength)
    x, y = some_points(1, 1e3)
    c, s = math.cos(angle), math.sin(angle)
    here = surface_points(waves, x, y, time)
    there = surface_points(turned, c * x - s * y, s * x + c * y, time)
    X, Y, Z = np.moveaxis(here.position, -1, 0)
    expected = np.stack([c * X - s * Y, s * X + c * Y, Z], axis=-1)
    allowed = 64 * FLOAT64_ROUNDING * scale_of(waves, 1e3)
    assert np.abs(there.position - expected).max() <= allowed


@any_settings
@given(framings, grids, cameras, st.sampled_from([1, 2, 3]))
def test_turning_the_camera_turns_the_plane(framing, grid, camera, quarters):
    """Truth: a quarter turn of the camera about z is one of the plane's anchors; ties may go either way."""
    c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarters]
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], float)
    turned = dataclasses.replace(camera, position=turn @ camera.position, axes=camera.axes @ turn.T)
    waves = discretise(Sea(wave_count=2), grid.shortest_wavelength)
    here, there = (place(grid, framing, waves, view, final=False).anchors for view in (camera, turned))
    spacing = np.array([grid.spacing(level) for level in range(grid.levels)])[:, None]
    assert np.isfinite(here).all()
    reach = np.abs(here).max() + np.abs(camera.position[:2]).max()
    assume(reach < 1e9)  # a ray that barely sinks meets the water anywhere
    assert (np.abs(here @ turn[:2, :2].T - there) <= spacing + 1e-3 * reach).all()


@any_settings
@given(seas(loop_period=st.just(0.0)), shortest_wavelengths, st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_time_has_no_origin(sea, shortest_wavelength, start, later):
    """Truth: the sea at start + later is the sea, with its phases turned by omega start, at `later`."""
    waves = discretise(sea, shortest_wavelength)
    turned = dataclasses.replace(waves, phase=waves.phase - np.mod(waves.angular_frequency * start, TWO_PI))
    x, y = some_points(2, 100.0)
    difference = surface_points(waves, x, y, start + later).position - surface_points(turned, x, y, later).position
    phase = 1.0 + waves.angular_frequency.max(initial=0.0) * (abs(start) + abs(later))
    motion = np.sum(waves.amplitude * (1.0 + waves.orbit_ratio))
    assert np.abs(difference).max() <= 64 * FLOAT64_ROUNDING * (scale_of(waves, 100.0) + motion * phase)


@any_settings
@given(seas(), shortest_wavelengths, times)
def test_systems_add(sea, shortest_wavelength, time):
    """Truth: superposition: displacements of a sea are the sum of those of its systems, each alone."""
    waves = discretise(sea, shortest_wavelength)
    x, y = some_points(3, 100.0)
    still = np.stack([x, y, np.zeros_like(x)], axis=-1)
    total = surface_points(waves, x, y, time).position - still
    parts = np.zeros_like(total)
    for index in range(len(sea.systems)):
        only = tuple(
            dataclasses.replace(system, enabled=system.enabled and number == index)
            for number, system in enumerate(sea.systems)
        )
        alone = discretise(dataclasses.replace(sea, systems=only), shortest_wavelength)
        parts += surface_points(alone, x, y, time).position - still
    assert np.abs(total - parts).max() <= 64 * FLOAT64_ROUNDING * scale_of(waves, 100.0)


@any_settings
@given(seas(loop_period=st.floats(1.0, 600.0)), st.floats(0.5, 1e3))
def test_the_mean_level_is_still_water(sea, shortest_wavelength):
    """Truth: at a fixed undisturbed point heights over a whole loop average to 0.

    With more instants than twice the most cycles of a wave the mean is exact; rounding and the loop's own 2^-36
    steps are left.
    """
    waves = discretise(sea, shortest_wavelength)
    assume(len(waves) > 0)
    cycles = np.rint(waves.angular_frequency * waves.loop_period / TWO_PI)
    instants = 2 ** int(np.ceil(np.log2(2 * cycles.max() + 1)))
    assume(instants <= 4096)
    steps = np.arange(instants) * (waves.loop_period / instants)
    mean = np.mean([np.sum(waves.amplitude * np.cos(waves.phase_at(time))) for time in steps])
    assert abs(mean) <= np.sum(waves.amplitude * (cycles * TWO_PI * 2.0**-36 + 64 * FLOAT64_ROUNDING))


@any_settings
@given(grids, cameras, places, st.floats(0.0, 50.0), st.floats(0.0, 1.0))
def test_what_the_camera_sees_is_never_left_flat(grid, camera, centre, highest, margin):
    """Truth: a tile with a vertex in the frame is seen, wherever waves of that height carry the vertex.

    Each wave carries it around a circle, so in no direction further than upwards.
    """
    anchors = level_anchors(grid, centre)
    planes = frame_planes(camera, margin)
    anywhere = Carried(np.zeros((0, 1, 1, 3)), np.full(grid.levels, highest), 1.0)
    seen = visible_tiles(grid, anchors, planes, anywhere)
    random = np.random.default_rng(4)
    points = undisturbed_positions(grid, anchors)
    directions = random.normal(size=(len(points), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    moved = np.column_stack([points, np.zeros(len(points))]) + highest * directions
    inside = (moved @ planes[:, :3].T + planes[:, 3] > 1e-6 * (1.0 + np.abs(moved).max())).all(axis=1)
    for number, tile in tiles(grid):
        assert seen[number] or not tile.of(inside).any()


@any_settings
@given(settings_of(OceanTime), st.floats(-1e6, 1e6), st.sampled_from([1.0, 23.976, 24.0, 60.0, 240.0]))
def test_clocks_are_numbers(clock, frame, rate):
    time = sea_time(clock, frame, rate)
    assert math.isfinite(time)
    assert math.isfinite(loop_period(clock, rate))
    if clock.loop_frames and clock.source == "FRAMES":
        whole = math.floor(frame)
        assert sea_time(clock, whole, rate) == sea_time(clock, whole + clock.loop_frames, rate)
