// SPDX-License-Identifier: Apache-2.0
#include "journal/solution_estimate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace raybundle {
namespace {

static_assert(std::endian::native == std::endian::little, "estimates are stored as they are");

constexpr std::uint32_t magic = 0x31534252;  // "RBS1"
constexpr float most = 1e30F;                // of a sum: nothing real is near it

struct StoredHead {
    std::uint32_t magic, epoch;
    std::uint64_t fingerprint;
    std::uint32_t patches, number;
};
static_assert(sizeof(StoredHead) == estimate_head_bytes);
static_assert(sizeof(glm::vec4) == 16);

glm::vec4 sum_at(std::string_view estimate, std::size_t patch) {
    glm::vec4 sum;
    std::memcpy(&sum, estimate.data() + estimate_head_bytes + patch * sizeof sum, sizeof sum);
    return sum;
}

/// Single patches may be slightly below 0, see docs/decisions.md, "Error bars"; weights may not.
bool is_sum(const glm::vec4& v) {
    return std::abs(v.x) < most && std::abs(v.y) < most && std::abs(v.z) < most && v.w >= 0.0F &&
           v.w < most;
}

}  // namespace

std::string encode_estimate(const EstimateHead& head, const PatchMeans& means, float unit) {
    const StoredHead stored{magic, head.state.epoch, head.state.fingerprint, head.state.patches,
                            head.number};
    std::string bytes(estimate_bytes(static_cast<std::uint32_t>(means.size())), '\0');
    std::memcpy(bytes.data(), &stored, sizeof stored);
    char* at = bytes.data() + sizeof stored;
    for (const glm::vec4& mean : means) {
        const glm::vec4 sum(glm::vec3(mean) * (mean.w * unit), mean.w);
        std::memcpy(at, &sum, sizeof sum);
        at += sizeof sum;
    }
    return bytes;
}

std::optional<EstimateHead> read_estimate_head(std::string_view bytes) {
    StoredHead stored{};
    if (bytes.size() < sizeof stored) {
        return std::nullopt;
    }
    std::memcpy(&stored, bytes.data(), sizeof stored);
    if (stored.magic != magic) {
        return std::nullopt;
    }
    return EstimateHead{{stored.epoch, stored.fingerprint, stored.patches}, stored.number};
}

std::string problem_of_head(const std::optional<EstimateHead>& head, const SolutionState& state) {
    if (!head) {
        return "it is none, or of another version";
    }
    if (head->state.epoch != state.epoch) {
        return "it is of another state of the scene";
    }
    if (head->state.patches != state.patches) {
        return "its scene is cut into " + std::to_string(head->state.patches) +
               " patches, and this one into " + std::to_string(state.patches) +
               ": use the same options and version";
    }
    if (head->state.fingerprint != state.fingerprint) {
        return "its scene file, options, version or patches are not those of this one";
    }
    return {};
}

std::string problem_of_estimate(std::string_view bytes, const SolutionState& state) {
    std::string problem = problem_of_head(read_estimate_head(bytes), state);
    if (!problem.empty()) {
        return problem;
    }
    if (bytes.size() != estimate_bytes(state.patches)) {
        return "it has another length than its head says";
    }
    for (std::size_t i = 0; i < state.patches; ++i) {
        if (!is_sum(sum_at(bytes, i))) {
            return "it holds a number that is none, or out of range";
        }
    }
    return {};
}

void EstimateSum::add(std::string_view estimate) {
    double weight = 0.0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const glm::dvec4 sum(sum_at(estimate, i));
        sums_[i] += sum;
        weight += sum.w;
    }
    weight /= std::max<double>(static_cast<double>(sums_.size()), 1.0);
    result_.weights += weight;
    result_.squared_weights += weight * weight;
    ++result_.workers;
}

MergedMeans EstimateSum::means(float unit) const {
    MergedMeans merged = result_;
    merged.means.reserve(sums_.size());
    for (const glm::dvec4& sum : sums_) {
        const double scale = sum.w > 0.0 ? 1.0 / (sum.w * static_cast<double>(unit)) : 0.0;
        merged.means.emplace_back(glm::vec3(glm::dvec3(sum) * scale), static_cast<float>(sum.w));
    }
    return merged;
}

}  // namespace raybundle
