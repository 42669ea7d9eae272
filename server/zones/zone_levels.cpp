// SPDX-License-Identifier: Apache-2.0
#include "zones/zone_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raybundle {

namespace {

constexpr double max_scale = 50.0;     // of what patches have; the rest is spread evenly
constexpr double fewest_groups = 4.0;  // that tell a variance
/// 32 iterations, the block within which shooters are stratified (transport/iteration_schedule.h).
constexpr unsigned groups_per_batch = 4;
constexpr double fewest_rays =
    4.0;  // that tell a flux from chance: fewer are off by more than a half

/// Share of the correction of its level that a zone gets. A zone that loses most of its light
/// forgets its start by itself, and its level would follow the noise of all of its patches.
double firmness(double arriving_share) {
    constexpr double loose = 0.3;
    constexpr double firm = 0.6;
    const double x = std::clamp((arriving_share - loose) / (firm - loose), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

/// Solves A x = b by elimination with partial pivoting; a: rows of n + 1, the last one is b.
std::vector<double> solve_linear(std::vector<double> a, std::size_t n) {
    const std::size_t row = n + 1;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i) {
            if (std::abs(a[i * row + k]) > std::abs(a[pivot * row + k])) {
                pivot = i;
            }
        }
        if (pivot != k) {
            std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(k * row),
                             a.begin() + static_cast<std::ptrdiff_t>((k + 1) * row),
                             a.begin() + static_cast<std::ptrdiff_t>(pivot * row));
        }
        const double p = a[k * row + k];
        if (p == 0.0) {
            continue;
        }
        for (std::size_t i = k + 1; i < n; ++i) {
            const double f = a[i * row + k] / p;
            if (f == 0.0) {
                continue;
            }
            for (std::size_t j = k; j <= n; ++j) {
                a[i * row + j] -= f * a[k * row + j];
            }
        }
    }
    std::vector<double> x(n, 0.0);
    for (std::size_t k = n; k-- > 0;) {
        double sum = a[k * row + n];
        for (std::size_t j = k + 1; j < n; ++j) {
            sum -= a[k * row + j] * x[j];
        }
        x[k] = a[k * row + k] != 0.0 ? sum / a[k * row + k] : 0.0;
    }
    return x;
}

/// Shares of what leaves each zone, and what rays leave unknown of them.
struct Shares {
    std::vector<glm::dvec3> reflected, emitted;  // [to * zones + from]
    std::vector<double> variance;                // of luminance shares, likewise
    std::vector<double> lost_variance;           // of what arrives nowhere, of each zone
};

glm::dvec3 ratio(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& otherwise) {
    glm::dvec3 result = otherwise;
    for (int c = 0; c < 3; ++c) {
        if (b[c] > 0.0) {
            result[c] = a[c] / b[c];
        }
    }
    return result;
}

/// What rays without any light, at the start, say of it: by their number.
Shares shares_of(std::span<const ZoneExchange> exchange, unsigned zones) {
    struct Total {
        glm::dvec3 reflected{0.0}, emitted{0.0};
        double light = 0.0, squares = 0.0, rays = 0.0;
    };
    std::vector<Total> total(zones);
    for (const ZoneExchange& e : exchange) {
        Total& t = total[e.from];
        t.reflected += e.reflected;
        t.emitted += e.emitted;
        t.light += luminance_of(e.reflected + e.emitted);
        t.squares += e.squares;
        t.rays += e.rays;
    }
    Shares shares;
    shares.reflected.assign(std::size_t{zones} * zones, glm::dvec3(0.0));
    shares.emitted = shares.reflected;
    // A pair of zones that no ray connects may still exchange as much as one ray carries.
    shares.variance.resize(shares.reflected.size());
    shares.lost_variance.assign(zones, 0.0);
    for (unsigned from = 0; from < zones; ++from) {
        const Total& t = total[from];
        const double count =
            t.squares > 0.0 ? t.light * t.light / t.squares : std::max(t.rays, 1.0);
        for (unsigned to = 0; to < zones; ++to) {
            const double unseen = to == from ? 0.0 : 1.0 / (count * count);
            shares.variance[std::size_t{to} * zones + from] = unseen;
        }
    }
    for (const ZoneExchange& e : exchange) {
        if (e.to >= zones) {
            const Total& t = total[e.from];
            const double lost = t.light > 0.0 ? luminance_of(e.reflected + e.emitted) / t.light
                                              : e.rays / std::max(t.rays, 1.0);
            const double count =
                t.squares > 0.0 ? t.light * t.light / t.squares : std::max(t.rays, 1.0);
            shares.lost_variance[e.from] = lost * std::max(1.0 - lost, 0.0) / count;
        }
        if (e.to >= zones || (e.to != e.from && e.rays < fewest_rays)) {
            continue;
        }
        const Total& t = total[e.from];
        const std::size_t at = std::size_t{e.to} * zones + e.from;
        const glm::dvec3 by_count(t.rays > 0.0 ? e.rays / t.rays : 0.0);
        shares.reflected[at] = ratio(e.reflected, t.reflected, by_count);
        shares.emitted[at] = ratio(e.emitted, t.emitted, shares.reflected[at]);
        const double count =
            t.squares > 0.0 ? t.light * t.light / t.squares : std::max(t.rays, 1.0);
        const double k =
            t.light > 0.0 ? luminance_of(e.reflected + e.emitted) / t.light : by_count.x;
        shares.variance[at] += k * std::max(1.0 - k, 0.0) / count;
    }
    return shares;
}

}  // namespace

