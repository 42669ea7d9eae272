// SPDX-License-Identifier: Apache-2.0
#include "solution/air/scattered_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <numeric>

#include "solution/geometry/patch_growth.h"

namespace raybundle {
namespace {

constexpr double division_share = 1.2;  // cells are divided from the root of all paths on, times
constexpr std::uint32_t chunk_size = 256;
constexpr double to_the_sky = std::numeric_limits<double>::infinity();

/// About z, by the cosine.
glm::vec3 direction_by_cosine(const glm::vec3& z, AirRandom& random) {
    const glm::vec3 helper = std::abs(z.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 x = glm::normalize(glm::cross(helper, z));
    const auto square = static_cast<float>(random.next());
    const auto turn = static_cast<float>(glm::two_pi<double>() * random.next());
    const float radius = std::sqrt(square);
    return glm::normalize(radius * (std::cos(turn) * x + std::sin(turn) * glm::cross(z, x)) +
                          std::sqrt(1.0F - square) * z);
}

}  // namespace

ScatteredLight::ScatteredLight(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                               const PatchCells& cells, std::uint64_t seed)
    : scene_(scene),
      gpu_scene_(gpu_scene),
      cells_(cells),
      surfaces_(scene, mesh, places(), gpu_scene.diameter()),
      reflected_(mesh.patch_count(), glm::vec3(0.0F)),
      lamp_sums_(mesh.patch_count(), glm::dvec3(0.0)),
      surface_sums_(lamp_sums_),
      counts_(mesh.patch_count(), 0),
      seed_(seed),
      flux_(mesh.patch_count(), glm::vec3(0.0F)) {}

std::vector<glm::mat4> ScatteredLight::places() const {
    std::vector<glm::mat4> places;
    for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
        places.push_back(gpu_scene_.world_from_object(i, Place::now));
    }
    return places;
}

AirPaths ScatteredLight::paths() const {
    return AirPaths(
        {scene_, *gpu_scene_.medium(), gpu_scene_.air_box(), surfaces_, *lights_, reflected_});
}

void ScatteredLight::restart(std::span<const glm::vec3> emission) {
    surfaces_.place(places(), gpu_scene_.diameter());
    std::vector<PlacedLight> punctual;
    for (std::size_t i = 0; i < gpu_scene_.punctual_lights().size(); ++i) {
        punctual.push_back(gpu_scene_.placed_light(i));
    }
    lights_.emplace(surfaces_, emission, std::move(punctual), gpu_scene_.diameter());
    side_areas_.clear();
    areas_.assign(reflected_.size(), 0.0F);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < surfaces_.side_count(); ++i) {
        const float area = surfaces_.side(i).area;
        areas_[surfaces_.patch_of(i)] += area;
        sum += static_cast<double>(area);
        side_areas_.push_back(sum);
    }
    lamp_sums_.assign(lamp_sums_.size(), glm::dvec3(0.0));
    surface_sums_ = lamp_sums_;
    counts_.assign(counts_.size(), 0);
    surface_weights_ = 0.0;
    paths_ = 0;
    batches_ = 0;
    ++changes_;
    scale(glm::vec3(1.0F));
    trace(first_paths);
}

void ScatteredLight::adopt(const ScatteredLight& other, const PatchGrowth& growth) {
    reflected_ = growth.grown(other.reflected_, glm::vec3(0.0F));
    reflected_flux_ = other.reflected_flux_;
    lamp_sums_ = growth.grown(other.lamp_sums_, glm::dvec3(0.0));
    surface_sums_ = growth.grown(other.surface_sums_, glm::dvec3(0.0));
    counts_ = growth.grown(other.counts_, 0U);
    flux_ = growth.grown(other.flux_, glm::vec3(0.0F));
    surface_weights_ = other.surface_weights_;
    paths_ = other.paths_;
    batches_ = other.batches_;
}

