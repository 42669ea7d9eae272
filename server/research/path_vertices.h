// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"
#include "reference/scattering.h"
#include "reference/specular_walk.h"

namespace raybundle {

/// A vertex of a subpath that sets out from the eye or from a light (Veach 1997, ch. 10).
///
/// Densities are per area of the ray scene's own space, but per solid angle for the sky. Punctual
/// lights are chosen with a probability, and no other vertex ever draws them: its density is 0.
/// Behind a mirror or glass a density is the factor of the delta distribution; paths are weighed by
/// ratios of such densities alone, in which the deltas of both ways cancel.
struct PathVertex {
    enum class Kind { eye, emitter, surface, sky, point_light, directional_light };

    Kind kind = Kind::surface;
    SurfacePoint point;                    ///< eye, point light: the position alone; sky: nothing
    int punctual = LightSample::no_light;  ///< index of a punctual light
    glm::dvec3 towards{0.0};         ///< unit, to the previous vertex; sky: the way it was met
    glm::dvec3 throughput{1.0};      ///< of the subpath up to here, scattering here not included
    double forward = 0.0;            ///< density with which its own subpath draws it
    double backward = 0.0;           ///< density with which the next vertex would draw it
    std::optional<Scattering> lobe;  ///< of a surface, for light to or from `towards`
    /// Mirror or glass: no lobe, one direction for each of its ways. Nothing can be joined with it.
    bool deflects = false;

    /// Whether light goes on from it.
    [[nodiscard]] bool goes_on() const { return lobe || deflects; }
};

using Subpath = std::vector<PathVertex>;

/// Density of a vertex for a draw per solid angle at `from`, in the vertex's own measure.
double vertex_density(const PathVertex& vertex, double density, const glm::dvec3& from);

/// A density per solid angle at `from`, as one per area at `to`.
double per_area(double density, const glm::dvec3& from, const SurfacePoint& to);

/// Draws the subpaths of bidirectional path tracing. Surfaces take the shading normal at the vertex
/// that the eye sees, be it behind mirrors and glass, and the geometric one elsewhere, as in path
/// tracing.
class SubpathSampler {
  public:
    SubpathSampler(const RayScene& scene, const LightSampling& lights, const CameraRays& camera)
        : scene_(scene), lights_(lights), camera_(camera) {}

    /// From the eye along a unit direction; ends at the sky, at a surface that absorbs, or by
    /// Russian roulette.
    [[nodiscard]] Subpath from_eye(const glm::dvec3& direction, PixelSampler& sampler) const;
    /// From a light; the first vertex is the emitter's or the sky. Its last vertex reflects.
    [[nodiscard]] Subpath from_light(PixelSampler& sampler) const;

    /// The first vertex of a light subpath, or the end of an eye subpath that is joined with a
    /// light, from what LightSampling has drawn: punctual light, or emitter, or else the sky.
    [[nodiscard]] PathVertex light_vertex(int punctual, const std::optional<SurfacePoint>& emitter,
                                          const std::optional<glm::dvec3>& origin) const;
    /// Density per area at a vertex that a light illuminates, in the direction to it.
    [[nodiscard]] double emission_density(const PathVertex& light, const SurfacePoint& lit,
                                          const glm::dvec3& direction) const;

  private:
    struct Onward;

    void extend(Subpath& path, glm::dvec3 direction, Carried carried, PixelSampler& sampler) const;
    [[nodiscard]] std::optional<Onward> onward(const PathVertex& vertex,
                                               const glm::dvec3& direction, Carried carried,
                                               PixelSampler& sampler) const;
    void find_reflection(PathVertex& vertex, NormalKind normal) const;

    const RayScene& scene_;
    const LightSampling& lights_;
    CameraRays camera_;
};

}  // namespace raybundle
