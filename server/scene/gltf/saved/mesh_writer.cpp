// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/mesh_writer.h"

#include <algorithm>
#include <map>

namespace raybundle {
namespace {

constexpr int component_float = 5126;
constexpr int component_index = 5125;
constexpr std::size_t max_uv_set = 7;

template <typename T>
std::span<const std::uint8_t> raw_bytes(const std::vector<T>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// The highest texCoord in a material, of its textures and what extensions make of them: a vertex
/// has one pair of uv, whatever set it is from.
std::size_t last_uv_set(const Json& json) {
    std::size_t last = 0;
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) {
            const bool set = key == "texCoord" && value.is_number_unsigned();
            last = std::max(last, set ? value.get<std::size_t>() : last_uv_set(value));
        }
    }
    return std::min(last, max_uv_set);
}

Json corner_json(const std::vector<glm::vec3>& points, bool low) {
    glm::vec3 corner = points.front();
    for (const glm::vec3& p : points) {
        corner = low ? glm::min(corner, p) : glm::max(corner, p);
    }
    return {corner.x, corner.y, corner.z};
}

/// The vertices of some triangles, in the order of their first use.
struct Corners {
    std::vector<glm::vec3> positions, normals, colours;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> order;

    Corners(const ObjectGeometry& geometry, const std::vector<Triangle>& triangles, bool turned) {
        std::map<std::uint32_t, std::uint32_t> known;
        for (const Triangle& triangle : triangles) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t corner = triangle.vertex[turned ? 2 - k : k];
                const auto [found, is_new] = known.try_emplace(corner, positions.size());
                if (is_new) {
                    const Vertex& vertex = geometry.vertices[corner];
                    positions.push_back(vertex.position);
                    normals.push_back(vertex.normal);
                    uvs.push_back(vertex.uv);
                    colours.push_back(vertex.colour);
                }
                order.push_back(found->second);
            }
        }
    }
};

Json primitive(const Corners& corners, std::uint32_t material, GlbParts& parts) {
    const std::size_t count = corners.positions.size();
    Json attributes;
    const std::size_t positions =
        parts.add_accessor(raw_bytes(corners.positions), component_float, count, "VEC3");
    parts.json["accessors"][positions]["min"] = corner_json(corners.positions, true);
    parts.json["accessors"][positions]["max"] = corner_json(corners.positions, false);
    attributes["POSITION"] = positions;
    attributes["NORMAL"] =
        parts.add_accessor(raw_bytes(corners.normals), component_float, count, "VEC3");
    const auto has = [](const auto& values, const auto& plain) {
        return std::any_of(values.begin(), values.end(),
                           [&](const auto& value) { return value != plain; });
    };
    if (has(corners.uvs, glm::vec2(0.0F))) {
        const std::size_t uv =
            parts.add_accessor(raw_bytes(corners.uvs), component_float, count, "VEC2");
        const std::size_t last = last_uv_set(parts.json["materials"][material]);
        for (std::size_t set = 0; set <= last; ++set) {
            attributes["TEXCOORD_" + std::to_string(set)] = uv;
        }
    }
    if (has(corners.colours, glm::vec3(1.0F))) {
        attributes["COLOR_0"] =
            parts.add_accessor(raw_bytes(corners.colours), component_float, count, "VEC3");
    }
    return {{"attributes", attributes},
            {"indices", parts.add_accessor(raw_bytes(corners.order), component_index,
                                           corners.order.size(), "SCALAR")},
            {"material", material}};
}

}  // namespace

std::size_t add_mesh(const ObjectGeometry& geometry, const std::string& name, bool turned,
                     GlbParts& parts) {
    std::map<std::uint32_t, std::vector<Triangle>> by_material;
    for (const Triangle& triangle : geometry.triangles) {
        by_material[triangle.material].push_back(triangle);
    }
    Json primitives = Json::array();
    for (const auto& [material, triangles] : by_material) {
        primitives.push_back(primitive(Corners(geometry, triangles, turned), material, parts));
    }
    return parts.add("meshes", {{"name", name}, {"primitives", primitives}});
}

}  // namespace raybundle
