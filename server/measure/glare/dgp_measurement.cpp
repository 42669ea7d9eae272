// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/dgp_measurement.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "measure/glare/background_paths.h"
#include "measure/solid_test.h"

namespace raybundle {
namespace {

constexpr double glaring_from = 5.0;  // times the mean luminance

double dgp_of(double illuminance, double glaring) {
    return 5.87e-5 * illuminance +
           (illuminance > 0.0
                ? 0.0918 * std::log10(1.0 + std::max(glaring, 0.0) / std::pow(illuminance, 1.87))
                : 0.0) +
           0.16;
}

double cosine_ahead(const Gaze& eye, const glm::dvec3& direction) {
    return std::max(glm::dot(eye.forward, direction), 0.0);
}

glm::dvec3 direction_of(const SeenSource& seen, std::size_t without) {
    return without < SeenSource::batches ? seen.direction_without(without) : seen.direction;
}

std::string words_for(const GlareRating& rating) {
    std::string words;
    if (rating.small > 0) {
        words = fmt::format(
            "{} in the illuminance at the eye alone",
            rating.small == 1 ? "a source without size counts" : "sources without size count");
    }
    const double value = rating.value.value;
    if (value < 0.2 || value > 0.8) {
        words += fmt::format("{}{}, where DGP has not been tested", words.empty() ? "" : "; ",
                             value < 0.2 ? "below 0.2" : "above 0.8");
    }
    return words;
}

}  // namespace

glm::dvec3 Fisheye::direction(const Gaze& gaze, std::size_t pixel, const glm::dvec2& at) {
    const std::size_t row = pixel / columns;
    const double z = 1.0 - (static_cast<double>(row) + at.x) / rows;
    const double azimuth =
        2.0 * std::numbers::pi * (static_cast<double>(pixel % columns) + at.y) / columns;
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 right = glm::cross(gaze.forward, gaze.up);
    return z * gaze.forward + r * (std::cos(azimuth) * gaze.up + std::sin(azimuth) * right);
}

DgpMeasurement::DgpMeasurement(std::shared_ptr<const MeasuredScene> scene,
                               std::vector<CalculationPoint> points, DgpSettings settings)
    : scene_(std::move(scene)),
      points_(std::move(points)),
      settings_(std::move(settings)),
      sources_(find_glare_sources(*scene_)),
      inside_(points_.size()),
      seen_(points_.size()) {
    if (points_.empty() || points_.size() > most_points || settings_.views.size() > most_views) {
        throw std::invalid_argument("a glare probability has 1 to 16 points and up to 8 views");
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
    for (std::size_t i = 0; i < points_.size(); ++i) {
        inside_[i] = inside_solid(scene_->rays, places_[i]) ? 1 : 0;
        measured_ += inside_[i] != 0 ? 0 : 1;
    }
    views_.resize(points_.size() * views());
}

void DgpMeasurement::add_samples(std::size_t count) {
    const std::uint64_t first = steps_;
    for (; steps_ < first + count; ++steps_) {
        const std::size_t point = steps_ % points_.size();
        const std::uint64_t round = steps_ / points_.size();
        if (inside(point) || scene_->paths.air()) {
            continue;
        }
        if (round == 0) {
            look_around(point);
        }
        tbb::parallel_for(std::size_t{0}, views(),
                          [&](std::size_t view) { add_sample(point, view, round); });
    }
}

void DgpMeasurement::look_around(std::size_t point) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const std::uint64_t seed = mixed_bits(mixed_bits(settings_.seed + point) + i);
        if (const auto seen = look_at(*scene_, sources_[i], places_[point], seed)) {
            seen_[point].push_back({*seen, sources_[i].name, sources_[i].light});
        }
    }
    see_suns(point);
}

