// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "report/report_words.h"

namespace raybundle {

// Sections of the report as HTML, each with its heading; empty where there is nothing to say.
std::string project_section(const ReportData& data, const ReportWords& words);
std::string overview_section(const ReportData& data, const ReportWords& words);
std::string luminaire_section(const ReportData& data, const ReportWords& words);
std::string zone_sections(const ReportData& data, const ReportWords& words);
std::string pin_section(const ReportData& data, const ReportWords& words);
std::string change_section(const ReportData& data, const ReportWords& words);
std::string method_section(const ReportData& data, const ReportWords& words);

/// Electrical power of all lamps as they are switched and dimmed, W; unknown: lamps whose file
/// does not state it.
struct ReportPower {
    double watts = 0.0;
    std::size_t unknown = 0;
};
ReportPower power_of(const ReportData& data);
/// Of all zones of horizontal illuminance that are not strips around others, m².
double lit_area(const ReportData& data);

}  // namespace raybundle
