// SPDX-License-Identifier: Apache-2.0
// A folder of scenes: opening, uploading, and everything that must not get in or out that way.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "net/access/access_tokens.h"
#include "test_folder.h"

namespace raybundle {
namespace {

const std::string editor_token(64, '1');
const std::string viewer_token(64, '2');

/// The Cornell box, its short box called by another name.
Json scene_with(const std::string& box) {
    Json scene = Json::parse(std::ifstream(scene_file("cornell_box.gltf")));
    for (Json& node : scene["nodes"]) {
        if (node.value("name", "") == "short box") {
            node["name"] = box;
        }
    }
    return scene;
}

Json scene_that_reads(const std::string& file) {
    Json scene = scene_with("spy");
    scene["images"] = Json::array({{{"uri", file}}});
    scene["textures"] = Json::array({{{"source", 0}}});
    return scene;
}

class ScenesTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TestFolder>();
        outside_ = std::make_unique<TestFolder>();
        outside_->write("secret.gltf", scene_with("secret").dump());
        folder_->write("first.gltf", scene_with("first box").dump());
        folder_->write("second.gltf", scene_with("second box").dump());
        folder_->write("broken.gltf", R"({"asset":{"version":"2.0"},"scenes":7})");
        folder_->write("spy.gltf", scene_that_reads("../../etc/hostname").dump());
        folder_->write("spy link.gltf", scene_that_reads("picture.png").dump());
        folder_->write("notes.txt", "no scene");
        std::filesystem::create_symlink("/etc/hostname", folder_->path("picture.png"));
        std::filesystem::create_symlink(outside_->path("secret.gltf"), folder_->path("link.gltf"));
        std::filesystem::create_directory(folder_->path("folder.gltf"));
        const auto entry = [](const std::string& role, const std::string& token) {
            return Json{{"name", role}, {"role", role}, {"sha256", to_hex(token_digest(token))}};
        };
        outside_->write(
            "site.json",
            Json{{"tokens", {entry("EDITOR", editor_token), entry("VIEWER", viewer_token)}}}
                .dump());
        daemon_ = std::make_unique<Daemon>(
            folder_->path("first.gltf"),
            std::vector<std::string>{"--scenes", folder_->path(), "--config",
                                     outside_->path("site.json"), "--max-upload-megabytes", "1"});
    }
    static void TearDownTestSuite() {
        daemon_.reset();
        folder_.reset();
        outside_.reset();
    }

