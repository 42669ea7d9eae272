// SPDX-License-Identifier: Apache-2.0
#include "solution/store/zone_balance.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <numeric>
#include <utility>

#include "scene/mesh/patch_means.h"
#include "solution/store/shooting_shares.h"

namespace raybundle {

namespace {

constexpr std::size_t vectors_per_zone = 3;     // of FluxSums
constexpr std::size_t vectors_per_segment = 2;  // reflected and emitted

}  // namespace

ZoneBalance::ZoneBalance(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                         std::uint64_t seed)
    : scene_(scene),
      gpu_scene_(gpu_scene),
      patch_count_(gpu_scene.patch_count()),
      rays_(scene, mesh, present_places(), gpu_scene.diameter(), seed),
      base_colour_(patch_means(mesh, mesh.base_colour)),
      levels_(1),
      zones_buffer_("zones", max_zones * sizeof(layout::ZoneLevelData) +
                                 std::size_t{patch_count_} * sizeof(std::uint32_t)),
      flux_({"solution_zone_flux.comp"}, gpu_scene.defines()),
      flux_sum_({"solution_zone_flux_sum.comp"}),
      exchange_({"solution_zone_exchange.comp"}, gpu_scene.defines()),
      means_({"solution_zone_means.comp"}),
      emitted_({"solution_emitted.comp"}, gpu_scene.defines()) {
    static_assert(max_zones == MAX_ZONES);
}

std::vector<glm::mat4> ZoneBalance::present_places() const {
    std::vector<glm::mat4> places;
    for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
        places.push_back(gpu_scene_.world_from_object(i, Place::now));
    }
    return places;
}

void ZoneBalance::surfaces_changed(const PatchMesh& mesh) {
    base_colour_ = patch_means(mesh, mesh.base_colour);
    const bool other_rays = rays_.choose_densities(mesh);
    stale_ = std::max(stale_, other_rays ? Stale::rays : Stale::light);
}

void ZoneBalance::interrupt() {
    levels_.forget();
    kept_.begin();
    group_weight_ = 0.0;
    older_share_.assign(older_share_.size(), 1.0);
}

void ZoneBalance::refresh() {
    if (stale_ == Stale::nothing) {
        return;
    }
    if (stale_ == Stale::places) {
        rays_.place(present_places(), gpu_scene_.diameter());
    }
    if (stale_ >= Stale::rays || !started_) {  // FirstReflection wants them, too
        find_rays();
    } else {
        for (ExchangeRay& ray : lost_) {
            rays_.look_up_sky(ray);
        }
    }
    stale_ = Stale::nothing;
    find_light();
}

SkyOpenings ZoneBalance::find_openings() {
    refresh();
    return find_sky_openings(rays_, partition_, lost_, sent_, MOST_OPENINGS);
}

float ZoneBalance::sky_share(std::span<const double> areas) const {
    const auto unit = static_cast<double>(gpu_scene_.radiance_unit());
    const auto luminance_of = [](const glm::dvec3& flux) {
        return static_cast<double>(luminance(glm::vec3(flux)));
    };
    double squares = 0.0;
    double area = 0.0;
    for (std::size_t zone = 0; zone < std::min<std::size_t>(areas.size(), sky_.size()); ++zone) {
        const double all = luminance_of(levels_.incident()[zone]);
        if (all > 0.0) {
            const double share = std::min(luminance_of(sky_[zone].flux / unit) / all, 1.0);
            squares += areas[zone] * share * share;
            area += areas[zone];
        }
    }
    return area > 0.0 ? static_cast<float>(std::sqrt(squares / area)) : 1.0F;
}

void ZoneBalance::find_rays() {
    std::vector<ExchangeRay> traced = rays_.trace();
    partition_ = find_zones(rays_, traced);
    lost_.clear();
    std::copy_if(traced.begin(), traced.end(), std::back_inserter(lost_),
                 [](const ExchangeRay& ray) { return ray.to == ExchangeRay::lost; });
    reflection_ = started_ ? FirstReflection()  // of a start that is over
                           : FirstReflection(partition_, traced, base_colour_, rays_.areas(),
                                             rays_.rays_per_area());
    sent_.assign(partition_.clusters, 0.0);
    for (const ExchangeRay& ray : traced) {
        sent_[partition_.cluster[ray.from]] += static_cast<double>(ray.area);
    }
    sort_patches();
    sort_rays(std::move(traced));
    sums_ = Buffer("zone sums",
                   (2 * max_zones * vectors_per_zone + segments_.size() * vectors_per_segment) *
                       sizeof(glm::vec4));
    readback_ = std::make_unique<Readback>("zone sums", sums_.bytes());
}

