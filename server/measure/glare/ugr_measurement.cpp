// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/ugr_measurement.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "measure/glare/background_paths.h"
#include "measure/point_measurement.h"
#include "measure/solid_test.h"

namespace raybundle {
namespace {

using std::numbers::pi;

constexpr double smallest_area = 0.005;  // m², projected: CIE 117, CIE 147
constexpr double largest_angle = 0.1;    // sr: CIE 117
constexpr double highest = 2.0;          // H/R: where the table of CIE 117 ends
constexpr double told = 0.05;            // of UGR: half of the last digit that is stated
constexpr double scale = 8.0;            // UGR = 8 log10(...)
constexpr std::size_t nothing = SeenSource::batches;

enum class Place { counted, below, beyond, behind };

Place place_of(const Gaze& gaze, const glm::dvec3& direction) {
    if (!(glm::dot(direction, gaze.forward) > 0.0)) {
        return Place::behind;
    }
    const double height = height_ratio(gaze, direction);
    return height < 0.0 ? Place::below : height > highest ? Place::beyond : Place::counted;
}

std::string counted(std::uint32_t count, const char* one, const char* many) {
    return count == 0 ? "" : fmt::format("{} {}; ", count, count == 1 ? one : many);
}

std::string words_of(const GlareRating& r, bool small_matter, bool dark) {
    std::string words;
    if (r.large > 0) {
        words += counted(r.large, "luminaire covers", "luminaires cover each");
        words.replace(words.size() - 2, 2, " more than 0.1 sr: UGR does not rate large areas; ");
    }
    if (small_matter) {
        words += counted(r.small, "source that matters has", "sources that matter have each");
        words.replace(words.size() - 2, 2,
                      " less than 0.005 m² of projected luminous area: UGR does not rate them; ");
    }
    if (dark) {
        words += "no light makes a background; ";
    }
    words += counted(r.below, "luminaire below the line of sight is left out",
                     "luminaires below the line of sight are left out");
    words += counted(r.beyond, "luminaire with H/R above 2 is left out",
                     "luminaires with H/R above 2 are left out");
    if (!words.empty()) {
        words.resize(words.size() - 2);
    }
    return words;
}

}  // namespace

std::vector<glm::dvec3> views_all_round(std::size_t count, const glm::dvec3& first) {
    const glm::dvec3 ahead = glm::normalize(glm::dvec3(first.x, 0.0, first.z));
    const glm::dvec3 right(-ahead.z, 0.0, ahead.x);
    std::vector<glm::dvec3> views;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(count);
        views.push_back(std::cos(angle) * ahead + std::sin(angle) * right);
    }
    return views;
}

UgrMeasurement::UgrMeasurement(std::shared_ptr<const MeasuredScene> scene,
                               std::vector<CalculationPoint> points, UgrSettings settings)
    : scene_(std::move(scene)),
      points_(std::move(points)),
      settings_(std::move(settings)),
      sources_(find_glare_sources(*scene_)),
      inside_(points_.size()),
      seen_(points_.size()) {
    if (points_.empty() || points_.size() > most_points || settings_.views.size() > most_views) {
        throw std::invalid_argument("a glare rating has 1 to 1024 points and up to 8 views");
    }
    for (const glm::dvec3& view : settings_.views) {
        gazes_.emplace_back(view);
    }
    for (const CalculationPoint& point : points_) {
        places_.push_back(scene_->rays.from_world(point.position));
        if (settings_.views.empty()) {
            gazes_.emplace_back(point.direction);
        }
    }
    sums_.resize(points_.size() * views() * batches);
    tbb::parallel_for(std::size_t{0}, points_.size(), [&](std::size_t i) {
        inside_[i] = inside_solid(scene_->rays, places_[i]) ? 1 : 0;
    });
    measured_ = static_cast<std::size_t>(std::count(inside_.begin(), inside_.end(), 0));
}

void UgrMeasurement::add_samples(std::size_t count) {
    const std::uint64_t first = steps_;
    const std::size_t all = points_.size();
    for (std::uint64_t begin = first; begin < first + count;) {
        const std::uint64_t end = std::min(first + count, (begin / all + 1) * all);
        tbb::parallel_for(begin, end,
                          [&](std::uint64_t step) { add_sample(step % all, step / all); });
        begin = end;
    }
    steps_ = first + count;
}

