// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/sampling/random.h"

namespace raybundle {

/// A point of primary sample space (Kelemen, Szirmay-Kalos, Antal, Csonka 2002, "A Simple and
/// Robust Mutation Strategy for the Metropolis Light Transport Algorithm"): the uniform numbers
/// that a path is made of, as many as it asks for, and their mutations. A coordinate is brought up
/// to date only when it is asked for.
class PrimarySample : public Sampler {
  public:
    /// The first point is uniformly distributed. random: of it and the mutations.
    explicit PrimarySample(const RandomStream& random) : random_(random) {}

    /// Proposes a new point: uniform if `large`, else near the current one. The numbers drawn next
    /// are its coordinates.
    void propose(bool large);
    /// The proposed point becomes the current one.
    void accept();
    /// The current point stays.
    void reject();
    /// Mutations to come are drawn from another stream.
    void continue_with(const RandomStream& random) { random_ = random; }

    double next() override;
    glm::dvec2 next_pair() override;

  private:
    struct Coordinate {
        double value = 0.0, kept_value = 0.0;
        std::int64_t time = -1, kept_time = -1;  // of the last mutation
    };

    void mutate(Coordinate& coordinate);

    RandomStream random_;
    std::vector<Coordinate> coordinates_;
    std::size_t drawn_ = 0;
    std::int64_t time_ = 0;  // mutations accepted, and the one proposed
    std::int64_t large_time_ = 0;
    bool large_ = true;
};

}  // namespace raybundle
