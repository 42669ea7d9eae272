// SPDX-License-Identifier: Apache-2.0
#include "stream/depth_code.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace raybundle {
namespace {

constexpr float kSteps = 65535.0F;

std::vector<std::uint16_t> quantise(const DepthMap& depths, float nearest) {
    std::vector<std::uint16_t> values(depths.inverse.size());
    std::transform(depths.inverse.begin(), depths.inverse.end(), values.begin(),
                   [nearest](float inverse) {
                       const float share = std::clamp(inverse * nearest, 0.0F, 1.0F);
                       return static_cast<std::uint16_t>(std::lround(share * kSteps));
                   });
    return values;
}

/// Modulo 2^16; small differences of either sign become small numbers.
std::uint16_t zigzag(std::uint16_t difference) {
    const bool negative = (difference & 0x8000U) != 0;
    return static_cast<std::uint16_t>((difference << 1U) ^ (negative ? 0xFFFFU : 0U));
}

/// Differences from left + above - above left (0 outside): all low bytes, then all high ones.
std::vector<std::uint8_t> differences(const std::vector<std::uint16_t>& values,
                                      std::size_t columns) {
    std::vector<std::uint8_t> bytes(2 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool first_column = i % columns == 0;
        const bool first_row = i < columns;
        const unsigned left = first_column ? 0U : values[i - 1];
        const unsigned above = first_row ? 0U : values[i - columns];
        const unsigned corner = first_column || first_row ? 0U : values[i - columns - 1];
        const auto rest = zigzag(static_cast<std::uint16_t>(values[i] - (left + above - corner)));
        bytes[i] = static_cast<std::uint8_t>(rest & 0xFFU);
        bytes[values.size() + i] = static_cast<std::uint8_t>(rest >> 8U);
    }
    return bytes;
}

std::vector<std::uint8_t> deflate_bytes(const std::vector<std::uint8_t>& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<std::uint8_t> packed(size);
    const int failed = compress2(packed.data(), &size, bytes.data(),
                                 static_cast<uLong>(bytes.size()), Z_BEST_SPEED);
    if (failed != Z_OK) {
        throw std::runtime_error(std::string("zlib: ") + zError(failed));
    }
    packed.resize(size);
    return packed;
}

}  // namespace

EncodedDepths encode_depths(const DepthMap& depths) {
    const std::size_t points = std::size_t{depths.columns} * depths.rows;
    if (points == 0 || points != depths.inverse.size()) {
        throw std::runtime_error("depths: not as many as their grid has points");
    }
    const float most = *std::max_element(depths.inverse.begin(), depths.inverse.end());
    EncodedDepths encoded;
    encoded.nearest = most > 0.0F ? 1.0F / most : 0.0F;
    encoded.bytes = deflate_bytes(differences(quantise(depths, encoded.nearest), depths.columns));
    return encoded;
}

}  // namespace raybundle
