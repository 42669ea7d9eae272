// SPDX-License-Identifier: Apache-2.0
#include "net/access/tls_certificate.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>

#include <array>
#include <filesystem>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr int kMaxChain = 16;  ///< certificates above the server's own

struct BioDeleter {
    void operator()(BIO* bio) const { BIO_free_all(bio); }
};
using BioPtr = std::unique_ptr<BIO, BioDeleter>;

struct X509Deleter {
    void operator()(X509* certificate) const { X509_free(certificate); }
};
struct KeyDeleter {
    void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
};
struct ChainDeleter {
    void operator()(STACK_OF(X509) * chain) const { sk_X509_pop_free(chain, X509_free); }
};

BioPtr open(const std::string& file) {
    std::error_code missing;
    if (std::filesystem::is_fifo(file, missing)) {  // nobody might ever write to it
        throw std::runtime_error(file + ": is a pipe, not a file");
    }
    BioPtr bio(BIO_new_file(file.c_str(), "r"));
    ERR_clear_error();
    if (!bio) {
        throw std::runtime_error(file + ": cannot be read");
    }
    return bio;
}

[[noreturn]] void fail(const std::string& file, const char* what) {
    std::array<char, 256> reason{};
    ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
    ERR_clear_error();
    throw std::runtime_error(file + ": " + what + " (" + reason.data() + ")");
}

/// A key that needs a passphrase is refused: a daemon has nobody to ask.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*user*/) {
    return -1;
}

}  // namespace

struct TlsCertificate::Parts {
    std::unique_ptr<X509, X509Deleter> own;
    std::unique_ptr<STACK_OF(X509), ChainDeleter> chain;
    std::unique_ptr<EVP_PKEY, KeyDeleter> key;
};

TlsCertificate::TlsCertificate(const std::string& certificate_file, const std::string& key_file)
    : parts_(std::make_unique<Parts>()) {
    const BioPtr certificates = open(certificate_file);
    parts_->own.reset(PEM_read_bio_X509(certificates.get(), nullptr, no_passphrase, nullptr));
    if (!parts_->own) {
        fail(certificate_file, "holds no PEM certificate");
    }
    parts_->chain.reset(sk_X509_new_null());
    for (int i = 0; i < kMaxChain; ++i) {
        X509* const next = PEM_read_bio_X509(certificates.get(), nullptr, no_passphrase, nullptr);
        if (next == nullptr) {
            break;
        }
        sk_X509_push(parts_->chain.get(), next);
    }
    ERR_clear_error();  // "no more certificates" is how a chain ends
    const BioPtr key = open(key_file);
    parts_->key.reset(PEM_read_bio_PrivateKey(key.get(), nullptr, no_passphrase, nullptr));
    if (!parts_->key) {
        fail(key_file, "holds no PEM private key without a passphrase");
    }
    if (X509_check_private_key(parts_->own.get(), parts_->key.get()) != 1) {
        fail(key_file, "is not the key of the certificate");
    }
}

TlsCertificate::~TlsCertificate() = default;

bool TlsCertificate::install(ssl_ctx_st* context) const {
    constexpr int kReplace = 1;
    const bool installed = SSL_CTX_use_cert_and_key(context, parts_->own.get(), parts_->key.get(),
                                                    parts_->chain.get(), kReplace) == 1;
    ERR_clear_error();
    return installed;
}

}  // namespace raybundle
