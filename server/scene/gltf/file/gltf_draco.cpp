// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <array>
#include <span>

namespace raybundle {
namespace {

constexpr std::uint32_t max_draco_vertices = 1U << 24U;

DracoAttribute read_attribute(const GltfDocument& document, const draco::Mesh& mesh,
                              const draco::PointAttribute& attribute,
                              const std::string& json_path) {
    std::array<float, 4> element{};
    const auto components = static_cast<std::size_t>(attribute.num_components());
    DracoAttribute result{components, {}};
    result.values.reserve(mesh.num_points() * components);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        // Corrupt data can point beyond the values.
        const draco::AttributeValueIndex value = attribute.mapped_index(point);
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<float>(value, static_cast<std::int8_t>(components),
                                           element.data())) {
            document.fail(json_path, "Draco data is corrupt");
        }
        result.values.insert(result.values.end(), element.begin(),
                             element.begin() + static_cast<std::ptrdiff_t>(components));
    }
    return result;
}

std::unique_ptr<draco::Mesh> decode_mesh(const GltfDocument& document,
                                         std::span<const std::uint8_t> bytes,
                                         const std::string& json_path) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        document.fail(json_path, fmt::format("Draco data cannot be decoded: {}",
                                             decoded.status().error_msg_string()));
    }
    std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    if (mesh->num_points() > max_draco_vertices || mesh->num_faces() > max_draco_vertices) {
        document.fail(json_path, "Draco mesh is too large");
    }
    return mesh;
}

}  // namespace

DracoMesh decode_draco(const GltfDocument& document, const tinygltf::Value& extension,
                       const std::string& json_path) {
    const int view = integer_or(extension, "bufferView", -1);
    const auto mesh = decode_mesh(document, document.view_bytes(view), json_path);
    DracoMesh result;
    result.vertex_count = mesh->num_points();
    for (const auto& [semantic, id] : extension.Get("attributes").Get<tinygltf::Value::Object>()) {
        // Unsigned in the file; tinygltf keeps the same 32 bits as an int.
        const draco::PointAttribute* attribute =
            mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id.GetNumberAsInt()));
        if (attribute == nullptr || attribute->num_components() > 4) {
            document.fail(fmt::format("{}.attributes.{}", json_path, semantic),
                          "the Draco data has no such attribute");
        }
        result.attributes[semantic] = read_attribute(document, *mesh, *attribute, json_path);
    }
    result.indices.reserve(std::size_t{mesh->num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face) {
        for (const draco::PointIndex& corner : mesh->face(face)) {
            result.indices.push_back(corner.value());
        }
    }
    return result;
}

}  // namespace raybundle
