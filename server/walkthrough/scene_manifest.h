// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/light/environment.h"
#include "walkthrough/scene_binary.h"
#include "walkthrough/scene_textures.h"

namespace raybundle {

/// What scene.json describes.
struct ManifestParts {
    const Scene& scene;
    const PositionGrid& grid;
    float light_unit = 1.0F;  ///< cd/m²
    std::span<const LightChunk> chunks;
    std::vector<ChunkPlaces> places{};                   ///< of the chunks
    std::vector<std::optional<std::size_t>> albedos{};   ///< of materials, in the geometry
    std::vector<std::optional<std::size_t>> textures{};  ///< of materials, among `written`
    std::vector<WrittenTexture> written{};
    std::optional<std::size_t> sky{};  ///< in the light
    std::size_t geometry_bytes = 0, light_bytes = 0;
    nlohmann::ordered_json solve{};  ///< how the light was found, for people
    bool live = false;  ///< light and sky come apart; chunks have objects, which can be moved
};

/// The description that the page begins with; its version is that of client_web/walkthrough.
nlohmann::ordered_json scene_manifest(const ManifestParts& parts);

}  // namespace raybundle
