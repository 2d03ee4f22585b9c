# SPDX-License-Identifier: GPL-3.0-or-later
"""Hard cases of scale: far from the origin, long after time 0, waves of all lengths, units of all sizes."""

import bpy
import numpy as np

import ocean_lod_addon
from ocean_lod_addon.core.constants import GRAVITY
from ocean_lod_addon.core.discretise import discretise
from ocean_lod_addon.core.dispersion import DEEP_WATER_WITH_RIPPLES, angular_frequency, wavenumber
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.lod import Grid, level_anchors, undisturbed_positions
from ocean_lod_addon.core.ocean_time import OceanTime, loop_period, sea_time
from ocean_lod_addon.core.sea import Sea, WaveSystem
from ocean_lod_addon.core.spectra.table import spectrum_of
from ocean_lod_addon.core.waves import TWO_PI
from ocean_lod_addon.core.windows import window, window_levels, window_reach
from tests.core.test_kernel import windowed_direct_sum
from tests.hard_cases.catalogue import FLOAT32_ROUNDING, FLOAT64_ROUNDING, hard_case

GRID = Grid(cell_size=0.25, cells=16, levels=2)
WAVES = discretise(Sea(wave_count=96), GRID.shortest_wavelength)
SUM_OF_AMPLITUDES = float(np.sum(WAVES.amplitude))
FLOAT32_SUM = 5 * FLOAT32_ROUNDING * SUM_OF_AMPLITUDES
FLOAT32_BECAUSE = "5 u times the sum of amplitudes: five roundings a wave, their accumulation averages out"


def heights(anchors, time):
    """Our float32 heights, a float32 direct sum and the float64 truth at all vertices."""
    kernel = FrameKernel(GRID, WAVES)
    ours = np.empty((kernel.vertex_count, 3), np.float32)
    kernel.evaluate(time, anchors, ours)
    x, y = undisturbed_positions(GRID, anchors).T
    truth = windowed_direct_sum(GRID, WAVES, anchors, time, x, y)[:, 2]
    single = [np.float32(values) for values in (WAVES.wavenumber, WAVES.direction, WAVES.phase)]
    k, theta, phase = single
    turned = np.float32(WAVES.angular_frequency) * np.float32(time)
    psi = k * (np.outer(np.float32(x), np.cos(theta)) + np.outer(np.float32(y), np.sin(theta))) + phase - turned
    present = windowed_direct_sum_weights(anchors, x, y)
    return ours[:, 2], (np.float32(WAVES.amplitude) * present * np.cos(psi)).sum(axis=1), truth


def windowed_direct_sum_weights(anchors, x, y):
    """The windows of all waves at all points: the naive sum shall differ in its precision only."""
    reach = window_reach(GRID, WAVES.wavelength)
    centre_x, centre_y = anchors[window_levels(GRID, WAVES.wavelength)].T
    both = window(np.abs(x[:, None] - centre_x), reach) * window(np.abs(y[:, None] - centre_y), reach)
    return both.astype(np.float32)


def worst(centre, time):
    ours, naive, truth = heights(level_anchors(GRID, centre), time)
    return float(np.abs(naive - truth).max()), float(np.abs(ours - truth).max())


@hard_case(
    title="10^6 m from the origin",
    truth="the float64 direct sum",
    naive="phases in float32",
    error="height, m",
    bound=FLOAT32_SUM,
    because=FLOAT32_BECAUSE,
)
def test_a_thousand_kilometres_from_the_origin():
    return worst((1e6, -1e6), 0.0)


@hard_case(
    title="10^7 s after time 0",
    truth="the float64 direct sum",
    naive="phases in float32",
    error="height, m",
    bound=FLOAT32_SUM,
    because=FLOAT32_BECAUSE,
)
def test_four_months_after_the_start():
    return worst((0.0, 0.0), 1e7)


@hard_case(
    title="negative time, both far and late",
    truth="the float64 direct sum",
    naive="phases in float32",
    error="height, m",
    bound=FLOAT32_SUM,
    because=FLOAT32_BECAUSE,
)
def test_before_the_start_and_far_away():
    return worst((-1e5, 1e6), -1e7 - 0.3)


@hard_case(
    title="negative frames and sub-frames",
    truth="frame -500.25 at 24000/1001 per second is -20.8641770833... s",
    naive="whole frames",
    error="time, s",
    bound=4 * FLOAT64_ROUNDING * 21.0,
    because="two float64 operations, each within u; twice that",
)
def test_sub_frames_of_negative_frames():
    rate = 24000 / 1001
    truth = -500.25 * 1001 / 24000
    return abs(int(-500.25) / rate - truth), abs(sea_time(OceanTime(), -500.25, rate) - truth)


def loop_gap(frames):
    """Naive: phases omega t of the rounded frequencies. Differences of phase in rad between ends of the loop."""
    rate = 24000 / 1001
    clock = OceanTime(loop_frames=frames)
    waves = discretise(Sea(loop_period=loop_period(clock, rate)), 1.0)
    start, end = (frame / rate for frame in (1, 1 + frames))
    turned = np.mod(waves.angular_frequency * end, TWO_PI) - np.mod(waves.angular_frequency * start, TWO_PI)
    naive = np.abs(np.angle(np.exp(1j * turned))).max()
    ours = waves.phase_at(sea_time(clock, 1 + frames, rate)) - waves.phase_at(sea_time(clock, 1, rate))
    return float(naive), float(np.abs(ours).max())


