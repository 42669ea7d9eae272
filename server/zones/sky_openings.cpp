// SPDX-License-Identifier: Apache-2.0
#include "zones/sky_openings.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "scene/scene.h"

namespace raybundle {

namespace {

// Where less of what is around is sky, parallel bundles of random directions see it so rarely that
// the squared deviation of one is above three times that of the mean.
constexpr double little_sky = 0.25;
// Rays from sheltered surfaces: a window of a thousandth of the surfaces that see it has some 30.
constexpr std::size_t sheltered_rays = 32768;
// Of those that meet the sky so many are looked at, at most.
constexpr std::size_t max_followed = 1024;
// A box that fewer rays have passed tells little of an opening's extent.
constexpr std::size_t min_places = 8;
// Chance that evenly spread rays leave a gap as wide as one that is taken for a wall: between two
// openings, or beside one.
constexpr double by_chance = 0.01;
// Of an opening's extent: thickness of one that rays pass in a plane.
constexpr float least_thickness = 0.05F;

/// Rows: two horizontal directions at right angles, to which most walls are parallel, and the
/// vertical.
glm::mat3 wall_axes(const ExchangeRays& rays) {
    double cosines = 0.0;
    double sines = 0.0;
    for (std::size_t i = 0; i < rays.areas().size(); ++i) {
        const glm::dvec3 n(rays.normals()[i]);
        const double level = n.x * n.x + n.z * n.z;  // floors and ceilings do not count
        const double four_angles = 4.0 * std::atan2(n.z, n.x);
        const double weight = static_cast<double>(rays.areas()[i]) * level * level;
        cosines += weight * std::cos(four_angles);
        sines += weight * std::sin(four_angles);
    }
    const double angle = 0.25 * std::atan2(sines, cosines);
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    return glm::transpose(glm::mat3(glm::vec3(c, 0, s), glm::vec3(0, 1, 0), glm::vec3(-s, 0, c)));
}

/// Luminance of the sky that a ray meets, times the area that the ray stands for.
double flux_of(const ExchangeRay& ray) {
    return ray.towards != glm::vec3(0.0F) ? static_cast<double>(ray.area * luminance(ray.sky))
                                          : 0.0;
}

/// A ray where it passes surfaces closely.
struct Place {
    const ExchangeRay* ray = nullptr;
    double served = 0.0;  ///< m²: area of the surfaces for which the ray stands
    glm::vec3 at{0.0F};   ///< along the wall axes
};

/// Places near each other, and the box that holds them. Few places are strays, which need none.
struct Box {
    std::vector<Place> places;
    glm::vec3 min{1e30F};
    glm::vec3 max{-1e30F};

