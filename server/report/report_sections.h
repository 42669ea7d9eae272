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

/// Sky and sun, as they have been set.
std::string daylight_text(const v1::SetDaylight& day, const ReportWords& words);

/// Number of the object that a change moves or removes; 0: it does neither.
std::uint32_t object_of(const v1::SceneChanged& change);

/// Electrical power of all lamps as they are switched and dimmed, W; unknown: lamps whose file
/// does not state it.
struct ReportPower {
    double watts = 0.0;
    std::size_t unknown = 0;
    bool stated = false;  ///< by one lamp at least: else the sum means nothing
};
ReportPower power_of(const ReportData& data);
/// What power is divided by, m²: as asked for, else the floor of rooms with luminaires; 0: not
/// known. Never the zones: a desk is lit by the power of a room.
double lit_area(const ReportData& data, const ReportOptions& options);

}  // namespace raybundle
