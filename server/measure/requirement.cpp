// SPDX-License-Identifier: Apache-2.0
#include "measure/requirement.h"

#include <algorithm>

namespace raybundle {
namespace {

Verdict at_least(const Interval& found, double least) {
    if (found.low >= least) {
        return Verdict::met;
    }
    return found.high < least ? Verdict::missed : Verdict::unknown;
}

Verdict at_most(std::span<const GlareRating> ratings, double most) {
    const std::optional<GlareRange> range = range_of(ratings);
    if (range && range->maximum.low > most) {
        return Verdict::missed;
    }
    Verdict verdict = ratings.empty() ? Verdict::unknown : Verdict::met;
    for (const GlareRating& rating : ratings) {
        const bool rated = rating.state == GlareRating::State::rated;
        const bool holds =
            rated ? rating.value.high <= most : rating.state == GlareRating::State::no_source;
        verdict = holds ? verdict : Verdict::unknown;
    }
    return verdict;
}

const char* symbol_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::vertical:
            return "Ev";
        case Quantity::cylindrical:
            return "Ez";
        case Quantity::semicylindrical:
            return "Esz";
        case Quantity::daylight_factor:
            return "D";
        case Quantity::ugr:
            return "UGR";
        case Quantity::dgp:
            return "DGP";
        default:
            return "Em";
    }
}

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::met:
            return "met";
        case Verdict::missed:
            return "missed";
        default:
            return "not yet known";
    }
}

std::vector<Check> check(const Requirement& requirement, Quantity quantity,
                         const std::optional<MeasurementSummary>& found,
                         std::span<const GlareRating> ratings) {
    std::vector<Check> checks;
    if (is_glare(quantity)) {
        if (requirement.most) {
            checks.push_back({symbol_of(quantity), *requirement.most, true,
                              at_most(ratings, *requirement.most)});
        }
        return checks;
    }
    if (requirement.mean) {
        checks.push_back({symbol_of(quantity), *requirement.mean, false,
                          found ? at_least(found->mean, *requirement.mean) : Verdict::unknown});
    }
    if (requirement.uniformity) {
        checks.push_back(
            {"Uo", *requirement.uniformity, false,
             found ? at_least(found->uniformity, *requirement.uniformity) : Verdict::unknown});
    }
    return checks;
}

Verdict verdict_of(std::span<const Check> checks) {
    const auto has = [&](Verdict verdict) {
        return std::any_of(checks.begin(), checks.end(),
                           [verdict](const Check& one) { return one.verdict == verdict; });
    };
    return has(Verdict::missed)    ? Verdict::missed
           : has(Verdict::unknown) ? Verdict::unknown
                                   : Verdict::met;
}

}  // namespace raybundle
