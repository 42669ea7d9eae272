// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_documents.h"

#include <libwebsockets.h>

#include <algorithm>

namespace raybundle {
namespace {

constexpr const char* retry_after_s = "5";  // most documents take less

DocumentResult stopping_result() {
    return {503, "text/plain; charset=utf-8", "The server is stopping\n", {}};
}

/// Printable ASCII: what is not is escaped with "%", as in a URI.
std::string header_text(const std::string& text) {
    constexpr std::size_t longest = 2000;
    constexpr const char* digits = "0123456789ABCDEF";
    std::size_t length = std::min(text.size(), longest);
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) {
        --length;  // whole characters alone
    }
    std::string result;
    for (const char c : text.substr(0, length)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x20 && byte < 0x7f && c != '%') {
            result += c;
        } else {
            result += {'%', digits[byte >> 4U], digits[byte & 15U]};
        }
    }
    return result;
}

HttpResponse document_response(DocumentResult result) {
    HttpResponse response;
    response.status = result.status;
    response.content_type = result.content_type;
    response.body = std::move(result.body);
    // A document of its own: it has its style in it, and no scripts.
    response.headers.emplace_back("content-security-policy:",
                                  "default-src 'none'; style-src 'unsafe-inline'; img-src data:; "
                                  "base-uri 'none'; form-action 'none'; frame-ancestors 'self'");
    if (result.status == 503) {
        response.headers.emplace_back("retry-after:", retry_after_s);
    }
    if (!result.notes.empty()) {
        response.headers.emplace_back("x-raybundle-notes:", header_text(result.notes));
    }
    if (!result.file_name.empty()) {
        response.headers.emplace_back("content-disposition:",
                                      "inline; filename=\"" + result.file_name + "\"");
    }
    return response;
}

}  // namespace

std::optional<HttpResponse> HttpDocuments::begin(lws* connection, DocumentRequest request,
                                                 std::optional<std::uint64_t> length) {
    const bool put = request.put;
    if (put && (!length || *length == 0)) {
        return document_response(
            {411, "text/plain; charset=utf-8", "Needs Content-Length, not 0\n", {}});
    }
    if (put && *length > most_bytes) {
        return last_response(
            document_response({413, "text/plain; charset=utf-8", "Larger than 16 MiB\n", {}}));
    }
    if (stopping_) {
        return document_response(stopping_result());
    }
    if (running_.size() >= most_running) {
        return document_response({503,
                                  "text/plain; charset=utf-8",
                                  "Other documents are being made; try again later\n",
                                  {}});
    }
    Running& running = running_[connection];
    running = {std::move(request), put ? *length : 0};
    if (put) {
        lws_set_timer_usecs(connection,
                            static_cast<lws_usec_t>(1e6 * state_.settings.max_upload_s));
    } else {
        ask(running);
    }
    return std::nullopt;
}

void HttpDocuments::ask(Running& running) {
    running.asked = true;
    state_.make_document(std::move(running.request),
                         [answer = running.answer, wake = wake_](DocumentResult result) {
                             {
                                 const std::lock_guard lock(answer->mutex);
                                 answer->result = std::move(result);
                             }
                             wake();
                         });
}

bool HttpDocuments::takes_body(lws* connection) const {
    return running_.contains(connection);
}

void HttpDocuments::write(lws* connection, std::string_view bytes) {
    Running& running = running_.at(connection);
    const std::size_t taken = std::min<std::uint64_t>(bytes.size(), running.missing);
    running.request.body += bytes.substr(0, taken);
    running.missing -= taken;
}

std::optional<HttpResponse> HttpDocuments::expire(lws* connection) {
    const auto found = running_.find(connection);
    if (found == running_.end() || found->second.asked) {
        return std::nullopt;
    }
    running_.erase(found);
    return last_response(document_response(
        {408, "text/plain; charset=utf-8", "The body took too long (maxUploadSeconds)\n", {}}));
}

void HttpDocuments::complete(lws* connection) {
    Running& running = running_.at(connection);
    if (running.missing == 0 && !running.asked) {
        ask(running);
    }
}

void HttpDocuments::say_goodbye() {
    stopping_ = true;
    for (auto& [connection, running] : running_) {
        const std::lock_guard lock(running.answer->mutex);
        if (!running.answer->result) {
            running.answer->result = stopping_result();
        }
    }
}

std::vector<std::pair<lws*, HttpResponse>> HttpDocuments::finished() {
    std::vector<std::pair<lws*, HttpResponse>> answers;
    for (auto entry = running_.begin(); entry != running_.end();) {
        std::optional<DocumentResult> result;
        {
            const std::lock_guard lock(entry->second.answer->mutex);
            result = entry->second.answer->result;
        }
        if (result) {
            answers.emplace_back(entry->first, document_response(std::move(*result)));
            entry = running_.erase(entry);
        } else {
            ++entry;
        }
    }
    return answers;
}

}  // namespace raybundle