ZoneLevels::ZoneLevels(unsigned zones)
    : zones_(zones),
      beyond_(zones),
      incident_(zones, glm::dvec3(0.0)),
      present_(zones, glm::dvec3(0.0)),
      predicted_(zones, glm::dvec3(0.0)),
      error_(zones, 0.0) {}

void ZoneLevels::forget() {
    beyond_.assign(zones_, Beyond{});
    solved_ = false;
}

void ZoneLevels::scale(const glm::vec3& factor) {
    const double brightness = luminance_of(glm::dvec3(factor));
    for (Beyond& b : beyond_) {
        for (Mean* mean : {&b.groups, &b.batches}) {
            mean->mean *= glm::dvec3(factor);
            mean->squares *= brightness * brightness;
        }
        b.batch_sum *= glm::dvec3(factor);
    }
}

void ZoneLevels::note_group(std::span<const ZoneFlux> zones, std::span<const double> older_share,
                            double weight) {
    if (!solved_ || weight <= 0.0) {
        return;
    }
    for (unsigned t = 0; t < zones_; ++t) {
        if (older_share[t] >= 1.0) {
            continue;
        }
        const glm::dvec3 brought =
            (zones[t].incident - older_share[t] * present_[t]) / (1.0 - older_share[t]);
        const glm::dvec3 difference = brought - predicted_[t];
        Beyond& b = beyond_[t];
        b.groups.add(difference, weight);
        b.batch_sum += weight * difference;
        b.batch_weight += weight;
        if (++b.batch_groups == groups_per_batch) {
            b.batches.add(b.batch_sum / b.batch_weight, b.batch_weight);
            b.batch_sum = glm::dvec3(0.0);
            b.batch_weight = 0.0;
            b.batch_groups = 0;
        }
    }
}

void ZoneLevels::Mean::add(const glm::dvec3& value, double value_weight) {
    weight += value_weight;
    squared_weight += value_weight * value_weight;
    const double before = luminance_of(value - mean);
    mean += (value - mean) * (value_weight / weight);
    squares += value_weight * before * luminance_of(value - mean);
}

double ZoneLevels::Mean::error() const {
    return count() > 1.0 ? std::sqrt(squares / (weight * (count() - 1.0))) : 0.0;
}

/// Weight of the flux that bundles bring beyond the rays' prediction, from its variance and that of
/// the rays.
glm::dvec3 ZoneLevels::beyond(unsigned zone, double variance) const {
    const Beyond& b = beyond_[zone];
    if (!known(zone)) {
        return glm::dvec3(0.0);
    }
    const double own = noise(zone) * noise(zone);
    return variance + own > 0.0 ? b.groups.mean * (variance / (variance + own)) : glm::dvec3(0.0);
}

bool ZoneLevels::known(unsigned zone) const {
    return beyond_[zone].groups.count() >= fewest_groups;
}

double ZoneLevels::noise(unsigned zone) const {
    const Beyond& b = beyond_[zone];
    if (!known(zone)) {
        return 0.0;
    }
    return b.batches.count() >= fewest_groups ? b.batches.error() : b.groups.error();
}

