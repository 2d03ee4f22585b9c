# SPDX-License-Identifier: GPL-3.0-or-later
"""Golden cases of the waves: case name to a function from the case's inputs to its outputs."""

import numpy as np

from ocean_lod_addon.core import dispersion, gerstner, rng
from ocean_lod_addon.core.discretise import looping_frequency
from ocean_lod_addon.core.spectra import pierson_moskowitz, two_parameter
from ocean_lod_addon.core.spectra.jonswap import jonswap_from_height, jonswap_from_wind
from ocean_lod_addon.core.spectra.moments import significant_wave_height, spectrum_moments
from ocean_lod_addon.core.spectra.neumann import Neumann
from ocean_lod_addon.core.spectra.tma import Tma, kitaigorodskii_factor
from ocean_lod_addon.core.spreading import cos2s, sampling, swop
from ocean_lod_addon.core.waves import TWO_PI, WaveSet
from ocean_lod_addon.core.wind import wind_at_height


def _water(given):
    return dispersion.Water(np.inf if given["depth"] is None else given["depth"])


def _dispersion(given):
    omega, water, g = given["omega"], _water(given), given["g"]
    k = dispersion.wavenumber(omega, water, g)
    return {
        "k": k,
        "wavelength": TWO_PI / k,
        "phase_speed": dispersion.phase_speed(k, water, g),
        "group_speed": dispersion.group_speed(k, water, g),
        "coth_kh": dispersion.coth_kh(k, water.depth),
    }


def _pm(given):
    return pierson_moskowitz.pierson_moskowitz_from_wind(given["U19.5"])


def _pm_moments(given):
    spectrum = _pm(given)
    m0, m1, m2 = (spectrum.moment(n) for n in range(3))
    return {
        "m0": m0,
        "m1": m1,
        "m2": m2,
        "Hs": significant_wave_height(m0),
        "omega_p": spectrum.peak_frequency,
        "gerstner_setdown_m": m2 / 9.81,
    }


def _pm_hs(given):
    spectrum = pierson_moskowitz.pierson_moskowitz_from_height(given["Hs"])
    return {"S": spectrum.density(given["omega"]), "omega_p": spectrum.peak_frequency}


def _pm_geometric_bins(given):
    edges = np.geomspace(given["omega_lo"], given["omega_hi"], given["N"] + 1)
    energy = _pm(given).energy_between(edges[:-1], edges[1:])
    slope_variance = _pm(given).deep_slope_variance_between(edges[:-1], edges[1:])
    return {
        "edges": edges,
        "amplitude": np.sqrt(2.0 * energy),
        "omega_slope_preserving": dispersion.angular_frequency(np.sqrt(slope_variance / energy)),
        "sum_half_A2": np.sum(energy),
        "sum_half_k2A2": np.sum(slope_variance),
    }


def _pm_equal_energy_bins(given):
    spectrum, n = _pm(given), given["N"]
    return {
        "amplitude_each": np.sqrt(2.0 * spectrum.moment(0) / n),
        "omega_median": spectrum.frequency_below_which((np.arange(n) + 0.5) / n),
    }


def _two_parameter(kind):
    def outputs(given):
        decay = two_parameter.DECAY_FROM_PERIOD[kind](given["T"])
        spectrum = two_parameter.two_parameter(given["Hs"], decay)
        return {"S": spectrum.density(given["omega"]), "B": spectrum.B, "A": spectrum.A}

    return outputs


def _jonswap(given):
    return jonswap_from_wind(given["U10"], given["fetch"], given["gamma"])


def _jonswap_fetch(given):
    spectrum = _jonswap(given)
    m0 = spectrum_moments(spectrum)[0]
    return {
        "alpha": spectrum.alpha,
        "omega_p": spectrum.peak_frequency,
        "m0": m0,
        "Hs": significant_wave_height(m0),
    }


def _jonswap_hs_exact(given):
    spectrum = jonswap_from_height(given["Hs"], TWO_PI / given["Tp"], given["gamma"])
    return {"S": spectrum.density(given["omega"])}


def _neumann(given):
    spectrum = Neumann(given["U7.5"])
    return {
        "S": spectrum.density(given["omega"]),
        "m0": spectrum.variance,
        "Hs": significant_wave_height(spectrum.variance),
        "omega_p": spectrum.peak_frequency,
    }


def _tma(given):
    spectrum = Tma(_jonswap(given), dispersion.Water(given["depth"]))
    return {
        "phi": kitaigorodskii_factor(given["omega"], spectrum.water),
        "S": spectrum.density(given["omega"]),
    }


