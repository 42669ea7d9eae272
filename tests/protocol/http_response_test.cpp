// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_response.h"

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

/// Value of a header as it is sent; "-" where it is absent, "!" where it is there twice.
std::string sent_header(const HttpResponse& response, std::string_view name) {
    std::string value = "-";
    for (const auto& [key, text] : headers_of(response)) {
        if (key == name) {
            value = value == "-" ? text : "!";
        }
    }
    return value;
}

TEST(HttpResponse, SaysWhenToAskAgainWhateverIsAskedFor) {
    EXPECT_EQ(sent_header(get("/healthz", false), "retry-after:"), "1");
    EXPECT_EQ(sent_header(get("/healthz", true), "retry-after:"), "-");
    HttpResponse crowded;
    crowded.status = 429;
    EXPECT_EQ(sent_header(crowded, "retry-after:"), "1");
    HttpResponse document;
    document.status = 503;
    document.headers = {{"retry-after:", "5"}, {"cache-control:", "private"}};
    EXPECT_EQ(sent_header(document, "retry-after:"), "5");
    EXPECT_EQ(sent_header(document, "cache-control:"), "private") << "in place of the common one";
    EXPECT_EQ(sent_header(document, "referrer-policy:"), "no-referrer");
}

TEST(HttpResponse, SaysThatItsConnectionEnds) {
    EXPECT_EQ(sent_header(get("/"), "connection:"), "-");
    EXPECT_EQ(sent_header(last_response(get("/")), "connection:"), "close");
}

TEST(HttpResponse, HealthTellsLiveReadyAndEditableApart) {
    const auto status = [](const char* path, bool ready, bool editable) {
        HttpContent content{kFiles, ready, ""};
        content.editable = editable;
        return http_response(HttpMethod::get, path, content).status;
    };
    EXPECT_EQ(status("/healthz/live", false, false), 200);
    EXPECT_EQ(status("/healthz/ready", false, true), 503);
    EXPECT_EQ(status("/healthz/ready", true, false), 200);
    EXPECT_EQ(status("/healthz/editable", true, false), 503);
    EXPECT_EQ(status("/healthz/editable", false, true), 503);
    EXPECT_EQ(status("/healthz/editable", true, true), 200);
    EXPECT_EQ(status("/healthz", true, false), 200) << "as it always was";
    EXPECT_EQ(status("/healthz/other", true, true), 404);
}

/// What a response says in a header; "-" where it is absent.
std::string header_of(const HttpResponse& response, std::string_view name) {
    for (const auto& [key, value] : response.headers) {
        if (key == name) {
            return value;
        }
    }
    return "-";
}

TEST(HttpResponse, FilesAreCompressedAndRevalidated) {
    const std::string page = "<!doctype html>" + std::string(1000, 'x');
    const std::array<EmbeddedFile, 2> files{{{"index.html", page}, {"tiny.js", ";"}}};
    const EncodedFiles encoded(files);
    const auto ask = [&](std::string_view path, const std::string& accept,
                         const std::string& known) {
        return http_response(HttpMethod::get, path,
                             {files, true, "", true, nullptr, &encoded, accept, known});
    };
    const HttpResponse plain = ask("/", "", "");
    EXPECT_EQ(plain.content(), page);
    EXPECT_EQ(header_of(plain, "content-encoding:"), "-");
    EXPECT_EQ(header_of(plain, "vary:"), "Accept-Encoding");
    const HttpResponse packed = ask("/", "deflate, gzip;q=0.5", "");
    EXPECT_LT(packed.content().size(), 200U);
    EXPECT_EQ(header_of(packed, "content-encoding:"), "gzip");
    EXPECT_EQ(ask("/tiny.js", "gzip", "").content(), ";") << "would only grow";
    const std::string etag = header_of(packed, "etag:");
    EXPECT_NE(etag, header_of(plain, "etag:")) << "other bytes";
    const HttpResponse known = ask("/", "gzip", "\"a\", W/" + etag);
    EXPECT_EQ(known.status, 304);
    EXPECT_FALSE(known.send_body);
    EXPECT_EQ(header_of(known, "etag:"), etag);
    EXPECT_EQ(ask("/", "", etag).status, 200) << "it has no bytes to show without gzip";
    EXPECT_EQ(ask("/nothing", "gzip", "*").status, 404);
}

TEST(HttpResponse, AcceptEncodingIsReadAsTheStandardSays) {
    for (const char* yes : {"gzip", "GZIP", "deflate, gzip", "*", "br;q=1.0, gzip;q=0.8, *;q=0.1",
                            " x-gzip ", "gzip; q=0.001", "identity;q=0, *"}) {
        EXPECT_TRUE(accepts_gzip(yes)) << yes;
    }
    for (const char* no : {"", "identity", "gzip;q=0", "gzip; q=0.0, *", "br", "*;q=0", "gzipped",
                           "gzip;q=x", ",,;"}) {
        EXPECT_FALSE(accepts_gzip(no)) << no;
    }
}

TEST(HttpResponse, OnlyGetAndHead) {
    EXPECT_EQ(http_response(HttpMethod::other, "/", {kFiles, true, ""}).status, 405);
    const HttpResponse head = http_response(HttpMethod::head, "/", {kFiles, true, ""});
    EXPECT_EQ(head.status, 200);
    EXPECT_FALSE(head.send_body);
}

}  // namespace
}  // namespace raybundle
