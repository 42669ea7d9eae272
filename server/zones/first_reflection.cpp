// SPDX-License-Identifier: Apache-2.0
#include "zones/first_reflection.h"

namespace raybundle {

FirstReflection::FirstReflection(const ZonePartition& partition, std::span<const ExchangeRay> rays,
                                 std::span<const glm::vec3> base_colour)
    : zones_(partition.count),
      seen_(std::size_t{partition.clusters} * partition.count, glm::vec3(0.0F)),
      area_(partition.clusters, 0.0F) {
    const auto add = [&](std::uint32_t at, std::uint32_t end, float area) {
        const std::uint32_t cluster = partition.cluster[at];
        area_[cluster] += area;
        if (end != ExchangeRay::lost && partition.zone[end] != partition.loose) {
            seen_[std::size_t{cluster} * zones_ + partition.zone[end]] += area * base_colour[end];
        }
    };
    for (const ExchangeRay& ray : rays) {
        add(ray.from, ray.to, ray.area);
        if (ray.to != ExchangeRay::lost) {
            add(ray.to, ray.from, ray.area);
            matters_ = matters_ || glm::dot(base_colour[ray.from], base_colour[ray.to]) > 0.0F;
        }
    }
}

std::vector<glm::vec4> FirstReflection::irradiance(const ZonePartition& partition,
                                                   std::span<const ZoneFlux> zones,
                                                   std::span<const glm::dvec3> incident,
                                                   std::span<const float> areas) const {
    std::vector<glm::vec4> result(areas.size(), glm::vec4(0.0F));
    if (area_.empty()) {
        return result;
    }
    std::vector<glm::dvec3> of_clusters(area_.size(), glm::dvec3(0.0));
    for (std::size_t cluster = 0; cluster < area_.size(); ++cluster) {
        for (unsigned zone = 0; zone < zones_ && area_[cluster] > 0.0F; ++zone) {
            const glm::vec3 share = seen_[cluster * zones_ + zone] / area_[cluster];
            if (zones[zone].area > 0.0) {
                of_clusters[cluster] += glm::dvec3(share) * incident[zone] / zones[zone].area;
            }
        }
    }
    std::vector<glm::dvec3> given(zones_, glm::dvec3(0.0));
    for (std::size_t i = 0; i < areas.size(); ++i) {
        given[partition.zone[i]] +=
            static_cast<double>(areas[i]) * of_clusters[partition.cluster[i]];
    }
    std::vector<glm::dvec3> factor(zones_, glm::dvec3(1.0));
    for (unsigned zone = 0; zone < zones_; ++zone) {
        for (int c = 0; c < 3 && !zones[zone].loose; ++c) {
            const double missing = incident[zone][c] - zones[zone].incident[c];
            factor[zone][c] =
                missing > 0.0 && given[zone][c] > 0.0 ? missing / given[zone][c] : 0.0;
        }
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
        result[i] = glm::vec4(factor[partition.zone[i]] * of_clusters[partition.cluster[i]], 0.0);
    }
    return result;
}

std::vector<ZoneFlux> direct_light(std::vector<ZoneFlux> zones,
                                   std::span<const ZoneExchange> exchange,
                                   std::span<const ZoneSky> sky) {
    std::vector<glm::dvec3> sent(zones.size(), glm::dvec3(0.0));
    for (const ZoneExchange& pair : exchange) {
        sent[pair.from] += pair.emitted;
    }
    for (std::size_t t = 0; t < zones.size(); ++t) {
        zones[t].incident = sky[t].flux;
    }
    for (const ZoneExchange& pair : exchange) {
        for (int c = 0; pair.to < zones.size() && c < 3; ++c) {
            const double all = sent[pair.from][c];
            zones[pair.to].incident[c] +=
                all > 0.0 ? zones[pair.from].emitted[c] * pair.emitted[c] / all : 0.0;
        }
    }
    return zones;
}

}  // namespace raybundle
