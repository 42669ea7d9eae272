// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/baked_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "scene/mesh/patch_colour.h"

namespace raybundle {

namespace {

using Json = nlohmann::ordered_json;
using Colour = std::array<std::uint16_t, 4>;

constexpr std::size_t eye_entry = 24;  // of an AlbedoRow: a cosine of 0.6
constexpr int component_short = 5123, component_float = 5126;
constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

/// Accessors and buffer views grow in the order in which write() sends their bytes.
class Layout {
  public:
    explicit Layout(Json& gltf) : gltf_(gltf) {}

    int add_view(std::size_t bytes) {
        gltf_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset_}, {"byteLength", bytes}});
        offset_ += (bytes + 3) / 4 * 4;
        return static_cast<int>(gltf_["bufferViews"].size()) - 1;
    }

    int add_accessor(int component, std::size_t count, const char* type, std::size_t bytes) {
        const int view = add_view(count * bytes);
        const bool indices = std::string_view(type) == "SCALAR";
        gltf_["bufferViews"].back()["target"] = indices ? 34963 : 34962;
        gltf_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return static_cast<int>(gltf_["accessors"].size()) - 1;
    }

    [[nodiscard]] std::size_t bytes() const { return offset_; }

  private:
    Json& gltf_;
    std::size_t offset_ = 0;
};

class Baker {
  public:
    explicit Baker(const BakedGltf& baked) : baked_(baked) {}

