// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/scene_binary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <sstream>
#include <stdexcept>

namespace raybundle {

static_assert(std::endian::native == std::endian::little);

std::vector<std::uint32_t> packed_light(std::span<const glm::vec3> values, float scale) {
    std::vector<std::uint32_t> packed(values.size());
    std::transform(values.begin(), values.end(), packed.begin(),
                   [scale](const glm::vec3& value) { return rgb9e5(scale * value); });
    return packed;
}

namespace {

float largest(std::span<const glm::vec3> values) {
    float most = 0.0F;
    for (const glm::vec3& value : values) {
        most = std::max({most, value.r, value.g, value.b});
    }
    return most;
}

std::size_t add_values(ArrayFile& file, const std::vector<std::uint32_t>& values) {
    return file.add(std::span<const std::uint32_t>(values));
}

}  // namespace

ArrayFile::ArrayFile() : stream_(std::make_unique<std::ostringstream>(std::ios::binary)) {}

ArrayFile::ArrayFile(const std::filesystem::path& path)
    : path_(path), stream_(std::make_unique<std::ofstream>(path, std::ios::binary)) {}

std::string ArrayFile::text() const {
    return dynamic_cast<const std::ostringstream&>(*stream_).str();
}

std::size_t ArrayFile::add_bytes(const void* data, std::size_t size) {
    constexpr std::size_t alignment = 4;
    const std::size_t first = bytes_;
    const std::size_t gap = (alignment - size % alignment) % alignment;
    stream_->write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    stream_->write("\0\0\0", static_cast<std::streamsize>(gap));
    bytes_ += size + gap;
    return first;
}

void ArrayFile::close() {
    stream_->flush();
    const auto on_disk = [this] {
        auto* const file = dynamic_cast<std::ofstream*>(stream_.get());
        if (file != nullptr) {
            file->close();
        }
        return !stream_->fail();
    };
    if (!on_disk()) {
        throw std::runtime_error(path_.string() + ": cannot be written: the disk may be full");
    }
}

void add_geometry(ArrayFile& file, const PositionGrid& grid, const LightChunk& chunk,
                  ChunkPlaces& places) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(3 * chunk.positions.size());
    for (std::size_t i = 0; i < chunk.positions.size(); ++i) {
        const auto packed = packed_vertex(grid, chunk.positions[i], chunk.normals[i]);
        vertices.insert(vertices.end(), packed.begin(), packed.end());
    }
    places.vertices = add_values(file, vertices);
    places.indices = file.add(std::span<const std::uint16_t>(chunk.indices));
    if (!chunk.uvs.empty()) {
        places.uvs = file.add(std::span<const glm::vec2>(chunk.uvs));
    }
    if (!chunk.colours.empty()) {
        std::vector<std::uint32_t> colours(chunk.colours.size());
        std::transform(chunk.colours.begin(), chunk.colours.end(), colours.begin(), packed_colour);
        places.colours = add_values(file, colours);
    }
}

void add_light(ArrayFile& file, float unit, const LightChunk& chunk, ChunkPlaces& places) {
    const float of_irradiance = glm::one_over_pi<float>() / unit;
    places.front = add_values(file, packed_light(chunk.front, of_irradiance));
    if (chunk.two_sided) {
        places.back = add_values(file, packed_light(chunk.back, of_irradiance));
    }
    if (!chunk.emissions.empty()) {
        places.emissions = add_values(file, packed_light(chunk.emissions, 1.0F / unit));
    }
}

float light_unit(std::span<const LightChunk> chunks, float most) {
    for (const LightChunk& chunk : chunks) {
        const float irradiance = std::max(largest(chunk.front), largest(chunk.back));
        most = std::max({most, irradiance * glm::one_over_pi<float>(), largest(chunk.emissions)});
    }
    return most > 0.0F ? std::exp2(std::ceil(std::log2(most)) - 15.0F) : 1.0F;
}

std::optional<SunDisc> sun_disc(const Environment& environment) {
    if (!environment.draws_sources() || environment.sources().empty()) {
        return std::nullopt;
    }
    const SkySource& sun = environment.sources().front();
    const float sine = std::max(std::sin(sun.angular_radius), 1e-4F);
    return SunDisc{glm::vec3(sun.direction), std::sqrt(1.0F - sine * sine),
                   sun.illuminance / (glm::pi<float>() * sine * sine)};
}

std::vector<glm::vec3> sky_texels(const Sky& sky) {
    if (!sky.environment) {
        return {};
    }
    const bool discs = sky.environment->draws_sources();
    constexpr float most = 1e9F;  // cd/m², as bright as the sun
    std::vector<glm::vec3> texels;
    texels.reserve(std::size_t{sky_width} * sky_height);
    for (int y = 0; y < sky_height; ++y) {
        const double elevation = glm::pi<double>() * (0.5 - (y + 0.5) / sky_height);
        for (int x = 0; x < sky_width; ++x) {
            const double azimuth = glm::two_pi<double>() * ((x + 0.5) / sky_width - 0.5);
            const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                       -std::cos(elevation) * std::cos(azimuth));
            const glm::dvec3 radiance =
                discs ? sky.environment->radiance(direction) : sky.environment->shown(direction);
            texels.push_back(glm::min(glm::vec3(radiance), most));
        }
    }
    return texels;
}

}  // namespace raybundle
