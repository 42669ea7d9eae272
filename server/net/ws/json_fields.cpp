// SPDX-License-Identifier: Apache-2.0
#include "net/ws/json_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace raybundle {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::OneofDescriptor;
using Json = nlohmann::json;

constexpr std::size_t kMaxExcerpt = 160;  ///< bytes

std::string joined(const std::string& path, const std::string& name) {
    return path.empty() ? name : path + "." + name;
}

std::string field_names(const Descriptor& type) {
    std::string names;
    for (int i = 0; i < type.field_count(); ++i) {
        names += (i > 0 ? ", " : "") + type.field(i)->json_name();
    }
    return names.empty() ? "none" : names;
}

/// Names that a message may use: value 0 of every enum stands for an absent one.
std::string value_names(const EnumDescriptor& type) {
    std::string names;
    for (int i = 0; i < type.value_count(); ++i) {
        if (type.value(i)->number() != 0) {
            names += (names.empty() ? "" : ", ") + type.value(i)->name();
        }
    }
    return names;
}

std::string unknown_value(const std::string& path, const std::string& value,
                          const EnumDescriptor& type) {
    return path + ": unknown value " + value + ", must be one of " + value_names(type);
}

/// Whether a double is a uint32, as protobuf's JSON takes them.
bool fits_uint32(double value) {
    return value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max() &&
           value == std::floor(value);
}

/// A number, whether it is written as such or as a text; NaN where it is none.
double number_of(const Json& value) {
    if (value.is_number()) {
        return value.get<double>();
    }
    double number = std::numeric_limits<double>::quiet_NaN();
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, number);
        if (error != std::errc() || rest != end) {
            number = std::numeric_limits<double>::quiet_NaN();
        }
    }
    return number;
}

/// Walks a message while nlohmann's parser reads it; returning false ends the parse.
class FieldWalk : public nlohmann::json_sax<Json> {
  public:
    FieldWalk(JsonFields& found, const Descriptor& type) : found_(found), root_(&type) {}

    bool null() override { return !in_array() || complain("must not hold null"); }
    bool boolean(bool value) override { return scalar(value); }
    bool number_integer(number_integer_t value) override { return scalar(value); }
    bool number_unsigned(number_unsigned_t value) override { return scalar(value); }
    bool number_float(number_float_t value, const string_t& /*text*/) override {
        return scalar(value);
    }
    bool string(string_t& value) override { return scalar(value); }
    bool binary(binary_t& /*value*/) override { return false; }

