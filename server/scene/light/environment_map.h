// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/light/environment.h"

namespace raybundle {

/// An equirectangular image of radiance, linear. Row 0 shows the zenith; its middle column looks
/// north (-Z) and columns go clockwise as seen from above, so that a quarter to the right is east
/// (+X).
struct EquirectangularImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;     ///< width * height
    std::vector<std::string> notes{};  ///< what a user should know about how it was read

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

struct EnvironmentMapSettings {
    std::string name;       ///< for people: the file's
    double rotation = 0.0;  ///< radians, clockwise as seen from above
    double scale = 1.0;     ///< cd/m² of one unit of the image
};

/// An image as environment. What is many times brighter than its mean and small is taken out of
/// radiance() and becomes a source: no number of random directions finds a sun.
class EnvironmentMap final : public Environment {
  public:
    /// The image must have pixels, finite and not negative.
    EnvironmentMap(EquirectangularImage image, const EnvironmentMapSettings& settings);

    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const override;
    [[nodiscard]] glm::dvec3 shown(const glm::dvec3& direction) const override;
    [[nodiscard]] glm::dvec3 mean() const override { return mean_; }
    [[nodiscard]] const std::vector<SkySource>& sources() const override { return sources_; }
    [[nodiscard]] std::string description() const override;
    [[nodiscard]] bool is_image() const override { return true; }
    [[nodiscard]] bool draws_sources() const override { return false; }
    [[nodiscard]] bool same_shape(const Environment& other) const override;
    [[nodiscard]] std::shared_ptr<const Environment> dimmed(
        const glm::dvec3& sky, std::span<const glm::dvec3> sources) const override;

  private:
    [[nodiscard]] glm::dvec3 look_up(const std::vector<glm::vec3>& pixels,
                                     const glm::dvec3& direction) const;
    [[nodiscard]] glm::dvec3 pixel_direction(int x, int y) const;
    [[nodiscard]] double solid_angle(int y) const;
    [[nodiscard]] double mean_luminance(double limit) const;
    void take_sources();
    void take_source(std::span<const int> spot, const glm::vec3& limit);

    [[nodiscard]] glm::dvec3 source_share(const glm::dvec3& direction) const;

    /// Shared by dimmed copies.
    struct Pixels {
        EquirectangularImage image;
        std::vector<glm::vec3> sourceless;  // empty where there are no sources
        std::vector<SkySource> sources;
        glm::dvec3 mean{0.0};

        [[nodiscard]] const std::vector<glm::vec3>& sky() const {
            return sourceless.empty() ? image.pixels : sourceless;
        }
    };
    std::shared_ptr<Pixels> pixels_;
    EnvironmentMapSettings settings_;
    glm::dvec3 sky_{1.0}, mean_{0.0};
    std::vector<glm::dvec3> source_factors_;  // empty: 1
    std::vector<SkySource> sources_;
};

/// Decodes a Radiance HDR or OpenEXR file. Refuses images of another layout. Throws SceneError
/// naming `file`.
EquirectangularImage read_equirectangular(const std::string& file,
                                          std::span<const std::uint8_t> bytes);

}  // namespace raybundle
