// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "embedded_file.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "walkthrough/live/light_stream.h"
#include "walkthrough/scene_binary.h"

namespace raybundle {

/// What browsers draw a running scene with. Its files are those of an export without light, which
/// is one row of values: first irradiance / pi at vertices, then radiance of lamps; both as
/// rgb9e5(), in units of `unit` cd/m².
struct LiveGeometry {
    std::vector<std::pair<std::string, std::string>> files;  ///< name, contents
    float unit = 1.0F;  ///< a power of two; light of 65408 units and more is cut off
    /// Of the first values: twice the mesh's vertex, and 1 more for the back.
    std::vector<std::uint32_t> sources;
    /// Of the others: triangle of the mesh that shines.
    std::vector<std::uint32_t> emission_triangles;
    std::vector<LightBlock> blocks;  ///< of all values
};

/// Makes it of a scene as it is now. brightest: largest radiance that reflected light has now,
/// cd/m²; lights may become eight times as bright as the brightest of all. shaders: the embedded
/// ones, of which the page draws with some. Takes long: textures are encoded. Throws
/// std::runtime_error where a texture cannot be.
LiveGeometry make_live_geometry(const Scene& scene, const PatchMesh& mesh, float brightest,
                                std::span<const EmbeddedFile> shaders);

/// Values of lamps. emission: of the mesh's triangles, cd/m².
std::vector<std::uint32_t> emission_values(const LiveGeometry& geometry,
                                           std::span<const glm::vec3> emission);

/// What is behind all.
struct LiveSky {
    glm::vec3 uniform{0.0F};  ///< cd/m²
    std::string texels;       ///< sky_width x sky_height, as rgb9e5(); empty: it is uniform
    float unit = 1.0F;        ///< of the texels, cd/m²
    std::optional<SunDisc> sun;
};
LiveSky make_live_sky(const Sky& sky);

}  // namespace raybundle
