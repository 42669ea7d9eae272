// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options/cli_options.h"

namespace raybundle {

/// Check of a number for which `fits` holds; else the text is not what `wanted` says.
CLI::Validator number_that(bool (*fits)(double), const std::string& wanted);
/// Of a number above 0.
CLI::Validator positive();
/// Of a number above 0 and below 1.
CLI::Validator relative_error();

/// The options of `measure`.
void add_measure(CLI::App& app, Options& options);

}  // namespace raybundle
