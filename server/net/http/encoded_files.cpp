// SPDX-License-Identifier: Apache-2.0
#include "net/http/encoded_files.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "net/access/access_tokens.h"

namespace raybundle {
namespace {

constexpr int kGzipWindow = 15 + 16;  ///< zlib: largest window, gzip header
constexpr int kGzipMemory = 9;        ///< zlib: the most

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// Takes the part before the next separator off the front of `list`.
std::string_view next_part(std::string_view& list, char separator) {
    const std::size_t end = std::min(list.find(separator), list.size());
    const std::string_view part = trimmed(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
    return part;
}

bool is_coding(std::string_view name, std::string_view coding) {
    return std::equal(name.begin(), name.end(), coding.begin(), coding.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    });
}

/// Weight of "coding;q=0.5"; 1 where there is none, 0 where it cannot be read.
double weight_of(std::string_view parameters) {
    while (!parameters.empty()) {
        const std::string_view parameter = next_part(parameters, ';');
        if (parameter.starts_with("q=") || parameter.starts_with("Q=")) {
            double weight = 0.0;
            std::from_chars(parameter.data() + 2, parameter.data() + parameter.size(), weight);
            return weight;
        }
    }
    return 1.0;
}

}  // namespace

std::string gzip(std::string_view bytes, int level) {
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, kGzipWindow, kGzipMemory, Z_DEFAULT_STRATEGY) !=
        Z_OK) {
        return {};
    }
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const bool done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
    packed.resize(done ? stream.total_out : 0);
    deflateEnd(&stream);
    return packed;
}

EncodedFiles::EncodedFiles(std::span<const EmbeddedFile> files) {
    for (const EmbeddedFile& file : files) {
        EncodedFile& encoded = files_[std::string(file.name)];
        encoded.etag = '"' + to_hex(token_digest(file.contents)).substr(0, 32) + '"';
        std::string packed = gzip(file.contents, Z_BEST_COMPRESSION);
        if (!packed.empty() && packed.size() < file.contents.size()) {
            encoded.gzip = std::make_shared<const std::string>(std::move(packed));
        }
    }
}

const EncodedFile* EncodedFiles::find(std::string_view name) const {
    const auto found = files_.find(name);
    return found == files_.end() ? nullptr : &found->second;
}

bool accepts_gzip(std::string_view accept_encoding) {
    std::optional<double> by_name;
    double by_star = 0.0;
    while (!accept_encoding.empty()) {
        std::string_view entry = next_part(accept_encoding, ',');
        const std::string_view name = next_part(entry, ';');
        if (is_coding(name, "gzip") || is_coding(name, "x-gzip")) {
            by_name = weight_of(entry);
        } else if (name == "*") {
            by_star = weight_of(entry);
        }
    }
    return by_name.value_or(by_star) > 0.0;
}

bool names_etag(std::string_view if_none_match, std::string_view etag) {
    while (!if_none_match.empty()) {
        std::string_view tag = next_part(if_none_match, ',');
        tag.remove_prefix(tag.starts_with("W/") ? 2 : 0);
        if (tag == "*" || (!tag.empty() && tag == etag)) {
            return true;
        }
    }
    return false;
}

std::string gzip_etag(std::string_view etag) {
    return std::string(etag.substr(0, etag.size() - 1)) + "-gzip\"";
}

}  // namespace raybundle
