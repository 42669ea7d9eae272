// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_traces.h"

#include <gtest/gtest.h>

#include <map>

#include "collected_spans.h"

namespace raybundle {
namespace {

ClientEvent dim(ViewerId viewer, const std::string& traceparent = {}) {
    ClientEvent event;
    event.viewer = viewer;
    event.received = Trace::Clock::now();
    event.message.mutable_set_light()->set_light(1);
    event.message.mutable_set_light()->set_dim(0.5F);
    if (!traceparent.empty()) {
        event.message.set_traceparent(traceparent);
    }
    return event;
}

std::string names(const std::vector<Span>& spans) {
    std::string text;
    for (const Span& span : spans) {
        text += (text.empty() ? "" : ", ") + span.name;
    }
    return text;
}

TEST(ChangeTraces, AreNoneWhereNobodyWantsThem) {
    ChangeTraces off(nullptr, "room");
    EXPECT_EQ(off.begin(dim(1)), nullptr);
    off.note_frame(1, 1, 100);
    CollectedSpans sink;
    const ChangeTraces on(&sink, "room");
    EXPECT_EQ(on.begin(dim(1, "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-00")), nullptr)
        << "its caller keeps none";
    EXPECT_NE(on.begin(dim(1, "nonsense")), nullptr);
}

TEST(ChangeTraces, FollowAChangeToTheFramesThatShowIt) {
    CollectedSpans sink;
    ChangeTraces traces(&sink, "room");
    ChangeQueue queue;
    const ClientEvent event = dim(7);
    queue.add(event, traces.begin(event));
    {
        const PendingChange change = queue.take();
        end_stage(change, "queue");
        end_stage(change, "apply");
        traces.begin_phase(change);
    }
    const std::vector<ViewerId> watchers{7, 8, 9};
    traces.end_phase(watchers, 3);
    traces.note_frame(7, 2, 10);  // drawn before
    EXPECT_TRUE(sink.spans().empty());
    traces.note_frame(7, 3, 20);
    traces.note_frame(8, 4, 30);
    traces.note_frame(7, 5, 40);  // it has had its frame
    EXPECT_TRUE(sink.spans().empty()) << "viewer 9 has none yet";
    traces.forget(9);
    const std::vector<Span> spans = sink.spans();
    EXPECT_EQ(names(spans), "change setLight, inbox, queue, apply, special phase, frame, frame");
    std::map<std::string, AttributeValue> root(spans[0].attributes.begin(),
                                               spans[0].attributes.end());
    EXPECT_EQ(std::get<std::string>(root.at("raybundle.change")), "setLight");
    EXPECT_EQ(std::get<std::int64_t>(root.at("raybundle.viewer")), 7);
    EXPECT_EQ(std::get<std::string>(root.at("raybundle.scene")), "room");
    for (const Span& span : spans) {
        EXPECT_EQ(span.trace, spans[0].trace);
        EXPECT_GE(span.begun_ns, spans[0].begun_ns);
        EXPECT_LE(span.ended_ns, spans[0].ended_ns);
    }
    EXPECT_EQ(spans[5].begun_ns, spans[4].ended_ns);
    EXPECT_EQ(std::get<std::int64_t>(spans[5].attributes[0].second), 7);
    EXPECT_EQ(std::get<std::int64_t>(spans[6].attributes[0].second), 8);
}

TEST(ChangeTraces, OfRequestsThatAreJoinedGoOnWithAllCallers) {
    CollectedSpans sink;
    ChangeTraces traces(&sink, "room");
    ChangeQueue queue;
    for (const char* caller : {"00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01",
                               "00-1af7651916cd43dd8448eb211c80319c-c7ad6b7169203331-01"}) {
        const ClientEvent event = dim(1, caller);
        queue.add(event, traces.begin(event));
    }
    ASSERT_EQ(queue.size(), 1U);
    { const PendingChange change = queue.take(); }
    const std::vector<Span> spans = sink.spans();
    EXPECT_EQ(names(spans), "change setLight, inbox, change setLight, inbox");
    EXPECT_EQ(hex_of(spans[0].trace), "0af7651916cd43dd8448eb211c80319c");
    EXPECT_EQ(hex_of(spans[2].trace), "1af7651916cd43dd8448eb211c80319c");
}

TEST(ChangeTraces, OfWhatStandsForSeveralChangesEndWithTheLast) {
    CollectedSpans sink;
    ChangeTraces traces(&sink, "room");
    ChangeQueue queue;
    ClientEvent undo;
    undo.viewer = 2;
    undo.received = Trace::Clock::now();
    undo.message.mutable_undo()->set_epoch(0);
    queue.add(undo, traces.begin(undo));
    const PendingChange asked = queue.take();
    queue.add_expanded({change_of(dim(2)), change_of(dim(2))}, asked);
    const auto trace = asked.traces.at(0);
    EXPECT_EQ(queue.take().traces.at(0), trace);
    EXPECT_EQ(queue.take().traces.at(0), trace);
    EXPECT_EQ(queue.take().traces.at(0), trace) << "the answer";
    EXPECT_TRUE(queue.empty());
}

TEST(ChangeTraces, WaitForNoFrameForEver) {
    CollectedSpans sink;
    ChangeTraces traces(&sink, "room");
    PendingChange change;
    change.traces = {traces.begin(dim(1))};
    traces.begin_phase(change);
    change.traces.clear();
    traces.end_phase(std::vector<ViewerId>{5}, 1);
    traces.expire();
    EXPECT_TRUE(sink.spans().empty());
    traces.expire(Trace::Clock::now() + ChangeTraces::max_wait + std::chrono::seconds(1));
    EXPECT_EQ(names(sink.spans()), "change setLight, inbox, special phase");
}

TEST(ChangeTraces, GoOnWithThatOfTheServerThatMadeTheChange) {
    CollectedSpans here;
    CollectedSpans there;
    const ChangeTraces asked(&here, "room");
    const ChangeTraces following(&there, "room");
    PendingChange made;
    EXPECT_EQ(traceparent_of(made), "");
    made.traces = {asked.begin(dim(1))};
    LogEntry entry;
    entry.change.mutable_set_light()->set_light(1);
    EXPECT_EQ(following.begin(entry), nullptr) << "the other server keeps no trace";
    entry.traceparent = traceparent_of(made);
    ChangeQueue queue;
    queue.add_recorded(entry, following.begin(entry));
    end_stage(queue.take(), "queue");
    made.traces.clear();
    ASSERT_EQ(names(there.spans()), "follow setLight, queue");
    ASSERT_FALSE(here.spans().empty());
    EXPECT_EQ(there.spans()[0].trace, here.spans()[0].trace);
    EXPECT_EQ(there.spans()[0].parent, here.spans()[0].id);
}

TEST(ChangeTraces, OfWhatPlaysFollowTheFirstChange) {
    CollectedSpans sink;
    const ChangeTraces traces(&sink, "room");
    ChangeQueue queue;
    queue.add_steps(std::vector<v1::SceneChanged>(2), traces.begin(dim(1)));
    EXPECT_EQ(queue.take().traces.size(), 1U);
    EXPECT_TRUE(queue.take().traces.empty());
    EXPECT_EQ(sink.spans().size(), 2U) << "the request, and its time in the inbox";
}

}  // namespace
}  // namespace raybundle
