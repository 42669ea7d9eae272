// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/descriptor.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace raybundle {

using SchemaJson = nlohmann::ordered_json;

/// JSON Schemas (2020-12) of messages in their proto3 JSON form, with the comments of the .proto as
/// descriptions.
class JsonSchemas {
  public:
    /// {"$ref": ...} of a message; it and what it refers to are among all().
    SchemaJson reference(const google::protobuf::Descriptor& type);
    /// Schema of a field.
    SchemaJson field(const google::protobuf::FieldDescriptor& field);
    /// Of the messages that have been referred to, by name.
    [[nodiscard]] const SchemaJson& all() const { return all_; }

  private:
    SchemaJson value(const google::protobuf::FieldDescriptor& field);

    SchemaJson all_ = SchemaJson::object();
};

}  // namespace raybundle
