// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/glare_sources.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "reference/sampling/directions.h"
#include "reference/sampling/pane_shares.h"
#include "scene/disjoint_sets.h"
#include "scene/edit/light_edit.h"

namespace raybundle {
namespace {

constexpr std::size_t batches = SeenSource::batches;

/// Numbers the emitting sides that touch each other alike: those of a material that share the
/// place of a vertex.
class Groups {
  public:
    explicit Groups(const PatchMesh& mesh) : mesh_(mesh), sets_(mesh.side_count()) {}

    void add(std::uint32_t side) {
        const std::uint32_t triangle = mesh_.side_triangle[side];
        const glm::uvec3& t = mesh_.triangles[triangle];
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh_.positions[t[k]];
            const std::array<std::uint32_t, 5> key = {
                mesh_.vertex_object[t[k]], mesh_.triangle_material[triangle],
                std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                std::bit_cast<std::uint32_t>(p.z)};
            const auto [found, fresh] = places_.try_emplace(key, side);
            if (!fresh) {
                sets_.join(side, found->second);
            }
        }
    }
    std::uint32_t group_of(std::uint32_t side) { return sets_.find(side); }

  private:
    const PatchMesh& mesh_;
    DisjointSets sets_;
    std::map<std::array<std::uint32_t, 5>, std::uint32_t> places_;
};

/// The light that a material is, by its number, and its name.
std::pair<std::uint32_t, std::string> light_of(const Scene& scene, std::uint32_t material) {
    for (const Light& light : scene.lights) {
        if (light.material == static_cast<int>(material)) {
            return {light.id, light.name};
        }
    }
    return {0, scene.materials[material].name};
}

void find_emitters(const RayScene& rays, std::vector<GlareSource>& sources) {
    const PatchMesh& mesh = rays.mesh();
    std::vector<std::uint32_t> emitting;
    Groups groups(mesh);
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        if (luminance(mesh.emission[side]) > 0.0F && rays.patch_area(side) > 0.0) {
            emitting.push_back(side);
            groups.add(side);
        }
    }
    std::map<std::uint32_t, std::size_t> source_of;
    for (const std::uint32_t side : emitting) {
        const auto [found, fresh] = source_of.try_emplace(groups.group_of(side), sources.size());
        if (fresh) {
            const std::uint32_t triangle = mesh.side_triangle[side];
            const Object& object =
                rays.scene().objects[mesh.vertex_object[mesh.triangles[triangle].x]];
            GlareSource source;
            std::tie(source.light, source.name) =
                light_of(rays.scene(), mesh.triangle_material[triangle]);
            if (!object.name.empty() && object.name != source.name) {
                source.name += source.name.empty() ? object.name : " (" + object.name + ")";
            }
            sources.push_back(std::move(source));
        }
        GlareSource& source = sources[found->second];
        const double before = source.area_up_to.empty() ? 0.0 : source.area_up_to.back();
        const double area = rays.patch_area(side);
        source.sides.push_back(side);
        source.area_up_to.push_back(before + area);
        source.middle += area * rays.point_on_patch(side, glm::dvec2(1.0 / 3.0)).position;
    }
    for (GlareSource& source : sources) {
        source.middle /= source.area_up_to.back();
    }
}

void find_lamps(const RayScene& rays, std::vector<GlareSource>& sources) {
    const Scene& scene = rays.scene();
    for (std::size_t i = 0; i < scene.punctual_lights.size(); ++i) {
        const PlacedLight placed = place_light(scene, scene.punctual_lights[i]);
        if (placed.kind == PunctualKind::directional || placed.intensity == glm::dvec3(0.0)) {
            continue;
        }
        GlareSource source;
        source.name = scene.punctual_lights[i].name;
        source.light = punctual_number(scene, i);
        source.middle = rays.from_world(placed.position);
        source.lamp = placed;
        sources.push_back(std::move(source));
    }
}

/// Sums of the samples of a source that is seen from a place.
class Look {
  public:
    Look(const MeasuredScene& scene, const GlareSource& source, const glm::dvec3& position)
        : rays_(scene.rays), source_(source), position_(position) {
        const glm::dvec3 offset = source.middle - position;
        square_ = glm::dot(offset, offset);
        if (source.lamp && square_ > 0.0) {
            const glm::dvec3 towards_eye = -offset / std::sqrt(square_);
            const double metres = rays_.square_metres();
            brought_ = source.lamp->towards(towards_eye) / (square_ * metres);
            const auto& profile = source.lamp->profile;
            area_ = profile
                        ? profile->data().opening.projected_area(towards_eye * source.lamp->axes)
                        : 0.0;
        }
    }

    [[nodiscard]] bool useless() const {
        return !(square_ > 0.0) || (source_.lamp && brought_ == glm::dvec3(0.0));
    }

    void add(std::size_t batch, Sampler& sampler) {
        source_.lamp ? add_lamp(batch, sampler) : add_emitter(batch, sampler);
    }

    /// each: samples in a batch.
    [[nodiscard]] SeenSource result(double each) const {
        SeenSource seen;
        for (std::size_t b = 0; b < batches; ++b) {
            seen.solid_angle[b] = solid_angle_[b] / each;
            seen.illuminance[b] = illuminance_[b] / each;
            seen.weighted[b] = glm::vec3(weighted_[b]);
        }
        seen.area = seen_area_ / (each * batches);
        seen.distance = std::sqrt(square_ * rays_.square_metres());
        seen.direction = glm::normalize(source_.middle - position_);
        seen.direction = seen.direction_without(batches);
        return seen;
    }

