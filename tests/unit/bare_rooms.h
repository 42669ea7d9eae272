// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "zones/exchange_rays.h"

namespace raybundle {

/// Boxes with fronts inwards, cut into patches; no files, no tessellator.
struct Rooms {
    Scene scene;
    PatchMesh mesh;

    Rooms() {
        scene.objects.emplace_back();
        scene.materials.emplace_back();
    }
    void quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, unsigned n) {
        const auto count = static_cast<float>(n);
        for (unsigned i = 0; i < n * n; ++i) {
            const glm::vec3 at = corner + u * (static_cast<float>(i % n) / count) +
                                 v * (static_cast<float>(i / n) / count);
            triangle(at, at + u / count, at + (u + v) / count);
            triangle(at, at + (u + v) / count, at + v / count);
        }
    }
    /// Wall from a corner along two edges, with holes in a row along the first: each from..to, in
    /// shares of the edge, and `low`..`high` of the other one.
    struct Hole {
        float from, to, low, high;
    };
    void wall(const glm::vec3& corner, const glm::vec3& along, const glm::vec3& up,
              const std::vector<Hole>& holes, unsigned n = 6) {
        float done = 0.0F;
        for (const Hole& hole : holes) {
            const glm::vec3 at = corner + hole.from * along;
            const glm::vec3 across = (hole.to - hole.from) * along;
            quad(corner + done * along, (hole.from - done) * along, up, n);
            quad(at, across, hole.low * up, n);
            quad(at + hole.high * up, across, (1.0F - hole.high) * up, n);
            done = hole.to;
        }
        quad(corner + done * along, (1.0F - done) * along, up, n);
    }
    void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : {a, b, c}) {
            mesh.positions.push_back(corner);
            mesh.vertex_object.push_back(0);
        }
        mesh.side_triangle.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
        mesh.triangles.push_back(first + glm::uvec3(0, 1, 2));
        mesh.triangle_material.push_back(0);
        mesh.back_side.push_back(PatchMesh::no_patch);
        mesh.base_colour.emplace_back(0.7F);
        mesh.emission.emplace_back(0.0F);
    }
    /// Room [low, high]; its wall towards +x has a hole where `open`.
    void room(const glm::vec3& low, const glm::vec3& high, bool open = false, unsigned n = 6) {
        const glm::vec3 e = high - low;
        const glm::vec3 x(e.x, 0, 0);
        const glm::vec3 y(0, e.y, 0);
        const glm::vec3 z(0, 0, e.z);
        quad(low, z, x, n);      // floor
        quad(low + y, x, z, n);  // ceiling
        quad(low, x, y, n);      // z low
        quad(low + z, y, x, n);  // z high
        quad(low, y, z, n);      // x low
        if (!open) {
            quad(low + x, z, y, n);  // x high
        }
    }
    [[nodiscard]] ExchangeRays rays() const {
        const glm::mat4 world(1.0F);
        return {scene, mesh, std::span(&world, 1), 20.0F, 1};
    }
};

}  // namespace raybundle
