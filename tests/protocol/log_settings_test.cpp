// SPDX-License-Identifier: Apache-2.0
#include "options/log_settings.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "collected_spans.h"
#include "telemetry/trace.h"
#include "telemetry/trace_scope.h"

namespace raybundle {
namespace {

/// What is logged in a format, where a viewer has a name that nobody expected.
std::string logged(const std::string& format) {
    std::ostringstream out;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(out)));
    Options options;
    options.log.format = format;
    set_log(options);
    spdlog::warn("viewer '{}' joined",
                 "a\"\\\n[error] b\x1b[2J \xc3\xa4 \xc2\xa9 \xc2\x9b\x32J \xff");
    spdlog::set_default_logger(before);
    return out.str();
}

TEST(LogSettings, NobodyForgesALine) {
    const std::string text = logged("text");
    EXPECT_NE(
        text.find(
            "[test] [warning] viewer 'a\"\\\\x0a[error] b\\x1b[2J \xc3\xa4 \xc2\xa9 \xc2\\x9b2J"),
        std::string::npos)
        << text;
    EXPECT_EQ(text.find('\n'), text.size() - 1);
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(LogSettings, JsonLinesAreJsonWhateverIsLogged) {
    const std::string text = logged("json");
    EXPECT_EQ(text.find('\n'), text.size() - 1);
    const auto line = nlohmann::json::parse(text);
    EXPECT_EQ(line.at("level"), "warning");
    EXPECT_FALSE(line.contains("trace_id"));
    EXPECT_NE(line.at("message").get<std::string>().find("a\"\\\n[error]"), std::string::npos);
}

TEST(LogSettings, JsonLinesOfAChangeNameItsTrace) {
    CollectedSpans sink;
    const Trace trace(sink, "change x", std::nullopt, Trace::Clock::now());
    const TraceScope scope(&trace);
    const auto line = nlohmann::json::parse(logged("json"));
    EXPECT_EQ(line.at("trace_id"), hex_of(trace.context().trace));
    EXPECT_EQ(line.at("span_id"), hex_of(trace.context().span));
    EXPECT_EQ(logged("text").find("trace"), std::string::npos);
}

}  // namespace
}  // namespace raybundle
