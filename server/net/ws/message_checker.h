// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "net/ws/wire_codec.h"

namespace raybundle {

/// Collects the first violation; later checks are skipped.
class MessageChecker {
  public:
    explicit MessageChecker(const WireLimits& limits) : limits_(limits) {}

    void require(bool holds, std::string_view field, std::string_view reason) {
        if (!holds && !refusal_) {
            refusal_ = Refusal{v1::Error::INVALID_ARGUMENT,
                               std::string(field) + ": " + std::string(reason), std::nullopt};
        }
    }

    [[nodiscard]] std::optional<Refusal> result() const { return refusal_; }

    /// Of a viewport, or of a snapshot.
    template <typename Size>
    void size(const Size& size, bool viewport, const std::string& field) {
        const std::uint32_t most = viewport ? limits_.max_viewport : limits_.max_picture;
        require(size.width() >= 1 && size.width() <= most, field + ".width",
                "must be 1.." + std::to_string(most));
        require(size.height() >= 1 && size.height() <= most, field + ".height",
                "must be 1.." + std::to_string(most));
    }

    void colour(const v1::Vec3& colour, float max, std::string_view field, std::string_view range) {
        const auto inside = [max](float value) { return value >= 0.0F && value <= max; };
        require(inside(colour.x()) && inside(colour.y()) && inside(colour.z()), field, range);
    }

    void share(float value, std::string_view field) {
        require(value >= 0.0F && value <= 1.0F, field, "must be 0..1");
    }

  private:
    const WireLimits& limits_;
    std::optional<Refusal> refusal_;
};

}  // namespace raybundle