/// Bounds the flux that bundles bring to all zones together beyond the prediction: it counts only
/// as far as the rays leave the lost flux uncertain. In a closed scene the rest is noise and
/// exchange between zones, which the levels would magnify. Zones share the correction by their
/// variances (least squares with a given sum), so that a wide, noisy outside hardly changes a room.
/// variance: of the rays' prediction for each zone.
void ZoneLevels::conserve(std::span<const double> variance, std::span<const double> lost_variance,
                          std::span<const glm::dvec3> albedo, std::span<const ZoneFlux> zones,
                          std::span<const ZoneSky> sky, std::vector<glm::dvec3>& extra) const {
    double lost = 0.0;
    double noise_of_all = 0.0;
    double freedom = 0.0;
    std::vector<double> unknown(zones_, 0.0);
    glm::dvec3 all(0.0), sum(0.0);
    for (unsigned t = 0; t < zones_; ++t) {
        const double light = luminance_of(zones[t].emitted + albedo[t] * incident_[t]);
        lost += light * light * lost_variance[t] + sky[t].squares;
        sum += extra[t];
        if (known(t)) {
            const double own = noise(t) * noise(t);
            noise_of_all += own;
            all += beyond_[t].groups.mean;
            unknown[t] = own + variance[t] > 0.0 ? own * variance[t] / (own + variance[t]) : 0.0;
            freedom += unknown[t];
        }
    }
    if (freedom <= 0.0) {
        return;
    }
    const glm::dvec3 believed = lost > 0.0 ? all * (lost / (lost + noise_of_all)) : glm::dvec3(0.0);
    for (unsigned t = 0; t < zones_; ++t) {
        extra[t] -= (sum - believed) * (unknown[t] / freedom);
    }
}

std::vector<ZoneLevel> ZoneLevels::solve(std::span<const ZoneFlux> zones,
                                         std::span<const ZoneExchange> exchange,
                                         std::span<const ZoneSky> sky) {
    const Shares shares = shares_of(exchange, zones_);
    const std::size_t n = zones_;
    std::vector<glm::dvec3> albedo(n);
    std::vector<glm::dvec3> extra(n);
    std::vector<double> variances(n);
    for (unsigned t = 0; t < n; ++t) {
        albedo[t] = glm::clamp(ratio(zones[t].reflected, zones[t].incident, zones[t].albedo),
                               glm::dvec3(0.0), glm::dvec3(0.9999));
        double variance = sky[t].squares;
        for (unsigned s = 0; s < n; ++s) {
            const double light = luminance_of(zones[s].emitted + albedo[s] * incident_[s]);
            variance += light * light * shares.variance[t * n + s];
        }
        error_[t] = std::sqrt(variance);
        variances[t] = variance;
        extra[t] = beyond(t, variance);
    }
    conserve(variances, shares.lost_variance, albedo, zones, sky, extra);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> a(n * (n + 1), 0.0);
        for (std::size_t t = 0; t < n; ++t) {
            double known = sky[t].flux[c] + extra[t][c];
            for (std::size_t s = 0; s < n; ++s) {
                a[t * (n + 1) + s] = -shares.reflected[t * n + s][c] * albedo[s][c];
                known += shares.emitted[t * n + s][c] * zones[s].emitted[c];
            }
            a[t * (n + 1) + t] += 1.0;
            a[t * (n + 1) + n] = known;
        }
        const std::vector<double> x = solve_linear(std::move(a), n);
        for (std::size_t t = 0; t < n; ++t) {
            incident_[t][c] = std::max(x[t], 0.0);
        }
    }
    std::vector<glm::dvec3> present(n);  // incident fluxes at the levels that are set
    std::vector<ZoneLevel> levels(n);
    for (std::size_t t = 0; t < n; ++t) {
        const glm::dvec3 reflected = albedo[t] * incident_[t];
        double arriving = 0.0;
        for (std::size_t to = 0; to < n; ++to) {
            arriving += luminance_of(shares.reflected[to * n + t] * reflected +
                                     shares.emitted[to * n + t] * zones[t].emitted);
        }
        const double sent = luminance_of(reflected + zones[t].emitted);
        const double firm = zones[t].loose ? 0.0 : (sent > 0.0 ? firmness(arriving / sent) : 1.0);
        for (int c = 0; c < 3; ++c) {
            const double has = zones[t].incident[c];
            const double wanted = has + firm * (incident_[t][c] - has);
            if (has > 0.0 && wanted <= max_scale * has) {
                levels[t].scale[c] = wanted / has;
            } else if (zones[t].area > 0.0) {
                levels[t].offset[c] = (wanted - has) / zones[t].area;
            }
            present[t][c] = wanted;
        }
    }
    for (std::size_t t = 0; t < n; ++t) {
        predicted_[t] = sky[t].flux;
        for (std::size_t s = 0; s < n; ++s) {
            predicted_[t] += shares.emitted[t * n + s] * zones[s].emitted +
                             shares.reflected[t * n + s] * albedo[s] * present[s];
        }
    }
    present_ = present;
    solved_ = true;
    return levels;
}

}  // namespace raybundle
