// SPDX-License-Identifier: Apache-2.0
#include "options/log_settings.h"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "telemetry/trace_scope.h"

namespace raybundle {
namespace {

/// The message as a JSON text, quotes included.
class JsonMessage : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& line, const std::tm& /*time*/,
                spdlog::memory_buf_t& out) override {
        const nlohmann::json text(std::string(line.payload.data(), line.payload.size()));
        const std::string quoted =
            text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        out.append(quoted.data(), quoted.data() + quoted.size());
    }
    [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<JsonMessage>();
    }
};

/// `,"trace_id":"...","span_id":"..."` of a line that belongs to a trace.
class TraceFields : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& /*line*/, const std::tm& /*time*/,
                spdlog::memory_buf_t& out) override {
        if (const auto& trace = current_trace()) {
            fmt::format_to(std::back_inserter(out), R"(,"trace_id":"{}","span_id":"{}")",
                           hex_of(trace->trace), hex_of(trace->span));
        }
    }
    [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<TraceFields>();
    }
};

/// Whether a byte is a control character, or the second one of U+0080 to U+009F in UTF-8: some
/// terminals take U+009B for the beginning of a command.
bool speaks(unsigned before, unsigned code) {
    constexpr unsigned first_printable = 0x20;
    constexpr unsigned delete_character = 0x7F;
    return code < first_printable || code == delete_character ||
           (before == 0xC2 && code >= 0x80 && code <= 0x9F);
}

/// The message on one line: a viewer's name or an address cannot forge another line, nor speak to
/// the terminal.
class PlainMessage : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& line, const std::tm& /*time*/,
                spdlog::memory_buf_t& out) override {
        unsigned before = 0;
        for (const char letter : line.payload) {
            const auto code = static_cast<unsigned char>(letter);
            if (speaks(before, code)) {
                fmt::format_to(std::back_inserter(out), "\\x{:02x}", code);
            } else {
                out.push_back(letter);
            }
            before = code;
        }
    }
    [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<PlainMessage>();
    }
};

}  // namespace

void set_log(const Options& options) {
    const bool json = options.log.format == "json";
    auto formatter = std::make_unique<spdlog::pattern_formatter>(
        json ? spdlog::pattern_time_type::utc : spdlog::pattern_time_type::local);
    if (json) {
        formatter->add_flag<JsonMessage>('*').add_flag<TraceFields>('J').set_pattern(
            R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l","message":%*%J})");
    } else {
        formatter->add_flag<PlainMessage>('*').set_pattern(
            "[%Y-%m-%d %H:%M:%S.%e] [%n] [%^%l%$] %*");
    }
    spdlog::set_formatter(std::move(formatter));
    set_log_level(options);
}

void set_log_level(const Options& options) {
    spdlog::set_level(
        spdlog::level::from_str(options.log.level == "warn" ? "warning" : options.log.level));
}

}  // namespace raybundle
