// SPDX-License-Identifier: Apache-2.0
#include "trace/facet_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "trace/gloss_packet.h"
#include "trace/lamp_packet.h"
#include "trace/ray_packet.h"
#include "trace/trace_query.h"

namespace raybundle {

namespace {

constexpr int tile = 32;  // pixels along the side of a thread's piece of work

/// Replaces a back that rays have met by the front that coincides with it, if any.
template <unsigned Width>
void prefer_fronts(Query query, const RayGrid& grid, typename Packet<Width>::Rays& rays,
                   const int* valid) {
    alignas(64) typename Packet<Width>::Rays others = rays;
    alignas(64) int backs[Width];
    bool any = false;
    for (unsigned i = 0; i < Width; ++i) {
        const bool met = valid[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        const float along = met ? along_normal(rays, i) : 0.0F;
        backs[i] = along > 0.0F ? -1 : 0;
        if (backs[i] == 0) {
            continue;
        }
        any = true;
        const float normal =
            std::sqrt(rays.hit.Ng_x[i] * rays.hit.Ng_x[i] + rays.hit.Ng_y[i] * rays.hit.Ng_y[i] +
                      rays.hit.Ng_z[i] * rays.hit.Ng_z[i]);
        // The way along the ray that is a tie across the surface.
        const float way = query.rules->tie * normal / along;
        others.ray.tnear[i] = std::max(rays.ray.tfar[i] - way, grid.near);
        others.ray.tfar[i] = rays.ray.tfar[i] + way;
        others.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!any) {
        return;
    }
    query.fronts_only = true;
    query.context.filter = &filter_query;
    Packet<Width>::intersect(backs, query.tree->get(), &query.context, others);
    for (unsigned i = 0; i < Width; ++i) {
        if (backs[i] != 0 && others.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
            rays.hit.Ng_x[i] = others.hit.Ng_x[i];
            rays.hit.Ng_y[i] = others.hit.Ng_y[i];
            rays.hit.Ng_z[i] = others.hit.Ng_z[i];
            rays.hit.primID[i] = others.hit.primID[i];
            rays.hit.geomID[i] = others.hit.geomID[i];
            rays.ray.tfar[i] = others.ray.tfar[i];
        }
    }
}

/// A part of a grid that one thread works on.
struct Tile {
    const RayGrid* grid = nullptr;
    glm::ivec2 first{0}, last{0};
};

void add_tiles(const RayGrid& grid, std::vector<Tile>& tiles) {
    for (int y = grid.first.y; y < grid.last.y; y += tile) {
        for (int x = grid.first.x; x < grid.last.x; x += tile) {
            tiles.push_back({&grid, {x, y}, glm::min(glm::ivec2(x, y) + tile, grid.last)});
        }
    }
}

template <unsigned Width, typename Work>
void for_packets(const Tile& part, const Work& work) {
    for (int y = part.first.y; y < part.last.y; y += Packet<Width>::rows) {
        for (int x = part.first.x; x < part.last.x; x += Packet<Width>::columns) {
            work(glm::ivec2(x, y));
        }
    }
}

template <typename Work>
void for_tiles(const std::vector<Tile>& tiles, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              work(tiles[i]);
                          }
                      });
}

std::size_t place_of(const RayGrid& grid, int x, int y) {
    return grid.result + static_cast<std::size_t>(y) * grid.result_row +
           static_cast<std::size_t>(x) * grid.result_column;
}

template <unsigned Width>
void trace_nearest(const Tile& part, const Query& query, const FacetTracer::Nearest& result) {
    const RayGrid& grid = *part.grid;
    for_packets<Width>(part, [&](const glm::ivec2& first) {
        alignas(64) typename Packet<Width>::Rays rays;
        alignas(64) int valid[Width];
        make_rays<Width>(grid, first, part.last, rays, valid);
        Query own = query;
        Packet<Width>::intersect(valid, query.tree->get(), &own.context, rays);
        if (query.rules->tie > 0.0F) {
            prefer_fronts<Width>(own, grid, rays, valid);
        }
        for (unsigned i = 0; i < Width; ++i) {
            if (valid[i] == 0) {
                continue;
            }
            const std::size_t at =
                place_of(grid, first.x + static_cast<int>(i) % Packet<Width>::columns,
                         first.y + static_cast<int>(i) / Packet<Width>::columns);
            const bool met = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
            std::uint32_t surface = FacetTracer::no_hit;
            if (met) {
                const bool along = along_normal(rays, i) > 0.0F;
                surface = 2 * query.tree->part(rays.hit.geomID[i]).facets[rays.hit.primID[i]] +
                          (along != query.rules->sides_along_rays ? 1U : 0U);
            }
            result.surfaces[at] = surface;
            if (result.depths != nullptr) {
                result.depths[at] = met ? result.depth_scale / rays.ray.tfar[i] : 0.0F;
            }
        }
    });
}

/// Writes a list as shaders/bundle/layers.glsl has it: the first four together, the others apart.
void write_list(const std::vector<LineHit>& hits, std::size_t pixel,
                const FacetTracer::Lists& result) {
    result.counts[pixel] = static_cast<std::uint32_t>(hits.size());
    const std::size_t kept = std::min<std::size_t>(hits.size(), result.capacity);
    for (std::size_t k = 0; k < kept; ++k) {
        result.surfaces[k < 4 ? 4 * pixel + k : k * result.pixels + pixel] = hits[k].surface;
    }
}

