// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// Values of rgb9e5() that lie near one another, in few bytes and without loss: a zlib stream of
/// four planes of a byte for each value. Of the differences from the value before, modulo their
/// sizes, mapped to 2d or -2d - 1, the first plane has the exponent's in bits 3 to 7 and bit 8 of
/// the three mantissas' in bits 0 to 2, the others their low bytes.
std::string encode_light_block(std::span<const std::uint32_t> values);

/// Nothing where the bytes are no such block of so many values.
std::optional<std::vector<std::uint32_t>> decode_light_block(std::string_view bytes,
                                                             std::size_t count);

}  // namespace raybundle
