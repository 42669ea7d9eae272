// SPDX-License-Identifier: Apache-2.0
#include "net/http/upload_check.h"

#include <algorithm>
#include <charconv>

#include "net/http/scene_name.h"

namespace raybundle {
namespace {

constexpr std::uint32_t kMaxPhotometryBytes = 16U << 20U;  ///< that are read of such a file

}  // namespace

std::string_view uploaded_name(std::string_view path) {
    const std::string_view scene = scene_of_path(path);
    return scene.empty() ? photometry_of_path(path) : scene;
}

std::optional<HttpResponse> refuse_upload(const UploadRequest& request, const UploadLimits& limits,
                                          const OriginRules& origins) {
    const auto refuse = [](int status, const std::string& text) {
        return text_response({status, text});
    };
    const std::string_view scene = scene_of_path(request.path);
    const std::string_view name = uploaded_name(request.path);
    const std::uint64_t most_bytes =
        scene.empty() ? std::min(limits.max_bytes, kMaxPhotometryBytes) : limits.max_bytes;
    if (name.empty() || limits.max_bytes == 0) {
        return refuse(405, "Only GET and HEAD");
    }
    if (!origin_allowed(request.origin, request.host, origins)) {
        return refuse(403, "A page of another origin may not upload");
    }
    if (!request.role) {
        return refuse(401, "Needs the header Authorization: Bearer TOKEN");
    }
    if (*request.role < v1::EDITOR) {
        return refuse(403, "Needs the role EDITOR");
    }
    const std::string problem =
        scene.empty() ? photometry_name_problem(name) : scene_name_problem(name);
    if (!problem.empty()) {
        return refuse(400, "The name " + problem);
    }
    if (!scene.empty() && !name.ends_with(".glb")) {
        return refuse(400, "Only .glb: one file that holds everything");
    }
    if (!request.length || *request.length == 0) {
        return refuse(411, "Needs Content-Length, not 0");
    }
    if (*request.length > most_bytes) {
        return last_response(refuse(413, "Larger than " + std::to_string(most_bytes) + " bytes"));
    }
    if (limits.running >= limits.max_running) {
        return refuse(503, "Other uploads are running; try again later");
    }
    return std::nullopt;
}

std::optional<std::uint64_t> parse_length(std::string_view header) {
    std::uint64_t length = 0;
    const char* const end = header.data() + header.size();
    const auto [rest, error] = std::from_chars(header.data(), end, length);
    return error == std::errc() && rest == end ? std::optional(length) : std::nullopt;
}

HttpResponse text_response(const UploadResult& result) {
    HttpResponse response;
    response.status = result.status;
    response.body = result.text + "\n";
    return response;
}

}  // namespace raybundle
