// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "reference/measures/image_estimate.h"
#include "research/path_vertices.h"

namespace raybundle {

/// Bidirectional path tracing (Lafortune, Willems 1993; Veach 1997, ch. 10): every vertex of a path
/// from the eye is joined with every vertex of a path from a light. All ways to make the same path
/// are weighted by the balance heuristic. Ends at lights are chosen anew for each eye vertex, as
/// next-event estimation does; emitters that the eye sees are left to eye paths alone. Subpaths go
/// on behind mirrors and glass, whose vertices are joined with none.
class Bidirectional {
  public:
    Bidirectional(const RayScene& scene, const LightSampling& lights, const CameraRays& camera)
        : scene_(scene), lights_(lights), camera_(camera), subpaths_(scene, lights, camera) {}

    /// One eye path along a unit direction and one light path. Returns the light that the eye path
    /// finds, cd/m²; what light paths bring to other pixels goes to `splats`.
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction, PixelSampler& sampler,
                                      std::vector<Splat>& splats) const;

  private:
    /// Densities of a path's vertices, numbered from the light, x[0], to the eye, for both ways of
    /// drawing each.
    struct Densities {
        std::vector<double> light, eye;
        std::vector<bool> deflects;  ///< mirrors and glass, with which nothing can be joined
        double connect = 1.0;        ///< of x[0] in next-event estimation, over that of light paths
    };

    [[nodiscard]] glm::dvec3 met_light(const Subpath& eye, std::size_t eye_count) const;
    [[nodiscard]] glm::dvec3 next_event(const Subpath& eye, std::size_t eye_count,
                                        PixelSampler& sampler) const;
    [[nodiscard]] glm::dvec3 joined(const Subpath& light, std::size_t light_count,
                                    const Subpath& eye, std::size_t eye_count) const;
    void join_with_eye(const Subpath& light, std::size_t light_count,
                       std::vector<Splat>& splats) const;

    [[nodiscard]] Densities known(const Subpath& light, std::size_t light_count, const Subpath& eye,
                                  std::size_t eye_count) const;
    [[nodiscard]] double connect_ratio(const PathVertex& light, const PathVertex& lit,
                                       const glm::dvec3& to_light) const;
    static double weight(const Densities& densities, std::size_t light_count);

    const RayScene& scene_;
    const LightSampling& lights_;
    CameraRays camera_;
    SubpathSampler subpaths_;
};

}  // namespace raybundle
