// SPDX-License-Identifier: Apache-2.0
#include "net/rest/openapi.h"

#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "embedded_file.h"
#include "net/rest/json_schema.h"
#include "net/rest/rest_route.h"

namespace raybundle {
namespace {

namespace pb = google::protobuf;
using Json = SchemaJson;

/// The .proto as it was compiled in, which has the comments that compiled messages have not.
class Declarations {
  public:
    Declarations() {
        const std::string_view bytes = protocol_files().front().contents;
        pb::FileDescriptorSet files;
        if (!files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) ||
            pool_.BuildFile(files.file(0)) == nullptr) {
            throw std::logic_error("the declarations of the protocol cannot be read");
        }
    }

    [[nodiscard]] const pb::Descriptor& message(const std::string& name) const {
        return *pool_.FindMessageTypeByName("raybundle.v1." + name);
    }

  private:
    pb::DescriptorPool pool_;
};

const pb::FieldDescriptor& field_of(const pb::Descriptor& type, std::string_view json_name) {
    return *type.FindFieldByCamelcaseName(std::string(json_name));
}

Json json_content(Json schema) {
    return {{"application/json", {{"schema", std::move(schema)}}}};
}

class Writer {
  public:
    Json document() {
        Json paths = Json::object();
        for (const RestRoute& route : rest_routes()) {
            std::string method(method_name(route.method));
            std::transform(method.begin(), method.end(), method.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            paths[std::string(route.path)][method] = operation(route);
        }
        const Json problem = schemas_.reference(types_.message("Problem"));
        Json components{{"schemas", schemas_.all()},
                        {"responses",
                         {{"Problem",
                           {{"description", "Why not (RFC 9457)."},
                            {"content", {{"application/problem+json", {{"schema", problem}}}}}}}}},
                        {"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}}};
        return {{"openapi", "3.1.0"},
                {"info", {{"title", "Raybundle"}, {"version", RAYBUNDLE_VERSION}}},
                {"security", Json::array({{{"token", Json::array()}}, Json::object()})},
                {"paths", std::move(paths)},
                {"components", std::move(components)}};
    }

  private:
    Json operation(const RestRoute& route) {
        Json result{{"operationId", route.operation}, {"summary", route.summary}};
        if (Json parameters = parameters_of(route); !parameters.empty()) {
            result["parameters"] = std::move(parameters);
        }
        if (route.body != RestBody::none) {
            result["requestBody"] = {{"required", true}, {"content", json_content(body_of(route))}};
        }
        Json responses{{std::to_string(route.status),
                        {{"description", "Done."}, {"content", json_content(answer_of(route))}}}};
        const bool asks = route.source == RestSource::requests;
        if (asks ? route.method == HttpMethod::get : route.method != HttpMethod::get) {
            responses["202"] = {
                {"description", "Not done yet: ask again at Location."},
                {"content", json_content(schemas_.reference(types_.message("RequestState")))}};
        }
        responses["default"] = {{"$ref", "#/components/responses/Problem"}};
        result["responses"] = std::move(responses);
        return result;
    }

    Json parameters_of(const RestRoute& route) {
        Json result = Json::array();
        for (const std::string& name : path_fields(route.path)) {
            result.push_back(
                {{"name", name},
                 {"in", "path"},
                 {"required", true},
                 {"schema", {{"type", is_number(route, name) ? "integer" : "string"}}}});
        }
        if (route.source == RestSource::session) {
            result.push_back({{"name", "wait"},
                              {"in", "query"},
                              {"description", "Seconds to wait for the answer."},
                              {"schema",
                               {{"type", "number"},
                                {"minimum", 0},
                                {"maximum", 30},
                                {"default", route.wait_s}}}});
            result.push_back({{"name", "name"},
                              {"in", "query"},
                              {"description", "That others see, unless the token has one."},
                              {"schema", {{"type", "string"}, {"maxLength", 64}}}});
        }
        if (route.source == RestSource::session && route.method != HttpMethod::get) {
            result.push_back({{"name", "traceparent"},
                              {"in", "header"},
                              {"description", "W3C Trace Context: the trace that it is a part of."},
                              {"schema", {{"type", "string"}, {"maxLength", 128}}}});
        }
        return result;
    }

    [[nodiscard]] bool is_number(const RestRoute& route, const std::string& name) const {
        if (route.source != RestSource::session) {
            return false;
        }
        const bool element = route.messages.front() == "hello";
        const pb::Descriptor& type =
            element
                ? *part(route.answers.front()).message_type()
                : *field_of(types_.message("ClientMessage"), route.messages.front()).message_type();
        return field_of(type, element ? route.key : std::string_view(name)).type() ==
               pb::FieldDescriptor::TYPE_UINT32;
    }

    /// The field of ServerMessage at "welcome.scene.lights".
    [[nodiscard]] const pb::FieldDescriptor& part(std::string_view path) const {
        const pb::Descriptor* type = &types_.message("ServerMessage");
        for (;;) {
            const std::size_t dot = path.find('.');
            const pb::FieldDescriptor& field = field_of(*type, path.substr(0, dot));
            if (dot == std::string_view::npos) {
                return field;
            }
            type = field.message_type();
            path = path.substr(dot + 1);
        }
    }

    Json body_of(const RestRoute& route) {
        const pb::Descriptor& client = types_.message("ClientMessage");
        if (route.body == RestBody::message) {
            return schemas_.reference(*field_of(client, route.messages.front()).message_type());
        }
        Json properties = Json::object();
        for (const std::string_view name : route.messages) {
            properties[std::string(name)] =
                schemas_.reference(*field_of(client, name).message_type());
        }
        if (route.body == RestBody::sequence) {
            return {{"type", "object"},
                    {"properties", std::move(properties)},
                    {"required", {route.messages.back()}},
                    {"additionalProperties", false}};
        }
        Json one_of = Json::array();
        for (const std::string_view name : route.messages) {
            one_of.push_back({{"required", {name}}});
        }
        properties["requestKey"] = schemas_.field(field_of(client, "requestKey"));
        return {{"type", "object"},
                {"properties", std::move(properties)},
                {"oneOf", std::move(one_of)},
                {"additionalProperties", false}};
    }

    Json answer_of(const RestRoute& route) {
        if (route.source == RestSource::photometry) {
            return {{"type", "array"}, {"items", {{"type", "object"}}}};
        }
        if (route.source == RestSource::requests) {
            return route.method == HttpMethod::get
                       ? Json{{"description", "As the request's own answer."}}
                       : schemas_.reference(types_.message("RequestState"));
        }
        if (route.answers.size() == 1) {
            const pb::FieldDescriptor& field = part(route.answers.front());
            const bool element = !route.key.empty();
            return element ? schemas_.reference(*field.message_type()) : schemas_.field(field);
        }
        Json properties = Json::object();
        for (const std::string_view name : route.answers) {
            properties[std::string(name)] = schemas_.field(part(name));
        }
        return {{"type", "object"}, {"properties", std::move(properties)}};
    }

    Declarations types_;
    JsonSchemas schemas_;
};

}  // namespace

std::shared_ptr<const std::string> openapi_document() {
    static const auto document =
        std::make_shared<const std::string>(Writer().document().dump(1) + "\n");
    return document;
}

}  // namespace raybundle
