// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

struct PatchMesh;

/// A triangle that may share its light with others.
struct JoinFace {
    std::array<glm::dvec3, 3> corners{};    ///< world, m, counter-clockwise from the front
    std::array<std::uint32_t, 3> points{};  ///< numbers of the corners: equal where faces touch
    glm::vec3 colour{0.0F};                 ///< base colour
    bool two_sided = false;
};

/// Only faces of one kind join: object, material, sides, emission.
struct JoinKind {
    std::uint32_t rough = 0;  ///< the kind without emission, where there are too many sets
    double widest = 0.0;      ///< largest angle between a face's normal and its set's, radians
    bool two_sided = false;
};

/// Triangles of a mesh that may share their light with others: what is in the mesh is not kept
/// twice. The mesh must outlive them.
class JoinFaces {
  public:
    JoinFaces(const Scene& scene, const PatchMesh& mesh);

    /// vertex_points: numbers of the mesh's vertices, equal where faces touch.
    void set_points(std::vector<std::uint32_t> vertex_points) {
        vertex_points_ = std::move(vertex_points);
    }
    void add_kind(const JoinKind& kind) { kinds_.push_back(kind); }
    void add(std::uint32_t triangle, std::uint32_t kind) {
        triangles_.push_back(triangle);
        kind_of_.push_back(kind);
    }

    [[nodiscard]] std::size_t size() const { return triangles_.size(); }
    [[nodiscard]] bool empty() const { return triangles_.empty(); }
    [[nodiscard]] JoinFace at(std::uint32_t face) const;
    [[nodiscard]] std::array<std::uint32_t, 3> points_of(std::uint32_t face) const;
    [[nodiscard]] std::uint32_t kind_of(std::uint32_t face) const { return kind_of_[face]; }
    [[nodiscard]] const JoinKind& kind(std::uint32_t number) const { return kinds_[number]; }
    [[nodiscard]] std::size_t sides_of(std::uint32_t face) const {
        return kinds_[kind_of_[face]].two_sided ? 2 : 1;
    }
    /// Numbers of the triangles in the mesh.
    [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }

  private:
    const PatchMesh& mesh_;
    std::vector<glm::dmat4> world_from_object_;
    std::vector<std::uint32_t> vertex_points_;
    std::vector<std::uint32_t> triangles_;  // by face
    std::vector<std::uint32_t> kind_of_;    // by face
    std::vector<JoinKind> kinds_;
};

}  // namespace raybundle
