// SPDX-License-Identifier: Apache-2.0
#include "zones/first_reflection.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "zones/zone_levels.h"

namespace raybundle {

namespace {

constexpr int most_reflections = 64;
constexpr double least_change = 1e-3;  // of all light, by one more reflection
constexpr double many_rays = 16.0;     // so many of equal weight tell an area to a quarter

/// Of each patch: clusters that reach into several zones are divided by them.
std::vector<std::uint32_t> cells_of(const ZonePartition& partition) {
    constexpr std::uint32_t none = ~0U;
    std::vector<std::uint32_t> number(std::size_t{partition.clusters} * partition.count, none);
    std::vector<std::uint32_t> result;
    std::uint32_t cells = 0;
    for (std::size_t i = 0; i < partition.zone.size(); ++i) {
        std::uint32_t& own =
            number[std::size_t{partition.cluster[i]} * partition.count + partition.zone[i]];
        own = own == none ? cells++ : own;
        result.push_back(own);
    }
    return result;
}

std::size_t number_of(const std::vector<std::uint32_t>& cell) {
    return cell.empty() ? 0 : *std::max_element(cell.begin(), cell.end()) + std::size_t{1};
}

}  // namespace

/// A ray from either patch to the other tells what both exchange, and its area follows from the
/// densities of both (balance heuristic): rays that meet a lamp by chance are noisy, those from it
/// are not.
FirstReflection::FirstReflection(const ZonePartition& partition, std::span<const ExchangeRay> rays,
                                 std::span<const glm::vec3> base_colour,
                                 std::span<const float> areas,
                                 std::span<const double> rays_per_area)
    : base_colour_(base_colour.begin(), base_colour.end()),
      cell_(cells_of(partition)),
      cell_areas_(number_of(cell_), 0.0),
      sky_(cell_areas_.size(), glm::dvec3(0.0)) {
    for (std::size_t i = 0; i < areas.size(); ++i) {
        cell_areas_[cell_[i]] += static_cast<double>(areas[i]);
    }
    for (const ExchangeRay& ray : rays) {
        if (ray.to == ExchangeRay::lost) {
            sky_[cell_[ray.from]] +=
                glm::pi<double>() * static_cast<double>(ray.area) * glm::dvec3(ray.sky);
        } else if (ray.area > 0.0F) {
            const double density = 1.0 / static_cast<double>(ray.area) + rays_per_area[ray.to];
            lines_.push_back({ray.from, ray.to, 1.0 / density});
            matters_ = matters_ || glm::dot(base_colour[ray.from], base_colour[ray.to]) > 0.0F;
        }
    }
    bound_exchange();
}

/// A cell that few rays meet may seem to receive more than its area can. Two such cells that see
/// each other would send light to and fro without an end, so that their areas are those of their
/// rays where these are larger. Of cells with many rays the excess is small and chance: to bound it
/// would darken all.
void FirstReflection::bound_exchange() {
    std::vector<double> seen(cell_areas_.size(), 0.0);
    std::vector<double> squares(cell_areas_.size(), 0.0);
    for (const Line& line : lines_) {
        for (const std::uint32_t patch : {line.from, line.to}) {
            seen[cell_[patch]] += line.area;
            squares[cell_[patch]] += line.area * line.area;
        }
    }
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
        if (seen[cell] * seen[cell] < many_rays * squares[cell]) {
            cell_areas_[cell] = std::max(cell_areas_[cell], seen[cell]);
        }
    }
}

void FirstReflection::make_fluxes_irradiance(std::vector<glm::dvec3>& flux) const {
    for (std::size_t cell = 0; cell < flux.size(); ++cell) {
        flux[cell] = cell_areas_[cell] > 0.0 ? flux[cell] / cell_areas_[cell] : glm::dvec3(0.0);
    }
}

/// Irradiance of the cells by what emits, and by the sky.
std::vector<glm::dvec3> FirstReflection::direct(std::span<const glm::vec4> emitted,
                                                double radiance_unit) const {
    std::vector<glm::dvec3> result = sky_;
    for (glm::dvec3& flux : result) {
        flux /= radiance_unit;
    }
    for (const Line& line : lines_) {
        result[cell_[line.to]] += line.area * glm::dvec3(glm::vec3(emitted[line.from]));
        result[cell_[line.from]] += line.area * glm::dvec3(glm::vec3(emitted[line.to]));
    }
    make_fluxes_irradiance(result);
    return result;
}

/// Irradiance of the cells by what they reflect of theirs.
std::vector<glm::dvec3> FirstReflection::reflected_once(
    std::span<const glm::dvec3> irradiance) const {
    std::vector<glm::dvec3> result(irradiance.size(), glm::dvec3(0.0));
    for (const Line& line : lines_) {
        const std::uint32_t a = cell_[line.from];
        const std::uint32_t b = cell_[line.to];
        result[b] += line.area * glm::dvec3(base_colour_[line.from]) * irradiance[a];
        result[a] += line.area * glm::dvec3(base_colour_[line.to]) * irradiance[b];
    }
    make_fluxes_irradiance(result);
    return result;
}

/// Luminance, radiance units m².
double FirstReflection::flux_of(std::span<const glm::dvec3> irradiance) const {
    double sum = 0.0;
    for (std::size_t cell = 0; cell < irradiance.size(); ++cell) {
        sum += cell_areas_[cell] * luminance_of(irradiance[cell]);
    }
    return sum;
}

/// Reflection by reflection (Neumann's series), until one more changes next to nothing. Whatever is
/// left then belongs to its slowest mode, a geometric series.
std::vector<glm::vec4> FirstReflection::irradiance(std::span<const glm::vec4> emitted,
                                                   double radiance_unit) const {
    std::vector<glm::vec4> result(emitted.size(), glm::vec4(0.0F));
    if (cell_areas_.empty()) {
        return result;
    }
    std::vector<glm::dvec3> last = direct(emitted, radiance_unit);
    std::vector<glm::dvec3> sum(last.size(), glm::dvec3(0.0));
    double light = flux_of(last);
    double before = light;
    for (int i = 0; i < most_reflections; ++i) {
        last = reflected_once(last);
        const double more = flux_of(last);
        light += more;
        const bool ends = i + 1 == most_reflections || more <= least_change * light;
        const double others = ends && before > more ? more / (before - more) : 0.0;
        for (std::size_t cell = 0; cell < sum.size(); ++cell) {
            sum[cell] += (1.0 + others) * last[cell];
        }
        if (ends) {
            break;
        }
        before = more;
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = glm::vec4(sum[cell_[i]], 0.0);
    }
    return result;
}

}  // namespace raybundle
