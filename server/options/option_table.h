// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "options/cli_options.h"

namespace raybundle {

/// Where an option's value lies.
using OptionMember =
    std::variant<bool Options::*, int Options::*, std::uint64_t Options::*, float Options::*,
                 double Options::*, std::optional<float> Options::*, std::string Options::*,
                 std::vector<std::string> Options::*, SkyChoice Options::*>;

/// One option of `serve`, on the command line and in the configuration file alike.
struct ServeOption {
    const char* key;   ///< in the file, e.g. "tlsCert"; the flag is --tls-cert
    const char* help;  ///< with unit and meaning
    OptionMember member;
    /// Of numbers; what lies outside is refused.
    double min = 0.0;
    double max = 0.0;
    /// Reason to refuse a text, empty where it is fine; null: any text.
    std::string (*problem)(const std::string& text) = nullptr;
    bool common = false;  ///< known to the other commands too
};

/// The one table. "SCENE", a positional argument, has the key "scene" in the file.
std::span<const ServeOption> serve_options();

/// "--tls-cert" of "tlsCert".
std::string flag_of(std::string_view key);

/// Why an option's present value is out of range; empty where it is fine.
std::string problem_of(const ServeOption& option, const Options& options);

}  // namespace raybundle
