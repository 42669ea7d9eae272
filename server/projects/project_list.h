// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "projects/projects.h"

namespace raybundle {

/// /projects.json. Of a project with tokens nobody but `trusted` readers, who have shown one of the
/// front, learns more than that it is there and whether it is awake.
std::string projects_json(const Projects& projects, FrontTime now, bool trusted);

/// /metrics: the front's own figures, then those of all servers that are awake, each with the label
/// `project`.
std::string projects_metrics(const Projects& projects, std::size_t connections);

/// Figures of several servers as one text: each family once, its samples with the label `project`.
/// `figures`: name and text of each.
std::string merged_metrics(const std::vector<std::pair<std::string, std::string>>& figures);

}  // namespace raybundle
