// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace raybundle {

/// Unit direction, Y up, of an elevation above the horizon and an azimuth, both in radians. Azimuth
/// 0 is north, -Z; it grows clockwise as seen from above: +X is east.
glm::dvec3 sky_direction(double elevation, double azimuth);

/// Relative luminance of a standard sky (CIE S 011/E:2003, "Spatial Distribution of Daylight - CIE
/// Standard General Sky"; of type 16 the traditional overcast sky, Moon, Spencer 1942,
/// "Illumination from a Non-Uniform Sky").
struct CieSky {
    int type = traditional_overcast;  ///< 1 to 16

    static constexpr int traditional_overcast = 16;
    static constexpr int standard_intermediate = 7;  ///< partly cloudy, brighter round the sun
    static constexpr int standard_clear = 12;        ///< low turbidity

    /// Luminance over that of the zenith, towards a unit direction above the horizon.
    [[nodiscard]] double relative_luminance(const glm::dvec3& direction,
                                            const glm::dvec3& sun) const;
    /// Horizontal illuminance over the luminance of the zenith, sr; by quadrature.
    [[nodiscard]] double relative_illuminance(const glm::dvec3& sun) const;
    /// Typical horizontal illuminance by the sky alone, lx, over sin(elevation): the sky's share of
    /// the extraterrestrial illuminance (Darula, Kittler 2002, "CIE General Sky Standard Defining
    /// Luminance Distributions", table 2).
    [[nodiscard]] double typical_illuminance() const;
    /// Typical illuminance of a surface that faces the sun, lx; 0 where clouds hide it. Same
    /// source: extinction by the type's luminous turbidity, or by another one. elevation: radians.
    [[nodiscard]] double typical_sun_illuminance(
        double elevation, std::optional<double> turbidity = std::nullopt) const;
};

/// "overcast", "intermediate", "clear", "cie-1" to "cie-15": its type; 0 for any other text.
int cie_sky_type(const std::string& name);
/// All names for messages: "overcast, intermediate, clear, cie-1 to cie-15".
const char* cie_sky_names();

}  // namespace raybundle
