// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "net/rest/rest_route.h"
#include "net/ws/wire_codec.h"

namespace raybundle {

/// The messages that a request comes to, with ids from 1 on; checked as on the socket.
std::variant<std::vector<v1::ClientMessage>, Refusal> rest_messages(const RestMatch& match,
                                                                    std::string_view body,
                                                                    const WireLimits& limits);

/// What a request is answered: the part of `message`, the JSON of a ServerMessage, that the route
/// names. Nothing where the element of a list that the path names is not there.
std::optional<std::string> rest_answer(const RestMatch& match, std::string_view message);

/// Path of what has been made, for the header Location: of a route with status 201.
std::string location_of(const RestRoute& route, std::string_view answer);

}  // namespace raybundle
