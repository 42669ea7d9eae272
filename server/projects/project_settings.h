// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "net/access/access_tokens.h"

namespace raybundle {

/// A project that is served.
struct ProjectSettings {
    std::string name;    ///< see is_project_name()
    std::string title;   ///< for people
    std::string scene;   ///< file
    std::string config;  ///< of its `raybundle serve`, JSON
    /// Opens its server for the front's own requests; empty: it needs none.
    std::string token;
    std::uint64_t max_memory_bytes = 0;  ///< 0: no limit
    std::size_t max_connections = 256;
    std::size_t max_viewers = 64;

    /// Whoever has no token of its may not look into it.
    [[nodiscard]] bool secret() const { return !token.empty(); }
};

/// What the front does.
struct FrontSettings {
    std::string host = "127.0.0.1";
    std::uint16_t port = 8080;  ///< 0: any free one
    std::string state_folder;   ///< of journals and pictures
    double sleep_after_s = 60.0;
    std::uint64_t max_memory_bytes = 0;  ///< of all projects; 0: no limit
    std::size_t max_connections = 1024;
    /// Those of this machine are not limited, since a reverse proxy runs there.
    std::size_t max_connections_per_address = 64;
    AccessTokens tokens;  ///< that open the list; none: everybody sees what needs no token
    std::vector<ProjectSettings> projects;
};

}  // namespace raybundle
