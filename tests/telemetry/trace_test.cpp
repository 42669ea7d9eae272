// SPDX-License-Identifier: Apache-2.0
#include "telemetry/trace.h"

#include <gtest/gtest.h>

#include <chrono>

#include "collected_spans.h"
#include "telemetry/trace_scope.h"

namespace raybundle {
namespace {

using std::chrono::milliseconds;

TEST(Trace, IsSentWithItsStagesWhenItEnds) {
    CollectedSpans sink;
    const auto begun = Trace::Clock::now() - milliseconds(100);
    TraceContext context;
    {
        Trace trace(sink, "change x", std::nullopt, begun);
        context = trace.context();
        trace.set("a", std::int64_t{1});
        trace.set("a", std::int64_t{2});
        trace.end_stage("first", {}, begun + milliseconds(10));
        trace.end_stage("second", {}, begun + milliseconds(30));
        trace.add("beside", begun + milliseconds(20), {{"b", true}}, begun + milliseconds(50));
        trace.fail("no");
        EXPECT_TRUE(sink.spans().empty());
    }
    const std::vector<Span> spans = sink.spans();
    ASSERT_EQ(spans.size(), 4U);
    const Span& root = spans[0];
    EXPECT_EQ(root.trace, context.trace);
    EXPECT_EQ(root.id, context.span);
    EXPECT_FALSE(root.parent);
    EXPECT_EQ(root.error, "no");
    ASSERT_EQ(root.attributes.size(), 1U);
    EXPECT_EQ(std::get<std::int64_t>(root.attributes[0].second), 2);
    EXPECT_EQ(root.ended_ns - root.begun_ns, 50'000'000U);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto age = now - std::chrono::nanoseconds(root.begun_ns);
    EXPECT_GE(age, milliseconds(99));
    EXPECT_LT(age, std::chrono::minutes(1));
    for (std::size_t i = 1; i < spans.size(); ++i) {
        EXPECT_EQ(spans[i].trace, root.trace);
        EXPECT_EQ(spans[i].parent, root.id);
        EXPECT_NE(spans[i].id, root.id);
    }
    EXPECT_EQ(spans[2].begun_ns, spans[1].ended_ns) << "stages follow each other";
    EXPECT_EQ(spans[3].name, "beside");
    EXPECT_EQ(spans[3].begun_ns, root.begun_ns + 20'000'000U);
}

TEST(Trace, GoesOnWithItsCallers) {
    CollectedSpans sink;
    const auto caller =
        parse_traceparent("00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01");
    { const Trace trace(sink, "x", caller, Trace::Clock::now()); }
    EXPECT_EQ(sink.spans().at(0).trace, caller->trace);
    EXPECT_EQ(sink.spans().at(0).parent, caller->span);
    EXPECT_NE(sink.spans().at(0).id, caller->span);
}

TEST(Trace, IsBounded) {
    CollectedSpans sink;
    {
        Trace trace(sink, "x", std::nullopt, Trace::Clock::now());
        for (std::size_t i = 0; i < 2 * Trace::max_spans; ++i) {
            trace.end_stage("y");
        }
    }
    ASSERT_EQ(sink.spans().size(), Trace::max_spans);
    const Attribute dropped = sink.spans().at(0).attributes.at(0);
    EXPECT_EQ(dropped.first, "raybundle.spans_dropped");
    EXPECT_EQ(std::get<std::int64_t>(dropped.second),
              static_cast<std::int64_t>(Trace::max_spans) + 1);
}

TEST(TraceScope, NestsAndEnds) {
    CollectedSpans sink;
    const Trace outer(sink, "x", std::nullopt, Trace::Clock::now());
    const Trace inner(sink, "y", std::nullopt, Trace::Clock::now());
    EXPECT_FALSE(current_trace());
    {
        const TraceScope first(&outer);
        {
            const TraceScope second(&inner);
            const TraceScope none(nullptr);
            EXPECT_EQ(current_trace()->trace, inner.context().trace);
        }
        EXPECT_EQ(current_trace()->trace, outer.context().trace);
    }
    EXPECT_FALSE(current_trace());
}

}  // namespace
}  // namespace raybundle