/// Directions over the whole sphere by their sine from the vertical serve all horizontal views.
void UgrMeasurement::add_sample(std::size_t point, std::uint64_t round) {
    if (inside(point) || scene_->paths.air()) {
        return;
    }
    if (round == 0) {
        look_around(point);
    }
    const bool single = settings_.views.empty();
    const Receiver receiver(single ? Quantity::normal : Quantity::cylindrical,
                            gaze(point, 0).forward);
    for (std::size_t batch = 0; batch < batches; ++batch) {
        PixelSampler sampler(settings_.seed, static_cast<std::uint32_t>(point),
                             static_cast<std::uint32_t>(batch), static_cast<std::uint32_t>(round));
        const auto add = [&](const glm::dvec3& direction, double light) {
            for (std::size_t view = 0; view < views(); ++view) {
                const double cosine = glm::dot(direction, gaze(point, view).forward);
                sums_[(point * views() + view) * batches + batch] += std::max(cosine, 0.0) * light;
            }
        };
        const glm::dvec3 direction = receiver.sample(sampler);
        const double weight = receiver.weight(direction);
        for_each_sun(*scene_, places_[point], sampler,
                     [&](const PlacedLight&, const SampledLight& sun) {
                         add(sun.direction, sun.luminance);
                     });
        if (weight > 0.0) {
            add(direction,
                pi / weight * background_luminance(*scene_, places_[point], direction, sampler));
        }
    }
}

void UgrMeasurement::look_around(std::size_t point) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const std::uint64_t seed = mixed_bits(mixed_bits(settings_.seed + point) + i);
        if (auto seen = look_at(*scene_, sources_[i], places_[point], seed)) {
            seen->source = static_cast<std::uint32_t>(i);
            seen_[point].push_back(*seen);
        }
    }
}

/// L² omega; without: a batch that is left out, or `nothing`.
double UgrMeasurement::illuminance_term(const SeenSource& seen, std::size_t without) const {
    const bool whole = without == nothing;
    const double e = whole ? seen.mean_illuminance() : seen.illuminance_without(without);
    if (seen.area < smallest_area) {  // CIE 147: 200 I²/r², I = E r²
        return 200.0 * e * e * seen.distance * seen.distance;
    }
    const double angle = whole ? seen.mean_solid_angle() : seen.solid_angle_without(without);
    return angle > 0.0 ? e * e / angle : 0.0;
}

UgrMeasurement::Glaring UgrMeasurement::glaring(std::size_t point, std::size_t view) const {
    Glaring result;
    const Gaze& eye = gaze(point, view);
    std::array<double, batches> without{};
    for (const SeenSource& seen : seen_[point]) {
        const Place place = place_of(eye, seen.direction);
        result.counts.below += place == Place::below ? 1 : 0;
        result.counts.beyond += place == Place::beyond ? 1 : 0;
        if (place != Place::counted) {
            continue;
        }
        const double p = guth_index(eye, seen.direction);
        const double term = illuminance_term(seen, nothing) / (p * p);
        const bool small = seen.area < smallest_area;
        result.counts.sources += 1;
        result.counts.small += small ? 1 : 0;
        result.counts.large += seen.mean_solid_angle() > largest_angle ? 1 : 0;
        result.small += small ? term : 0.0;
        if (small && !settings_.small_sources) {
            continue;
        }
        result.sum += term;
        for (std::size_t b = 0; b < batches; ++b) {
            const double other = guth_index(eye, seen.direction_without(b));
            without[b] += illuminance_term(seen, b) / (other * other);
        }
    }
    const double mean = std::accumulate(without.begin(), without.end(), 0.0) / batches;
    for (const double part : without) {
        result.variance += mean > 0.0 ? (part / mean - 1.0) * (part / mean - 1.0) : 0.0;
    }
    result.variance *= static_cast<double>(batches - 1) / batches;
    return result;
}

UgrMeasurement::Background UgrMeasurement::background(std::size_t point, std::size_t view) const {
    const double* const sums = &sums_[(point * views() + view) * batches];
    const std::uint64_t done = rounds() + (point < steps_ % points_.size() ? 1 : 0);
    const double whole = std::accumulate(sums, sums + batches, 0.0);
    if (!(whole > 0.0)) {
        return {};
    }
    Background result{whole / (batches * static_cast<double>(done)), 0.0};
    for (std::size_t b = 0; b < batches; ++b) {
        const double off = sums[b] * batches / whole - 1.0;
        result.variance += off * off / (double{batches} * (batches - 1));
    }
    return result;
}

