// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "gpu/gl_objects.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// Where values of patches stand once objects have been added: new fronts stand before the backs.
class PatchGrowth {
  public:
    PatchGrowth(const GpuScene& before, const GpuScene& after)
        : before_(before.patch_count()),
          after_(after.patch_count()),
          fronts_(before.front_patch_count()),
          first_back_(after.front_patch_count()) {}

    /// Values of new patches stay what they are. The buffers may hold several values a patch, one
    /// array behind the other: `arrays`.
    void copy(const Buffer& from, const Buffer& to, std::size_t arrays = 1) const {
        const std::size_t value = from.bytes() / (arrays * before_);
        for (std::size_t i = 0; i < arrays; ++i) {
            copy_bytes(from, to, i * before_ * value, i * after_ * value, fronts_ * value);
            copy_bytes(from, to, (i * before_ + fronts_) * value,
                       (i * after_ + first_back_) * value, (before_ - fronts_) * value);
        }
    }

    /// Of the patches as they are now; new ones have `none`.
    template <typename T>
    [[nodiscard]] std::vector<T> grown(const std::vector<T>& from, const T& none) const {
        std::vector<T> to(after_, none);
        const auto fronts = from.begin() + static_cast<std::ptrdiff_t>(fronts_);
        std::copy(from.begin(), fronts, to.begin());
        std::copy(fronts, from.end(), to.begin() + static_cast<std::ptrdiff_t>(first_back_));
        return to;
    }

  private:
    static void copy_bytes(const Buffer& from, const Buffer& to, std::size_t first, std::size_t at,
                           std::size_t bytes) {
        if (bytes > 0) {
            glCopyNamedBufferSubData(from.get(), to.get(), static_cast<GLintptr>(first),
                                     static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes));
        }
    }

    std::size_t before_, after_, fronts_, first_back_;
};

}  // namespace raybundle
