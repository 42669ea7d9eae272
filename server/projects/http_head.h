// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace raybundle {

/// Bytes of a request's head that are read; beyond that it is refused (431).
inline constexpr std::size_t max_head_bytes = 32768;

/// Headers in their order, names as they were sent.
using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

/// The value of a header, whatever the case of its name; empty where there is none.
std::string_view header_of(const HttpHeaders& headers, std::string_view name);

/// Line and headers of a request, understood in one way only: what two readers could understand
/// differently is refused (RFC 9112, 11.2).
struct RequestHead {
    std::string method;
    std::string target{};  ///< path and query, as sent
    HttpHeaders headers{};
    std::uint64_t body_bytes = 0;  ///< that follow; more is no part of the request
    bool upgrade = false;          ///< to a WebSocket: all that follows belongs to it, once granted
    bool expects_continue = false;
};

/// Why a request is refused.
struct HeadProblem {
    int status = 400;
    std::string text;
};

/// Reads a head, up to and including its empty line.
std::variant<RequestHead, HeadProblem> parse_request_head(std::string_view text);

/// Where a target leads: the project, and the target within it ("/ws?x"), which is empty where the
/// target is the project's name alone, without a slash. Nothing for any other target than those
/// below /p/.
struct ProjectTarget {
    std::string project;
    std::string target;
};
std::optional<ProjectTarget> project_target(std::string_view target);

/// Whether a project may be called so: 1 to 64 letters, digits, "-", "_", ".", the first a letter
/// or digit.
bool is_project_name(std::string_view name);

/// The head as a project's server gets it: one request, or one WebSocket, to a connection. `peer`
/// becomes the last entry of X-Forwarded-For.
std::string forwarded_head(const RequestHead& head, std::string_view target, std::string_view peer);

/// What the first bytes of a server's answer say, once its head is complete.
struct ResponseHead {
    int status = 0;
    std::string text;  ///< the head as the client gets it
    /// Of the body; nothing: until the connection ends.
    std::optional<std::uint64_t> body_bytes;
};

/// Reads the head of the answer to a request, up to and including its empty line. Says that the
/// connection ends, unless it has become a WebSocket; a Location on the server gets `prefix`
/// ("/p/NAME"). Nothing where it is none.
std::optional<ResponseHead> forwarded_response(std::string_view text, const RequestHead& request,
                                               std::string_view prefix);

}  // namespace raybundle