/// What the zones reflect, and get of the sky; their levels are not known.
void ZoneBalance::find_light() {
    levels_ = ZoneLevels(partition_.count);
    older_share_.assign(partition_.count, 1.0);
    younger_.assign(partition_.count, 0.0);
    shooting_.clear();
    mean_albedo_.assign(partition_.count, glm::dvec3(0.0));
    std::vector<double> area(partition_.count, 1e-30);
    sky_.assign(partition_.count, ZoneSky{});
    for (std::uint32_t i = 0; i < patch_count_; ++i) {
        const auto own = static_cast<double>(rays_.areas()[i]);
        mean_albedo_[partition_.zone[i]] += own * glm::dvec3(base_colour_[i]);
        area[partition_.zone[i]] += own;
    }
    for (unsigned zone = 0; zone < partition_.count; ++zone) {
        mean_albedo_[zone] /= area[zone];
    }
    for (const ExchangeRay& ray : lost_) {
        const glm::dvec3 flux =
            glm::pi<double>() * static_cast<double>(ray.area) * glm::dvec3(ray.sky);
        ZoneSky& sky = sky_[partition_.zone[ray.from]];
        const auto l = static_cast<double>(luminance(glm::vec3(flux)));
        sky.flux += flux;
        sky.squares += l * l;
    }
}

/// Lists the patches of each zone, in blocks of which each is of one zone.
void ZoneBalance::sort_patches() {
    zones_buffer_.write<std::uint32_t>(partition_.zone, max_zones * sizeof(layout::ZoneLevelData));
    std::vector<std::uint32_t> order;
    first_block_.assign(1, 0);
    std::vector<std::vector<std::uint32_t>> patches(partition_.count);
    for (std::uint32_t i = 0; i < patch_count_; ++i) {
        patches[partition_.zone[i]].push_back(i);
    }
    for (const std::vector<std::uint32_t>& zone : patches) {
        order.insert(order.end(), zone.begin(), zone.end());
        order.resize((order.size() + POWER_BLOCK - 1) / POWER_BLOCK * POWER_BLOCK, NO_PATCH);
        first_block_.push_back(static_cast<std::uint32_t>(order.size() / POWER_BLOCK));
    }
    order_ = Buffer::from<std::uint32_t>("patches by zone", order);
    blocks_ = Buffer::from<std::uint32_t>("first blocks of zones", first_block_);
    block_sums_ = Buffer("fluxes of blocks",
                         std::max<std::size_t>(first_block_.back(), 1) * sizeof(layout::FluxSums));
}

void ZoneBalance::sort_rays(std::vector<ExchangeRay> traced) {
    const auto key = [this](const ExchangeRay& ray) {
        const unsigned to =
            ray.to == ExchangeRay::lost ? partition_.count : partition_.zone[ray.to];
        return partition_.zone[ray.from] * (max_zones + 1) + to;
    };
    std::stable_sort(traced.begin(), traced.end(),
                     [&](const ExchangeRay& a, const ExchangeRay& b) { return key(a) < key(b); });
    std::vector<layout::ZoneRay> rays;
    std::vector<std::uint32_t> bounds;
    segments_.clear();
    for (const ExchangeRay& ray : traced) {
        const auto at = static_cast<std::uint32_t>(rays.size());
        const unsigned from = key(ray) / (max_zones + 1);
        const unsigned to = key(ray) % (max_zones + 1);
        if (segments_.empty() || segments_.back().from != from || segments_.back().to != to) {
            segments_.push_back({from, to, at, at});
            bounds.push_back(at);
        }
        segments_.back().end = at + 1;
        rays.push_back({ray.from, ray.area});
    }
    bounds.push_back(static_cast<std::uint32_t>(rays.size()));
    ray_buffer_ = Buffer::from<layout::ZoneRay>("rays between zones", rays);
    segment_buffer_ = Buffer::from<std::uint32_t>("first rays of zone pairs", bounds);
}

