// SPDX-License-Identifier: Apache-2.0
#include "solution/store/solution_measures.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {
constexpr std::size_t statistics_groups = 64;
constexpr float relevant_change = 0.01F;  // smaller relative changes are taken for noise
}  // namespace

SolutionMeasures::SolutionMeasures(std::uint32_t patch_count)
    : patch_count_(patch_count),
      scout_stride_((patch_count + MOST_SCOUTS - 1) / MOST_SCOUTS),
      counters_("counters", sizeof(layout::Counters)),
      checkpoint_buffer_("checkpoint", std::size_t{patch_count} * sizeof(glm::vec4)),
      sums_("solution statistics", statistics_groups * sizeof(glm::vec4)),
      scatter_("scatter of the strategies", (patch_count / scout_stride_ + 1) * sizeof(glm::vec2)),
      sums_readback_("statistics readback", sums_.bytes()),
      counters_readback_("counters readback", sizeof(layout::Counters)),
      checkpoint_({"solution_checkpoint.comp"}),
      statistics_({"solution_statistics.comp"}),
      measure_scatter_({"solution_scatter.comp"}) {
    for (const Buffer* buffer : {&counters_, &checkpoint_buffer_, &scatter_}) {
        buffer->clear();
    }
}

void SolutionMeasures::bind() const {
    counters_.bind_storage(BINDING_COUNTERS);
    checkpoint_buffer_.bind_storage(BINDING_CHECKPOINT);
    scatter_.bind_storage(BINDING_SCATTER);
}

void SolutionMeasures::checkpoint(bool unsettled) const {
    checkpoint_.set("unsettled", unsettled ? 1 : 0);
    checkpoint_.set("patch_count", patch_count_);
    checkpoint_.dispatch(patch_count_);
}

glm::dvec4 SolutionMeasures::reduce(const ShaderProgram& program) const {
    sums_.bind_storage(BINDING_STATISTICS);
    program.set("patch_count", patch_count_);
    program.dispatch(statistics_groups * 256);
    sums_readback_.request(sums_, sums_.bytes());
    glm::dvec4 sum(0.0);
    for (const glm::vec4& p : sums_readback_.take_as<glm::vec4>()) {
        sum += glm::dvec4(p);
    }
    return sum;
}

SolutionStatistics SolutionMeasures::statistics() const {
    statistics_.set("relevance", relevant_change);
    const glm::dvec4 sum = reduce(statistics_);
    SolutionStatistics result;
    result.distance = sum.z > 0.0 ? std::sqrt(sum.w / sum.z) : 0.0;
    result.settled = sum.x > 0.0 ? std::clamp(1.0 - std::sqrt(sum.y / sum.x), 0.0, 1.0) : 1.0;
    return result;
}

glm::dvec2 SolutionMeasures::take_scatter() const {
    scatter_.bind_storage(BINDING_SCATTER);
    measure_scatter_.set("scout_stride", scout_stride_);
    return glm::dvec2(reduce(measure_scatter_));
}

layout::Counters SolutionMeasures::take_counters() const {
    counters_readback_.request(counters_, sizeof(layout::Counters));
    clear_counters();
    return counters_readback_.take_as<layout::Counters>().front();
}

}  // namespace raybundle
