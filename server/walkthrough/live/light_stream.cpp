// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/live/light_stream.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>
#include <utility>

#include "walkthrough/live/light_block_code.h"
#include "walkthrough/quantise.h"

namespace raybundle {

namespace {

/// Relative change of light that is one of 255 steps s of an sRGB display where that is least, at
/// white: d ln L / d s is 2.4 / (s + 0.055).
constexpr float visible_share = 2.4F / 1.055F / 255.0F;
/// A step at black, 1/(255 * 12.92) of white, where the mean is exposed for mid-grey, 0.18 of
/// white.
constexpr float faint_share = 1.0F / (255.0F * 12.92F * 0.18F);

float largest(const glm::vec3& colour) {
    return std::max({colour.r, colour.g, colour.b});
}

void append(std::string& bytes, std::size_t number) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<char>(number >> shift & 255U));
    }
}

/// Whether any of a ball may be in the picture's cone, and how much of the sphere round the eye it
/// covers.
std::pair<bool, float> seen(const LightBlock& block, const LightView& view) {
    const glm::vec3 way = block.centre - view.eye;
    const float distance = glm::length(way);
    if (distance <= block.radius) {
        return {true, 1.0F};
    }
    const float cosine = std::clamp(glm::dot(way, view.forward) / distance, -1.0F, 1.0F);
    const float half_size = std::asin(block.radius / distance);
    return {std::acos(cosine) <= view.half_angle + half_size, 0.5F * (1.0F - std::cos(half_size))};
}

/// Blocks as LightMessage has them.
class BlockMessage {
  public:
    void add(std::size_t block, const std::string& code) {
        append(blocks_, block);
        append(blocks_, code.size());
        blocks_ += code;
        ++count_;
    }
    [[nodiscard]] std::size_t size_with(const std::string& code) const {
        constexpr std::size_t head = 8;  // of a block, bytes
        return sizeof(std::uint32_t) + blocks_.size() + head + code.size();
    }
    [[nodiscard]] std::shared_ptr<const std::string> finish() const {
        std::string bytes;
        append(bytes, count_);
        return std::make_shared<const std::string>(bytes + blocks_);
    }

  private:
    std::string blocks_;
    std::size_t count_ = 0;
};

}  // namespace

std::vector<LightBlock> cut_into_blocks(std::span<const glm::vec3> positions, std::size_t count) {
    std::vector<LightBlock> blocks;
    for (std::size_t first = 0; first < positions.size(); first += count) {
        LightBlock block{first, std::min(count, positions.size() - first)};
        Bounds bounds;
        for (const glm::vec3& position : positions.subspan(block.first, block.count)) {
            bounds.add(position);
        }
        block.centre = bounds.centre();
        block.radius = 0.5F * glm::length(bounds.extent());
        blocks.push_back(block);
    }
    return blocks;
}

LightStream::LightStream(std::vector<LightBlock> blocks)
    : blocks_(std::move(blocks)), states_(blocks_.size()) {
    std::size_t values = 0;
    for (const LightBlock& block : blocks_) {
        values = std::max(values, block.first + block.count);
    }
    published_.resize(values);
}

/// 0: it looks the same.
float LightStream::visible_change(const LightBlock& block, std::span<const std::uint32_t> values,
                                  float faint) const {
    float most = 0.0F;
    for (std::size_t i = block.first; i < block.first + block.count; ++i) {
        if (values[i] == published_[i]) {
            continue;
        }
        const glm::vec3 before = from_rgb9e5(published_[i]);
        const glm::vec3 now = from_rgb9e5(values[i]);
        const float brightness = std::max(largest(before), largest(now));
        const float step = largest(glm::abs(now - before));
        if (step >= std::max(visible_share * brightness, faint)) {
            most = std::max(most, step / brightness);
        }
    }
    return most;
}

