// SPDX-License-Identifier: Apache-2.0
#include "report/zip_file.h"

#include <zlib.h>

#include <algorithm>
#include <vector>

namespace raybundle {
namespace {

constexpr std::uint32_t local_header = 0x04034b50;
constexpr std::uint32_t central_header = 0x02014b50;
constexpr std::uint32_t end_of_directory = 0x06054b50;
constexpr std::uint16_t deflated = 8;
constexpr std::uint16_t version = 20;
constexpr std::uint16_t utf8_names = 1U << 11U;
constexpr std::uint16_t first_day = 33;  // 1980-01-01: there is no clock in it

void add16(std::string& out, std::uint32_t value) {
    out += static_cast<char>(value & 0xffU);
    out += static_cast<char>(value >> 8U & 0xffU);
}

void add32(std::string& out, std::uint32_t value) {
    add16(out, value & 0xffffU);
    add16(out, value >> 16U);
}

std::string deflate_raw(const std::string& contents) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        return {};
    }
    std::string out(deflateBound(&stream, static_cast<uLong>(contents.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(contents.data()));
    stream.avail_in = static_cast<uInt>(contents.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

std::optional<std::string> inflate_raw(std::string_view packed, std::size_t size) {
    z_stream stream{};
    if (inflateInit2(&stream, -15) != Z_OK) {
        return std::nullopt;
    }
    std::string out(size, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int status = inflate(&stream, Z_FINISH);
    const bool whole = status == Z_STREAM_END && stream.total_out == size;
    inflateEnd(&stream);
    return whole ? std::optional(std::move(out)) : std::nullopt;
}

std::uint32_t checksum(std::string_view contents) {
    return static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(contents.data()),
                                            static_cast<uInt>(contents.size())));
}

/// What local and central headers have in common.
void add_description(std::string& out, std::uint32_t crc, std::size_t packed, std::size_t size,
                     std::size_t name) {
    add16(out, utf8_names);
    add16(out, deflated);
    add16(out, 0);
    add16(out, first_day);
    add32(out, crc);
    add32(out, static_cast<std::uint32_t>(packed));
    add32(out, static_cast<std::uint32_t>(size));
    add16(out, static_cast<std::uint32_t>(name));
    add16(out, 0);
}

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    }
    return value;
}

/// Where the end of the directory begins; there may be a comment behind it.
std::optional<std::size_t> find_end(std::string_view bytes) {
    constexpr std::size_t length = 22;
    constexpr std::size_t longest_comment = 65535;
    if (bytes.size() < length) {
        return std::nullopt;
    }
    const std::size_t last = bytes.size() - length;
    for (std::size_t back = 0; back <= std::min(last, longest_comment); ++back) {
        if (number(bytes, last - back, 4) == end_of_directory) {
            return last - back;
        }
    }
    return std::nullopt;
}

bool leads_out(const std::string& name) {
    return name.empty() || name.front() == '/' || name.find('\\') != std::string::npos ||
           name.find('\0') != std::string::npos ||
           ("/" + name + "/").find("/../") != std::string::npos;
}

struct Entry {
    std::string name;
    std::uint32_t method = 0, crc = 0, packed = 0, size = 0, offset = 0, flags = 0;
};

std::optional<std::string> contents_of(std::string_view bytes, const Entry& entry,
                                       std::string& reason) {
    constexpr std::size_t header = 30;
    if (entry.offset > bytes.size() || bytes.size() - entry.offset < header ||
        number(bytes, entry.offset, 4) != local_header) {
        reason = entry.name + ": its header is not where the directory says";
        return std::nullopt;
    }
    const std::size_t begin = entry.offset + header + number(bytes, entry.offset + 26, 2) +
                              number(bytes, entry.offset + 28, 2);
    if (begin > bytes.size() || bytes.size() - begin < entry.packed) {
        reason = entry.name + ": the archive ends within it";
        return std::nullopt;
    }
    const std::string_view packed = bytes.substr(begin, entry.packed);
    std::optional<std::string> contents;
    if ((entry.flags & 1U) == 0 && entry.method == deflated) {
        contents = inflate_raw(packed, entry.size);
    } else if ((entry.flags & 1U) == 0 && entry.method == 0 && entry.packed == entry.size) {
        contents = std::string(packed);
    }
    if (!contents || checksum(*contents) != entry.crc) {
        reason = entry.name + ": it is damaged, encrypted, or packed in an unknown way";
        return std::nullopt;
    }
    return contents;
}

}  // namespace

std::string write_zip(const ZipEntries& entries) {
    std::string out;
    std::string directory;
    for (const auto& [name, contents] : entries) {
        const std::string packed = deflate_raw(contents);
        const std::uint32_t crc = checksum(contents);
        const auto offset = static_cast<std::uint32_t>(out.size());
        add32(out, local_header);
        add16(out, version);
        add_description(out, crc, packed.size(), contents.size(), name.size());
        out += name + packed;
        add32(directory, central_header);
        add16(directory, version);
        add16(directory, version);
        add_description(directory, crc, packed.size(), contents.size(), name.size());
        add16(directory, 0);  // comment
        add16(directory, 0);  // disk
        add16(directory, 0);  // attributes
        add32(directory, 0);
        add32(directory, offset);
        directory += name;
    }
    const auto begin = static_cast<std::uint32_t>(out.size());
    out += directory;
    add32(out, end_of_directory);
    add32(out, 0);
    add16(out, static_cast<std::uint32_t>(entries.size()));
    add16(out, static_cast<std::uint32_t>(entries.size()));
    add32(out, static_cast<std::uint32_t>(directory.size()));
    add32(out, begin);
    add16(out, 0);
    return out;
}

std::optional<ZipEntries> read_zip(std::string_view bytes, const ZipLimits& limits,
                                   std::string& reason) {
    const auto end = find_end(bytes);
    if (!end) {
        reason = "it is not a ZIP archive";
        return std::nullopt;
    }
    const std::size_t count = number(bytes, *end + 10, 2);
    std::size_t at = number(bytes, *end + 16, 4);
    if (count > limits.most_entries) {
        reason = "it has too many entries";
        return std::nullopt;
    }
    ZipEntries entries;
    std::size_t total = 0;
    constexpr std::size_t header = 46;
    for (std::size_t i = 0; i < count; ++i) {
        if (at > bytes.size() || bytes.size() - at < header ||
            number(bytes, at, 4) != central_header) {
            reason = "its directory is damaged";
            return std::nullopt;
        }
        Entry entry{{},
                    number(bytes, at + 10, 2),
                    number(bytes, at + 16, 4),
                    number(bytes, at + 20, 4),
                    number(bytes, at + 24, 4),
                    number(bytes, at + 42, 4),
                    number(bytes, at + 8, 2)};
        const std::size_t name = number(bytes, at + 28, 2);
        if (bytes.size() - at - header < name) {
            reason = "its directory is damaged";
            return std::nullopt;
        }
        entry.name = std::string(bytes.substr(at + header, name));
        at += header + name + number(bytes, at + 30, 2) + number(bytes, at + 32, 2);
        if (!entry.name.empty() && entry.name.back() == '/') {
            continue;  // a folder
        }
        if (leads_out(entry.name)) {
            reason = "one of its names leads out of it";
            return std::nullopt;
        }
        total += entry.size;
        if (total > limits.most_bytes) {
            reason = "it is too large";
            return std::nullopt;
        }
        auto contents = contents_of(bytes, entry, reason);
        if (!contents) {
            return std::nullopt;
        }
        entries[entry.name] = std::move(*contents);
    }
    return entries;
}

}  // namespace raybundle
