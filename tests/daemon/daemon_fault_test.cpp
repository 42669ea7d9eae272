// SPDX-License-Identifier: Apache-2.0
// What operators and accidents do to a running server.
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "net/access/access_tokens.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
class DaemonTest : public testing::Test {
  protected:
    DaemonTest() {
        std::string pattern = fs::temp_directory_path() / "raybundle_daemon_XXXXXX";
        folder_ = mkdtemp(pattern.data());
    }
    ~DaemonTest() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

    fs::path folder_;
};

const std::string& cornell_box() {
    static const std::string file = scene_file("cornell_box.gltf");
    return file;
}

Json place(double x) {
    return {{"translation", {{"x", x}, {"y", 0.825}, {"z", 1.7}}}};
}

Json move(JsonViewer& viewer, double x, bool final = true) {
    return viewer.request(
        {{"moveObject", {{"object", kShortBox}, {"transform", place(x)}, {"final", final}}}});
}

double x_of_box(const Json& welcome) {
    for (const Json& object : welcome.at("welcome").at("scene").at("objects")) {
        if (object.at("id") == kShortBox) {
            return object.at("transform").at("translation").at("x").get<double>();
        }
    }
    return -1.0;
}

/// Waits until a solution message says that light has been solved for.
bool solves(JsonViewer& viewer) {
    const auto solved = [](const Json& message) {
        return message.contains("solution") && message["solution"].value("iterations", 0) > 16;
    };
    return !viewer.next(solved).empty();
}

