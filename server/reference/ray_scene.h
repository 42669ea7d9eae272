// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/material/brdf.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/photometry/luminaire_body.h"
#include "scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace raybundle {

/// A point on one side of a triangle. Positions and lengths are in the ray scene's own space.
struct SurfacePoint {
    std::uint32_t triangle = 0;
    std::uint32_t patch = PatchMesh::no_patch;  ///< no_patch: back of a one-sided surface, absorbs
    glm::dvec2 barycentric{0.0};                ///< weights of the triangle's vertices 1 and 2
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};  ///< geometric, unit, out of the side that is seen

    [[nodiscard]] bool absorbs() const { return patch == PatchMesh::no_patch; }
};

/// The tessellated scene for ray casting, objects at their initial places. Read-only and usable by
/// any number of threads; scene and mesh must outlive it.
///
/// Rays live in a space of their own: the world moved so that the scene's centre is the origin and
/// scaled by a power of two so that its diameter is in [1, 2). Scenes far from the origin, of a
/// millimetre or of a kilometre are all alike there, and radiance does not depend on the scale.
///
/// Rays start a millionth of the diameter in front of their surface, so that neither the surface
/// itself nor one without distance behind it can be met. Where a front and an absorbing back lie
/// within that distance the front is seen, as in the rasterised bundles.
class RayScene {
  public:
    RayScene(const Scene& scene, const PatchMesh& mesh);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// First surface from a point in space along a unit direction; nothing: the sky.
    [[nodiscard]] std::optional<SurfacePoint> trace(const glm::dvec3& origin,
                                                    const glm::dvec3& direction) const;
    /// The first body of a luminaire on a ray, from a point in space or in front of a surface,
    /// before what the ray has met; distance in the own space. For rays from an eye alone: to light
    /// between surfaces there are none.
    [[nodiscard]] std::optional<LuminaireHit> luminaire_before(
        const glm::dvec3& origin, const glm::dvec3& direction,
        const std::optional<SurfacePoint>& hit) const;
    /// First surface from a surface point; direction on the side of its normal.
    [[nodiscard]] std::optional<SurfacePoint> trace_from(const SurfacePoint& from,
                                                         const glm::dvec3& direction) const;
    /// Where rays from a surface point start: in front of it, and as far from the triangle's edges,
    /// so that a wall that begins there is in front of the ray and not behind or on its start.
    [[nodiscard]] glm::vec3 departure(const SurfacePoint& point) const;
    /// Whether nothing lies between two points where rays start.
    [[nodiscard]] bool unobstructed(const glm::vec3& a, const glm::vec3& b) const {
        return !occluded(a, b - a, 1.0F);
    }
    /// The same for one point and many others at once, which is faster where those are near each
    /// other: open[i] tells of others[i].
    void find_unobstructed(const glm::vec3& point, std::span<const glm::vec3> others,
                           std::span<bool> open) const;
    /// Whether nothing lies between two surface points, each in front of the other.
    [[nodiscard]] bool mutually_visible(const SurfacePoint& a, const SurfacePoint& b) const;
    /// Whether nothing lies between a surface point and a point in space in front of it.
    [[nodiscard]] bool sees_point(const SurfacePoint& from, const glm::dvec3& point) const;
    /// Whether a ray from a surface point meets nothing.
    [[nodiscard]] bool sees_sky(const SurfacePoint& from, const glm::dvec3& direction) const;

    /// Whether a ray from a point in space meets nothing.
    [[nodiscard]] bool open_towards(const glm::vec3& from, const glm::dvec3& direction) const;
    /// Whether any material is a thin pane of glass.
    [[nodiscard]] bool has_panes() const { return has_panes_; }

    /// Point of a patch at barycentric coordinates (weights of vertices 1 and 2).
    [[nodiscard]] SurfacePoint point_on_patch(std::uint32_t patch,
                                              const glm::dvec2& barycentric) const;
    /// Point in space, from world space in metres.
    [[nodiscard]] glm::dvec3 from_world(const glm::dvec3& world) const {
        return (world - centre_) * scale_;
    }

