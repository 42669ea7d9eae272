// SPDX-License-Identifier: Apache-2.0
// A server that is asked for something before its scene is ready.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "daemon.h"
#include "json_viewer.h"
#include "test_folder.h"

namespace raybundle {
namespace {

/// Servers whose scene never gets ready: as if compiling its shaders took for ever.
class StartTest : public testing::Test {
  protected:
    // NOLINTBEGIN(concurrency-mt-unsafe)
    StartTest() { setenv("RAYBUNDLE_TEST_COMPILES_FOR_EVER", "1", 1); }
    ~StartTest() override { unsetenv("RAYBUNDLE_TEST_COMPILES_FOR_EVER"); }
    // NOLINTEND(concurrency-mt-unsafe)
};

/// Says hello and waits for what comes first.
Json first_message(JsonViewer& viewer) {
    viewer.send({{"id", 1}, {"hello", {{"protocol", "1.0"}}}});
    return viewer.next([](const Json&) { return true; });
}

TEST_F(StartTest, HelloIsAnsweredWithProgressBeforeTheSceneIsReady) {
    const Daemon daemon(scene_file("cornell_box.gltf"));
    JsonViewer viewer(daemon.port());
    Json progress = first_message(viewer);
    while (progress.contains("sceneOpening") &&
           progress["sceneOpening"].at("stage") != "COMPILING") {
        progress = viewer.next([](const Json&) { return true; });
    }
    ASSERT_TRUE(progress.contains("sceneOpening")) << progress.dump();
    EXPECT_FALSE(progress.contains("replyTo")) << "the welcome will be the answer";
    EXPECT_EQ(progress["sceneOpening"].at("name"), "cornell_box.gltf") << "no path";
    EXPECT_EQ(progress["sceneOpening"].at("by"), 0);
    JsonViewer another(daemon.port());
    EXPECT_EQ(first_message(another)["sceneOpening"].at("stage"), "COMPILING");
}

TEST_F(StartTest, SaysAgainThatItPreparesAsLongAsItDoes) {
    const Daemon daemon(scene_file("cornell_box.gltf"));
    JsonViewer viewer(daemon.port());
    first_message(viewer);
    const auto compiling = [](const Json& message) {
        return message.contains("sceneOpening") &&
               message.at("sceneOpening").at("stage") == "COMPILING";
    };
    for (int times = 0; times < 3; ++times) {
        const Json news = viewer.next(compiling);
        EXPECT_EQ(news.at("sceneOpening").at("name"), "cornell_box.gltf") << news.dump();
    }
}

TEST_F(StartTest, EndsAtOnceBeforeTheSceneIsReady) {
    for (const int number : {SIGTERM, SIGINT}) {
        Daemon daemon(scene_file("cornell_box.gltf"));
        JsonViewer viewer(daemon.port());
        EXPECT_TRUE(first_message(viewer).contains("sceneOpening"));
        EXPECT_EQ(daemon.end(number), 0);
        EXPECT_EQ(viewer.close_code(), 1001);
    }
}

TEST_F(StartTest, ReadsItsSettingsAgainBeforeTheSceneIsReady) {
    Daemon daemon(scene_file("cornell_box.gltf"));
    daemon.signal(SIGHUP);
    EXPECT_TRUE(daemon.says("settings have been read again"));
    EXPECT_EQ(daemon.end(), 0);
}

TEST(FirstLineTest, AHangupWhileTheConfigurationIsReadEndsNothing) {
    const TestFolder folder;
    const std::string config = folder.path("config.json");
    ASSERT_EQ(mkfifo(config.c_str(), 0600), 0);
    Daemon daemon(Daemon::Unready{}, scene_file("cornell_box.gltf"), {"--config", config});
    const int file = open(config.c_str(), O_WRONLY | O_CLOEXEC);  // waits for the server to read it
    ASSERT_GE(file, 0);
    daemon.signal(SIGHUP);
    EXPECT_EQ(write(file, "{}", 2), 2);
    close(file);
    ASSERT_NO_THROW(daemon.wait_for_address());
    JsonViewer viewer(daemon.port());
    EXPECT_TRUE(viewer.join().contains("welcome"));
}

TEST(FirstLineTest, AHangupBeforeMainIsAnsweredOnceThereIsAServer) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer wants to be the first library";
#endif
    // NOLINTBEGIN(concurrency-mt-unsafe)
    setenv("LD_PRELOAD", RAYBUNDLE_HANGUP_LIBRARY, 1);
    Daemon daemon(Daemon::Unready{}, scene_file("cornell_box.gltf"), {});
    unsetenv("LD_PRELOAD");
    // NOLINTEND(concurrency-mt-unsafe)
    ASSERT_NO_THROW(daemon.wait_for_address());
    EXPECT_TRUE(daemon.says("settings have been read again"));
    EXPECT_EQ(daemon.end(), 0);
}

}  // namespace
}  // namespace raybundle
