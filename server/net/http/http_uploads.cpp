// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_uploads.h"

#include <fmt/core.h>
#include <libwebsockets.h>

#include <string>

namespace raybundle {

std::optional<HttpResponse> HttpUploads::begin(lws* connection, const UploadRequest& request) {
    const UploadLimits limits{state_.settings.max_upload_bytes, running_.size()};
    auto refusal = refuse_upload(request, limits, state_.gate.access()->origins);
    if (refusal) {
        return refusal;
    }
    auto upload = state_.begin_upload(std::string(uploaded_name(request.path)));
    if (!upload) {
        return text_response({507, "The server cannot store it"});
    }
    running_[connection] = {std::move(upload), *request.length};
    lws_set_timer_usecs(connection, static_cast<lws_usec_t>(1e6 * state_.settings.max_upload_s));
    return std::nullopt;
}

std::optional<HttpResponse> HttpUploads::write(lws* connection, std::string_view bytes) {
    const auto found = running_.find(connection);
    if (found == running_.end()) {
        return std::nullopt;
    }
    Running& running = found->second;
    if (bytes.size() <= running.missing && running.upload->write(bytes)) {
        running.missing -= bytes.size();
        return std::nullopt;
    }
    running_.erase(found);
    return text_response({507, "The server cannot store it"});
}

std::optional<HttpResponse> HttpUploads::expire(lws* connection) {
    const auto found = running_.find(connection);
    if (found == running_.end() || found->second.missing == 0) {
        return std::nullopt;
    }
    const std::uint64_t missing = found->second.missing;
    running_.erase(found);
    return last_response(
        text_response({408, fmt::format("The upload took longer than {} s (maxUploadSeconds); "
                                        "{} bytes were missing",
                                        state_.settings.max_upload_s, missing)}));
}

void HttpUploads::complete(lws* connection) {
    const auto found = running_.find(connection);
    if (found == running_.end() || found->second.missing > 0) {
        return;
    }
    found->second.upload->finish(
        [answer = found->second.answer, wake = wake_](UploadResult result) {
            {
                const std::lock_guard lock(answer->mutex);
                answer->result = std::move(result);
            }
            wake();
        });
}

std::vector<std::pair<lws*, HttpResponse>> HttpUploads::finished() {
    std::vector<std::pair<lws*, HttpResponse>> answers;
    for (auto entry = running_.begin(); entry != running_.end();) {
        std::optional<UploadResult> result;
        {
            const std::lock_guard lock(entry->second.answer->mutex);
            result = entry->second.answer->result;
        }
        if (result) {
            answers.emplace_back(entry->first, text_response(*result));
            entry = running_.erase(entry);
        } else {
            ++entry;
        }
    }
    return answers;
}

}  // namespace raybundle
