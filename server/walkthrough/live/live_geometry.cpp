// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/live/live_geometry.h"

#include <algorithm>
#include <cmath>

#include "walkthrough/page_files.h"
#include "walkthrough/quantise.h"
#include "walkthrough/scene_manifest.h"

namespace raybundle {

namespace {

constexpr std::size_t block_values = 256;  // docs/decisions.md, 16
constexpr float headroom = 8.0F;

float brightest_channel(const glm::vec3& v) {
    return std::max({v.r, v.g, v.b});
}

float brightest_of(const Scene& scene, const PatchMesh& mesh, float brightest) {
    for (const glm::vec3& emission : mesh.emission) {
        brightest = std::max(brightest, brightest_channel(emission));
    }
    for (const Light& light : scene.lights) {
        brightest = std::max(brightest, brightest_channel(light.radiance));
    }
    return headroom * brightest;
}

/// Writes the files of one geometry, and where its values come from.
class Maker {
  public:
    Maker(const Scene& scene, const PatchMesh& mesh)
        : scene_(scene),
          chunks_(make_light_chunks(scene, mesh, dark(mesh), ChunkGroups::by_object)),
          albedos_(surface_albedos(scene, mesh)) {}

    LiveGeometry make(const PatchMesh& mesh, float brightest) {
        made_.unit = light_unit({}, brightest_of(scene_, mesh, brightest));
        Bounds bounds;
        for (const LightChunk& chunk : chunks_) {
            for (const glm::vec3& position : chunk.positions) {
                bounds.add(position);
            }
        }
        const PositionGrid grid(bounds);
        ManifestParts parts{.scene = scene_, .grid = grid, .chunks = chunks_};
        parts.live = true;
        parts.light_unit = made_.unit;
        add_textures(parts);
        add_geometry_file(parts);
        place_values(parts);
        parts.light_bytes = sizeof(std::uint32_t) * places_.size();
        made_.files.emplace_back("scene.json", scene_manifest(parts).dump());
        made_.blocks = cut_into_blocks(places_, block_values);
        return std::move(made_);
    }

  private:
    static VertexLight dark(const PatchMesh& mesh) {
        return {std::vector<glm::vec3>(mesh.positions.size()),
                std::vector<glm::vec3>(mesh.positions.size())};
    }

    void add_textures(ManifestParts& parts) {
        SceneTextures textures = scene_textures(scene_);
        for (std::size_t i = 0; i < textures.images.size(); ++i) {
            made_.files.emplace_back(textures.written[i].file, std::move(textures.images[i].bytes));
        }
        parts.textures = std::move(textures.of_materials);
        parts.written = std::move(textures.written);
    }

    void add_geometry_file(ManifestParts& parts) {
        ArrayFile file;
        for (const std::optional<AlbedoRow>& row : albedos_) {
            std::optional<std::size_t>& place = parts.albedos.emplace_back();
            if (row) {
                place = file.add(std::span<const glm::vec4>(*row));
            }
        }
        parts.places.resize(chunks_.size());
        for (std::size_t i = 0; i < chunks_.size(); ++i) {
            add_geometry(file, parts.grid, chunks_[i], parts.places[i]);
        }
        parts.geometry_bytes = file.bytes();
        made_.files.emplace_back("geometry.bin", file.text());
    }

    void place_values(ManifestParts& parts) {
        for (std::size_t i = 0; i < chunks_.size(); ++i) {
            parts.places[i].front = place_side(chunks_[i], 0);
            if (chunks_[i].two_sided) {
                parts.places[i].back = place_side(chunks_[i], 1);
            }
        }
        for (std::size_t i = 0; i < chunks_.size(); ++i) {
            place_emission(chunks_[i], parts.places[i]);
        }
    }

    std::size_t place_side(const LightChunk& chunk, std::uint32_t back) {
        const std::size_t first = sizeof(std::uint32_t) * places_.size();
        for (const std::uint32_t vertex : chunk.vertices) {
            made_.sources.push_back(2 * vertex + back);
        }
        places_.insert(places_.end(), chunk.positions.begin(), chunk.positions.end());
        return first;
    }

    void place_emission(const LightChunk& chunk, ChunkPlaces& places) {
        const std::size_t first = sizeof(std::uint32_t) * places_.size();
        made_.emission_triangles.insert(made_.emission_triangles.end(),
                                        chunk.emission_triangles.begin(),
                                        chunk.emission_triangles.end());
        if (chunk.emissions.empty()) {
            places.emission = first;
            places_.push_back(chunk.positions.front());
        } else {
            places.emissions = first;
            places_.insert(places_.end(), chunk.positions.begin(), chunk.positions.end());
        }
    }

    const Scene& scene_;
    std::vector<LightChunk> chunks_;
    std::vector<std::optional<AlbedoRow>> albedos_;
    std::vector<glm::vec3> places_;  // of all values
    LiveGeometry made_;
};

}  // namespace

LiveGeometry make_live_geometry(const Scene& scene, const PatchMesh& mesh, float brightest,
                                std::span<const EmbeddedFile> shaders) {
    LiveGeometry made = Maker(scene, mesh).make(mesh, brightest);
    for (ShaderText& shader : walkthrough_shaders(shaders)) {
        made.files.emplace_back(std::move(shader.name), std::move(shader.text));
    }
    return made;
}

std::vector<std::uint32_t> emission_values(const LiveGeometry& geometry,
                                           std::span<const glm::vec3> emission) {
    std::vector<std::uint32_t> values;
    values.reserve(geometry.emission_triangles.size());
    for (const std::uint32_t triangle : geometry.emission_triangles) {
        values.push_back(rgb9e5(emission[triangle] / geometry.unit));
    }
    return values;
}

LiveSky make_live_sky(const Sky& sky) {
    const std::vector<glm::vec3> texels = sky_texels(sky);
    float most = 0.0F;
    for (const glm::vec3& texel : texels) {
        most = std::max(most, brightest_channel(texel));
    }
    LiveSky made{.uniform = sky.uniform, .texels = {}, .unit = light_unit({}, most), .sun = {}};
    const std::vector<std::uint32_t> packed = packed_light(texels, 1.0F / made.unit);
    made.texels.assign(reinterpret_cast<const char*>(packed.data()),
                       sizeof(std::uint32_t) * packed.size());
    if (sky.environment) {
        made.sun = sun_disc(*sky.environment);
    }
    return made;
}

}  // namespace raybundle
