// SPDX-License-Identifier: Apache-2.0
// Light that lamps throw through mirrors and glass on other surfaces: closed forms per patch, and
// path tracing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "oracle/scene_builder.h"
#include "pictures.h"
#include "scene/material/specular_surface.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::caustics_test {
namespace {

using std::numbers::pi;

Material mirror_material() {
    Material material;
    material.base_colour = {0.9F, 0.8F, 0.6F};
    material.metallic = 1.0F;
    material.roughness = 0.0F;
    return material;
}

Material glass_material(const glm::vec3& colour, float thickness) {
    Material material;
    material.base_colour = colour;
    material.metallic = 0.0F;
    material.roughness = 0.0F;
    material.transmission = 1.0F;
    material.thickness = thickness;
    return material;
}

/// Bends off at every face, as a solid does.
void add_ball(SceneBuilder& b, const glm::vec3& centre, float radius, std::uint32_t material) {
    constexpr int rings = 24;
    constexpr int columns = 48;
    const auto normal = [](int ring, int column) {
        const double theta = pi * ring / rings;
        const double phi = 2.0 * pi * column / columns;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
    };
    const std::size_t first = b.mesh.positions.size();
    for (int ring = 0; ring < rings; ++ring) {
        for (int column = 0; column < columns; ++column) {
            const glm::vec3 p00 = centre + radius * normal(ring, column);
            const glm::vec3 p01 = centre + radius * normal(ring, column + 1);
            const glm::vec3 p10 = centre + radius * normal(ring + 1, column);
            const glm::vec3 p11 = centre + radius * normal(ring + 1, column + 1);
            if (ring > 0) {
                b.add_triangle(p00, p01, p11, material);
            }
            if (ring + 1 < rings) {
                b.add_triangle(p00, p11, p10, material);
            }
        }
    }
    for (std::size_t i = first; i < b.mesh.positions.size(); ++i) {
        b.mesh.normals[i] = glm::normalize(b.mesh.positions[i] - centre);
    }
}

SolverSettings settings_for(std::uint64_t seed = 1) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {128, 200};
    settings.coarse_iterations = 1'000'000;
    return settings;
}

void iterate(Solver& solver, int iterations) {
    for (int i = 0; i < iterations; ++i) {
        solver.step({});
    }
}

double patch_area(const PatchMesh& mesh, std::size_t patch) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    return 0.5 *
           static_cast<double>(glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                      mesh.positions[t.z] - mesh.positions[t.x])));
}

glm::vec3 centroid(const PatchMesh& mesh, std::size_t patch) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
}

/// Relative RMS over patches that `expected` knows, in all channels.
template <typename Expected>
double error_of(const std::vector<glm::vec4>& found, const PatchMesh& mesh, Expected expected) {
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < mesh.patch_count(); ++i) {
        const std::optional<glm::dvec3> exact = expected(centroid(mesh, i));
        if (exact) {
            const glm::dvec3 difference = glm::dvec3(found[i]) - *exact;
            square += glm::dot(difference, difference);
            total += glm::dot(*exact, *exact);
        }
    }
    return std::sqrt(square / total);
}

/// A lamp that shines up at a mirror below the ceiling: all light on the floor comes from its
/// image.
TEST(HeavyCaustics, AFlatMirrorThrowsTheLightOfItsImage) {
    SceneBuilder b;
    b.add_quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, 12, 12, b.add_material(glm::vec3(0.0F)));
    const auto mirror = b.add_material(mirror_material());
    b.add_quad({-4, 3, -4}, {8, 0, 0}, {0, 0, 8}, 16, 16, mirror);
    constexpr float radiance = 1000.0F;
    b.add_quad({-0.1F, 1, -0.1F}, {0, 0, 0.2F}, {0.2F, 0, 0}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(radiance)));
    Solver solver(b.scene, b.mesh, settings_for());
    iterate(solver, 6144);
    const SpecularSurface surface =
        specular_surface(b.scene.materials[mirror], b.scene.materials[mirror].base_colour);
    const auto expected = [&](const glm::vec3& at) -> std::optional<glm::dvec3> {
        if (at.y > 0.01F || std::hypot(at.x, at.z) < 0.5F) {  // there the lamp's own shadow lies
            return std::nullopt;
        }
        const glm::vec3 way = at - glm::vec3(0, 5, 0);
        const float square = glm::dot(way, way);
        const float cosine = 5.0F / std::sqrt(square);
        return glm::dvec3(mirror_reflectance(surface, cosine) *
                          (radiance * 0.04F * cosine * cosine / square));
    };
    EXPECT_LT(error_of(solver.store().read_irradiance(), b.mesh, expected), 0.05);
}

