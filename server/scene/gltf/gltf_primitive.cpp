// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "scene/gltf/file/gltf_accessor.h"
#include "scene/gltf/file/gltf_draco.h"
#include "scene/gltf/material/gltf_material.h"

namespace raybundle {
namespace {

// Faces and bodies have some hundred; bounds the work that a small file can ask for.
constexpr std::size_t max_morph_targets = 1024;

/// Accessors by semantic, as those of a primitive or of a morph target.
using AccessorMap = std::map<std::string, int>;

int accessor_or_none(const AccessorMap& accessors, const char* semantic) {
    const auto it = accessors.find(semantic);
    return it == accessors.end() ? -1 : it->second;
}

const tinygltf::Value* draco_extension(const tinygltf::Primitive& primitive) {
    return find_extension(primitive.extensions, "KHR_draco_mesh_compression");
}

/// Attribute arrays of a primitive, from accessors or from Draco data.
class Attributes {
  public:
    Attributes(const GltfDocument& document, const tinygltf::Primitive& primitive,
               const std::string& path)
        : document_(document), accessors_(primitive.attributes), path_(path) {
        if (const tinygltf::Value* extension = draco_extension(primitive)) {
            draco_ =
                decode_draco(document, *extension, path + ".extensions.KHR_draco_mesh_compression");
        }
    }

    [[nodiscard]] const std::optional<DracoMesh>& draco() const { return draco_; }
    [[nodiscard]] bool has(const char* semantic) const {
        return (draco_ && draco_->attributes.contains(semantic)) || accessors_.contains(semantic);
    }

    /// Empty if absent.
    [[nodiscard]] std::vector<float> read(const char* semantic, std::size_t components) const {
        const std::string path = path_ + ".attributes." + semantic;
        if (draco_) {
            const auto it = draco_->attributes.find(semantic);
            if (it != draco_->attributes.end()) {
                if (it->second.components != components) {
                    document_.fail(path, fmt::format("{} components, {} are expected",
                                                     it->second.components, components));
                }
                return it->second.values;
            }
        }
        const int accessor = accessor_or_none(accessors_, semantic);
        return accessor < 0 ? std::vector<float>{}
                            : read_floats(document_, accessor, components, path);
    }

    /// COLOR_0, of three components or, alpha left out, of four. Empty if absent.
    [[nodiscard]] std::vector<glm::vec3> read_colours() const {
        const char* const semantic = "COLOR_0";
        if (!has(semantic)) {
            return {};
        }
        std::size_t components = 3;
        if (draco_ && draco_->attributes.contains(semantic)) {
            components = draco_->attributes.at(semantic).components;
        } else if (item(document_.model().accessors, accessor_or_none(accessors_, semantic)).type ==
                   TINYGLTF_TYPE_VEC4) {
            components = 4;
        }
        components = std::clamp<std::size_t>(components, 3, 4);
        const std::vector<float> values = read(semantic, components);
        std::vector<glm::vec3> colours;
        for (std::size_t i = 0; i + components <= values.size(); i += components) {
            colours.push_back(
                glm::clamp(glm::vec3(values[i], values[i + 1], values[i + 2]), 0.0F, 1.0F));
        }
        return colours;
    }

  private:
    const GltfDocument& document_;
    const AccessorMap& accessors_;
    std::string path_;
    std::optional<DracoMesh> draco_;
};

template <typename Vector>
std::vector<Vector> as_vectors(const std::vector<float>& values) {
    constexpr auto n = static_cast<std::size_t>(Vector::length());
    std::vector<Vector> result(values.size() / n);
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t c = 0; c < n; ++c) {
            result[i][static_cast<int>(c)] =
                static_cast<typename Vector::value_type>(values[i * n + c]);
        }
    }
    return result;
}

std::vector<glm::uvec3> assemble_triangles(const std::vector<std::uint32_t>& indices, int mode) {
    std::vector<glm::uvec3> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        }
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        } else {
            // Every other triangle of a strip runs the other way round (glTF 2.0, 3.7.2.1).
            const std::size_t odd = i % 2;
            triangles.emplace_back(indices[i], indices[i + 1 + odd], indices[i + 2 - odd]);
        }
    }
    return triangles;
}

void check_order(const GltfDocument& document, const std::vector<std::uint32_t>& order,
                 std::size_t vertex_count, const std::string& path) {
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (order[i] >= vertex_count) {
            document.fail(path + ".indices",
                          fmt::format("entry {} refers to vertex {}, there are {}", i, order[i],
                                      vertex_count));
        }
    }
}

std::vector<std::uint32_t> read_vertex_order(const GltfDocument& document,
                                             const tinygltf::Primitive& primitive,
                                             const Attributes& attributes, std::size_t vertex_count,
                                             const std::string& path) {
    std::vector<std::uint32_t> order;
    if (attributes.draco()) {
        order = attributes.draco()->indices;
    } else if (primitive.indices >= 0) {
        order = read_indices(document, primitive.indices, path + ".indices");
    } else {
        order.resize(vertex_count);
        for (std::size_t i = 0; i < vertex_count; ++i) {
            order[i] = static_cast<std::uint32_t>(i);
        }
    }
    check_order(document, order, vertex_count, path);
    return order;
}

void check_lengths(const GltfDocument& document, const PrimitiveData& data,
                   const std::string& path) {
    const std::size_t expected = data.positions.size();
    const auto check = [&](std::size_t size, const char* semantic) {
        if (size != 0 && size != expected) {
            document.fail(fmt::format("{}.attributes.{}", path, semantic),
                          fmt::format("has {} elements, POSITION has {}", size, expected));
        }
    };
    check(data.normals.size(), "NORMAL");
    check(data.uvs.size(), "TEXCOORD");
    check(data.colours.size(), "COLOR_0");
    check(data.joints.size(), "JOINTS_0");
    check(data.weights.size(), "WEIGHTS_0");
}

