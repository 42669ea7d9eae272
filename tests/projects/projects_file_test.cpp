// SPDX-License-Identifier: Apache-2.0
// What `raybundle projects` is told.
#include "options/projects_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "test_folder.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

class ProjectsFile : public testing::Test {
  protected:
    ProjectsConfig read(const std::string& text) {
        folder_.write("projects.json", text);
        options_.projects.source = folder_.path("projects.json");
        return read_projects(options_);
    }
    std::string problem(const std::string& text) {
        try {
            read(text);
            return {};
        } catch (const UsageError& error) {
            return std::string(error.what()).substr(options_.projects.source.size() + 2);
        }
    }

    TestFolder folder_;
    Options options_;
};

TEST_F(ProjectsFile, NamesProjectsAndWhatIsOfAll) {
    options_.config.on_command_line = {"listen"};
    options_.network.listen = "127.0.0.1:0";
    const ProjectsConfig config = read(R"({"listen":"0.0.0.0:80","sleepAfterSeconds":5,
        "memoryMegabytes":4000,"state":"/s","logFormat":"json",
        "defaults":{"maxViewers":8,"memoryMegabytes":500},
        "projects":{"b":{"scene":"b.glb","title":"B","maxViewers":2},"a":{"scene":"a.glb"}}})");
    EXPECT_EQ(config.front.network.listen, "127.0.0.1:0") << "the command line wins";
    EXPECT_EQ(config.front.projects.sleep_after_s, 5.0);
    EXPECT_EQ(config.front.projects.memory_megabytes, 4000);
    ASSERT_EQ(config.projects.size(), 2U);
    EXPECT_EQ(config.projects[0].title, "B");
    EXPECT_EQ(config.projects[0].serve.serve.max_viewers, 2);
    EXPECT_EQ(config.projects[1].serve.serve.max_viewers, 8);
    EXPECT_EQ(config.projects[1].memory_megabytes, 500);

    const AccessToken watch{"front", v1::VIEWER, {}};
    const Json served =
        Json::parse(server_config(config.projects[1], config.front, "/s/a", &watch));
    EXPECT_EQ(served["listen"], "127.0.0.1:0");
    EXPECT_EQ(served["journal"], "/s/a/journal.db");
    EXPECT_EQ(served["trustedProxies"], Json({"127.0.0.1"}));
    EXPECT_EQ(served["logFormat"], "json");
    EXPECT_EQ(served["tokens"][0]["role"], "VIEWER");
    EXPECT_FALSE(served.contains("memoryMegabytes"));
}

TEST_F(ProjectsFile, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(problem(R"({})"), "projects: must be an object with a project by its name");
    EXPECT_EQ(problem(R"({"projects":{"a":{}}})"), "projects.a: needs a scene");
    EXPECT_EQ(problem(R"({"projects":{"a":{"scene":"x","maxViewer":1}}})"),
              "projects.a: maxViewer: unknown key, did you mean 'maxViewers'?");
    EXPECT_EQ(problem(R"({"projects":{"a":{"scene":"x","listen":"h:1"}}})"),
              "projects.a: listen: is of all projects, not of one");
    EXPECT_EQ(problem(R"({"projects":{"a":{"scene":"x","memoryMegabytes":-1}}})"),
              "projects.a: memoryMegabytes: must be a number from 0 to 1000000000");
    EXPECT_EQ(problem(R"({"sleepAfterSeconds":"1","projects":{}})"),
              "sleepAfterSeconds: must be a number from 0 to 1000000000");
    EXPECT_EQ(problem(R"({"scene":"x","projects":{}})"), "scene: unknown key");
    EXPECT_EQ(problem(R"({"projects":{"a":{"scene":"x"},"a":{"scene":"y"}}})"),
              "a: is there twice");
}

TEST_F(ProjectsFile, AFolderHasAProjectForEachScene) {
    folder_.write("b.gltf", "");
    folder_.write("a.glb", "");
    folder_.write("a.bin", "");
    options_.projects.source = folder_.path();
    const ProjectsConfig config = read_projects(options_);
    ASSERT_EQ(config.projects.size(), 2U);
    EXPECT_EQ(config.projects[0].name, "a");
    EXPECT_EQ(config.projects[0].serve.scene.file, folder_.path("a.glb"));
    folder_.write("a.gltf", "");
    EXPECT_THROW(read_projects(options_), UsageError);
}

}  // namespace
}  // namespace raybundle