/// The part of each sun's disc that is seen.
void DgpMeasurement::see_suns(std::size_t point) {
    constexpr std::uint32_t samples = 8;
    std::vector<Source> suns;
    for (std::uint32_t k = 0; k < samples; ++k) {
        for (std::uint32_t b = 0; b < batches; ++b) {
            PixelSampler sampler(mixed_bits(settings_.seed), static_cast<std::uint32_t>(point), b,
                                 k);
            std::size_t i = 0;
            for_each_sun(*scene_, places_[point], sampler,
                         [&](const PlacedLight& light, const SampledLight& sun) {
                             suns.resize(std::max(suns.size(), i + 1));
                             Source& source = suns[i++];
                             source.name = "sun";
                             source.seen.direction = -light.direction();
                             const double disc =
                                 2.0 * std::numbers::pi * (1.0 - std::cos(light.angular_radius));
                             source.seen.solid_angle[b] +=
                                 sun.luminance > 0.0 ? disc / samples : 0.0;
                             source.seen.illuminance[b] += sun.luminance / samples;
                         });
        }
    }
    for (Source& sun : suns) {
        if (sun.seen.mean_illuminance() > 0.0) {
            seen_[point].push_back(std::move(sun));
        }
    }
}

void DgpMeasurement::add_sample(std::size_t point, std::size_t view, std::uint64_t round) {
    View& own = views_[point * views() + view];
    own.sums.resize(Fisheye::pixels * batches);
    const std::size_t part = round % pass;
    const auto turn = static_cast<std::uint32_t>(round / pass);
    for (std::size_t pixel = part; pixel < Fisheye::pixels; pixel += pass) {
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            PixelSampler sampler(settings_.seed + point * most_views + view,
                                 static_cast<std::uint32_t>(pixel), batch, turn);
            const glm::dvec3 direction =
                Fisheye::direction(gaze(point, view), pixel, sampler.next_pair());
            own.sums[pixel * batches + batch] += static_cast<float>(
                background_luminance(*scene_, places_[point], direction, sampler));
        }
    }
    own.rounds = round + 1;
}

/// Without one of the batches, or with all of them.
DgpMeasurement::Picture DgpMeasurement::picture(const View& view, std::size_t without) const {
    Picture result;
    result.luminance.resize(Fisheye::pixels);
    result.halves.resize(Fisheye::pixels);
    for (std::size_t pixel = 0; pixel < Fisheye::pixels && !view.sums.empty(); ++pixel) {
        const std::uint64_t full = view.rounds / pass;
        const std::uint64_t turns = full + (pixel % pass < view.rounds % pass ? 1 : 0);
        std::array<double, 2> sum{}, squares{}, count{};  // of even and odd batches
        for (std::size_t b = 0; b < batches && turns > 0; ++b) {
            if (b != without) {
                const double one = static_cast<double>(view.sums[pixel * batches + b]) /
                                   static_cast<double>(turns);
                sum[b % 2] += one;
                squares[b % 2] += one * one;
                count[b % 2] += 1.0;
            }
        }
        if (turns == 0) {
            continue;
        }
        result.luminance[pixel] = (sum[0] + sum[1]) / (count[0] + count[1]);
        for (std::size_t half = 0; half < 2; ++half) {
            // Of pairs of different batches alone: (sum² - squares)/(n (n - 1)).
            result.halves[pixel][half] = {
                sum[half] / count[half],
                (sum[half] * sum[half] - squares[half]) / (count[half] * (count[half] - 1.0))};
        }
    }
    return result;
}

/// Luminance squared of a pixel that glares, else 0. One half of the batches says whether it does,
/// the other one how much: what is bright by chance in one is not in the other.
double DgpMeasurement::glaring_square(const Halves& halves, double least) {
    return 0.5 * ((halves[0].mean > least ? halves[1].square : 0.0) +
                  (halves[1].mean > least ? halves[0].square : 0.0));
}

