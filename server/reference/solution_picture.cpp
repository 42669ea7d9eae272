// SPDX-License-Identifier: Apache-2.0
#include "reference/solution_picture.h"

#include <tbb/parallel_for.h>

#include <glm/gtc/constants.hpp>

#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr int rays_per_side = 4;

/// Calls visit(pixel, corner) for every pixel, on all threads.
template <typename Visit>
void for_each_pixel(const glm::uvec2& size, const Visit& visit) {
    tbb::parallel_for(std::size_t{0}, std::size_t{size.y}, [&](std::size_t y) {
        for (std::size_t x = 0; x < size.x; ++x) {
            visit(y * size.x + x, glm::dvec2(static_cast<double>(x), static_cast<double>(y)));
        }
    });
}

glm::dvec3 radiance(const RayScene& scene, const AlbedoTables& tables,
                    const InterpolatedIrradiance& irradiance,
                    const std::optional<SurfacePoint>& hit, const glm::dvec3& direction) {
    if (!hit) {
        return background_towards(scene.scene(), direction);
    }
    if (hit->absorbs()) {
        return glm::dvec3(0.0);
    }
    const Scattering scattering(scene, *hit, NormalKind::shading, -direction);
    return scene.shown_emission(*hit) + main_part(tables,
                                                  scene.mesh().triangle_material[hit->triangle],
                                                  scattering, irradiance.at(*hit));
}

}  // namespace

InterpolatedIrradiance::InterpolatedIrradiance(const RayScene& scene,
                                               std::span<const glm::dvec3> patches)
    : scene_(scene), vertices_(2 * scene.mesh().positions.size(), glm::dvec3(0.0)) {
    const PatchMesh& mesh = scene.mesh();
    std::vector<double> areas(vertices_.size(), 0.0);
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
        const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
        const std::size_t side = patch < mesh.triangle_count() ? 0 : 1;
        const double area = scene.patch_area(patch);
        for (int k = 0; k < 3; ++k) {
            vertices_[2 * std::size_t{t[k]} + side] += area * patches[patch];
            areas[2 * std::size_t{t[k]} + side] += area;
        }
    }
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        vertices_[i] = areas[i] > 0.0 ? vertices_[i] / areas[i] : glm::dvec3(0.0);
    }
}

glm::dvec3 InterpolatedIrradiance::at(const SurfacePoint& point) const {
    const glm::uvec3& t = scene_.mesh().triangles[point.triangle];
    const std::size_t side = point.patch < scene_.mesh().triangle_count() ? 0 : 1;
    const glm::dvec2& b = point.barycentric;
    return (1.0 - b.x - b.y) * vertices_[2 * std::size_t{t.x} + side] +
           b.x * vertices_[2 * std::size_t{t.y} + side] +
           b.y * vertices_[2 * std::size_t{t.z} + side];
}

glm::dvec3 main_part(const AlbedoTables& tables, std::uint32_t material,
                     const Scattering& scattering, const glm::dvec3& irradiance) {
    return glm::one_over_pi<double>() * tables.albedo(material, scattering) * irradiance;
}

std::vector<glm::dvec3> picture_of(const RayScene& scene, const AlbedoTables& tables,
                                   const CameraRays& camera,
                                   const InterpolatedIrradiance& irradiance) {
    std::vector<glm::dvec3> picture(std::size_t{camera.size().x} * camera.size().y);
    for_each_pixel(camera.size(), [&](std::size_t pixel, const glm::dvec2& corner) {
        glm::dvec3 sum(0.0);
        for (int k = 0; k < rays_per_side * rays_per_side; ++k) {
            const glm::dvec2 cell(k % rays_per_side, k / rays_per_side);
            const glm::dvec3 direction =
                camera.direction(corner + (cell + 0.5) / double{rays_per_side});
            sum += radiance(scene, tables, irradiance, scene.trace(camera.origin(), direction),
                            direction);
        }
        picture[pixel] = sum / double{rays_per_side * rays_per_side};
    });
    return picture;
}

std::vector<std::optional<SurfacePoint>> pixel_centres(const RayScene& scene,
                                                       const CameraRays& camera) {
    std::vector<std::optional<SurfacePoint>> centres(std::size_t{camera.size().x} *
                                                     camera.size().y);
    for_each_pixel(camera.size(), [&](std::size_t pixel, const glm::dvec2& corner) {
        centres[pixel] = scene.trace(camera.origin(), camera.direction(corner + 0.5));
    });
    return centres;
}

}  // namespace raybundle
