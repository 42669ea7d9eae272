// SPDX-License-Identifier: Apache-2.0
// REST beside the socket, as it is served: what is done over HTTP is what the socket shows.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "daemon.h"
#include "http_receiver.h"
#include "json_viewer.h"
#include "otlp_trace.pb.h"
#include "telemetry/trace_context.h"
#include "test_folder.h"

namespace raybundle {
namespace {

struct Answer {
    int status = 0;
    std::string head;
    std::string body;
    [[nodiscard]] Json json() const { return Json::parse(body, nullptr, false); }
};

/// One server for all: each test goes on where the one before has left the scene.
class RestTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TestFolder>();
        collector_ = std::make_unique<HttpReceiver>();
        daemon_ = std::make_unique<Daemon>(
            scene_file("cornell_box.gltf"),
            std::vector<std::string>{"--journal", folder_->path("session.db"), "--otlp",
                                     collector_->url(), "--audit-log",
                                     folder_->path("audit.jsonl")});
    }
    static void TearDownTestSuite() {
        daemon_.reset();
        collector_.reset();
        folder_.reset();
    }

    [[nodiscard]] static Answer ask(const std::string& line, const std::string& body = "",
                                    const std::string& headers = "") {
        const std::string text =
            http_exchange(daemon_->port(),
                          line + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" + headers +
                              (body.empty() ? ""
                                            : "Content-Type: application/json\r\n"
                                              "Content-Length: " +
                                                  std::to_string(body.size()) + "\r\n") +
                              "\r\n" + body);
        const std::size_t end = text.find("\r\n\r\n");
        return {std::stoi(text.substr(9, 3)), text.substr(0, end), text.substr(end + 4)};
    }