    static std::string put(const std::string& path, const std::string& body,
                           const std::string& token = editor_token,
                           const std::string& headers = {}) {
        return http_exchange(
            daemon_->port(),
            "PUT " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" +
                (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") + headers +
                "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }

    static std::set<std::string> names(JsonViewer& viewer) {
        std::set<std::string> result;
        const Json answer = viewer.request({{"listScenes", Json::object()}});
        for (const Json& scene : answer.at("sceneList").at("scenes")) {
            result.insert(scene.at("name").get<std::string>());
        }
        return result;
    }

    static Json open(JsonViewer& viewer, const std::string& name) {
        return viewer.request({{"openScene", {{"name", name}}}});
    }

    static std::unique_ptr<TestFolder> folder_, outside_;
    static std::unique_ptr<Daemon> daemon_;
};

std::unique_ptr<TestFolder> ScenesTest::folder_, ScenesTest::outside_;
std::unique_ptr<Daemon> ScenesTest::daemon_;

int status_of(const std::string& answer) {
    return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9)) : 0;
}

std::string stage_of(JsonViewer& viewer) {
    return viewer.next_with("sceneOpening").at("sceneOpening").at("stage");
}

TEST_F(ScenesTest, OpeningTellsEverybodyAndShowsTheOtherScene) {
    JsonViewer editor(daemon_->port());
    EXPECT_EQ(editor.join(editor_token).at("welcome").at("canOpenScenes"), true);
    JsonViewer watching(daemon_->port());
    watching.join(viewer_token);
    EXPECT_EQ(open(editor, "second.gltf").count("ok"), 1U);
    EXPECT_EQ(editor.close_code(), 1012);
    for (const char* stage : {"READING", "PREPARING", "COMPILING", "READY"}) {
        EXPECT_EQ(stage_of(watching), stage);
    }
    EXPECT_EQ(watching.close_code(), 1012);
    JsonViewer again(daemon_->port());
    EXPECT_NE(again.join(editor_token).dump().find("second box"), std::string::npos);
    EXPECT_EQ(again.request({{"listScenes", Json::object()}}).at("sceneList").at("current"),
              "second.gltf");
    EXPECT_FALSE(again.next_frame([](const Json&) { return true; }).empty());
    // By now it is known how long scenes take.
    JsonViewer later(daemon_->port());
    later.join(viewer_token);
    EXPECT_EQ(open(again, "second.gltf").count("ok"), 1U);
    const Json foreseen = later.next_with("sceneOpening").at("sceneOpening");
    EXPECT_GT(foreseen.value("secondsLeft", 0.0), 0.0) << foreseen.dump();
    // Whoever joins before those of the former scene are gone is sent away with them.
    EXPECT_EQ(again.close_code(), 1012);
}

TEST_F(ScenesTest, ARejectedSceneChangesNothing) {
    JsonViewer editor(daemon_->port());
    const std::string before = editor.join(editor_token).at("welcome").at("scene").dump();
    JsonViewer watching(daemon_->port());
    watching.join(viewer_token);
    for (const char* name : {"broken.gltf", "spy.gltf", "spy link.gltf"}) {
        const Json answer = open(editor, name);
        EXPECT_EQ(answer.at("error").at("code"), "INVALID_ARGUMENT") << answer.dump();
        EXPECT_EQ(answer.dump().find(folder_->path()), std::string::npos) << answer.dump();
        EXPECT_EQ(stage_of(watching), "READING");
        const Json progress = watching.next_with("sceneOpening").at("sceneOpening");
        EXPECT_EQ(progress.at("stage"), "REJECTED");
        EXPECT_FALSE(progress.at("reason").get<std::string>().empty());
    }
    JsonViewer late(daemon_->port());
    EXPECT_EQ(late.join(editor_token).at("welcome").at("scene").dump(), before);
    EXPECT_TRUE(editor.request({{"ping", Json::object()}}).contains("pong")) << "still connected";
}

TEST_F(ScenesTest, OnlyEditorsOpenAndOnlyPlainFilesOfTheFolder) {
    JsonViewer editor(daemon_->port());
    editor.join(editor_token);
    const std::set<std::string> listed = names(editor);
    for (const char* name : {"first.gltf", "second.gltf", "broken.gltf"}) {
        EXPECT_TRUE(listed.contains(name)) << name;
    }
    for (const char* name : {"link.gltf", "notes.txt", "folder.gltf", "picture.png"}) {
        EXPECT_FALSE(listed.contains(name)) << name;
    }
    for (const char* name : {"link.gltf", "folder.gltf", "missing.glb"}) {
        EXPECT_EQ(open(editor, name).at("error").at("code"), "NOT_FOUND") << name;
    }
    const std::string up =
        "../" + std::filesystem::path(outside_->path()).parent_path().filename().string();
    for (const std::string& name :
         {up + "/secret.gltf", outside_->path("secret.gltf"), std::string("..%2fsecret.gltf"),
          std::string("..\\secret.gltf"), std::string(".hidden.gltf"), std::string("a\nb.gltf"),
          std::string(), std::string("notes.txt"), std::string(200, 'a') + ".glb"}) {
        EXPECT_EQ(open(editor, name).at("error").at("code"), "INVALID_ARGUMENT") << name;
    }
    JsonViewer viewer(daemon_->port());
    viewer.join(viewer_token);
    EXPECT_EQ(open(viewer, "first.gltf").at("error").at("code"), "PERMISSION_DENIED");
    EXPECT_EQ(viewer.request({{"listScenes", Json::object()}}).at("error").at("code"),
              "PERMISSION_DENIED");
}

TEST_F(ScenesTest, AnUploadIsCheckedStoredAndCanBeOpened) {
    const std::string name = "/scenes/B%C3%BCro%202.glb";
    EXPECT_EQ(status_of(put(name, to_glb(scene_with("uploaded box")))), 201);
    EXPECT_EQ(status_of(put(name, to_glb(scene_with("better box")))), 200) << "replaced";
    const std::size_t files = folder_->files();
    const std::string rejected = put(name, "glTF, as it says, but not really");
    EXPECT_EQ(status_of(rejected), 422) << rejected;
    EXPECT_NE(rejected.find("Rejected: "), std::string::npos) << rejected;
    EXPECT_EQ(rejected.find(folder_->path()), std::string::npos) << rejected;
    EXPECT_EQ(status_of(put("/scenes/spy.glb", to_glb(scene_that_reads("../../etc/hostname")))),
              422);
    EXPECT_EQ(folder_->files(), files) << "nothing stays of what was rejected";
    JsonViewer editor(daemon_->port());
    editor.join(editor_token);
    EXPECT_TRUE(names(editor).contains("Büro 2.glb"));
    EXPECT_TRUE(open(editor, "Büro 2.glb").contains("ok"));
    EXPECT_EQ(editor.close_code(), 1012);
    JsonViewer again(daemon_->port());
    EXPECT_NE(again.join(editor_token).dump().find("better box"), std::string::npos);
}

TEST_F(ScenesTest, WhatMayNotBeUploadedIsRefusedBeforeItIsRead) {
    const std::string scene = to_glb(scene_with("box"));
    const std::size_t files = folder_->files();
    EXPECT_EQ(status_of(put("/scenes/a.glb", scene, "")), 401);
    EXPECT_EQ(status_of(put("/scenes/a.glb", scene, std::string(64, '3'))), 401);
    EXPECT_EQ(status_of(put("/scenes/a.glb", scene, viewer_token)), 403);
    EXPECT_EQ(status_of(put("/scenes/a.glb", scene, editor_token,
                            "Origin: https://elsewhere.example\r\n")),
              403);
    EXPECT_EQ(status_of(put("/scenes/a.gltf", scene)), 400);
    EXPECT_EQ(status_of(put("/scenes/.a.glb", scene)), 400);
    EXPECT_EQ(status_of(put("/a.glb", scene)), 405);
    EXPECT_EQ(status_of(put("/scenes/a.glb", "")), 411);
    for (const char* path : {"/scenes/..%2fa.glb", "/scenes/%2e%2e%2fa.glb", "/scenes/sub%2fa.glb",
                             "/scenes/..%5ca.glb", "/scenes/%252e%252e%252fa.glb",
                             "/scenes/../a.glb", "/scenes/a%00.glb", "//scenes/a.glb/"}) {
        const int status = status_of(put(path, scene));
        EXPECT_TRUE(status == 0 || status >= 400) << path << ": " << status;
    }
    const std::string large = http_exchange(
        daemon_->port(), "PUT /scenes/a.glb HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer " +
                             editor_token + "\r\nContent-Length: 1000001\r\n\r\n");
    EXPECT_EQ(status_of(large), 413);
    EXPECT_EQ(folder_->files(), files);
    std::filesystem::path parent =
        std::filesystem::path(folder_->path()).parent_path().parent_path();
    EXPECT_FALSE(std::filesystem::exists(parent / "a.glb"));
}

TEST_F(ScenesTest, AnUploadThatBreaksOffLeavesNothing) {
    const std::size_t files = folder_->files();
    {
        RawClient client(daemon_->port());
        client.send("PUT /scenes/half.glb HTTP/1.1\r\nHost: a\r\nAuthorization: Bearer " +
                    editor_token + "\r\nContent-Length: 100000\r\n\r\nglTF");
        for (int i = 0; i < 15000 && folder_->files() == files; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        EXPECT_EQ(folder_->files(), files + 1) << "it is being written";
        client.reset();
    }
    for (int i = 0; i < 15000 && folder_->files() > files; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(folder_->files(), files);
}

TEST(ScenesOverARestart, TheOneThatWasOpenedIsShownAgainAsItWas) {
    const TestFolder folder;
    folder.write("first.gltf", scene_with("first box").dump());
    folder.write("second.gltf", scene_with("second box").dump());
    const std::vector<std::string> options{"--scenes", folder.path(), "--journal",
                                           folder.path("session.db")};
    const Json move = {{"moveObject", {{"object", 2}, {"transform", Json::object()}}}};
    {
        Daemon daemon(folder.path("first.gltf"), options);
        JsonViewer viewer(daemon.port());
        viewer.join();
        EXPECT_TRUE(viewer.request(move).contains("sceneChanged"));
        EXPECT_TRUE(viewer.request({{"openScene", {{"name", "second.gltf"}}}}).contains("ok"));
        EXPECT_EQ(viewer.close_code(), 1012);
        JsonViewer again(daemon.port());
        EXPECT_EQ(again.join().at("welcome").at("epoch"), 0) << "a session of its own";
        again.request(move);
        EXPECT_EQ(again.request(move).at("sceneChanged").at("epoch"), 2);
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    {
        Daemon daemon(folder.path("first.gltf"), options);
        JsonViewer viewer(daemon.port());
        const Json welcome = viewer.join().at("welcome");
        EXPECT_EQ(welcome.at("epoch"), 2);
        EXPECT_NE(welcome.dump().find("second box"), std::string::npos);
        EXPECT_TRUE(viewer.request({{"openScene", {{"name", "first.gltf"}}}}).contains("ok"));
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL) << "as soon as it has said so";
    }
    {
        Daemon daemon(folder.path("first.gltf"), options);
        JsonViewer viewer(daemon.port());
        EXPECT_EQ(viewer.join().at("welcome").at("epoch"), 1) << "the first session goes on";
        EXPECT_TRUE(viewer.request({{"openScene", {{"name", "second.gltf"}}}}).contains("ok"));
        EXPECT_EQ(viewer.close_code(), 1012);
        JsonViewer again(daemon.port());
        EXPECT_EQ(again.join().at("welcome").at("epoch"), 2) << "and the second";
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    std::filesystem::remove(folder.path("first.gltf"));
    Daemon daemon(folder.path("second.gltf"), options);
    JsonViewer viewer(daemon.port());
    EXPECT_EQ(viewer.join().at("welcome").at("epoch"), 2) << "another configuration counts";
}

TEST(ScenesOverARestart, AreShownAsTheyWereWithoutAWordOfJournals) {
    const TestFolder folder;
    const TestFolder state;
    setenv("XDG_STATE_HOME", state.path().c_str(), 1);
    folder.write("first.gltf", scene_with("first box").dump());
    folder.write("second.gltf", scene_with("second box").dump());
    const std::vector<std::string> options{"--scenes", folder.path()};
    const Json move = {{"moveObject", {{"object", 2}, {"transform", Json::object()}}}};
    {
        Daemon daemon(folder.path("first.gltf"), options);
        EXPECT_TRUE(daemon.says("changes and pins are saved in " + state.path("raybundle/")));
        JsonViewer viewer(daemon.port());
        EXPECT_EQ(viewer.join().at("welcome").at("saving"), "SAVED");
        EXPECT_TRUE(viewer.request({{"openScene", {{"name", "second.gltf"}}}}).contains("ok"));
        EXPECT_EQ(viewer.close_code(), 1012);
        JsonViewer again(daemon.port());
        again.join();
        EXPECT_TRUE(again.request(move).contains("sceneChanged"));
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    {
        Daemon daemon(folder.path("first.gltf"), options);
        JsonViewer viewer(daemon.port());
        const Json welcome = viewer.join().at("welcome");
        EXPECT_EQ(welcome.at("epoch"), 1);
        EXPECT_NE(welcome.dump().find("second box"), std::string::npos);
        EXPECT_EQ(daemon.end(SIGKILL), -SIGKILL);
    }
    Daemon daemon(folder.path("first.gltf"), {"--journal", "none"});
    EXPECT_TRUE(daemon.says("not saved"));
    JsonViewer viewer(daemon.port());
    const Json welcome = viewer.join().at("welcome");
    EXPECT_EQ(welcome.at("epoch"), 0);
    EXPECT_EQ(welcome.at("saving"), "NOT_SAVED");
    unsetenv("XDG_STATE_HOME");
}

TEST(ScenesWithoutAFolder, AreRefused) {
    Daemon daemon(scene_file("cornell_box.gltf"));
    JsonViewer viewer(daemon.port());
    EXPECT_EQ(viewer.join().at("welcome").at("canOpenScenes"), false);
    EXPECT_EQ(viewer.request({{"openScene", {{"name", "a.glb"}}}}).at("error").at("code"),
              "NOT_FOUND");
    EXPECT_EQ(status_of(http_exchange(daemon.port(),
                                      "PUT /scenes/a.glb HTTP/1.1\r\nHost: a\r\nConnection: "
                                      "close\r\nContent-Length: 4\r\n\r\nglTF")),
              405);
}

}  // namespace
}  // namespace raybundle
