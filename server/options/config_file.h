// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "options/cli_options.h"

namespace raybundle {

/// Reads a JSON configuration of `serve`: the keys of option_table(), "scene" and "tokens". What
/// options.config.on_command_line names keeps its value. Throws UsageError that names the file, the
/// key and the reason; an unknown key gets a suggestion. The options are unchanged then.
void apply_config_file(const std::string& file, Options& options);

/// As apply_config_file() for JSON text; `name` stands for the file in errors.
void apply_config_text(const std::string& name, const std::string& text, Options& options);

/// The options as they would be if the program started again now: the file is read again, the
/// command line still counts. Throws UsageError.
Options reread_config(const Options& options);

/// The configuration in effect as JSON that apply_config_file() reads back.
std::string print_config(const Options& options);

/// Those of these options that the light of a scene depends on, as text.
std::string light_options(const Options& options);

}  // namespace raybundle