    [[nodiscard]] bool strays() const { return places.size() < min_places; }
    [[nodiscard]] float volume() const {
        const glm::vec3 e = max - min;
        return strays() ? 0.0F : e.x * e.y * e.z;
    }
    [[nodiscard]] double served() const {
        return std::accumulate(places.begin(), places.end(), 0.0,
                               [](double sum, const Place& p) { return sum + p.served; });
    }
};

/// Of n evenly spread numbers none is within the share g of an end by the chance (1 - g)^n. Where
/// an opening reaches beyond the box all the same, its light is found by random directions alone,
/// which leaves marks; a box that is too large costs bundles that start in a wall.
Box make_box(std::vector<Place> places) {
    Box box;
    for (const Place& place : places) {
        box.min = glm::min(box.min, place.at);
        box.max = glm::max(box.max, place.at);
    }
    const glm::vec3 extent = box.max - box.min;
    const float widest = std::max({extent.x, extent.y, extent.z});
    const float gap =
        1.0F - static_cast<float>(std::pow(by_chance, 1.0 / static_cast<double>(places.size())));
    const glm::vec3 margin =
        glm::max(extent * (gap / (1.0F - gap)), glm::vec3(0.5F * least_thickness * widest));
    box.min -= margin;
    box.max += margin;
    box.places = std::move(places);
    return box;
}

/// Two parts of a box between which no ray has passed, where that is no chance; those whose boxes
/// are smallest.
std::optional<std::array<Box, 2>> split(const Box& whole) {
    const auto n = static_cast<double>(whole.places.size());
    std::optional<std::array<Box, 2>> best;
    float least = 0.8F * whole.volume();
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Place> sorted = whole.places;
        std::stable_sort(sorted.begin(), sorted.end(), [axis](const Place& a, const Place& b) {
            return a.at[axis] < b.at[axis];
        });
        const double extent = static_cast<double>(sorted.back().at[axis] - sorted.front().at[axis]);
        for (std::size_t i = 1; i < sorted.size(); ++i) {
            const double gap = static_cast<double>(sorted[i].at[axis] - sorted[i - 1].at[axis]);
            if (gap <= 0.0 || n * std::pow(std::max(1.0 - gap / extent, 0.0), n) > by_chance) {
                continue;
            }
            const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(i);
            std::array<Box, 2> parts = {make_box({sorted.begin(), middle}),
                                        make_box({middle, sorted.end()})};
            if (parts[0].volume() + parts[1].volume() < least) {
                least = parts[0].volume() + parts[1].volume();
                best = std::move(parts);
            }
        }
    }
    return best;
}

std::vector<Box> split_all(Box whole, std::size_t most) {
    std::vector<Box> boxes;
    boxes.push_back(std::move(whole));
    for (std::size_t i = 0; i < boxes.size() && boxes.size() < most;) {
        std::optional<std::array<Box, 2>> parts = split(boxes[i]);
        if (!parts) {
            ++i;
            continue;
        }
        boxes[i] = std::move((*parts)[0]);
        boxes.push_back(std::move((*parts)[1]));
        std::erase_if(boxes, [](const Box& box) { return box.strays(); });
    }
    return boxes;
}

/// What the surfaces see of the sky, as the rays of their clusters tell.
struct Shelter {
    std::vector<bool> sheltered;  ///< of patches: it is little
    double hidden = 0.0;  ///< m²: area of all, less the share of each one's rays that meet it
};

Shelter find_shelter(const ExchangeRays& rays, const ZonePartition& partition,
                     std::span<const ExchangeRay> lost, std::span<const double> sent) {
    std::vector<double> escaped(partition.clusters, 0.0);
    for (const ExchangeRay& ray : lost) {
        const std::uint32_t cluster = partition.cluster[ray.from];
        escaped[cluster] +=
            flux_of(ray) > 0.0 ? static_cast<double>(ray.area) / sent[cluster] : 0.0;
    }
    Shelter shelter;
    for (std::size_t i = 0; i < rays.areas().size(); ++i) {
        const double share = escaped[partition.cluster[i]];
        shelter.sheltered.push_back(share < little_sky);
        shelter.hidden += static_cast<double>(rays.areas()[i]) * std::max(1.0 - share, 0.0);
    }
    return shelter;
}

/// Rays from sheltered surfaces that meet the sky, max_followed at most.
std::vector<ExchangeRay> bright_rays(const ExchangeRays& rays, const std::vector<bool>& sheltered) {
    std::vector<std::uint32_t> patches;
    for (std::uint32_t i = 0; i < sheltered.size(); ++i) {
        if (sheltered[i]) {
            patches.push_back(i);
        }
    }
    std::vector<ExchangeRay> bright;
    for (const ExchangeRay& ray : rays.trace_from(patches, sheltered_rays)) {
        if (flux_of(ray) > 0.0) {
            bright.push_back(ray);
        }
    }
    if (bright.size() > max_followed) {
        for (std::size_t i = 0; i < max_followed; ++i) {
            bright[i] = bright[i * bright.size() / max_followed];
        }
        bright.resize(max_followed);
    }
    return bright;
}

/// bright: rays from sheltered surfaces that meet the sky. Where they pass between others on their
/// way. Those of a zone stand for all of its sheltered surfaces.
std::vector<Place> find_places(const ExchangeRays& rays, const ZonePartition& partition,
                               std::span<const ExchangeRay> bright,
                               const std::vector<bool>& sheltered, const glm::mat3& axes) {
    std::vector<std::optional<glm::vec3>> found(bright.size());
    tbb::parallel_for(std::size_t{0}, bright.size(),
                      [&](std::size_t i) { found[i] = rays.last_narrow_place(bright[i]); });
    std::vector<Place> places;
    std::vector<double> flux(partition.count, 0.0);
    std::vector<double> area(partition.count, 0.0);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i]) {
            places.push_back({&bright[i], 0.0, axes * *found[i]});
            flux[partition.zone[bright[i].from]] += flux_of(bright[i]);
        }
    }
    for (std::size_t i = 0; i < sheltered.size(); ++i) {
        area[partition.zone[i]] += sheltered[i] ? static_cast<double>(rays.areas()[i]) : 0.0;
    }
    for (Place& place : places) {
        const unsigned zone = partition.zone[place.ray->from];
        place.served = area[zone] * flux_of(*place.ray) / flux[zone];
    }
    return places;
}

