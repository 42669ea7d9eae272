// SPDX-License-Identifier: Apache-2.0
// REST beside the socket, without a render thread: routes, messages, the description, refusals.
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "net/rest/openapi.h"
#include "net/rest/rest_messages.h"
#include "net/rest/rest_problem.h"
#include "net/rest/rest_route.h"
#include "net/server.h"
#include "raw_client.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

std::variant<std::vector<v1::ClientMessage>, Refusal> messages_of(HttpMethod method,
                                                                  const std::string& path,
                                                                  const std::string& body) {
    return rest_messages(match_route(method, path), body, {});
}

std::string refusal_of(HttpMethod method, const std::string& path, const std::string& body) {
    const auto result = messages_of(method, path, body);
    const auto* const refusal = std::get_if<Refusal>(&result);
    return refusal == nullptr ? "" : refusal->text;
}

TEST(RestRoutes, EveryOperationHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (const RestRoute& route : rest_routes()) {
        EXPECT_TRUE(names.insert(route.operation).second) << route.operation;
        EXPECT_TRUE(route.path.starts_with("/api/v1/")) << route.path;
        EXPECT_EQ(match_route(route.method, route.path).route, &route) << route.path;
    }
}

TEST(RestRoutes, EveryMessageIsOfferedOrSaidToBeForTheSocketAlone) {
    std::set<std::string> offered;
    for (const RestRoute& route : rest_routes()) {
        offered.insert(route.messages.begin(), route.messages.end());
    }
    // Frames, cameras that move, and whatever only a viewer has.
    const std::set<std::string> socket_only{
        "setViewport", "setTarget", "follow",     "ack",        "ping",           "pointAt",
        "probeGrid",   "setDepths", "getWalkMap", "setDrawing", "cancelSnapshot", "ackLight"};
    const auto* const body = v1::ClientMessage::descriptor()->FindOneofByName("body");
    for (int i = 0; i < body->field_count(); ++i) {
        const std::string& name = body->field(i)->json_name();
        EXPECT_NE(offered.contains(name), socket_only.contains(name)) << name;
    }
}

TEST(RestRoutes, APathNamesWhatItsMethodsAre) {
    EXPECT_EQ(match_route(HttpMethod::put, "/api/v1/pins").allowed, "GET, POST");
    EXPECT_EQ(match_route(HttpMethod::put, "/api/v1/pins").route, nullptr);
    EXPECT_EQ(match_route(HttpMethod::head, "/api/v1/pins").route->operation, "listPins");
    for (const char* path :
         {"/api/v1/pin", "/api/v1/pins/", "/api/v1/pins/3/x", "/api/v1", "/api/"}) {
        EXPECT_TRUE(match_route(HttpMethod::get, path).allowed.empty()) << path;
    }
}

TEST(RestMessages, AreThoseOfTheSocket) {
    const auto light =
        messages_of(HttpMethod::patch, "/api/v1/lights/3", R"({"intensity":5,"on":true})");
    const auto& set = std::get<0>(light).at(0).set_light();
    EXPECT_EQ(set.light(), 3U);
    EXPECT_EQ(set.intensity(), 5.0F);
    const auto change =
        messages_of(HttpMethod::post, "/api/v1/changes", R"({"requestKey":"a-1","undo":{}})");
    EXPECT_TRUE(std::holds_alternative<Refusal>(change));
    const auto keyed = messages_of(HttpMethod::post, "/api/v1/changes",
                                   R"({"requestKey":"a-1","removeObject":{"object":2}})");
    EXPECT_EQ(std::get<0>(keyed).at(0).request_key(), "a-1");
    const auto picture =
        messages_of(HttpMethod::post, "/api/v1/snapshots",
                    R"({"snapshot":{"width":8,"height":8,"relativeError":1,"format":"PNG"},)"
                    R"("setCamera":{"eye":{"x":1},"target":{"x":2}}})");
    ASSERT_EQ(std::get<0>(picture).size(), 2U);
    EXPECT_TRUE(std::get<0>(picture)[0].has_set_camera());
    EXPECT_EQ(std::get<0>(picture)[1].id(), 2U);
}

