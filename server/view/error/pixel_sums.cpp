// SPDX-License-Identifier: Apache-2.0
#include "view/error/pixel_sums.h"

#include <algorithm>

#include "gpu/layouts.h"

namespace raybundle {

namespace {

constexpr std::size_t sum_groups = 64;
constexpr std::size_t sum_group_size = 64;  // invocations

}  // namespace

PixelSums::PixelSums()
    : partial_("view statistics", 5 * sum_groups * sizeof(glm::vec4)),
      readback_("view statistics readback", partial_.bytes()) {
    partial_.clear();
}

void PixelSums::bind() const {
    partial_.bind_storage(BINDING_STATISTICS);
}

void PixelSums::restart() {
    batches_.restart();
    detail_samples_ = 0;
    requested_samples_ = 0;
}

void PixelSums::end_batch(const ShaderProgram& statistics, const SampleWeights& all,
                          SampleOrder order) {
    batches_.end(all, order);
    statistics.set("batch_begin", batches_.begin());
    statistics.set("batch_squares", batches_.squares());
}

void PixelSums::run(const ShaderProgram& program) {
    program.dispatch(sum_groups * sum_group_size);
}

bool PixelSums::detail_due(std::uint64_t samples) const {
    return samples >= std::max<std::uint64_t>(2 * detail_samples_, 2 * GROUP_SIZE);
}

void PixelSums::request(std::uint64_t samples) {
    readback_.request(partial_, partial_.bytes());
    requested_samples_ = samples;
}

PixelSums::Sums PixelSums::take() {
    Sums sums;
    const auto parts = readback_.take_as<glm::vec4>();
    if (parts.size() < 5 * sum_groups) {  // nothing has been requested
        return sums;
    }
    for (std::size_t i = 0; i < sum_groups; ++i) {
        sums.light += glm::dvec4(parts[i]);
        sums.detail += glm::dvec4(parts[sum_groups + i]);
        sums.drift += glm::dvec4(parts[2 * sum_groups + i]);
        sums.difference += glm::dvec4(parts[3 * sum_groups + i]);
        sums.batches += glm::dvec4(parts[4 * sum_groups + i]);
    }
    return sums;
}

}  // namespace raybundle
