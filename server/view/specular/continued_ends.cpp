// SPDX-License-Identifier: Apache-2.0
#include "view/specular/continued_ends.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "gpu/octahedral.h"
#include "solution/geometry/facet_raster.h"
#include "view/filters/sub_samples.h"

namespace raybundle {
namespace {

constexpr std::size_t tile_pixels = VIEW_TILE * VIEW_TILE;

layout::ContinuedPixel unused() {
    layout::ContinuedPixel pixel{};
    pixel.surface = CONTINUED_NONE;
    pixel.old_index = NO_HIT;
    return pixel;
}

layout::ContinuedPixel pixel_of(const ContinuedRay& ray, std::size_t branch) {
    layout::ContinuedPixel pixel = unused();
    pixel.position = ray.position;
    pixel.surface = ray.surface;
    pixel.throughput = ray.throughput;
    pixel.towards = glm::packSnorm2x16(octahedral_from_vector(ray.towards));
    pixel.way = ray.way;
    pixel.branch = static_cast<std::uint32_t>(branch);
    pixel.added = ray.added ? 1U : 0U;
    return pixel;
}

/// Tiles [first, last) along both axes.
struct TileRange {
    glm::uvec2 first{0}, last{0};
};

/// Tiles of the picture that a box may be seen in.
TileRange tiles_of(const Bounds& box, const layout::ViewParameters& view, glm::uvec2 tiles) {
    glm::vec2 low(1e30F);
    glm::vec2 high(-1e30F);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p((corner & 1) != 0 ? box.max.x : box.min.x,
                          (corner & 2) != 0 ? box.max.y : box.min.y,
                          (corner & 4) != 0 ? box.max.z : box.min.z, 1.0F);
        const glm::vec4 clip = view.clip_from_world * p;
        if (clip.w <= clip.z) {  // nearer than the picture's plane
            return {glm::uvec2(0), tiles};
        }
        const glm::vec2 at = glm::vec2(clip) / clip.w * 0.5F + 0.5F;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::vec2 per_unit = glm::vec2(view.size) / static_cast<float>(VIEW_TILE);
    const glm::vec2 first = glm::floor(low * per_unit - 0.5F);
    const glm::vec2 last = glm::ceil(high * per_unit + 0.5F);
    return {glm::uvec2(glm::clamp(first, glm::vec2(0.0F), glm::vec2(tiles))),
            glm::uvec2(glm::clamp(last, glm::vec2(0.0F), glm::vec2(tiles)))};
}

std::vector<std::uint32_t> candidate_tiles(const SpecularRays& rays,
                                           const layout::ViewParameters& view, glm::uvec2 tiles) {
    std::vector<bool> wanted(std::size_t{tiles.x} * tiles.y, false);
    for (const Bounds& box : rays.boxes()) {
        const TileRange range = tiles_of(box, view, tiles);
        for (unsigned y = range.first.y; y < range.last.y; ++y) {
            for (unsigned x = range.first.x; x < range.last.x; ++x) {
                wanted[std::size_t{y} * tiles.x + x] = true;
            }
        }
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i]) {
            result.push_back(i);
        }
    }
    return result;
}

/// Ends of the pixels of one tile, strongest first: tile_pixels for each rank that some pixel has.
std::vector<layout::ContinuedPixel> ends_of_tile(const SpecularRays& rays,
                                                 const layout::ViewParameters& view,
                                                 std::span<const std::uint32_t> hidden,
                                                 glm::uvec2 tile) {
    std::vector<layout::ContinuedPixel> found;
    for (std::size_t k = 0; k < tile_pixels; ++k) {
        const glm::uvec2 at = tile * unsigned{VIEW_TILE} + glm::uvec2(k % VIEW_TILE, k / VIEW_TILE);
        if (at.x >= view.size.x || at.y >= view.size.y) {
            continue;
        }
        const glm::vec2 ndc =
            (glm::vec2(at) + 0.5F + place_in_pixel(view, at)) / glm::vec2(view.size) * 2.0F - 1.0F;
        const glm::vec3 direction = glm::normalize(
            glm::vec3(view.forward) + ndc.x * glm::vec3(view.right) + ndc.y * glm::vec3(view.up));
        std::array<ContinuedRay, SpecularRays::most_ends> ends;
        const std::size_t count =
            rays.follow(glm::vec3(view.eye), direction, at.y * view.size.x + at.x, ends,
                        SpecularRays::Coats::followed, hidden);
        if (found.size() < count * tile_pixels) {
            found.resize(count * tile_pixels, unused());
        }
        for (std::size_t i = 0; i < count; ++i) {
            found[i * tile_pixels + k] = pixel_of(ends[i], i);
        }
    }
    return found;
}

bool same_end(const layout::ContinuedPixel& a, const layout::ContinuedPixel& b) {
    return a.surface == b.surface && a.towards == b.towards && a.position == b.position;
}

}  // namespace

ContinuedEnds find_continued_ends(const SpecularRays& rays, const layout::ViewParameters& view,
                                  std::span<const std::uint32_t> hidden) {
    const glm::uvec2 tiles =
        (glm::uvec2(view.size) + unsigned{VIEW_TILE} - 1U) / unsigned{VIEW_TILE};
    const std::vector<std::uint32_t> candidates = candidate_tiles(rays, view, tiles);
    std::vector<std::vector<layout::ContinuedPixel>> of_tile(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        const glm::uvec2 tile(candidates[i] % tiles.x, candidates[i] / tiles.x);
        of_tile[i] = ends_of_tile(rays, view, hidden, tile);
    });
    ContinuedEnds result;
    result.tiles.assign(std::size_t{tiles.x} * tiles.y, 0);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const std::size_t count = of_tile[i].size() / tile_pixels;
        if (count > 0) {
            result.tiles[candidates[i]] =
                static_cast<std::uint32_t>(8 * result.tile_count() + count);
            result.ends.insert(result.ends.end(), of_tile[i].begin(), of_tile[i].end());
        }
    }
    return result;
}

std::uint32_t index_in_rows(std::size_t end, unsigned columns) {
    const std::size_t tile = end / tile_pixels;
    const std::size_t inside = end % tile_pixels;
    const std::size_t row = VIEW_TILE * (tile / columns) + inside / VIEW_TILE;
    return static_cast<std::uint32_t>(row * VIEW_TILE * columns + VIEW_TILE * (tile % columns) +
                                      inside % VIEW_TILE);
}

std::vector<layout::ContinuedPixel> in_rows(const ContinuedEnds& found, unsigned columns,
                                            unsigned rows) {
    std::vector<layout::ContinuedPixel> result(std::size_t{columns} * rows * tile_pixels, unused());
    for (std::size_t i = 0; i < found.ends.size(); ++i) {
        result[index_in_rows(i, columns)] = found.ends[i];
    }
    return result;
}

void match_ends(ContinuedEnds& found, const ContinuedEnds& old, unsigned old_columns) {
    if (found.tiles.size() != old.tiles.size()) {
        return;
    }
    for (std::size_t tile = 0; tile < found.tiles.size(); ++tile) {
        const std::size_t count = std::min(found.tiles[tile] & 7U, old.tiles[tile] & 7U);
        for (std::size_t i = 0; i < count * tile_pixels; ++i) {
            layout::ContinuedPixel& end = found.ends[(found.tiles[tile] >> 3U) * tile_pixels + i];
            const std::size_t before = (old.tiles[tile] >> 3U) * tile_pixels + i;
            if (end.surface != CONTINUED_NONE && same_end(end, old.ends[before])) {
                end.old_index = index_in_rows(before, old_columns);
            }
        }
    }
}

}  // namespace raybundle
