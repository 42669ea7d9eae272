// SPDX-License-Identifier: Apache-2.0
// Light that other surfaces and the sky throw through glass and by mirrors (DS+D), by quadrature.
// In none of the scenes does a lamp shine at these.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "oracle/scene_builder.h"
#include "scene/material/specular_surface.h"
#include "transport/solver.h"

namespace raybundle::surface_rays_test {
namespace {

using std::numbers::pi;
constexpr float wall_albedo = 0.8F;

Material specular_material(const glm::vec3& colour, float metallic, float transmission) {
    Material material;
    material.base_colour = colour;
    material.metallic = metallic;
    material.roughness = 0.0F;
    material.transmission = transmission;
    return material;
}

/// A point that sends or receives, and the area that it stands for.
struct Place {
    std::size_t patch;
    glm::dvec3 at;
    double area;
};

std::vector<Place> places_of(const PatchMesh& mesh, std::uint32_t material) {
    std::vector<Place> found;
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        if (mesh.triangle_material[i] != material) {
            continue;
        }
        const glm::uvec3& t = mesh.triangles[i];
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 b(mesh.positions[t.y]);
        const glm::dvec3 c(mesh.positions[t.z]);
        found.push_back({i, (a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))});
    }
    return found;
}

std::vector<glm::vec4> solved(const SceneBuilder& b, int iterations) {
    SolverSettings settings;
    settings.seed = 3;
    settings.coarse = {128, 200};
    settings.coarse_iterations = 1'000'000;
    Solver solver(b.scene, b.mesh, settings);
    for (int i = 0; i < iterations; ++i) {
        solver.step({});
    }
    return solver.store().read_irradiance();
}

/// A spot from above, on what lies around x, y below it.
void add_spot(SceneBuilder& b, const glm::vec3& at) {
    PunctualLight lamp;
    lamp.kind = PunctualKind::spot;
    lamp.position = at;
    lamp.intensity = glm::vec3(100.0F);
    lamp.inner_cosine = 0.9F;
    lamp.outer_cosine = 0.8F;
    b.scene.punctual_lights.push_back(lamp);
}

/// Flux that the receivers get over what should arrive there from the wall, which lies in z = 0 and
/// appears to them at that height; share(cosine): of it that arrives. By channels.
template <typename Share>
glm::dvec3 ratio_of_flux(const std::vector<glm::vec4>& irradiance, const std::vector<Place>& wall,
                         const std::vector<Place>& receivers, double height, Share share) {
    glm::dvec3 found(0.0);
    glm::dvec3 expected(0.0);
    for (const Place& x : receivers) {
        found += x.area * glm::dvec3(irradiance[x.patch]);
        for (const Place& y : wall) {
            const glm::dvec3 way(x.at.x - y.at.x, x.at.y - y.at.y, height);
            const double square = glm::dot(way, way);
            const double cosine = height / std::sqrt(square);
            const glm::dvec3 sent = glm::dvec3(irradiance[y.patch]) * (double{wall_albedo} / pi);
            expected += x.area * y.area * cosine * cosine / square * sent *
                        glm::dvec3(share(static_cast<float>(cosine)));
        }
    }
    EXPECT_GT(expected.g, 0.0);
    return found / expected;
}

void expect_near_one(const glm::dvec3& ratio, double bound) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(ratio[c], 1.0, bound) << "channel " << c;
    }
}

/// Bundles alone would take as much of all colours through: by luminance. Bound: more than three
/// standard deviations (1 % over four seeds).
TEST(SurfaceRays, ATintedPaneColoursTheLightOfAWall) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(wall_albedo));
    b.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 16, 16, wall);
    const auto receiver = b.add_material(glm::vec3(0.0F));
    b.add_quad({-0.5F, -0.5F, 3}, {0, 1, 0}, {1, 0, 0}, 3, 3, receiver);
    const auto pane = b.add_material(specular_material({0.9F, 0.5F, 0.2F}, 0.0F, 1.0F));
    b.add_quad({-3, -3, 2}, {6, 0, 0}, {0, 6, 0}, 1, 1, pane);
    add_spot(b, {0, 0, 1});
    const SpecularSurface glass =
        specular_surface(b.scene.materials[pane], b.scene.materials[pane].base_colour);
    const auto passing = [&](float cosine) { return pane_shares(glass, cosine).transmitted; };
    expect_near_one(ratio_of_flux(solved(b, 1024), places_of(b.mesh, wall),
                                  places_of(b.mesh, receiver), 3.0, passing),
                    0.04);
}

