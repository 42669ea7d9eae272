// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace raybundle {

/// What estimates must agree in to be of the same light.
struct SolutionState {
    std::uint32_t epoch = 0;        ///< of the last change
    std::uint64_t fingerprint = 0;  ///< of scene file, options, version and mesh
    std::uint32_t patches = 0;

    bool operator==(const SolutionState&) const = default;
};

/// Mean irradiance of each patch; w: weight of the samples behind it, 0: none.
using PatchMeans = std::vector<glm::vec4>;

/// What other workers' samples come to.
struct MergedMeans {
    PatchMeans means;
    /// Of each worker the weight of a patch's samples: their sum, and that of their squares.
    double weights = 0.0, squared_weights = 0.0;
    unsigned workers = 0;
};

struct ExchangeFigures {
    std::uint64_t bytes_sent = 0, bytes_received = 0;
    std::uint64_t published = 0, received = 0, refused = 0;  ///< estimates
    unsigned workers = 0;                                    ///< whose light is merged
    bool working = true;
};

/// The estimates of the workers of a project: each gives the others what its own samples since the
/// last change have brought, and takes theirs. Own samples are never in what it gets, so that
/// nothing counts twice. No exchange is a null pointer. Called by one thread; nothing waits for
/// the network.
class SolutionExchange {
  public:
    SolutionExchange() = default;
    virtual ~SolutionExchange() = default;
    SolutionExchange(const SolutionExchange&) = delete;
    SolutionExchange& operator=(const SolutionExchange&) = delete;

    /// From now on estimates are of this state; what has come of another one is void. unit: lx of
    /// what is published and collected here, which is each worker's own.
    virtual void begin(const SolutionState& state, float unit) = 0;
    /// Gives the others the own means, in place of the last ones.
    virtual void publish(PatchMeans own) = 0;
    /// What the others have, where that is something else than when it was collected last; with no
    /// workers where all have gone. The same set of estimates gives the same bits.
    [[nodiscard]] virtual std::optional<MergedMeans> collect() = 0;
    [[nodiscard]] virtual ExchangeFigures figures() const = 0;
};

}  // namespace raybundle
