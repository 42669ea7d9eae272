// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace raybundle {

using ConfigJson = nlohmann::ordered_json;

/// Text of a configuration file. Throws UsageError where it cannot be read or is too large.
std::string read_config_file(const std::string& file);

/// Throws UsageError where the text is no JSON object or a key comes twice; `name` stands for the
/// file.
ConfigJson parse_config_json(const std::string& name, const std::string& text);

}  // namespace raybundle
