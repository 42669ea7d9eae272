// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/scene_textures.h"

#include "scene/mesh/patch_colour.h"

namespace raybundle {

namespace {

constexpr int most_texels = 1024;  // along an edge: a metre of wall, 1 mm a texel

}  // namespace

SceneTextures scene_textures(const Scene& scene) {
    SceneTextures textures;
    std::vector<std::optional<std::size_t>> known(2 * scene.textures.size());
    for (const Material& material : scene.materials) {
        std::optional<std::size_t>& own = textures.of_materials.emplace_back();
        if (material.base_colour_texture.texture < 0) {
            continue;
        }
        const auto index = static_cast<std::size_t>(material.base_colour_texture.texture);
        const bool alpha = texture_alpha_cutoff(material).has_value();
        std::optional<std::size_t>& written = known[2 * index + (alpha ? 1 : 0)];
        if (!written) {
            written = textures.images.size();
            textures.images.push_back(texture_image(scene.textures[index], alpha, most_texels));
            textures.written.push_back({"textures/" + std::to_string(*written) +
                                            (textures.images.back().png ? ".png" : ".jpg"),
                                        scene.textures[index].repeat_u,
                                        scene.textures[index].repeat_v});
        }
        own = written;
    }
    return textures;
}

}  // namespace raybundle
