// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// How far the solution is from the end of its last correction; see solution_statistics.comp.
struct SolutionStatistics {
    double settled = 0.0;  ///< 1 - remaining correction / size of the correction, 0..1
    /// Of the iterate from the mean irradiance, root mean square over patches, relative.
    double distance = 1.0;
};

/// What is measured of the solution, and never changes it: its distance from the checkpoint of the
/// last change, the variance of the strategies, the counters of bundles.
class SolutionMeasures {
  public:
    explicit SolutionMeasures(std::uint32_t patch_count);

    void bind() const;
    /// Remembers the state that is bound. unsettled: the last change is still being worked in, and
    /// both are one for statistics().
    void checkpoint(bool unsettled) const;
    void forget_checkpoint() const { checkpoint_buffer_.clear(); }
    [[nodiscard]] const Buffer& checkpoint_buffer() const { return checkpoint_buffer_; }
    [[nodiscard]] SolutionStatistics statistics() const;
    /// See RadianceStore::take_scatter().
    [[nodiscard]] glm::dvec2 take_scatter() const;
    void forget_scatter() const { scatter_.clear(); }
    /// Patches from one whose variance is measured to the next.
    [[nodiscard]] unsigned scout_stride() const { return scout_stride_; }
    /// Sums of a reduction over all patches by statistics_groups groups of 256; see its shader.
    [[nodiscard]] glm::dvec4 reduce(const ShaderProgram& program) const;

    /// Reads the counters back and clears them (synchronous, four numbers).
    layout::Counters take_counters() const;
    void clear_counters() const { counters_.clear(); }
    [[nodiscard]] const Buffer& counters() const { return counters_; }
    [[nodiscard]] std::size_t bytes() const { return checkpoint_buffer_.bytes(); }

  private:
    std::uint32_t patch_count_;
    unsigned scout_stride_;
    Buffer counters_, checkpoint_buffer_, sums_, scatter_;
    mutable Readback sums_readback_, counters_readback_;
    ShaderProgram checkpoint_, statistics_, measure_scatter_;
};

}  // namespace raybundle