    /// All but the binary chunk. Sets its size.
    Json describe(std::size_t& binary_bytes) {
        Json gltf = {{"asset",
                      {{"version", "2.0"},
                       {"generator", "Raybundle " RAYBUNDLE_VERSION},
                       {"extras", {{"raybundle", {{"exposure", baked_.exposure}}}}}}},
                     {"extensionsUsed", {"KHR_materials_unlit"}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}},
                     {"nodes", {{{"name", baked_.scene.name}, {"mesh", 0}}}}};
        add_cameras(gltf);
        Layout layout(gltf);
        for (const LightChunk& chunk : baked_.chunks) {
            describe_chunk(gltf, layout, chunk);
        }
        add_images(gltf, layout);
        add_materials(gltf);
        binary_bytes = layout.bytes();
        gltf["buffers"] = {{{"byteLength", binary_bytes}}};
        return gltf;
    }

    void write(ArrayFile& file) const {
        for (const LightChunk& chunk : baked_.chunks) {
            file.add(std::span<const glm::vec3>(chunk.positions));
            if (has_texture(chunk)) {
                file.add(std::span<const glm::vec2>(chunk.uvs));
            }
            file.add(std::span<const Colour>(colours(chunk, chunk.front)));
            file.add(std::span<const std::uint16_t>(chunk.indices));
            if (chunk.two_sided) {
                file.add(std::span<const Colour>(colours(chunk, chunk.back)));
                file.add(std::span<const std::uint16_t>(turned(chunk.indices)));
            }
        }
        for (const TextureImage& image : baked_.images) {
            file.add(std::span<const char>(image.bytes));
        }
    }

  private:
    [[nodiscard]] const Material& material_of(const LightChunk& chunk) const {
        return baked_.scene.materials[chunk.material];
    }

    /// Lamps show what they emit beside, or in the place of, their texture.
    [[nodiscard]] bool has_texture(const LightChunk& chunk) const {
        return has_texture(chunk.material);
    }
    [[nodiscard]] bool has_texture(std::size_t material) const {
        return baked_.textures[material].has_value() &&
               baked_.scene.materials[material].emission == glm::vec3(0.0F);
    }

    static std::vector<std::uint16_t> turned(std::vector<std::uint16_t> indices) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            std::swap(indices[i + 1], indices[i + 2]);
        }
        return indices;
    }

    void describe_chunk(Json& gltf, Layout& layout, const LightChunk& chunk) {
        const std::size_t count = chunk.positions.size();
        Json attributes;
        const int positions =
            layout.add_accessor(component_float, count, "VEC3", sizeof(glm::vec3));
        Bounds bounds;
        for (const glm::vec3& position : chunk.positions) {
            bounds.add(position);
        }
        Json& accessor = gltf["accessors"][static_cast<std::size_t>(positions)];
        accessor["min"] = {bounds.min.x, bounds.min.y, bounds.min.z};
        accessor["max"] = {bounds.max.x, bounds.max.y, bounds.max.z};
        attributes["POSITION"] = positions;
        if (has_texture(chunk)) {
            attributes["TEXCOORD_0"] =
                layout.add_accessor(component_float, count, "VEC2", sizeof(glm::vec2));
        }
        add_side(gltf, layout, chunk, attributes);
        if (chunk.two_sided) {
            add_side(gltf, layout, chunk, attributes);
        }
    }

    static void add_side(Json& gltf, Layout& layout, const LightChunk& chunk, Json attributes) {
        const int colour =
            layout.add_accessor(component_short, chunk.positions.size(), "VEC4", sizeof(Colour));
        gltf["accessors"][static_cast<std::size_t>(colour)]["normalized"] = true;
        attributes["COLOR_0"] = colour;
        const int indices = layout.add_accessor(component_short, chunk.indices.size(), "SCALAR",
                                                sizeof(std::uint16_t));
        gltf["meshes"][0]["primitives"].push_back(
            {{"attributes", attributes}, {"indices", indices}, {"material", chunk.material}});
    }

    void add_cameras(Json& gltf) const {
        for (const Camera& camera : baked_.scene.cameras) {
            constexpr double nearest = 0.01;  // m
            const glm::mat4 m = glm::inverse(glm::lookAt(camera.eye, camera.target, camera.up));
            Json matrix = Json::array();
            for (int i = 0; i < 16; ++i) {
                matrix.push_back(m[i / 4][i % 4]);
            }
            gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size());
            gltf["nodes"].push_back(
                {{"name", camera.name}, {"camera", gltf["cameras"].size()}, {"matrix", matrix}});
            gltf["cameras"].push_back(
                {{"name", camera.name},
                 {"type", "perspective"},
                 {"perspective", {{"yfov", camera.vertical_fov}, {"znear", nearest}}}});
        }
    }

    void add_images(Json& gltf, Layout& layout) const {
        for (std::size_t i = 0; i < baked_.images.size(); ++i) {
            const TextureImage& image = baked_.images[i];
            gltf["images"].push_back({{"bufferView", layout.add_view(image.bytes.size())},
                                      {"mimeType", image.png ? "image/png" : "image/jpeg"}});
            const auto wrap = [](bool repeats) { return repeats ? 10497 : 33071; };
            gltf["samplers"].push_back({{"wrapS", wrap(baked_.written[i].repeat_u)},
                                        {"wrapT", wrap(baked_.written[i].repeat_v)}});
            gltf["textures"].push_back({{"source", i}, {"sampler", i}});
        }
    }

    void add_materials(Json& gltf) const {
        for (std::size_t i = 0; i < baked_.scene.materials.size(); ++i) {
            const Material& material = baked_.scene.materials[i];
            Json surface = {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
            Json result = {{"name", material.name},
                           {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
            if (has_texture(i)) {
                surface["baseColorTexture"] = {{"index", *baked_.textures[i]}};
                if (const std::optional<float> cutoff = texture_alpha_cutoff(material)) {
                    result["alphaMode"] = "MASK";
                    result["alphaCutoff"] = *cutoff;
                }
            }
            if (const float passing = luminance(transparency(baked_.scene, i)); passing > 0.0F) {
                surface["baseColorFactor"] = {1.0, 1.0, 1.0, 1.0F - passing};
                result["alphaMode"] = "BLEND";
            }
            result["pbrMetallicRoughness"] = surface;
            gltf["materials"].push_back(result);
        }
    }

    /// What the texture is multiplied by, or all that is reflected where there is none.
    [[nodiscard]] glm::vec3 reflected(const LightChunk& chunk, const glm::vec3& colour) const {
        const std::optional<AlbedoRow>& row = baked_.albedos[chunk.material];
        if (!row) {
            return colour;
        }
        const glm::vec4& albedo = (*row)[eye_entry];
        const glm::vec3 own = has_texture(chunk) ? glm::vec3(0.0F) : glm::vec3(albedo);
        return own + albedo.a * colour;
    }

    [[nodiscard]] std::vector<Colour> colours(const LightChunk& chunk,
                                              std::span<const glm::vec3> light) const {
        const Material& material = material_of(chunk);
        const bool textured = has_texture(chunk);
        const glm::vec3 whole =
            textured ? material.base_colour : mean_base_colour(baked_.scene, material);
        std::vector<Colour> result(light.size());
        for (std::size_t i = 0; i < light.size(); ++i) {
            const glm::vec3 colour = chunk.colours.empty() ? whole : whole * chunk.colours[i];
            const glm::vec3 emission =
                chunk.emissions.empty() ? chunk.emission : chunk.emissions[i];
            const glm::vec3 radiance =
                emission + reflected(chunk, colour) * light[i] * glm::one_over_pi<float>();
            result[i] = packed(material.unlit ? colour : baked_.exposure * radiance);
        }
        return result;
    }

    static Colour packed(const glm::vec3& colour) {
        constexpr float most = std::numeric_limits<std::uint16_t>::max();
        Colour result{0, 0, 0, std::numeric_limits<std::uint16_t>::max()};
        for (int c = 0; c < 3; ++c) {
            const float value = colour[c] > 0.0F ? std::min(colour[c], 1.0F) : 0.0F;
            result[static_cast<std::size_t>(c)] =
                static_cast<std::uint16_t>(std::lround(most * value));
        }
        return result;
    }

    const BakedGltf& baked_;
};

}  // namespace

std::size_t write_baked_gltf(const BakedGltf& baked, const std::filesystem::path& path) {
    Baker baker(baked);
    std::size_t binary_bytes = 0;
    std::string text = baker.describe(binary_bytes).dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    constexpr std::size_t headers = 28;
    const std::size_t all = headers + text.size() + binary_bytes;
    if (all > std::numeric_limits<std::uint32_t>::max()) {
        throw std::runtime_error(path.string() + ": cannot be written: binary glTF ends at 4 GiB");
    }
    const auto word = [](std::size_t value) { return static_cast<std::uint32_t>(value); };
    ArrayFile file(path);
    const std::array<std::uint32_t, 5> head = {magic, 2, word(all), word(text.size()), json_chunk};
    file.add(std::span<const std::uint32_t>(head));
    file.add(std::span<const char>(text));
    const std::array<std::uint32_t, 2> binary = {word(binary_bytes), binary_chunk};
    file.add(std::span<const std::uint32_t>(binary));
    baker.write(file);
    file.close();
    return file.bytes();
}

}  // namespace raybundle
