// SPDX-License-Identifier: Apache-2.0
#include "session/light/solution_sharing.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "scene/mix_bits.h"

namespace raybundle {

namespace {

constexpr double rest_per_work = 19.0;  // a twentieth of the time is work
constexpr double least_rest_ms = 500.0;
/// Own samples are published when there are so many times as many as last time: the others lack a
/// ninth of them at most, and a solve of any length is published some dozens of times.
constexpr double growth = 1.125;

/// Which triangles make which patches. Their places are what the file and the options say, and
/// another rounding would do no harm.
std::uint64_t fingerprint_of(const PatchMesh& mesh, std::uint64_t sum) {
    for (const glm::uvec3& triangle : mesh.triangles) {
        sum = mix_bits(sum ^ (std::uint64_t{triangle.x} << 32U | triangle.y));
        sum = mix_bits(sum ^ triangle.z);
    }
    for (const std::uint32_t object : mesh.vertex_object) {
        sum = mix_bits(sum ^ object);
    }
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        sum =
            mix_bits(sum ^ (std::uint64_t{mesh.side_triangle[side]} << 32U | mesh.patch_of(side)));
    }
    return sum;
}

}  // namespace

void SolutionSharing::step() {
    const LiveScene& scene = parts_.scene;
    if (parts_.exchange == nullptr || !scene.log().agrees()) {
        return;
    }
    follow_scene();
    const TimePoint begun = parts_.clock.now();
    if (scene.solver().correcting() || scene.fades().running() || begun < next_) {
        return;
    }
    take_own();
    ask_for_own();
    merge();
    const TimePoint now = parts_.clock.now();
    const double rest_ms = std::max(rest_per_work * milliseconds(now - begun), least_rest_ms);
    next_ = now + std::chrono::duration_cast<TimePoint::duration>(
                      std::chrono::duration<double, std::milli>(rest_ms));
}

/// After a change all begins anew.
void SolutionSharing::follow_scene() {
    const LiveScene& scene = parts_.scene;
    Subject subject{&scene.solver(), scene.fades().steps(), subject_.state};
    subject.state.epoch = scene.epoch();
    if (subject_.solver != subject.solver) {  // maybe of another mesh
        subject.state.patches = static_cast<std::uint32_t>(scene.mesh().patch_count());
        subject.state.fingerprint = fingerprint_of(scene.mesh(), parts_.fingerprint);
    }
    if (subject == subject_) {
        return;
    }
    if (subject_.state.patches != subject.state.patches) {
        readback_.reset();
    } else if (readback_) {
        readback_->cancel();
    }
    subject_ = subject;
    asked_samples_ = 0;
    own_weight_ = 0.0;
    parts_.exchange->begin(subject_.state, scene.solver().scene().radiance_unit());
}

void SolutionSharing::take_own() {
    if (!readback_ || !readback_->ready()) {
        return;
    }
    const auto means = readback_->take_as<glm::vec4>();
    PatchMeans own(means.begin(), means.end());
    own_weight_ = own.empty() ? 0.0 : static_cast<double>(own.front().w);  // of all patches alike
    parts_.exchange->publish(std::move(own));
}

void SolutionSharing::ask_for_own() {
    const Solver& solver = parts_.scene.solver();
    const Buffer* const own = solver.own_light();
    if (own == nullptr || (readback_ && readback_->pending()) ||
        static_cast<double>(solver.samples()) < growth * static_cast<double>(asked_samples_)) {
        return;
    }
    if (!readback_) {
        readback_.emplace("own means readback", own->bytes());
    }
    readback_->request(*own, own->bytes());
    asked_samples_ = solver.samples();
}

void SolutionSharing::merge() {
    const std::optional<MergedMeans> others = parts_.exchange->collect();
    if (!others) {
        return;
    }
    const double all = own_weight_ + others->weights;
    const double squares = own_weight_ * own_weight_ + others->squared_weights;
    parts_.scene.solver().store().merge(
        others->means, squares > 0.0 ? static_cast<float>(all * all / squares) : 1.0F);
}

std::optional<ExchangeFigures> SolutionSharing::figures() const {
    return parts_.exchange == nullptr ? std::nullopt : std::optional(parts_.exchange->figures());
}

}  // namespace raybundle
