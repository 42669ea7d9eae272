// SPDX-License-Identifier: Apache-2.0
// Things and luminaires that are added, exchanged and removed over the wire, by several people,
// with undo, and kept over a restart.
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "daemon.h"
#include "journal/session_journal.h"
#include "json_viewer.h"
#include "net/access/access_tokens.h"
#include "scene/edit/light_edit.h"
#include "test_folder.h"

namespace raybundle {
namespace {

const std::string editor_token(64, '1');
const std::string viewer_token(64, '2');

const std::string wide =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0.3 0.6 0.05\n1 1 10\n0 30 60 90\n0\n"
    "100 90 50 0\n";
const std::string narrow =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 1 1 2 0 0 0\n1 1 15\n0 10 20 90\n0\n900 500 0 0\n";

Json vec(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

class Additions : public testing::Test {
  protected:
    Additions() {
        const Json scene = Json::parse(std::ifstream(scene_file("cornell_box.gltf")));
        folder_.write("room.gltf", scene.dump());
        const auto entry = [](const std::string& role, const std::string& token) {
            return Json{{"name", role}, {"role", role}, {"sha256", to_hex(token_digest(token))}};
        };
        outside_.write(
            "site.json",
            Json{{"tokens", {entry("EDITOR", editor_token), entry("VIEWER", viewer_token)}}}
                .dump());
        start();
    }

    void start() {
        daemon_.reset();
        daemon_ = std::make_unique<Daemon>(
            folder_.path("room.gltf"),
            std::vector<std::string>{"--scenes", folder_.path(), "--config",
                                     outside_.path("site.json"), "--journal",
                                     outside_.path("session.db")});
    }

    [[nodiscard]] std::string exchange(const std::string& method, const std::string& path,
                                       const std::string& body = {},
                                       const std::string& token = editor_token) const {
        return http_exchange(
            daemon_->port(),
            method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" +
                (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") +
                "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }

    [[nodiscard]] int put(const std::string& name, const std::string& body,
                          const std::string& token = editor_token) const {
        return std::stoi(exchange("PUT", "/photometry/" + name, body, token).substr(9));
    }

    TestFolder folder_, outside_;
    std::unique_ptr<Daemon> daemon_;
};

Json add(const std::string& file, const Json& more = {}) {
    Json body = {{"photometry", file}, {"position", vec(2.7, 5.0, 2.7)}};
    body.update(more.is_null() ? Json::object() : more);
    return {{"addLuminaire", body}};
}

std::string refusal(JsonViewer& viewer, const Json& request) {
    const Json answer = viewer.request(request);
    return answer.contains("error") ? answer.at("error").at("code").get<std::string>()
                                    : answer.dump();
}

std::set<std::uint32_t> ids(const Json& list) {
    std::set<std::uint32_t> result;
    for (const Json& one : list) {
        result.insert(one.at("id").get<std::uint32_t>());
    }
    return result;
}

TEST_F(Additions, TakesPhotometricFilesThatAreRight) {
    EXPECT_EQ(put("wide.ies", wide), 201);
    EXPECT_EQ(put("wide.ies", wide), 200);
    EXPECT_EQ(put("wide.ies", narrow), 409);
    EXPECT_EQ(put("broken.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 2 three\n"), 422);
    EXPECT_EQ(put("text.txt", wide), 400);
    EXPECT_EQ(put(".wide.ies", wide), 400);
    EXPECT_GE(put("..%2Fwide.ies", wide), 400);
    EXPECT_EQ(put("other.ies", wide, viewer_token), 403);
    EXPECT_EQ(put("other.ies", wide, "wrong"), 401);
    const std::string answer = exchange("GET", "/photometry");
    const Json files = Json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
    ASSERT_EQ(files.size(), 1U);
    EXPECT_EQ(files[0].at("name"), "wide.ies");
    EXPECT_GT(files[0].at("flux").get<double>(), 100.0);
    EXPECT_EQ(files[0].at("power"), 10.0);
    EXPECT_NEAR(files[0].at("size").at("length").get<double>(), 0.6, 1e-9);
    EXPECT_TRUE(files[0].at("problems").is_array());
    EXPECT_EQ(exchange("GET", "/photometry", "", "wrong").substr(9, 3), "401");
    EXPECT_EQ(folder_.files(), 2U);  // the scene and the folder of photometry
}

TEST_F(Additions, LuminairesComeGoAndChangeForEverybody) {
    ASSERT_EQ(put("wide.ies", wide), 201);
    ASSERT_EQ(put("narrow.ies", narrow), 201);
    JsonViewer editor(daemon_->port());
    const Json first = editor.join(editor_token).at("welcome").at("scene");
    JsonViewer watching(daemon_->port());
    watching.join(viewer_token);
    EXPECT_EQ(refusal(watching, add("wide.ies")), "PERMISSION_DENIED");
    EXPECT_EQ(refusal(editor, add("absent.ies")), "INVALID_ARGUMENT");
    EXPECT_EQ(refusal(editor, add("../wide.ies")), "INVALID_ARGUMENT");
    EXPECT_EQ(refusal(editor, add("wide.ies", {{"columns", 200}, {"rows", 200}})),
              "INVALID_ARGUMENT");
    EXPECT_EQ(refusal(editor, {{"removeLight", {{"light", 1}}}}), "INVALID_ARGUMENT");  // surface
    EXPECT_EQ(refusal(editor, {{"removeLight", {{"light", 77}}}}), "NOT_FOUND");

    const Json added = editor.request(add("wide.ies", {{"name", "desk"}, {"group", "desks"}}));
    ASSERT_TRUE(added.contains("sceneChanged")) << added;
    const Json light = added.at("sceneChanged").at("lights").at(0);
    const auto id = light.at("id").get<std::uint32_t>();
    EXPECT_EQ(added.at("sceneChanged").at("addLuminaire").at("light"), id);
    EXPECT_EQ(light.at("name"), "desk");
    EXPECT_EQ(light.at("unit"), "LM");
    EXPECT_EQ(light.at("photometry"), "wide.ies");
    EXPECT_EQ(light.at("added"), true);
    const Json heard = watching.next_with("sceneChanged").at("sceneChanged");
    EXPECT_EQ(heard.at("lights").at(0).at("id"), id);

    const Json other = editor.request(
        {{"setLight", {{"light", id}, {"photometry", "narrow.ies"}, {"sameType", true}}}});
    EXPECT_TRUE(other.contains("ok")) << other;
    JsonViewer late(daemon_->port());
    const Json scene = late.join(viewer_token).at("welcome").at("scene");
    ASSERT_EQ(scene.at("luminaires").size(), 1U);
    EXPECT_EQ(scene.at("luminaires").at(0).at("photometry"), "narrow.ies");
    EXPECT_EQ(scene.at("luminaires").at(0).at("power"), 15.0);
    EXPECT_EQ(scene.at("luminaires").at(0).at("group"), "desks");
    EXPECT_EQ(scene.at("lights").size(), first.at("lights").size() + 1);

    const Json field = editor.request(add("wide.ies", {{"columns", 3},
                                                       {"rows", 2},
                                                       {"position", vec(1, 5, 1)},
                                                       {"columnStep", vec(1, 0, 0)},
                                                       {"rowStep", vec(0, 0, 2)}}));
    EXPECT_TRUE(field.contains("ok")) << field;
    JsonViewer third(daemon_->port());
    const Json with_field = third.join(viewer_token).at("welcome").at("scene").at("lights");
    ASSERT_EQ(with_field.size(), first.at("lights").size() + 7);
    EXPECT_EQ(with_field.back().at("position").at("x"), 3.0);
    EXPECT_EQ(with_field.back().at("position").at("z"), 3.0);

    const Json removed = editor.request({{"removeLight", {{"light", id}}}});
    EXPECT_EQ(removed.at("sceneChanged").at("removeLight").at("light"), id) << removed;
    EXPECT_EQ(refusal(editor, {{"removeLight", {{"light", id}}}}), "INVALID_ARGUMENT");
    EXPECT_EQ(refusal(editor, {{"setLight", {{"light", id}, {"on", false}}}}), "NOT_FOUND");
    const Json again = editor.request({{"addLuminaire", {{"light", id}}}});
    EXPECT_EQ(again.at("sceneChanged").at("lights").at(0).at("photometry"), "narrow.ies") << again;
    EXPECT_TRUE(editor.request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    JsonViewer last(daemon_->port());
    EXPECT_EQ(last.join(viewer_token).at("welcome").at("scene").at("lights"), first.at("lights"));
}

TEST_F(Additions, ObjectsAreRemovedCopiedAndTakenFromTheFolder) {
    JsonViewer editor(daemon_->port());
    const Json first = editor.join(editor_token).at("welcome").at("scene").at("objects");
    std::uint32_t box = 0;
    std::uint32_t fixed = 0;
    for (const Json& object : first) {
        (object.at("movable") == true ? box : fixed) = object.at("id").get<std::uint32_t>();
    }
    ASSERT_GT(box, 0U);
    const Json removed = editor.request({{"removeObject", {{"object", box}}}});
    EXPECT_EQ(removed.at("sceneChanged").at("removeObject").at("object"), box) << removed;
    EXPECT_EQ(refusal(editor, {{"removeObject", {{"object", box}}}}), "NOT_FOUND");
    EXPECT_EQ(refusal(editor, {{"removeObject", {{"object", 99}}}}), "NOT_FOUND");
    EXPECT_EQ(refusal(editor, {{"addObject", {{"copyOf", box}}}}), "NOT_FOUND");
    EXPECT_EQ(refusal(editor, {{"addObject", {{"library", "absent.glb"}}}}), "INVALID_ARGUMENT");
    EXPECT_EQ(refusal(editor, {{"addObject", Json::object()}}), "INVALID_ARGUMENT");
    const Json back = editor.request({{"addObject", {{"object", box}}}});
    EXPECT_EQ(back.at("sceneChanged").at("objects").at(0).at("id"), box) << back;
    const Json copied = editor.request({{"addObject", {{"copyOf", box}, {"name", "twin"}}}});
    ASSERT_TRUE(copied.contains("sceneChanged")) << copied;
    const Json twin = copied.at("sceneChanged").at("objects").at(0);
    EXPECT_EQ(twin.at("name"), "twin");
    EXPECT_EQ(twin.at("movable"), true);
    const auto number = twin.at("id").get<std::uint32_t>();
    const Json moved = editor.request(
        {{"moveObject", {{"object", number}, {"transform", {{"translation", vec(0.5, 0, 0.5)}}}}}});
    EXPECT_TRUE(moved.contains("sceneChanged")) << moved;
    const Json library = editor.request(
        {{"addObject",
          {{"library", "room.gltf"}, {"transform", {{"scale", vec(0.1, 0.1, 0.1)}}}}}});
    ASSERT_TRUE(library.contains("sceneChanged")) << library;
    EXPECT_GT(library.at("sceneChanged").at("materials").size(), 0U);

    const auto objects_now = [&] {
        JsonViewer viewer(daemon_->port());
        return viewer.join(viewer_token).at("welcome").at("scene").at("objects");
    };
    const Json before = objects_now();
    EXPECT_EQ(before.size(), first.size() + 2);
    start();
    EXPECT_EQ(objects_now(), before) << daemon_->output();
    JsonViewer again(daemon_->port());
    again.join(editor_token);
    // It stands in the way of rays, too.
    const Json& box_of_twin = before.at(before.size() - 2).at("bounds");
    const Json hit =
        again.request({{"probe",
                        {{"ray",
                          {{"origin", vec(0.5 * (box_of_twin["min"]["x"].get<double>() +
                                                 box_of_twin["max"]["x"].get<double>()),
                                          5.4,
                                          0.5 * (box_of_twin["min"]["z"].get<double>() +
                                                 box_of_twin["max"]["z"].get<double>()))},
                           {"direction", vec(0, -1, 0)}}}}}});
    EXPECT_EQ(hit.at("probeResult").at("object"), number) << hit;
    EXPECT_TRUE(again.request({{"undo", {{"epoch", 0}}}}).contains("ok"));
    EXPECT_EQ(ids(objects_now()), ids(first));
}

Json keyed(Json request, const std::string& key) {
    request["requestKey"] = key;
    return request;
}

/// What a request was answered, without what names the request or tells of the scene as it is now.
Json said(JsonViewer& viewer, const Json& request) {
    Json answer = viewer.request(request);
    answer.erase("replyTo");
    if (answer.contains("sceneChanged")) {
        Json& change = answer["sceneChanged"];
        for (const char* now : {"objects", "materials", "lights"}) {
            change.erase(now);
        }
        if (change.contains("setDaylight")) {
            EXPECT_GT(change["setDaylight"].at("lights").size(), 0U);
            change["setDaylight"].erase("lights");
        }
    }
    return answer;
}

Json field_of_four() {
    return keyed(
        add("wide.ies",
            {{"columns", 2}, {"rows", 2}, {"columnStep", vec(1, 0, 0)}, {"rowStep", vec(0, 0, 2)}}),
        "field");
}

TEST_F(Additions, HeavyWhatIsAskedForAgainAfterAKillIsNotMadeAgain) {
    ASSERT_EQ(put("wide.ies", wide), 201);
    const std::vector<Json> requests{
        keyed({{"setLight", {{"light", 1}, {"intensity", 500.0}}}}, "light"),
        field_of_four(),
        keyed({{"setGroup", {{"group", "all"}, {"dim", 0.5}, {"lights", {1}}}}}, "group"),
        keyed({{"setDaylight", {{"sky", "clear"}, {"sunElevation", 40.0}}}}, "day"),
        keyed({{"addObject", {{"copyOf", kShortBox}, {"name", "twin"}}}}, "twin"),
        keyed({{"undo", {{"epoch", 1}}}}, "undo")};
    std::vector<Json> answers;
    {
        JsonViewer editor(daemon_->port());
        editor.join(editor_token, 32, 24);
        for (const Json& request : requests) {
            answers.push_back(said(editor, request));
            EXPECT_FALSE(answers.back().contains("error")) << request << answers.back();
            EXPECT_EQ(said(editor, request), answers.back()) << "asked for again at once";
        }
        daemon_->end(SIGKILL);
    }
    start();
    JsonViewer editor(daemon_->port());
    const Json welcome = editor.join(editor_token, 32, 24).at("welcome");
    for (std::size_t i = 0; i < requests.size(); ++i) {
        EXPECT_EQ(said(editor, requests[i]), answers[i]) << requests[i];
    }
    JsonViewer late(daemon_->port());
    const Json after = late.join(editor_token, 32, 24).at("welcome");
    EXPECT_EQ(after.at("epoch"), welcome.at("epoch")) << "nothing has been added";
    EXPECT_EQ(after.at("scene"), welcome.at("scene"));
}

/// A server that was killed between the luminaires of a field has added some of them.
TEST_F(Additions, OfAFieldThatWasBegunOnlyTheRestIsAdded) {
    ASSERT_EQ(put("wide.ies", wide), 201);
    daemon_.reset();
    const std::string room = folder_.path("room.gltf");
    {
        SessionJournal journal({outside_.path("session.db"), room, *file_digest(room)});
        v1::SceneChanged first;
        first.set_epoch(1);
        v1::AddLuminaire& luminaire = *first.mutable_add_luminaire();
        luminaire.set_light(first_added_light);
        luminaire.set_photometry("wide.ies");
        luminaire.set_name("wide 1");
        luminaire.mutable_position()->set_y(5.0F);
        luminaire.mutable_aim()->set_y(-1.0F);
        ASSERT_EQ(journal.append(first, {}, {{"field", 1, 4}}), Appended::yes);
    }
    start();
    JsonViewer editor(daemon_->port());
    const Json lights = editor.join(editor_token, 32, 24).at("welcome").at("scene").at("lights");
    ASSERT_EQ(lights.back().at("name"), "wide 1");
    EXPECT_TRUE(editor.request(field_of_four()).contains("ok"));
    EXPECT_TRUE(editor.request(field_of_four()).contains("ok"));
    JsonViewer late(daemon_->port());
    const Json welcome = late.join(editor_token, 32, 24).at("welcome");
    EXPECT_EQ(welcome.at("epoch"), 4);
    EXPECT_EQ(welcome.at("scene").at("lights").size(), lights.size() + 3);
    EXPECT_EQ(welcome.at("scene").at("lights").back().at("name"), "wide 4");
}

TEST_F(Additions, ARestartKeepsWhatHasComeAndGone) {
    ASSERT_EQ(put("wide.ies", wide), 201);
    Json lights;
    {
        JsonViewer editor(daemon_->port());
        editor.join(editor_token);
        const Json one = editor.request(add("wide.ies"));
        const Json two = editor.request(add("wide.ies"));
        const auto gone = one.at("sceneChanged").at("addLuminaire").at("light");
        const auto kept = two.at("sceneChanged").at("addLuminaire").at("light");
        editor.request({{"setLight", {{"light", gone}, {"dim", 0.25}}}});
        editor.request({{"setLight", {{"light", kept}, {"dim", 0.5}}}});
        editor.request({{"removeLight", {{"light", gone}}}});
        JsonViewer late(daemon_->port());
        lights = late.join(viewer_token).at("welcome").at("scene").at("lights");
        EXPECT_EQ(lights.back().at("dim"), 0.5);
    }
    start();
    JsonViewer editor(daemon_->port());
    const Json welcome = editor.join(editor_token).at("welcome");
    EXPECT_EQ(welcome.at("scene").at("lights"), lights);
    EXPECT_EQ(welcome.at("epoch"), 5);
    EXPECT_TRUE(editor.request({{"undo", {{"epoch", 4}}}}).contains("ok"));
    JsonViewer late(daemon_->port());
    const Json again = late.join(viewer_token).at("welcome").at("scene").at("lights");
    ASSERT_EQ(again.size(), lights.size() + 1);
    EXPECT_EQ(again.at(again.size() - 2).at("dim"), 0.25);
}

}  // namespace
}  // namespace raybundle