std::vector<ZoneFlux> ZoneBalance::read_fluxes(std::span<const glm::vec4> sums) const {
    std::vector<ZoneFlux> zones(partition_.count);
    for (unsigned zone = 0; zone < partition_.count; ++zone) {
        const glm::vec4* s = &sums[zone * vectors_per_zone];
        zones[zone].incident = glm::dvec3(glm::vec3(s[0]));
        zones[zone].reflected = glm::dvec3(glm::vec3(s[1]));
        zones[zone].emitted = glm::dvec3(glm::vec3(s[2]));
        zones[zone].area = static_cast<double>(s[2].w);
        zones[zone].albedo = mean_albedo_[zone];
        zones[zone].loose = partition_.loose == zone;
    }
    return zones;
}

std::vector<ZoneExchange> ZoneBalance::read_exchange(std::span<const glm::vec4> sums) const {
    std::vector<ZoneExchange> exchange(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const glm::vec4* s = &sums[i * vectors_per_segment];
        exchange[i].from = segments_[i].from;
        exchange[i].to = segments_[i].to;
        exchange[i].reflected = glm::dvec3(glm::vec3(s[0]));
        exchange[i].emitted = glm::dvec3(glm::vec3(s[1]));
        exchange[i].squares = static_cast<double>(s[0].w);
        exchange[i].rays = static_cast<double>(segments_[i].end - segments_[i].first);
    }
    return exchange;
}

namespace {

double step_at(double iterate_age) {
    return std::pow(std::max(iterate_age, 0.0) + 1.0, -static_cast<double>(ITERATE_EXPONENT));
}

}  // namespace

void ZoneBalance::note_step(float iterate_age, float weight) {
    started_ = true;
    group_weight_ += static_cast<double>(weight);
    const auto age = static_cast<double>(iterate_age);
    for (std::size_t zone = 0; zone < older_share_.size(); ++zone) {
        older_share_[zone] *= 1.0 - step_at(age - younger_[zone]);
    }
}

void ZoneBalance::forget_step(float iterate_age, float weight) {
    group_weight_ -= static_cast<double>(weight);
    const auto age = static_cast<double>(iterate_age);
    for (std::size_t zone = 0; zone < older_share_.size(); ++zone) {
        const double rest = 1.0 - step_at(age - younger_[zone]);
        older_share_[zone] = rest > 0.0 ? older_share_[zone] / rest : 1.0;
    }
}

/// Sums what has been summed over the blocks of zones.
void ZoneBalance::sum_by_zones(std::size_t first_sum) {
    sums_.bind_storage(BINDING_ZONE_SUMS);
    blocks_.bind_storage(BINDING_ZONE_ORDER);
    flux_sum_.set("first_sum", static_cast<unsigned>(first_sum));
    flux_sum_.dispatch_groups(partition_.count, 1);
}

