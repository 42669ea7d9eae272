// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "trace/gloss_ray.h"
#include "transport/bundle_receiver.h"
#include "view/specular/specular_groups.h"

namespace raybundle {

/// Programs of GlossRays; only where a scene has lobes that rays are drawn from.
struct GlossRayPrograms {
    ShaderProgram make, land;
};

/// Rays that the glossy pixels of a picture draw from their narrow lobes, one strategy more beside
/// the bundles (ch. 6.2): what a bundle finds within such a lobe is rare and far too bright. A ray
/// brings what the patch that it meets sends, so that the light of all bundles so far is in it.
class GlossRays {
  public:
    /// At most so many pixels.
    explicit GlossRays(std::size_t pixels);

    /// The pixels are new: what patches send into their lobes is looked at (ch. 7.3), by a ray for
    /// each, so that there are highlights before there is a sample. The picture and the solution
    /// are bound. Nothing before the first sample ever.
    void begin(const GpuScene& scene, const GlossRayPrograms& programs,
               const SpecularGroups& groups);
    /// Traces the rays of the running sample and adds what they bring; before the bundle's own
    /// contribution. The picture, the bundle and the solution are bound. layered: the bundle is.
    void trace(const GpuScene& scene, const GlossRayPrograms& programs,
               const SpecularGroups& groups, const BundleReceiver::Context& context, bool layered);
    /// Rays of a pixel for each sample.
    static constexpr float share() { return 1.0F / static_cast<float>(GLOSS_RAY_STRIDE); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    struct Pass {
        std::uint32_t phase = 0, number = 0;
        bool first_look = false, layered = false;
    };
    void run(const GpuScene& scene, const GlossRayPrograms& programs, const SpecularGroups& groups,
             const Pass& pass);
    void follow(const GpuScene& scene, std::size_t count);

    std::uint32_t samples_ = 0;  // since the pixels were made
    std::uint32_t seed_ = 0;
    float weight_ = 0.0F;  // of the last sample
    Buffer buffer_;
    std::vector<GlossRay> rays_;
};

}  // namespace raybundle
