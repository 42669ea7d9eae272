// SPDX-License-Identifier: Apache-2.0
#include "telemetry/otlp_message.h"

#include <gtest/gtest.h>

#include <numeric>

#include "otlp_trace.pb.h"

namespace raybundle {
namespace {

/// A field with a length, as protobuf writes it: its tag, the length, the bytes.
std::string field(char tag, const std::string& bytes) {
    std::string length;
    for (std::size_t rest = bytes.size();; rest >>= 7U) {
        length += static_cast<char>((rest & 0x7FU) | (rest > 0x7FU ? 0x80U : 0U));
        if (rest <= 0x7FU) {
            return tag + length + bytes;
        }
    }
}

template <typename Id>
Id counting_from(std::uint8_t first) {
    Id id{};
    std::iota(id.begin(), id.end(), first);
    return id;
}

template <typename Id>
std::string text_of(const Id& id) {
    return {id.begin(), id.end()};
}

Span example() {
    Span span;
    span.trace = counting_from<TraceId>(1);
    span.id = counting_from<SpanId>(0x11);
    span.parent = counting_from<SpanId>(0x21);
    span.serves = true;
    span.name = "n";
    span.begun_ns = 1;
    span.ended_ns = 0x0102030405060708;
    span.attributes = {{"k", std::int64_t{5}}};
    span.error = "e";
    return span;
}

TEST(OtlpMessage, HasTheBytesThatTheFieldNumbersOfOpenTelemetryAskFor) {
    const Span span = example();
    using namespace std::string_literals;
    const std::string bytes_of_span =
        "\x0a\x10"s + text_of(span.trace) +        // 1: trace_id
        "\x12\x08"s + text_of(span.id) +           // 2: span_id
        "\x22\x08"s + text_of(*span.parent) +      // 4: parent_span_id
        "\x2a\x01n"s                               // 5: name
        "\x30\x02"                                 // 6: kind, SERVER
        "\x39\x01\x00\x00\x00\x00\x00\x00\x00"s +  // 7: start_time_unix_nano
        "\x41\x08\x07\x06\x05\x04\x03\x02\x01"s +  // 8: end_time_unix_nano
        "\x4a\x07\x0a\x01k\x12\x02\x18\x05"s +     // 9: attributes: key, value: int_value
        "\x7a\x05\x12\x01"s +
        "e\x18\x02"s +                // 15: status: message, code ERROR
        "\x85\x01\x01\x00\x00\x00"s;  // 16: flags, sampled
    const std::string service =
        field('\x0a', "service.name") + field('\x12', field('\x0a', "here"));
    const std::string scope = field('\x0a', "raybundle") + field('\x12', RAYBUNDLE_VERSION);
    const std::string expected =
        field('\x0a', field('\x0a', field('\x0a', service)) +
                          field('\x12', field('\x0a', scope) + field('\x12', bytes_of_span)));
    EXPECT_EQ(otlp_message({"here", {}}, std::span(&span, 1)), expected);
}

TEST(OtlpMessage, CarriesEveryKindOfValue) {
    Span span = example();
    span.parent.reset();
    span.error.reset();
    span.serves = false;
    span.attributes = {{"real", 0.5}, {"truth", true}, {"text", std::string("x")}};
    otlp::v1::ExportTraceServiceRequest read;
    ASSERT_TRUE(read.ParseFromString(
        otlp_message({"s", {{"host.name", std::string("h")}}}, std::span(&span, 1))));
    const auto& resource = read.resource_spans(0).resource();
    ASSERT_EQ(resource.attributes_size(), 2);
    EXPECT_EQ(resource.attributes(1).key(), "host.name");
    const auto& back = read.resource_spans(0).scope_spans(0).spans(0);
    EXPECT_EQ(back.kind(), otlp::v1::Span::SPAN_KIND_INTERNAL);
    EXPECT_TRUE(back.parent_span_id().empty());
    EXPECT_FALSE(back.has_status());
    EXPECT_EQ(back.attributes(0).value().double_value(), 0.5);
    EXPECT_TRUE(back.attributes(1).value().bool_value());
    EXPECT_EQ(back.attributes(2).value().string_value(), "x");
}

}  // namespace
}  // namespace raybundle
