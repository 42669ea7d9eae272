// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;
struct RTCRayHit;

namespace raybundle {

/// Uniform numbers in [0, 1) of one path.
class AirRandom {
  public:
    AirRandom(std::uint64_t seed, std::uint64_t index);
    double next();

  private:
    std::uint64_t state_;
};

/// Triangles of the refined mesh at the present places, for rays through the air (Embree). The
/// rules of bundles hold: light passes cut-outs (alpha MASK) and glass, straight and less what that
/// absorbs, by chance. Usable by any number of threads.
class AirScene {
  public:
    /// world_from_object: of all objects, in the space that rays live in; diameter: of the scene,
    /// m. Throws std::runtime_error where memory runs out.
    AirScene(const Scene& scene, const PatchMesh& mesh,
             std::span<const glm::mat4> world_from_object, float diameter);
    ~AirScene();
    AirScene(const AirScene&) = delete;
    AirScene& operator=(const AirScene&) = delete;

    void place(std::span<const glm::mat4> world_from_object, float diameter);
    /// Takes over a material that has changed.
    void update(const Scene& scene, std::size_t material);

    struct Hit {
        float distance = 0.0F;                      ///< m
        std::uint32_t patch = PatchMesh::no_patch;  ///< no_patch: a back that sends nothing
    };
    [[nodiscard]] std::optional<Hit> meet(const glm::vec3& origin, const glm::vec3& direction,
                                          AirRandom& random) const;
    /// Whether light passes from a point to another, or along a direction out of the scene.
    [[nodiscard]] bool open(const glm::vec3& from, const glm::vec3& to, AirRandom& random) const;
    [[nodiscard]] bool open_towards(const glm::vec3& from, const glm::vec3& direction,
                                    AirRandom& random) const;

    /// A side as it lies: a corner, two edges, its normal, m.
    struct Side {
        glm::vec3 a{0.0F}, e1{0.0F}, e2{0.0F};
        glm::vec3 normal{0.0F};
        float area = 0.0F;  ///< m²
    };
    [[nodiscard]] Side side(std::uint32_t side) const;
    [[nodiscard]] std::uint32_t side_count() const {
        return static_cast<std::uint32_t>(side_triangle_.size());
    }
    [[nodiscard]] std::uint32_t patch_of(std::uint32_t side) const {
        return sets_.empty() ? side : sets_.side_patch[side];
    }
    [[nodiscard]] float lift() const { return lift_; }  ///< m: so far in front of sides rays start
    [[nodiscard]] std::size_t bytes() const;

  private:
    void build();
    [[nodiscard]] bool passes(const RTCRayHit& hit, AirRandom& random) const;
    [[nodiscard]] bool hidden(const glm::vec3& from, const glm::vec3& direction, float end,
                              AirRandom& random) const;

    std::vector<glm::vec3> positions_;  // object space
    std::vector<glm::uvec3> triangles_;
    std::vector<std::uint32_t> vertex_object_, triangle_material_, back_side_, side_triangle_;
    PatchSets sets_;
    std::vector<float> coverage_;
    std::vector<BundleGlass> glass_;  // by material
    std::vector<bool> is_glass_;
    bool any_passes_ = false;
    float lift_ = 0.0F;
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDeviceTy*)> device_;
    std::unique_ptr<RTCSceneTy, void (*)(RTCSceneTy*)> rays_;
    RTCGeometryTy* geometry_ = nullptr;
    glm::vec3* vertices_ = nullptr;  // of the geometry, three a triangle
};

}  // namespace raybundle
