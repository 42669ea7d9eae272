// SPDX-License-Identifier: Apache-2.0
// Compressed geometry and images, encoded here with the same libraries.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "gltf_builder.h"

namespace raybundle::test {
namespace {

const std::vector<glm::vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// The two triangles of a square as Draco data, with the position attribute's unique id.
std::pair<std::vector<std::uint8_t>, std::uint32_t> draco_square() {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(2);
    const int position =
        soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const std::size_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (std::uint32_t f = 0; f < 2; ++f) {
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(f), &square[faces[f][0]],
                                       &square[faces[f][1]], &square[faces[f][2]]);
    }
    const auto mesh = soup.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffer.data());
    return {{bytes, bytes + buffer.size()}, mesh->attribute(position)->unique_id()};
}

TEST(SceneCompression, Draco) {
    GltfBuilder builder;
    const auto [bytes, position_id] = draco_square();
    const int view = builder.add_view(bytes);
    // Accessors of compressed primitives have no buffer view.
    builder.json["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                                 {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    builder.json["extensionsUsed"] =
        builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    builder.add_node(
        {{"mesh", builder.add_mesh({{"attributes", {{"POSITION", 0}}},
                                    {"indices", 1},
                                    {"extensions",
                                     {{"KHR_draco_mesh_compression",
                                       {{"bufferView", view},
                                        {"attributes", {{"POSITION", position_id}}}}}}}})}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.bounds.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 1, 0));
    for (const Triangle& triangle : scene.triangles) {
        EXPECT_GT(world_normal(scene, triangle).z, 0.99F);
    }
}

/// A view of `raw` that has been meshopt-encoded; the fallback buffer is number 1.
int add_meshopt_view(GltfBuilder& builder, const std::vector<std::uint8_t>& encoded,
                     std::size_t count, std::size_t stride, const char* mode,
                     std::size_t& fallback_bytes) {
    const int raw = builder.add_view(encoded);
    Json& view = builder.json["bufferViews"][static_cast<std::size_t>(raw)];
    const Json compressed = {{"buffer", 0},
                             {"byteOffset", view["byteOffset"]},
                             {"byteLength", encoded.size()},
                             {"byteStride", stride},
                             {"count", count},
                             {"mode", mode}};
    view = {{"buffer", 1},
            {"byteOffset", fallback_bytes},
            {"byteLength", count * stride},
            {"extensions", {{"EXT_meshopt_compression", compressed}}}};
    fallback_bytes += (count * stride + 3) / 4 * 4;
    return raw;
}

TEST(SceneCompression, Meshopt) {
    GltfBuilder builder;
    std::size_t fallback_bytes = 0;
    std::vector<std::uint8_t> vertices(meshopt_encodeVertexBufferBound(4, sizeof(glm::vec3)));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), square.data(), 4,
                                               sizeof(glm::vec3)));
    const int vertex_view =
        add_meshopt_view(builder, vertices, 4, sizeof(glm::vec3), "ATTRIBUTES", fallback_bytes);
    const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    std::vector<std::uint8_t> triangles(meshopt_encodeIndexBufferBound(6, 4));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices, 6));
    const int index_view = add_meshopt_view(builder, triangles, 6, 2, "TRIANGLES", fallback_bytes);
    const int positions = builder.add_accessor(vertex_view, 5126, 4, "VEC3");
    const int order = builder.add_accessor(index_view, 5123, 6, "SCALAR");
    builder.json["extensionsUsed"] =
        builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    builder.json["buffers"] = {
        {{"byteLength", builder.buffer().size()},
         {"uri", "data:application/octet-stream;base64," + base64(builder.buffer())}},
        {{"byteLength", fallback_bytes},
         {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}},
                                                 {"indices", order}})}});
    const Scene scene = builder.load();
    ASSERT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 1, 0));
}

TEST(SceneCompression, Webp) {
    std::vector<unsigned char> webp;
    OIIO::Filesystem::IOVecOutput sink(webp);
    OIIO::Filesystem::IOProxy* proxy = &sink;
    OIIO::ImageSpec spec(8, 8, 3, OIIO::TypeDesc::UINT8);
    spec["compression"] = "lossless";
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    const auto output = OIIO::ImageOutput::create("webp");
    ASSERT_TRUE(output && output->open("image.webp", spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8,
                                    std::vector<std::uint8_t>(8 * 8 * 3, 77).data()));
    output->close();

    GltfBuilder builder;
    const int mesh = builder.add_triangle_mesh(square);
    builder.json["meshes"][0]["primitives"][0]["material"] =
        builder.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["meshes"][0]["primitives"][0]["mode"] = 6;
    builder.add_node({{"mesh", mesh}});
    builder.json["images"] = {
        {{"uri", "data:image/webp;base64," + base64({webp.begin(), webp.end()})}}};
    builder.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    builder.json["extensionsUsed"] = {"EXT_texture_webp"};
    const Scene scene = builder.load();
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].width, 8);
    EXPECT_NEAR(scene.textures[0].rgba[0], 77, 1);
    EXPECT_EQ(scene.textures[0].rgba[3], 255);
}

}  // namespace
}  // namespace raybundle::test