/// A bare lamp above a tinted pane: what passes by its shares, and nothing of what does not.
TEST(Caustics, AFlatPaneLetsItsShareThrough) {
    SceneBuilder b;
    b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 8, 8, b.add_material(glm::vec3(0.0F)));
    const auto pane = b.add_material(glass_material({0.9F, 0.6F, 0.3F}, 0.0F));
    b.add_quad({-2, 1, -2}, {0, 0, 4}, {4, 0, 0}, 1, 1, pane);
    PunctualLight lamp;
    lamp.kind = PunctualKind::point;
    lamp.position = {0, 2, 0};
    lamp.intensity = glm::vec3(100.0F);
    b.scene.punctual_lights.push_back(lamp);
    Solver solver(b.scene, b.mesh, settings_for());
    iterate(solver, 1024);
    const SpecularSurface surface =
        specular_surface(b.scene.materials[pane], b.scene.materials[pane].base_colour);
    const auto expected = [&](const glm::vec3& at) -> std::optional<glm::dvec3> {
        if (at.y > 0.01F) {
            return std::nullopt;
        }
        const glm::vec3 way = at - lamp.position;
        const float square = glm::dot(way, way);
        const float cosine = 2.0F / std::sqrt(square);
        return glm::dvec3(pane_shares(surface, cosine).transmitted * (100.0F * cosine / square));
    };
    EXPECT_LT(error_of(solver.store().read_irradiance(), b.mesh, expected), 0.03);
}

/// The same with an emitting surface, whose light bundles carry, too, and dim by chance.
TEST(Caustics, AFlatPaneLetsTheShareOfAnEmitterThrough) {
    SceneBuilder b;
    b.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 8, 8, b.add_material(glm::vec3(0.0F)));
    const auto pane = b.add_material(glass_material({0.9F, 0.6F, 0.3F}, 0.0F));
    b.add_quad({-2, 1, -2}, {0, 0, 4}, {4, 0, 0}, 1, 1, pane);
    constexpr float radiance = 1000.0F;
    b.add_quad({-0.1F, 2, -0.1F}, {0.2F, 0, 0}, {0, 0, 0.2F}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(radiance)));
    Solver solver(b.scene, b.mesh, settings_for());
    iterate(solver, 1024);
    const SpecularSurface surface =
        specular_surface(b.scene.materials[pane], b.scene.materials[pane].base_colour);
    const auto expected = [&](const glm::vec3& at) -> std::optional<glm::dvec3> {
        if (at.y > 0.01F) {
            return std::nullopt;
        }
        const glm::vec3 way = at - glm::vec3(0, 2, 0);
        const float square = glm::dot(way, way);
        const float cosine = 2.0F / std::sqrt(square);
        return glm::dvec3(pane_shares(surface, cosine).transmitted *
                          (radiance * 0.04F * cosine * cosine / square));
    };
    EXPECT_LT(error_of(solver.store().read_irradiance(), b.mesh, expected), 0.05);
}

/// A black room with a lamp and something that neither takes light nor gives any.
SceneBuilder black_room_with_ball(const glm::vec3& ball_at, float radiance = 400.0F) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {2, 2, 2}, true, 8, b.add_material(glm::vec3(0.0F)));
    b.add_quad({0.8F, 1.98F, 0.8F}, {0.4F, 0, 0}, {0, 0, 0.4F}, 2, 2,
               b.add_material(glm::vec3(0.0F), glm::vec3(radiance)));
    Transform transform;
    transform.translation = ball_at;
    b.add_object("ball", transform);
    add_ball(b, glm::vec3(0.0F), 0.35F, b.add_material(glass_material(glm::vec3(1.0F), 0.7F)));
    return b;
}

std::vector<glm::vec3> floor_of(const SceneBuilder& b, const Solver& solver) {
    const std::vector<glm::vec4> all = solver.store().read_irradiance();
    std::vector<glm::vec3> floor;
    for (std::size_t i = 0; i < b.mesh.patch_count(); ++i) {
        if (b.mesh.vertex_object[b.mesh.triangles[i].x] == 0 && centroid(b.mesh, i).y < 0.01F) {
            floor.emplace_back(all[i]);
        }
    }
    return floor;
}

double difference_of(const std::vector<glm::vec3>& found, const std::vector<glm::vec3>& exact) {
    double square = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        square += static_cast<double>(glm::dot(found[i] - exact[i], found[i] - exact[i]));
        total += static_cast<double>(glm::dot(exact[i], exact[i]));
    }
    return std::sqrt(square / total);
}

/// Whatever way a ball of clear glass bends the light: it all arrives somewhere.
TEST(Caustics, AGlassBallKeepsTheFlux) {
    const SceneBuilder b = black_room_with_ball({1.0F, 0.6F, 1.0F});
    Solver solver(b.scene, b.mesh, settings_for());
    iterate(solver, 256);
    const auto irradiance = solver.store().read_irradiance();
    double flux = 0.0;
    for (std::size_t i = 0; i < b.mesh.patch_count(); ++i) {
        flux += b.mesh.vertex_object[b.mesh.triangles[i].x] == 0
                    ? patch_area(b.mesh, i) * static_cast<double>(irradiance[i].g)
                    : 0.0;
    }
    const double sent = pi * 400.0 * 0.16;
    EXPECT_NEAR(flux, sent, 0.02 * sent);
}

