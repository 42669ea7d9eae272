// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/light/cie_sky.h"
#include "scene/light/environment.h"

namespace raybundle {

struct SkyDomeSettings {
    CieSky sky;
    double sun_elevation = 0.785398163;  ///< radians, 0 to pi/2
    double sun_azimuth = 3.141592654;    ///< radians, see sky_direction()
    double zenith_luminance = 0.0;       ///< cd/m²
    double sun_illuminance = 0.0;        ///< lx, of a surface that faces the sun; 0: no sun
    double sun_radius = 0.004654;        ///< radians, half of its angular diameter
    double ground_albedo = 0.2;          ///< of the plain below the horizon
    bool keeps_sun = false;              ///< has a sun of 0 lx rather than none
};

/// A CIE standard sky, white, above an endless Lambert plain, with the sun's disc.
class SkyDome final : public Environment {
  public:
    explicit SkyDome(const SkyDomeSettings& settings);

    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const override;
    [[nodiscard]] glm::dvec3 shown(const glm::dvec3& direction) const override;
    [[nodiscard]] glm::dvec3 mean() const override { return mean_; }
    [[nodiscard]] const std::vector<SkySource>& sources() const override { return sources_; }
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] bool is_image() const override { return false; }
    [[nodiscard]] bool draws_sources() const override { return true; }
    [[nodiscard]] double illuminance() const override { return sky_illuminance_; }
    [[nodiscard]] std::shared_ptr<const Environment> dimmed(
        const glm::dvec3& sky, std::span<const glm::dvec3> sources) const override;

    /// Of an unobstructed horizontal plane, lx, by the sky without the sun, as made.
    [[nodiscard]] double sky_illuminance() const { return sky_illuminance_; }
    /// Of the ground, cd/m².
    [[nodiscard]] double ground_luminance() const {
        return static_cast<double>(luminance(glm::vec3(ground_)));
    }
    [[nodiscard]] const SkyDomeSettings& settings() const { return settings_; }
    [[nodiscard]] bool same_shape(const Environment& other) const override;

  private:
    void set_light(const glm::dvec3& sky, const glm::dvec3& sun);

    SkyDomeSettings settings_;
    glm::dvec3 sun_;
    double sky_illuminance_, mean_luminance_;  // as made, of the upper half
    glm::dvec3 sky_{1.0};                      // factor of both
    glm::dvec3 ground_{0.0}, mean_{0.0};       // cd/m²
    std::vector<SkySource> sources_;
};

/// Zenith luminance, cd/m², of a sky that sends its typical illuminance.
double typical_zenith_luminance(const CieSky& sky, double sun_elevation);

}  // namespace raybundle