    bool start_object(std::size_t /*elements*/) override {
        if (levels_.empty()) {
            levels_.push_back({root_, nullptr, "", {}, {}});
            return true;
        }
        const FieldDescriptor* const field = current();
        if (field == nullptr) {
            levels_.push_back({});
            return true;
        }
        if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || wants_array()) {
            return complain(wanted(*field));
        }
        if (!choose(*field)) {
            return false;
        }
        levels_.push_back({field->message_type(), nullptr, path(), {}, {}});
        return true;
    }

    bool start_array(std::size_t /*elements*/) override {
        const FieldDescriptor* const field = current();
        if (field != nullptr && !wants_array()) {
            return complain(wanted(*field));
        }
        levels_.push_back({nullptr, field, path(), {}, {}});
        return true;
    }

    bool end_object() override { return end(); }
    bool end_array() override { return end(); }

    bool key(string_t& key) override {
        Level& level = levels_.back();
        field_ = nullptr;
        if (level.type == nullptr) {
            return true;
        }
        field_ = level.type->FindFieldByCamelcaseName(key);
        field_ = field_ == nullptr ? level.type->FindFieldByName(key) : field_;
        if (field_ == nullptr) {
            note_unknown_key(level, key);
            return true;
        }
        return level.seen.insert(field_).second || complain("is given twice");
    }

    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;
    }

  private:
    /// An open object or array. Both pointers are null within a field that is not known.
    struct Level {
        const Descriptor* type = nullptr;        ///< of an object
        const FieldDescriptor* array = nullptr;  ///< of an array
        std::string path;
        std::set<const FieldDescriptor*> seen;
        std::map<const OneofDescriptor*, const FieldDescriptor*> chosen;
    };

    [[nodiscard]] bool in_array() const { return !levels_.empty() && levels_.back().array; }

    /// Field that the next value belongs to; null where it is not known.
    [[nodiscard]] const FieldDescriptor* current() const {
        const Level& level = levels_.back();
        return level.type != nullptr ? field_ : level.array;
    }

    [[nodiscard]] bool wants_array() const { return current()->is_repeated() && !in_array(); }

    [[nodiscard]] std::string path() const {
        const Level& level = levels_.back();
        return level.type != nullptr && field_ != nullptr ? joined(level.path, field_->json_name())
                                                          : level.path;
    }

    bool end() {
        levels_.pop_back();
        return true;
    }

    bool complain(const std::string& reason) {
        found_.problem = path() + ": " + reason;
        return false;
    }

    void note_unknown(std::string text) {
        if (found_.unknown.empty()) {
            found_.unknown = std::move(text);
        }
    }

    void note_unknown_key(const Level& level, const std::string& key) {
        if (levels_.size() > 1) {
            note_unknown(joined(level.path, short_excerpt(key)) + ": unknown field; known are " +
                         field_names(*level.type));
        }
    }

    static std::string wanted(const FieldDescriptor& field) {
        if (field.is_repeated()) {
            return "must be an array";
        }
        switch (field.cpp_type()) {
            case FieldDescriptor::CPPTYPE_MESSAGE:
                return "must be an object";
            case FieldDescriptor::CPPTYPE_BOOL:
                return "must be true or false";
            case FieldDescriptor::CPPTYPE_STRING:
                return "must be a text";
            case FieldDescriptor::CPPTYPE_ENUM:
                return "must be one of " + value_names(*field.enum_type());
            case FieldDescriptor::CPPTYPE_UINT32:
                return "must be a whole number, 0..4294967295";
            default:
                return "must be a number";
        }
    }

    bool scalar(const Json& value) {
        const FieldDescriptor* const field = levels_.empty() ? nullptr : current();
        if (field == nullptr) {
            return true;
        }
        if (wants_array() || field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ||
            !has_type(value, *field)) {
            return complain(wanted(*field));
        }
        return choose(*field) && (!is_number(*field) || fits(value, *field));
    }

    /// Of the fields of a oneof, one may have a value.
    bool choose(const FieldDescriptor& field) {
        const auto* const oneof = field.real_containing_oneof();
        Level& level = levels_.back();
        if (oneof == nullptr || level.type == nullptr) {
            return true;
        }
        const auto* const other = level.chosen.emplace(oneof, &field).first->second;
        if (other == &field) {
            return true;
        }
        found_.problem = (level.path.empty() ? "invalid value" : level.path) + ": " +
                         other->json_name() + " and " + field.json_name() + " exclude each other";
        return false;
    }

    static bool is_number(const FieldDescriptor& field) {
        return field.cpp_type() == FieldDescriptor::CPPTYPE_FLOAT ||
               field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
    }

    bool has_type(const Json& value, const FieldDescriptor& field) {
        switch (field.cpp_type()) {
            case FieldDescriptor::CPPTYPE_BOOL:
                return value.is_boolean() || value == "true" || value == "false";
            case FieldDescriptor::CPPTYPE_STRING:
                return value.is_string();
            case FieldDescriptor::CPPTYPE_ENUM:
                return check_enum(value, field);
            case FieldDescriptor::CPPTYPE_UINT32:
                return fits_uint32(number_of(value));
            default:
                return value.is_number() || value.is_string();
        }
    }

    /// A float holds it: protobuf refuses others in words of its own.
    bool fits(const Json& value, const FieldDescriptor& field) {
        const double number = number_of(value);
        if (!std::isfinite(number)) {
            const bool named = value == "NaN" || value == "Infinity" || value == "-Infinity";
            return complain(named ? "must be a finite number" : wanted(field));
        }
        const bool single = field.cpp_type() == FieldDescriptor::CPPTYPE_FLOAT;
        return !single || std::abs(number) <= std::numeric_limits<float>::max() ||
               complain("must be at most 1e9");
    }

    bool check_enum(const Json& value, const FieldDescriptor& field) {
        if (!value.is_string()) {
            const double number = number_of(value);
            if (!(std::abs(number) <= INT32_MAX && number == std::floor(number))) {
                return false;
            }
            if (field.enum_type()->FindValueByNumber(static_cast<int>(number)) == nullptr) {
                note_unknown(unknown_value(path(), std::to_string(static_cast<int>(number)),
                                           *field.enum_type()));
            }
            return true;
        }
        const auto& name = value.get_ref<const std::string&>();
        if (field.enum_type()->FindValueByName(name) == nullptr) {
            note_unknown(
                unknown_value(path(), '"' + short_excerpt(name) + '"', *field.enum_type()));
        }
        return true;
    }

    JsonFields& found_;
    const Descriptor* root_;
    const FieldDescriptor* field_ = nullptr;  ///< of the last key
    std::vector<Level> levels_;
};

std::string unknown_in_part(const google::protobuf::Message& message, const std::string& path);

/// Unknown enum numbers of one field, and whatever is unknown within its messages.
std::string unknown_in_field(const google::protobuf::Message& message, const FieldDescriptor& field,
                             const std::string& path) {
    const auto* const reflection = message.GetReflection();
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !field.is_repeated()) {
        return unknown_in_part(reflection->GetMessage(message, &field), path);
    }
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_ENUM) {
        return {};
    }
    const int count = field.is_repeated() ? reflection->FieldSize(message, &field) : 1;
    for (int i = 0; i < count; ++i) {
        const int number = field.is_repeated()
                               ? reflection->GetRepeatedEnumValue(message, &field, i)
                               : reflection->GetEnumValue(message, &field);
        if (field.enum_type()->FindValueByNumber(number) == nullptr) {
            return unknown_value(path, std::to_string(number), *field.enum_type());
        }
    }
    return {};
}

std::string unknown_in_part(const google::protobuf::Message& message, const std::string& path) {
    const auto* const reflection = message.GetReflection();
    const auto& unknown = reflection->GetUnknownFields(message);
    if (!path.empty() && !unknown.empty()) {
        return path + ": unknown field number " + std::to_string(unknown.field(0).number());
    }
    std::vector<const FieldDescriptor*> fields;
    reflection->ListFields(message, &fields);
    for (const auto* field : fields) {
        std::string found = unknown_in_field(message, *field, joined(path, field->json_name()));
        if (!found.empty()) {
            return found;
        }
    }
    return {};
}

}  // namespace

JsonFields check_json_fields(std::string_view json, const Descriptor& type) {
    JsonFields found;
    FieldWalk walk(found, type);
    static_cast<void>(Json::sax_parse(json.begin(), json.end(), &walk));
    return found;
}

std::string unknown_in_binary(const google::protobuf::Message& message) {
    return unknown_in_part(message, "");
}

std::string short_excerpt(std::string_view text) {
    text = text.substr(0, text.find('\n'));
    if (text.size() > kMaxExcerpt) {
        std::size_t end = kMaxExcerpt;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
            --end;
        }
        text = text.substr(0, end);
    }
    return std::string(text);
}

}  // namespace raybundle