void ZoneBalance::balance(const Means& means) {
    refresh();
    if (!started_) {  // the first bundles come from what emits, and are noisier otherwise
        keep();
        return;
    }
    constexpr std::size_t first_mean = max_zones * vectors_per_zone;
    constexpr std::size_t first_pair = 2 * first_mean;
    block_sums_.bind_storage(BINDING_FLUX);
    order_.bind_storage(BINDING_ZONE_ORDER);
    flux_.dispatch_groups(first_block_.back(), 1);
    sum_by_zones(0);
    if (means.kept != nullptr) {
        means.kept->bind_storage(BINDING_KEPT);
        means.since->bind_storage(BINDING_SINCE);
        order_.bind_storage(BINDING_ZONE_ORDER);
        bind();
        block_sums_.bind_storage(BINDING_ZONE_RAYS);
        means_.dispatch_groups(first_block_.back(), 1);
        block_sums_.bind_storage(BINDING_FLUX);
        sum_by_zones(first_mean);
    }
    ray_buffer_.bind_storage(BINDING_ZONE_RAYS);
    segment_buffer_.bind_storage(BINDING_ZONE_ORDER);
    exchange_.set("first_sum", static_cast<unsigned>(first_pair));
    exchange_.dispatch_groups(static_cast<unsigned>(segments_.size()), 1);
    readback_->request(sums_, sums_.bytes());
    const auto sums = readback_->take_as<glm::vec4>();
    const std::vector<ZoneFlux> zones = read_fluxes(sums);
    levels_.note_group(zones, older_share_, group_weight_);
    group_weight_ = 0.0;
    older_share_.assign(partition_.count, 1.0);
    std::vector<ZoneSky> sky = sky_;
    const auto unit = static_cast<double>(gpu_scene_.radiance_unit());
    for (ZoneSky& s : sky) {
        s.flux /= unit;
        s.squares /= unit * unit;
    }
    const std::vector<ZoneExchange> exchange = read_exchange(sums.subspan(first_pair));
    std::vector<ZoneLevel> levels = levels_.solve(zones, exchange, sky);
    std::vector<KeptLevel> kept(partition_.count);
    if (means.kept != nullptr) {
        std::vector<ZoneMeans> light;
        for (const ZoneFlux& zone : read_fluxes(sums.subspan(first_mean))) {
            ZoneMeans means_of_zone;
            means_of_zone.kept = zone.incident;
            means_of_zone.since = zone.reflected;
            means_of_zone.since_weight = zone.emitted.x / std::max(zone.area, 1e-30);
            means_of_zone.area = zone.area;
            means_of_zone.loose = zone.loose;
            if (zone.emitted.y > 0.0) {
                means_of_zone.bounded_difference = zone.emitted.z / zone.emitted.y;
            }
            light.push_back(means_of_zone);
        }
        const bool first = !kept_.judged();
        kept = kept_.judge(light, levels_);
        for (unsigned zone = 0; first && zone < partition_.count; ++zone) {
            younger_[zone] = std::max(iterate_age_ - kept[zone].limit, 0.0);
            if (kept[zone].anew) {
                levels[zone] = {.scale = glm::dvec3(0.0), .offset = glm::dvec3(0.0)};
                levels_.skip_group();
            }
        }
    }
    shooting_ = shooting_factors(zones, levels);
    upload(levels, kept);
}

/// Flux per area that patches send whatever bundles bring, radiance units.
std::vector<glm::vec4> ZoneBalance::emitted() {
    const Buffer buffer("what patches emit", std::size_t{patch_count_} * sizeof(glm::vec4));
    buffer.bind_storage(BINDING_COMPLETION);
    emitted_.set("patch_count", patch_count_);
    emitted_.dispatch(patch_count_);
    std::vector<glm::vec4> result(patch_count_);
    buffer.read<glm::vec4>(result);
    return result;
}

std::vector<glm::vec4> ZoneBalance::complete_start() {
    const FirstReflection reflection = std::exchange(reflection_, {});
    return reflection.irradiance(emitted(), static_cast<double>(gpu_scene_.radiance_unit()));
}

void ZoneBalance::keep() {
    upload(std::vector<ZoneLevel>(max_zones), std::vector<KeptLevel>(max_zones));
}

void ZoneBalance::upload(std::span<const ZoneLevel> levels, std::span<const KeptLevel> kept) {
    std::vector<layout::ZoneLevelData> data;
    for (std::size_t zone = 0; zone < levels.size(); ++zone) {
        data.push_back(
            {glm::vec4(levels[zone].scale, kept[zone].sample_variance),
             glm::vec4(levels[zone].offset, zone < younger_.size() ? younger_[zone] : 0.0),
             glm::vec4(kept[zone].scale, kept[zone].limit),
             glm::vec4(zone < shooting_.size() ? shooting_[zone] : 1.0F)});
    }
    zones_buffer_.write<layout::ZoneLevelData>(data, 0);
    bind();
}

std::size_t ZoneBalance::bytes() const {
    std::size_t sum = 0;
    for (const Buffer* buffer : {&zones_buffer_, &order_, &blocks_, &block_sums_, &ray_buffer_,
                                 &segment_buffer_, &sums_}) {
        sum += buffer->bytes();
    }
    return sum;
}

}  // namespace raybundle