    /// Emitted radiance, cd/m².
    [[nodiscard]] glm::dvec3 emission(const SurfacePoint& point) const;
    /// What a camera sees the point send of its own, cd/m²: an unlit surface besides.
    [[nodiscard]] glm::dvec3 shown_emission(const SurfacePoint& point) const;
    /// Linear base colour, factor times texture and vertex colours.
    [[nodiscard]] glm::vec3 base_colour(const SurfacePoint& point) const;
    /// Metalness and roughness, factors times texture.
    [[nodiscard]] glm::vec2 metallic_roughness(const SurfacePoint& point) const;
    /// Reflectance with what the textures say at this point.
    [[nodiscard]] Brdf brdf(const SurfacePoint& point) const;
    [[nodiscard]] const Material& material(const SurfacePoint& point) const;
    /// The same point of the surface's other side; for materials with two.
    [[nodiscard]] SurfacePoint other_side(const SurfacePoint& point) const;
    /// Whether any material transmits light diffusely: only path tracing follows it.
    [[nodiscard]] bool transmitting() const;
    /// Interpolated vertex normal, unit, on the side of the geometric one; the geometric normal
    /// itself where the triangle is flat.
    [[nodiscard]] glm::dvec3 shading_normal(const SurfacePoint& point) const;
    /// The same after the material's normal map, for a viewer in this direction, unit; see
    /// scene/material/normal_map.h. As patches know neither, only what a picture shows has it.
    [[nodiscard]] glm::dvec3 shading_normal(const SurfacePoint& point,
                                            const glm::dvec3& to_eye) const;
    /// Whether alpha MASK leaves the surface standing at this point.
    [[nodiscard]] bool covered(std::uint32_t triangle, const glm::dvec2& barycentric) const;

    [[nodiscard]] double patch_area(std::uint32_t patch) const;  ///< own space
    /// Area in m² of one unit of area of the own space.
    [[nodiscard]] double square_metres() const { return 1.0 / (scale_ * scale_); }
    [[nodiscard]] double diameter() const;  ///< of the scene, own space: in [1, 2)
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const PatchMesh& mesh() const { return mesh_; }

  private:
    struct DeviceDeleter {
        void operator()(RTCDeviceTy* device) const;
    };
    struct SceneDeleter {
        void operator()(RTCSceneTy* scene) const;
    };

    void place_vertices();
    void find_smooth_triangles();
    void build();
    [[nodiscard]] std::optional<SurfacePoint> trace_ray(const glm::vec3& origin,
                                                        const glm::vec3& direction) const;
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction,
                                float length) const;
    [[nodiscard]] SurfacePoint point_on_triangle(std::uint32_t triangle, bool front,
                                                 const glm::dvec2& barycentric) const;
    [[nodiscard]] std::optional<SurfacePoint> front_at(const SurfacePoint& back,
                                                       const glm::vec3& origin,
                                                       const glm::vec3& direction,
                                                       float distance) const;
    [[nodiscard]] glm::dvec2 mesh_uv(const SurfacePoint& point) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    glm::dvec3 centre_;                           // world, m
    double scale_;                                // own units per metre, a power of two
    std::vector<glm::vec3> positions_, normals_;  // of the vertices, own space; normals not unit
    std::vector<bool> smooth_;                    // triangles whose vertex normals bend
    bool has_panes_ = false;
    std::vector<LuminaireBody> luminaires_;  // world space
    std::vector<ReflectanceModel> models_;   // of the materials, as the next
    std::vector<std::optional<TexturedReflectance>> textured_models_;
    std::unique_ptr<RTCDeviceTy, DeviceDeleter> device_;
    std::unique_ptr<RTCSceneTy, SceneDeleter> embree_;
};

}  // namespace raybundle
