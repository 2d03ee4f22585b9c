# SPDX-License-Identifier: GPL-3.0-or-later
"""Golden cases of optics: case name to a function from the case's inputs to its outputs."""

import numpy as np

from ocean_lod_addon.core.optics import (
    cox_munk,
    erf,
    fresnel,
    mean_fresnel,
    ross,
    slope_density,
    smith,
    trochoid_slopes,
)
from ocean_lod_addon.core.waves import WaveSet
from tests.core.optics_helpers import OPS, cox_munk_sigmas, direction, exact_slopes


def lambda_of_a(case):
    a = case["a"]
    return {
        "Lambda": smith.smith_lambda(a),
        "Lambda_with_erfc_eq19": smith.smith_lambda_eq19(OPS, a),
        "erfc": erf.erfc(a),
        "erfcx": erf.erfcx(a),
        "erfc_eq19": erf.erfc_eq19(OPS, a),
    }


def visibility(case):
    variances = case["sigma2_x"], case["sigma2_y"]
    a = smith.a_of_direction(case["theta"], case["phi"], *variances)
    w = direction(case["theta"], case["phi"])
    M = exact_slopes(*variances).masked_area(OPS, w)
    return {"a": a, "Lambda": smith.smith_lambda(a), "cos_Lambda": M, "projected_visible_area": w[2] + M}


def ross_brdf(case):
    n, variances = case["n"], (case["sigma2_x"], case["sigma2_y"])
    slopes = exact_slopes(*variances)
    v, light = direction(case["theta_v"], case["phi_v"]), direction(case["theta_l"], case["phi_l"])
    half = ross.half_vector(OPS, v, light)
    tilt = half.tilt_x, half.tilt_y
    lobe = ross.reflection_lobe(OPS, v, light, half, slopes)
    F_schlick = fresnel.schlick(OPS, half.cos_incidence, n)
    return {
        "zeta_h": [-half.tilt_x, -half.tilt_y],
        "p": slopes.density(OPS, *tilt),
        "Lambda_v": slopes.masked_area(OPS, v) / v[2],
        "Lambda_l": slopes.masked_area(OPS, light) / light[2],
        "q_vn_density": ross.visible_slope_density(OPS, tilt, v, slopes, light),
        "v_dot_h": half.cos_incidence,
        "h_z": 1.0 / np.sqrt(half.secant2),
        "brdf_F1": lobe / light[2],
        "F_exact": fresnel.exact(OPS, half.cos_incidence, n),
        "F_schlick": F_schlick,
        "brdf_exactF": ross.brdf(OPS, v, light, slopes, n),
        "brdf_schlickF": lobe * F_schlick / light[2],
        "brdf_F1_times_cos_l": lobe,
    }


def fresnel_of_cos(case):
    return {
        "exact": fresnel.exact(OPS, case["cos"], case["n"]),
        "schlick": fresnel.schlick(OPS, case["cos"], case["n"]),
    }


def mean_fresnel_visible(case):
    n, slopes = case["n"], exact_slopes(case["sigma2_x"], case["sigma2_y"])
    v = direction(case["theta_v"], case["phi_v"])
    sigma_v = np.hypot(slopes.sigma_x * np.cos(case["phi_v"]), slopes.sigma_y * np.sin(case["phi_v"]))
    return {
        "exact_F": mean_fresnel.mean_over_visible_slopes(OPS, lambda c: fresnel.exact(OPS, c, n), v, slopes),
        "schlick_F": mean_fresnel.mean_over_visible_slopes(OPS, lambda c: fresnel.schlick(OPS, c, n), v, slopes),
        "bruneton_fit": mean_fresnel.mean_fresnel_bruneton(OPS, v[2], sigma_v, n),
    }


def cox_munk_coefficients(case):
    U = case["U12.5"]
    return {
        "sigma2_up": cox_munk.slope_variance_along(U),
        "sigma2_cross": cox_munk.slope_variance_across(U),
        "c21": cox_munk.skewness_c21(U),
        "c03": cox_munk.skewness_c03(U),
    }


def cox_munk_pdf(case):
    U = case["U12.5"]
    sigma_x, sigma_y = cox_munk_sigmas(U)
    X, Y = -case["zeta_x_downwind"] / sigma_x, case["zeta_y"] / sigma_y
    p0 = slope_density.gaussian(OPS, X, Y, sigma_x, sigma_y)
    K = slope_density.gram_charlier_factor(OPS, X, Y, cox_munk.skewness_c21(U), cox_munk.skewness_c03(U))
    return {"p_gauss": p0, "gram_charlier_factor": K, "p_gram_charlier": p0 * K}


def visible_area_gram_charlier(case):
    U, v = case["U12.5"], direction(case["theta_v"], case["phi_v"])
    sigmas = cox_munk_sigmas(U)
    s_v = smith.slope_spread(OPS, v[0], v[1], *sigmas)
    M = smith.masked_area_exact(OPS, v[2], s_v)
    c21, c03 = cox_munk.skewness_c21(U), cox_munk.skewness_c03(U)
    M_gram_charlier = slope_density.gram_charlier_masked_area(OPS, M, v, s_v, sigmas, c21, c03)
    return {"C_gauss": v[2] + M, "C_gram_charlier": v[2] + M_gram_charlier}


def trochoid_slope_variance(case):
    e = case["kA"]
    return {
        "by_horizontal_area": trochoid_slopes.mean_square_slope(e),
        "by_undisturbed_position": trochoid_slopes.mean_square_slope_by_undisturbed_position(e),
        "linear": trochoid_slopes.mean_square_slope_linear(e),
        "choppiness_half": trochoid_slopes.mean_square_slope(e, 0.5),
    }


def sum_of_trochoids(case):
    A, k, theta = np.array(case["waves_A_k_theta"]).T
    waves = WaveSet(A, k, np.sqrt(9.81 * k), theta, 0.0 * A, np.ones_like(A), np.zeros(len(A)))
    covariance = trochoid_slopes.slope_covariance(waves)
    return {"sigma2_x": covariance.xx, "sigma2_y": covariance.yy, "sigma_xy": covariance.xy}


CASES = {
    "Lambda": lambda_of_a,
    "visibility": visibility,
    "ross_brdf": ross_brdf,
    "fresnel": fresnel_of_cos,
    "mean_fresnel_visible": mean_fresnel_visible,
    "cox_munk_coefficients": cox_munk_coefficients,
    "cox_munk_pdf": cox_munk_pdf,
    "visible_area_gram_charlier": visible_area_gram_charlier,
    "trochoid_slope_variance": trochoid_slope_variance,
    "sum_of_trochoids": sum_of_trochoids,
}
