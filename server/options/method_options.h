// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "options/cli_options.h"

namespace raybundle {

/// Options of `render` that vary its methods.
void add_method_options(CLI::App& app, RenderOptions& render);

/// "0.15,0.15,0.7" -> shares of layered, plane and perspective bundles, scaled to a sum of 1;
/// nothing for an empty text. Throws UsageError naming the option: three numbers of 0 to 1 whose
/// sum is 1, to within their rounding (0.001).
std::optional<StrategyProbabilities> parse_shares(const std::string& option,
                                                  const std::string& text);

/// Throws UsageError where an option does not go with the method.
void check_method_options(const RenderOptions& render, const RenderMethod& method);

}  // namespace raybundle
