// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/triangle_joins.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/disjoint_sets.h"
#include "scene/mesh/face_set.h"
#include "scene/mesh/face_sight.h"
#include "scene/mix_bits.h"

namespace raybundle {
namespace {

constexpr double square_variance = 1.0 / 6.0;  // of places on a square, over its area
constexpr double largest_extent = 2.0;         // of a set, over the target edge
constexpr double lift_share = 0.05;            // of the target edge: what is lower hides nothing
constexpr int most_rounds = 64;
// Of sets, in areas of a patch of the target edge: where joining begins, and where it begins to
// look for neighbours without a common edge.
constexpr double smallest_size = 0x1p-10;
constexpr double smallest_near = 0x1p-3;
constexpr int most_levels = 12;  // each of sets twice as large
constexpr unsigned grid_bits = 20;
constexpr std::uint32_t none = 0xffffffffU;

/// Two sets that may join, the lower number first.
using Link = std::pair<std::uint32_t, std::uint32_t>;

/// A partner, and what joining it would cost more.
struct Partner {
    double cost = std::numeric_limits<double>::infinity();
    std::uint64_t tie = 0;
    std::uint32_t set = none;

    [[nodiscard]] bool worse_than(double other_cost, std::uint64_t other_tie) const {
        return other_cost < cost || (other_cost == cost && other_tie < tie);
    }
};

FaceSet set_of(const JoinFace& face, std::uint32_t number) {
    FaceSet set;
    const glm::dvec3 across =
        glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double size = glm::length(across);
    set.kind = face.kind;
    set.largest = number;
    set.area = 0.5 * size;
    set.largest_area = set.area;
    set.axis = size > 0.0 ? across / size : glm::dvec3(0.0);
    set.normal = set.area * set.axis;
    const glm::dvec3 colour(face.colour);
    set.colour = set.area * colour;
    set.squared_colour = set.area * glm::dot(colour, colour);
    const glm::dvec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
    set.place = set.area * middle;
    set.squared_place = set.area * glm::dot(middle, middle);
    for (const glm::dvec3& corner : face.corners) {
        // Of a triangle the mean square is a twelfth of the corners' about the middle.
        const glm::dvec3 from_middle = corner - middle;
        set.squared_place += set.area * glm::dot(from_middle, from_middle) / 12.0;
        set.low = glm::min(set.low, corner);
        set.high = glm::max(set.high, corner);
    }
    set.widest = std::acos(std::clamp(face.widest, -1.0, 1.0));
    return set;
}

/// Bits of a coordinate with two zeros after each.
std::uint64_t spread_bits(std::uint64_t value) {
    std::uint64_t result = 0;
    for (unsigned bit = 0; bit < grid_bits; ++bit) {
        result |= (value >> bit & 1U) << (3 * bit);
    }
    return result;
}

class Joining {
  public:
    Joining(const Scene& scene, std::span<const JoinFace> faces, const JoinSettings& settings)
        : sight_(scene, faces, lift_share * settings.edge),
          faces_(faces),
          settings_(settings),
          set_of_face_(faces.size()) {
        // Places are counted from the middle, so that squares keep their digits.
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (const JoinFace& face : faces) {
            for (const glm::dvec3& corner : face.corners) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
        origin_ = 0.5 * (low + high);
        sets_.reserve(faces.size());
        for (std::uint32_t i = 0; i < faces.size(); ++i) {
            JoinFace shifted = faces[i];
            for (glm::dvec3& corner : shifted.corners) {
                corner -= origin_;
            }
            sets_.push_back(set_of(shifted, i));
        }
        std::iota(set_of_face_.begin(), set_of_face_.end(), 0U);
    }

    std::vector<std::uint32_t> run() {
        links_ = edges();
        double size = settings_.wanted_sides > 0 ? smallest_size : 1.0;
        for (; size <= 1.0 && above(settings_.wanted_sides) > 0; size *= 2.0) {
            join_all(size);
            if (size >= smallest_near && above(settings_.wanted_sides) > 0) {
                link_near();
                join_all(size);
            }
        }
        for (int level = 0; level < most_levels && above(settings_.most_sides) > 0; ++level) {
            link_near();
            join_all(size);
            size *= 2.0;
        }
        for (const bool facing : {true, false}) {
            while (above(settings_.most_sides) > 0 && join_neighbours(facing)) {
            }
        }
        return numbered();
    }

  private:
    /// Pairs of faces of one kind that share an edge and see each other across it.
    [[nodiscard]] std::vector<Link> edges() const {
        struct Edge {
            std::uint32_t low, high, face;
        };
        std::vector<Edge> all;
        all.reserve(3 * faces_.size());
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = faces_[i].points[k];
                const std::uint32_t b = faces_[i].points[(k + 1) % 3];
                all.push_back({std::min(a, b), std::max(a, b), i});
            }
        }
        std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
        });
        std::vector<Link> found;
        for (std::size_t i = 0; i + 1 < all.size(); ++i) {
            const Edge& a = all[i];
            const Edge& b = all[i + 1];
            if (a.low == b.low && a.high == b.high && a.face != b.face &&
                sets_[a.face].kind == sets_[b.face].kind) {
                found.emplace_back(a.face, b.face);
            }
        }
        std::vector<char> clear(found.size());
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
            clear[i] = sight_.across(found[i].first, found[i].second) ? 1 : 0;
        });
        return kept(found, clear);
    }

    static std::vector<Link> kept(const std::vector<Link>& links, const std::vector<char>& which) {
        std::vector<Link> result;
        for (std::size_t i = 0; i < links.size(); ++i) {
            if (which[i] != 0) {
                result.push_back(links[i]);
            }
        }
        return result;
    }

    /// The axis that a set faces most, and its sign.
    static std::uint32_t facing_of(const FaceSet& set) {
        const glm::dvec3 size = glm::abs(set.axis);
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        return 2U * static_cast<std::uint32_t>(axis) + (set.axis[axis] < 0.0 ? 1U : 0U);
    }

    [[nodiscard]] std::uint32_t sides_of(const FaceSet& set) const {
        return faces_[set.largest].two_sided ? 2 : 1;
    }

    /// How many more sides there are than so many.
    [[nodiscard]] std::size_t above(std::size_t limit) const {
        std::size_t sides = 0;
        for (const FaceSet& set : sets_) {
            sides += sides_of(set);
        }
        return sides - std::min(sides, limit);
    }

    struct Item {
        std::uint64_t group;
        std::uint64_t place;
        std::uint32_t set;
    };

    /// All sets, those of each group along a curve through all places. group: of a set.
    template <typename Group>
    [[nodiscard]] std::vector<Item> along_curve(const Group& group) const {
        glm::dvec3 low(1e300);
        double extent = 0.0;
        for (const FaceSet& set : sets_) {
            low = glm::min(low, set.low);
        }
        for (const FaceSet& set : sets_) {
            const glm::dvec3 e = set.high - low;
            extent = std::max({extent, e.x, e.y, e.z});
        }
        std::vector<Item> items;
        items.reserve(sets_.size());
        const double cells = static_cast<double>((1U << grid_bits) - 1U) / std::max(extent, 1e-30);
        for (std::uint32_t i = 0; i < sets_.size(); ++i) {
            const glm::dvec3 at = (0.5 * (sets_[i].low + sets_[i].high) - low) * cells;
            items.push_back({group(sets_[i]),
                             spread_bits(static_cast<std::uint64_t>(at.x)) |
                                 spread_bits(static_cast<std::uint64_t>(at.y)) << 1U |
                                 spread_bits(static_cast<std::uint64_t>(at.z)) << 2U,
                             i});
        }
        std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
            return std::tie(a.group, a.place, a.set) < std::tie(b.group, b.place, b.set);
        });
        return items;
    }

    /// Joins neighbours of one rough kind, and of one facing if that counts, in pairs, the smallest
    /// first, as far as there are too many. False where there are none.
    bool join_neighbours(bool facing) {
        const std::vector<Item> items = along_curve([&](const FaceSet& set) {
            return 8U * std::uint64_t{faces_[set.largest].rough_kind} +
                   (facing ? facing_of(set) : 0U);
        });
        struct Pair {
            double area;
            std::size_t first;
        };
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i + 1 < items.size(); ++i) {
            if (items[i].group == items[i + 1].group) {
                pairs.push_back({sets_[items[i].set].area + sets_[items[i + 1].set].area, i});
                ++i;
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
            return std::tie(a.area, a.first) < std::tie(b.area, b.first);
        });
        std::vector<Partner> partners(sets_.size());
        std::size_t left = above(settings_.most_sides);
        for (const Pair& pair : pairs) {
            const std::uint32_t a = items[pair.first].set;
            const std::uint32_t b = items[pair.first + 1].set;
            partners[a].set = b;
            partners[b].set = a;
            left -= std::min<std::size_t>(left, sides_of(sets_[a]));
            if (left == 0) {
                break;
            }
        }
        return join_mutual(partners);
    }

    /// Links sets of one kind that face alike and follow each other along a curve through all
    /// places, and that see each other.
    void link_near() {
        const std::vector<Item> items = along_curve(
            [](const FaceSet& set) { return 8U * std::uint64_t{set.kind} + facing_of(set); });
        std::vector<Link> found;
        constexpr std::size_t ahead = 4;
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (std::size_t k = i + 1; k < std::min(items.size(), i + 1 + ahead); ++k) {
                if (items[k].group == items[i].group) {
                    found.emplace_back(std::min(items[i].set, items[k].set),
                                       std::max(items[i].set, items[k].set));
                }
            }
        }
        std::vector<char> clear(found.size());
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
            const std::uint32_t a = sets_[found[i].first].largest;
            const std::uint32_t b = sets_[found[i].second].largest;
            clear[i] = sight_.between(a, b) ? 1 : 0;
        });
        const std::vector<Link> seen = kept(found, clear);
        links_.insert(links_.end(), seen.begin(), seen.end());
        tidy();
    }

    /// Sorts links and leaves out doubles.
    void tidy() {
        std::sort(links_.begin(), links_.end());
        links_.erase(std::unique(links_.begin(), links_.end()), links_.end());
    }

    /// Whether a set may be, where sets cost at most as much as patches `size` times as large.
    [[nodiscard]] bool allowed(const FaceSet& set, double size) const {
        const double most_cost =
            square_variance * size * size * settings_.patch_area * settings_.patch_area;
        const double most_extent = largest_extent * settings_.edge;
        return set.angle <= set.widest && set.cost(settings_.edge) <= most_cost &&
               set.squared_extent() <= size * most_extent * most_extent;
    }

    /// Joins, over and over, sets that are each other's best partners.
    void join_all(double size) {
        for (int round = 0; round < most_rounds && join_best(size); ++round) {
        }
    }

    bool join_best(double size) {
        std::vector<double> costs(links_.size());
        tbb::parallel_for(std::size_t{0}, links_.size(), [&](std::size_t i) {
            const FaceSet& a = sets_[links_[i].first];
            const FaceSet& b = sets_[links_[i].second];
            const FaceSet both = joined(a, b);
            costs[i] = allowed(both, size) ? both.cost(settings_.edge) - a.cost(settings_.edge) -
                                                 b.cost(settings_.edge)
                                           : std::numeric_limits<double>::infinity();
        });
        std::vector<Partner> best(sets_.size());
        for (std::size_t i = 0; i < links_.size(); ++i) {
            if (costs[i] == std::numeric_limits<double>::infinity()) {
                continue;
            }
            const auto [a, b] = links_[i];
            // Equal costs, as on a regular mesh, are told apart evenly.
            const std::uint64_t tie = mix_bits(std::uint64_t{a} << 32U | b);
            if (best[a].worse_than(costs[i], tie)) {
                best[a] = {costs[i], tie, b};
            }
            if (best[b].worse_than(costs[i], tie)) {
                best[b] = {costs[i], tie, a};
            }
        }
        return join_mutual(best);
    }

    /// Joins what is each other's partner. False where nothing is.
    bool join_mutual(const std::vector<Partner>& best) {
        std::vector<std::uint32_t> next(sets_.size(), none);  // number of each set from now on
        std::vector<FaceSet> sets;
        sets.reserve(sets_.size());
        bool any = false;
        for (std::uint32_t a = 0; a < sets_.size(); ++a) {
            const std::uint32_t b = best[a].set;
            const bool mutual = b != none && best[b].set == a;
            if (mutual && b < a) {
                continue;  // it went with that one
            }
            next[a] = static_cast<std::uint32_t>(sets.size());
            sets.push_back(mutual ? joined(sets_[a], sets_[b]) : sets_[a]);
            if (mutual) {
                next[b] = next[a];
                any = true;
            }
        }
        if (any) {
            adopt(std::move(sets), next);
        }
        return any;
    }

    void adopt(std::vector<FaceSet> sets, const std::vector<std::uint32_t>& next) {
        sets_ = std::move(sets);
        for (std::uint32_t& set : set_of_face_) {
            set = next[set];
        }
        std::vector<Link> links;
        links.reserve(links_.size());
        for (const auto& [a, b] : links_) {
            if (next[a] != next[b]) {
                links.emplace_back(std::min(next[a], next[b]), std::max(next[a], next[b]));
            }
        }
        links_ = std::move(links);
        tidy();
    }

    /// Sets in the order of their first faces.
    [[nodiscard]] std::vector<std::uint32_t> numbered() const {
        std::vector<std::uint32_t> number(sets_.size(), none);
        std::vector<std::uint32_t> result;
        result.reserve(set_of_face_.size());
        std::uint32_t count = 0;
        for (const std::uint32_t set : set_of_face_) {
            if (number[set] == none) {
                number[set] = count++;
            }
            result.push_back(number[set]);
        }
        return result;
    }

    FaceSight sight_;
    std::span<const JoinFace> faces_;
    JoinSettings settings_;
    glm::dvec3 origin_{0.0};
    std::vector<FaceSet> sets_;
    std::vector<std::uint32_t> set_of_face_;
    std::vector<Link> links_;
};

}  // namespace

std::vector<std::uint32_t> join_faces(const Scene& scene, std::span<const JoinFace> faces,
                                      const JoinSettings& settings) {
    return Joining(scene, faces, settings).run();
}

}  // namespace raybundle