TEST(RestMessages, AreRefusedInTheSocketsWords) {
    const auto patch = [](const std::string& body) {
        return refusal_of(HttpMethod::patch, "/api/v1/lights/3", body);
    };
    EXPECT_TRUE(has(patch(R"({"intensity":-1})"), "setLight.intensity")) << patch("{}");
    EXPECT_TRUE(has(patch(R"({"color":{}})"), "setLight.color: unknown field"));
    EXPECT_TRUE(has(patch(R"({"light":4,"on":true})"), "setLight.light: stands in the path"));
    EXPECT_TRUE(has(patch(R"({"colour":{"x":1,"x":2}})"), "given twice"));
    EXPECT_TRUE(has(patch(R"({"on":true},"undo":{})"), "not valid JSON"));
    EXPECT_TRUE(has(patch("[1]"), "not a JSON object"));
    EXPECT_TRUE(has(patch(""), "needs a body"));
    EXPECT_TRUE(has(patch(R"({"intensity":1e999})"), "not finite"));
    EXPECT_TRUE(has(patch(std::string(100, '[')), "body"));
    EXPECT_TRUE(has(refusal_of(HttpMethod::remove, "/api/v1/pins/x", ""), "no pin \"x\""));
    EXPECT_TRUE(has(refusal_of(HttpMethod::post, "/api/v1/changes",
                               R"({"setLight":{"light":1,"on":true},"undo":{}})"),
                    "undo"));
    EXPECT_TRUE(has(refusal_of(HttpMethod::post, "/api/v1/changes", "{}"), "exactly one"));
    EXPECT_TRUE(
        has(refusal_of(HttpMethod::post, "/api/v1/snapshots", "{}"), "snapshot: is missing"));
}

TEST(RestMessages, AnswersArePartsOfTheSocketsAnswers) {
    const std::string welcome =
        R"({"replyTo":1,"welcome":{"pins":[{"pin":3,"text":"a"},{"pin":4,"text":"b"}]}})";
    EXPECT_EQ(rest_answer(match_route(HttpMethod::get, "/api/v1/pins/4"), welcome),
              R"({"pin":4,"text":"b"})");
    EXPECT_EQ(rest_answer(match_route(HttpMethod::get, "/api/v1/pins/5"), welcome), std::nullopt);
    EXPECT_EQ(
        Json::parse(*rest_answer(match_route(HttpMethod::get, "/api/v1/pins"), welcome)).size(),
        2U);
    EXPECT_EQ(location_of(*match_route(HttpMethod::post, "/api/v1/pins").route, R"({"pin":4})"),
              "/api/v1/pins/4");
}

/// All values of "$ref" in a document.
void collect_references(const Json& json, std::set<std::string>& references) {
    if (json.is_object() && json.contains("$ref") && json["$ref"].is_string()) {
        references.insert(json["$ref"].get<std::string>());
    }
    if (json.is_structured()) {
        for (const Json& part : json) {
            collect_references(part, references);
        }
    }
}

TEST(OpenApi, EveryReferenceLeadsSomewhereAndEveryPathHasNamedOperations) {
    const Json document = Json::parse(*openapi_document());
    EXPECT_EQ(document["openapi"], "3.1.0");
    std::set<std::string> references;
    collect_references(document, references);
    EXPECT_GT(references.size(), 30U);
    for (const std::string& reference : references) {
        ASSERT_TRUE(reference.starts_with("#"));
        EXPECT_TRUE(document.contains(Json::json_pointer(reference.substr(1)))) << reference;
    }
    std::set<std::string> names;
    std::size_t operations = 0;
    for (const auto& [path, methods] : document["paths"].items()) {
        for (const auto& [method, operation] : methods.items()) {
            ++operations;
            names.insert(operation.at("operationId").get<std::string>());
            std::size_t in_path = 0;
            for (const Json& parameter : operation.value("parameters", Json::array())) {
                in_path += parameter["in"] == "path" ? 1 : 0;
                EXPECT_TRUE(parameter["in"] != "path" ||
                            has(path, "{" + parameter["name"].get<std::string>() + "}"));
            }
            EXPECT_EQ(in_path, path_fields(path).size()) << path;
            EXPECT_TRUE(operation["responses"].contains("default")) << path;
        }
    }
    EXPECT_EQ(operations, rest_routes().size());
    EXPECT_EQ(names.size(), operations);
}