double DgpMeasurement::illuminance(const Gaze& eye, const Picture& picture, std::size_t point,
                                   std::size_t without) const {
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < Fisheye::pixels; ++pixel) {
        // The mean cosine of a row is that of its middle.
        const std::size_t row = pixel / Fisheye::columns;
        const double z = 1.0 - (static_cast<double>(row) + 0.5) / Fisheye::rows;
        sum += picture.luminance[pixel] * z * Fisheye::solid_angle;
    }
    for (const Source& source : seen_[point]) {
        sum += cosine_ahead(eye, direction_of(source.seen, without)) *
               (without == all_batches ? source.seen.mean_illuminance()
                                       : source.seen.illuminance_without(without));
    }
    return sum;
}

/// cd/m².
double DgpMeasurement::threshold(const Gaze& eye, const Picture& picture, std::size_t point) const {
    double sum = std::accumulate(picture.luminance.begin(), picture.luminance.end(), 0.0) *
                 Fisheye::solid_angle;
    for (const Source& source : seen_[point]) {
        if (cosine_ahead(eye, source.seen.direction) > 0.0 && source.seen.has_size()) {
            sum += source.seen.mean_illuminance();
        }
    }
    return glaring_from * sum / (2.0 * std::numbers::pi);
}

double DgpMeasurement::dgp(const Gaze& eye, const Picture& picture, std::size_t point, double least,
                           std::size_t without) const {
    double glaring = 0.0;
    for (std::size_t pixel = 0; pixel < Fisheye::pixels; ++pixel) {
        const double square = glaring_square(picture.halves[pixel], least);
        if (square != 0.0) {
            const double p = position_index(eye, Fisheye::middle(eye, pixel));
            glaring += square * Fisheye::solid_angle / (p * p);
        }
    }
    for (const Source& source : seen_[point]) {
        const bool all = without == all_batches;
        const double e =
            all ? source.seen.mean_illuminance() : source.seen.illuminance_without(without);
        const double angle =
            all ? source.seen.mean_solid_angle() : source.seen.solid_angle_without(without);
        if (cosine_ahead(eye, source.seen.direction) > 0.0 && angle > 0.0 && e > least * angle) {
            const double p = position_index(eye, direction_of(source.seen, without));
            glaring += e * e / angle / (p * p);
        }
    }
    return dgp_of(illuminance(eye, picture, point, without), glaring);
}

GlareRating DgpMeasurement::rate(std::size_t point, std::size_t view) const {
    const Gaze& eye = gaze(point, view);
    const View& own = views_[point * views() + view];
    if (scene_->paths.air()) {
        return rating_in_air(eye.forward, "DGP");
    }
    GlareRating rating;
    rating.view = eye.forward;
    if (own.rounds == 0) {
        return rating;
    }
    const Picture whole = picture(own, all_batches);
    const double least = threshold(eye, whole, point);
    const double value = dgp(eye, whole, point, least, all_batches);
    double sum = 0.0;
    for (std::size_t b = 0; b < batches; ++b) {
        const double part = dgp(eye, picture(own, b), point, least, b);
        sum += (part - value) * (part - value);
    }
    rating.value.value = value;
    rating.error = std::sqrt(sum * (batches - 1) / batches);
    rating.state = GlareRating::State::rated;
    rating.background = illuminance(eye, whole, point, all_batches);
    for (const Source& source : seen_[point]) {
        const bool ahead = cosine_ahead(eye, source.seen.direction) > 0.0;
        rating.small += ahead && !source.seen.has_size() ? 1 : 0;
    }
    rating.words = words_for(rating);
    rating.ratios = ring_luminances(eye, whole, point);
    name_sources(eye, whole, point, least, rating);
    return rating;
}