/// The ball moves, and a lamp is dimmed: its caustic is that of a scene that has always been so.
TEST(Caustics, TheyFollowAMoveAndALamp) {
    SceneBuilder moved = black_room_with_ball({1.0F, 0.6F, 1.0F});
    Solver solver(moved.scene, moved.mesh, settings_for());
    iterate(solver, 256);
    const auto before = floor_of(moved, solver);
    solver.move_object(1, glm::translate(glm::mat4(1.0F), {0.6F, 0.6F, 1.2F}), {});
    while (solver.correcting()) {
        solver.step({});
    }
    const std::array<std::uint32_t, 1> lamp = {1};
    moved.scene.materials[1].emission *= 0.25F;
    solver.change_surfaces(moved.scene, moved.mesh, lamp, {}, {});
    while (solver.correcting()) {
        solver.step({});
    }
    iterate(solver, 256);
    const SceneBuilder there = black_room_with_ball({0.6F, 0.6F, 1.2F}, 100.0F);
    Solver fresh(there.scene, there.mesh, settings_for(2));
    iterate(fresh, 256);
    const auto expected = floor_of(there, fresh);
    EXPECT_GT(difference_of(before, expected), 1.0);
    EXPECT_LT(difference_of(floor_of(moved, solver), expected), 0.06);
}

TEST(Caustics, EqualSeedsGiveEqualBits) {
    const auto solved = [] {
        const SceneBuilder b = black_room_with_ball({1.0F, 0.6F, 1.0F});
        Solver solver(b.scene, b.mesh, settings_for());
        iterate(solver, 24);
        return solver.store().read_irradiance();
    };
    EXPECT_EQ(solved(), solved());
}

/// Where nothing is a mirror or glass, or nothing shines, there are none: no shader knows of them.
TEST(Caustics, OtherScenesDoNotPayForThem) {
    SceneBuilder plain;
    plain.add_box({0, 0, 0}, {2, 2, 2}, true, 2,
                  plain.add_material(glm::vec3(0.5F), glm::vec3(1.0F)));
    SceneBuilder dark = plain;
    dark.scene.materials[0].emission = glm::vec3(0.0F);
    dark.mesh.emission.assign(dark.mesh.emission.size(), glm::vec3(0.0F));
    dark.add_box({0.5F, 0.5F, 0.5F}, {1, 1, 1}, false, 1, dark.add_material(mirror_material()));
    for (const SceneBuilder* b : {&plain, &dark}) {
        const GpuScene scene(b->scene, b->mesh);
        EXPECT_FALSE(scene.caustics());
        const auto& defines = scene.defines();
        EXPECT_EQ(std::find(defines.begin(), defines.end(), "CAUSTICS 1"), defines.end());
    }
}

constexpr glm::uvec2 picture_size(48, 48);

/// Block means of a picture of the floor against path tracing.
double difference_from_paths(const SceneBuilder& b, const Camera& camera, int iterations,
                             std::uint32_t paths, unsigned block) {
    const auto truth = path_traced_centres(b.scene, b.mesh, camera, picture_size, paths);
    Solver solver(b.scene, b.mesh, settings_for());
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, picture_size);
    image.set_camera(camera);
    BundleReceiver* const receivers[] = {&image};
    for (int i = 0; i < iterations; ++i) {
        solver.step(receivers);
    }
    return block_difference(image.read_radiance(), truth, picture_size, block);
}

Camera down_at_the_floor() {
    Camera camera;
    camera.eye = {1.0F, 0.2F, 1.9F};
    camera.target = {1.0F, 0.0F, 1.3F};
    camera.vertical_fov = 1.0F;
    return camera;
}

SceneBuilder lit_room(const Material& ball_material) {
    SceneBuilder b;
    b.add_box({0, 0, 0}, {2, 2, 2}, true, 24, b.add_material({0.6F, 0.5F, 0.4F}));
    b.add_quad({0.7F, 1.98F, 0.7F}, {0.6F, 0, 0}, {0, 0, 0.6F}, 2, 2,
               b.add_material(glm::vec3(0.0F), glm::vec3(400.0F)));
    add_ball(b, {1.0F, 0.5F, 0.9F}, 0.35F, b.add_material(ball_material));
    return b;
}

TEST(HeavyCaustics, AGlassBallAgreesWithPathTracing) {
    const SceneBuilder b = lit_room(glass_material({0.9F, 1.0F, 0.8F}, 0.7F));
    EXPECT_LT(difference_from_paths(b, down_at_the_floor(), 1024, 4096, 6), 0.05);
}

TEST(HeavyCaustics, AMirrorBallAgreesWithPathTracing) {
    const SceneBuilder b = lit_room(mirror_material());
    EXPECT_LT(difference_from_paths(b, down_at_the_floor(), 1024, 1024, 6), 0.05);
}

}  // namespace
}  // namespace raybundle::caustics_test
