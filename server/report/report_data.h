// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/work_plane.h"
#include "raybundle.pb.h"

namespace raybundle {

/// A zone as it is reported.
struct ReportZone {
    v1::Measure measure;
    v1::Measured found;
    MeasuredArea lattice;              ///< what the grid lies on
    GridSize lattice_size;             ///< its points; 0 x 0: single points
    std::vector<std::uint32_t> cells;  ///< which of them found.points() are, row by row
    double area = 0.0;                 ///< of its outline, m²; 0: single points
};

/// What a report says: a copy of what is known at one moment.
struct ReportData {
    std::string server;
    v1::Scene scene;  ///< its name, bounds, lights, groups, lighting scenes and daylight
    std::uint32_t epoch = 0;
    double made_at_ms = 0.0;              ///< Unix time
    std::optional<double> picture_error;  ///< relative, of the best picture that somebody sees
    std::vector<ReportZone> zones;
    double floor_area = 0.0;  ///< of the rooms with luminaires, m²; 0: not known
    std::vector<v1::Requirement> requirements;
    std::vector<v1::PinChanged> pins;
    v1::ChangeHistory changes;
    std::map<std::uint32_t, std::string> objects;  ///< names by number, of removed ones too
};

struct ReportOptions {
    bool german = false;
    bool foot_candles = false;  ///< of illuminance, else lx
    double since_ms = 0.0;      ///< Unix time from which on changes are listed
    double area = 0.0;          ///< m², that power is divided by; 0: ReportData::floor_area
    double hours = 2500.0;      ///< that lights burn in a year, for LENI: an office's of EN 15193-1
};

/// Area of a polygon in space whose corners lie in a plane, m².
double area_of(const std::vector<glm::dvec3>& outline);

}  // namespace raybundle