void ScatteredLight::set_radiance(std::span<const glm::vec3> sent,
                                  std::span<const glm::vec3> emission) {
    for (std::size_t i = 0; i < reflected_.size(); ++i) {
        reflected_[i] = glm::max(sent[i] - emission[i], 0.0F);
    }
    scale(glm::vec3(1.0F));
}

void ScatteredLight::scale(const glm::vec3& factor) {
    reflected_flux_ = glm::dvec3(0.0);
    for (std::size_t i = 0; i < reflected_.size(); ++i) {
        reflected_[i] *= factor;
        reflected_flux_ +=
            glm::dvec3(areas_.empty() ? 0.0F : areas_[i]) * glm::dvec3(reflected_[i]);
    }
}

/// Evenly over the sides. place: in [0, 1).
ScatteredLight::Sample ScatteredLight::sample(const AirPaths& air, std::uint64_t number,
                                              double place) const {
    AirRandom random(seed_ + changes_, number);
    const double area = side_areas_.back();
    const auto found = std::upper_bound(side_areas_.begin(), side_areas_.end(), place * area);
    const auto side = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(
        found - side_areas_.begin(), static_cast<std::ptrdiff_t>(side_areas_.size()) - 1));
    const AirScene::Side at = surfaces_.side(side);
    const auto root = static_cast<float>(std::sqrt(random.next()));
    const float along = root * static_cast<float>(random.next());
    const glm::vec3 origin =
        at.a + (root - along) * at.e1 + along * at.e2 + surfaces_.lift() * at.normal;
    const glm::vec3 direction = direction_by_cosine(at.normal, random);
    const std::optional<AirScene::Hit> hit = surfaces_.meet(origin, direction, random);
    const AirEstimate light =
        air.along(origin, direction, hit ? static_cast<double>(hit->distance) : to_the_sky, random);
    const double share = glm::pi<double>() * area;
    return {surfaces_.patch_of(side), glm::vec3(share * light.lamps),
            glm::vec3(share * light.surfaces)};
}

void ScatteredLight::trace(std::uint32_t count) {
    if (side_areas_.empty() || !(side_areas_.back() > 0.0)) {
        return;
    }
    std::vector<Sample> samples(count);
    const std::uint32_t chunks = (count + chunk_size - 1) / chunk_size;
    // Places of successive batches are between each other.
    AirRandom shift(~seed_, batches_);
    const double first = shift.next();
    const AirPaths air = paths();
    tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t chunk) {
        const std::uint32_t end = std::min((chunk + 1) * chunk_size, count);
        for (std::uint32_t i = chunk * chunk_size; i < end; ++i) {
            samples[i] = sample(air, paths_ + i, (i + first) / count);
        }
    });
    const double weight = static_cast<double>(++batches_) * count;
    for (const Sample& s : samples) {
        lamp_sums_[s.patch] += glm::dvec3(s.lamps);
        surface_sums_[s.patch] += static_cast<double>(batches_) * glm::dvec3(s.surfaces) /
                                  glm::max(reflected_flux_, glm::dvec3(1e-300));
        ++counts_[s.patch];
    }
    paths_ += count;
    if (reflected_flux_ != glm::dvec3(0.0)) {
        surface_weights_ += weight;
    }
    const auto least =
        static_cast<std::uint64_t>(division_share * std::sqrt(static_cast<double>(paths_))) + 1;
    std::vector<glm::dvec3> sums(lamp_sums_.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = lamp_sums_[i] / static_cast<double>(paths_);
        if (surface_weights_ > 0.0) {
            sums[i] += surface_sums_[i] * reflected_flux_ / surface_weights_;
        }
    }
    flux_ = cells_.spread(sums, counts_, least);
}

std::size_t ScatteredLight::bytes() const {
    return surfaces_.bytes() +
           flux_.size() * (2 * sizeof(glm::dvec3) + 2 * sizeof(glm::vec3) + sizeof(std::uint32_t));
}

}  // namespace raybundle
