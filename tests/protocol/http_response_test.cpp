// SPDX-License-Identifier: Apache-2.0
#include "net/http_response.h"

#include <gtest/gtest.h>

#include <array>

namespace raybundle {
namespace {

constexpr std::array<EmbeddedFile, 3> kFiles{
    {{"index.html", "<!doctype html>"}, {"main.js", "export {};"}, {"parts/style.css", "body {}"}}};

HttpResponse get(std::string_view path, bool ready = true) {
    return http_response(HttpMethod::get, path, {kFiles, ready, "figures 1\n"});
}

TEST(HttpResponse, ServesTheClientWithItsTypes) {
    EXPECT_EQ(get("/").body, "<!doctype html>");
    EXPECT_EQ(get("/").content_type, "text/html; charset=utf-8");
    EXPECT_EQ(get("/main.js").content_type, "text/javascript; charset=utf-8");
    EXPECT_EQ(get("/parts/style.css").content_type, "text/css; charset=utf-8");
}

TEST(HttpResponse, KnowsNothingElse) {
    for (const char* path : {"/nothing.js", "/../etc/passwd", "//etc/passwd", "/main.js/", "/parts",
                             "/./main.js", "/parts/../main.js", "/main.js\0x"}) {
        EXPECT_EQ(get(path).status, path == std::string_view("/main.js") ? 200 : 404) << path;
    }
    EXPECT_EQ(get("").status, 400);
    EXPECT_EQ(get("main.js").status, 400);
    EXPECT_EQ(get("/ws").status, 426);
}

TEST(HttpResponse, HealthAndMetrics) {
    EXPECT_EQ(get("/healthz", false).status, 503);
    EXPECT_EQ(get("/healthz", true).status, 200);
    EXPECT_EQ(get("/metrics").body, "figures 1\n");
    EXPECT_EQ(get("/metrics").content_type, "text/plain; version=0.0.4; charset=utf-8");
}

TEST(HttpResponse, OnlyGetAndHead) {
    EXPECT_EQ(http_response(HttpMethod::other, "/", {kFiles, true, ""}).status, 405);
    const HttpResponse head = http_response(HttpMethod::head, "/", {kFiles, true, ""});
    EXPECT_EQ(head.status, 200);
    EXPECT_FALSE(head.send_body);
}

}  // namespace
}  // namespace raybundle
