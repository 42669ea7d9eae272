// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measurement.h"
#include "measure/receiver.h"
#include "measure/zone_luminaires.h"

namespace raybundle {

enum class Verdict { met, missed, unknown };
/// "met", "missed" or "not yet known".
const char* name_of(Verdict verdict);

/// What a task asks of one quantity of its area, as a row of EN 12464-1 does.
struct Requirement {
    std::optional<double> mean;        ///< in the unit of the quantity, at least
    std::optional<double> uniformity;  ///< Uo, at least
    std::optional<double> most;        ///< of ratings of glare, at every point
    /// Ra, at least, of each luminaire that lights the area.
    std::optional<double> colour_rendering{};

    [[nodiscard]] bool empty() const { return !mean && !uniformity && !most && !colour_rendering; }
};

/// One number that is required.
struct Check {
    std::string what;  ///< Em, Ez, Ev, D, Uo, UGR, DGP or Ra
    double required = 0.0;
    bool at_most = false;
    Verdict verdict = Verdict::unknown;
    std::string words{};         ///< of Ra: which luminaires fall short, or do not state it
    bool by_measurement = true;  ///< more samples may decide it
};

/// By intervals: missed where one lies on the wrong side of what is required, met where all of it
/// lies on the right one, else unknown. A place without a rating is unknown; one where nothing
/// glares meets any. Ra of a group that holds the limit is unknown, as where a luminaire does not
/// state it.
std::vector<Check> check(const Requirement& requirement, Quantity quantity,
                         const std::optional<MeasurementSummary>& found,
                         std::span<const GlareRating> ratings,
                         std::span<const ZoneLuminaire> luminaires = {});

/// Of all together: missed where one is, met where all are.
Verdict verdict_of(std::span<const Check> checks);

}  // namespace raybundle
