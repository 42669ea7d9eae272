// SPDX-License-Identifier: Apache-2.0
#include "projects/http_head.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace raybundle {
namespace {

constexpr std::string_view projects_folder = "/p/";
constexpr std::string_view line_end = "\r\n";
constexpr std::string_view forwarded_for = "X-Forwarded-For";

bool same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
        return std::tolower(x) == std::tolower(y);
    });
}

bool is_one_of(std::string_view name, const auto& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view other) { return same_word(name, other); });
}

/// A character of a token (RFC 9110, 5.6.2).
bool is_token_character(unsigned char c) {
    constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
    return c < 0x80 && (std::isalnum(c) != 0 || marks.find(static_cast<char>(c)) != marks.npos);
}

bool is_token(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_token_character);
}

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    return text.substr(0, text.find_last_not_of(" \t") + 1);
}

/// Whether a list between commas has a word.
bool lists(std::string_view list, std::string_view word) {
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        if (same_word(trimmed(list.substr(0, comma)), word)) {
            return true;
        }
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return false;
}

std::optional<std::uint64_t> parse_length(std::string_view text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    return !text.empty() && last == end && error == std::errc() ? std::optional(value)
                                                                : std::nullopt;
}

/// No control character but tabs.
bool is_clean(std::string_view value) {
    return std::all_of(value.begin(), value.end(),
                       [](unsigned char c) { return (c >= 0x20 && c != 0x7F) || c == '\t'; });
}

/// "name: value". False where it is none, or continues the line before.
bool add_header(std::string_view line, HttpHeaders& headers) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) {
        return false;
    }
    const std::string_view value = trimmed(line.substr(colon + 1));
    headers.emplace_back(line.substr(0, colon), value);
    return is_clean(value);
}

/// Cuts off and returns the next line, without its end.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find(line_end), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + line_end.size(), text.size()));
    return line;
}

/// Lines until the empty one. False where one is no header.
bool read_headers(std::string_view text, HttpHeaders& headers) {
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        if (line.empty()) {
            return text.empty();
        }
        if (!add_header(line, headers)) {
            return false;
        }
    }
    return false;
}

std::size_t count_of(const HttpHeaders& headers, std::string_view name) {
    return static_cast<std::size_t>(
        std::count_if(headers.begin(), headers.end(),
                      [&](const auto& header) { return same_word(header.first, name); }));
}

/// Path and query on this server, in visible ASCII.
bool is_target(std::string_view target) {
    return target.starts_with('/') &&
           std::all_of(target.begin(), target.end(),
                       [](unsigned char c) { return c > 0x20 && c < 0x7F && c != '#'; });
}

std::optional<HeadProblem> read_line(std::string_view line, RequestHead& head) {
    const std::size_t first = line.find(' ');
    const std::size_t last = line.rfind(' ');
    if (first == std::string_view::npos || last <= first) {
        return HeadProblem{400, "the request line is none of HTTP"};
    }
    const std::string_view version = line.substr(last + 1);
    head.method = line.substr(0, first);
    head.target = line.substr(first + 1, last - first - 1);
    if (version != "HTTP/1.1" && version != "HTTP/1.0") {
        return HeadProblem{505, "only HTTP/1.1 is spoken here"};
    }
    if (!is_token(head.method) || !is_target(head.target)) {
        return HeadProblem{400, "the request line is none of HTTP"};
    }
    if (version == "HTTP/1.1" && count_of(head.headers, "Host") == 0) {
        return HeadProblem{400, "needs the header Host"};
    }
    return std::nullopt;
}

/// How much follows the head.
std::optional<HeadProblem> read_body(RequestHead& head) {
    if (count_of(head.headers, "Transfer-Encoding") > 0) {
        return HeadProblem{411, "needs Content-Length in place of Transfer-Encoding"};
    }
    if (count_of(head.headers, "Content-Length") > 0) {
        const auto length = parse_length(header_of(head.headers, "Content-Length"));
        if (!length) {
            return HeadProblem{400, "Content-Length: must be a number"};
        }
        head.body_bytes = *length;
    }
    head.upgrade = head.method == "GET" && head.body_bytes == 0 &&
                   same_word(header_of(head.headers, "Upgrade"), "websocket") &&
                   lists(header_of(head.headers, "Connection"), "upgrade");
    head.expects_continue =
        head.body_bytes > 0 && same_word(header_of(head.headers, "Expect"), "100-continue");
    return std::nullopt;
}