TEST(OpenApi, SchemasHaveTheNamesThatTheSocketHas) {
    const Json schemas = Json::parse(*openapi_document())["components"]["schemas"];
    std::size_t checked = 0;
    for (const auto& [name, schema] : schemas.items()) {
        const auto* const type =
            google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(
                "raybundle.v1." + name);
        ASSERT_NE(type, nullptr) << name;
        EXPECT_EQ(schema["properties"].size(), static_cast<std::size_t>(type->field_count()));
        for (int i = 0; i < type->field_count(); ++i, ++checked) {
            EXPECT_TRUE(schema["properties"].contains(type->field(i)->json_name()))
                << name << "." << type->field(i)->json_name();
        }
    }
    EXPECT_GT(checked, 200U);
    EXPECT_TRUE(
        has(schemas["SetLight"]["properties"]["flux"]["description"].get<std::string>(), "lm"));
}

TEST(RestProblem, IsOfRfc9457) {
    const HttpResponse response = problem(v1::Error::NOT_FOUND, "no pin \xff");
    EXPECT_EQ(response.content_type, "application/problem+json");
    const Json body = Json::parse(response.body);
    EXPECT_EQ(body["status"], 404);
    EXPECT_EQ(body["title"], "Not Found");
    EXPECT_EQ(body["type"], "about:blank");
    EXPECT_EQ(body["code"], "NOT_FOUND");
}

/// A server whose render thread never answers.
class RestServerTest : public testing::Test {
  protected:
    explicit RestServerTest(ServerSettings settings = {}) : server_(local(std::move(settings))) {
        server_.start();
    }
    static ServerSettings local(ServerSettings settings) {
        settings.port = 0;
        return settings;
    }
    [[nodiscard]] std::string ask(const std::string& line, const std::string& body = "",
                                  const std::string& headers = "") const {
        return http_exchange(server_.port(), head(line, body, headers) + body);
    }
    static std::string head(const std::string& line, const std::string& body,
                            const std::string& headers) {
        return line + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" + headers +
               (body.empty() ? ""
                             : "Content-Type: application/json\r\nContent-Length: " +
                                   std::to_string(body.size()) + "\r\n") +
               "\r\n";
    }
    Server server_;
};

TEST_F(RestServerTest, ServesItsDescription) {
    const std::string answer = ask("GET /api/openapi.json");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer.substr(0, 200);
    EXPECT_TRUE(answer.ends_with(*openapi_document()));
}

