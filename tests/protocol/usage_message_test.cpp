// SPDX-License-Identifier: Apache-2.0
#include "options/usage_message.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "options/cli_options.h"

namespace raybundle {
namespace {

/// What somebody reads of arguments that cannot be understood; empty where they can.
std::string message_of(std::vector<std::string> arguments) {
    CLI::App app;
    Options options;
    define_options(app, options);
    arguments.insert(arguments.begin(), "build/raybundle");
    std::vector<const char*> words;
    for (const std::string& argument : arguments) {
        words.push_back(argument.c_str());
    }
    try {
        app.parse(static_cast<int>(words.size()), words.data());
        return {};
    } catch (const CLI::ParseError& error) {
        return usage_message(app, error);
    }
}

TEST(UsageMessage, NamesTheWordThatIsNotKnownAndWhatIsMeant) {
    const auto begins = [](const std::string& text, const std::string& with) {
        EXPECT_EQ(text.substr(0, with.size()), with);
    };
    begins(message_of({"srve", "a.glb"}),
           "raybundle: there is no command 'srve'; is 'serve' meant?\n"
           "raybundle --help lists what there is\n");
    begins(
        message_of({"office.glb"}),
        "raybundle: there is no command 'office.glb'; there are serve, work, projects, render, ");
    begins(message_of({"serve", "a.glb", "--listn", "127.0.0.1:1"}),
           "raybundle: serve: there is no option '--listn'; is '--listen' meant?\n"
           "raybundle serve --help lists what there is\n");
    begins(message_of({"render", "a.glb", "-o", "a.png", "--quality=9"}),
           "raybundle: render: there is no option '--quality=9'\n");
    begins(message_of({"inspect", "a.glb", "b.glb"}),
           "raybundle: inspect: 'b.glb' is one argument too many\n");
    begins(message_of({"render", "a.glb"}), "raybundle: --output is required\n");
    begins(message_of({"--verison"}),
           "raybundle: there is no option '--verison'; is '--version' meant?");
    EXPECT_EQ(message_of({"inspect", "a.glb"}), "");
}

}  // namespace
}  // namespace raybundle
