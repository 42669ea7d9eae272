// SPDX-License-Identifier: Apache-2.0
#include "research/photon_map.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace raybundle {
namespace {

/// Least cosine between the normals of a photon and of the point where it is counted.
constexpr float least_facing = 0.7F;

unsigned char widest_axis(const std::vector<Photon>& photons, std::size_t first, std::size_t last) {
    glm::vec3 low(photons[first].position);
    glm::vec3 high = low;
    for (std::size_t i = first + 1; i < last; ++i) {
        low = glm::min(low, photons[i].position);
        high = glm::max(high, photons[i].position);
    }
    const glm::vec3 extent = high - low;
    if (extent.x >= extent.y && extent.x >= extent.z) {
        return 0;
    }
    return extent.y >= extent.z ? 1 : 2;
}

}  // namespace

struct PhotonMap::Query {
    glm::vec3 position;
    glm::vec3 normal;
    std::size_t nearest;
    float square;              // of the distance within which to look
    std::vector<Found> found;  // a heap once it is full, the farthest on top
};

PhotonMap::PhotonMap(std::vector<Photon> photons)
    : photons_(std::move(photons)), axes_(photons_.size()) {
    arrange(0, photons_.size());
}

void PhotonMap::arrange(std::size_t first, std::size_t last) {
    if (last - first < 2) {
        return;
    }
    const std::size_t middle = first + (last - first) / 2;
    const int axis = widest_axis(photons_, first, last);
    const auto at = [this](std::size_t i) {
        return photons_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(last), [axis](const Photon& a, const Photon& b) {
        return a.position[axis] < b.position[axis];
    });
    axes_[middle] = static_cast<unsigned char>(axis);
    arrange(first, middle);
    arrange(middle + 1, last);
}

void PhotonMap::take(Query& query, const Found& found) {
    const auto nearer = [](const Found& a, const Found& b) { return a.square < b.square; };
    if (query.found.size() == query.nearest) {
        std::pop_heap(query.found.begin(), query.found.end(), nearer);
        query.found.back() = found;
        std::push_heap(query.found.begin(), query.found.end(), nearer);
        query.square = query.found.front().square;
        return;
    }
    query.found.push_back(found);
    if (query.found.size() == query.nearest) {
        std::make_heap(query.found.begin(), query.found.end(), nearer);
        query.square = query.found.front().square;
    }
}

void PhotonMap::search(std::size_t first, std::size_t last, Query& query) const {
    if (first == last) {
        return;
    }
    const std::size_t middle = first + (last - first) / 2;
    const Photon& photon = photons_[middle];
    const float beyond = query.position[axes_[middle]] - photon.position[axes_[middle]];
    const bool above = beyond > 0.0F;
    search(above ? middle + 1 : first, above ? last : middle, query);
    const glm::vec3 offset = photon.position - query.position;
    const float square = glm::dot(offset, offset);
    if (square < query.square && glm::dot(photon.normal, query.normal) > least_facing) {
        take(query, {square, middle});
    }
    if (beyond * beyond < query.square) {
        search(above ? first : middle + 1, above ? middle : last, query);
    }
}

glm::dvec3 PhotonMap::reflected(const SurfacePoint& point, const Scattering& scattering,
                                std::size_t nearest, double radius) const {
    Query query{glm::vec3(point.position),
                glm::vec3(point.normal),
                nearest,
                static_cast<float>(radius * radius),
                {}};
    query.found.reserve(nearest);
    search(0, photons_.size(), query);
    const bool full = query.found.size() == nearest;
    glm::dvec3 sum(0.0);
    for (std::size_t i = full ? 1 : 0; i < query.found.size(); ++i) {
        const Photon& photon = photons_[query.found[i].photon];
        sum += glm::dvec3(photon.power) * scattering.reflectance(glm::dvec3(photon.from));
    }
    const double square = query.square;
    return square > 0.0 ? sum / (glm::pi<double>() * square) : glm::dvec3(0.0);
}

}  // namespace raybundle
