// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>

#include "embedded_file.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "walkthrough/new_folder.h"

namespace raybundle {

/// What a solved scene is shown by.
struct SolvedScene {
    const Scene& scene;
    const PatchMesh& mesh;
    std::span<const glm::vec4> irradiance;  ///< of patches, lx: RadianceStore::read_irradiance()
    nlohmann::ordered_json solve;           ///< how it was found, for people
};

/// Bytes of what was written, and what it holds.
struct WalkthroughSizes {
    std::size_t page = 0, geometry = 0, light = 0, textures = 0, gltf = 0;
    std::size_t vertices = 0, triangles = 0;
};

/// Writes a walkthrough: the page, what it draws, and scene.glb for other programs. client,
/// shaders: the embedded files. exposure: factor from cd/m² to display white of scene.glb. Throws
/// std::runtime_error naming the file and the reason.
WalkthroughSizes write_walkthrough(const SolvedScene& solved, std::span<const EmbeddedFile> client,
                                   std::span<const EmbeddedFile> shaders, float exposure,
                                   const NewFolder& folder);

}  // namespace raybundle