std::size_t LightStream::publish(std::span<const std::uint32_t> values) {
    if (values.size() != published_.size()) {
        throw std::invalid_argument("LightStream: not as many values as in its blocks");
    }
    double sum = 0.0;
    for (const std::uint32_t value : values) {
        sum += static_cast<double>(largest(from_rgb9e5(value)));
    }
    const auto count = static_cast<double>(std::max<std::size_t>(values.size(), 1));
    const float faint = faint_share * static_cast<float>(sum / count);
    std::size_t changed = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const LightBlock& block = blocks_[b];
        State& state = states_[b];
        const float change = state.version == 0 ? 1.0F : visible_change(block, values, faint);
        if (change == 0.0F) {
            continue;
        }
        const auto own = values.subspan(block.first, block.count);
        std::copy(own.begin(), own.end(),
                  published_.begin() + static_cast<std::ptrdiff_t>(block.first));
        state.version = publication_ + 1;
        state.change = std::min(change, 1.0F);
        ++changed;
    }
    if (changed > 0) {
        ++publication_;
        last_changes_.reset();
    }
    return changed;
}

const std::string& LightStream::code(std::size_t block) {
    State& state = states_[block];
    if (state.encoded != state.version) {
        state.code = encode_light_block(
            std::span(published_).subspan(blocks_[block].first, blocks_[block].count));
        state.encoded = state.version;
        ++encodings_;
    }
    return state.code;
}

std::shared_ptr<const std::string> LightStream::last_changes() {
    if (!last_changes_) {
        BlockMessage message;
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (states_[b].version == publication_) {
                message.add(b, code(b));
            }
        }
        last_changes_ = message.finish();
    }
    return last_changes_;
}

LightMessage LightFollower::send(std::shared_ptr<const std::string> bytes) {
    LightMessage message{++last_number_, std::move(bytes)};
    sent_.push_back({message.number, message.bytes->size()});
    in_flight_ += message.bytes->size();
    return message;
}

std::optional<LightMessage> LightFollower::next(LightStream& stream, const LightView& view,
                                                std::size_t window) {
    const std::uint32_t newest = stream.publication();
    if (complete_ == newest || (in_flight_ >= window && in_flight_ > 0)) {
        return std::nullopt;
    }
    if (complete_ && *complete_ + 1 == newest) {
        if (auto changes = stream.last_changes(); in_flight_ + changes->size() <= window) {
            complete_ = newest;
            return send(std::move(changes));
        }
    }
    if (complete_) {
        versions_.resize(stream.blocks().size());
        for (std::size_t b = 0; b < versions_.size(); ++b) {
            versions_[b] = std::min(stream.version(b), *complete_);
        }
        complete_.reset();
    }
    auto bytes = most_wanted(stream, view, window);
    return bytes ? std::optional(send(std::move(bytes))) : std::nullopt;
}

/// Null where there is no room for any.
std::shared_ptr<const std::string> LightFollower::most_wanted(LightStream& stream,
                                                              const LightView& view,
                                                              std::size_t window) {
    std::vector<std::pair<std::pair<bool, float>, std::size_t>> stale;
    for (std::size_t b = 0; b < versions_.size(); ++b) {
        if (versions_[b] != stream.version(b)) {
            auto [visible, cover] = seen(stream.blocks()[b], view);
            stale.push_back({{visible, cover * stream.change(b)}, b});
        }
    }
    std::stable_sort(stale.begin(), stale.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    BlockMessage message;
    std::size_t sent = 0;
    for (const auto& [visibility, b] : stale) {
        const std::string& code = stream.code(b);
        if (in_flight_ + message.size_with(code) > window && (sent > 0 || in_flight_ > 0)) {
            break;
        }
        message.add(b, code);
        versions_[b] = stream.version(b);
        ++sent;
    }
    if (sent == stale.size()) {
        complete_ = stream.publication();
        versions_ = {};
    }
    return sent > 0 ? message.finish() : nullptr;
}

void LightFollower::acknowledge(std::uint32_t number) {
    if (number > last_number_) {
        return;
    }
    while (!sent_.empty() && sent_.front().number <= number) {
        in_flight_ -= sent_.front().bytes;
        sent_.pop_front();
    }
}

}  // namespace raybundle
