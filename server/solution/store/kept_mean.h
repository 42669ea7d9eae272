// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/store/zone_balance.h"

namespace raybundle {

/// The mean irradiance of before the last change, apart from what has come in since; see
/// solution_serve.comp. Has buffers from the first change on.
class KeptMean {
  public:
    /// Keeps the mean irradiance as it is; iterations write to since() from now on.
    void keep(const Buffer& irradiance);
    /// There has been no change: nothing is kept apart.
    void forget() { keeping_ = false; }
    [[nodiscard]] bool keeping() const { return keeping_; }
    /// Writes what is served of both to the mean irradiance that is bound, by the levels of zones
    /// that are bound. Only while keeping().
    void serve(std::uint32_t patch_count) const;

    [[nodiscard]] const Buffer& since() const { return since_; }
    [[nodiscard]] ZoneBalance::Means means() const {
        return keeping_ ? ZoneBalance::Means{&kept_, &since_} : ZoneBalance::Means{};
    }
    [[nodiscard]] std::size_t bytes() const { return kept_.bytes() + since_.bytes(); }

  private:
    Buffer kept_, since_;
    bool keeping_ = false;
    ShaderProgram serve_;
};

}  // namespace raybundle
