// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/light/environment.h"
#include "scene/scene.h"

namespace raybundle {

/// Daylight as the command line or a scene file asks for it; what is not said stays open. Angles in
/// degrees.
struct Daylight {
    std::optional<std::string> sky;          ///< a name of cie_sky_type()
    std::optional<float> zenith_luminance;   ///< cd/m²; else typical of sky and sun's elevation
    std::optional<float> sun_elevation;      ///< 0 to 90, default 45
    std::optional<float> sun_azimuth;        ///< from north (-Z) over east (+X), default 180
    std::optional<float> sun_illuminance;    ///< lx, of a surface that faces it; else typical
    std::optional<float> sun_diameter;       ///< default 0.533
    std::optional<float> turbidity;          ///< luminous, of the typical sun; default: the sky's
    std::optional<float> ground_albedo;      ///< 0 to 1, default 0.2
    std::optional<std::string> environment;  ///< file name for messages
    std::vector<std::uint8_t> environment_bytes;  ///< its content
    std::optional<float> environment_rotation;    ///< clockwise as seen from above
    std::optional<float> environment_scale;       ///< cd/m² of one unit

    [[nodiscard]] bool given() const { return sky || environment; }
};

/// What `more` says goes before what `daylight` says; another sky or image replaces both.
Daylight overlaid(const Daylight& daylight, const Daylight& more);

/// A standard sky with its sun; keeps_sun: with one of 0 lx where it is hidden. Throws SceneError
/// that names `file` where the sky has no such name.
std::shared_ptr<const Environment> make_sky_dome(const Daylight& daylight, const std::string& file,
                                                 bool keeps_sun);

/// Gives the scene that sky or environment, and adds notices of how its image was read. Throws
/// SceneError.
void apply_daylight(const Daylight& daylight, Scene& scene);

}  // namespace raybundle
