// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "measure/receiver.h"
#include "reference/path_tracer.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"

namespace raybundle {

/// A scene as calculation points see it; scene and mesh must outlive it.
struct MeasuredScene {
    MeasuredScene(const Scene& scene, const PatchMesh& mesh);

    RayScene rays;
    LightSampling lights;
    PathTracer paths;
    std::vector<PlacedLight> punctual;
};

/// Light that arrives at a point, lx.
struct ArrivedLight {
    double direct = 0.0;
    double reflected = 0.0;  ///< by surfaces
};

/// Light that arrives at points in space, by independent paths. A sample is one path in a direction
/// drawn in proportion to the receiver's weight, and some points of emitters; what both find is
/// weighted by the power heuristic. Punctual lights are taken all, once for each point, those with
/// a disc at another point of it for each sample. Values are luminances, lx.
///
/// Emission that comes straight, through glass or by ideal mirrors is direct light. Light of
/// punctual lights comes through thin panes, not by way of bodies of glass or of mirrors.
class PointPaths {
  public:
    explicit PointPaths(const MeasuredScene& scene) : scene_(scene) {}

    /// What punctual lights without a disc bring without any reflection: exact, of those with an
    /// opening within half a per cent of each, but for what hides less than a sixteenth of it.
    /// position: own space of the ray scene.
    [[nodiscard]] double fixed(const glm::dvec3& position, const Receiver& receiver) const;
    /// Unbiased estimate of the rest. reflected: include light that surfaces have reflected.
    [[nodiscard]] ArrivedLight sample(const glm::dvec3& position, const Receiver& receiver,
                                      bool reflected, Sampler& sampler) const;

  private:
    [[nodiscard]] double by_point(const PlacedLight& light, const glm::dvec3& place,
                                  const glm::dvec3& position, const Receiver& receiver) const;
    [[nodiscard]] double by_opening(const PlacedLight& light, const glm::dvec3& position,
                                    const Receiver& receiver) const;
    [[nodiscard]] double left_between(const glm::dvec3& a, const glm::dvec3& b) const;
    [[nodiscard]] double left_from_sky(const glm::dvec3& at, const glm::dvec3& direction) const;
    [[nodiscard]] double discs(const glm::dvec3& position, const Receiver& receiver,
                               Sampler& sampler) const;
    [[nodiscard]] double emitters(const SurfacePoint& at, const Receiver& receiver,
                                  Sampler& sampler) const;
    [[nodiscard]] ArrivedLight along_path(const SurfacePoint& at, const Receiver& receiver,
                                          bool reflected, Sampler& sampler) const;

    const MeasuredScene& scene_;
};

}  // namespace raybundle
