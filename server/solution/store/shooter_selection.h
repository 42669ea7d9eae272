// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// Which patches shoot: selection probabilities from what patches send, and the shooting points
/// that follow from them (ch. 6.3). Rewritten between groups of iterations.
class ShooterSelection {
  public:
    explicit ShooterSelection(const GpuScene& scene);

    void bind() const;
    /// Whether only perspective bundles are drawn, which never find what lines meet nothing.
    void set_shoots_only(bool shoots_only) { shoots_only_ = shoots_only; }
    /// The constant that bundles do not carry, from what is bound (ch. 5.5).
    void balance_constant() const;
    /// New probabilities from the radiance that is bound.
    void refresh() const;
    /// Shooting points for the coming perspective bundles; one small readback. numbers: see
    /// solution_shooters.comp; at most 16.
    std::vector<layout::Shooter> choose(std::span<const glm::vec4> numbers, float diameter);
    [[nodiscard]] const Buffer& balance() const { return balance_; }
    [[nodiscard]] std::size_t bytes() const { return power_.bytes() + cdf_.bytes(); }

  private:
    std::uint32_t patch_count_, block_count_;
    Buffer power_, flux_, balance_, cdf_, shooters_;
    bool shoots_only_ = false;
    Readback readback_;
    ShaderProgram power_sum_, power_scan_, power_density_, choose_, flux_sum_, balance_flux_;
};

}  // namespace raybundle
