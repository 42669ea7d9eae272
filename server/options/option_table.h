// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "options/cli_options.h"

namespace raybundle {

/// Where an option's value lies.
template <typename Value>
struct OptionField {
    Value& (*of)(Options& options);
    const Value& (*of_const)(const Options& options);

    Value& operator()(Options& options) const { return of(options); }
    const Value& operator()(const Options& options) const { return of_const(options); }
};

/// A member of one of the groups of Options.
template <auto group, auto member>
constexpr auto field() {
    using Value = std::remove_reference_t<decltype(std::declval<Options&>().*group.*member)>;
    return OptionField<Value>{
        [](Options& options) -> Value& { return options.*group.*member; },
        [](const Options& options) -> const Value& { return options.*group.*member; }};
}

using AnyOptionField = std::variant<OptionField<bool>, OptionField<int>, OptionField<std::uint64_t>,
                                    OptionField<float>, OptionField<double>,
                                    OptionField<std::optional<float>>, OptionField<std::string>,
                                    OptionField<std::vector<std::string>>, OptionField<SkyChoice>>;

/// One option of `serve`, on the command line and in the configuration file alike.
struct OptionRow {
    const char* key;   ///< in the file, e.g. "tlsCert"; the flag is --tls-cert
    const char* help;  ///< with unit and meaning
    AnyOptionField field;
    /// Of numbers; what lies outside is refused.
    double min = 0.0;
    double max = 0.0;
    /// Reason to refuse a text, empty where it is fine; null: any text.
    std::string (*problem)(const std::string& text) = nullptr;
    bool common = false;  ///< known to the other commands too
};

/// The one table. "SCENE", a positional argument, has the key "scene" in the file.
std::span<const OptionRow> option_table();

/// "--tls-cert" of "tlsCert".
std::string flag_of(std::string_view key);

/// Why an option's present value is out of range; empty where it is fine.
std::string problem_of(const OptionRow& row, const Options& options);

}  // namespace raybundle