def _cos2s(given):
    law = cos2s.constant_cos2s(given["s"])
    return {
        "D": law.density(1.0, given["theta"]),
        "mean_cos_2theta": 2.0 * sampling.mean_cos2(law, 1.0, np.pi) - 1.0,
    }


def _mitsuyasu(given):
    wind, peak = given["U10"], given["omega_p"]
    return {
        "s": cos2s.mitsuyasu_exponent(given["omega"], wind, peak),
        "s_max": cos2s.mitsuyasu_largest_exponent(wind, peak),
    }


def _swop(given):
    law, ratio, theta = swop.swop(1.0), np.float64(given["omega_over_omega0"]), given["theta"]
    return {
        "D": law.density(ratio, theta),
        "cdf": law.cumulative(ratio, theta),
        "mean_cos2": sampling.mean_cos2(law, ratio, np.pi),
    }


def _swop_inverse(given):
    return {"theta": sampling.direction_at_share(swop.swop(1.0), given["omega_over_omega0"], given["u"])}


def _loop_quantise(given):
    omega = looping_frequency(given["omega"], given["T"])
    return {"n": omega * given["T"] / TWO_PI, "omega_q": omega, "k_deep": dispersion.wavenumber(omega)}


def _splitmix64_phase(given):
    index = np.arange(given["n"])
    uniform = rng.uniform(given["seed"], index)
    return {
        "u64_hex": [f"0x{value:016X}" for value in rng.splitmix64(given["seed"], index).tolist()],
        "uniform": uniform,
        "phase": TWO_PI * uniform,
    }


def _gerstner(given):
    A, k, theta, phase = np.array(given["waves_A_k_theta_phase"]).T
    water, g = _water(given), given["g"]
    omega = dispersion.angular_frequency(k, water, g)
    orbit_ratio = given["choppiness"] * dispersion.coth_kh(k, water.depth)
    waves = WaveSet(A, k, omega, theta, phase, orbit_ratio, np.zeros(len(A)))
    points = gerstner.surface_points(waves, given["x0"], given["y0"], given["t"])
    return {
        "position": points.position,
        "dP_dx0": points.tangent_x,
        "dP_dy0": points.tangent_y,
        "jacobian": points.jacobian,
        "normal": points.normal,
        "slope": points.slope,
        "velocity": points.velocity,
        "sum_steepness": gerstner.sum_steepness(waves),
        "mean_level": gerstner.mean_level(waves),
    }


def _gerstner_eq1(given):
    dx, dz, jacobian = gerstner.gerstner_particle(given["a"], given["k"], given["z0"], given["phase"])
    return {"dx": dx, "dz": dz, "jacobian": jacobian}


CASES = {
    "dispersion_k_of_omega": _dispersion,
    "pm_wind_moments": _pm_moments,
    "pm_wind": lambda given: {"S": _pm(given).density(given["omega"])},
    "pm_wind_mss_below": lambda given: {"mss": _pm(given).deep_slope_variance_below(given["omega_c"])},
    "pm_hs": _pm_hs,
    "pm_geometric_bins": _pm_geometric_bins,
    "pm_equal_energy_bins": _pm_equal_energy_bins,
    "issc_T1": _two_parameter("mean"),
    "ittc_Tz": _two_parameter("zero_crossing"),
    "bretschneider_Tp": _two_parameter("peak"),
    "jonswap_fetch": _jonswap_fetch,
    "jonswap_fetch_S": lambda given: {"S": _jonswap(given).density(given["omega"])},
    "jonswap_hs_exact": _jonswap_hs_exact,
    "neumann": _neumann,
    "tma": _tma,
    "cos2s": _cos2s,
    "mitsuyasu_s": _mitsuyasu,
    "wind_height_loglaw_Cd": lambda given: {"Uz": wind_at_height(given["U10"], given["z"], given["Cd"])},
    "swop": _swop,
    "swop_inverse_cdf": _swop_inverse,
    "loop_quantise": _loop_quantise,
    "splitmix64_phase": _splitmix64_phase,
    "gerstner_one_deep_crest": _gerstner,
    "gerstner_one_deep": _gerstner,
    "gerstner_three_deep": _gerstner,
    "gerstner_three_depth8": _gerstner,
    "gerstner_three_choppy_half": _gerstner,
    "gerstner_three_deep_far": _gerstner,
    "gerstner_eq1": _gerstner_eq1,
}