TEST_F(DaemonTest, KilledItGoesOnWhereItWas) {
    const std::vector<std::string> options{"--journal", path("session.db")};
    std::uint32_t epoch = 0;
    {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        EXPECT_EQ(viewer.join().at("welcome").at("epoch"), 0);
        move(viewer, 2.0);
        move(viewer, 2.3, false);
        epoch = move(viewer, 2.6).at("sceneChanged").at("epoch").get<std::uint32_t>();
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    EXPECT_EQ(epoch, 3U);
    for (int restart = 0; restart < 2; ++restart) {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        const Json welcome = viewer.join();
        EXPECT_EQ(welcome.at("welcome").at("epoch"), epoch);
        EXPECT_NEAR(x_of_box(welcome), 2.6, 1e-6);
        EXPECT_TRUE(solves(viewer));
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
}

/// A restart is no end of the session: what was before it can still be gone back to.
TEST_F(DaemonTest, AnyEarlierEpochCanBeGoneBackToAfterARestart) {
    const std::vector<std::string> options{"--journal", path("session.db")};
    double first = 0.0;
    {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        first = x_of_box(viewer.join());
        move(viewer, 2.0);
        move(viewer, 2.3);
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        viewer.join();
        move(viewer, 2.6);
        EXPECT_TRUE(viewer.request({{"undo", {{"epoch", 1}}}}).contains("ok"));
        JsonViewer other(daemon.port());
        EXPECT_NEAR(x_of_box(other.join()), 2.0, 1e-6);
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    Daemon daemon(cornell_box(), options);
    JsonViewer viewer(daemon.port());
    EXPECT_EQ(viewer.join().at("welcome").at("epoch"), 4);
    EXPECT_TRUE(viewer.request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    JsonViewer other(daemon.port());
    EXPECT_NEAR(x_of_box(other.join()), first, 1e-6);
}

TEST_F(DaemonTest, KilledWhileItIsWrittenToItLosesNothingAcknowledged) {
    const std::vector<std::string> options{"--journal", path("session.db")};
    std::uint32_t acknowledged = 0;
    {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        viewer.join();
        for (int i = 0; i < 200; ++i) {
            viewer.send(
                {{"id", i + 1},
                 {"moveObject", {{"object", kShortBox}, {"transform", place(1.5 + 0.005 * i)}}}});
        }
        for (int i = 0; i < 5; ++i) {
            acknowledged =
                viewer.next_with("sceneChanged").at("sceneChanged").at("epoch").get<unsigned>();
        }
        daemon.end(SIGKILL);
    }
    ASSERT_GE(acknowledged, 1U);
    Daemon daemon(cornell_box(), options);
    JsonViewer viewer(daemon.port());
    EXPECT_GE(viewer.join().at("welcome").at("epoch").get<unsigned>(), acknowledged);
}

/// No file of the process grows beyond this.
void limit_files(pid_t process, rlim_t bytes) {
    const rlimit limit{bytes, RLIM_INFINITY};
    ASSERT_EQ(prlimit(process, RLIMIT_FSIZE, &limit, nullptr), 0);
}

TEST_F(DaemonTest, AFullDiskIsToldAndViewingGoesOn) {
    const std::vector<std::string> options{"--journal", path("session.db")};
    {
        Daemon daemon(cornell_box(), options);
        JsonViewer viewer(daemon.port());
        viewer.join();
        EXPECT_EQ(move(viewer, 2.0).at("sceneChanged").at("epoch"), 1);
        limit_files(daemon.process(), 1);
        const Json refused = move(viewer, 2.3);
        ASSERT_TRUE(refused.contains("error")) << refused.dump();
        EXPECT_EQ(refused.at("error").at("code"), "INTERNAL");
        EXPECT_TRUE(daemon.says("could not be saved"));
        EXPECT_TRUE(solves(viewer));
        EXPECT_FALSE(viewer.next_frame([](const Json&) { return true; }).empty());
        limit_files(daemon.process(), RLIM_INFINITY);
        EXPECT_EQ(move(viewer, 2.6).at("sceneChanged").at("epoch"), 2) << "there is room again";
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    Daemon daemon(cornell_box(), options);
    JsonViewer viewer(daemon.port());
    const Json welcome = viewer.join();
    EXPECT_EQ(welcome.at("welcome").at("epoch"), 2);
    EXPECT_NEAR(x_of_box(welcome), 2.6, 1e-6);
}

TEST_F(DaemonTest, WithoutAJournalASessionBeginsAnew) {
    for (int start = 0; start < 2; ++start) {
        Daemon daemon(cornell_box());
        JsonViewer viewer(daemon.port());
        EXPECT_EQ(viewer.join().at("welcome").at("epoch"), 0);
        EXPECT_EQ(move(viewer, 2.0).at("sceneChanged").at("epoch"), 1);
    }
}

TEST_F(DaemonTest, ADamagedJournalIsReportedAndSetAside) {
    std::ofstream(path("session.db")) << "not a database, whatever else it may have been once";
    Daemon daemon(cornell_box(), {"--journal", path("session.db")});
    EXPECT_TRUE(daemon.says("the journal was damaged"));
    JsonViewer viewer(daemon.port());
    viewer.join();
    EXPECT_EQ(move(viewer, 2.0).at("sceneChanged").at("epoch"), 1);
}

TEST_F(DaemonTest, AJournalThatCannotBeWrittenStopsChangesNotViewing) {
    Daemon daemon(cornell_box(), {"--journal", path("no/such/folder/session.db")});
    EXPECT_TRUE(daemon.says("changes cannot be saved"));
    JsonViewer viewer(daemon.port());
    viewer.join();
    const Json refusal = move(viewer, 2.0);
    ASSERT_TRUE(refusal.contains("error")) << refusal.dump();
    EXPECT_EQ(refusal.at("error").at("code"), "INTERNAL");
    EXPECT_EQ(refusal.dump().find(folder_.string()), std::string::npos) << "no paths in errors";
    EXPECT_TRUE(solves(viewer));
    EXPECT_FALSE(viewer.next_frame([](const Json& frame) { return frame["epoch"] == 0; }).empty());
    EXPECT_NE(http_exchange(daemon.port(),
                            "GET /metrics HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n")
                  .find("raybundle_viewers 1"),
              std::string::npos);
}

/// Status of GET /healthz/..., "200" or "503".
std::string health(const Daemon& daemon, const std::string& what) {
    const std::string answer =
        http_exchange(daemon.port(),
                      "GET /healthz/" + what + " HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
    return answer.substr(std::min<std::size_t>(9, answer.size()), 3);
}

TEST_F(DaemonTest, ASecondServerOnAJournalSaysThatItCannotEditUntilItCan) {
    const std::vector<std::string> options{"--journal", path("session.db")};
    std::optional<Daemon> first(std::in_place, cornell_box(), options);
    Daemon second(cornell_box(), options);
    EXPECT_TRUE(second.says("another server uses it"));
    JsonViewer viewer(second.port());
    viewer.join();
    EXPECT_TRUE(solves(viewer));
    EXPECT_EQ(health(second, "live"), "200");
    // Ready after its first iteration, which may be later than its first frame.
    for (int i = 0; i < 6000 && health(second, "ready") != "200"; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(health(second, "ready"), "200");
    EXPECT_EQ(health(second, "editable"), "503");
    EXPECT_EQ(move(viewer, 2.0).at("error").at("code"), "INTERNAL");
    EXPECT_EQ(first->end(), 0);
    first.reset();
    EXPECT_EQ(move(viewer, 2.3).at("sceneChanged").at("epoch"), 1)
        << "nothing was changed meanwhile";
    EXPECT_EQ(health(second, "editable"), "200");
}

TEST_F(DaemonTest, SigtermSaysGoodbyeAndEndsWithSuccess) {
    Daemon daemon(cornell_box());
    JsonViewer viewer(daemon.port());
    viewer.join();
    RawClient silent(daemon.port());
    daemon.signal(SIGTERM);
    EXPECT_EQ(viewer.close_code(), 1001);
    EXPECT_EQ(daemon.wait(), 0) << "waits for the silent one";
}

TEST_F(DaemonTest, SighupReadsTokensAgainAndWrongSettingsChangeNothing) {
    const std::string first(64, '1');
    const std::string second(64, '2');
    const auto configure = [&](const std::string& token) {
        std::ofstream(path("site.json")) << R"({"tokens":[{"name":"a","role":"EDITOR","sha256":")"
                                         << to_hex(token_digest(token)) << R"("}]})";
    };
    configure(first);
    Daemon daemon(cornell_box(), {"--config", path("site.json")});
    JsonViewer old_viewer(daemon.port());
    EXPECT_EQ(old_viewer.join(first).at("welcome").at("role"), "EDITOR");
    std::ofstream(path("site.json")) << R"({"tokenz":[]})";
    daemon.signal(SIGHUP);
    EXPECT_TRUE(daemon.says("did you mean 'tokens'?"));
    EXPECT_TRUE(old_viewer.request({{"ping", Json::object()}}).contains("pong"));
    configure(second);
    daemon.signal(SIGHUP);
    EXPECT_TRUE(daemon.says("have been read again"));
    EXPECT_EQ(old_viewer.close_code(), 1008);
    EXPECT_TRUE(JsonViewer(daemon.port()).join(first).contains("error"));
    EXPECT_TRUE(JsonViewer(daemon.port()).join(second).contains("welcome"));
}

/// Writes what a base64 data URI holds.
void write_data_uri(const std::string& uri, const std::string& file) {
    const std::string text = uri.substr(uri.find(',') + 1);
    std::string bytes(3 * text.size() / 4, '\0');
    EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                    reinterpret_cast<const unsigned char*>(text.data()),
                    static_cast<int>(text.size()));
    std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(DaemonTest, AReplacedSceneIsServedAndARejectedOneIsNot) {
    fs::copy_file(cornell_box(), path("scene.gltf"));
    Daemon daemon(path("scene.gltf"), {"--watch"});
    JsonViewer viewer(daemon.port());
    EXPECT_TRUE(viewer.join().contains("welcome"));

    std::ofstream(path("broken.gltf")) << R"({"asset":{"version":"2.0"},"scenes":7})";
    fs::rename(path("broken.gltf"), path("scene.gltf"));
    EXPECT_TRUE(daemon.says("the scene stays as it was"));
    EXPECT_EQ(move(viewer, 2.0).at("sceneChanged").at("epoch"), 1) << "the old scene is there";

    Json scene = Json::parse(std::ifstream(cornell_box()));
    for (Json& node : scene["nodes"]) {
        if (node.value("name", "") == "short box") {
            node["name"] = "renamed box";
        }
    }
    Json& uri = scene["buffers"][0]["uri"];
    const std::string buffer = uri.get<std::string>();
    uri = "late.bin";
    std::ofstream(path("new.gltf")) << scene.dump();
    fs::rename(path("new.gltf"), path("scene.gltf"));
    EXPECT_TRUE(daemon.says("late.bin")) << "its buffer is not there yet";
    write_data_uri(buffer, path("late.bin"));
    EXPECT_EQ(viewer.close_code(), 1012);
    JsonViewer again(daemon.port());
    const Json welcome = again.join();
    EXPECT_NE(welcome.dump().find("renamed box"), std::string::npos) << welcome.dump();
    EXPECT_EQ(welcome.at("welcome").at("epoch"), 0);
    EXPECT_TRUE(solves(again));

    // What is not done when the server stops can be asked for again.
    const Json picture = {
        {"width", 640}, {"height", 480}, {"format", "PNG"}, {"relativeError", 1e-3}};
    again.send({{"id", 98}, {"snapshot", picture}});
    again.send({{"id", 99}, {"snapshot", picture}});
    again.request({{"ping", Json::object()}});  // they are there
    daemon.signal(SIGTERM);
    for (const std::uint32_t id : {98U, 99U}) {
        const Json answer = again.answer_to(id);
        ASSERT_TRUE(answer.contains("error")) << answer;
        EXPECT_EQ(answer.at("error").at("code"), "UNAVAILABLE") << answer;
    }
    EXPECT_EQ(daemon.wait(), 0);
}

}  // namespace
}  // namespace raybundle
