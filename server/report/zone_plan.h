// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "report/report_data.h"
#include "report/report_words.h"

namespace raybundle {

/// A plan of a zone as SVG, seen from above or from where it faces: its outline, what was measured
/// in colours fit for colour-blind readers, lines of equal values with their labels, numbers where
/// there are few, arrows of the worst views of glare, a scale of length. Empty where there is
/// nothing to draw.
std::string zone_plan(const ReportZone& zone, const ReportWords& words);

}  // namespace raybundle