/// Leaves out places far from others. Of evenly spread ones next to none is four times as far from
/// its fourth neighbour as they usually are: it would have sixteen times as many within that.
void drop_lonely(std::vector<Place>& places) {
    constexpr std::size_t neighbours = 4;
    constexpr float usual_distances = 4.0F;
    if (places.size() <= neighbours) {
        places.clear();
        return;
    }
    std::vector<float> distance(places.size());
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
        std::vector<float> others;
        for (const Place& other : places) {
            others.push_back(glm::distance(places[i].at, other.at));
        }
        std::nth_element(others.begin(), others.begin() + neighbours, others.end());
        distance[i] = others[neighbours];  // the place itself is one of them
    });
    std::vector<float> sorted = distance;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (distance[i] <= usual_distances * *middle) {
            places[kept++] = places[i];
        }
    }
    places.resize(kept);
}

SkyOpening opening_of(const Box& box, const glm::mat3& axes) {
    const glm::mat3 world = glm::transpose(axes);
    SkyOpening opening;
    opening.corner = world * box.min;
    for (int axis = 0; axis < 3; ++axis) {
        opening.edges[static_cast<std::size_t>(axis)] = world[axis] * (box.max - box.min)[axis];
    }
    // A window is thin along its normal, and light passes it that way.
    glm::vec3 inward(0.0F);
    for (const Place& place : box.places) {
        inward -= static_cast<float>(place.served) * (axes * place.ray->towards);
    }
    const glm::vec3 flow = glm::abs(inward) / (box.max - box.min);
    const int normal = flow.x > flow.y ? (flow.x > flow.z ? 0 : 2) : (flow.y > flow.z ? 1 : 2);
    opening.inward = inward[normal] < 0.0F ? -world[normal] : world[normal];
    return opening;
}

}  // namespace

float SkyOpenings::probability(float sky_share) const {
    // What comes by other ways, as the light of a patch of sun, is left to the other bundles: with
    // a quarter less of them its error grows by 1/sqrt(3/4) at most, 15 %.
    constexpr float most = 0.25F;
    return std::min(odds * sky_share / (1.0F + odds * sky_share), most);
}

SkyOpenings find_sky_openings(const ExchangeRays& rays, const ZonePartition& partition,
                              std::span<const ExchangeRay> lost, std::span<const double> sent,
                              std::size_t most) {
    const Shelter shelter = find_shelter(rays, partition, lost, sent);
    const std::vector<bool>& sheltered = shelter.sheltered;
    const std::vector<ExchangeRay> bright = bright_rays(rays, sheltered);
    const glm::mat3 axes = wall_axes(rays);
    std::vector<Place> places = find_places(rays, partition, bright, sheltered, axes);
    drop_lonely(places);
    if (places.size() < min_places) {
        return {};
    }
    SkyOpenings result;
    result.sheltered.assign((rays.areas().size() + 31) / 32, 0);
    result.sheltered_areas.assign(partition.count, 0.0);
    for (std::size_t i = 0; i < rays.areas().size(); ++i) {
        if (sheltered[i]) {
            result.sheltered[i / 32] |= 1U << (i % 32);
            result.sheltered_areas[partition.zone[i]] += static_cast<double>(rays.areas()[i]);
        }
    }
    double roots = 0.0;
    double served = 0.0;
    for (const Box& box : split_all(make_box(std::move(places)), most)) {
        SkyOpening opening = opening_of(box, axes);
        // Errors are relative, and count alike on each square metre. What n bundles leave to
        // surfaces of the areas a, the sum of a/n, is least for n like the root of a.
        opening.share = static_cast<float>(std::sqrt(box.served()));
        if (opening.volume() > 0.0F && opening.share > 0.0F) {
            roots += static_cast<double>(opening.share);
            served += box.served();
            result.openings.push_back(opening);
        }
    }
    for (SkyOpening& opening : result.openings) {
        opening.share /= static_cast<float>(roots);
    }
    // The same rule between these bundles and all others, which serve the whole scene: what sees
    // the sky needs few.
    result.odds =
        static_cast<float>(std::sqrt(std::min(served / std::max(shelter.hidden, 1e-30), 1.0)));
    return result;
}

}  // namespace raybundle