/// Empty where the target has none, or the mesh itself.
std::vector<glm::vec3> read_offsets(const GltfDocument& document, const AccessorMap& target,
                                    const char* semantic, std::size_t count,
                                    const std::string& path) {
    const int accessor = accessor_or_none(target, semantic);
    if (accessor < 0 || count == 0) {
        return {};
    }
    std::vector<glm::vec3> offsets =
        as_vectors<glm::vec3>(read_floats(document, accessor, 3, path + "." + semantic));
    if (offsets.size() != count) {
        document.fail(path + "." + semantic,
                      fmt::format("has {} elements, the mesh has {}", offsets.size(), count));
    }
    return offsets;
}

void apply_morph_targets(GltfDocument& document, const std::vector<AccessorMap>& targets,
                         const std::vector<float>& weights, const std::string& path,
                         PrimitiveData& data) {
    if (!targets.empty()) {
        document.note("morph targets are read in the rest pose that the file's weights give");
    }
    for (std::size_t i = 0; i < std::min({targets.size(), weights.size(), max_morph_targets});
         ++i) {
        if (weights[i] != 0.0F) {
            const std::string target_path = path + "." + item_path("targets", i);
            add_offsets(
                read_offsets(document, targets[i], "POSITION", data.positions.size(), target_path),
                weights[i], data.positions);
            add_offsets(
                read_offsets(document, targets[i], "NORMAL", data.normals.size(), target_path),
                weights[i], data.normals);
        }
    }
}

void read_attributes(GltfDocument& document, const Attributes& attributes, PrimitiveData& data) {
    const std::string uv_set =
        fmt::format("TEXCOORD_{}", uv_set_of_material(document, data.material));
    data.positions = as_vectors<glm::vec3>(attributes.read("POSITION", 3));
    data.normals = as_vectors<glm::vec3>(attributes.read("NORMAL", 3));
    data.uvs = as_vectors<glm::vec2>(attributes.read(uv_set.c_str(), 2));
    if (attributes.has("JOINTS_0") && attributes.has("WEIGHTS_0")) {
        data.joints = as_vectors<glm::uvec4>(attributes.read("JOINTS_0", 4));
        data.weights = as_vectors<glm::vec4>(attributes.read("WEIGHTS_0", 4));
    }
    data.colours = attributes.read_colours();
    if (attributes.has("JOINTS_1")) {
        document.note("only four joints per vertex are used");
    }
    if (data.uvs.empty() && material_has_texture(document, data.material)) {
        document.note(
            fmt::format("a textured mesh has no {}: its textures are read at uv = 0", uv_set));
    }
}

}  // namespace

void check_meshes(const GltfDocument& document) {
    // Primitives may share their indices: read them once for each number of vertices.
    std::set<std::pair<int, std::size_t>> checked;
    const std::vector<tinygltf::Mesh>& meshes = document.model().meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        std::size_t p = 0;
        for (const tinygltf::Primitive& primitive : meshes[m].primitives) {
            const std::string path = fmt::format("meshes[{}].primitives[{}]", m, p++);
            const int positions = accessor_or_none(primitive.attributes, "POSITION");
            if (positions < 0 || primitive.indices < 0 || draco_extension(primitive) != nullptr) {
                continue;
            }
            const std::size_t vertex_count = item(document.model().accessors, positions).count;
            if (checked.emplace(primitive.indices, vertex_count).second) {
                check_order(document, read_indices(document, primitive.indices, path + ".indices"),
                            vertex_count, path);
            }
        }
    }
}

std::vector<MorphTarget> read_morph_targets(const GltfDocument& document,
                                            const tinygltf::Primitive& primitive,
                                            const std::string& json_path,
                                            const PrimitiveData& data) {
    std::vector<MorphTarget> targets;
    for (std::size_t i = 0; i < std::min(primitive.targets.size(), max_morph_targets); ++i) {
        const std::string path = json_path + "." + item_path("targets", i);
        const AccessorMap& target = primitive.targets[i];
        targets.push_back({read_offsets(document, target, "POSITION", data.positions.size(), path),
                           read_offsets(document, target, "NORMAL", data.normals.size(), path)});
    }
    return targets;
}

PrimitiveData read_primitive(GltfDocument& document, const tinygltf::Primitive& primitive,
                             const std::vector<float>& morph_weights,
                             const std::string& json_path) {
    PrimitiveData data;
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        document.note("points and lines are skipped");
        return data;
    }
    const Attributes attributes(document, primitive, json_path);
    if (!attributes.has("POSITION")) {
        document.note("mesh primitives without POSITION are skipped");
        return data;
    }
    data.material = primitive.material;
    read_attributes(document, attributes, data);
    check_lengths(document, data, json_path);
    apply_morph_targets(document, primitive.targets, morph_weights, json_path, data);
    const std::vector<std::uint32_t> order =
        read_vertex_order(document, primitive, attributes, data.positions.size(), json_path);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && order.size() % 3 != 0) {
        document.note("incomplete last triangles of a mesh are skipped");
    }
    // Draco stores strips as lists.
    data.triangles =
        assemble_triangles(order, attributes.draco() ? TINYGLTF_MODE_TRIANGLES : primitive.mode);
    return data;
}

}  // namespace raybundle
