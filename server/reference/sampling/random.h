// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace raybundle {

/// 64-bit finaliser of SplitMix64 (Steele, Lea, Flood 2014): decorrelates structured integers.
inline std::uint64_t mixed_bits(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15ULL;
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
    return value ^ (value >> 31U);
}

/// Centre of the 32-bit cell of the unit interval: never 0, never 1.
inline double unit_interval(std::uint32_t bits) {
    return (static_cast<double>(bits) + 0.5) * 0x1.0p-32;
}

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3"):
/// four random words from a counter and a key, without any state.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Source of uniform numbers in (0, 1) for one sample of something.
class Sampler {
  public:
    Sampler() = default;
    virtual ~Sampler() = default;
    Sampler(const Sampler&) = default;
    Sampler& operator=(const Sampler&) = default;

    virtual double next() = 0;
    virtual glm::dvec2 next_pair() = 0;
};

/// Source of independent uniform random numbers: the stream is a pure function of seed, stream
/// number and position, so results do not depend on who draws them.
class RandomStream final : public Sampler {
  public:
    RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

    double next() override;
    glm::dvec2 next_pair() override;

  private:
    std::uint64_t seed_, stream_;
    std::uint64_t drawn_ = 0;
    std::array<std::uint32_t, 4> words_{};
};

/// Random numbers of one sample of one pixel: (0, 2)-sequences of Sobol', Owen-scrambled by hashing
/// and padded (Burley 2020, "Practical Hash-based Owen Scrambling"). The samples of one pixel and
/// batch are spread evenly over every dimension and pair; different pixels, batches and seeds are
/// independent.
class PixelSampler final : public Sampler {
  public:
    PixelSampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t batch, std::uint32_t index);

    double next() override;  ///< the first of a pair
    glm::dvec2 next_pair() override;

  private:
    /// Hashes for the next dimensions and the number of this sample among their points.
    struct Place {
        std::uint64_t hash;
        std::uint32_t index;
    };

    Place next_place();

    std::uint64_t key_;
    std::uint32_t index_;
    std::uint32_t dimension_ = 0;
};

}  // namespace raybundle
