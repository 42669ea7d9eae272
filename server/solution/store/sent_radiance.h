// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// Which radiance bundles carry: the solution's, that of glossy patches along one bundle, that with
/// the densities of objects of another size, or another one altogether.
class SentRadiance {
  public:
    /// radiance: of the solution, per patch.
    SentRadiance(const GpuScene& scene, const Buffer& radiance);

    /// radiance: of the solution, as for the constructor.
    void bind(const Buffer& radiance) const;
    /// See RadianceStore::send_along_bundle().
    void send_along_bundle(const GpuScene& scene, Place place) const;
    /// Objects have moved: makes ready for those that have another size now.
    void follow_sizes(const GpuScene& scene);
    /// Another radiance instead of the solution's, until stop_sending_other(). Both must outlive
    /// that.
    void send_other(const Buffer& radiance, const Texture2D& texture);
    void stop_sending_other();
    [[nodiscard]] bool sends_other() const { return other_ != nullptr; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// Radiance with the densities of one place; exists from the first change of a size on.
    struct Placed {
        Buffer radiance;
        Texture2D texture;
        ShaderProgram program;
    };

    std::uint32_t patch_count_;
    Texture2D texture_;         // of the solution's radiance
    Buffer along_bundle_;       // only where the scene is glossy
    Texture2D bundle_texture_;  // on it
    ShaderProgram send_;
    std::optional<Placed> placed_;
    const Buffer* other_ = nullptr;
    const Texture2D* other_texture_ = nullptr;
};

}  // namespace raybundle
