// SPDX-License-Identifier: Apache-2.0
// The two binary files of a walkthrough, little-endian, every array at a multiple of 4 bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/light/environment.h"
#include "walkthrough/light_chunks.h"
#include "walkthrough/quantise.h"
#include "walkthrough/surface_albedo.h"

namespace raybundle {

/// A file that grows array by array, or the same in memory.
class ArrayFile {
  public:
    ArrayFile();
    explicit ArrayFile(const std::filesystem::path& path);

    /// Returns the place of its first byte in the file.
    template <typename T>
    std::size_t add(std::span<const T> values) {
        return add_bytes(values.data(), values.size_bytes());
    }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    /// Throws std::runtime_error naming the file where not all of it is on disk.
    void close();
    /// Contents, where it is in memory.
    [[nodiscard]] std::string text() const;

  private:
    std::size_t add_bytes(const void* data, std::size_t size);

    std::filesystem::path path_;
    std::unique_ptr<std::ostream> stream_;
    std::size_t bytes_ = 0;
};

/// Where a chunk's arrays are: the first five in the file of the geometry, the others in that of
/// the light.
struct ChunkPlaces {
    std::size_t vertices = 0, indices = 0;
    std::optional<std::size_t> uvs, colours;
    std::size_t front = 0;
    std::optional<std::size_t> back, emissions;
    std::optional<std::size_t> emission;  ///< of all of it, where it comes with the light
};

/// 12 bytes a vertex (packed_vertex()), 2 an index, 8 a uv (floats), 4 a colour (packed_colour()).
/// Fills the chunk's places.
void add_geometry(ArrayFile& file, const PositionGrid& grid, const LightChunk& chunk,
                  ChunkPlaces& places);
/// 4 bytes a vertex: radiance of a white surface, that is irradiance / pi, in units of so many
/// cd/m², as rgb9e5().
void add_light(ArrayFile& file, float unit, const LightChunk& chunk, ChunkPlaces& places);

/// Power of two, cd/m²: all light fits into rgb9e5() in it. most: largest radiance besides that of
/// the chunks, cd/m².
float light_unit(std::span<const LightChunk> chunks, float most);

/// The disc of a sun, as GpuScene::set_background() shows it.
struct SunDisc {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< to it, unit
    float cosine = 1.0F;                    ///< of its angular radius
    glm::vec3 radiance{0.0F};               ///< cd/m²
};
/// Nothing where the environment has no sun, or shows it with its texels.
std::optional<SunDisc> sun_disc(const Environment& environment);

/// The sky as rows of rgb9e5() from the zenith down, the middle column north (-Z).
constexpr int sky_width = 512;
constexpr int sky_height = 256;
/// Without what is drawn as a disc, cd/m²; empty where the scene has but a uniform sky.
std::vector<glm::vec3> sky_texels(const Sky& sky);
/// As they are stored, in units of so many cd/m².
std::vector<std::uint32_t> packed_light(std::span<const glm::vec3> values, float scale);

}  // namespace raybundle
