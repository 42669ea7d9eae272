// SPDX-License-Identifier: Apache-2.0
// Patches are small where direct light changes within them and surfaces close by see it.
#include "scene/contact/near_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/scene_builder.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::near_field_test {
namespace {

constexpr float albedo = 0.5F;

/// A floor of 4 x 4 m under a lamp as large, 2 m above. Optionally a board 1 m above one half of
/// the floor, and an upright board, 0.4 m high, that stands on it along the middle of the shadow's
/// edge.
struct LitFloor {
    explicit LitFloor(bool shadow, bool neighbour) {
        const auto paint = b.add_material(glm::vec3(albedo));
        const auto black = b.add_material(glm::vec3(0.0F));
        const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
        b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 1, 1, paint);
        b.add_quad({-0.5F, 2, -0.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
        if (shadow) {
            b.add_box({-2, 1, -2}, {0, 1.05F, 2}, false, 1, black);
        }
        if (neighbour) {
            b.add_box({0.3F, 0, -0.5F}, {0.32F, 0.4F, 0.5F}, false, 1, paint);
        }
        scene = b.loaded_scene();
    }

    /// Of a triangle of the floor that the shadow's edge crosses, with edges of half a metre.
    [[nodiscard]] double misplaced() const {
        return NearField(scene).misplaced_flux(
            {{glm::dvec3(-0.2, 0, -0.25), glm::dvec3(-0.2, 0, 0.25), glm::dvec3(0.25, 0, 0)}}, 0.0);
    }

    SceneBuilder b;
    Scene scene;
};

double shortest_edge(const PatchMesh& mesh, bool floor) {
    double shortest = 1e9;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        if ((std::max({p[0].y, p[1].y, p[2].y}) == 0.0F) == floor) {
            for (int k = 0; k < 3; ++k) {
                shortest =
                    std::min(shortest, static_cast<double>(glm::distance(p[k], p[(k + 1) % 3])));
            }
        }
    }
    return shortest;
}

TEST(NearField, CountsLightThatChangesBesideASurface) {
    EXPECT_EQ(LitFloor(true, false).misplaced(), 0.0);  // nobody is near
    const double even = LitFloor(false, true).misplaced();
    const double shadow = LitFloor(true, true).misplaced();
    EXPECT_GT(even, 0.0);
    EXPECT_GT(shadow, 5.0 * even);
}

TEST(NearField, AShadowsEdgeMisplacesHalfTheLight) {
    // Illuminance about E on one half and 0 on the other: standard deviation E/2, less in a
    // penumbra. The board takes a part of the light below a half, and reflects half of it.
    const LitFloor floor(true, true);
    const double area = 0.5 * 0.5 * 0.45;
    const double flux = NearField(floor.scene)
                            .direct_flux({{glm::dvec3(0.5, 0, -0.25), glm::dvec3(0.5, 0, 0.25),
                                           glm::dvec3(0.95, 0, 0)}});
    const double lit = flux / area;  // lx, beside it in full light
    const double half = 0.5 * lit * area * double{albedo};
    EXPECT_GT(floor.misplaced(), 0.03 * half * double{albedo});
    EXPECT_LT(floor.misplaced(), half * double{albedo});
}

TEST(NearField, DirectFluxOfALampIsThatOfADisc) {
    // A square lamp of 1 m², 2 m above: E = 1000 cd/m² * F, F = 0.2387 for a point under its middle
    // (form factor of a rectangle, Siegel and Howell), within what 48 points make of it.
    const LitFloor floor(false, false);
    const double side = 0.5;
    const double c = side / 2.0;
    const double form_factor = 4.0 / (2.0 * std::acos(-1.0)) * 2.0 * c / std::hypot(1.0, c) *
                               std::atan(c / std::hypot(1.0, c));
    const double e = std::acos(-1.0) * 1000.0 * form_factor;
    const glm::dvec3 size(0.02, 0, 0.02);
    const double flux = NearField(floor.scene)
                            .direct_flux({{glm::dvec3(0, 0, 0), glm::dvec3(0, 0, size.z),
                                           glm::dvec3(size.x, 0, 0)}});
    EXPECT_NEAR(flux / (0.5 * size.x * size.z), e, 0.02 * e);
}

TEST(NearField, PatchesAreFinerThereAndNowhereElse) {
    TessellationSettings settings;
    settings.patch_size = 0.5F;
    Scene plain = LitFloor(true, false).scene;
    Scene beside = LitFloor(true, true).scene;
    const PatchMesh coarse = tessellate(plain, settings);
    const PatchMesh fine = tessellate(beside, settings);
    EXPECT_GT(shortest_edge(coarse, true), 0.2);
    EXPECT_LT(shortest_edge(fine, true), 0.1);
    EXPECT_LE(fine.patch_count(), 2 * coarse.patch_count());
    for (const glm::uvec3& t : fine.triangles) {
        const glm::vec3 middle =
            (fine.positions[t.x] + fine.positions[t.y] + fine.positions[t.z]) / 3.0F;
        const float edge = glm::distance(fine.positions[t.x], fine.positions[t.y]);
        if (middle.y == 0.0F && edge < 0.12F) {
            EXPECT_LT(std::abs(middle.x), 1.0F);  // at the foot of the board
        }
    }
}

/// A lamp of 1 m² that shines to both sides, 5 mm below a ceiling: what leaves a patch that lies
/// half in the slot and half beside it would get out by half.
TEST(NearField, CeilingsAreCutAlongTheRimOfALampBelow) {
    SceneBuilder b;
    Material lamp;
    lamp.base_colour = glm::vec3(0.8F);
    lamp.metallic = lamp.specular = 0.0F;
    lamp.emission = glm::vec3(1000.0F);
    lamp.double_sided = true;
    b.add_quad({-2, 2, -2}, {4, 0, 0}, {0, 0, 4}, 1, 1, b.add_material(glm::vec3(albedo)));
    b.add_quad({-0.47F, 1.995F, -0.53F}, {1, 0, 0}, {0, 0, 1}, 1, 1, b.add_material(lamp));
    Scene scene = b.loaded_scene();
    TessellationSettings settings;
    settings.patch_size = 0.1F;
    const PatchMesh mesh = tessellate(scene, settings);
    double half_in = 0.0;  // m²
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        int inside = 0;
        for (const glm::vec3& corner : p) {
            inside += corner.x > -0.47F && corner.x < 0.53F && corner.z > -0.53F &&
                              corner.z < 0.47F && corner.y == 2.0F
                          ? 1
                          : 0;
        }
        if (inside == 1 || inside == 2) {
            half_in += 0.5 * static_cast<double>(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
        }
    }
    EXPECT_GT(half_in, 0.0);
    EXPECT_LT(half_in, 0.09);  // seen: 0.071; 0.123 where the lamp was 48 points
}

/// Wherever rounding puts a place on a lamp, it is not lit by that.
TEST(NearField, ALampDoesNotLightItself) {
    for (const float tilt : {0.0F, 0.1F, 0.7F}) {
        SceneBuilder b;
        Material lamp;
        lamp.metallic = lamp.specular = 0.0F;
        lamp.emission = glm::vec3(1000.0F);
        lamp.double_sided = true;
        const glm::dvec3 along(std::cos(tilt), std::sin(tilt), 0.3);
        const glm::dvec3 across(-0.1, 0.4, 1.0);
        b.add_quad({0, 0, 0}, glm::vec3(along), glm::vec3(across), 1, 1, b.add_material(lamp));
        const Scene scene = b.loaded_scene();
        const NearField field(scene);
        const glm::dvec3 corner = 0.21 * along + 0.13 * across;
        EXPECT_EQ(
            field.direct_flux({{corner, corner + 0.3 * along, corner + 0.3 * across}, 0, true}),
            0.0);
    }
}

TEST(NearField, NoLightNoWork) {
    SceneBuilder b;
    const auto paint = b.add_material(glm::vec3(albedo));
    b.add_box({0, 0, 0}, {2, 2, 2}, true, 1, paint);
    b.add_box({0.5F, 0, 0.5F}, {1, 0.5F, 1}, false, 1, paint);
    Scene scene = b.loaded_scene();
    TessellationSettings settings;
    settings.patch_size = 1.0F;
    EXPECT_LT(tessellate(scene, settings).patch_count(), 200U);
}

}  // namespace
}  // namespace raybundle::near_field_test
