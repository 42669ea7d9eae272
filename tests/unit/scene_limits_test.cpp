// SPDX-License-Identifier: Apache-2.0
// A few bytes can ask for any amount of memory: what they ask for is bounded, before it is taken,
// and the limit is named.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

std::uint32_t crc32_of(const std::vector<std::uint8_t>& bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    return ~crc;
}

void append_u32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    for (unsigned shift = 32; shift > 0; shift -= 8) {
        bytes.push_back(static_cast<std::uint8_t>(value >> (shift - 8)));
    }
}

void append_chunk(std::vector<std::uint8_t>& file, std::vector<std::uint8_t> typed) {
    append_u32(file, static_cast<std::uint32_t>(typed.size() - 4));
    file.insert(file.end(), typed.begin(), typed.end());
    append_u32(file, crc32_of(typed));
}

/// A PNG that says how large it is, and has no pixels: whoever decodes it fails.
std::vector<std::uint8_t> png_header(std::uint32_t size) {
    std::vector<std::uint8_t> file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::vector<std::uint8_t> header = {'I', 'H', 'D', 'R'};
    append_u32(header, size);
    append_u32(header, size);
    header.insert(header.end(), {8, 6, 0, 0, 0});  // 8 bits, RGBA
    append_chunk(file, header);
    append_chunk(file, {'I', 'D', 'A', 'T', 0x78, 0x9c, 0x03, 0x00});
    append_chunk(file, {'I', 'E', 'N', 'D'});
    return file;
}

/// A triangle with `count` materials, each with a texture of its own.
GltfBuilder textured(std::uint32_t size, int count, const char* slot) {
    GltfBuilder builder = one_triangle();
    const int view = builder.add_view(png_header(size));
    for (int i = 0; i < count; ++i) {
        builder.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
        builder.json["textures"].push_back({{"source", i}});
        const Json texture = {{"index", i}};
        builder.add_material(
            slot == std::string_view("clearcoatTexture")
                ? Json{{"extensions",
                        {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {slot, texture}}}}}}
            : slot == std::string_view("normalTexture")
                ? Json{{slot, texture}}
                : Json{{"pbrMetallicRoughness", {{slot, texture}}}});
    }
    return builder;
}

TEST(SceneLimits, ImagesAreAddedUpBeforeOneIsDecoded) {
    for (const char* slot : {"baseColorTexture", "normalTexture", "clearcoatTexture"}) {
        const SceneError error = load_error(textured(8192, 40, slot));
        EXPECT_EQ(error.json_path(), "images[8]") << error.what();
        EXPECT_NE(error.reason().find("decoded images exceed 2147483648 bytes"), std::string::npos)
            << error.what();
    }
}

/// A triangle placed by an accessor that has no bytes.
GltfBuilder instanced(std::size_t count, int nodes) {
    GltfBuilder builder;
    const int offsets = builder.add_accessor(0, 5126, count, "VEC3");
    builder.json["accessors"][static_cast<std::size_t>(offsets)].erase("bufferView");
    const int mesh = builder.add_triangle_mesh(unit_triangle);
    for (int i = 0; i < nodes; ++i) {
        builder.add_node(
            {{"mesh", mesh},
             {"extensions",
              {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}});
    }
    return builder;
}

TEST(SceneLimits, InstancesOfANodeAndOfAllAreBounded) {
    const SceneError one = load_error(instanced(2'000'000, 1));
    EXPECT_EQ(one.json_path(), "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes");
    EXPECT_NE(one.reason().find("2000000 instances; the limit is 333333"), std::string::npos)
        << one.what();
    const SceneError all = load_error(instanced(200'000, 2));
    EXPECT_EQ(all.json_path(), "nodes[1]");
    EXPECT_NE(all.reason().find("more than 333333 instances"), std::string::npos) << all.what();
}

TEST(SceneLimits, VerticesAreCountedBeforeTheyAreRead) {
    GltfBuilder builder = instanced(2, 1);
    const int positions = builder.add_accessor(0, 5126, 20'000'000, "VEC3");
    builder.json["accessors"][static_cast<std::size_t>(positions)].erase("bufferView");
    builder.json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}}}};
    const SceneError error = load_error(builder);
    EXPECT_EQ(error.json_path(), "meshes[0].primitives[0]");
    EXPECT_NE(error.reason().find("more than 25000000 vertices"), std::string::npos)
        << error.what();
}

TEST(SceneLimits, NodesAndPrimitivesAreBounded) {
    GltfBuilder nodes = one_triangle();
    std::fill_n(std::back_inserter(nodes.json["nodes"].get_ref<Json::array_t&>()), 500'000,
                Json::object());
    EXPECT_EQ(load_error(nodes).json_path(), "nodes");
    GltfBuilder primitives = one_triangle();
    Json::array_t& list = primitives.json["meshes"][0]["primitives"].get_ref<Json::array_t&>();
    list.resize(500'000, list.front());
    const SceneError error = load_error(primitives);
    EXPECT_EQ(error.json_path(), "meshes[0].primitives");
    EXPECT_NE(error.reason().find("more than 500000"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace raybundle::test
