// SPDX-License-Identifier: Apache-2.0
// What the front reads of a request and of an answer: in one way only.
#include "projects/http_head.h"

#include <gtest/gtest.h>

#include "projects/project_list.h"
#include "projects/server_process.h"

namespace raybundle {
namespace {

RequestHead head_of(const std::string& text) {
    auto parsed = parse_request_head(text);
    if (auto* const problem = std::get_if<HeadProblem>(&parsed)) {
        ADD_FAILURE() << problem->text;
        return {};
    }
    return std::get<RequestHead>(parsed);
}

int refusal_of(const std::string& text) {
    const auto parsed = parse_request_head(text);
    const auto* const problem = std::get_if<HeadProblem>(&parsed);
    return problem == nullptr ? 0 : problem->status;
}

TEST(RequestHeads, WhatCouldBeReadInTwoWaysIsRefused) {
    const auto with = [](const std::string& lines) {
        return refusal_of("POST /p/a/x HTTP/1.1\r\nHost: h\r\n" + lines + "\r\n");
    };
    EXPECT_EQ(with("Content-Length: 3\r\n"), 0);
    EXPECT_EQ(with("Content-Length: 3\r\nContent-Length: 3\r\n"), 400);
    EXPECT_EQ(with("Content-Length: 3, 3\r\n"), 400);
    EXPECT_EQ(with("Content-Length: +3\r\n"), 400);
    EXPECT_EQ(with("Content-Length: 99999999999999999999\r\n"), 400);
    EXPECT_EQ(with("Transfer-Encoding: chunked\r\n"), 411);
    EXPECT_EQ(with("Transfer-Encoding: xchunked\r\nContent-Length: 3\r\n"), 411);
    EXPECT_EQ(with("Content-Length : 3\r\n"), 400) << "a blank before the colon";
    EXPECT_EQ(with("A: b\r\n c\r\n"), 400) << "a line that continues the one before";
    EXPECT_EQ(with("A: b\nContent-Length: 3\r\n"), 400) << "a line that ends by LF alone";
    EXPECT_EQ(with("A: b\rc\r\n"), 400);
    EXPECT_EQ(with("A: b" + std::string(1, '\0') + "\r\n"), 400);
    EXPECT_EQ(with("Host: other\r\n"), 400) << "two hosts";
    EXPECT_EQ(with("no header\r\n"), 400);
}

TEST(RequestHeads, LinesOfOtherProtocolsAreRefused) {
    const auto line = [](const std::string& text) {
        return refusal_of(text + "\r\nHost: h\r\n\r\n");
    };
    EXPECT_EQ(line("GET / HTTP/1.1"), 0);
    EXPECT_EQ(line("GET / HTTP/2.0"), 505);
    EXPECT_EQ(line("GET /"), 400);
    EXPECT_EQ(line("GET / x HTTP/1.1"), 400);
    EXPECT_EQ(line("GET http://h/ HTTP/1.1"), 400);
    EXPECT_EQ(line("G(T / HTTP/1.1"), 400);
    EXPECT_EQ(line(""), 400);
    EXPECT_EQ(refusal_of("GET / HTTP/1.1\r\n\r\n"), 400) << "no host";
    EXPECT_EQ(refusal_of("GET / HTTP/1.0\r\n\r\n"), 0);
}

TEST(RequestHeads, AreForwardedAsOneRequestToAConnection) {
    const RequestHead head = head_of(
        "PUT /p/a/scenes/x.glb?y HTTP/1.1\r\nHost: h\r\nConnection: keep-alive\r\n"
        "Content-Length: 3\r\nExpect: 100-continue\r\nX-Forwarded-For: 1.2.3.4\r\n"
        "Authorization: Bearer t\r\n\r\n");
    EXPECT_EQ(head.body_bytes, 3U);
    EXPECT_TRUE(head.expects_continue);
    EXPECT_EQ(forwarded_head(head, "/scenes/x.glb?y", "5.6.7.8"),
              "PUT /scenes/x.glb?y HTTP/1.1\r\nHost: h\r\nContent-Length: 3\r\n"
              "Authorization: Bearer t\r\nX-Forwarded-For: 1.2.3.4, 5.6.7.8\r\n"
              "Connection: close\r\n\r\n");
    const RequestHead socket = head_of(
        "GET /p/a/ws HTTP/1.1\r\nHost: h\r\nConnection: keep-alive, Upgrade\r\n"
        "Upgrade: WebSocket\r\n\r\n");
    EXPECT_TRUE(socket.upgrade);
    EXPECT_EQ(forwarded_head(socket, "/ws", "::1"),
              "GET /ws HTTP/1.1\r\nHost: h\r\nX-Forwarded-For: ::1\r\nUpgrade: websocket\r\n"
              "Connection: Upgrade\r\n\r\n");
    EXPECT_FALSE(head_of("GET / HTTP/1.1\r\nHost: h\r\nConnection: Upgrade\r\n"
                         "Upgrade: h2c\r\n\r\n")
                     .upgrade);
}

TEST(RequestHeads, LeadToProjects) {
    EXPECT_EQ(project_target("/p/a/ws?x=1")->project, "a");
    EXPECT_EQ(project_target("/p/a/ws?x=1")->target, "/ws?x=1");
    EXPECT_EQ(project_target("/p/a/")->target, "/");
    EXPECT_EQ(project_target("/p/a")->target, "");
    EXPECT_EQ(project_target("/p/a?x/y")->target, "");
    EXPECT_FALSE(project_target("/pictures/a.png"));
    EXPECT_FALSE(project_target("/"));
    EXPECT_TRUE(is_project_name("office-2_b.1"));
    for (const char* name : {"", ".", "..", "-a", "a/b", "a b", "\xC3\xA4"}) {
        EXPECT_FALSE(is_project_name(name)) << name;
    }
}

TEST(ResponseHeads, SayWhereTheAnswerEnds) {
    const RequestHead get = head_of("GET /p/a/ HTTP/1.1\r\nHost: h\r\n\r\n");
    const auto answer = forwarded_response(
        "HTTP/1.1 201 Created\r\nlocation: /api/v1/pins/3\r\nconnection: keep-alive\r\n"
        "content-length: 12\r\n\r\n",
        get, "/p/a");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 201);
    EXPECT_EQ(answer->body_bytes, 12U);
    EXPECT_EQ(answer->text,
              "HTTP/1.1 201 Created\r\nlocation: /p/a/api/v1/pins/3\r\ncontent-length: 12\r\n"
              "Connection: close\r\n\r\n");
    EXPECT_EQ(forwarded_response("HTTP/1.1 304 Not Modified\r\ncontent-length: 12\r\n\r\n", get, "")
                  ->body_bytes,
              0U);
    const auto socket = forwarded_response(
        "HTTP/1.1 101 Switching Protocols\r\nConnection: Upgrade\r\n\r\n", get, "");
    EXPECT_EQ(socket->text, "HTTP/1.1 101 Switching Protocols\r\nConnection: Upgrade\r\n\r\n");
    EXPECT_FALSE(socket->body_bytes);
    EXPECT_FALSE(forwarded_response("SSH-2.0-x\r\n\r\n", get, ""));
}

TEST(ProjectLists, FiguresOfAllServersAreOneText) {
    const std::string one =
        "# HELP a what\n# TYPE a gauge\na 1\n# HELP b x\n# TYPE b summary\nb{q=\"1\"} 2\nb_sum 3\n";
    EXPECT_EQ(merged_metrics({{"x", one}, {"y", one}, {"z", ""}}),
              "# HELP a what\n# TYPE a gauge\na{project=\"x\"} 1\na{project=\"y\"} 1\n"
              "# HELP b x\n# TYPE b summary\nb{project=\"x\",q=\"1\"} 2\nb_sum{project=\"x\"} 3\n"
              "b{project=\"y\",q=\"1\"} 2\nb_sum{project=\"y\"} 3\n");
}

TEST(ProjectLists, LinesOfTheLogHaveTheProjectsName) {
    EXPECT_EQ(named_line("box", "raybundle serves"), "box: raybundle serves\n");
    EXPECT_EQ(named_line("box", R"({"time":"t","level":"info"})"),
              R"({"project":"box","time":"t","level":"info"})"
              "\n");
}

}  // namespace
}  // namespace raybundle
