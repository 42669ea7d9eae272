// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/walkthrough.h"

#include <algorithm>
#include <utility>

#include "scene/light/environment.h"
#include "walkthrough/baked_gltf.h"
#include "walkthrough/page_files.h"
#include "walkthrough/scene_manifest.h"
#include "walkthrough/scene_textures.h"
#include "walkthrough/texture_images.h"

namespace raybundle {

namespace {

/// Writes one walkthrough.
class Writer {
  public:
    Writer(const SolvedScene& solved, const NewFolder& folder)
        : solved_(solved),
          folder_(folder),
          chunks_(make_light_chunks(
              solved.scene, solved.mesh,
              light_at_vertices(solved.mesh, world_positions(solved.scene, solved.mesh),
                                solved.irradiance))),
          albedos_(surface_albedos(solved.scene, solved.mesh)) {}

    void write_page(std::span<const EmbeddedFile> client, std::span<const EmbeddedFile> shaders) {
        for (const EmbeddedFile& file : walkthrough_page(client)) {
            write_bytes(folder_.file(std::string(file.name)), file.contents);
            sizes_.page += file.contents.size();
        }
        for (const ShaderText& shader : walkthrough_shaders(shaders)) {
            write_bytes(folder_.file(shader.name), shader.text);
            sizes_.page += shader.text.size();
        }
    }

    void write_scene(float exposure) {
        const PositionGrid grid(chunk_bounds());
        ManifestParts parts{.scene = solved_.scene, .grid = grid, .chunks = chunks_};
        parts.solve = solved_.solve;
        const std::vector<TextureImage> images = write_textures(parts);
        write_geometry(parts);
        write_light(parts);
        const std::string manifest = scene_manifest(parts).dump();
        write_bytes(folder_.file("scene.json"), manifest);
        sizes_.page += manifest.size();
        const BakedGltf baked{solved_.scene, chunks_, albedos_, parts.textures,
                              parts.written, images,  exposure};
        sizes_.gltf = write_baked_gltf(baked, folder_.file("scene.glb"));
    }

    [[nodiscard]] WalkthroughSizes sizes() const {
        WalkthroughSizes sizes = sizes_;
        for (const LightChunk& chunk : chunks_) {
            sizes.vertices += chunk.positions.size();
            sizes.triangles += chunk.indices.size() / 3;
        }
        return sizes;
    }

  private:
    [[nodiscard]] Bounds chunk_bounds() const {
        Bounds bounds;
        for (const LightChunk& chunk : chunks_) {
            for (const glm::vec3& position : chunk.positions) {
                bounds.add(position);
            }
        }
        return bounds;
    }

    std::vector<TextureImage> write_textures(ManifestParts& parts) {
        SceneTextures textures = scene_textures(solved_.scene);
        for (std::size_t i = 0; i < textures.images.size(); ++i) {
            write_bytes(folder_.file(textures.written[i].file), textures.images[i].bytes);
            sizes_.textures += textures.images[i].bytes.size();
        }
        parts.textures = std::move(textures.of_materials);
        parts.written = std::move(textures.written);
        return std::move(textures.images);
    }

    void write_geometry(ManifestParts& parts) {
        ArrayFile file(folder_.file("geometry.bin"));
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
        file.close();
        parts.geometry_bytes = sizes_.geometry = file.bytes();
    }

    void write_light(ManifestParts& parts) {
        ArrayFile file(folder_.file("light.bin"));
        const std::vector<glm::vec3> sky = sky_texels(sky_of(solved_.scene));
        float most = 0.0F;
        for (const glm::vec3& texel : sky) {
            most = std::max({most, texel.r, texel.g, texel.b});
        }
        parts.light_unit = light_unit(chunks_, most);
        for (std::size_t i = 0; i < chunks_.size(); ++i) {
            add_light(file, parts.light_unit, chunks_[i], parts.places[i]);
        }
        if (!sky.empty()) {
            std::vector<std::uint32_t> packed(sky.size());
            std::transform(sky.begin(), sky.end(), packed.begin(), [&](const glm::vec3& texel) {
                return rgb9e5(texel / parts.light_unit);
            });
            parts.sky = file.add(std::span<const std::uint32_t>(packed));
        }
        file.close();
        parts.light_bytes = sizes_.light = file.bytes();
    }

    const SolvedScene& solved_;
    const NewFolder& folder_;
    std::vector<LightChunk> chunks_;
    std::vector<std::optional<AlbedoRow>> albedos_;
    WalkthroughSizes sizes_;
};

}  // namespace

WalkthroughSizes write_walkthrough(const SolvedScene& solved, std::span<const EmbeddedFile> client,
                                   std::span<const EmbeddedFile> shaders, float exposure,
                                   const NewFolder& folder) {
    Writer writer(solved, folder);
    writer.write_page(client, shaders);
    writer.write_scene(exposure);
    return writer.sizes();
}

}  // namespace raybundle
