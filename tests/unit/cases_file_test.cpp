// SPDX-License-Identifier: Apache-2.0
// Files as a whole: other kinds of files under our names, encodings, data URIs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "gltf_builder.h"
#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/photometry/ies_profile.h"

namespace raybundle::test {
namespace {

using namespace std::string_literals;

GltfContainer parsed(const std::string& text) {
    return parse_gltf_container("f", std::vector<std::uint8_t>(text.begin(), text.end()));
}

template <class Action>
std::string error_of(Action action) {
    try {
        action();
        return "";
    } catch (const SceneError& error) {
        return error.what();
    }
}

std::string gltf_error(const std::string& text) {
    return error_of([&] { parsed(text); });
}

TEST(CasesFile, OtherKindsOfFilesAreNamed) {
    EXPECT_EQ(gltf_error(""), "f: not glTF: the file is empty");
    EXPECT_EQ(gltf_error("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
              "f: not glTF: this is a Git LFS pointer: the file itself has not been fetched");
    EXPECT_EQ(gltf_error("\xFF\xFE{\0}\0"s), "f: not glTF: this is UTF-16 text");
    EXPECT_EQ(gltf_error("\x1F\x8B\x08"), "f: not glTF: this is compressed (gzip)");
    EXPECT_EQ(gltf_error("<!DOCTYPE html>"), "f: not glTF: this is XML or HTML");
    EXPECT_EQ(gltf_error("PK\x03\x04"), "f: not glTF: this is a ZIP archive");
    EXPECT_EQ(gltf_error("ISO-10303-21;\nHEADER;\n"), "f: not glTF: this is IFC or STEP");
    EXPECT_EQ(gltf_error("\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p\0"s),
              "f: not glTF: this is SketchUp");
    for (const char* obj : {"o house\n", "# Blender\r\n\r\nmtllib a.mtl\n", "#\n#\nv 0 0 0"}) {
        EXPECT_EQ(gltf_error(obj), "f: not glTF: this is Wavefront OBJ") << obj;
    }
    EXPECT_EQ(gltf_error("# nothing\n#").find("this is"), std::string::npos);
    EXPECT_EQ(error_of([] { parse_ies("f", "version https://git-lfs.github.com/spec/v1\n"); }),
              "f: line 1: this is a Git LFS pointer: the file itself has not been fetched");
}

/// Messages go into logs and to clients, which take UTF-8 alone.
TEST(CasesFile, MessagesAboutOtherEncodingsAreText) {
    for (const char* text : {"{\"asset\":{\"version\":\"2.0\"},\"x\":\"l\xe4mp\"}", "{\"\xff\":1}",
                             "\x80", "{\"x\":\"\x01\"}"}) {
        const std::string error = gltf_error(text);
        EXPECT_TRUE(error.starts_with("f: not glTF: ")) << error;
        EXPECT_TRUE(std::all_of(error.begin(), error.end(), [](char c) {
            return c >= ' ' && c <= '~';
        })) << error;
    }
}

TEST(CasesFile, AKeyThatIsGivenTwiceIsRefused) {
    EXPECT_EQ(gltf_error(R"({"asset":{"version":"2.0"},"scene":7,"scene":0})"),
              "f: scene: is given twice in one object of the JSON");
    EXPECT_EQ(gltf_error(R"({"nodes":[{"mesh":0},{"mesh":1,"name":"a","mesh":2}]})"),
              "f: mesh: is given twice in one object of the JSON");
    EXPECT_EQ(gltf_error(R"({"nodes":[{"mesh":0,"extras":{"mesh":1}},{"mesh":1}],"mesh":[]})"), "");
}

/// The triangle of a file whose buffer has another URI.
std::string triangle_of(const std::string& before, const std::string& after, bool wrapped) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", builder.add_positions({{0, 0, 0}, {0, 0, 7}, {7, 0, 0}})}}}});
    builder.add_node({{"mesh", mesh}});
    Json json = Json::parse(builder.text());
    std::string uri = json.at("buffers").at(0).at("uri").get<std::string>();
    const std::size_t comma = uri.find(',');
    std::string body = uri.substr(comma + 1);
    for (std::size_t at = 10; wrapped && at < body.size(); at += 12) {
        body.insert(at, "\r\n");
    }
    json["buffers"][0]["uri"] = before + body + after;
    return json.dump();
}

TEST(CasesFile, Base64IsReadHoweverItIsNamedAndWrapped) {
    const TemporaryFolder folder;
    for (const char* before :
         {"data:application/octet-stream;base64,", "data:application/octet-stream;BASE64,",
          "data:;Base64,", "data:application/gltf-buffer;base64;charset=utf-8,",
          "data:application/octet-stream; base64 ,"}) {
        for (const bool wrapped : {false, true}) {
            const Scene scene = load_gltf(
                folder.write("a.gltf", triangle_of(before, wrapped ? "\n" : "", wrapped)));
            ASSERT_GE(scene.vertices.size(), 3U) << before;
            EXPECT_EQ(scene.vertices[1].position, glm::vec3(0, 0, 7)) << before;
        }
    }
}

}  // namespace
}  // namespace raybundle::test
