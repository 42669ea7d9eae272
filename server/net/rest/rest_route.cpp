// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_route.h"

namespace raybundle {
namespace {

std::vector<std::string_view> parts_of(std::string_view path) {
    std::vector<std::string_view> parts;
    while (!path.empty()) {
        path.remove_prefix(1);  // the slash
        const std::size_t end = path.find('/');
        parts.push_back(path.substr(0, end));
        path = end == std::string_view::npos ? std::string_view() : path.substr(end);
    }
    return parts;
}

bool is_field(std::string_view part) {
    return part.starts_with('{');
}

std::string field_of(std::string_view part) {
    return std::string(part.substr(1, part.size() - 2));
}

/// What stands for the fields of a template; nothing where the path is not of that form.
std::optional<std::vector<std::pair<std::string, std::string>>> fields_of(std::string_view form,
                                                                          std::string_view path) {
    const auto forms = parts_of(form);
    const auto parts = parts_of(path);
    if (forms.size() != parts.size()) {
        return std::nullopt;
    }
    std::vector<std::pair<std::string, std::string>> fields;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (is_field(forms[i]) && !parts[i].empty()) {
            fields.emplace_back(field_of(forms[i]), parts[i]);
        } else if (forms[i] != parts[i]) {
            return std::nullopt;
        }
    }
    return fields;
}

}  // namespace

std::vector<std::string> path_fields(std::string_view path) {
    std::vector<std::string> fields;
    for (const std::string_view part : parts_of(path)) {
        if (is_field(part)) {
            fields.push_back(field_of(part));
        }
    }
    return fields;
}

RestMatch match_route(HttpMethod method, std::string_view path) {
    const HttpMethod wanted = method == HttpMethod::head ? HttpMethod::get : method;
    RestMatch match;
    for (const RestRoute& route : rest_routes()) {
        auto fields = fields_of(route.path, path);
        if (!fields) {
            continue;
        }
        match.allowed +=
            (match.allowed.empty() ? "" : ", ") + std::string(method_name(route.method));
        if (route.method == wanted) {
            match.route = &route;
            match.fields = std::move(*fields);
        }
    }
    return match;
}

std::string_view method_name(HttpMethod method) {
    switch (method) {
        case HttpMethod::get:
            return "GET";
        case HttpMethod::head:
            return "HEAD";
        case HttpMethod::put:
            return "PUT";
        case HttpMethod::post:
            return "POST";
        case HttpMethod::patch:
            return "PATCH";
        case HttpMethod::remove:
            return "DELETE";
        default:
            return "";
    }
}

}  // namespace raybundle
