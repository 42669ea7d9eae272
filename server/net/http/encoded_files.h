// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "embedded_file.h"

namespace raybundle {

/// What is sent of a file besides its bytes.
struct EncodedFile {
    std::string etag;                         ///< quoted; follows the contents
    std::shared_ptr<const std::string> gzip;  ///< null where it would save nothing
};

/// Compresses files once, so that a request costs no processor time.
class EncodedFiles {
  public:
    explicit EncodedFiles(std::span<const EmbeddedFile> files);

    /// Null where there is no such file.
    [[nodiscard]] const EncodedFile* find(std::string_view name) const;

  private:
    std::map<std::string, EncodedFile, std::less<>> files_;
};

/// In gzip's format; level: of zlib. Empty where zlib fails.
std::string gzip(std::string_view bytes, int level);

/// Whether an Accept-Encoding header (RFC 9110, 12.5.3) takes gzip.
bool accepts_gzip(std::string_view accept_encoding);

/// Whether an If-None-Match header (RFC 9110, 13.1.2) names this entity tag, compared weakly.
bool names_etag(std::string_view if_none_match, std::string_view etag);

/// ETag of the gzip form of what `etag` belongs to: bytes that differ have tags that differ.
std::string gzip_etag(std::string_view etag);

}  // namespace raybundle
