// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <utility>

namespace raybundle::test {
namespace {

void append_u32(std::string& out, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        out.push_back(static_cast<char>((value >> shift) & 0xffU));
    }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    static std::atomic<int> serial{0};
    path_ = std::filesystem::temp_directory_path() /
            ("raybundle_test_" + std::to_string(::getpid()) + "_" + std::to_string(serial++));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
}

GltfBuilder::GltfBuilder() {
    json = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", Json::array()}}}},
            {"nodes", Json::array()},
            {"meshes", Json::array()},
            {"accessors", Json::array()},
            {"bufferViews", Json::array()}};
}

int GltfBuilder::add_view(const std::vector<std::uint8_t>& bytes) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfBuilder::add_accessor(int view, int component_type, std::size_t count, const char* type) {
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfBuilder::add_positions(const std::vector<glm::vec3>& positions) {
    return add_accessor(add_view_of(positions), 5126, positions.size(), "VEC3");
}

int GltfBuilder::add_uvs(const std::vector<glm::vec2>& uvs) {
    return add_accessor(add_view_of(uvs), 5126, uvs.size(), "VEC2");
}

int GltfBuilder::add_indices(const std::vector<std::uint16_t>& indices) {
    return add_accessor(add_view_of(indices), 5123, indices.size(), "SCALAR");
}

int GltfBuilder::add_mesh(const Json& primitive) {
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    return static_cast<int>(json["meshes"].size()) - 1;
}

int GltfBuilder::add_triangle_mesh(const std::vector<glm::vec3>& corners) {
    return add_mesh({{"attributes", {{"POSITION", add_positions(corners)}}}});
}

int GltfBuilder::add_box_mesh(const glm::vec3& low, const glm::vec3& high) {
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i) {
        corners.emplace_back((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                             (i & 4U) != 0 ? high.z : low.z);
    }
    const std::vector<std::uint16_t> indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
                                                0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,
                                                0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return add_mesh({{"attributes", {{"POSITION", add_positions(corners)}}},
                     {"indices", add_indices(indices)}});
}

int GltfBuilder::add_material(const Json& material) {
    json["materials"].push_back(material);
    return static_cast<int>(json["materials"].size()) - 1;
}

int GltfBuilder::add_node(const Json& node, bool is_root) {
    json["nodes"].push_back(node);
    const int index = static_cast<int>(json["nodes"].size()) - 1;
    if (is_root) {
        json["scenes"][0]["nodes"].push_back(index);
    }
    return index;
}

std::string GltfBuilder::text(bool embed) const {
    Json file = json;
    if (!file.contains("buffers") && !buffer_.empty()) {
        Json buffer = {{"byteLength", buffer_.size()}};
        if (embed) {
            buffer["uri"] = "data:application/octet-stream;base64," + base64(buffer_);
        }
        file["buffers"] = Json::array({buffer});
    }
    return file.dump();
}

std::string GltfBuilder::glb() const {
    std::string chunk = text(false);
    chunk.resize((chunk.size() + 3) / 4 * 4, ' ');
    std::string binary(buffer_.begin(), buffer_.end());
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    append_u32(file, 2);
    append_u32(file, 12 + 8 + chunk.size() + 8 + binary.size());
    append_u32(file, chunk.size());
    file += "JSON" + chunk;
    append_u32(file, binary.size());
    file += std::string("BIN\0", 4) + binary;
    return file;
}

Scene GltfBuilder::load(const SceneSettings& settings) const {
    const TemporaryFolder folder;
    return load_gltf(folder.write("scene.gltf", text()), settings);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8U | (i + k < bytes.size() ? bytes[i + k] : 0U);
        }
        for (unsigned k = 0; k < 4; ++k) {
            const bool present = i + k <= bytes.size();
            out.push_back(present ? alphabet[(bits >> (18 - 6 * k)) & 63U] : '=');
        }
    }
    return out;
}

std::vector<std::uint8_t> png(int width, int height, const std::vector<std::uint8_t>& rgba) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    OIIO::Filesystem::IOProxy* proxy = &sink;
    OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
    const auto output = OIIO::ImageOutput::create("png");
    EXPECT_TRUE(output->open("image.png", spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, rgba.data()));
    output->close();
    return bytes;
}

SceneError load_error(const std::string& path) {
    try {
        (void)load_gltf(path);
    } catch (const SceneError& error) {
        EXPECT_EQ(error.file(), path);
        return error;
    }
    ADD_FAILURE() << path << " was not rejected";
    return {path, "", "was not rejected"};
}

SceneError load_error(const GltfBuilder& builder) {
    const TemporaryFolder folder;
    return load_error(folder.write("scene.gltf", builder.text()));
}

bool has_notice(const Scene& scene, std::string_view text) {
    for (const std::string& notice : scene.notices) {
        if (notice.find(text) != std::string::npos) {
            return true;
        }
    }
    return false;
}

GltfBuilder one_triangle() {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_triangle_mesh(unit_triangle)}, {"name", "thing"}});
    return builder;
}

std::array<glm::vec3, 3> world_corners(const Scene& scene, const Triangle& triangle) {
    const glm::mat4 world = scene.objects[triangle.object].world_from_object();
    std::array<glm::vec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] =
            glm::vec3(world * glm::vec4(scene.vertices[triangle.vertex[k]].position, 1.0F));
    }
    return corners;
}

glm::vec3 world_normal(const Scene& scene, const Triangle& triangle) {
    const auto p = world_corners(scene, triangle);
    return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
}

}  // namespace raybundle::test
