// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "net/http/http_response.h"
#include "net/http/upload.h"
#include "net/ws/upgrade_check.h"
#include "raybundle.pb.h"

namespace raybundle {

/// What decides about PUT /scenes/NAME.glb and /photometry/NAME.ies or .ldt, before a byte of the
/// file has been read.
struct UploadRequest {
    std::string path;  ///< decoded
    std::string origin, host;
    std::optional<v1::Role> role;         ///< of the request's token; none: a wrong token or none
    std::optional<std::uint64_t> length;  ///< Content-Length, bytes
};

struct UploadLimits {
    std::uint32_t max_bytes = 0;  ///< 0: no uploads
    std::size_t running = 0;      ///< uploads that have not ended
    std::size_t max_running = 2;
};

/// The refusal, or nothing where the upload may begin.
std::optional<HttpResponse> refuse_upload(const UploadRequest& request, const UploadLimits& limits,
                                          const OriginRules& origins);

/// The name in such a path, which has been decoded; empty for any other path.
std::string_view uploaded_name(std::string_view path);

/// Length in bytes of a Content-Length header; nothing unless it is a plain decimal number.
std::optional<std::uint64_t> parse_length(std::string_view header);

/// A line of text.
HttpResponse text_response(const UploadResult& result);

}  // namespace raybundle
