// SPDX-License-Identifier: Apache-2.0
#include "net/rest/json_schema.h"

#include <limits>

namespace raybundle {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

/// The comment above or behind a declaration, in one line.
template <typename Declared>
std::string comment_of(const Declared& declared) {
    google::protobuf::SourceLocation location;
    if (!declared.GetSourceLocation(&location)) {
        return {};
    }
    std::string text;
    for (const char c : location.leading_comments + location.trailing_comments) {
        if (c != '\n' && c != ' ') {
            text += c;
        } else if (!text.empty() && text.back() != ' ') {
            text += ' ';
        }
    }
    while (!text.empty() && text.back() == ' ') {
        text.pop_back();
    }
    return text;
}

/// "Measure.Point" of raybundle.v1.Measure.Point.
std::string schema_name(const Descriptor& type) {
    return type.full_name().substr(type.file()->package().size() + 1);
}

}  // namespace

SchemaJson JsonSchemas::reference(const Descriptor& type) {
    const std::string name = schema_name(type);
    if (!all_.contains(name)) {
        all_[name] = SchemaJson::object();  // keeps its place while its fields are looked at
        SchemaJson schema{{"type", "object"}};
        if (const std::string comment = comment_of(type); !comment.empty()) {
            schema["description"] = comment;
        }
        SchemaJson properties = SchemaJson::object();
        for (int i = 0; i < type.field_count(); ++i) {
            properties[type.field(i)->json_name()] = field(*type.field(i));
        }
        schema["properties"] = std::move(properties);
        all_[name] = std::move(schema);
    }
    return {{"$ref", "#/components/schemas/" + name}};
}

SchemaJson JsonSchemas::field(const FieldDescriptor& field) {
    SchemaJson schema = value(field);
    if (field.is_repeated()) {
        schema = SchemaJson{{"type", "array"}, {"items", std::move(schema)}};
    }
    if (const std::string comment = comment_of(field); !comment.empty()) {
        schema["description"] = comment;
    }
    return schema;
}

/// Of one element where the field is a list.
SchemaJson JsonSchemas::value(const FieldDescriptor& field) {
    switch (field.type()) {
        case FieldDescriptor::TYPE_MESSAGE:
            return reference(*field.message_type());
        case FieldDescriptor::TYPE_ENUM: {
            SchemaJson names = SchemaJson::array();
            for (int i = 0; i < field.enum_type()->value_count(); ++i) {
                names.push_back(field.enum_type()->value(i)->name());
            }
            return {{"type", "string"}, {"enum", std::move(names)}};
        }
        case FieldDescriptor::TYPE_BOOL:
            return {{"type", "boolean"}};
        case FieldDescriptor::TYPE_UINT32:
            return {{"type", "integer"},
                    {"minimum", 0},
                    {"maximum", std::numeric_limits<std::uint32_t>::max()}};
        case FieldDescriptor::TYPE_STRING:
            return {{"type", "string"}};
        case FieldDescriptor::TYPE_BYTES:
            return {{"type", "string"}, {"contentEncoding", "base64"}};
        default:
            return {{"type", "number"}};
    }
}

}  // namespace raybundle
