// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "walkthrough/texture_images.h"

namespace raybundle {

/// A texture in the folder.
struct WrittenTexture {
    std::string file;
    bool repeat_u = true, repeat_v = true;
};

/// Base colour textures as browsers get them.
struct SceneTextures {
    std::vector<TextureImage> images;
    std::vector<WrittenTexture> written;                   ///< of the images
    std::vector<std::optional<std::size_t>> of_materials;  ///< among the images
};

/// Each texture once, but once more where only some of its materials have holes. Throws
/// std::runtime_error.
SceneTextures scene_textures(const Scene& scene);

}  // namespace raybundle
