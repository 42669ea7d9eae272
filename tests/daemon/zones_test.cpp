// SPDX-License-Identifier: Apache-2.0
// What is kept with a project: zones and what is required of them, threads of pins; glare on the
// wire; the documents that are made of it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "daemon.h"
#include "json_viewer.h"
#include "net/access/access_tokens.h"
#include "report/print_pdf.h"
#include "report/zip_file.h"
#include "test_folder.h"

namespace raybundle {
namespace {

Json place(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

Json zone(const std::string& name, double above = 3.0) {
    return {{"measure",
             {{"quantity", "HORIZONTAL"},
              {"outline", {place(1, above, 1), place(4, above, 1), place(4, above, 4)}},
              {"columns", 4},
              {"rows", 4},
              {"keep", true},
              {"relativeError", 0.5},
              {"name", name}}}};
}

struct Http {
    int status = 0;
    std::string head, body;
};

Http http(std::uint16_t port, const std::string& line, const std::string& body = {}) {
    RawClient client(port);
    client.send(line + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\n" +
                (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") +
                "\r\n" + body);
    const std::string all = client.read_all();
    const std::size_t end = all.find("\r\n\r\n");
    Http answer;
    answer.head = all.substr(0, end);
    answer.body = end == std::string::npos ? "" : all.substr(end + 4);
    answer.status = all.size() > 12 ? std::atoi(all.substr(9, 3).c_str()) : 0;
    return answer;
}

const Json* zone_named(const Json& zones, const std::string& name) {
    for (const Json& one : zones) {
        if (one.value("name", "") == name) {
            return &one;
        }
    }
    return nullptr;
}

TEST(Zones, AreThereAgainAfterARestartAndSeenByEverybody) {
    const TestFolder folder;
    const std::vector<std::string> options = {"--journal", folder.path("journal.db")};
    {
        Daemon daemon(scene_file("cornell_box.gltf"), options);
        JsonViewer maker(daemon.port());
        maker.join();
        JsonViewer other(daemon.port());
        const Json welcome = other.join();
        EXPECT_GE(welcome.at("welcome").at("requirements").size(), 4U);
        const Json answer = maker.request(zone("desk"));
        ASSERT_TRUE(answer.contains("measured")) << answer;
        const Json& made = answer["measured"];
        EXPECT_EQ(made["name"], "desk");
        EXPECT_GT(made["points"].size(), 4U);  // those of 16 that the triangle holds
        EXPECT_LT(made["points"].size(), 14U);
        EXPECT_EQ(made["outline"].size(), 3U);
        const Json heard = other.next([](const Json& message) {
            return message.contains("measured") && message["measured"].contains("mean");
        });
        EXPECT_EQ(heard["measured"]["name"], "desk");

        // Cornell's light is dim: 20 lx are met, 500 are missed.
        const auto require = [&](double mean) {
            return maker.request(
                {{"setRequirement", {{"requirement", {{"name", "task"}, {"mean", mean}}}}}});
        };
        ASSERT_TRUE(require(20.0).contains("ok"));
        ASSERT_TRUE(maker
                        .request({{"setZone",
                                   {{"measurement", made["measurement"]},
                                    {"requirement", "task"},
                                    {"name", "table"}}}})
                        .contains("ok"));
        const auto verdict = [&](const std::string& wanted) {
            return other.next([&](const Json& message) {
                return message.contains("measured") &&
                       message["measured"].value("verdict", "") == wanted;
            });
        };
        const Json met = verdict("MET");
        ASSERT_TRUE(met.contains("measured"));
        EXPECT_EQ(met["measured"]["name"], "table");
        EXPECT_EQ(met["measured"]["checks"][0]["what"], "Em");
        ASSERT_TRUE(require(5000.0).contains("ok"));
        EXPECT_TRUE(verdict("MISSED").contains("measured"));
        EXPECT_EQ(maker
                      .request({{"setZone",
                                 {{"measurement", made["measurement"]}, {"requirement", "none"}}}})
                      .at("error")
                      .at("code"),
                  "NOT_FOUND");
        daemon.end(SIGKILL);
    }
    Daemon daemon(scene_file("cornell_box.gltf"), options);
    JsonViewer viewer(daemon.port());
    const Json welcome = viewer.join().at("welcome");
    const Json* const kept = zone_named(welcome.at("zones"), "table");
    ASSERT_NE(kept, nullptr) << welcome.at("zones");
    EXPECT_EQ(kept->value("requirement", ""), "task");
    const Json again = viewer.next([](const Json& message) {
        return message.contains("measured") && message["measured"].contains("mean");
    });
    EXPECT_EQ(again["measured"]["verdict"], "MISSED");
    const Json removed = viewer.request(
        {{"removeMeasurement", {{"measurement", again["measured"]["measurement"]}}}});
    EXPECT_TRUE(removed.contains("ok")) << removed;
    JsonViewer late(daemon.port());
    EXPECT_EQ(zone_named(late.join().at("welcome").at("zones"), "table"), nullptr);
}

/// A row has Ez, which is no semicylindrical illuminance: nothing is compared.
TEST(Zones, WithoutAMatchingQuantityThereIsNoVerdict) {
    Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", "none"});
    JsonViewer viewer(daemon.port());
    viewer.join();
    const auto measured = [&](const std::string& quantity) {
        Json asked = zone(quantity);
        asked["measure"]["quantity"] = quantity;
        asked["measure"]["direction"] = place(1, 0, 0);
        asked["measure"]["requirement"] = "Corridor";
        return viewer.request(asked).at("measured");
    };
    const Json cylindrical = measured("CYLINDRICAL");
    ASSERT_EQ(cylindrical.value("checks", Json::array()).size(), 1U) << cylindrical;
    EXPECT_EQ(cylindrical["checks"][0]["what"], "Ez");
    const Json half = measured("SEMICYLINDRICAL");
    EXPECT_EQ(half["requirement"], "Corridor");
    EXPECT_EQ(half.value("checks", Json::array()).size(), 0U) << half;
    EXPECT_EQ(half.value("verdict", "VERDICT_UNSPECIFIED"), "VERDICT_UNSPECIFIED");
}

TEST(Zones, OnlyReviewersKeepThem) {
    const std::string look = "a-token-of-those-who-look-0123456789";
    const TestFolder folder;
    folder.write(
        "site.json",
        Json{{"tokens",
              {{{"name", "a"}, {"role", "VIEWER"}, {"sha256", to_hex(token_digest(look))}}}}}
            .dump());
    Daemon daemon(scene_file("cornell_box.gltf"),
                  {"--journal", "none", "--config", folder.path("site.json")});
    JsonViewer viewer(daemon.port());
    viewer.join(look);
    EXPECT_EQ(viewer.request(zone("mine")).at("error").at("code"), "PERMISSION_DENIED");
    EXPECT_EQ(http(daemon.port(), "GET /report.html").status, 401);
    EXPECT_EQ(http(daemon.port(), "PUT /pins.bcf", "x").status, 401);
}

/// The ceiling lamp of the Cornell box is 1.3 m x 1.05 m: from its front it is a large source, and
/// the answer says so; straight below no luminaire is in the method's range.
TEST(Glare, IsRatedOverTheWire) {
    Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", "none"});
    JsonViewer viewer(daemon.port());
    viewer.join();
    const auto rate = [&](const Json& more) {
        Json request = {
            {"measure",
             {{"quantity", "UGR"}, {"points", {{{"position", place(2.75, 1.2, 0.3)}}}}}}};
        request["measure"].update(more);
        return viewer.request(request);
    };
    const Json all = rate({{"directions", 8}});
    ASSERT_TRUE(all.contains("measured")) << all;
    const Json& glare = all["measured"]["points"][0]["glare"];
    ASSERT_EQ(glare["state"], "RATED") << glare;
    EXPECT_GT(glare["direction"]["z"], 0.5);
    ASSERT_EQ(glare["sources"].size(), 1U);
    EXPECT_NEAR(glare["sources"][0]["share"], 1.0, 1e-6);
    EXPECT_EQ(glare["sources"][0]["light"], 1);
    EXPECT_GT(glare["background"], 0.0);
    EXPECT_LE(all["measured"]["points"][0]["low"], all["measured"]["points"][0]["value"]);
    EXPECT_FALSE(all["measured"].contains("uniformity") &&
                 all["measured"]["uniformity"].is_number() && all["measured"]["uniformity"] > 0.0);
    const Json away = rate({{"direction", place(0, 0, -1)}});
    EXPECT_EQ(away["measured"]["points"][0]["glare"]["state"], "NO_SOURCE");
    EXPECT_EQ(rate(Json::object()).at("error").at("code"), "INVALID_ARGUMENT");
    Json daylight = {{"measure",
                      {{"quantity", "DGP"},
                       {"points", {{{"position", place(2.75, 1.2, 0.3)}}}},
                       {"direction", place(0, 0, 1)},
                       {"relativeError", 0.5}}}};
    const Json dgp = viewer.request(daylight);
    ASSERT_TRUE(dgp.contains("measured")) << dgp;
    EXPECT_GT(dgp["measured"]["points"][0]["value"], 0.15);
    EXPECT_EQ(dgp["measured"]["points"][0]["glare"]["luminances"].size(), 3U);
}

/// A report holds what is kept; pins leave as BCF, and come back with what has been replied.
TEST(Documents, AreMadeOfWhatIsKept) {
    Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", "none"});
    JsonViewer viewer(daemon.port());
    viewer.join();
    viewer.request(zone("<desk>"));
    const Json pin = viewer.request(
        {{"addPin", {{"text", "too dark"}, {"position", place(2, 0, 2)}, {"patch", 0}}}});
    const Json number = pin.at("pinChanged").at("pin");
    viewer.request({{"replyToPin", {{"pin", number}, {"text", "indeed"}}}});
    const Json set =
        viewer.request({{"setPin", {{"pin", number}, {"resolved", true}, {"assignedTo", "Bo"}}}});
    EXPECT_EQ(set.at("pinChanged").at("replies")[0].at("text"), "indeed");
    EXPECT_TRUE(set.at("pinChanged").at("resolved"));
    EXPECT_EQ(viewer.request({{"setPin", {{"pin", 99}}}}).at("error").at("code"), "NOT_FOUND");

    const Http page = http(daemon.port(), "GET /report.html?lang=de");
    EXPECT_EQ(page.status, 200) << page.head;
    EXPECT_TRUE(has(page.head, "style-src 'unsafe-inline'"));
    for (const char* text :
         {"lang=\"de\"", "&lt;desk&gt;", "too dark", "indeed", "erledigt", "<svg"}) {
        EXPECT_TRUE(has(page.body, text)) << text;
    }
    const Http json = http(daemon.port(), "GET /report.json");
    EXPECT_EQ(Json::parse(json.body).at("zones")[0].at("name"), "<desk>");
    EXPECT_EQ(http(daemon.port(), "GET /report.csv").status, 200);

    const Http bcf = http(daemon.port(), "GET /pins.bcf");
    ASSERT_EQ(bcf.status, 200);
    std::string reason;
    auto entries = read_zip(bcf.body, {}, reason);
    ASSERT_TRUE(entries) << reason;
    // Somebody opens it again, and adds a topic of their own.
    for (auto& [name, contents] : *entries) {
        const std::size_t at = contents.find("TopicStatus=\"Closed\"");
        if (at != std::string::npos) {
            contents.replace(at, 20, "TopicStatus=\"Open\"");
        }
    }
    (*entries)["11111111-2222-4333-8444-555555555555/markup.bcf"] =
        "<Markup><Topic Guid=\"11111111-2222-4333-8444-555555555555\" TopicStatus=\"Open\">"
        "<Title>From the other tool</Title><CreationDate>2026-01-01T00:00:00Z</CreationDate>"
        "<CreationAuthor>Eve</CreationAuthor></Topic></Markup>";
    const Http put = http(daemon.port(), "PUT /pins.bcf", write_zip(*entries));
    EXPECT_EQ(put.status, 200) << put.body;
    EXPECT_TRUE(has(put.body, "1 pins added, 1 brought up to date")) << put.body;
    JsonViewer late(daemon.port());
    const Json pins = late.join().at("welcome").at("pins");
    ASSERT_EQ(pins.size(), 2U);
    EXPECT_FALSE(pins[0].at("resolved"));
    EXPECT_EQ(pins[0].at("replies").size(), 1U) << "the same reply does not come twice";
    EXPECT_EQ(pins[1].at("text"), "From the other tool");
    EXPECT_EQ(http(daemon.port(), "PUT /pins.bcf", "no archive").status, 400);
    EXPECT_EQ(http(daemon.port(), "PUT /report.html", "x").status, 405);
}

/// The scene as it has been edited, which another server opens as it was; `raybundle save` writes
/// the same of the journal.
TEST(Documents, AreTheSceneAsItIsNow) {
    const TestFolder folder;
    const std::string journal = folder.path("journal.sqlite");
    std::string bytes;
    Json before;
    {
        Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", journal});
        JsonViewer viewer(daemon.port());
        const Json scene = viewer.join().at("welcome").at("scene");
        Json box;
        for (const Json& object : scene.at("objects")) {
            box = object.at("movable").get<bool>() ? object : box;
        }
        box["transform"]["translation"]["x"] = 0.3;
        viewer.request(
            {{"moveObject",
              {{"object", box.at("id")}, {"transform", box.at("transform")}, {"final", true}}}});
        viewer.request({{"setLight", {{"light", 1}, {"dim", 0.4}, {"group", "ceiling"}}}});
        viewer.request({{"saveLightingScene", {{"name", "evening"}}}});
        const Http saved = http(daemon.port(), "GET /scene.glb");
        ASSERT_EQ(saved.status, 200) << saved.body;
        EXPECT_TRUE(has(saved.head, "model/gltf-binary")) << saved.head;
        bytes = saved.body;
        EXPECT_EQ(http(daemon.port(), "PUT /scene.glb", "x").status, 405);
        JsonViewer late(daemon.port());
        before = late.join().at("welcome").at("scene");
    }
    const std::string file = folder.path("cornell_box.glb");
    std::ofstream(file, std::ios::binary) << bytes;
    Daemon other(file, {"--journal", "none"});
    JsonViewer viewer(other.port());
    const Json after = viewer.join().at("welcome").at("scene");
    for (const char* what : {"name", "objects", "materials", "cameras", "groups", "daylight",
                             "lightingScenes", "animations"}) {
        EXPECT_EQ(after.at(what), before.at(what)) << what;
    }
    for (const char* what : {"intensity", "colour", "dim", "on", "group"}) {
        EXPECT_EQ(after.at("lights")[0].at(what), before.at("lights")[0].at(what)) << what;
    }
    const std::string again = folder.path("again.glb");
    const std::string command = std::string(RAYBUNDLE_EXECUTABLE) + " save " +
                                scene_file("cornell_box.gltf") + " --journal " + journal + " -o " +
                                again + " 2>/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c)
    std::ifstream stream(again, std::ios::binary);
    EXPECT_TRUE(std::string(std::istreambuf_iterator<char>(stream), {}) == bytes);
}

/// Where Chromium is installed it prints; elsewhere the answer says so.
TEST(Documents, PdfOrWords) {
    Daemon daemon(scene_file("cornell_box.gltf"), {"--journal", "none"});
    JsonViewer viewer(daemon.port());
    viewer.join();
    const Http pdf = http(daemon.port(), "GET /report.pdf");
    if (!find_browser().empty()) {
        ASSERT_EQ(pdf.status, 200) << pdf.body;
        EXPECT_TRUE(pdf.body.starts_with("%PDF-"));
        EXPECT_TRUE(has(pdf.head, "application/pdf"));
    } else {
        EXPECT_EQ(pdf.status, 501);
        EXPECT_TRUE(has(pdf.body, "report.html"));
    }
}

/// A Chromium that hangs: whose askers have gone keep it busy, and the end of the server ends it.
TEST(Documents, ThatNobodyWaitsForAreBoundedAndEndWithTheServer) {
    const TestFolder folder;
    const std::string program = folder.path("chromium");
    std::ofstream(program) << "#!/bin/sh\nsleep 50\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (std::filesystem::path(program).parent_path().string() + ":" + path).c_str(), 1);
    Daemon daemon(scene_file("cornell_box.gltf"));
    setenv("PATH", path.c_str(), 1);
    ASSERT_TRUE(daemon.says("is ready")) << daemon.output();
    Http last;
    for (int i = 0; i < 100 && last.status != 503; ++i) {
        {
            RawClient client(daemon.port());
            client.send("GET /report.pdf HTTP/1.1\r\nHost: x\r\n\r\n");
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
        if (i >= 8) {
            last = http(daemon.port(), "GET /report.csv");
        }
    }
    EXPECT_EQ(last.status, 503);
    EXPECT_NE(last.head.find("retry-after: "), std::string::npos) << last.head;
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_EQ(daemon.end(), 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

}  // namespace
}  // namespace raybundle
