// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/store/zone_balance.h"

namespace raybundle {

/// The mean irradiance of before the last change, apart from what has come in since, and from what
/// other workers' samples have brought since; see solution_serve.comp. Has buffers from the first
/// change or merge on.
class KeptMean {
  public:
    /// Keeps the mean irradiance as it is; iterations write to since() from now on. What has been
    /// merged is part of it.
    void keep(const Buffer& irradiance);
    /// There has been no change: nothing is kept apart.
    void forget() {
        mixed_ = mixed_ || merging_;
        keeping_ = false;
        merging_ = false;
    }
    [[nodiscard]] bool keeping() const { return keeping_; }
    /// The mean irradiance is another store's: it may hold what has been merged there.
    void adopt() { mixed_ = true; }
    /// What own samples have brought since the last change, radiance units, w = weight; null where
    /// that is not known. irradiance: the mean that is served.
    [[nodiscard]] const Buffer* own(const Buffer& irradiance) const {
        return keeping_ ? &since_ : mixed_ ? nullptr : &irradiance;
    }
    /// From now on these means of other workers, in the same form, are served with own samples.
    /// irradiance: as for own(); it is left for serve() to write. sequences: of so many independent
    /// ones, all of the same length, the mean of all would be as exact.
    void merge(const Buffer& irradiance, std::span<const glm::vec4> others, float sequences);
    [[nodiscard]] float sequences() const { return merging_ ? sequences_ : 1.0F; }
    /// Writes what is served of both to the mean irradiance that is bound, by the levels of zones
    /// that are bound. Only while keeping().
    void serve(std::uint32_t patch_count) const;

    [[nodiscard]] const Buffer& since() const { return since_; }
    [[nodiscard]] ZoneBalance::Means means() const {
        return keeping_ && !nothing_kept_ ? ZoneBalance::Means{&kept_, &since_}
                                          : ZoneBalance::Means{};
    }
    [[nodiscard]] std::size_t bytes() const {
        return kept_.bytes() + since_.bytes() + others_.bytes();
    }

  private:
    void make_buffers(const Buffer& irradiance);

    Buffer kept_, since_, others_;
    bool keeping_ = false;
    bool nothing_kept_ = false;  // there has been no change: kept_ is empty
    bool merging_ = false;
    float sequences_ = 1.0F;
    bool mixed_ = false;  // while nothing is kept apart: others' samples may be in the mean
    ShaderProgram serve_, serve_merged_;
};

}  // namespace raybundle