template <unsigned Width>
std::size_t trace_lines(const Tile& part, const Query& query, const LineOrder& order,
                        const FacetTracer::Lists& result) {
    const RayGrid& grid = *part.grid;
    std::size_t longest = 0;
    PacketLines lines;
    lines.columns = Packet<Width>::columns;
    lines.line_row = grid.line_row;
    for_packets<Width>(part, [&](const glm::ivec2& first) {
        alignas(64) typename Packet<Width>::Rays rays;
        alignas(64) int valid[Width];
        make_rays<Width>(grid, first, part.last, rays, valid);
        lines.first = first;
        Query own = query;
        own.context.filter = &filter_lines;
        own.lines = &lines;
        Packet<Width>::intersect(valid, query.tree->get(), &own.context, rays);
        for (unsigned i = 0; i < Width; ++i) {
            if (valid[i] != 0) {
                std::vector<LineHit>& hits = lines.lines[i];
                order_line(hits, order);
                write_list(hits,
                           place_of(grid, first.x + static_cast<int>(i) % Packet<Width>::columns,
                                    first.y + static_cast<int>(i) / Packet<Width>::columns),
                           result);
                longest = std::max(longest, hits.size());
                hits.clear();
            }
        }
    });
    return longest;
}

std::vector<bool> passable(const Scene& scene, const LineOpenings& openings) {
    std::vector<bool> result;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        result.push_back(openings.may_pass(i));
    }
    return result;
}

}  // namespace

struct FacetTracer::Impl {
    Impl(const Scene& scene, const PatchMesh& mesh, std::span<const glm::mat4> world_from_object)
        : openings(scene),
          tree(scene, mesh, world_from_object, passable(scene, openings), &filter_part),
          width(packet_width(tree.device())) {}

    [[nodiscard]] Query query(const TraceRules& rules) {
        tree.commit();
        Query result;
        rtcInitIntersectContext(&result.context);
        result.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        result.tree = &tree;
        result.openings = &openings;
        result.rules = &rules;
        return result;
    }

    LineOpenings openings;
    FacetTreeScene tree;
    unsigned width;
};

FacetTracer::FacetTracer(const Scene& scene, const PatchMesh& mesh,
                         std::span<const glm::mat4> world_from_object)
    : impl_(std::make_unique<Impl>(scene, mesh, world_from_object)) {}

FacetTracer::~FacetTracer() = default;

void FacetTracer::update_material(const Scene& scene, std::size_t material) {
    impl_->openings.update(scene, material);
    if (impl_->openings.may_pass(material)) {
        impl_->tree.let_pass(static_cast<std::uint32_t>(material));
    }
}

void FacetTracer::move(std::uint32_t object, const glm::mat4& world_from_object) {
    impl_->tree.move(object, world_from_object);
}

void FacetTracer::settle() {
    impl_->tree.settle();
}

void FacetTracer::nearest(std::span<const RayGrid> grids, const TraceRules& rules,
                          const Nearest& result, std::span<const std::uint32_t> hidden) {
    Query query = impl_->query(rules);
    if (!hidden.empty()) {
        query.hidden = hidden;
        query.context.filter = &filter_query;
    }
    std::vector<Tile> tiles;
    for (const RayGrid& grid : grids) {
        add_tiles(grid, tiles);
    }
    for_tiles(tiles, [&](const Tile& part) {
        switch (impl_->width) {
            case 16:
                trace_nearest<16>(part, query, result);
                break;
            case 8:
                trace_nearest<8>(part, query, result);
                break;
            default:
                trace_nearest<4>(part, query, result);
                break;
        }
    });
}

std::uint32_t FacetTracer::all(const RayGrid& grid, const TraceRules& rules, const LineOrder& order,
                               const Lists& result) {
    const Query query = impl_->query(rules);
    std::vector<Tile> tiles;
    add_tiles(grid, tiles);
    std::atomic<std::size_t> longest{0};
    for_tiles(tiles, [&](const Tile& part) {
        const std::size_t found = impl_->width == 16  ? trace_lines<16>(part, query, order, result)
                                  : impl_->width == 8 ? trace_lines<8>(part, query, order, result)
                                                      : trace_lines<4>(part, query, order, result);
        std::size_t known = longest.load();
        while (found > known && !longest.compare_exchange_weak(known, found)) {
        }
    });
    return static_cast<std::uint32_t>(longest.load());
}

void FacetTracer::reach(std::span<const LampPoint> points, const LampQuestion& question,
                        std::span<std::uint32_t> lit) {
    constexpr std::size_t grain = 64;
    const Query query = impl_->query(question.rules);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              lit[i] = lamps_that_reach(points[i], query, question);
                          }
                      });
}

void FacetTracer::follow(std::span<GlossRay> rays, const TraceRules& rules, float tie) {
    constexpr std::size_t grain = 256;
    const Query query = impl_->query(rules);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              if (rays[i].facet != GlossRay::unused) {
                                  follow_gloss_ray(rays[i], static_cast<std::uint32_t>(i), query,
                                                   tie);
                              }
                          }
                      });
}

std::size_t FacetTracer::bytes() const {
    return impl_->tree.bytes();
}

}  // namespace raybundle
