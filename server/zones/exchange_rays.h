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
struct RTCFilterFunctionNArguments;

namespace raybundle {

/// One random line of the light that a patch sends evenly over directions.
struct ExchangeRay {
    static constexpr std::uint32_t lost = 0xffffffffU;

    std::uint32_t from = 0;   ///< patch
    std::uint32_t to = lost;  ///< patch that receives it; lost: it leaves the scene or meets a back
                              ///< that has no patch
    float area = 0.0F;        ///< m² that the ray stands for: the sum of area times exitance over
                              ///< all rays is an unbiased estimate of the whole flux
    glm::vec3 sky{0.0F};      ///< cd/m²: radiance of the sky that it meets
    glm::vec3 towards{0.0F};  ///< where the sky meets it; 0 where it meets none
    float left_by_air = 1.0F;  ///< share of the sky's light that the air lets through
    glm::vec3 origin{0.0F};    ///< m
};

/// Single rays between patches (Embree) that measure how surfaces exchange light, independently of
/// the bundles. They are a few ten thousand, always the same ones, so that a difference between two
/// traces is due to the scene and not to chance. The rules of bundles hold: light passes cut-outs
/// (alpha MASK) and glass, less its absorption; backs without a patch absorb. All surfaces are
/// Lambertian. What the air takes out of light is lost.
class ExchangeRays {
  public:
    /// world_from_object: of all objects, in the space that rays live in; sky directions are the
    /// same there as in the world. diameter: of the scene, m. Throws std::runtime_error where
    /// memory runs out.
    ExchangeRays(const Scene& scene, const PatchMesh& mesh,
                 std::span<const glm::mat4> world_from_object, float diameter, std::uint64_t seed);
    ~ExchangeRays();
    ExchangeRays(ExchangeRays&&) noexcept = default;
    ExchangeRays& operator=(ExchangeRays&&) = delete;

    /// Moves objects and prepares trace().
    void place(std::span<const glm::mat4> world_from_object, float diameter);
    /// A patch's share of all rays follows its area, its object, its emission and its number.
    /// False: they are what they were, and so are all rays but for the sky that they meet.
    bool choose_densities(const PatchMesh& mesh);
    /// Gives a ray the radiance of the sky that it meets now.
    void look_up_sky(ExchangeRay& ray) const;
    /// All rays, in the order of their patches. On all cores; the same bits always.
    [[nodiscard]] std::vector<ExchangeRay> trace() const;

    /// So many rays from some patches, evenly over their area, besides those of trace().
    [[nodiscard]] std::vector<ExchangeRay> trace_from(std::span<const std::uint32_t> patches,
                                                      std::size_t count) const;
    /// Where a ray that meets the sky passes between surfaces for the last time: along it the
    /// distance from the nearest surface falls, and then rises above what it was. That is in a
    /// window's plane, mostly, or in a pane that the ray goes through. Nothing: it is free at once.
    [[nodiscard]] std::optional<glm::vec3> last_narrow_place(const ExchangeRay& ray) const;

    [[nodiscard]] const std::vector<glm::vec3>& centres() const { return centres_; }
    [[nodiscard]] const std::vector<glm::vec3>& normals() const { return normals_; }
    [[nodiscard]] const std::vector<float>& areas() const { return areas_; }
    /// Share of the rays that start on each patch; the sum is 1.
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }
    /// Density of the rays that start on each patch, 1/m².
    [[nodiscard]] std::vector<double> rays_per_area() const;
    [[nodiscard]] const std::vector<std::uint32_t>& objects() const { return objects_; }

  private:
    struct Query;
    struct Corners {
        glm::vec3 a, b, c;
    };

    [[nodiscard]] Corners corners_of(std::size_t triangle) const;
    [[nodiscard]] std::uint32_t patch_of(std::uint32_t side) const {
        return sets_.empty() ? side : sets_.side_patch[side];
    }
    [[nodiscard]] PatchSides sides_of(std::uint32_t patch) const {
        return sets_.empty() ? PatchSides(patch) : PatchSides(sets_, patch);
    }
    void measure(std::uint32_t patch);
    [[nodiscard]] std::uint32_t side_within(std::uint32_t patch, float& share) const;
    [[nodiscard]] ExchangeRay follow(std::uint32_t patch, std::uint64_t number) const;
    [[nodiscard]] std::uint32_t front_beside(const RTCRayHit& back) const;
    [[nodiscard]] double left_by_air(const RTCRayHit& hit, bool met) const;
    static void reject_backs(const RTCFilterFunctionNArguments* arguments);
    void build(std::span<const glm::uvec3> triangles);

    const Scene& scene_;
    std::vector<glm::vec3> positions_;  // object space
    std::vector<std::uint32_t> vertex_object_, triangle_material_, back_side_, side_triangle_;
    PatchSets sets_;  // sides of every patch
    std::vector<float> coverage_;
    std::vector<BundleGlass> glass_;  // by material
    std::vector<bool> is_glass_;
    std::vector<glm::mat4> world_from_object_;
    std::vector<std::uint32_t> objects_;  // by patch
    std::vector<glm::vec3> centres_, normals_;
    std::vector<float> areas_, side_areas_;  // the latter without cut-outs
    std::vector<double> shares_;
    std::vector<std::uint32_t> starts_;  // patch of each ray
    glm::vec4 offsets_;                  // of the sequence of points
    float diameter_ = 0.0F;              // m, of the scene
    float lift_ = 0.0F;                  // m
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDeviceTy*)> device_;
    std::unique_ptr<RTCSceneTy, void (*)(RTCSceneTy*)> rays_;
    RTCGeometryTy* geometry_ = nullptr;
    std::span<glm::vec3> vertices_;          // of the geometry, world space
    std::span<const glm::uvec3> triangles_;  // likewise, their vertices
};

}  // namespace raybundle
