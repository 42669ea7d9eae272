// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// Something so bright and small in the sky that it is a light of its own, as the sun is.
struct SkySource {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< to it, unit, world space
    glm::vec3 illuminance{0.0F};          ///< of a surface that faces it, lx
    float angular_radius = 0.0F;          ///< radians
};

/// Light from infinitely far away, over direction. World space; directions are unit and point away
/// from the scene. Immutable.
class Environment {
  public:
    virtual ~Environment() = default;
    /// What is transferred as sky: without its sources, cd/m².
    [[nodiscard]] virtual glm::dvec3 radiance(const glm::dvec3& direction) const = 0;
    /// What is seen: with its sources, cd/m².
    [[nodiscard]] virtual glm::dvec3 shown(const glm::dvec3& direction) const = 0;
    /// Mean of radiance() over all directions.
    [[nodiscard]] virtual glm::dvec3 mean() const = 0;
    [[nodiscard]] virtual const std::vector<SkySource>& sources() const = 0;
    /// For people: "CIE type 12, sun at 45 degrees".
    [[nodiscard]] virtual std::string description() const = 0;
    [[nodiscard]] virtual bool is_image() const = 0;
    /// Sources are drawn as discs in the picture; else shown() has them at its own resolution.
    [[nodiscard]] virtual bool draws_sources() const = 0;
    /// Of an unobstructed horizontal plane by the sky without sources, lx; 0: not stated.
    [[nodiscard]] virtual double illuminance() const { return 0.0; }
    /// A copy with its sky and each source multiplied, relative to what it was made with; the
    /// ground that both light follows.
    [[nodiscard]] virtual std::shared_ptr<const Environment> dimmed(
        const glm::dvec3& sky, std::span<const glm::dvec3> sources) const = 0;

    /// Whether both differ by no more than what dimmed() changes.
    [[nodiscard]] virtual bool same_shape(const Environment& other) const = 0;

  protected:
    Environment() = default;
    Environment(const Environment&) = default;
    Environment& operator=(const Environment&) = default;
};

/// What lines see that leave a scene, without what is a light of its own.
struct Sky {
    glm::vec3 uniform{0.0F};  ///< cd/m²
    std::shared_ptr<const Environment> environment;

    /// Radiance, cd/m².
    [[nodiscard]] glm::dvec3 towards(const glm::dvec3& direction) const;
    /// Over all directions, cd/m².
    [[nodiscard]] glm::dvec3 mean() const;
};
Sky sky_of(const Scene& scene);

/// Radiance of lines that leave the scene, cd/m²: the uniform sky and the environment, without what
/// is a light of its own.
glm::dvec3 sky_towards(const Scene& scene, const glm::dvec3& direction);
/// The same with all that an eye sees.
glm::dvec3 background_towards(const Scene& scene, const glm::dvec3& direction);
/// Mean of sky_towards() over all directions.
glm::dvec3 mean_sky(const Scene& scene);
/// Whether there is one, be it switched off.
bool has_sky(const Scene& scene);
/// The scene's sky as a light, as loaded; nothing where it has none that shines.
std::optional<SkyLight> find_sky_light(const Scene& scene);
/// Gives the sky the light that Scene::sky_light and the suns among the scene's lights have now.
void refresh_sky(Scene& scene);
/// Makes it the scene's, its sources lights of the scene.
void set_environment(std::shared_ptr<const Environment> environment, Scene& scene);
/// Takes it out again, and the lights that it brought.
void remove_environment(Scene& scene);

}  // namespace raybundle