TEST_F(RestServerTest, RefusesWithAProblem) {
    const auto expect = [](const std::string& answer, int status) {
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 " + std::to_string(status))) << answer;
        EXPECT_TRUE(has(answer, "content-type: application/problem+json\r\n")) << answer;
        EXPECT_TRUE(has(answer, "\"status\":" + std::to_string(status))) << answer;
    };
    expect(ask("GET /api/v1/nothing"), 404);
    expect(ask("GET /api/"), 404);
    const std::string method = ask("PUT /api/v1/pins", "{}");
    expect(method, 405);
    EXPECT_TRUE(has(method, "allow: GET, POST\r\n")) << method;
    expect(ask("POST /api/v1/undo", "{"), 400);
    expect(ask("POST /api/v1/undo", "", "Content-Length: 0\r\n"), 400);
    expect(ask("POST /api/v1/undo"), 411);
    expect(ask("GET /api/v1/scene?wait=31"), 400);
    expect(ask("GET /api/v1/scene?wait=nan"), 400);
    expect(ask("GET /api/v1/scene?name=" + std::string(65, 'n')), 400);
    expect(ask("POST /api/v1/undo", std::string(70000, ' ')), 413);
    expect(ask("POST /api/v1/undo", "", "Transfer-Encoding: chunked\r\n"), 411);
    expect(http_exchange(server_.port(),
                         "POST /api/v1/undo HTTP/1.1\r\nHost: h\r\nConnection: close\r\n"
                         "Content-Length: 2\r\nContent-Type: text/plain\r\n\r\n{}"),
           415);
    expect(ask("GET /api/v1/scene", "", "Origin: https://evil.example\r\n"), 403);
    expect(ask("GET /api/v1/requests/abc"), 404);
    expect(ask("GET /api/v1/photometry"), 404);
    expect(ask("GET /api/v1/scene?wait=0.01"), 503);
}

TEST_F(RestServerTest, WhoIsHereIsAsViewersWereToldLast) {
    EXPECT_TRUE(ask("GET /api/v1/viewers").ends_with("{\"viewers\":[]}\n"));
    v1::ServerMessage message;
    message.mutable_presence()->add_viewers()->set_name("Ada");
    server_.broadcast(message);
    EXPECT_TRUE(has(ask("GET /api/v1/viewers"), "\"name\":\"Ada\""));
}

TEST_F(RestServerTest, WhatTakesLongerIsAskedForAgainAndOneCallerHasEightRunning) {
    std::string url;
    for (int i = 0; i < 8; ++i) {
        const std::string answer = ask("POST /api/v1/undo?wait=0", "{}");
        ASSERT_TRUE(answer.starts_with("HTTP/1.1 202")) << answer;
        const std::size_t at = answer.find("location: ") + 10;
        url = answer.substr(at, answer.find('\r', at) - at);
    }
    EXPECT_TRUE(ask("POST /api/v1/undo?wait=0", "{}").starts_with("HTTP/1.1 429"));
    EXPECT_TRUE(ask("GET /api/v1/pins?wait=0.01").starts_with("HTTP/1.1 503"));  // may look
    EXPECT_TRUE(ask("GET " + url).starts_with("HTTP/1.1 202"));
    EXPECT_TRUE(ask("DELETE " + url).starts_with("HTTP/1.1 200"));
    EXPECT_TRUE(ask("GET " + url).starts_with("HTTP/1.1 404"));
    EXPECT_TRUE(ask("POST /api/v1/undo?wait=0", "{}").starts_with("HTTP/1.1 202"));
    // What was dropped has left: nobody handles it.
    EXPECT_EQ(server_.inbox().drain().size(), 16U);
}

