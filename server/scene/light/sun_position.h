// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace raybundle {

/// Where the sun stands, degrees.
struct SunPosition {
    double elevation = 0.0;  ///< above the horizon as it is seen, refraction included; -90..90
    double azimuth = 0.0;    ///< from north over east, 0..360
};

/// Seconds since 1970-01-01T00:00Z of a time as "2026-06-21T15:00:00+02:00", also without seconds,
/// or with "Z" for the zone; nothing where it is no such time. Years 1901 to 2099.
std::optional<double> parse_time(const std::string& text);

/// Of a place (degrees, north and east positive) at a time in seconds since 1970-01-01T00:00Z.
/// Meeus 1998, "Astronomical Algorithms", chapters 12, 25 (low accuracy: 0.01 degrees) and 16
/// (refraction, Saemundsson).
SunPosition sun_position(double latitude, double longitude, double time);

}  // namespace raybundle