/// Few paths may have missed what is rare: no background is known better than the mean of all.
double UgrMeasurement::common_variance() const {
    double sum = 0.0;
    for (std::size_t point = 0; point < points_.size(); ++point) {
        for (std::size_t view = 0; view < views() && !inside(point); ++view) {
            sum += background(point, view).variance;
        }
    }
    return sum / static_cast<double>(std::max<std::size_t>(measured_ * views(), 1));
}

GlareRating UgrMeasurement::rate(std::size_t point, std::size_t view, double least_variance) const {
    if (scene_->paths.air()) {
        return rating_in_air(gaze(point, view).forward, "UGR");
    }
    const Glaring found = glaring(point, view);
    const Background behind = background(point, view);
    GlareRating rating = found.counts;
    rating.view = gaze(point, view).forward;
    rating.background = behind.mean / pi;
    const bool dark = found.sum + found.small > 0.0 && !(behind.mean > 0.0);
    const bool small_matter =
        !settings_.small_sources && found.small > 0.0 &&
        (found.sum <= 0.0 || scale * std::log10(1.0 + found.small / found.sum) >= told);
    rating.words = words_of(rating, small_matter, dark);
    if (dark || small_matter || rating.large > 0) {
        rating.state = GlareRating::State::outside;
    } else {
        rating.state = found.sum > 0.0 ? GlareRating::State::rated : GlareRating::State::no_source;
    }
    if (found.sum > 0.0 && behind.mean > 0.0) {
        rating.error = scale / std::numbers::ln10 *
                       std::sqrt(std::max(behind.variance, least_variance) + found.variance);
        rating.value.value = scale * std::log10(0.25 / rating.background * found.sum);
    }
    return rating;
}

/// The worst view of each point.
std::vector<GlareRating> UgrMeasurement::rate_all() const {
    std::vector<GlareRating> result(points_.size());
    const double least = rounds() > 0 ? common_variance() : 0.0;
    for (std::size_t point = 0; point < points_.size() && rounds() > 0; ++point) {
        std::vector<GlareRating> ratings;
        for (std::size_t view = 0; view < views() && !inside(point); ++view) {
            ratings.push_back(rate(point, view, least));
        }
        if (!ratings.empty()) {
            result[point] = worst_of(std::move(ratings));
        }
    }
    return result;
}

void UgrMeasurement::name_sources(std::size_t point, const Gaze& eye, GlareRating& rating) const {
    double whole = 0.0;
    for (const SeenSource& seen : seen_[point]) {
        if (place_of(eye, seen.direction) != Place::counted) {
            continue;
        }
        const GlareSource& source = sources_[seen.source];
        GlareShare share;
        share.name = source.name;
        share.light = source.light;
        share.position = points_[point].position + seen.distance * seen.direction;
        share.position_index = guth_index(eye, seen.direction);
        share.solid_angle = seen.mean_solid_angle();
        share.luminance =
            share.solid_angle > 0.0 ? seen.mean_illuminance() / share.solid_angle : 0.0;
        share.share =
            illuminance_term(seen, nothing) / (share.position_index * share.position_index);
        whole += share.share;
        rating.shares.push_back(share);
    }
    std::stable_sort(rating.shares.begin(), rating.shares.end(),
                     [](const GlareShare& a, const GlareShare& b) { return a.share > b.share; });
    rating.shares.resize(std::min(rating.shares.size(), GlareRating::most_sources));
    for (GlareShare& share : rating.shares) {
        share.share /= whole;
    }
}

std::vector<GlareRating> UgrMeasurement::glare() const {
    std::vector<GlareRating> result = rate_all();
    for (std::size_t point = 0; point < points_.size(); ++point) {
        if (rounds() > 0 && !inside(point)) {
            name_sources(point, Gaze(result[point].view), result[point]);
        }
    }
    return result;
}

std::vector<Interval> UgrMeasurement::values() const {
    std::vector<Interval> result;
    for (const GlareRating& rating : rate_all()) {
        result.push_back(rating.value);
    }
    return result;
}

std::optional<MeasurementSummary> UgrMeasurement::all() const {
    const std::vector<GlareRating> ratings = glare();
    const auto range = range_of(ratings);
    return range ? std::optional(
                       MeasurementSummary{range->mean, range->minimum, range->maximum, {}, {}})
                 : std::nullopt;
}

double UgrMeasurement::relative_error() const {
    if (rounds() < PointMeasurement::least_rounds) {
        return std::numeric_limits<double>::infinity();
    }
    double widest = 0.0;
    for (const GlareRating& rating : rate_all()) {
        widest = std::max(widest, 0.5 * (rating.value.high - rating.value.low));
    }
    return std::numbers::ln10 / scale * widest;
}

}  // namespace raybundle