void append(std::string& text, std::string_view name, std::string_view value) {
    text.append(name).append(": ").append(value).append(line_end);
}

}  // namespace

std::string_view header_of(const HttpHeaders& headers, std::string_view name) {
    const auto found = std::find_if(headers.begin(), headers.end(), [&](const auto& header) {
        return same_word(header.first, name);
    });
    return found == headers.end() ? std::string_view() : std::string_view(found->second);
}

std::variant<RequestHead, HeadProblem> parse_request_head(std::string_view text) {
    RequestHead head;
    const std::string_view line = take_line(text);
    if (!read_headers(text, head.headers)) {
        return HeadProblem{400, "a header is none of HTTP"};
    }
    for (const char* name : {"Host", "Content-Length", "Upgrade", "Expect", "Authorization"}) {
        if (count_of(head.headers, name) > 1) {
            return HeadProblem{400, std::string(name) + ": is there twice"};
        }
    }
    if (auto problem = read_line(line, head)) {
        return std::move(*problem);
    }
    if (auto problem = read_body(head)) {
        return std::move(*problem);
    }
    return head;
}

std::optional<ProjectTarget> project_target(std::string_view target) {
    if (!target.starts_with(projects_folder)) {
        return std::nullopt;
    }
    target.remove_prefix(projects_folder.size());
    const std::size_t end = std::min(target.find_first_of("/?"), target.size());
    ProjectTarget result{std::string(target.substr(0, end)), ""};
    if (end < target.size() && target[end] == '/') {
        result.target = target.substr(end);
    }
    return result;
}

bool is_project_name(std::string_view name) {
    constexpr std::size_t max_letters = 64;
    const auto is_alphanumeric = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0;
    };
    return !name.empty() && name.size() <= max_letters && is_alphanumeric(name.front()) &&
           std::all_of(name.begin(), name.end(), [&](char c) {
               return is_alphanumeric(c) || c == '-' || c == '_' || c == '.';
           });
}

std::string forwarded_head(const RequestHead& head, std::string_view target,
                           std::string_view peer) {
    // Of this connection only, or said anew below.
    constexpr std::array<std::string_view, 9> own{"Connection", "Keep-Alive",  "Proxy-Connection",
                                                  "TE",         "Trailer",     "Upgrade",
                                                  "Expect",     forwarded_for, "HTTP2-Settings"};
    std::string text = head.method + " " + std::string(target) + " HTTP/1.1\r\n";
    std::string chain;
    for (const auto& [name, value] : head.headers) {
        if (same_word(name, forwarded_for)) {
            chain += value + ", ";
        } else if (!is_one_of(name, own)) {
            append(text, name, value);
        }
    }
    append(text, forwarded_for, chain + std::string(peer));
    if (head.upgrade) {
        append(text, "Upgrade", "websocket");
    }
    append(text, "Connection", head.upgrade ? "Upgrade" : "close");
    return text + std::string(line_end);
}

std::optional<ResponseHead> forwarded_response(std::string_view text, const RequestHead& request,
                                               std::string_view prefix) {
    const std::string_view line = take_line(text);
    constexpr std::size_t status_at = 9;  // behind "HTTP/1.1 "
    HttpHeaders headers;
    const auto status = parse_length(line.substr(std::min(status_at, line.size())).substr(0, 3));
    if (!line.starts_with("HTTP/1.") || !status || !read_headers(text, headers)) {
        return std::nullopt;
    }
    ResponseHead head;
    head.status = static_cast<int>(*status);
    head.text = std::string(line) + std::string(line_end);
    const bool switches = head.status == 101;
    for (const auto& [name, value] : headers) {
        const bool moved = same_word(name, "Location") && value.starts_with('/');
        if (switches || !(same_word(name, "Connection") || same_word(name, "Keep-Alive"))) {
            append(head.text, name, moved ? std::string(prefix) + value : value);
        }
    }
    if (!switches && head.status >= 200) {
        append(head.text, "Connection", "close");
    }
    head.text += line_end;
    if (request.method == "HEAD" || head.status == 204 || head.status == 304) {
        head.body_bytes = 0;
    } else if (!switches) {
        head.body_bytes = parse_length(header_of(headers, "Content-Length"));
    }
    return head;
}

}  // namespace raybundle
