// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "report/report_data.h"

namespace raybundle {

/// A whole HTML document that needs nothing else, with rules for A4 pages and their numbers.
std::string report_html(const ReportData& data, const ReportOptions& options);
/// All zones' points, in the report's unit: zone, quantity, x, y, z, value, from, to, note.
std::string report_csv(const ReportData& data, const ReportOptions& options);
/// Everything that the report says, lx and SI units.
std::string report_json(const ReportData& data, const ReportOptions& options);

}  // namespace raybundle
