// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace raybundle {

/// A self-signed certificate for 127.0.0.1, made by the openssl program in a folder of its own and
/// removed with it.
class TestCertificate {
  public:
    explicit TestCertificate(const std::string& common_name) {
        std::string pattern = (std::filesystem::temp_directory_path() / "raybundle_tls_XXXXXX");
        if (mkdtemp(pattern.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        folder_ = pattern;
        make(common_name);
    }
    ~TestCertificate() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    TestCertificate(const TestCertificate&) = delete;
    TestCertificate& operator=(const TestCertificate&) = delete;

    /// Replaces both files by a new pair.
    void make(const std::string& common_name) const {
        const std::string command =
            "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 2"
            " -subj /CN=" +
            common_name + " -addext subjectAltName=IP:127.0.0.1 -keyout " + key() + " -out " +
            certificate() + " 2>/dev/null";
        if (std::system(command.c_str()) != 0) {  // NOLINT(concurrency-mt-unsafe)
            throw std::runtime_error("the openssl program is missing");
        }
    }

    [[nodiscard]] std::string certificate() const { return folder_ / "certificate.pem"; }
    [[nodiscard]] std::string key() const { return folder_ / "key.pem"; }

  private:
    std::filesystem::path folder_;
};

}  // namespace raybundle
