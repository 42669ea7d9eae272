// SPDX-License-Identifier: Apache-2.0
#include "telemetry/http_url.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

TEST(HttpUrl, HasSchemeHostPortAndPath) {
    const auto plain = parse_http_url("http://127.0.0.1:4318");
    ASSERT_TRUE(plain);
    EXPECT_FALSE(plain->tls);
    EXPECT_EQ(plain->host, "127.0.0.1");
    EXPECT_EQ(plain->port, 4318);
    EXPECT_EQ(plain->path, "/");
    EXPECT_EQ(plain->authority(), "127.0.0.1:4318");

    const auto secure = parse_http_url("https://otel.example.org/in/v1/traces?tenant=a");
    ASSERT_TRUE(secure);
    EXPECT_TRUE(secure->tls);
    EXPECT_EQ(secure->port, 443);
    EXPECT_EQ(secure->path, "/in/v1/traces?tenant=a");
    EXPECT_EQ(secure->authority(), "otel.example.org");
    EXPECT_EQ(secure->text(), "https://otel.example.org/in/v1/traces?tenant=a");

    const auto numeric = parse_http_url("http://[::1]:4318/");
    ASSERT_TRUE(numeric);
    EXPECT_EQ(numeric->host, "::1");
    EXPECT_EQ(numeric->authority(), "[::1]:4318");
    EXPECT_EQ(parse_http_url("http://[::1]")->port, 80);
}

TEST(HttpUrl, RefusesEverythingElse) {
    for (const char* text : {"", "127.0.0.1:4318", "ftp://a", "http://", "http://:80", "http://a:",
                             "http://a:0", "http://a:65536", "http://a:8x", "http://user:secret@a",
                             "http://a b", "http://a/\r\nX: y", "http://[::1", "http://[::1]x",
                             "http://[]:80", "http://a?b", "http://a/#b"}) {
        EXPECT_FALSE(parse_http_url(text)) << text;
    }
}

}  // namespace
}  // namespace raybundle
