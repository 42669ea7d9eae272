// SPDX-License-Identifier: Apache-2.0
// What is not a usable scene is rejected with the place in the file and the reason.
#include <gtest/gtest.h>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <cmath>
#include <functional>
#include <limits>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

GltfBuilder indexed_triangle() {
    GltfBuilder builder;
    const int positions = builder.add_positions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int indices = builder.add_indices({0, 1, 2});
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}},
                                                 {"indices", indices}})}});
    return builder;
}

struct SceneFault {
    const char* name;
    std::function<void(Json&)> inject;
    const char* json_path;
    const char* reason;
};

void PrintTo(const SceneFault& fault, std::ostream* out) {
    *out << fault.name;
}

class SceneRejection : public testing::TestWithParam<SceneFault> {};

TEST_P(SceneRejection, NamesThePlaceAndTheReason) {
    GltfBuilder builder = indexed_triangle();
    GetParam().inject(builder.json);
    const SceneError error = load_error(builder);
    EXPECT_EQ(error.json_path(), GetParam().json_path);
    EXPECT_NE(error.reason().find(GetParam().reason), std::string::npos) << error.what();
}

const SceneFault scene_faults[] = {
    {"no_asset", [](Json& j) { j.erase("asset"); }, "asset", "is missing"},
    {"old_version", [](Json& j) { j["asset"]["version"] = "1.0"; }, "asset.version", "only 2.0"},
    {"old_file",
     [](Json& j) {
         j = {{"asset", {{"version", "1.0"}}}, {"scenes", {{"a", 1}}}};
     },
     "asset.version", "only 2.0"},
    {"newer_minimum", [](Json& j) { j["asset"]["minVersion"] = "2.1"; }, "asset.minVersion",
     "only 2.0"},
    {"required_extension", [](Json& j) { j["extensionsRequired"] = {"ACME_magic"}; },
     "extensionsRequired[0]", "ACME_magic"},
    {"required_material_extension",
     [](Json& j) { j["extensionsRequired"] = {"KHR_materials_iridescence"}; },
     "extensionsRequired[0]", "KHR_materials_iridescence"},
    {"scene_index", [](Json& j) { j["scene"] = 7; }, "scene", "out of range"},
    {"scene_type", [](Json& j) { j["scene"] = "zero"; }, "scene", "must be an index"},
    {"negative_index", [](Json& j) { j["nodes"][0]["mesh"] = -1; }, "nodes[0].mesh",
     "out of range"},
    {"fractional_index", [](Json& j) { j["nodes"][0]["mesh"] = 0.5; }, "nodes[0].mesh",
     "must be an index"},
    {"nodes_type", [](Json& j) { j["nodes"] = 3; }, "nodes", "must be an array"},
    {"primitive_type", [](Json& j) { j["meshes"][0]["primitives"][0] = 1; },
     "meshes[0].primitives[0]", "must be an object"},
    {"attribute_index",
     [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; },
     "meshes[0].primitives[0].attributes.POSITION", "99 is out of range"},
    {"indices_index", [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 99; },
     "meshes[0].primitives[0].indices", "out of range"},
    {"mode", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; },
     "meshes[0].primitives[0].mode", "not in [0, 6]"},
    {"accessor_too_long", [](Json& j) { j["accessors"][0]["count"] = 4; }, "accessors[0]",
     "needs 48 bytes"},
    {"accessor_huge", [](Json& j) { j["accessors"][0]["count"] = 4000000000U; },
     "accessors[0].count", "limit"},
    {"accessor_zero", [](Json& j) { j["accessors"][0]["count"] = 0; }, "accessors[0].count",
     "not in"},
    {"accessor_offset", [](Json& j) { j["accessors"][0]["byteOffset"] = 2; },
     "accessors[0].byteOffset", "aligned"},
    {"accessor_component", [](Json& j) { j["accessors"][0]["componentType"] = 5124; },
     "accessors[0].componentType", "no component type"},
    {"accessor_type", [](Json& j) { j["accessors"][0]["type"] = "VEC5"; }, "accessors[0].type",
     "not one of"},
    {"position_components", [](Json& j) { j["accessors"][0]["type"] = "VEC2"; },
     "meshes[0].primitives[0].attributes.POSITION", "components"},
    {"stride_small", [](Json& j) { j["bufferViews"][0]["byteStride"] = 4; },
     "bufferViews[0].byteStride", "does not fit"},
    {"stride_odd", [](Json& j) { j["bufferViews"][0]["byteStride"] = 13; },
     "bufferViews[0].byteStride", "multiple of 4"},
    {"view_range", [](Json& j) { j["bufferViews"][0]["byteLength"] = 4000; }, "bufferViews[0]",
     "outside of the buffer"},
    {"view_offset", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 4294967290U; },
     "bufferViews[0]", "outside of the buffer"},
    {"view_buffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; }, "bufferViews[0].buffer",
     "out of range"},
    {"buffer_file_missing",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 42}, {"uri", "gone.bin"}}};
     },
     "buffers[0].uri", "gone.bin\" not found"},
    {"buffer_folder",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 42}, {"uri", ".."}}};
     },
     "buffers[0].uri", "is no file"},
    {"buffer_without_uri",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 42}}};
     },
     "buffers[0].uri", "no GLB binary chunk"},
    {"buffer_short",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 42}, {"uri", "data:;base64,AAAA"}}};
     },
     "buffers[0]", "holds 3 bytes"},
    {"buffer_huge",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 4000000000U}, {"uri", "data:;base64,AAAA"}}};
     },
     "buffers[0].byteLength", "exceed"},
    {"base64",
     [](Json& j) {
         j["buffers"] = {{{"byteLength", 42}, {"uri", "data:;base64,!!"}}};
     },
     "buffers[0].uri", "not valid base64"},
    {"image_missing",
     [](Json& j) {
         j["images"] = {{{"uri", "gone.png"}}};
     },
     "images[0].uri", "gone.png\" not found"},
    {"image_empty", [](Json& j) { j["images"] = {Json::object()}; }, "images[0]", "neither"},
    {"own_child", [](Json& j) { j["nodes"][0]["children"] = {0}; }, "nodes[0]", "its own ancestor"},
    {"cycle",
     [](Json& j) {
         j["nodes"].push_back({{"children", {2}}});
         j["nodes"].push_back({{"children", {1}}});
     },
     "nodes[1]", "its own ancestor"},
    {"two_parents",
     [](Json& j) {
         j["nodes"].push_back({{"children", {2}}});
         j["nodes"].push_back(Json::object());
         j["nodes"].push_back({{"children", {2}}});
     },
     "nodes[3].children[0]", "already has the parent 1"},
    {"root_with_parent",
     [](Json& j) {
         j["nodes"].push_back({{"children", {0}}});
         j["scenes"][0]["nodes"] = {1, 0};
     },
     "scenes[0].nodes[1]", "not a root"},
    {"root_twice",
     [](Json& j) {
         j["scenes"][0]["nodes"] = {0, 0};
     },
     "scenes[0].nodes[1]", "twice"},
    {"matrix_length",
     [](Json& j) {
         j["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "nodes[0].matrix", "array of 16 numbers"},
    {"matrix_projective",
     [](Json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1}; },
     "nodes[0].matrix", "last row"},
    {"rotation_zero",
     [](Json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "nodes[0].rotation", "zero"},
    {"far_too_large",
     [](Json& j) {
         j["nodes"][0]["scale"] = {1e12, 1e12, 1e12};
     },
     "meshes[0].primitives[0].attributes.POSITION", "limit"},
    {"empty_scene", [](Json& j) { j["scenes"][0]["nodes"] = Json::array(); }, "", "no triangles"},
    {"flat_scene",
     [](Json& j) {
         j["nodes"][0]["scale"] = {0, 0, 0};
     },
     "", "no triangles with an area"},
    {"sparse_too_many",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 9},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}};
     },
     "accessors[0].sparse.count", "larger"},
    {"sparse_beyond_32_bits",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 4294967297},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}};
     },
     "accessors[0].sparse.count", "not in"},
    {"sparse_order",
     [](Json& j) {
         // The index view holds 0 1 2; read as bytes that is 0 0 1.
         j["accessors"][0]["sparse"] = {{"count", 3},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 0}}}};
     },
     "accessors[0].sparse.indices", "out of order"},
    {"metallic",
     [](Json& j) {
         j["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 2}}}}};
     },
     "materials[0].pbrMetallicRoughness.metallicFactor", "not in [0, 1]"},
    {"texture_index",
     [](Json& j) {
         j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
     },
     "materials[0].pbrMetallicRoughness.baseColorTexture.index", "out of range"},
    {"texture_source",
     [](Json& j) {
         j["textures"] = {{{"source", 3}}};
         j["materials"] = {{{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}}};
     },
     "textures[0].source", "out of range"},
    {"ktx2",
     [](Json& j) {
         j["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
         j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
     },
     "textures[0].extensions.KHR_texture_basisu", "KHR_texture_basisu"},
    {"meshopt_corrupt",
     [](Json& j) {
         j["bufferViews"][0]["extensions"] = {{"EXT_meshopt_compression",
                                               {{"buffer", 0},
                                                {"byteLength", 36},
                                                {"byteStride", 12},
                                                {"count", 3},
                                                {"mode", "ATTRIBUTES"}}}};
     },
     "bufferViews[0].extensions.EXT_meshopt_compression", "corrupt"},
    {"draco_corrupt",
     [](Json& j) {
         j["meshes"][0]["primitives"][0]["extensions"] = {
             {"KHR_draco_mesh_compression",
              {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}};
     },
     "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression", "cannot be decoded"},
};

INSTANTIATE_TEST_SUITE_P(Faults, SceneRejection, testing::ValuesIn(scene_faults),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SceneRejectionData, IndicesBeyondTheVertices) {
    GltfBuilder builder = indexed_triangle();
    builder.json["meshes"][0]["primitives"][0]["indices"] = builder.add_indices({0, 1, 3});
    const SceneError error = load_error(builder);
    EXPECT_EQ(error.json_path(), "meshes[0].primitives[0].indices");
    EXPECT_EQ(error.reason(), "entry 2 refers to vertex 3, there are 3");
}

TEST(SceneRejectionData, NonFinitePositions) {
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        GltfBuilder builder;
        builder.add_node(
            {{"mesh", builder.add_triangle_mesh({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}})}});
        const SceneError error = load_error(builder);
        EXPECT_EQ(error.json_path(), "meshes[0].primitives[0].attributes.POSITION");
        EXPECT_NE(error.reason().find("element 1 is NaN or infinite"), std::string::npos);
    }
}

