// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "net/access/access_tokens.h"

namespace raybundle {

int run_token(const Options& options) {
    if (!parse_role(options.token.role)) {
        throw UsageError("--role: '" + options.token.role +
                         "' is none of VIEWER, REVIEWER, EDITOR");
    }
    const std::string token = random_token();
    nlohmann::ordered_json entry;
    entry["name"] = options.token.name;
    entry["role"] = options.token.role;
    entry["sha256"] = to_hex(token_digest(token));
    fmt::print("token, for the client:     {}\n", token);
    fmt::print("entry, for \"tokens\": [...]: {}\n", entry.dump());
    return exit_done;
}

}  // namespace raybundle
