// SPDX-License-Identifier: Apache-2.0
#include "measure/requirement.h"

#include <algorithm>

namespace raybundle {
namespace {

Verdict judge(const Interval& found, double least) {
    if (found.low >= least) {
        return Verdict::met;
    }
    return found.high < least ? Verdict::missed : Verdict::unknown;
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

Verdict judge(const Requirement& requirement, const MeasurementSummary& found) {
    const Verdict mean = judge(found.mean, requirement.mean);
    const Verdict uniformity =
        requirement.uniformity ? judge(found.uniformity, *requirement.uniformity) : Verdict::met;
    if (mean == Verdict::missed || uniformity == Verdict::missed) {
        return Verdict::missed;
    }
    return mean == Verdict::met && uniformity == Verdict::met ? Verdict::met : Verdict::unknown;
}

}  // namespace raybundle
