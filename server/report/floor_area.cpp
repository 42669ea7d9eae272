// SPDX-License-Identifier: Apache-2.0
#include "report/floor_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace raybundle {
namespace {

constexpr int most_columns = 256;             // along each side
constexpr float least_width = 0.05F;          // of a column, m
constexpr float headroom = 1.2F;              // m: above tables and beds, and not inside cupboards
constexpr float recess = 0.3F;                // m: luminaires in a ceiling are above its underside
constexpr std::size_t most_hits = 1U << 23U;  // 64 MiB

/// What a vertical line meets.
struct Hit {
    std::uint32_t column;
    std::uint32_t object;
    float height;  ///< m
    bool above;    ///< its upper side has light
    bool below;    ///< its lower side has light
};

/// Free part of a column between a floor and a ceiling.
struct Gap {
    std::uint32_t column;
    float low, high;
};

/// Vertical lines on a grid.
class Columns {
  public:
    /// most: along each side.
    Columns(const Bounds& bounds, int most) : corner_(bounds.min.x, bounds.min.z), most_(most) {
        const glm::vec3 extent = bounds.extent();
        width_ = std::max(std::max(extent.x, extent.z) / static_cast<float>(most), least_width);
        along_x_ = count(extent.x);
        along_z_ = count(extent.z);
    }

    [[nodiscard]] double area() const { return static_cast<double>(width_) * width_; }
    [[nodiscard]] int along_x() const { return along_x_; }
    [[nodiscard]] int size() const { return along_x_ * along_z_; }
    /// The column of a place; outside of the grid: the nearest one.
    [[nodiscard]] int at(const glm::vec3& place) const {
        const glm::vec2 cell = glm::floor((glm::vec2(place.x, place.z) - corner_) / width_);
        return std::clamp(static_cast<int>(cell.y), 0, along_z_ - 1) * along_x_ +
               std::clamp(static_cast<int>(cell.x), 0, along_x_ - 1);
    }

    /// Adds where lines meet a triangle.
    void meet(const std::array<glm::vec3, 3>& corner, std::uint32_t object, bool two_sided,
              std::vector<Hit>& hits) const {
        const glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        if (!(std::abs(normal.y) > 1e-6F * glm::length(normal))) {
            return;
        }
        std::array<glm::vec2, 3> flat;
        for (std::size_t k = 0; k < 3; ++k) {
            flat[k] = (glm::vec2(corner[k].x, corner[k].z) - corner_) / width_ - 0.5F;
        }
        const auto range = [](float a, float b, float c, int most) {
            const auto limit = static_cast<float>(most);
            return std::pair(
                static_cast<int>(std::clamp(std::ceil(std::min({a, b, c})), 0.0F, limit)),
                static_cast<int>(std::clamp(std::floor(std::max({a, b, c})), -1.0F, limit - 1)));
        };
        const auto [left, right] = range(flat[0].x, flat[1].x, flat[2].x, along_x_);
        const auto [front, back] = range(flat[0].y, flat[1].y, flat[2].y, along_z_);
        const auto side = [](const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        };
        const float whole = side(flat[0], flat[1], flat[2]);
        for (int z = front; z <= back; ++z) {
            for (int x = left; x <= right && whole != 0.0F; ++x) {
                const glm::vec2 p(static_cast<float>(x), static_cast<float>(z));
                const float u = side(flat[1], flat[2], p) / whole;
                const float v = side(flat[2], flat[0], p) / whole;
                const float w = 1.0F - u - v;
                if (u >= 0.0F && v >= 0.0F && w >= 0.0F && hits.size() < most_hits) {
                    hits.push_back({static_cast<std::uint32_t>(z * along_x_ + x), object,
                                    u * corner[0].y + v * corner[1].y + w * corner[2].y,
                                    two_sided || normal.y > 0.0F, two_sided || normal.y < 0.0F});
                }
            }
        }
    }

  private:
    [[nodiscard]] int count(float extent) const {
        return std::clamp(static_cast<int>(std::ceil(extent / width_)), 1, most_);
    }

    glm::vec2 corner_;
    int most_;
    float width_;
    int along_x_ = 1, along_z_ = 1;
};

std::vector<Hit> all_hits(const Scene& scene, const Columns& columns) {
    std::vector<glm::mat4> worlds;
    worlds.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        worlds.push_back(object.world_from_object());
    }
    std::vector<Hit> hits;
    for (const Triangle& triangle : scene.triangles) {
        std::array<glm::vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = glm::vec3(worlds[triangle.object] *
                                   glm::vec4(scene.vertices[triangle.vertex[k]].position, 1.0F));
        }
        columns.meet(corners, triangle.object, two_sided(scene, triangle), hits);
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return std::pair(a.column, a.height) < std::pair(b.column, b.height);
    });
    return hits;
}