TEST_F(RestServerTest, TheConnectionServesTheNextRequestAfterARefusal) {
    RawClient client(server_.port());
    const std::string type = "Content-Type: application/json\r\n";
    for (const std::string& refused :
         {"DELETE /api/v1/nothing HTTP/1.1\r\nHost: h\r\n\r\n" + std::string(),
          "POST /api/v1/nothing HTTP/1.1\r\nHost: h\r\nContent-Length: 2\r\n\r\n{}" + std::string(),
          "POST /api/v1/probes HTTP/1.1\r\nHost: h\r\n" + type + "Content-Length: 2\r\n\r\n{}"}) {
        client.send(refused);
        EXPECT_TRUE(client.read_until("}\n").starts_with("HTTP/1.1 40")) << refused;
    }
    client.send("GET /healthz/live HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_TRUE(client.read_until("live\n").starts_with("HTTP/1.1 200"));
}

/// Only where nobody can tell where the next request begins.
TEST_F(RestServerTest, ABodyWithoutLengthEndsItsConnectionAndAnEmptyOneDoesNot) {
    for (const char* line : {"POST /api/v1/undo", "PATCH /api/v1/pins/1", "POST /index.html"}) {
        RawClient client(server_.port());
        client.send(std::string(line) + " HTTP/1.1\r\nHost: h\r\n\r\n");
        const std::string answer = client.read_all();
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 4")) << answer;
        EXPECT_TRUE(has(answer, "connection: close\r\n")) << answer;
    }
    RawClient client(server_.port());
    for (const char* line : {"POST /api/v1/undo", "PUT /pins.bcf", "PUT /scenes/a.glb"}) {
        client.send(std::string(line) + " HTTP/1.1\r\nHost: h\r\nContent-Length: 0\r\n\r\n");
        const std::string answer = client.read_until("\r\n\r\n");
        client.read_until("\n");
        EXPECT_TRUE(answer.starts_with("HTTP/1.1 4")) << answer;
        EXPECT_FALSE(has(answer, "connection: close\r\n")) << answer;
    }
    client.send("GET /healthz/live HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_TRUE(client.read_until("live\n").starts_with("HTTP/1.1 200"));
}

TEST_F(RestServerTest, WhoWaitsWhileTheServerStopsIsToldSo) {
    RawClient client(server_.port());
    client.send(head("POST /api/v1/undo", "{}", "") + "{}");
    while (server_.inbox().size() < 2) {
        server_.inbox().wait_for(std::chrono::milliseconds(5));
    }
    server_.stop();
    const std::string answer = client.read_all();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 503")) << answer;
    EXPECT_TRUE(has(answer, "retry-after: 1\r\n")) << answer;
    EXPECT_TRUE(has(answer, "\"code\":\"UNAVAILABLE\"")) << answer;
    EXPECT_TRUE(has(answer, "the server is stopping")) << answer;
}

TEST_F(RestServerTest, WhoHangsUpLeaves) {
    {
        RawClient client(server_.port());
        client.send(head("POST /api/v1/undo", "{}", "") + "{}");
        while (server_.inbox().size() < 2) {
            server_.inbox().wait_for(std::chrono::milliseconds(5));
        }
    }
    while (server_.inbox().size() > 0) {
        EXPECT_TRUE(has(ask("GET /api/openapi.json"), "200"));
    }
}

ServerSettings with_tokens() {
    ServerSettings settings;
    settings.access.tokens = AccessTokens(
        {{"Ada", v1::VIEWER, token_digest("look")}, {"Ben", v1::EDITOR, token_digest("edit")}});
    return settings;
}

class RestTokenTest : public RestServerTest {
  protected:
    RestTokenTest() : RestServerTest(with_tokens()) {}
};

TEST_F(RestTokenTest, RolesAreThoseOfTheSocket) {
    EXPECT_TRUE(ask("GET /api/v1/scene").starts_with("HTTP/1.1 401"));
    const std::string wrong = ask("GET /api/v1/scene", "", "Authorization: Bearer no\r\n");
    EXPECT_TRUE(wrong.starts_with("HTTP/1.1 401")) << wrong;
    EXPECT_TRUE(has(wrong, "www-authenticate: Bearer\r\n")) << wrong;
    const std::string role = ask("POST /api/v1/undo", "{}", "Authorization: Bearer look\r\n");
    EXPECT_TRUE(role.starts_with("HTTP/1.1 403")) << role;
    EXPECT_TRUE(has(role, "undo: needs the role EDITOR")) << role;
    EXPECT_TRUE(ask("GET /api/v1/scene?name=Ben", "", "Authorization: Bearer look\r\n")
                    .starts_with("HTTP/1.1 403"));
    EXPECT_TRUE(ask("POST /api/v1/undo?wait=0", "{}", "Authorization: Bearer edit\r\n")
                    .starts_with("HTTP/1.1 202"));
    const auto events = server_.inbox().drain();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].message.hello().name(), "Ben");
    EXPECT_TRUE(events[0].caller && events[1].caller);
    EXPECT_EQ(events[1].payer(), 0U);
}

}  // namespace
}  // namespace raybundle
