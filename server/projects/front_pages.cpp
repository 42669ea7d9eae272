// SPDX-License-Identifier: Apache-2.0
#include "projects/front_pages.h"

#include <fmt/core.h>

#include <algorithm>

#include "net/rest/rest_problem.h"
#include "projects/project_list.h"

namespace raybundle {
namespace {

std::string_view phrase_of(int status) {
    switch (status) {
        case 200:
            return "OK";
        case 308:
            return "Permanent Redirect";
        case 401:
            return "Unauthorized";
        case 404:
            return "Not Found";
        case 502:
            return "Bad Gateway";
        case 503:
            return "Service Unavailable";
        default:
            return "Refused";
    }
}

std::string bytes_of(const HttpResponse& response, std::string_view method) {
    std::string text =
        fmt::format("HTTP/1.1 {} {}\r\ncontent-type: {}\r\ncontent-length: {}\r\n", response.status,
                    phrase_of(response.status), response.content_type, response.content().size());
    for (const auto& [name, value] : headers_of(last_response(response))) {
        text += fmt::format("{} {}\r\n", name, value);
    }
    return text + "\r\n" + (method == "HEAD" ? "" : response.content());
}

HttpResponse plain(int status, std::string text) {
    HttpResponse response;
    response.status = status;
    response.body = std::move(text);
    return response;
}

std::string_view token_of(std::string_view authorization) {
    constexpr std::string_view scheme = "Bearer ";
    return authorization.starts_with(scheme) ? authorization.substr(scheme.size())
                                             : std::string_view();
}

std::string_view path_of(std::string_view target) {
    return target.substr(0, target.find('?'));
}

/// What is never said by a stranger: it needs no escaping.
std::string page(const std::string& text, std::string_view target, bool again) {
    const auto slashes = std::count(target.begin(), target.end(), '/');
    std::string up;
    for (auto i = slashes; i > 1; --i) {
        up += "../";
    }
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"dark light\">\n{}<title>Raybundle</title>\n"
        "<link rel=\"stylesheet\" href=\"{}style/style.css\">\n"
        "<link rel=\"stylesheet\" href=\"{}projects/projects.css\">\n</head>\n"
        "<body class=\"projects\">\n<main class=\"refused\">\n<h1>Not available</h1>\n<p>{}.</p>\n"
        "<p>{}<a href=\"{}./\">All projects</a></p>\n</main>\n</body>\n</html>\n",
        again ? "<meta http-equiv=\"refresh\" content=\"3\">\n" : "", up, up, text,
        again ? "This page tries again by itself. " : "", up);
}

HttpResponse file_response(std::string_view path) {
    HttpContent content;
    content.files = project_files();
    return http_response(HttpMethod::get, path == "/" ? "/projects/index.html" : path, content);
}

}  // namespace

std::string FrontPages::answer(const RequestHead& request, FrontTime now) const {
    if (request.method != "GET" && request.method != "HEAD") {
        return bytes_of(plain(405, "Only GET and HEAD\n"), request.method);
    }
    return bytes_of(response(request, now), request.method);
}

HttpResponse FrontPages::response(const RequestHead& request, FrontTime now) const {
    const std::string_view path = path_of(request.target);
    if (path == "/healthz" || path == "/healthz/live" || path == "/healthz/ready") {
        return plain(200, "ok\n");
    }
    constexpr std::string_view pictures = "/pictures/";
    const bool data = path == "/projects.json" || path == "/metrics" || path.starts_with(pictures);
    if (!data) {
        return file_response(path);
    }
    const bool known =
        tokens_.role_of(token_digest(token_of(header_of(request.headers, "Authorization"))))
            .has_value();
    if (!known) {
        return problem(401, "needs the header Authorization: Bearer TOKEN");
    }
    const bool trusted = !tokens_.empty();
    if (path == "/metrics") {
        HttpResponse figures = plain(200, projects_metrics(projects_, connections_));
        figures.content_type = "text/plain; version=0.0.4; charset=utf-8";
        return figures;
    }
    if (path == "/projects.json") {
        HttpResponse list = plain(200, projects_json(projects_, now, trusted));
        list.content_type = "application/json";
        return list;
    }
    return picture(path.substr(pictures.size()), trusted);
}

HttpResponse FrontPages::picture(std::string_view file, bool trusted) const {
    constexpr std::string_view suffix = ".png";
    const auto project = file.ends_with(suffix)
                             ? projects_.find(file.substr(0, file.size() - suffix.size()))
                             : nullptr;
    const bool open = project && (trusted || !project->settings().secret());
    if (!open || project->picture().empty()) {
        return plain(404, "Not found\n");
    }
    HttpResponse response = plain(200, project->picture());
    response.content_type = "image/png";
    return response;
}

std::string FrontPages::answer_asleep(const RequestHead& request, std::string_view target) {
    const std::string_view path = path_of(target);
    if (path == "/healthz" || path.starts_with("/healthz/")) {
        return bytes_of(plain(200, "asleep\n"), request.method);
    }
    return path == "/metrics"
               ? bytes_of(plain(503, "asleep; /metrics of the whole server has it\n"),
                          request.method)
               : "";
}

std::string FrontPages::refuse(const RequestHead& request, int status, const std::string& text) {
    if (header_of(request.headers, "Accept").find("text/html") == std::string_view::npos) {
        return bytes_of(problem(status, text), request.method);
    }
    const bool again = status == 502 || status == 503;
    HttpResponse response = plain(status, page(text, path_of(request.target), again));
    response.content_type = "text/html; charset=utf-8";
    return bytes_of(response, request.method);
}

std::string FrontPages::redirect(const RequestHead& request, const std::string& location) {
    HttpResponse response = plain(308, "Moved\n");
    response.headers.emplace_back("location:", location);
    return bytes_of(response, request.method);
}

}  // namespace raybundle
