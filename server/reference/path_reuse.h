// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "reference/measures/image_estimate.h"
#include "reference/path_tracer.h"

namespace raybundle {

/// Path tracing of neighbouring pixels that share their paths from the second surface on (Bekaert,
/// Sbert, Halton 2002, "Accelerating Path Tracing by Re-Using Paths"). Each pixel joins the point
/// it sees with the second surface of everyone's path, weighted by the balance heuristic over the
/// pixels that might have gone there. As unbiased as path tracing, but the errors of the pixels
/// that share paths are not independent of each other.
///
/// Second surfaces that reflect differently to different points, transmit light or are reached by
/// way of mirrors or glass serve their own pixel alone. In air that scatters nothing is shared.
class PathReuse {
  public:
    /// Scene and lights must outlive it.
    PathReuse(const RayScene& scene, const LightSampling& lights, PathSettings settings = {})
        : scene_(scene), tracer_(scene, lights, with_two_lights(settings)) {}

    /// Adds one sample to every pixel of a whole picture.
    void add_pass(ImageEstimate& image, const CameraRays& camera) const;

  private:
    /// What a pixel shows.
    struct View {
        std::size_t pixel;
        PathEnd end;
        glm::vec3 departure;  ///< of rays from there
    };

    /// Where a path went on to from what a pixel shows.
    struct Offer {
        std::size_t pixel;    ///< whose path it is
        SurfacePoint point;   ///< a Lambert surface
        glm::dvec3 radiance;  ///< that it reflects to everywhere, cd/m²
    };

    /// Estimates of the radiance that arrives at a point in space against each ray, cd/m²; at most
    /// as many as a tile has.
    void radiance(const glm::dvec3& origin, std::span<PixelRay> rays,
                  std::span<glm::dvec3> radiance) const;
    void share(const Offer& offer, std::span<const View> views,
               std::span<glm::dvec3> radiance) const;

    /// Most light arrives with shared paths, and that of the lamps does not.
    static PathSettings with_two_lights(PathSettings settings) {
        settings.first_light_samples = 2;
        return settings;
    }

    const RayScene& scene_;
    PathTracer tracer_;
};

}  // namespace raybundle
