// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Builds small scenes whose illumination is known in closed form, patch by patch, without going
/// through a file or the tessellator.
class SceneBuilder {
  public:
    SceneBuilder();

    /// Starts a new object (object 0 exists from the beginning). Returns its index.
    std::uint32_t add_object(const std::string& name, const Transform& transform = {});
    /// Lambert material; returns its index.
    std::uint32_t add_material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0));
    std::uint32_t add_material(const Material& material);
    /// Parallelogram with its front towards cross(u, v), split into n x m x 2 triangles.
    void add_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, std::uint32_t n,
                  std::uint32_t m, std::uint32_t material);
    void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                      std::uint32_t material);
    /// Box [min, max] with fronts inwards (a room) or outwards, n x n cells a face.
    void add_box(const glm::vec3& min, const glm::vec3& max, bool inwards, std::uint32_t n,
                 std::uint32_t material);
    /// Everything added from now on is turned by this matrix (about the world's origin).
    void set_transform(const glm::mat4& matrix) { transform_ = matrix; }
    /// Gives a triangle another material.
    void set_triangle_material(std::size_t triangle, std::uint32_t material);
    /// Centre of a triangle before set_transform()'s matrix.
    [[nodiscard]] glm::vec3 cell_centre(std::size_t triangle) const;
    /// The scene with its triangles and lamps as loading a file leaves it, for tessellate(). For
    /// objects of one builder, whose vertices are where add_...() has put them.
    [[nodiscard]] Scene loaded_scene() const;
    /// Makes patches of so many triangles that follow each other, where their material is the same.
    void join(std::uint32_t size);
    /// Deterministic shuffle of the triangles' order.
    void shuffle(std::uint64_t seed);

    Scene scene;
    PatchMesh mesh;

  private:
    glm::mat4 transform_{1.0F};
    std::uint32_t object_ = 0;
};

}  // namespace raybundle
