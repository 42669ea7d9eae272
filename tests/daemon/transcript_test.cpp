// SPDX-License-Identifier: Apache-2.0
// Conversations of protocol 1.0, recorded once, replayed from then on: what a client of that
// version sends must be understood, and what it was told it must still be told. README.md beside
// the transcripts has their format.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "daemon.h"
#include "json_viewer.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// Fields whose values depend on time, machine or build; recorded by type only.
const std::set<std::string> kVolatile{"server",
                                      "iterations",
                                      "iterationsPerSecond",
                                      "settled",
                                      "relativeError",
                                      "errorLow",
                                      "errorHigh",
                                      "errorMeasured",
                                      "secondsToTarget",
                                      "targetOutOfReach",
                                      "exposure",
                                      "serverTimeMs",
                                      "illuminance",
                                      "luminance",
                                      "patch",
                                      "frame",
                                      "quality",
                                      "localPosition",
                                      "position",
                                      "normal",
                                      "effects",
                                      "worldFromParent",
                                      "bounds",
                                      "renderer",
                                      "softwareRendering",
                                      "setAtMs"};

std::string type_mark(const Json& value) {
    return "<" + std::string(value.type_name()) + ">";
}

/// Where `actual` lacks something of `expected`, by path; empty where all of it is there. Fields
/// that are new in `actual` are what a client ignores.
std::string difference(const Json& expected, const Json& actual, const std::string& path = "") {
    if (expected.is_string() && expected.get<std::string>().starts_with("<")) {
        return expected == type_mark(actual) ? "" : path + ": is " + actual.dump();
    }
    if (expected.is_object()) {
        for (const auto& [key, value] : expected.items()) {
            const std::string inner = std::string(path).append(".").append(key);
            if (!actual.is_object() || !actual.contains(key)) {
                return inner + ": is missing";
            }
            std::string found = difference(value, actual.at(key), inner);
            if (!found.empty()) {
                return found;
            }
        }
        return {};
    }
    if (expected.is_array() && actual.is_array() && expected.size() == actual.size()) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            std::string found =
                difference(expected[i], actual[i], path + "[" + std::to_string(i) + "]");
            if (!found.empty()) {
                return found;
            }
        }
        return {};
    }
    const bool numbers = expected.is_number() && actual.is_number();
    const bool same = numbers ? std::abs(expected.get<double>() - actual.get<double>()) <=
                                    1e-5 * (1.0 + std::abs(expected.get<double>()))
                              : expected == actual;
    return same ? "" : path + ": is " + actual.dump() + " instead of " + expected.dump();
}

/// The recording of a value: itself, with what is volatile replaced by its type.
Json recording_of(const Json& value) {
    Json result = value;
    if (value.is_structured()) {
        for (auto& [key, inner] : result.items()) {
            inner = value.is_object() && kVolatile.contains(key) ? Json(type_mark(inner))
                                                                 : recording_of(inner);
        }
    }
    return result;
}

/// The server's next message or frame for a line that has one expected.
Json receive(JsonViewer& viewer, const Json& line) {
    if (line.contains("frame")) {
        const Json& wanted = line.at("where");
        return viewer.next_frame(
            [&](const Json& header) { return difference(wanted, header).empty(); });
    }
    if (line.contains("close")) {
        return viewer.close_code();
    }
    return line.contains("answerTo") ? viewer.answer_to(line.at("answerTo").get<std::uint32_t>())
                                     : viewer.next_with(line.at("message").get<std::string>());
}

class TranscriptTest : public testing::TestWithParam<std::string> {};

TEST_P(TranscriptTest, IsStillTrue) {
    const fs::path file = fs::path(RAYBUNDLE_TRANSCRIPTS) / (GetParam() + ".jsonl");
    // NOLINTNEXTLINE(concurrency-mt-unsafe)
    const bool record = std::getenv("RAYBUNDLE_RECORD_TRANSCRIPTS") != nullptr;
    const Daemon daemon(scene_file("cornell_box.gltf"));
    JsonViewer viewer(daemon.port());
    std::ifstream stream(file);
    ASSERT_TRUE(stream) << file;
    std::string recorded;
    int number = 0;
    for (std::string text; std::getline(stream, text);) {
        ++number;
        Json line = Json::parse(text);
        if (line.contains("send")) {
            viewer.send(line.at("send"));
        } else if (line.contains("sendText")) {
            viewer.send_text(line.at("sendText").get<std::string>());
        } else {
            const Json actual = receive(viewer, line);
            if (record) {
                line["expect"] = recording_of(actual);
            }
            EXPECT_EQ(difference(line.at("expect"), actual), "")
                << GetParam() << ".jsonl, line " << number << "\n"
                << actual.dump();
        }
        recorded += line.dump() + "\n";
    }
    EXPECT_GT(number, 2);
    if (record) {
        std::ofstream(file) << recorded;
    }
}

INSTANTIATE_TEST_SUITE_P(Protocol10, TranscriptTest,
                         testing::Values("hello", "camera", "move", "light", "undo", "errors",
                                         "version", "review"),
                         [](const auto& test) { return test.param; });

TEST(TranscriptDifference, FindsWhatIsMissingOrOther) {
    const Json expected = Json::parse(R"({"a":1,"b":{"c":"<number>","d":[1,"x"]}})");
    EXPECT_EQ(difference(expected, Json::parse(R"({"a":1,"b":{"c":7,"d":[1,"x"],"e":0},"f":1})")),
              "");
    EXPECT_EQ(difference(expected, Json::parse(R"({"a":1,"b":{"d":[1,"x"]}})")),
              ".b.c: is missing");
    EXPECT_EQ(difference(expected, Json::parse(R"({"a":2,"b":{"c":7,"d":[1,"x"]}})")),
              ".a: is 2 instead of 1");
    EXPECT_EQ(difference(expected, Json::parse(R"({"a":1,"b":{"c":"7","d":[1,"x"]}})")),
              ".b.c: is \"7\"");
    EXPECT_NE(difference(expected, Json::parse(R"({"a":1,"b":{"c":7,"d":[1]}})")), "");
}

}  // namespace
}  // namespace raybundle
