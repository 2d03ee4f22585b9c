# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light one smooth facet of water reflects (Eq. 25), unpolarised."""


def normal_incidence(refractive_index):
    """R = ((n-1)/(n+1))^2, the reflectance at normal incidence (Eq. 25)."""
    ratio = (refractive_index - 1.0) / (refractive_index + 1.0)
    return ratio * ratio


def exact(ops, cos_incidence, refractive_index):
    """Fresnel reflectance of a dielectric, c = v.h in [0, 1] (THEORY section 7).

    G = sqrt(n^2 - 1 + c^2), F = [((c-G)/(c+G))^2 + ((n^2 c - G)/(n^2 c + G))^2] / 2. No denominator vanishes:
    G >= sqrt(n^2 - 1) > 0.
    """
    c, n2 = cos_incidence, refractive_index * refractive_index
    G = ops.label(ops.sqrt(ops.multiply_add(c, c, n2 - 1.0)), "n cos of refraction")
    n2c = n2 * c
    s_polarised = (c - G) / (c + G)
    p_polarised = (n2c - G) / (n2c + G)
    F = 0.5 * ops.multiply_add(s_polarised, s_polarised, p_polarised * p_polarised)
    return ops.label(F, "Fresnel F")


def schlick(ops, cos_incidence, refractive_index):
    """Schlick's approximation R + (1-R)(1-c)^5 (Eq. 25): up to 23 % off for water, near 50 degrees."""
    R = normal_incidence(refractive_index)
    m = 1.0 - cos_incidence
    m2 = m * m
    return ops.label(ops.multiply_add(1.0 - R, m2 * m2 * m, R), "Schlick F")
