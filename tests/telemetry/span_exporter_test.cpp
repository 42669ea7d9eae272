// SPDX-License-Identifier: Apache-2.0
#include "telemetry/span_exporter.h"

#include <gtest/gtest.h>

#include <chrono>

#include "http_receiver.h"
#include "otlp_trace.pb.h"
#include "test_certificate.h"

namespace raybundle {
namespace {

using std::chrono::milliseconds;

/// So soon that no test waits for it.
OtlpSettings settings_for(const std::string& base) {
    OtlpSettings settings = *otlp_settings(base, [](const char*) { return nullptr; });
    settings.batch_time = milliseconds(1);
    settings.first_pause = milliseconds(1);
    return settings;
}

std::vector<Span> some_spans(std::size_t count) {
    std::vector<Span> spans(count);
    for (Span& span : spans) {
        span.trace = random_trace_id();
        span.id = random_span_id();
        span.name = "x";
    }
    return spans;
}

int spans_in(const std::string& body) {
    otlp::v1::ExportTraceServiceRequest request;
    return request.ParseFromString(body) ? request.resource_spans(0).scope_spans(0).spans_size()
                                         : -1;
}

/// Waits until all spans have come or gone.
SpanExporter::Figures settled(const SpanExporter& exporter, std::uint64_t spans) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (exporter.figures().exported + exporter.figures().dropped < spans &&
           std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(milliseconds(1));
    }
    return exporter.figures();
}

TEST(SpanExporter, PostsProtobuf) {
    HttpReceiver collector;
    OtlpSettings settings = settings_for(collector.url());
    settings.headers = {{"api-key", "secret"}};
    SpanExporter exporter(settings);
    exporter.submit(some_spans(3));
    const auto requests = collector.wait_for(1);
    ASSERT_EQ(requests.size(), 1U);
    EXPECT_TRUE(requests[0].head.starts_with("POST /v1/traces HTTP/1.1\r\n")) << requests[0].head;
    for (const std::string& line :
         {"Host: 127.0.0.1:" + std::to_string(collector.port()),
          std::string("Content-Type: application/x-protobuf"), std::string("api-key: secret")}) {
        EXPECT_NE(requests[0].head.find("\r\n" + line + "\r\n"), std::string::npos) << line;
    }
    EXPECT_EQ(spans_in(requests[0].body), 3);
    EXPECT_EQ(settled(exporter, 3).exported, 3U);
}

TEST(SpanExporter, SendsWhatIsLeftBeforeItEnds) {
    HttpReceiver collector;
    OtlpSettings settings = settings_for(collector.url());
    settings.batch_time = std::chrono::hours(1);
    SpanExporter exporter(settings);
    exporter.submit(some_spans(SpanExporter::max_batch - 1));
    exporter.stop();
    EXPECT_EQ(exporter.figures().exported, SpanExporter::max_batch - 1);
    exporter.submit(some_spans(1));
    EXPECT_EQ(exporter.figures().dropped, 1U);
}

TEST(SpanExporter, TriesAgainWhereTheCollectorIsBusy) {
    HttpReceiver collector;
    collector.answer({503, 429});
    SpanExporter exporter(settings_for(collector.url()));
    exporter.submit(some_spans(2));
    const auto figures = settled(exporter, 2);
    EXPECT_EQ(figures.exported, 2U);
    EXPECT_EQ(figures.failures, 2U);
    const auto requests = collector.wait_for(3);
    ASSERT_EQ(requests.size(), 3U);
    EXPECT_EQ(requests[0].body, requests[2].body);
}

TEST(SpanExporter, DropsWhatIsRefused) {
    HttpReceiver collector;
    collector.answer({400});
    SpanExporter exporter(settings_for(collector.url()));
    exporter.submit(some_spans(2));
    auto figures = settled(exporter, 2);
    EXPECT_EQ(figures.dropped, 2U);
    EXPECT_EQ(figures.failures, 1U);
    exporter.submit(some_spans(1));
    EXPECT_EQ(settled(exporter, 3).exported, 1U);
}

TEST(SpanExporter, ACollectorThatIsAwayCostsSpansAlone) {
    std::string nobody;
    {
        const HttpReceiver gone;
        nobody = gone.url();
    }
    SpanExporter exporter(settings_for(nobody));
    exporter.submit(some_spans(4));
    const auto figures = settled(exporter, 4);
    EXPECT_EQ(figures.dropped, 4U);
    EXPECT_EQ(figures.failures, static_cast<std::uint64_t>(SpanExporter::max_attempts));
}

TEST(SpanExporter, ACollectorThatHangsHoldsUpNobody) {
    HttpReceiver collector;
    collector.hang();
    OtlpSettings settings = settings_for(collector.url());
    settings.timeout = milliseconds(20);
    SpanExporter exporter(settings);
    exporter.submit(some_spans(1));
    auto figures = settled(exporter, 1);
    EXPECT_EQ(figures.dropped, 1U);
    EXPECT_EQ(figures.failures, static_cast<std::uint64_t>(SpanExporter::max_attempts));
}

TEST(SpanExporter, QueuesNoMoreThanItHasRoomFor) {
    HttpReceiver collector;
    collector.hang();
    SpanExporter exporter(settings_for(collector.url()));
    std::uint64_t submitted = 0;
    while (exporter.figures().dropped == 0 && submitted < 4 * SpanExporter::max_queued) {
        exporter.submit(some_spans(64));
        submitted += 64;
    }
    // Beside the queue there is the batch that is on its way.
    EXPECT_LE(submitted, SpanExporter::max_queued + SpanExporter::max_batch + 64);
    exporter.stop();
    EXPECT_EQ(exporter.figures().exported, 0U);
    EXPECT_EQ(exporter.figures().dropped, submitted);
}

TEST(SpanExporter, SpeaksTlsWithWhomItTrustsAlone) {
    const TestCertificate own("localhost");
    const TestCertificate other("localhost");
    HttpReceiver collector(own.certificate(), own.key());
    OtlpSettings settings = settings_for(collector.url());
    settings.ca_file = own.certificate();
    {
        SpanExporter exporter(settings);
        exporter.submit(some_spans(1));
        EXPECT_EQ(settled(exporter, 1).exported, 1U);
        EXPECT_EQ(spans_in(collector.wait_for(1).at(0).body), 1);
    }
    settings.ca_file = other.certificate();
    SpanExporter stranger(settings);
    stranger.submit(some_spans(1));
    EXPECT_EQ(settled(stranger, 1).dropped, 1U);
    EXPECT_EQ(collector.wait_for(1).size(), 1U) << "nothing is said to a stranger";
    settings.ca_file = "/nowhere/ca.pem";
    EXPECT_THROW(SpanExporter{settings}, std::runtime_error);
}

}  // namespace
}  // namespace raybundle
