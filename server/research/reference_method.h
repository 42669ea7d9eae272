// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "reference/measures/image_estimate.h"
#include "reference/path_tracer.h"
#include "reference/ray_scene.h"
#include "scene/scene.h"

namespace raybundle {

/// The comparison methods of `render --method`.
enum class ReferenceKind {
    path,
    path_reuse,
    single_ray,
    ray_cast,
    light,
    bidirectional,
    metropolis,
    photon_map
};

/// A method on the CPU that improves a picture with every iteration. The result depends on the seed
/// and the number of iterations alone.
class ReferenceMethod {
  public:
    ReferenceMethod() = default;
    virtual ~ReferenceMethod() = default;
    ReferenceMethod(const ReferenceMethod&) = delete;
    ReferenceMethod& operator=(const ReferenceMethod&) = delete;

    /// One more sample of every pixel, and as many light paths (light, bidirectional) or new photon
    /// maps; metropolis: about as many steps as pixels; single_ray: a fixed number of particles.
    virtual void iterate() = 0;
    [[nodiscard]] virtual std::uint64_t iterations() const = 0;
    /// Radiance, cd/m², row 0 at the top.
    [[nodiscard]] virtual std::vector<glm::dvec3> picture() const = 0;
    /// Over the pixels that errors are measured of (measured_pixels()); where there are none, those
    /// that show a reflecting surface.
    [[nodiscard]] virtual ImageError error() const = 0;
    /// Samples dropped because they were not finite.
    [[nodiscard]] virtual std::uint64_t non_finite() const = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;  ///< without the scene
};

/// Why a method cannot follow a scene's light at all; empty where it can. Only path tracing knows
/// diffuse transmission, and single rays no glass.
std::string reason_against(ReferenceKind kind, const RayScene& scene);

/// Which light a method does not find in a picture, though it shows the rest of the light path
/// classes that it is for; empty: it finds all of them.
std::string light_missed(ReferenceKind kind, const RayScene& scene, const Camera& camera,
                         glm::uvec2 size);

/// The picture's own part of a method's input, and what it is made from; the ray scene must outlive
/// the method. paths: of path and path_reuse. Throws std::runtime_error where there is a
/// reason_against() it.
std::unique_ptr<ReferenceMethod> make_reference_method(ReferenceKind kind, const RayScene& scene,
                                                       const Camera& camera, glm::uvec2 size,
                                                       std::uint64_t seed,
                                                       const PathSettings& paths = {});

}  // namespace raybundle
