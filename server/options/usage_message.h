// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace raybundle {

/// What is wrong with a command line, for people: names the first word that is not known, and what
/// there is instead.
std::string usage_message(const CLI::App& app, const CLI::Error& error);

}  // namespace raybundle
