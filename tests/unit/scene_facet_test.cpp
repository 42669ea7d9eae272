// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "scene/mesh/patch_mesh.h"

namespace raybundle {
namespace {

/// The walk of shaders/scene/facets.glsl.
std::uint32_t triangle_at(const PatchMesh& mesh, std::size_t facet, glm::dvec3 weights) {
    FacetNode node = mesh.facet_roots[facet];
    while ((node.code & FacetNode::leaf_bit) == 0) {
        std::uint32_t bisection = 0;
        std::uint32_t exit = 0;
        for (int level = 0; level < 3; ++level) {
            const std::uint32_t edge = node.code >> (2 * bisection) & 3U;
            bool second = false;
            if (edge != FacetNode::stop) {
                const glm::dvec3 w(weights[static_cast<int>(edge)],
                                   weights[static_cast<int>((edge + 1) % 3)],
                                   weights[static_cast<int>((edge + 2) % 3)]);
                second = w.x < w.y;
                weights = second ? glm::dvec3(2 * w.x, w.y - w.x, w.z)
                                 : glm::dvec3(w.x - w.y, 2 * w.y, w.z);
            }
            exit = 2 * exit + (second ? 1 : 0);
            bisection = 2 * bisection + 1 + (second ? 1 : 0);
        }
        node = mesh.facet_tree[node.first + exit];
    }
    return node.first;
}

/// Smallest barycentric weight of a point in a triangle: >= 0 inside.
double least_weight(const std::array<glm::dvec3, 3>& p, const glm::dvec3& x) {
    const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double w1 = glm::dot(glm::cross(x - p[0], p[2] - p[0]), n) / glm::dot(n, n);
    const double w2 = glm::dot(glm::cross(p[1] - p[0], x - p[0]), n) / glm::dot(n, n);
    return std::min({1.0 - w1 - w2, w1, w2});
}

std::array<glm::dvec3, 3> points(const PatchMesh& mesh, const glm::uvec3& t) {
    return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
            glm::dvec3(mesh.positions[t.z])};
}

/// A fan of long and short triangles, so that bisections differ in depth and shape.
Scene crooked_scene() {
    Scene scene;
    scene.materials.emplace_back();
    scene.objects.emplace_back();
    const std::array<glm::vec3, 5> corners = {glm::vec3(0, 0, 0), glm::vec3(5, 0, 0),
                                              glm::vec3(4, 2.5F, 1), glm::vec3(0.3F, 3, -1),
                                              glm::vec3(-2, 0.2F, 0)};
    for (const glm::vec3& corner : corners) {
        scene.vertices.push_back({corner, glm::vec3(0, 0, 1), glm::vec2(0)});
    }
    for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) {
        scene.triangles.push_back({{0, k, k + 1}, 0, 0});
    }
    return scene;
}

TEST(FacetTree, FindsTheTriangleUnderAPoint) {
    Scene scene = crooked_scene();
    TessellationSettings settings;
    settings.patch_size = 0.2F;
    const PatchMesh mesh = tessellate(scene, settings);
    ASSERT_EQ(mesh.facets.size(), 3U);
    ASSERT_GT(mesh.triangle_count(), 300U);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform;
    std::vector<bool> found(mesh.triangle_count(), false);
    for (std::size_t i = 0; i < 30000; ++i) {
        const std::size_t facet = i % 3;
        const double root = std::sqrt(uniform(random));
        const double v = uniform(random);
        const glm::dvec3 weights(1.0 - root, root * (1.0 - v), root * v);
        const auto p = points(mesh, mesh.facets[facet]);
        const glm::dvec3 x = weights.x * p[0] + weights.y * p[1] + weights.z * p[2];
        const std::uint32_t triangle = triangle_at(mesh, facet, weights);
        ASSERT_LT(triangle, mesh.triangle_count());
        found[triangle] = true;
        EXPECT_GT(least_weight(points(mesh, mesh.triangles[triangle]), x), -1e-4) << i;
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), false), 0);
}

TEST(FacetTree, TrianglesThatAreNotSplitAreTheirOwnFacets) {
    Scene scene = crooked_scene();
    TessellationSettings settings;
    settings.patch_size = 100.0F;
    const PatchMesh mesh = tessellate(scene, settings);
    ASSERT_EQ(mesh.facets.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh.facet_roots[i].code, FacetNode::leaf_bit);
        EXPECT_EQ(mesh.facet_roots[i].first, i);
    }
}

}  // namespace
}  // namespace raybundle