TEST(SceneRejectionData, AttributesOfUnequalLength) {
    GltfBuilder builder = indexed_triangle();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        builder.add_positions({{0, 0, 1}});
    EXPECT_EQ(load_error(builder).json_path(), "meshes[0].primitives[0].attributes.NORMAL");
}

TEST(SceneRejectionData, ImagesThatAreNone) {
    GltfBuilder builder = indexed_triangle();
    builder.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["textures"] = {{{"source", 0}}};
    std::vector<std::uint8_t> bytes = png(4, 4, std::vector<std::uint8_t>(64, 9));
    for (const std::size_t keep : {std::size_t{4}, std::size_t{20}, bytes.size() / 2}) {
        const std::vector<std::uint8_t> cut(bytes.begin(),
                                            bytes.begin() + static_cast<std::ptrdiff_t>(keep));
        builder.json["images"] = {{{"uri", "data:image/png;base64," + base64(cut)}}};
#ifdef __SANITIZE_ADDRESS__
        // libpng leaves OpenImageIO's reader by longjmp, over the destructor of a string.
        const __lsan::ScopedDisabler third_party_leak;
#endif
        EXPECT_EQ(load_error(builder).json_path(), "images[0]") << keep;
    }
    builder.json["images"] = {{{"uri", "data:image/png;base64,AAAAAAAA"}}};
    EXPECT_NE(load_error(builder).reason().find("not a PNG, JPEG or WebP"), std::string::npos);
    const std::string ktx2 = "\xabKTX 20\xbb\r\n\x1a\n";
    builder.json["images"] = {
        {{"uri", "data:image/ktx2;base64," + base64({ktx2.begin(), ktx2.end()})}}};
    EXPECT_NE(load_error(builder).reason().find("KHR_texture_basisu"), std::string::npos);
}

TEST(SceneRejectionData, CutOffGlbNeverCrashes) {
    const TemporaryFolder folder;
    const std::string whole = indexed_triangle().glb();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string file = folder.write("cut.glb", whole.substr(0, length));
        (void)load_error(file);
    }
}

TEST(SceneRejectionData, DamagedGlbNeverCrashes) {
    const TemporaryFolder folder;
    const std::string whole = indexed_triangle().glb();
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        try {
            (void)load_gltf(folder.write("damaged.glb", damaged));
        } catch (const SceneError&) {
            continue;
        }
    }
}

TEST(SceneRejectionData, WhatIsNotGltf) {
    const TemporaryFolder folder;
    for (const char* text : {"", "{", "[]", "null", "42", "glTF", "#!/bin/sh\n", "{\"asset\":1}"}) {
        (void)load_error(folder.write("not.gltf", text));
    }
    EXPECT_NE(load_error(folder.path().string()).reason().find("is no file"), std::string::npos);
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    EXPECT_NE(load_error(folder.write("deep.gltf", "{\"extras\":" + deep + "}"))
                  .reason()
                  .find("nested deeper"),
              std::string::npos);
}

}  // namespace
}  // namespace raybundle::test