@hard_case(
    title="a loop of 10^6 frames",
    truth="frame 1 000 001 is frame 1",
    naive="phase omega t",
    error="phase, rad",
    bound=0.0,
    because="bit for bit: the loop is taken out of whole numbers",
)
def test_a_loop_of_a_million_frames():
    return loop_gap(1_000_000)


@hard_case(
    title="a loop of 2 frames",
    truth="every wave moves and repeats",
    naive="the nearest whole number of cycles, which is 0",
    error="share of waves that stand still",
    bound=0.0,
    because="at least one cycle, by construction",
)
def test_a_loop_of_two_frames():
    period = loop_period(OceanTime(loop_frames=2), 24.0)
    naive = np.rint(discretise(Sea(), 1.0).angular_frequency * period / TWO_PI) == 0
    waves = discretise(Sea(loop_period=period), 1.0)
    still = (waves.phase_at(0.0) != waves.phase_at(period)) | (waves.phase_at(0.0) == waves.phase_at(period / 4))
    return float(naive.mean()), float(still.mean())


LENGTHS = np.geomspace(3e-3, 1e3, 200)


@hard_case(
    title="waves from 3 mm to 1 km in one sea",
    truth="omega(k) and k(omega) are inverse to each other",
    naive="omega^2 = g k",
    error="k, relative",
    bound=16 * FLOAT64_ROUNDING,
    because="omega rounds by 4 u, doubled by d ln k/d ln omega <= 2, and as much again for the inverse",
)
def test_ripples_and_swell_disperse_by_one_law():
    k = TWO_PI / LENGTHS
    omega = angular_frequency(k, DEEP_WATER_WITH_RIPPLES)
    ours = np.abs(wavenumber(omega, DEEP_WATER_WITH_RIPPLES) / k - 1.0).max()
    return float(np.abs(omega**2 / GRAVITY / k - 1.0).max()), float(ours)


@hard_case(
    title="waves from 3 mm to 1 km in one sea, 128 of them",
    truth="their slope variance is the integral of k^2 S",
    naive="equal steps of frequency, S(omega) d omega",
    error="slope variance, relative",
    bound=1e-10,
    because="Gauss-Legendre panels converge to rounding; Simpson's rule for the truth to 1e-11",
)
def test_one_sea_of_all_lengths_keeps_its_slopes():
    system = WaveSystem(spectrum="elfouhaily", wind_speed=15.0)
    sea = Sea(systems=(system,), surface_tension=True, wave_count=128)
    spectrum, cutoff = spectrum_of(system, sea.water), float(angular_frequency(TWO_PI / 3e-3, sea.water))
    omega = np.geomspace(0.15 * spectrum.peak_frequency, cutoff, 400_001)
    density = wavenumber(omega, sea.water) ** 2 * spectrum.density(omega) * omega
    steps = np.diff(np.log(omega))
    truth = simpson(density, steps[0])
    edges = np.linspace(0.15 * spectrum.peak_frequency, cutoff, 129)
    middle = 0.5 * (edges[1:] + edges[:-1])
    naive = np.sum(wavenumber(middle, sea.water) ** 2 * spectrum.density(middle) * np.diff(edges))
    waves = discretise(sea, 3e-3)
    ours = 0.5 * np.sum((waves.wavenumber * waves.amplitude) ** 2)
    return abs(naive / truth - 1.0), abs(ours / truth - 1.0)


def simpson(values, step):
    """Simpson's rule on an odd number of points."""
    return step / 3.0 * (values[0] + values[-1] + 4.0 * values[1:-1:2].sum() + 2.0 * values[2:-1:2].sum())


@hard_case(
    title="scene units from 0.001 to 1000 m",
    truth="the outer square has the same metres in every unit",
    naive="a mesh in metres, whatever the unit",
    error="extent, relative",
    bound=4 * FLOAT32_ROUNDING,
    because="Blender keeps coordinate, scale, matrix and unit as float32",
)
def test_scene_units_of_all_sizes():
    registered = hasattr(bpy.types.Object, "ocean_lod")
    if not registered:
        ocean_lod_addon.register()
    naive = ours = 0.0
    for unit in (1e-3, 1.0, 1e3):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        unit_settings = bpy.context.scene.unit_settings
        unit_settings.scale_length = unit
        bpy.ops.mesh.ocean_lod_add(preset="calm", cells=8, levels=2, cell_size=0.25)
        ob = bpy.context.object
        bpy.context.view_layer.update()
        ob.ocean_lod.sea.systems[0].enabled = False
        corner = max(ob.data.vertices, key=lambda vertex: vertex.co.x).co.x
        in_metres = (ob.matrix_world @ ob.data.vertices[-1].co).x * unit_settings.scale_length
        truth = 0.25 * 2 * 8 / 2
        naive = max(naive, abs(corner * unit / truth - 1.0))
        ours = max(ours, abs(in_metres / truth - 1.0))
    if not registered:
        ocean_lod_addon.unregister()
    return naive, ours
