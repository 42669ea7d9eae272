// SPDX-License-Identifier: Apache-2.0
#include "scene/light/sun_position.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace raybundle {
namespace {

double sine(double degrees) {
    return std::sin(glm::radians(degrees));
}

double cosine(double degrees) {
    return std::cos(glm::radians(degrees));
}

struct Equatorial {
    double right_ascension = 0.0, declination = 0.0;  // degrees
};

/// Apparent place of the sun; centuries since J2000.
Equatorial apparent_sun(double t) {
    const double longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
    const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sine(anomaly) +
                          (0.019993 - t * 0.000101) * sine(2.0 * anomaly) +
                          0.000289 * sine(3.0 * anomaly);
    const double node = 125.04 - 1934.136 * t;
    const double apparent = longitude + centre - 0.00569 - 0.00478 * sine(node);
    const double obliquity = 23.0 + 26.0 / 60.0 + 21.448 / 3600.0 -
                             t * (46.8150 + t * (0.00059 - t * 0.001813)) / 3600.0 +
                             0.00256 * cosine(node);
    return {glm::degrees(std::atan2(cosine(obliquity) * sine(apparent), cosine(apparent))),
            glm::degrees(std::asin(sine(obliquity) * sine(apparent)))};
}

/// What air lifts the sun by, degrees, at 1010 hPa and 10 degrees.
double refraction(double elevation) {
    constexpr double lowest = -1.0;  // the formula is one for what can be seen
    if (elevation < lowest) {
        return 0.0;
    }
    return std::max(1.02 / std::tan(glm::radians(elevation + 10.3 / (elevation + 5.11))), 0.0) /
           60.0;
}

}  // namespace

std::optional<double> parse_time(const std::string& text) {
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%4d-%2u-%2uT%2d:%2d%n", &year, &month, &day, &hour, &minute,
                    &used) != 5) {
        return std::nullopt;
    }
    std::string rest = text.substr(static_cast<std::size_t>(used));
    double second = 0.0;
    if (rest.starts_with(":")) {
        if (std::sscanf(rest.c_str(), ":%4lf%n", &second, &used) != 1) {
            return std::nullopt;
        }
        rest = rest.substr(static_cast<std::size_t>(used));
    }
    int zone = 0;  // minutes
    if (rest != "Z") {
        char sign = 0;
        int hours = 0;
        int minutes = 0;
        if (std::sscanf(rest.c_str(), "%c%2d:%2d%n", &sign, &hours, &minutes, &used) != 3 ||
            static_cast<std::size_t>(used) != rest.size() || (sign != '+' && sign != '-') ||
            hours < 0 || hours > 14 || minutes < 0 || minutes > 59) {
            return std::nullopt;
        }
        zone = (sign == '-' ? -1 : 1) * (60 * hours + minutes);
    }
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                           std::chrono::day(day)};
    if (!date.ok() || year < 1901 || year > 2099 || hour < 0 || hour > 23 || minute < 0 ||
        minute > 59 || !(second >= 0.0 && second < 61.0)) {
        return std::nullopt;
    }
    const auto days = std::chrono::sys_days(date).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * (minute - zone) + second;
}

SunPosition sun_position(double latitude, double longitude, double time) {
    constexpr double unix_epoch_from_j2000 = -10957.5;  // days
    const double days = time / 86400.0 + unix_epoch_from_j2000;
    const Equatorial sun = apparent_sun(days / 36525.0);
    const double sidereal = 280.46061837 + 360.98564736629 * days;  // at Greenwich
    const double hour_angle = sidereal + longitude - sun.right_ascension;
    const double south = cosine(hour_angle) * sine(latitude) -
                         std::tan(glm::radians(sun.declination)) * cosine(latitude);
    const double azimuth = glm::degrees(std::atan2(sine(hour_angle), south)) + 180.0;
    const double up = sine(latitude) * sine(sun.declination) +
                      cosine(latitude) * cosine(sun.declination) * cosine(hour_angle);
    const double elevation = glm::degrees(std::asin(std::clamp(up, -1.0, 1.0)));
    return {elevation + refraction(elevation), std::fmod(azimuth, 360.0)};
}

}  // namespace raybundle
