// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <string>

#include "gpu/gl_objects.h"

namespace raybundle {

/// Brings a GPU buffer's contents to the CPU without stalling: request, go on, look later.
class Readback {
  public:
    Readback(const std::string& label, std::size_t bytes);
    Readback(Readback&& other) noexcept;
    Readback& operator=(Readback&&) = delete;
    ~Readback();

    /// Queues a copy of the first `bytes` of the source. A request not yet looked at is replaced.
    void request(const Buffer& source, std::size_t bytes);
    [[nodiscard]] bool pending() const { return fence_ != nullptr; }
    /// Forgets a request not yet looked at.
    void cancel() { drop_fence(); }
    /// True once the requested data can be had without waiting.
    [[nodiscard]] bool ready() const;
    /// The requested bytes; waits where they are not there yet. Valid until the next request.
    std::span<const std::byte> take();

    template <typename T>
    std::span<const T> take_as() {
        const auto raw = take();
        return {reinterpret_cast<const T*>(raw.data()), raw.size() / sizeof(T)};
    }

  private:
    void drop_fence();

    Buffer staging_;
    const std::byte* mapped_ = nullptr;
    std::size_t requested_ = 0;
    GLsync fence_ = nullptr;
};

}  // namespace raybundle
