// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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
struct RTCFilterFunctionNArguments;

namespace raybundle {

/// Where a view ray ends that mirrors and glass have deflected.
struct ContinuedRay {
    static constexpr std::uint32_t sky = 0xffffffffU;

    glm::vec3 position{0.0F};     ///< shifted world, m
    std::uint32_t surface = sky;  ///< 2 * facet + side (0 front, 1 back); sky: it leaves the scene
    glm::vec3 throughput{0.0F};   ///< share of the radiance there that arrives at the eye
    glm::vec3 towards{0.0F};      ///< unit, from the end back along the ray
    float way = 0.0F;             ///< from the last deflection to the end, m; 0 to the sky
    bool added = false;           ///< beside what the first surface, below a coat, shows
};

/// Follows view rays from surface to surface where these are mirrors, glass or coats
/// (scene/material/specular_surface.h), through the facets of the mesh at the present places of the
/// objects. One hierarchy per object, so that a move costs no more than a matrix. Exists only in
/// scenes that have such surfaces. Alpha MASK is not looked at: what it cuts out is whole behind a
/// mirror.
class SpecularRays {
  public:
    static constexpr std::size_t most_ends = 4;  ///< of one view ray

    /// world_from_object: of all objects, in the space that rays live in.
    SpecularRays(const Scene& scene, const PatchMesh& mesh,
                 std::span<const glm::mat4> world_from_object);
    ~SpecularRays();
    SpecularRays(const SpecularRays&) = delete;
    SpecularRays& operator=(const SpecularRays&) = delete;

    void place(std::uint32_t object, const glm::mat4& world_from_object);
    /// Takes over a material that has changed.
    void update(const Scene& scene, std::size_t material);

    /// Whether coats deflect a ray: for light, as bundles know them, they do not.
    enum class Coats { passed, followed };

    /// Ends of a ray from a point in space, the strongest first; 0 where the first surface is not
    /// specular. Glass splits a ray into the reflected and the refracted one, both followed, until
    /// there are most_ends: then one of both is chosen at random, by what they carry, so that the
    /// expected value is right. `seed` decides that; equal seeds, equal ends. A coat splits
    /// it, too: what lies below is an end where the ray meets it, unless it is the first surface,
    /// which is seen without this. Rays stop after most_surfaces, or when they carry less than
    /// least_throughput. hidden: objects that no ray meets. Usable by any number of threads.
    std::size_t follow(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t seed,
                       std::span<ContinuedRay, most_ends> ends, Coats coats = Coats::followed,
                       std::span<const std::uint32_t> hidden = {}) const;
    static constexpr int most_surfaces = 12;
    static constexpr float least_throughput = 1.0F / 512.0F;

    /// Boxes that hold all specular facets, one per object with any; without those that only have
    /// a coat where that is passed.
    [[nodiscard]] std::vector<Bounds> boxes(Coats coats = Coats::followed) const;
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

    /// Where a ray meets a facet.
    struct Hit {
        glm::vec3 position{0.0F};
        glm::vec3 normal{0.0F};     ///< interpolated, unit, towards where the ray comes from
        glm::vec3 geometric{0.0F};  ///< the facet's, likewise
        std::uint32_t facet = 0;
        bool front = true;
        float distance = 0.0F;  ///< m
    };
    /// The nearest facet on the way of a ray. hidden: objects that it does not meet.
    [[nodiscard]] std::optional<Hit> meet(const glm::vec3& origin, const glm::vec3& direction,
                                          std::span<const std::uint32_t> hidden = {}) const;
    [[nodiscard]] const SpecularSurface& surface(const Hit& hit) const {
        return surfaces_[materials_[hit.facet]];
    }
    [[nodiscard]] const SpecularSurface& surface_of(std::size_t material) const {
        return surfaces_[material];
    }
    /// Share of a ray's light that the air leaves over a distance, m; to the sky without limit.
    [[nodiscard]] float left_by_air(const glm::vec3& origin, const glm::vec3& direction,
                                    double distance) const {
        return medium_ ? static_cast<float>(
                             medium_->left_after(way_in_box(air_low_, air_high_, glm::dvec3(origin),
                                                            glm::dvec3(direction), distance)
                                                     .length()))
                       : 1.0F;
    }
    /// Whether that side of a facet takes light and sends none.
    [[nodiscard]] bool absorbs(std::uint32_t facet, bool front) const {
        return !front && !two_sided_[materials_[facet]];
    }
    /// m: so far in front of a surface rays start.
    [[nodiscard]] float offset() const { return offset_; }
    /// Places of three vertices of one object, shifted world.
    [[nodiscard]] std::array<glm::vec3, 3> corners(const glm::uvec3& vertices) const;
    /// Barycentric weights of a facet's corners at a point on it.
    [[nodiscard]] glm::vec3 weights(std::uint32_t facet, const glm::vec3& position) const;

  private:
    struct Object {
        std::vector<std::uint32_t> facets;  // in the order of its hierarchy
        glm::mat4 world_from_object{1.0F};
        RTCGeometryTy* instance = nullptr;  // owned by scene_; null where it has no facets
        bool mirrored = false;              // the matrix turns fronts into backs
        std::unique_ptr<RTCSceneTy, void (*)(RTCSceneTy*)> hierarchy{nullptr, nullptr};
    };
    class Walk;
    struct RayQuery;

    void build(Object& object);
    void classify(const Scene& scene, std::size_t material);
    [[nodiscard]] Hit hit_of(std::uint32_t object, std::uint32_t primitive, float u, float v,
                             float distance, const glm::vec3& direction) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);

    std::vector<glm::vec3> positions_, normals_;  // of the vertices, object space
    std::vector<std::uint32_t> vertex_object_;
    std::vector<glm::uvec3> facets_;
    std::vector<std::uint32_t> materials_;   // of the facets
    std::vector<SpecularSurface> surfaces_;  // of the materials
    std::vector<bool> two_sided_;            // glass is
    float offset_ = 0.0F;                    // m: so far in front of a surface rays start
    std::optional<Medium> medium_;
    glm::dvec3 air_low_{0.0}, air_high_{0.0};  // its box, shifted world
    std::size_t bytes_ = 0;
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDeviceTy*)> device_;
    std::vector<Object> objects_;
    std::unique_ptr<RTCSceneTy, void (*)(RTCSceneTy*)> scene_;
};

}  // namespace raybundle
