// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/joins/triangle_joins.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/mesh/joins/face_sets.h"
#include "scene/mesh/joins/face_sight.h"
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
constexpr std::size_t most_apart = 262144;  // links to be sorted apart from the others
constexpr std::uint32_t none = 0xffffffffU;

/// Two sets that may join, the lower number first.
struct Link {
    std::uint32_t a = 0, b = 0;
    double cost = unknown;  // what joining them would cost more; infinite where it may not be

    static constexpr double unknown = -1e300;
    [[nodiscard]] bool operator<(const Link& other) const {
        return std::tie(a, b) < std::tie(other.a, other.b);
    }
    [[nodiscard]] bool operator==(const Link& other) const { return a == other.a && b == other.b; }
    /// Equal costs, as on a regular mesh, are told apart evenly.
    [[nodiscard]] std::uint64_t tie() const { return mix_bits(std::uint64_t{a} << 32U | b); }
    [[nodiscard]] bool better_than(const Link& other) const {
        return cost < other.cost || (cost == other.cost && tie() < other.tie());
    }
};

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
    Joining(const Scene& scene, const JoinFaces& faces, const JoinSettings& settings)
        : sight_(scene, faces, lift_share * settings.edge),
          faces_(faces),
          settings_(settings),
          sets_(faces),
          set_of_face_(faces.size()) {
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
            const std::array<std::uint32_t, 3> points = faces_.points_of(i);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = points[k];
                const std::uint32_t b = points[(k + 1) % 3];
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
                faces_.kind_of(a.face) == faces_.kind_of(b.face)) {
                found.push_back({a.face, b.face});
            }
        }
        std::vector<Edge>().swap(all);
        keep(found, [this](const Link& link) { return sight_.across(link.a, link.b); });
        return found;
    }

    /// Takes away the links that are not as asked for; asked on all cores.
    template <typename Ask>
    static void keep(std::vector<Link>& links, const Ask& ask) {
        std::vector<char> which(links.size());
        tbb::parallel_for(std::size_t{0}, links.size(),
                          [&](std::size_t i) { which[i] = ask(links[i]) ? 1 : 0; });
        std::size_t kept = 0;
        for (std::size_t i = 0; i < links.size(); ++i) {
            if (which[i] != 0) {
                links[kept++] = links[i];
            }
        }
        links.resize(kept);
    }

    /// The axis that a set faces most, and its sign.
    static std::uint32_t facing_of(const FaceSet& set) {
        const glm::dvec3 size = glm::abs(set.axis);
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        return 2U * static_cast<std::uint32_t>(axis) + (set.axis[axis] < 0.0 ? 1U : 0U);
    }

    /// How many more sides there are than so many.
    [[nodiscard]] std::size_t above(std::size_t limit) const {
        std::size_t sides = 0;
        for (std::uint32_t set = 0; set < sets_.size(); ++set) {
            sides += sets_.sides_of(set);
        }
        return sides - std::min(sides, limit);
    }

    struct Item {
        std::uint64_t group;
        std::uint64_t place;
        std::uint32_t set;
    };

    /// All sets, those of each group along a curve through all places. group: of a set, by its
    /// number and its sums.
    template <typename Group>
    [[nodiscard]] std::vector<Item> along_curve(const Group& group) const {
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (std::uint32_t i = 0; i < sets_.size(); ++i) {
            const FaceSet set = sets_.at(i);
            low = glm::min(low, set.low);
            high = glm::max(high, set.high);
        }
        const glm::dvec3 e = high - low;
        const double extent = std::max({e.x, e.y, e.z});
        std::vector<Item> items;
        items.reserve(sets_.size());
        const double cells = static_cast<double>((1U << grid_bits) - 1U) / std::max(extent, 1e-30);
        for (std::uint32_t i = 0; i < sets_.size(); ++i) {
            const FaceSet set = sets_.at(i);
            const glm::dvec3 at = (0.5 * (set.low + set.high) - low) * cells;
            items.push_back({group(i, set),
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
        const std::vector<Item> items = along_curve([&](std::uint32_t number, const FaceSet& set) {
            return 8U * std::uint64_t{faces_.kind(sets_.kind(number)).rough} +
                   (facing ? facing_of(set) : 0U);
        });
        struct Pair {
            double area;
            std::size_t first;
        };
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i + 1 < items.size(); ++i) {
            if (items[i].group == items[i + 1].group) {
                pairs.push_back({sets_.at(items[i].set).area + sets_.at(items[i + 1].set).area, i});
                ++i;
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
            return std::tie(a.area, a.first) < std::tie(b.area, b.first);
        });
        std::vector<std::uint32_t> partners(sets_.size(), none);
        std::size_t left = above(settings_.most_sides);
        for (const Pair& pair : pairs) {
            const std::uint32_t a = items[pair.first].set;
            const std::uint32_t b = items[pair.first + 1].set;
            partners[a] = b;
            partners[b] = a;
            left -= std::min<std::size_t>(left, sets_.sides_of(a));
            if (left == 0) {
                break;
            }
        }
        return join_mutual(partners);
    }

    /// Links sets of one kind that face alike and follow each other along a curve through all
    /// places, and that see each other.
    void link_near() {
        const std::vector<Item> items = along_curve([&](std::uint32_t number, const FaceSet& set) {
            return 8U * std::uint64_t{sets_.kind(number)} + facing_of(set);
        });
        constexpr std::size_t ahead = 4;
        constexpr std::size_t at_once = 65536;  // so that those that are in the way take no room
        std::vector<Link> found;
        for (std::size_t begin = 0; begin < items.size(); begin += at_once) {
            found.clear();
            for (std::size_t i = begin; i < std::min(items.size(), begin + at_once); ++i) {
                for (std::size_t k = i + 1; k < std::min(items.size(), i + 1 + ahead); ++k) {
                    if (items[k].group == items[i].group) {
                        found.push_back({std::min(items[i].set, items[k].set),
                                         std::max(items[i].set, items[k].set)});
                    }
                }
            }
            keep(found, [this](const Link& link) {
                return sight_.between(sets_.largest(link.a), sets_.largest(link.b));
            });
            links_.insert(links_.end(), found.begin(), found.end());
        }
        std::sort(links_.begin(), links_.end());
        drop_doubles(links_);
    }

    /// Of sorted links.
    static void drop_doubles(std::vector<Link>& links) {
        links.erase(std::unique(links.begin(), links.end()), links.end());
    }

    /// Whether a set may be, where sets cost at most as much as patches `size` times as large.
    [[nodiscard]] bool allowed(const FaceSet& set, double size) const {
        const double widest = faces_.kind(faces_.kind_of(set.largest)).widest;
        const double most_cost =
            square_variance * size * size * settings_.patch_area * settings_.patch_area;
        const double most_extent = largest_extent * settings_.edge;
        return set.angle <= widest && set.cost(settings_.edge) <= most_cost &&
               set.squared_extent() <= size * most_extent * most_extent;
    }

    /// Joins, over and over, sets that are each other's best partners.
    void join_all(double size) {
        if (size != size_of_costs_) {
            size_of_costs_ = size;
            for (Link& link : links_) {
                link.cost = Link::unknown;
            }
        }
        for (int round = 0; round < most_rounds && join_best(size); ++round) {
        }
    }

    bool join_best(double size) {
        tbb::parallel_for(std::size_t{0}, links_.size(), [&](std::size_t i) {
            Link& link = links_[i];
            if (link.cost != Link::unknown) {
                return;  // neither set has changed
            }
            const FaceSet a = sets_.at(link.a);
            const FaceSet b = sets_.at(link.b);
            const FaceSet both = joined(a, b);
            link.cost = allowed(both, size) ? both.cost(settings_.edge) - a.cost(settings_.edge) -
                                                  b.cost(settings_.edge)
                                            : std::numeric_limits<double>::infinity();
        });
        std::vector<std::uint32_t> best(sets_.size(), none);  // a link, then a partner
        const auto offer = [&](std::uint32_t set, std::uint32_t link) {
            if (best[set] == none || links_[link].better_than(links_[best[set]])) {
                best[set] = link;
            }
        };
        for (std::uint32_t i = 0; i < links_.size(); ++i) {
            if (links_[i].cost != std::numeric_limits<double>::infinity()) {
                offer(links_[i].a, i);
                offer(links_[i].b, i);
            }
        }
        for (std::uint32_t set = 0; set < best.size(); ++set) {
            if (best[set] != none) {
                const Link& link = links_[best[set]];
                best[set] = link.a == set ? link.b : link.a;
            }
        }
        return join_mutual(best);
    }

    /// Joins what is each other's partner. False where nothing is.
    bool join_mutual(const std::vector<std::uint32_t>& partner) {
        std::vector<std::uint32_t> next(sets_.size(), none);  // number of each set from now on
        std::vector<bool> changed(sets_.size(), false);
        std::uint32_t count = 0;
        for (std::uint32_t a = 0; a < sets_.size(); ++a) {
            const std::uint32_t b = partner[a];
            const bool mutual = b != none && partner[b] == a;
            if (mutual && b < a) {
                next[a] = next[b];
                continue;
            }
            next[a] = count++;
            if (mutual) {
                sets_.join(a, b);
                changed[a] = true;
                changed[b] = true;
            }
        }
        if (count == sets_.size()) {
            return false;
        }
        sets_.compact(next);
        for (std::uint32_t& set : set_of_face_) {
            set = next[set];
        }
        renumber_links(next, changed);
        return true;
    }

    /// Those between sets that have not changed stay in order, as these do, and come first; the
    /// others are sorted and merged into them.
    void renumber_links(const std::vector<std::uint32_t>& next, const std::vector<bool>& changed) {
        std::vector<Link> fresh;
        std::size_t kept = 0;
        bool in_place = false;
        for (std::size_t i = 0; i < links_.size(); ++i) {
            Link link = links_[i];
            const bool stays = !changed[link.a] && !changed[link.b];
            link = {std::min(next[link.a], next[link.b]), std::max(next[link.a], next[link.b]),
                    stays ? link.cost : Link::unknown};
            if (link.a == link.b) {
                continue;
            }
            if (stays || in_place) {
                links_[kept++] = link;
                continue;
            }
            fresh.push_back(link);
            // Room for many would be as much as all links take: they are sorted where they are.
            if (fresh.size() > most_apart) {
                in_place = true;
                std::copy(fresh.begin(), fresh.end(),
                          links_.begin() + static_cast<std::ptrdiff_t>(kept));
                kept += fresh.size();
                fresh = {};
            }
        }
        links_.resize(kept);
        if (in_place) {
            std::sort(links_.begin(), links_.end());
            drop_doubles(links_);
            return;
        }
        std::sort(fresh.begin(), fresh.end());
        drop_doubles(fresh);
        // From behind, into the room that they need.
        links_.resize(kept + fresh.size());
        for (std::size_t at = links_.size(); !fresh.empty();) {
            const bool old = kept > 0 && fresh.back() < links_[kept - 1];
            links_[--at] = old ? links_[kept - 1] : fresh.back();
            kept -= old ? 1 : 0;
            if (!old) {
                fresh.pop_back();
            }
        }
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
    const JoinFaces& faces_;
    JoinSettings settings_;
    FaceSets sets_;
    std::vector<std::uint32_t> set_of_face_;
    std::vector<Link> links_;  // sorted
    double size_of_costs_ = 0.0;
};

}  // namespace

std::vector<std::uint32_t> join_faces(const Scene& scene, const JoinFaces& faces,
                                      const JoinSettings& settings) {
    return Joining(scene, faces, settings).run();
}

}  // namespace raybundle
