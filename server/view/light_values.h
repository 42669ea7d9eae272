// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "solution/store/radiance_store.h"

namespace raybundle {

/// The light of all vertices on its way to browsers that draw by themselves: found, packed and read
/// back on the GPU, 4 bytes for each value.
class LightValues {
  public:
    /// sources: of each value twice the vertex, and 1 more for its back. unit: of values, cd/m².
    LightValues(const GpuScene& scene, const RadianceStore& store,
                std::span<const std::uint32_t> sources, float unit);

    /// Queues the present light. Between groups of iterations; not within a special phase.
    void request();
    [[nodiscard]] bool pending() const { return readback_.pending(); }
    [[nodiscard]] bool ready() const { return readback_.ready(); }
    /// Irradiance / pi as rgb9e5() in that unit. Valid until the next request.
    [[nodiscard]] std::span<const std::uint32_t> take() {
        return readback_.take_as<std::uint32_t>();
    }
    [[nodiscard]] std::size_t bytes() const;

  private:
    const GpuScene& scene_;
    const RadianceStore& store_;
    float unit_;
    std::uint32_t count_;
    ShaderProgram interpolate_, pack_;
    Buffer vertex_irradiance_, sources_, values_;
    Readback readback_;
};

}  // namespace raybundle
