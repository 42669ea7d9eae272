// SPDX-License-Identifier: Apache-2.0
#include "scene/light/cie_sky.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

using std::numbers::pi;
constexpr double extraterrestrial = 133.8e3;  // lx, of a surface that faces the sun

/// One of the standard's types: gradation a, b; indicatrix c, d, e; share of the extraterrestrial
/// illuminance that the sky alone sends; luminous turbidity, 0: the sun is hidden.
struct Row {
    double a, b, c, d, e, share, turbidity;
};

constexpr std::array<Row, 15> rows = {{
    {4.0, -0.7, 0.0, -1.0, 0.0, 0.10, 0.0},
    {4.0, -0.7, 2.0, -1.5, 0.15, 0.18, 0.0},
    {1.1, -0.8, 0.0, -1.0, 0.0, 0.15, 0.0},
    {1.1, -0.8, 2.0, -1.5, 0.15, 0.22, 0.0},
    {0.0, -1.0, 0.0, -1.0, 0.0, 0.20, 0.0},
    {0.0, -1.0, 2.0, -1.5, 0.15, 0.38, 0.0},
    {0.0, -1.0, 5.0, -2.5, 0.30, 0.42, 12.0},
    {0.0, -1.0, 10.0, -3.0, 0.45, 0.41, 10.0},
    {-1.0, -0.55, 2.0, -1.5, 0.15, 0.40, 12.0},
    {-1.0, -0.55, 5.0, -2.5, 0.30, 0.36, 10.0},
    {-1.0, -0.55, 10.0, -3.0, 0.45, 0.23, 4.0},
    {-1.0, -0.32, 10.0, -3.0, 0.45, 0.10, 2.5},
    {-1.0, -0.32, 16.0, -3.0, 0.30, 0.28, 4.5},
    {-1.0, -0.15, 16.0, -3.0, 0.30, 0.28, 5.0},
    {-1.0, -0.15, 24.0, -2.8, 0.15, 0.30, 4.0},
}};

const Row& row_of(int type) {
    // What the traditional overcast sky sends is what the standard's own one does.
    const int index = type == CieSky::traditional_overcast ? 1 : std::clamp(type, 1, 15);
    return rows[static_cast<std::size_t>(index - 1)];
}

/// Gradation function; sine: of the elevation, at least 0.
double gradation(const Row& row, double sine) {
    return sine > 0.0 ? 1.0 + row.a * std::exp(row.b / sine) : 1.0;
}

/// Scattering indicatrix; cosine: of the angle to the sun.
double indicatrix(const Row& row, double cosine) {
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    return 1.0 + row.c * (std::exp(row.d * angle) - std::exp(row.d * 0.5 * pi)) +
           row.e * cosine * cosine;
}

/// Relative optical air mass (Kasten, Young 1989, "Revised Optical Air Mass Tables").
double air_mass(double elevation) {
    const double degrees = glm::degrees(elevation);
    return 1.0 / (std::sin(elevation) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

}  // namespace

glm::dvec3 sky_direction(double elevation, double azimuth) {
    const double level = std::cos(elevation);
    return {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)};
}

double CieSky::relative_luminance(const glm::dvec3& direction, const glm::dvec3& sun) const {
    const double sine = std::max(direction.y, 0.0);
    if (type == traditional_overcast) {
        return (1.0 + 2.0 * sine) / 3.0;
    }
    const Row& row = row_of(type);
    return gradation(row, sine) * indicatrix(row, glm::dot(direction, sun)) /
           (gradation(row, 1.0) * indicatrix(row, sun.y));
}

double CieSky::relative_illuminance(const glm::dvec3& sun) const {
    constexpr int sines = 256;
    constexpr int azimuths = 512;
    double sum = 0.0;
    for (int i = 0; i < sines; ++i) {
        const double elevation = std::asin((i + 0.5) / sines);
        double ring = 0.0;
        for (int k = 0; k < azimuths; ++k) {
            ring +=
                relative_luminance(sky_direction(elevation, 2.0 * pi * (k + 0.5) / azimuths), sun);
        }
        sum += ring * std::sin(elevation);
    }
    return sum * 2.0 * pi / (double{sines} * azimuths);
}

double CieSky::typical_illuminance() const {
    return row_of(type).share * extraterrestrial;
}

double CieSky::typical_sun_illuminance(double elevation,
                                       std::optional<double> turbidity_of_air) const {
    const double own = row_of(type).turbidity;
    if (!(own > 0.0) || type == traditional_overcast) {
        return 0.0;
    }
    const double turbidity = turbidity_of_air.value_or(own);
    const double mass = air_mass(elevation);
    return extraterrestrial * std::exp(-turbidity * mass / (9.9 + 0.043 * mass));
}

int cie_sky_type(const std::string& name) {
    if (name == "overcast") {
        return CieSky::traditional_overcast;
    }
    if (name == "intermediate") {
        return CieSky::standard_intermediate;
    }
    if (name == "clear") {
        return CieSky::standard_clear;
    }
    const std::string prefix = "cie-";
    int type = 0;
    if (!name.starts_with(prefix)) {
        return 0;
    }
    const char* const end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + prefix.size(), end, type);
    return parsed.ec == std::errc() && parsed.ptr == end && type >= 1 && type <= 15 ? type : 0;
}

const char* cie_sky_names() {
    return "overcast, intermediate, clear, cie-1 to cie-15";
}

}  // namespace raybundle