/// Light that bundles scatter about the mirrored direction is taken away again: counted twice it
/// would be far off. Bound: three standard deviations of what bundles bring (6 % over four seeds).
TEST(SurfaceRays, AMirrorShowsAWallToWhatLiesBesideIt) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(wall_albedo));
    b.add_quad({-4, -1, 0}, {2, 0, 0}, {0, 2, 0}, 16, 16, wall);
    const auto receiver = b.add_material(glm::vec3(0.0F));
    b.add_quad({2.5F, -0.5F, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3, receiver);
    const auto mirror = b.add_material(specular_material({0.9F, 0.8F, 0.6F}, 1.0F, 0.0F));
    b.add_quad({-5, -4, 2}, {0, 8, 0}, {10, 0, 0}, 16, 16, mirror);
    add_spot(b, {-3, 0, 1});
    const SpecularSurface surface =
        specular_surface(b.scene.materials[mirror], b.scene.materials[mirror].base_colour);
    const auto mirrored = [&](float cosine) { return mirror_reflectance(surface, cosine); };
    expect_near_one(ratio_of_flux(solved(b, 2048), places_of(b.mesh, wall),
                                  places_of(b.mesh, receiver), 4.0, mirrored),
                    0.2);
}

/// A black box below a skylight of clear glass: what the glass reflects stays outside. Bound: a
/// quarter of what would come in beyond that.
TEST(SurfaceRays, AWindowKeepsOutWhatItReflects) {
    constexpr float sky = 100.0F;
    constexpr int cells = 24;
    SceneBuilder b;
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto ground = b.add_material(glm::vec3(0.0F));
    b.add_quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, 8, 8, ground);
    b.add_quad({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 2, 1, black);
    b.add_quad({0, 0, 2}, {0, 1, 0}, {2, 0, 0}, 1, 2, black);
    b.add_quad({0, 0, 0}, {0, 1, 0}, {0, 0, 2}, 1, 2, black);
    b.add_quad({2, 0, 0}, {0, 0, 2}, {0, 1, 0}, 2, 1, black);
    const auto pane = b.add_material(specular_material(glm::vec3(1.0F), 0.0F, 1.0F));
    b.add_quad({0, 1, 0}, {0, 0, 2}, {2, 0, 0}, 1, 1, pane);
    b.scene.sky_radiance = glm::vec3(sky);
    const SpecularSurface glass = specular_surface(b.scene.materials[pane], glm::vec3(1.0F));
    const std::vector<glm::vec4> irradiance = solved(b, 1024);
    double found = 0.0;
    double expected = 0.0;
    double unglazed = 0.0;
    for (const Place& x : places_of(b.mesh, ground)) {
        found += x.area * static_cast<double>(irradiance[x.patch].g);
        for (int i = 0; i < cells * cells; ++i) {
            const glm::dvec3 way(2.0 * (i % cells + 0.5) / cells - x.at.x, 1.0,
                                 2.0 * (i / cells + 0.5) / cells - x.at.z);
            const double square = glm::dot(way, way);
            const double flux = x.area * 4.0 / (cells * cells) * double{sky} / (square * square);
            unglazed += flux;
            expected +=
                flux *
                static_cast<double>(
                    pane_shares(glass, static_cast<float>(1.0 / std::sqrt(square))).transmitted.g);
        }
    }
    ASSERT_GT(unglazed, 1.08 * expected);
    EXPECT_NEAR(found / expected, 1.0, 0.02);
}

}  // namespace
}  // namespace raybundle::surface_rays_test
