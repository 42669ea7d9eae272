// SPDX-License-Identifier: Apache-2.0
#include "scene/light/colour_temperature.h"

#include <cmath>

#include "scene/material/colour_space.h"

namespace raybundle {
namespace {

/// A bell of unequal sides.
double bell(double x, double centre, double left, double right) {
    const double t = (x - centre) / (x < centre ? left : right);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 colour matching functions at a wavelength (nm): the fit of Wyman, Sloan and Shirley
/// 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions".
glm::dvec3 matching(double nm) {
    return {1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
                0.065 * bell(nm, 501.1, 20.4, 26.2),
            0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
            1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8)};
}

/// XYZ of a black body, up to a factor (Planck's law).
glm::dvec3 black_body(double kelvin) {
    constexpr double second_radiation_constant = 1.4388e7;  // nm K
    glm::dvec3 xyz(0.0);
    for (int nm = 360; nm <= 830; ++nm) {
        const double l = nm;
        const double power =
            std::pow(l, -5.0) / std::expm1(second_radiation_constant / (l * kelvin));
        xyz += power * matching(l);
    }
    return xyz;
}

/// XYZ of CIE daylight, Y = 1 (CIE 15).
glm::dvec3 daylight(double kelvin) {
    const double t = 1e3 / kelvin;
    const double x = kelvin <= 7000.0 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                                      : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
    const double y = (-3.000 * x + 2.870) * x - 0.275;
    return {x / y, 1.0, (1.0 - x - y) / y};
}

}  // namespace

glm::vec3 colour_of_temperature(double kelvin) {
    constexpr double daylight_from = 5000.0;
    const glm::dvec3 xyz = kelvin < daylight_from ? black_body(kelvin) : daylight(kelvin);
    const glm::dvec3 rgb = glm::max(rec709_from_xyz() * xyz, 0.0);
    const double y = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
    return glm::vec3(rgb / y);
}

}  // namespace raybundle
