// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/stream_entry.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace raybundle {
namespace {

constexpr char key_separator = '\n';

template <typename Number>
bool parse_number(std::string_view text, Number& number) {
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
}

/// "KEY", or "KEY PART/PARTS" of one of several changes. Keys have no blanks.
std::string text_of(const RequestKey& key) {
    return key.parts == 0
               ? key.text
               : key.text + " " + std::to_string(key.part) + "/" + std::to_string(key.parts);
}

RequestKey parse_key(std::string_view text) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::size_t slash = std::min(text.find('/', blank), text.size());
    RequestKey key{std::string(text.substr(0, blank))};
    if (slash < text.size() &&
        (!parse_number(text.substr(blank + 1, slash - blank - 1), key.part) ||
         !parse_number(text.substr(slash + 1), key.parts))) {
        key.part = 0;
        key.parts = 1;  // it is not known to be complete
    }
    return key;
}

std::vector<RequestKey> split_keys(const std::string& text) {
    std::vector<RequestKey> keys;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(key_separator, begin), text.size());
        keys.push_back(parse_key(std::string_view(text).substr(begin, end - begin)));
        begin = end + 1;
    }
    return keys;
}

void read_field(const std::string& name, const std::string& value, StreamEntry& entry) {
    std::uint8_t kind = 0;
    if (name == "worker") {
        entry.worker = value;
    } else if (name == "request") {
        parse_number(value, entry.request);
    } else if (name == "keys") {
        entry.entry.keys = split_keys(value);
    } else if (name == "traceparent") {
        entry.entry.traceparent = value;
    } else if (name == "change") {
        entry.is_change = true;
        if (!entry.entry.change.ParseFromString(value)) {
            entry.entry.change.Clear();
        }
        entry.entry.change.set_epoch(static_cast<std::uint32_t>(entry.id.epoch));
    } else if (name == "before") {
        if (!entry.before.ParseFromString(value)) {
            entry.before.Clear();
        }
    } else if (name == "kind" && parse_number(value, kind)) {
        entry.entry.kind = static_cast<NoteKind>(kind);
    } else if (name == "number") {
        parse_number(value, entry.entry.number);
    } else if (name == "body") {
        entry.entry.body = value;
    }
}

}  // namespace

std::optional<StreamId> parse_stream_id(const std::string& text) {
    StreamId id;
    const std::size_t dash = text.find('-');
    const bool fits = dash != std::string::npos &&
                      parse_number(std::string_view(text).substr(0, dash), id.epoch) &&
                      parse_number(std::string_view(text).substr(dash + 1), id.sequence);
    return fits ? std::optional(id) : std::nullopt;
}

std::vector<std::string> words_of(const StreamEntry& entry) {
    std::vector<std::string> words{"worker", entry.worker, "request",
                                   std::to_string(entry.request)};
    if (entry.is_change) {
        words.insert(words.end(), {"change", entry.entry.change.SerializeAsString(), "before",
                                   entry.before.SerializeAsString()});
    } else {
        words.insert(words.end(),
                     {"kind", std::to_string(static_cast<unsigned>(entry.entry.kind)), "number",
                      std::to_string(entry.entry.number), "body", entry.entry.body});
    }
    std::string keys;
    for (const RequestKey& key : entry.entry.keys) {
        keys += (keys.empty() ? "" : std::string(1, key_separator)) + text_of(key);
    }
    if (!keys.empty()) {
        words.insert(words.end(), {"keys", keys});
    }
    if (!entry.entry.traceparent.empty()) {
        words.insert(words.end(), {"traceparent", entry.entry.traceparent});
    }
    return words;
}

std::vector<StreamEntry> parse_entries(const RedisReply& reply) {
    std::vector<StreamEntry> entries;
    for (const RedisReply& item : reply.list) {
        const auto id = item.list.size() == 2 ? parse_stream_id(item.list[0].text) : std::nullopt;
        if (!id) {
            continue;
        }
        StreamEntry& entry = entries.emplace_back();
        entry.id = *id;
        const std::vector<RedisReply>& fields = item.list[1].list;
        for (std::size_t i = 0; i + 1 < fields.size(); i += 2) {
            read_field(fields[i].text, fields[i + 1].text, entry);
        }
    }
    return entries;
}

std::vector<StreamEntry> entries_read(const RedisReply& reply) {
    const bool some = !reply.list.empty() && reply.list[0].list.size() == 2;
    return some ? parse_entries(reply.list[0].list[1]) : std::vector<StreamEntry>();
}

bool is_conflict(const RedisRefusal& refusal) {
    return std::string_view(refusal.what()).find("equal or smaller") != std::string_view::npos;
}

}  // namespace raybundle