    /// Asks again until there is an answer.
    [[nodiscard]] static Answer poll(const std::string& url) {
        for (;;) {
            Answer answer = ask("GET " + url);
            if (answer.status != 202) {
                return answer;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    /// Spans of the trace that a caller has begun, once a frame has shown its change.
    [[nodiscard]] static std::vector<otlp::v1::Span> spans_of(const std::string& trace) {
        std::vector<otlp::v1::Span> spans;
        for (std::size_t requests = 1; spans.empty(); ++requests) {
            const auto received = collector_->wait_for(requests);
            if (received.size() < requests) {
                break;
            }
            otlp::v1::ExportTraceServiceRequest read;
            if (!read.ParseFromString(received[requests - 1].body) ||
                read.resource_spans().empty()) {
                ADD_FAILURE() << received[requests - 1].head;
                break;
            }
            for (const auto& span : read.resource_spans(0).scope_spans(0).spans()) {
                if (hex_of_text(span.trace_id()) == trace) {
                    spans.push_back(span);
                }
            }
        }
        return spans;
    }

    [[nodiscard]] static std::string hex_of_text(const std::string& bytes) {
        return hex_of({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    }

    [[nodiscard]] static std::vector<std::string> events_in(const std::string& name) {
        std::vector<std::string> events;
        std::ifstream file(folder_->path(name));
        for (std::string text; std::getline(file, text);) {
            const Json line = Json::parse(text);
            EXPECT_EQ(line.at("address"), "127.0.0.1") << text;
            std::string event = line.at("event");
            for (const char* key : {"request", "change", "path"}) {
                event += line.contains(key) ? " " + line.at(key).get<std::string>() : "";
            }
            events.push_back(event);
        }
        return events;
    }

    static inline std::unique_ptr<HttpReceiver> collector_;
    static inline std::unique_ptr<TestFolder> folder_;
    static inline std::unique_ptr<Daemon> daemon_;
};

TEST_F(RestTest, WhatIsChangedOverHttpIsSeenOverTheSocket) {
    JsonViewer viewer(daemon_->port());
    const Json welcome = viewer.join({}, 32, 24).at("welcome");
    const std::size_t changes = ask("GET /api/v1/changes").json().at("changes").size();
    const Json scene = ask("GET /api/v1/scene").json();
    EXPECT_EQ(scene.at("scene").at("lights"), welcome.at("scene").at("lights"));
    EXPECT_EQ(ask("GET /api/v1/lights/1").json(), welcome.at("scene").at("lights").at(0));

    const Answer set = ask("PATCH /api/v1/lights/1?name=Ada", R"({"dim":0.5})");
    EXPECT_EQ(set.status, 200) << set.body;
    const Json told = viewer.next_with("sceneChanged").at("sceneChanged");
    EXPECT_EQ(told.at("epoch"), set.json().at("sceneChanged").at("epoch"));
    EXPECT_EQ(told.at("byName"), "Ada");
    EXPECT_EQ(ask("GET /api/v1/lights/1").json().at("dim"), 0.5);
    EXPECT_EQ(ask("GET /api/v1/changes").json().at("changes").size(), changes + 1);
    EXPECT_EQ(ask("POST /api/v1/undo", Json{{"epoch", welcome.at("epoch")}}.dump()).status, 200);
    EXPECT_EQ(ask("GET /api/v1/lights/1").json().at("dim"), 1);
    const Answer none = ask("POST /api/v1/changes", R"({"setLight":{"light":99,"on":true}})");
    EXPECT_EQ(none.status, 404);
    EXPECT_EQ(none.json().at("detail"), "setLight.light: no light 99");

    // Who asks over HTTP is not among the people, of whom a presence tells when the next one comes.
    JsonViewer other(daemon_->port());
    const Json own = other.join({}, 32, 24).at("welcome").at("viewer");
    other.next([&](const Json& message) {
        const Json viewers = message.value("/presence/viewers"_json_pointer, Json::array());
        for (const Json& person : viewers) {
            EXPECT_EQ(person.at("name"), "test") << viewers;
        }
        return viewers.size() == 2 && viewers.at(1).at("viewer") == own;
    });
    EXPECT_EQ(ask("GET /api/v1/viewers").json().at("viewers").at(1).at("viewer"), own);
}

TEST_F(RestTest, PinsComeAndGo) {
    JsonViewer viewer(daemon_->port());
    viewer.join({}, 32, 24);
    const Json floor = ask("POST /api/v1/probes",
                           R"({"ray":{"origin":{"x":1,"y":2,"z":0.5},"direction":{"y":-1}}})")
                           .json();
    ASSERT_TRUE(floor.at("hit").get<bool>());
    const Json wanted{
        {"text", "glare"}, {"position", floor.at("position")}, {"patch", floor.at("patch")}};
    const Answer added = ask("POST /api/v1/pins?name=Ada", wanted.dump());
    ASSERT_EQ(added.status, 201) << added.body;
    const std::string path = "/api/v1/pins/" + added.json().at("pin").dump();
    EXPECT_TRUE(has(added.head + "\r\n", "location: " + path + "\r\n")) << added.head;
    EXPECT_GT(added.json().at("illuminance"), 0);
    EXPECT_FALSE(added.json().contains("camera")) << "it was looked at from nowhere";
    EXPECT_EQ(viewer.next_with("pinChanged").at("pinChanged").at("text"), "glare");
    EXPECT_EQ(ask("POST " + path + "/replies?name=Ben", R"({"text":"yes"})").status, 200);
    EXPECT_EQ(ask("PATCH " + path, R"({"resolved":true})").status, 200);
    const Json pin = ask("GET " + path).json();
    EXPECT_EQ(pin.at("replies").at(0).at("byName"), "Ben");
    EXPECT_TRUE(pin.at("resolved").get<bool>());
    EXPECT_EQ(ask("DELETE " + path).status, 200);
    EXPECT_EQ(ask("GET " + path).status, 404);
    EXPECT_EQ(ask("DELETE " + path).status, 404);
    EXPECT_EQ(ask("POST /api/v1/probes", R"({"pixel":{"x":1,"y":1}})").status, 400);
}

TEST_F(RestTest, MeasurementsAndPicturesAreAskedForAgain) {
    const Answer measuring =
        ask("POST /api/v1/measurements?wait=0", R"({"quantity":"HORIZONTAL","relativeError":0.2,)"
                                                R"("points":[{"position":{"x":1,"y":4,"z":1}}]})");
    ASSERT_EQ(measuring.status, 202) << measuring.body;
    const Answer measured = poll(measuring.json().at("url"));
    ASSERT_EQ(measured.status, 200) << measured.body;
    const Json point = measured.json().at("points").at(0);
    EXPECT_LE(point.at("low"), point.at("value"));
    EXPECT_LE(point.at("value"), point.at("high"));

    const Answer taking = ask(
        "POST /api/v1/snapshots",
        R"({"snapshot":{"width":32,"height":24,"relativeError":0.9,"format":"PNG"},"setCamera":)"
        R"({"eye":{"x":2.7,"y":2.7,"z":-7.5},"target":{"x":2.7,"y":2.7,"z":2.7}}})");
    ASSERT_EQ(taking.status, 202) << taking.body;
    const std::string url = taking.json().at("url");
    const Answer taken = poll(url);
    ASSERT_EQ(taken.status, 200) << taken.body;
    EXPECT_EQ(poll(url).body, taken.body) << "the answer is kept";
    // Exposed by itself, though nobody looks.
    EXPECT_NE(taken.json().at("exposure"), 0);
    const Answer picture = ask("GET " + taken.json().at("url").get<std::string>());
    EXPECT_TRUE(picture.body.starts_with("\x89PNG"));
}

TEST_F(RestTest, AChangeIsOneTraceAndOneLineOfTheAuditLog) {
    JsonViewer viewer(daemon_->port());
    viewer.join({}, 32, 24);
    for (int i = 0; i < 2; ++i) {  // once it is known to acknowledge frames it is waited for
        viewer.next_frame([](const Json&) { return true; });
    }
    const std::string trace = "0af7651916cd43dd8448eb211c80319c";
    const Answer set = ask("PATCH /api/v1/lights/1?name=Ada", R"({"dim":0.7})",
                           "traceparent: 00-" + trace + "-b7ad6b7169203331-01\r\n");
    ASSERT_EQ(set.status, 200) << set.body;
    const Json epoch = set.json().at("sceneChanged").at("epoch");
    viewer.next_frame([&](const Json& header) { return header.value("epoch", Json()) == epoch; });
    const auto spans = spans_of(trace);
    std::vector<std::string> names;
    for (const auto& span : spans) {
        names.push_back(span.name());
    }
    const std::vector<std::string> expected{"change setLight", "inbox",         "queue", "record",
                                            "apply",           "special phase", "frame"};
    ASSERT_EQ(names, expected);
    EXPECT_EQ(hex_of_text(spans[0].parent_span_id()), "b7ad6b7169203331");

    collector_->hang();  // which holds nobody up
    EXPECT_EQ(ask("PATCH /api/v1/lights/1?name=Ada", R"({"dim":0.6})").status, 200);
    EXPECT_EQ(ask("GET /report.json").status, 200);
    std::filesystem::rename(folder_->path("audit.jsonl"), folder_->path("audit.jsonl.1"));
    daemon_->signal(SIGHUP);
    ASSERT_TRUE(daemon_->says("settings have been read again"));
    EXPECT_EQ(ask("GET /api/v1/pins").status, 200);
    const std::vector<std::string> before = events_in("audit.jsonl.1");
    const std::vector<std::string> last{"request PATCH /api/v1/lights/1", "change setLight",
                                        "download /report.json"};
    ASSERT_GE(before.size(), last.size());
    EXPECT_EQ(std::vector<std::string>(before.end() - 3, before.end()), last);
    EXPECT_EQ(events_in("audit.jsonl"), std::vector<std::string>{"request GET /api/v1/pins"});
}

}  // namespace
}  // namespace raybundle
