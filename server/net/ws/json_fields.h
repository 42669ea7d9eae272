// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace raybundle {

/// What a JSON message has that its schema has not.
struct JsonFields {
    std::string problem;  ///< empty, or "field: reason": no reader can make sense of it
    std::string unknown;  ///< empty, or the first field or enum name that the schema lacks: lenient
                          ///< readers ignore it
};

/// Compares strict JSON (see scan_json()) with the proto3 JSON mapping of `type`: names, types,
/// enum names, fields given twice or excluding each other. Unknown keys of the outermost object are
/// left to the caller. Protobuf's parser does this too, but drops unknown enum names silently and
/// words errors in its own terms.
JsonFields check_json_fields(std::string_view json, const google::protobuf::Descriptor& type);

/// The first field number or enum number of a message that the schema lacks, as "field: reason";
/// empty where there is none. Unknown fields of the outermost message are left to the caller.
std::string unknown_in_binary(const google::protobuf::Message& message);

/// First line of foreign text, at most 160 bytes, cut between two UTF-8 characters.
std::string short_excerpt(std::string_view text);

}  // namespace raybundle
