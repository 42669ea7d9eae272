// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/live/light_block_code.h"

#include <zlib.h>

#include <array>
#include <stdexcept>

namespace raybundle {

namespace {

constexpr std::size_t planes = 4;

/// The parts of a value: three mantissas and the exponent.
using Parts = std::array<std::uint32_t, 4>;
constexpr Parts sizes = {512, 512, 512, 32};

Parts parts_of(std::uint32_t value) {
    return {value & 511U, value >> 9U & 511U, value >> 18U & 511U, value >> 27U};
}

std::uint32_t value_of(const Parts& parts) {
    return parts[0] | parts[1] << 9U | parts[2] << 18U | parts[3] << 27U;
}

/// A difference modulo `size` as a number that is small where it is near 0.
std::uint32_t folded(std::uint32_t difference, std::uint32_t size) {
    return difference < size / 2 ? 2 * difference : 2 * (size - difference) - 1;
}

std::uint32_t unfolded(std::uint32_t number, std::uint32_t size) {
    return number % 2 == 0 ? number / 2 : size - (number + 1) / 2;
}

}  // namespace

std::string encode_light_block(std::span<const std::uint32_t> values) {
    const std::size_t count = values.size();
    std::vector<unsigned char> raw(planes * count);
    Parts before{};
    for (std::size_t i = 0; i < count; ++i) {
        const Parts now = parts_of(values[i]);
        Parts code{};
        for (std::size_t k = 0; k < code.size(); ++k) {
            code[k] = folded((now[k] + sizes[k] - before[k]) % sizes[k], sizes[k]);
        }
        raw[i] = static_cast<unsigned char>(code[3] << 3U | code[0] >> 8U | (code[1] >> 8U) << 1U |
                                            (code[2] >> 8U) << 2U);
        for (std::size_t k = 0; k < 3; ++k) {
            raw[(k + 1) * count + i] = static_cast<unsigned char>(code[k] & 255U);
        }
        before = now;
    }
    uLongf size = compressBound(static_cast<uLong>(raw.size()));
    std::string bytes(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, raw.data(),
                  static_cast<uLong>(raw.size()), Z_BEST_SPEED) != Z_OK) {
        throw std::runtime_error("zlib: a block of light cannot be compressed");
    }
    bytes.resize(size);
    return bytes;
}

std::optional<std::vector<std::uint32_t>> decode_light_block(std::string_view bytes,
                                                             std::size_t count) {
    std::vector<unsigned char> raw(planes * count);
    auto size = static_cast<uLongf>(raw.size());
    if (uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                   static_cast<uLong>(bytes.size())) != Z_OK ||
        size != raw.size()) {
        return std::nullopt;
    }
    std::vector<std::uint32_t> values(count);
    Parts parts{};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t flags = raw[i];
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            const std::uint32_t number =
                k == 3 ? flags >> 3U : (flags >> k & 1U) << 8U | raw[(k + 1) * count + i];
            parts[k] = (parts[k] + unfolded(number, sizes[k])) % sizes[k];
        }
        values[i] = value_of(parts);
    }
    return values;
}

}  // namespace raybundle