  private:
    void add_emitter(std::size_t batch, Sampler& sampler) {
        const double whole = source_.area_up_to.back();
        const double at = whole * sampler.next();
        const auto found =
            std::upper_bound(source_.area_up_to.begin(), source_.area_up_to.end() - 1, at);
        const auto index = static_cast<std::size_t>(found - source_.area_up_to.begin());
        const SurfacePoint point =
            rays_.point_on_patch(source_.sides[index], uniform_triangle(sampler.next_pair()));
        const glm::dvec3 offset = point.position - position_;
        const double square = glm::dot(offset, offset);
        const double facing = -glm::dot(offset, point.normal);
        if (!(facing > 0.0)) {
            return;
        }
        const glm::dvec3 radiance = rays_.emission(point);
        const glm::dvec3 share = share_through_panes(rays_, position_, rays_.departure(point));
        const double shown = luminance(glm::vec3(radiance * share));
        if (shown > 0.0) {
            const double projected = whole * facing / std::sqrt(square);
            note(batch, offset, projected / square, shown * projected / square,
                 projected * rays_.square_metres());
        }
    }

    /// By a point of its opening.
    void add_lamp(std::size_t batch, Sampler& sampler) {
        const glm::dvec3 share = share_through_panes(
            rays_, position_, rays_.from_world(source_.lamp->point(sampler.next_pair())));
        const double light = luminance(glm::vec3(brought_ * share));
        if (light > 0.0) {
            const double square = square_ * rays_.square_metres();
            note(batch, source_.middle - position_, area_ / square, light, area_);
        }
    }

    void note(std::size_t batch, const glm::dvec3& offset, double solid_angle, double illuminance,
              double area) {
        solid_angle_[batch] += solid_angle;
        illuminance_[batch] += illuminance;
        seen_area_ += area;
        weighted_[batch] +=
            (solid_angle > 0.0 ? solid_angle : illuminance) * glm::normalize(offset);
    }

    const RayScene& rays_;
    const GlareSource& source_;
    glm::dvec3 position_;
    double square_ = 0.0;      // of the distance, own space
    glm::dvec3 brought_{0.0};  // of a lamp, illuminance of what faces it
    double area_ = 0.0;        // of a lamp, projected, m²
    std::array<double, batches> solid_angle_{}, illuminance_{};
    double seen_area_ = 0.0;
    std::array<glm::dvec3, batches> weighted_{};
};

double mean_of(const std::array<double, batches>& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) / batches;
}

double mean_without(const std::array<double, batches>& numbers, std::size_t batch) {
    return (mean_of(numbers) * batches - numbers[batch]) / (batches - 1);
}

/// L² omega, which is E² / omega; of a source without size E².
double glaring(double illuminance, double solid_angle) {
    return illuminance * illuminance / (solid_angle > 0.0 ? solid_angle : 1.0);
}

/// Relative standard error, by the jackknife.
double error_of(const SeenSource& seen) {
    const double whole = glaring(seen.mean_illuminance(), seen.mean_solid_angle());
    double sum = 0.0;
    for (std::size_t b = 0; b < batches; ++b) {
        const double part = glaring(seen.illuminance_without(b), seen.solid_angle_without(b));
        sum += (part - whole) * (part - whole);
    }
    return std::sqrt(sum * (batches - 1) / batches) / whole;
}

}  // namespace

double SeenSource::mean_solid_angle() const {
    return mean_of(solid_angle);
}
double SeenSource::mean_illuminance() const {
    return mean_of(illuminance);
}
double SeenSource::solid_angle_without(std::size_t batch) const {
    return mean_without(solid_angle, batch);
}
double SeenSource::illuminance_without(std::size_t batch) const {
    return mean_without(illuminance, batch);
}

glm::dvec3 SeenSource::direction_without(std::size_t batch) const {
    glm::dvec3 sum(0.0);
    for (std::size_t b = 0; b < batches; ++b) {
        sum += b == batch ? glm::dvec3(0.0) : glm::dvec3(weighted[b]);
    }
    return glm::length(sum) > 0.0 ? glm::normalize(sum) : direction;
}

std::vector<GlareSource> find_glare_sources(const MeasuredScene& scene) {
    std::vector<GlareSource> sources;
    find_emitters(scene.rays, sources);
    find_lamps(scene.rays, sources);
    return sources;
}

std::optional<SeenSource> look_at(const MeasuredScene& scene, const GlareSource& source,
                                  const glm::dvec3& position, std::uint64_t seed) {
    constexpr std::size_t first = 4;  // samples in a batch
    constexpr std::size_t most = 64;
    constexpr double good = 0.02;
    Look look(scene, source, position);
    if (look.useless()) {
        return std::nullopt;
    }
    for (std::size_t done = 0, wanted = first;; wanted *= 2) {
        for (; done < wanted; ++done) {
            for (std::size_t b = 0; b < batches; ++b) {
                PixelSampler sampler(seed, 0, static_cast<std::uint32_t>(b),
                                     static_cast<std::uint32_t>(done));
                look.add(b, sampler);
            }
        }
        SeenSource seen = look.result(static_cast<double>(done));
        if (!(seen.mean_illuminance() > 0.0)) {
            return std::nullopt;
        }
        if (wanted == most || error_of(seen) <= good) {
            return seen;
        }
    }
}

}  // namespace raybundle
