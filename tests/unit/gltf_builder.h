// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/gltf_loader.h"
#include "scene/scene.h"

namespace raybundle::test {

using Json = nlohmann::json;

/// A folder that is removed with everything in it.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Writes a file in the folder, making subfolders as needed; returns its full path.
    std::string write(const std::string& name, std::string_view bytes) const;

  private:
    std::filesystem::path path_;
};

/// Builds small glTF files. `json` may be changed at will before the file is written.
class GltfBuilder {
  public:
    GltfBuilder();

    Json json;

    /// Appends bytes to the buffer, aligned to 4, and returns the index of a new buffer view.
    int add_view(const std::vector<std::uint8_t>& bytes);
    template <typename T>
    int add_view_of(const std::vector<T>& values) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
        return add_view({first, first + values.size() * sizeof(T)});
    }
    int add_accessor(int view, int component_type, std::size_t count, const char* type);
    int add_positions(const std::vector<glm::vec3>& positions);
    int add_uvs(const std::vector<glm::vec2>& uvs);
    int add_indices(const std::vector<std::uint16_t>& indices);

    /// Adds a mesh of one primitive and returns its index.
    int add_mesh(const Json& primitive);
    int add_triangle_mesh(const std::vector<glm::vec3>& corners);
    /// A box with outward faces, corners shared by its faces.
    int add_box_mesh(const glm::vec3& low, const glm::vec3& high);
    int add_material(const Json& material);
    /// Adds a node; a root of scene 0 unless told otherwise.
    int add_node(const Json& node, bool is_root = true);

    /// Bytes of the buffer so far.
    [[nodiscard]] const std::vector<std::uint8_t>& buffer() const { return buffer_; }
    /// The JSON with the buffer as a data URI, or without a URI if `embed` is false.
    [[nodiscard]] std::string text(bool embed = true) const;
    /// A GLB with the buffer as its binary chunk.
    [[nodiscard]] std::string glb() const;

    /// Writes the file to a temporary folder and loads it.
    [[nodiscard]] Scene load(const SceneSettings& settings = {}) const;

  private:
    std::vector<std::uint8_t> buffer_;
};

std::string base64(const std::vector<std::uint8_t>& bytes);

/// A PNG of the given RGBA pixels.
std::vector<std::uint8_t> png(int width, int height, const std::vector<std::uint8_t>& rgba);

/// Loads a file that must be rejected, and returns the error.
SceneError load_error(const std::string& path);
SceneError load_error(const GltfBuilder& builder);

/// True if a notice contains the text.
bool has_notice(const Scene& scene, std::string_view text);

inline const std::vector<glm::vec3> unit_triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

/// A scene of one node, "thing", that is the unit triangle.
GltfBuilder one_triangle();

/// The corner positions of a triangle in world space.
std::array<glm::vec3, 3> world_corners(const Scene& scene, const Triangle& triangle);
glm::vec3 world_normal(const Scene& scene, const Triangle& triangle);

}  // namespace raybundle::test
