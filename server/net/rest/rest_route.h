// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "net/http/http_response.h"

namespace raybundle {

inline constexpr std::string_view kRestFolder = "/api/";
inline constexpr std::string_view kOpenApiPath = "/api/openapi.json";
inline constexpr std::string_view kRestRequestsPath = "/api/v1/requests/";

/// What the body of a request is.
enum class RestBody {
    none,
    message,   ///< the fields of its one message, without those that stand in the path
    one_of,    ///< an object with one of its messages, by name, and `requestKey` if need be
    sequence,  ///< an object with some of its messages, which take effect in order; the last is a
               ///< must
};

/// Who answers.
enum class RestSource {
    session,     ///< the messages, on the render thread
    photometry,  ///< the folder of photometric files
    requests,    ///< an earlier request that was answered with 202
    presence,    ///< what viewers have been told last of who is here
};

/// An operation of the interface. Requests become messages as they come over the socket, by their
/// JSON names; the answer is a part of the ServerMessage that answers the last of them.
struct RestRoute {
    HttpMethod method = HttpMethod::get;
    std::string_view path;                     ///< "/api/v1/pins/{pin}": parts in braces are fields
    std::string_view operation;                ///< operationId
    std::string_view summary;                  ///< one sentence
    std::vector<std::string_view> messages{};  ///< fields of ClientMessage
    RestBody body = RestBody::none;
    /// Paths in ServerMessage, "welcome.scene.lights". Several: the answer is an object with the
    /// one that it is.
    std::vector<std::string_view> answers{};
    /// Of one element of a list: the field by which the path's part names it.
    std::string_view key{};
    int status = 200;
    double wait_s = 10.0;  ///< for the answer, unless the query says otherwise
    RestSource source = RestSource::session;
};

/// All operations.
std::span<const RestRoute> rest_routes();

/// Fields in a path, in order: "pin" of "/api/v1/pins/{pin}".
std::vector<std::string> path_fields(std::string_view path);

/// A route with what stands in the request's path for its fields.
struct RestMatch {
    const RestRoute* route = nullptr;  ///< null: none of this method
    std::vector<std::pair<std::string, std::string>> fields;
    /// The path has operations, though perhaps none of this method: "GET, POST".
    std::string allowed;
};
RestMatch match_route(HttpMethod method, std::string_view path);

/// "GET", "DELETE" ...
std::string_view method_name(HttpMethod method);

}  // namespace raybundle
