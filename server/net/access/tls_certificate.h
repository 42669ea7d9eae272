// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

struct ssl_ctx_st;

namespace raybundle {

/// A certificate chain with its private key, read and found to belong together.
class TlsCertificate {
  public:
    /// Reads PEM files. Throws std::runtime_error that names the file and the reason.
    TlsCertificate(const std::string& certificate_file, const std::string& key_file);
    ~TlsCertificate();
    TlsCertificate(const TlsCertificate&) = delete;
    TlsCertificate& operator=(const TlsCertificate&) = delete;

    /// Makes new connections of an OpenSSL context use it; open ones keep theirs. False where
    /// OpenSSL refuses, which leaves the context as it was.
    [[nodiscard]] bool install(ssl_ctx_st* context) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace raybundle