/// Insides of objects on one line, from a lower side to the next upper side of the same object.
std::vector<std::pair<float, float>> solids_on(std::span<const Hit> line) {
    std::vector<std::pair<float, float>> solids;
    std::map<std::uint32_t, float> entered;  // by object
    for (const Hit& hit : line) {
        if (hit.below && !hit.above) {
            entered.try_emplace(hit.object, hit.height);
        } else if (const auto from = entered.find(hit.object); from != entered.end()) {
            solids.emplace_back(from->second, hit.height);
            entered.erase(from);
        }
    }
    return solids;
}

/// Adds the gaps of one line, from below. What stands on a slab and carries the next one has faces
/// in theirs: the middle of a gap tells whether it is free.
void find_gaps(std::span<const Hit> line, std::vector<Gap>& gaps) {
    const std::vector<std::pair<float, float>> solids = solids_on(line);
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Hit& floor = line[i - 1];
        const Hit& ceiling = line[i];
        const float middle = 0.5F * (floor.height + ceiling.height);
        if (floor.above && ceiling.below && ceiling.height - floor.height >= headroom &&
            std::none_of(solids.begin(), solids.end(), [&](const auto& solid) {
                return solid.first < middle && middle < solid.second;
            })) {
            gaps.push_back({floor.column, floor.height, ceiling.height});
        }
    }
}

/// By columns, from below.
std::vector<Gap> gaps_between(const std::vector<Hit>& hits) {
    std::vector<Gap> gaps;
    for (std::size_t i = 0; i < hits.size();) {
        std::size_t end = i;
        while (end < hits.size() && hits[end].column == hits[i].column) {
            ++end;
        }
        find_gaps(std::span(hits).subspan(i, end - i), gaps);
        i = end;
    }
    return gaps;
}

/// Gaps that are open to one another: each knows one of its room.
class Rooms {
  public:
    explicit Rooms(std::size_t gaps) : parent_(gaps) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t room_of(std::size_t gap) {
        while (parent_[gap] != gap) {
            parent_[gap] = parent_[parent_[gap]];
            gap = parent_[gap];
        }
        return gap;
    }
    void join(std::size_t a, std::size_t b) { parent_[room_of(a)] = room_of(b); }

  private:
    std::vector<std::size_t> parent_;
};

}  // namespace

double floor_area(const Scene& scene, std::span<const glm::vec3> places) {
    if (places.empty() || scene.triangles.empty()) {
        return 0.0;
    }
    int most = most_columns;
    Columns columns(scene.bounds, most);
    std::vector<Hit> hits = all_hits(scene, columns);
    while (hits.size() >= most_hits && most > 1) {  // some are missing
        most /= 2;
        columns = Columns(scene.bounds, most);
        hits = all_hits(scene, columns);
    }
    const std::vector<Gap> gaps = gaps_between(hits);
    std::vector<std::size_t> first(static_cast<std::size_t>(columns.size()) + 1, gaps.size());
    for (std::size_t i = gaps.size(); i-- > 0;) {
        first[gaps[i].column] = i;
    }
    for (std::size_t i = first.size() - 1; i-- > 0;) {  // columns without gaps: none from here on
        first[i] = std::min(first[i], first[i + 1]);
    }
    Rooms rooms(gaps.size());
    const auto join_with = [&](std::size_t gap, std::size_t column) {
        for (std::size_t other = first[column]; other < first[column + 1]; ++other) {
            if (std::min(gaps[gap].high, gaps[other].high) -
                    std::max(gaps[gap].low, gaps[other].low) >=
                headroom) {
                rooms.join(gap, other);
            }
        }
    };
    const auto row = static_cast<std::size_t>(columns.along_x());
    const auto all = static_cast<std::size_t>(columns.size());
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const std::size_t column = gaps[i].column;
        if ((column + 1) % row != 0) {
            join_with(i, column + 1);
        }
        if (column + row < all) {
            join_with(i, column + row);
        }
    }
    std::set<std::size_t> lit;
    for (const glm::vec3& place : places) {
        const auto column = static_cast<std::size_t>(columns.at(place));
        for (std::size_t i = first[column]; i < first[column + 1]; ++i) {
            if (place.y >= gaps[i].low && place.y <= gaps[i].high + recess) {
                lit.insert(rooms.room_of(i));
            }
        }
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        count += lit.contains(rooms.room_of(i)) ? 1 : 0;
    }
    return static_cast<double>(count) * columns.area();
}

}  // namespace raybundle
