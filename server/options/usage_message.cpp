// SPDX-License-Identifier: Apache-2.0
#include "options/usage_message.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <vector>

namespace raybundle {
namespace {

/// Letters to be put in, left out or replaced to make one word the other.
std::size_t letters_apart(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[k - 1] ? 0U : 1U);
            diagonal = row[k];
            row[k] = std::min({row[k] + 1, row[k - 1] + 1, replaced});
        }
    }
    return row.back();
}

/// The most similar of some words, where it is as near as a slip of the fingers.
std::string similar(const std::string& word, const std::vector<std::string>& known) {
    const auto nearest =
        std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
            return letters_apart(word, a) < letters_apart(word, b);
        });
    return nearest != known.end() && letters_apart(word, *nearest) <= 2 ? *nearest : std::string();
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    const std::string meant = similar(word, names);
    return fmt::format("there is no command '{}'; {}", word,
                       meant.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                     : fmt::format("is '{}' meant?", meant));
}

std::string unknown_argument(const CLI::App& command, const std::string& name,
                             const std::string& word) {
    if (!word.starts_with('-')) {
        return fmt::format("{}'{}' is one argument too many", name, word);
    }
    const std::string meant = similar(word.substr(0, word.find('=')), option_names(command));
    return fmt::format("{}there is no option '{}'{}", name, word,
                       meant.empty() ? "" : fmt::format("; is '{}' meant?", meant));
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::Error& error) {
    const auto parsed = app.get_subcommands();
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    // The name of the whole program is how it has been called, a path.
    const std::string name = parsed.empty() ? "" : command.get_name() + ": ";
    std::string text = error.what();
    // Its name is that of the command.
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
        const std::vector<std::string> words = app.remaining(true);
        if (!words.empty()) {
            const std::string& word = words.front();
            text = parsed.empty() && !word.starts_with('-') ? unknown_command(app, word)
                                                            : unknown_argument(command, name, word);
        }
    }
    return fmt::format("raybundle: {}\nraybundle {}--help lists what there is\n", text,
                       parsed.empty() ? "" : command.get_name() + " ");
}

}  // namespace raybundle
