// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace raybundle {

/// The step of splitmix64 (Steele, Lea, Flood 2014): 64 bits that look random, from any others.
inline std::uint64_t mix_bits(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15ULL;
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
    return value ^ (value >> 31U);
}

}  // namespace raybundle