/// Luminaires and suns by their names; bright pixels by what is seen there.
void DgpMeasurement::name_sources(const Gaze& eye, const Picture& picture, std::size_t point,
                                  double least, GlareRating& rating) const {
    std::vector<GlareShare> found;
    for (const Source& source : seen_[point]) {
        const double angle = source.seen.mean_solid_angle();
        const double e = source.seen.mean_illuminance();
        if (!(cosine_ahead(eye, source.seen.direction) > 0.0) || !source.seen.has_size() ||
            e <= least * angle) {
            continue;
        }
        const double p = position_index(eye, source.seen.direction);
        const double away = source.seen.distance > 0.0 ? source.seen.distance : 1.0;
        found.push_back({source.name, source.light,
                         points_[point].position + away * source.seen.direction,
                         e * e / angle / (p * p), e / angle, angle, p});
    }
    std::vector<std::pair<std::string, GlareShare>> areas;
    for (std::size_t pixel = 0; pixel < Fisheye::pixels; ++pixel) {
        if (!(picture.luminance[pixel] > least)) {
            continue;
        }
        const glm::dvec3 direction = Fisheye::middle(eye, pixel);
        const auto hit = scene_->rays.trace(places_[point], direction);
        const PatchMesh& mesh = scene_->rays.mesh();
        const std::string name =
            hit ? scene_->rays.scene()
                      .objects[mesh.vertex_object[mesh.triangles[hit->triangle].x]]
                      .name
                : "sky";
        auto area = std::find_if(areas.begin(), areas.end(),
                                 [&](const auto& entry) { return entry.first == name; });
        if (area == areas.end()) {
            area =
                areas.insert(areas.end(), {name, {name, 0, points_[point].position + direction}});
        }
        const double p = position_index(eye, direction);
        area->second.share +=
            glaring_square(picture.halves[pixel], least) * Fisheye::solid_angle / (p * p);
        area->second.luminance += picture.luminance[pixel] * Fisheye::solid_angle;
        area->second.solid_angle += Fisheye::solid_angle;
        area->second.position_index = p;
    }
    for (auto& [name, area] : areas) {
        area.luminance /= area.solid_angle;
        found.push_back(area);
    }
    rating.sources = static_cast<std::uint32_t>(found.size());
    std::stable_sort(found.begin(), found.end(),
                     [](const GlareShare& a, const GlareShare& b) { return a.share > b.share; });
    double whole = 0.0;
    for (const GlareShare& share : found) {
        whole += share.share;
    }
    found.resize(std::min(found.size(), GlareRating::most_sources));
    for (GlareShare& share : found) {
        share.share = whole > 0.0 ? share.share / whole : 0.0;
    }
    rating.shares = std::move(found);
}

std::vector<GlareRating> DgpMeasurement::glare() const {
    std::vector<GlareRating> result(points_.size());
    for (std::size_t point = 0; point < points_.size(); ++point) {
        std::vector<GlareRating> ratings;
        for (std::size_t view = 0; view < views() && !inside(point); ++view) {
            ratings.push_back(rate(point, view));
        }
        if (!ratings.empty()) {
            result[point] = worst_of(std::move(ratings));
        }
    }
    return result;
}

std::vector<Interval> DgpMeasurement::values() const {
    std::vector<Interval> result;
    for (const GlareRating& rating : glare()) {
        result.push_back(rating.value);
    }
    return result;
}

std::optional<MeasurementSummary> DgpMeasurement::all() const {
    const std::vector<GlareRating> ratings = glare();
    const auto range = range_of(ratings);
    return range ? std::optional(
                       MeasurementSummary{range->mean, range->minimum, range->maximum, {}, {}})
                 : std::nullopt;
}

double DgpMeasurement::relative_error() const {
    if (rounds() < pass) {
        return std::numeric_limits<double>::infinity();
    }
    double widest = 0.0;
    for (const GlareRating& rating : glare()) {
        const double value = rating.value.value;
        widest = std::max(widest,
                          value > 0.0 ? 0.5 * (rating.value.high - rating.value.low) / value : 0.0);
    }
    return widest;
}

}  // namespace raybundle
