// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_problem.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace raybundle {
namespace {

/// Reason phrases of RFC 9110, and of RFC 6585 for 429.
const char* title_of(int status) {
    switch (status) {
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 408:
            return "Request Timeout";
        case 409:
            return "Conflict";
        case 411:
            return "Length Required";
        case 413:
            return "Content Too Large";
        case 415:
            return "Unsupported Media Type";
        case 429:
            return "Too Many Requests";
        case 501:
            return "Not Implemented";
        case 503:
            return "Service Unavailable";
        default:
            return "Internal Server Error";
    }
}

}  // namespace

int http_status(v1::Error::Code code) {
    switch (code) {
        case v1::Error::INVALID_ARGUMENT:
            return 400;
        case v1::Error::UNAUTHENTICATED:
            return 401;
        case v1::Error::PERMISSION_DENIED:
            return 403;
        case v1::Error::NOT_FOUND:
            return 404;
        case v1::Error::RESOURCE_EXHAUSTED:
            return 429;
        case v1::Error::UNIMPLEMENTED:
            return 501;
        case v1::Error::CANCELLED:
            return 409;
        case v1::Error::UNAVAILABLE:
            return 503;
        default:
            return 500;
    }
}

HttpResponse problem(int status, std::string detail, v1::Error::Code code) {
    nlohmann::ordered_json body{{"type", "about:blank"},
                                {"title", title_of(status)},
                                {"status", status},
                                {"detail", std::move(detail)}};
    if (code != v1::Error::CODE_UNSPECIFIED) {
        body["code"] = v1::Error::Code_Name(code);
    }
    HttpResponse response;
    response.status = status;
    response.content_type = "application/problem+json";
    // What a client has sent comes back in texts, and need not be UTF-8.
    response.body =
        body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    return response;
}

HttpResponse problem(v1::Error::Code code, std::string detail) {
    return problem(http_status(code), std::move(detail), code);
}

}  // namespace raybundle
