// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "walkthrough/light_chunks.h"
#include "walkthrough/scene_manifest.h"
#include "walkthrough/surface_albedo.h"
#include "walkthrough/texture_images.h"

namespace raybundle {

/// A solved scene for programs that only show what is in a file.
struct BakedGltf {
    const Scene& scene;
    std::span<const LightChunk> chunks;
    std::span<const std::optional<AlbedoRow>> albedos;     ///< of materials
    std::span<const std::optional<std::size_t>> textures;  ///< of materials, among `images`
    std::span<const WrittenTexture> written;
    std::span<const TextureImage> images;
    float exposure = 1.0F;  ///< factor from cd/m² to display white
};

/// Writes glTF 2.0, binary: positions and COLOR_0 (normalised 16 bits, linear), all materials
/// KHR_materials_unlit. COLOR_0 times the base colour texture is the radiance towards an eye 53
/// degrees from the normal, times the exposure; what is brighter than display white is 1. asset.
/// extras.raybundle has the exposure. Back sides are triangles of their own. Returns the size of
/// the file, bytes. Throws std::runtime_error naming it.
std::size_t write_baked_gltf(const BakedGltf& baked, const std::filesystem::path& path);

}  // namespace raybundle
