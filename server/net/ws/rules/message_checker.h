// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "net/ws/wire_codec.h"

namespace raybundle {

constexpr double kMinLength = 1e-6;           ///< of a direction, an axis, a distance
constexpr float kMaxTurn = 360.0F;            ///< degrees
constexpr std::size_t kMaxName = 64;          ///< characters
constexpr std::size_t kMaxTraceparent = 128;  ///< characters; of version 00 they are 55
constexpr double kMaxNumber = 1e9;  ///< metres, seconds, photometric units: keeps squares finite

inline glm::dvec3 to_vector(const v1::Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// Characters of a text.
inline std::size_t characters(const std::string& utf8) {
    return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
    }));
}

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
