// SPDX-License-Identifier: Apache-2.0
// Many projects behind one address: the front and its servers as they run in production.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "daemon.h"
#include "json_viewer.h"
#include "net/access/access_tokens.h"
#include "test_folder.h"

namespace raybundle {
namespace {

/// Waits for a state, however long that takes: ctest ends what never comes.
void wait_until(const std::function<bool()>& reached) {
    while (!reached()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

Json token_entry(const std::string& token, const std::string& role = "EDITOR") {
    return {{"name", token}, {"role", role}, {"sha256", to_hex(token_digest(token))}};
}

/// A front with its projects. Nobody's token is another's.
class ProjectsTest : public testing::Test {
  protected:
    struct Answer {
        int status = 0;
        std::string head, body;
        [[nodiscard]] Json json() const { return Json::parse(body, nullptr, false); }
    };

    explicit ProjectsTest(double sleep_after_s = 1e6) {
        config_ = {{"listen", "127.0.0.1:0"},
                   {"state", folder_.path("state")},
                   {"sleepAfterSeconds", sleep_after_s},
                   {"projects",
                    {{"box",
                      {{"scene", scene_file("cornell_box.gltf")},
                       {"title", "The box"},
                       {"maxViewers", 1}}}}}};
    }

    void add_project(const std::string& name, const std::string& token) {
        config_["projects"][name] = {{"scene", scene_file("effects/punctual_lights.gltf")},
                                     {"title", "Secret"},
                                     {"tokens", {token_entry(token)}}};
    }

    void write_config() { folder_.write("projects.json", config_.dump()); }

    Daemon& start() {
        write_config();
        front_ =
            std::make_unique<Daemon>(Daemon::Command{{"projects", folder_.path("projects.json")}});
        return *front_;
    }

    [[nodiscard]] Answer ask(const std::string& line, const std::string& headers = "") const {
        const std::string text = http_exchange(
            front_->port(), line + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + headers + "\r\n");
        const std::size_t end = text.find("\r\n\r\n");
        if (end == std::string::npos) {
            return {};
        }
        return {std::stoi(text.substr(9, 3)), text.substr(0, end), text.substr(end + 4)};
    }

    /// What the list says of a project.
    [[nodiscard]] Json listed(const std::string& name, const std::string& headers = "") const {
        const Json projects = ask("GET /projects.json", headers).json().at("projects");
        for (const Json& project : projects) {
            if (project.at("name") == name) {
                return project;
            }
        }
        return Json::object();
    }
    [[nodiscard]] std::string state(const std::string& name) const {
        return listed(name).value("state", "");
    }

    /// Processes of the front's servers.
    [[nodiscard]] std::vector<pid_t> servers() const {
        const std::string id = std::to_string(front_->process());
        std::ifstream children("/proc/" + id + "/task/" + id + "/children");
        std::vector<pid_t> result;
        for (pid_t process = 0; children >> process;) {
            result.push_back(process);
        }
        return result;
    }

    TestFolder folder_;
    Json config_;
    std::unique_ptr<Daemon> front_;
};

class SleepyProjectsTest : public ProjectsTest {
  protected:
    SleepyProjectsTest() : ProjectsTest(0.01) {}
};

/// "T" of a process that is stopped, "R" of one that runs ...
std::string process_state(pid_t process) {
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::stringstream text;
    text << stat.rdbuf();
    return text.str().substr(text.str().rfind(')') + 2, 1);
}

std::string pin_texts(const Json& welcome) {
    std::string texts;
    for (const Json& pin : welcome.at("pins")) {
        texts += pin.at("text").get<std::string>() + " ";
    }
    return texts;
}

Json pin(const std::string& text) {
    return {{"addPin", {{"text", text}, {"position", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}}}}}};
}

TEST_F(ProjectsTest, ListsProjectsAndWakesThoseThatAreVisited) {
    add_project("lamps", "lamps-token");
    start();
    EXPECT_EQ(state("box"), "OFF");
    EXPECT_EQ(listed("box").at("title"), "The box");
    EXPECT_EQ(listed("lamps").at("title"), "lamps") << "the title needs a token";
    EXPECT_FALSE(listed("lamps").contains("people"));
    EXPECT_TRUE(servers().empty()) << "nobody has been there";
    EXPECT_NE(ask("GET /").body.find("projects.js"), std::string::npos);
    EXPECT_EQ(ask("GET /projects/projects.js").status, 200);
    EXPECT_EQ(ask("GET /healthz").status, 200);
    EXPECT_EQ(ask("GET /p/box/healthz").body, "asleep\n") << "a probe wakes nobody";
    EXPECT_EQ(state("box"), "OFF");
    EXPECT_EQ(ask("GET /p/nothing/").status, 404);
    EXPECT_NE(ask("GET /p/box").head.find("location: box/"), std::string::npos);

    EXPECT_NE(ask("GET /p/box/").body.find("main.js"), std::string::npos);
    JsonViewer viewer(front_->port(), "/p/box/ws");
    EXPECT_EQ(viewer.join({}, 32, 24).at("welcome").at("scene").at("name"), "cornell_box");
    EXPECT_FALSE(viewer.next_frame([](const Json&) { return true; }).empty());
    wait_until([&] { return listed("box").at("people") == Json({"test"}); });
    EXPECT_EQ(state("box"), "AWAKE");
    EXPECT_EQ(state("lamps"), "OFF");
    wait_until([&] { return listed("box").at("memoryBytes") > 0; });
    const std::string figures = ask("GET /metrics").body;
    EXPECT_NE(figures.find("raybundle_viewers{project=\"box\"} 1\n"), std::string::npos);
    EXPECT_NE(figures.find("raybundle_project_awake{project=\"lamps\"} 0\n"), std::string::npos);

    JsonViewer second(front_->port(), "/p/box/ws");
    EXPECT_EQ(second.join({}, 32, 24).at("error").at("code"), "RESOURCE_EXHAUSTED")
        << "one viewer is the limit of this project";

    EXPECT_EQ(front_->end(SIGTERM), 0);
    EXPECT_EQ(viewer.close_code(), 1001);
}

TEST_F(ProjectsTest, TokensAndChangesAreEachProjectsOwn) {
    add_project("lamps", "lamps-token");
    add_project("other", "other-token");
    config_["tokens"] = Json::array({token_entry("list-token", "VIEWER")});
    start();
    EXPECT_EQ(ask("GET /projects.json").status, 401);
    const std::string header = "Authorization: Bearer list-token\r\n";
    EXPECT_EQ(listed("lamps", header).at("title"), "Secret");

    JsonViewer stranger(front_->port(), "/p/lamps/ws");
    EXPECT_EQ(stranger.join("other-token", 32, 24).at("error").at("code"), "UNAUTHENTICATED");
    JsonViewer lister(front_->port(), "/p/lamps/ws");
    EXPECT_EQ(lister.join("list-token", 32, 24).at("error").at("code"), "UNAUTHENTICATED");
    JsonViewer lamps(front_->port(), "/p/lamps/ws");
    EXPECT_EQ(lamps.join("lamps-token", 32, 24).at("welcome").at("role"), "EDITOR");
    JsonViewer other(front_->port(), "/p/other/ws");
    EXPECT_EQ(other.join("other-token", 32, 24).at("welcome").at("epoch"), 0);
    EXPECT_EQ(lamps.request(pin("in lamps")).at("pinChanged").at("text"), "in lamps");
    // The same scene file, and another project.
    JsonViewer again(front_->port(), "/p/other/ws");
    EXPECT_EQ(pin_texts(again.join("other-token", 32, 24).at("welcome")), "");
    JsonViewer there(front_->port(), "/p/lamps/ws");
    EXPECT_EQ(pin_texts(there.join("lamps-token", 32, 24).at("welcome")), "in lamps ");
    wait_until([&] { return listed("lamps", header).at("people").size() == 2; });

    // A second request on a connection is never answered, by another project least of all.
    const std::string two =
        http_exchange(front_->port(),
                      "GET /p/lamps/healthz/live HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
                      "GET /p/other/healthz/live HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_EQ(two.find("HTTP/1.1", 1), std::string::npos) << two;
    EXPECT_TRUE(two.ends_with("live\n")) << two;
}

TEST_F(SleepyProjectsTest, SleepWithoutProcessorTimeAndAnswerAVisit) {
    start();
    {
        JsonViewer viewer(front_->port(), "/p/box/ws");
        EXPECT_TRUE(viewer.join({}, 32, 24).contains("welcome"));
        EXPECT_EQ(viewer.request(pin("kept")).at("pinChanged").at("text"), "kept");
        wait_until([&] { return listed("box").at("people") == Json({"test"}); });
    }
    wait_until([&] { return state("box") == "ASLEEP"; });
    ASSERT_EQ(servers().size(), 1U);
    EXPECT_EQ(process_state(servers()[0]), "T");
    EXPECT_EQ(listed("box").at("people"), Json::array());
    const Answer picture = ask("GET /" + listed("box").at("picture").get<std::string>());
    EXPECT_TRUE(picture.body.starts_with("\x89PNG")) << picture.head;
    EXPECT_EQ(ask("GET /p/box/metrics").status, 503);
    EXPECT_EQ(state("box"), "ASLEEP");

    JsonViewer viewer(front_->port(), "/p/box/ws");
    EXPECT_EQ(pin_texts(viewer.join({}, 32, 24).at("welcome")), "kept ");
    EXPECT_EQ(state("box"), "AWAKE");
    EXPECT_NE(process_state(servers()[0]), "T");
}

TEST_F(SleepyProjectsTest, HeavyEndWhereMemoryIsShortAndComeBackWithTheirPins) {
    // Less than one server has, so that nobody stays asleep, and more than none: somebody may
    // start.
    config_["memoryMegabytes"] = 1;
    start();
    {
        JsonViewer viewer(front_->port(), "/p/box/ws");
        viewer.join({}, 32, 24);
        EXPECT_EQ(viewer.request(pin("kept")).at("pinChanged").at("text"), "kept");
    }
    wait_until([&] { return state("box") == "OFF"; });
    EXPECT_TRUE(servers().empty());
    JsonViewer viewer(front_->port(), "/p/box/ws");
    EXPECT_EQ(pin_texts(viewer.join({}, 32, 24).at("welcome")), "kept ");
}

TEST_F(ProjectsTest, AServerThatWasKilledComesBackWithItsEdits) {
    config_["projects"]["box"]["maxViewers"] = 8;
    config_["projects"]["broken"] = {{"scene", folder_.path("absent.gltf")}};
    start();
    JsonViewer viewer(front_->port(), "/p/box/ws");
    viewer.join({}, 32, 24);
    EXPECT_EQ(viewer.request(pin("kept")).at("pinChanged").at("text"), "kept");
    const std::vector<pid_t> before = servers();
    ASSERT_EQ(before.size(), 1U);
    kill(before[0], SIGKILL);
    EXPECT_EQ(viewer.close_code(), 0) << "the connection ends, and says nothing";
    JsonViewer again(front_->port(), "/p/box/ws");
    EXPECT_EQ(pin_texts(again.join({}, 32, 24).at("welcome")), "kept ");
    ASSERT_EQ(servers().size(), 1U);
    EXPECT_NE(servers(), before);
    EXPECT_NE(ask("GET /metrics").body.find("raybundle_project_starts_total{project=\"box\"} 2\n"),
              std::string::npos);

    // One that cannot be loaded says so, and is no trouble to the others.
    wait_until([&] { return ask("GET /p/broken/").status == 503; });
    EXPECT_EQ(state("broken"), "FAILED");
    // Once it has failed nobody gets a page of which half is missing.
    EXPECT_EQ(ask("GET /p/broken/").status, 503);
    wait_until([&] {
        const Answer page = ask("GET /p/broken/", "Accept: text/html\r\n");
        return page.body.find("its scene is not accepted") != std::string::npos &&
               page.body.find("http-equiv=\"refresh\"") != std::string::npos;
    });
    EXPECT_TRUE(front_->says("broken: "));
    EXPECT_EQ(ask("GET /p/box/healthz/live").body, "live\n");
}

TEST_F(ProjectsTest, HeavySettingsAreReadAgain) {
    config_["projects"]["box"]["maxViewers"] = 8;
    start();
    JsonViewer viewer(front_->port(), "/p/box/ws");
    viewer.join({}, 32, 24);
    config_["projects"]["box"]["tokens"] = Json::array({token_entry("box-token")});
    add_project("lamps", "lamps-token");
    write_config();
    front_->signal(SIGHUP);
    EXPECT_EQ(viewer.close_code(), 1008) << "the token that it has is not known any more";
    EXPECT_EQ(state("lamps"), "OFF");
    JsonViewer known(front_->port(), "/p/box/ws");
    EXPECT_TRUE(known.join("box-token", 32, 24).contains("welcome"));
    config_["projects"].erase("box");
    write_config();
    front_->signal(SIGHUP);
    EXPECT_EQ(known.close_code(), 1001);
    wait_until([&] { return servers().empty(); });
    EXPECT_EQ(ask("GET /p/box/").status, 404);
    config_["projects"]["lamps"]["maxViewer"] = 1;
    write_config();
    front_->signal(SIGHUP);
    EXPECT_TRUE(front_->says("settings stay as they were"));
    EXPECT_EQ(state("lamps"), "OFF");
    EXPECT_EQ(front_->end(SIGTERM), 0);
}

TEST_F(ProjectsTest, MisshapenRequestsReachNoServer) {
    start();
    EXPECT_EQ(ask("GET /p/box/", "Transfer-Encoding: chunked\r\n").status, 411);
    EXPECT_EQ(ask("GET /p/box/", "Content-Length: 1\r\nContent-Length: 2\r\n").status, 400);
    EXPECT_EQ(ask("GET /", "X: " + std::string(40000, 'x') + "\r\n").status, 431);
    EXPECT_EQ(ask("POST /projects.json").status, 405);
    EXPECT_EQ(ask("GET /../../etc/passwd").status, 404);
    RawClient half(front_->port());
    half.send("GET /p/box/ HTTP/1.1\r\nHo");
    EXPECT_EQ(state("box"), "OFF");
    EXPECT_TRUE(servers().empty());
    EXPECT_EQ(front_->end(SIGTERM), 0) << "who has not said what he wants holds nobody up";
}

}  // namespace
}  // namespace raybundle
