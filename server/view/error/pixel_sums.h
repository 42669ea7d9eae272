// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "view/error/sample_batches.h"

namespace raybundle {

/// Sums of view_statistics.comp and view_detail.comp over the probe pixels of a picture, on their
/// way from the GPU, and the samples that they are of.
class PixelSums {
  public:
    struct Sums {
        glm::dvec4 light{0.0}, detail{0.0}, drift{0.0}, difference{0.0}, batches{0.0};
    };

    PixelSums();

    void bind() const;
    /// The samples begin anew.
    void restart();
    /// What was requested is of another scene.
    void forget_request() { requested_samples_ = 0; }
    /// Ends a batch of samples and tells view_statistics.comp of all batches.
    void end_batch(const ShaderProgram& statistics, const SampleWeights& all, SampleOrder order);
    /// Runs view_statistics.comp or view_detail.comp; all that they need is bound.
    static void run(const ShaderProgram& program);
    /// Detail finer than the pixels changes little: due when there are twice as many samples.
    [[nodiscard]] bool detail_due(std::uint64_t samples) const;
    void note_detail(std::uint64_t samples) { detail_samples_ = samples; }

    /// Queues the readback; samples: so far.
    void request(std::uint64_t samples);
    [[nodiscard]] bool ready() const { return readback_.ready(); }
    /// As last requested; waits for them.
    [[nodiscard]] Sums take();
    [[nodiscard]] std::uint64_t requested_samples() const { return requested_samples_; }
    [[nodiscard]] SampleBatches& batches() { return batches_; }

  private:
    Buffer partial_;  // of the work groups
    Readback readback_;
    SampleBatches batches_;
    std::uint64_t requested_samples_ = 0;
    std::uint64_t detail_samples_ = 0;  // when the detail was measured last
};

}  // namespace raybundle
