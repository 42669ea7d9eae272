// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/random.h"

namespace raybundle {
namespace {

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = (x >> 1U & 0x55555555U) | (x & 0x55555555U) << 1U;
    x = (x >> 2U & 0x33333333U) | (x & 0x33333333U) << 2U;
    x = (x >> 4U & 0x0f0f0f0fU) | (x & 0x0f0f0f0fU) << 4U;
    x = (x >> 8U & 0x00ff00ffU) | (x & 0x00ff00ffU) << 8U;
    return x >> 16U | x << 16U;
}

/// Owen scrambling of a bit-reversed fraction: each bit is flipped depending on the bits below it
/// (Laine, Karras 2011, with the constants of Vegdahl 2021, "Building a Better LK Hash").
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= seed >> 16U | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

/// Bytes' contributions to the second dimension of Sobol's sequence, bit-reversed: its generator
/// matrix is Pascal's triangle modulo 2.
struct SobolTable {
    std::uint32_t word[4][256];
};

constexpr SobolTable make_sobol_table() {
    SobolTable table{};
    std::uint32_t direction = 0x80000000U;  // of index bit 0
    std::uint32_t directions[32];
    for (std::uint32_t& d : directions) {
        d = direction;
        direction ^= direction >> 1U;
    }
    for (unsigned byte = 0; byte < 4; ++byte) {
        for (unsigned value = 0; value < 256; ++value) {
            std::uint32_t sum = 0;
            for (unsigned bit = 0; bit < 8; ++bit) {
                sum ^= (value >> bit & 1U) != 0 ? directions[8 * byte + bit] : 0U;
            }
            table.word[byte][value] = reversed_bits(sum);
        }
    }
    return table;
}

std::uint32_t reversed_second_sobol(std::uint32_t index) {
    static constexpr SobolTable table = make_sobol_table();
    return table.word[0][index & 255U] ^ table.word[1][index >> 8U & 255U] ^
           table.word[2][index >> 16U & 255U] ^ table.word[3][index >> 24U];
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xd2511f53U} * counter[0];
        const std::uint64_t b = std::uint64_t{0xcd9e8d57U} * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32U) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32U) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(a)};
        key = {key[0] + 0x9e3779b9U, key[1] + 0xbb67ae85U};
    }
    return counter;
}

double RandomStream::next() {
    const std::uint64_t block = drawn_ / 4;
    if (drawn_ % 4 == 0) {
        words_ = philox(
            {static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(block >> 32U),
             static_cast<std::uint32_t>(stream_), static_cast<std::uint32_t>(stream_ >> 32U)},
            {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32U)});
    }
    return unit_interval(words_[drawn_++ % 4]);
}

glm::dvec2 RandomStream::next_pair() {
    const double first = next();
    return {first, next()};
}

PixelSampler::PixelSampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t batch,
                           std::uint32_t index)
    : key_(mixed_bits(mixed_bits(mixed_bits(seed) + pixel) + batch)), index_(index) {}

PixelSampler::Place PixelSampler::next_place() {
    const std::uint64_t hash = mixed_bits(key_ + dimension_++);
    // A scrambled order of the points decorrelates this pair from the others.
    return {mixed_bits(hash),
            reversed_bits(laine_karras(reversed_bits(index_), static_cast<std::uint32_t>(hash)))};
}

double PixelSampler::next() {
    const Place place = next_place();
    // The first dimension of Sobol' is the index bit-reversed: reversed once more it is the index.
    const std::uint32_t x = laine_karras(place.index, static_cast<std::uint32_t>(place.hash));
    return unit_interval(reversed_bits(x));
}

glm::dvec2 PixelSampler::next_pair() {
    const Place place = next_place();
    const std::uint32_t x = laine_karras(place.index, static_cast<std::uint32_t>(place.hash));
    const std::uint32_t y = laine_karras(reversed_second_sobol(place.index),
                                         static_cast<std::uint32_t>(place.hash >> 32U));
    return {unit_interval(reversed_bits(x)), unit_interval(reversed_bits(y))};
}

}  // namespace raybundle
