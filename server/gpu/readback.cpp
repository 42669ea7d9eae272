// SPDX-License-Identifier: Apache-2.0
#include "gpu/readback.h"

#include <algorithm>
#include <utility>

#include "gpu/egl_context.h"

namespace raybundle {

namespace {
constexpr GLbitfield map_flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
constexpr GLuint64 patience_ns = 10'000'000'000ULL;  // a GPU silent for 10 s is lost
}  // namespace

Readback::Readback(const std::string& label, std::size_t bytes)
    : staging_(label, bytes, map_flags) {
    mapped_ = static_cast<const std::byte*>(glMapNamedBufferRange(
        staging_.get(), 0, static_cast<GLsizeiptr>(staging_.bytes()), map_flags));
    if (mapped_ == nullptr) {
        throw GpuError("the driver cannot map the readback buffer '" + label + "'");
    }
}

Readback::Readback(Readback&& other) noexcept
    : staging_(std::move(other.staging_)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      requested_(other.requested_),
      fence_(std::exchange(other.fence_, nullptr)) {}

Readback::~Readback() {
    drop_fence();
}

void Readback::drop_fence() {
    if (fence_ != nullptr) {
        glDeleteSync(fence_);
        fence_ = nullptr;
    }
}

void Readback::request(const Buffer& source, std::size_t bytes) {
    requested_ = std::min({bytes, source.bytes(), staging_.bytes()});
    glCopyNamedBufferSubData(source.get(), staging_.get(), 0, 0,
                             static_cast<GLsizeiptr>(requested_));
    drop_fence();
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
}

bool Readback::ready() const {
    if (fence_ == nullptr) {
        return false;
    }
    const GLenum status = glClientWaitSync(fence_, 0, 0);
    return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED;
}

std::span<const std::byte> Readback::take() {
    if (fence_ != nullptr) {
        const GLenum status = glClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, patience_ns);
        drop_fence();
        if (status == GL_TIMEOUT_EXPIRED || status == GL_WAIT_FAILED) {
            throw GpuError("the GPU does not answer any more; restart the server");
        }
    }
    return {mapped_, requested_};
}

}  // namespace raybundle
