// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <vector>

#include "oracle/scene_builder.h"
#include "reference/path_tracer.h"

namespace raybundle {

/// Standard errors that an estimate may be off: passed by chance once in 150 000.
inline constexpr double sigmas = 4.5;

/// Nothing axis-aligned passes by luck.
inline glm::mat4 odd_rotation() {
    return glm::rotate(glm::mat4(1.0F), 0.7F, glm::normalize(glm::vec3(0.3F, 1.0F, 0.5F)));
}

/// A camera in the space before odd_rotation().
Camera camera_at(const glm::vec3& eye, const glm::vec3& target, float fov);

/// An L-shaped room that emits `emission` cd/m² everywhere: radiance emission/(1 - albedo).
SceneBuilder furnace_room(float albedo, float emission);

/// Flux of the lamp of enclosure(), lm.
constexpr double enclosure_flux = 10'000.0;
/// Surface of enclosure(), m².
constexpr double enclosure_surface = 96.0;
/// A 4 m cube of one albedo, 1 m² of its ceiling the lamp. `where` is applied before the rotation.
SceneBuilder enclosure(float albedo, const glm::mat4& where = glm::mat4(1.0F));

/// Two 4 m cubes side by side, `thickness` m of wall between them; the ceiling of the first one has
/// the lamp of enclosure(). Patches of the dark room begin at `first_dark`.
struct TwoRooms {
    SceneBuilder builder;
    std::uint32_t first_dark = 0;
};
TwoRooms two_rooms(float albedo, float thickness);

/// A material of every kind of lobe: plastic (GGX over Lambert), metal (GGX), max-Phong over
/// Lambert.
struct NamedMaterial {
    const char* name;
    Material material;
};
std::vector<NamedMaterial> glossy_materials();

/// Adds a sphere of `rings` rings of flat triangles, fronts inwards (a room) or outwards.
void add_sphere(SceneBuilder& builder, const glm::vec3& centre, float radius, int rings,
                bool inwards, std::uint32_t material);

/// Adds a material of any kind; returns its index.
std::uint32_t add_material(SceneBuilder& builder, const Material& material);

/// A lamp over a floor of this material, and a wall that cannot see it for a black screen: all its
/// light comes by the floor. Lengths about 1 m.
struct ScreenedLamp {
    SceneBuilder builder;
    std::uint32_t lamp = 0;   ///< its first patch; 2 patches
    std::uint32_t wall = 0;   ///< first patch; wall_patches
    std::uint32_t floor = 0;  ///< first patch
    static constexpr std::uint32_t wall_patches = 8;
};
ScreenedLamp screened_lamp(const Material& floor, const glm::vec3& wall_albedo,
                           const glm::vec3& lamp_emission = glm::vec3(1000.0F));

/// A mean with its standard error.
struct Estimate {
    double mean = 0.0;
    double standard_error = 0.0;
    double largest = 0.0;  ///< of the samples
};

/// Area mean of the irradiance (green channel) over patches [first, last), by independent paths.
Estimate mean_irradiance(const RayScene& scene, const PathTracer& tracer, std::uint32_t first,
                         std::uint32_t last, std::uint32_t paths, std::uint64_t seed = 1);

/// Irradiance (green channel) at one point.
Estimate irradiance_at(const PathTracer& tracer, const SurfacePoint& point, std::uint32_t paths,
                       std::uint64_t seed = 1);

/// What a path tracer needs, built from one scene.
struct Tracing {
    explicit Tracing(const SceneBuilder& builder, const PathSettings& settings = {})
        : scene(builder.scene, builder.mesh), lights(scene), tracer(scene, lights, settings) {}

    RayScene scene;
    LightSampling lights;
    PathTracer tracer;
};

}  // namespace raybundle
