// SPDX-License-Identifier: Apache-2.0
#include "solution/specular/caustics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "gpu/gl_scope.h"
#include "scene/mesh/patch_means.h"
#include "solution/geometry/patch_growth.h"

namespace raybundle {
namespace {

constexpr double division_factor =
    1.2;  // cells are divided from the root of all rays on, times this

/// Geometry, materials and emission; the rest is not looked at.
PatchMesh without_colours(const PatchMesh& mesh) {
    PatchMesh result;
    result.positions = mesh.positions;
    result.vertex_object = mesh.vertex_object;
    result.triangles = mesh.triangles;
    result.triangle_material = mesh.triangle_material;
    result.side_triangle = mesh.side_triangle;
    result.emission = mesh.emission;
    result.patch_sets = mesh.patch_sets;
    return result;
}

}  // namespace

Caustics::Caustics(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                   std::uint64_t seed)
    : scene_(gpu_scene),
      mesh_(without_colours(mesh)),
      cells_(mesh),
      sums_(mesh.patch_count(), glm::dvec3(0.0)),
      surface_sums_(sums_),
      surface_counts_(sums_.size(), 0),
      seed_(seed),
      unit_(gpu_scene.radiance_unit()),
      readback_("caustic sources", mesh.patch_count() * sizeof(glm::vec4)),
      flux_("caustic flux", 2 * mesh.patch_count() * sizeof(glm::vec4)),
      deposit_buffer_("caustic deposits", mesh.patch_count() * sizeof(glm::vec4)),
      irradiance_("caustic irradiance", deposit_buffer_.bytes()),
      radiance_("caustic radiance", deposit_buffer_.bytes()),
      vertices_("vertex caustics", 2 * mesh.positions.size() * sizeof(glm::uvec2)),
      vertex_texture_(create_buffer_texture("vertex caustics", GL_RGBA16F, vertices_)),
      deposit_({"solution_caustic_deposits.comp"}),
      reflect_({"solution_caustics.comp"}, gpu_scene.defines()),
      interpolate_({"view_vertex_irradiance.comp"}, gpu_scene.set_defines()) {
    flux_.clear();
    irradiance_.clear();
    radiance_.clear();
    vertices_.clear();
    if (gpu_scene.mirrors_shine()) {
        caustic_rays_.emplace(scene, mesh, *gpu_scene.specular_rays());
    }
    if (gpu_scene.medium()) {
        air_.emplace(scene, mesh, gpu_scene, cells_, seed);
    }
}

void Caustics::refine(const Buffer& sent) {
    if (lights_ && !lights_->empty()) {
        trace(batch_rays);
    }
    const bool surfaces = batches_++ % surface_interval == 0 && caustic_rays_;
    if (surfaces || air_) {
        if (!readback_.pending()) {
            request(sent);
        }
        const std::span<const glm::vec4> radiance = readback_.take_as<glm::vec4>();
        if (surfaces) {
            trace_surfaces(radiance);
        }
        if (air_) {
            scatter(radiance);
        }
        upload_surfaces();
    }
    reflect();
    if (batches_ % surface_interval == 0 || air_) {
        request(sent);  // for the next time
    }
}

/// What the air scatters, of the patches' radiance as it is.
void Caustics::scatter(std::span<const glm::vec4> radiance) {
    std::vector<glm::vec3> sent;
    sent.reserve(radiance.size());
    for (const glm::vec4& r : radiance) {
        sent.push_back(glm::vec3(r) * scene_.radiance_unit());
    }
    air_->set_radiance(sent, patch_means(mesh_, mesh_.emission));
    air_->refine();
}

void Caustics::scale(const glm::vec3& factor) {
    scale_ *= factor;
}

void Caustics::restart() {
    if (caustic_rays_) {
        lights_.emplace(scene_, mesh_, mesh_.emission, CausticLights::Kind::lamps,
                        scene_.specular_rays()->boxes(SpecularRays::Coats::passed));
    }
    if (air_) {
        air_->scale(scale_ * (scene_.radiance_unit() / unit_));  // which is in cd/m²
        air_->restart(mesh_.emission);
    }
    sums_.assign(sums_.size(), glm::dvec3(0.0));
    surface_sums_.assign(sums_.size(), glm::dvec3(0.0));
    surface_counts_.assign(sums_.size(), 0);
    surface_batches_ = 0;
    batches_ = 0;
    readback_.cancel();
    flux_.clear(deposit_buffer_.bytes());
    for (glm::vec4& flux : surface_flux_) {
        flux *= glm::vec4(scale_, 1.0F);
    }
    upload_surfaces();
    rays_ = 0;
    ++changes_;
    if (lights_ && !lights_->empty()) {
        trace(first_rays);
    }
    reflect();
}

void Caustics::adopt(const Caustics* other) {
    if (other == nullptr) {
        radiance_.clear();
        return;
    }
    const PatchGrowth growth(other->scene_, scene_);
    growth.copy(other->radiance_, radiance_);
    scale_ = other->scale_;
    unit_ = other->unit_;
    if (air_ && other->air_) {
        air_->adopt(*other->air_, growth);
    }
    if (!caustic_rays_ || !other->caustic_rays_) {
        return;
    }
    growth.copy(other->flux_, flux_, 2);
    sums_ = growth.grown(other->sums_, glm::dvec3(0.0));
    surface_sums_ = growth.grown(other->surface_sums_, glm::dvec3(0.0));
    surface_counts_ = growth.grown(other->surface_counts_, 0U);
    if (!other->surface_flux_.empty()) {
        surface_flux_ = growth.grown(other->surface_flux_, glm::vec4(0.0F));
    }
    surface_batches_ = other->surface_batches_;
    batches_ = other->batches_;
    rays_ = other->rays_;
}

void Caustics::refresh() {
    upload_surfaces();
    reflect();
}

void Caustics::update(const Scene& scene, std::span<const std::uint32_t> materials,
                      std::span<const glm::vec3> emission) {
    for (const std::uint32_t material : materials) {
        if (caustic_rays_) {
            caustic_rays_->update(scene, material);
        }
        if (air_) {
            air_->update(scene, material);
        }
    }
    mesh_.emission.assign(emission.begin(), emission.end());
}

/// Uploads the sums of the patches that the rays have met, and no others.
void Caustics::trace(std::uint32_t rays) {
    met_.clear();
    for (const CausticDeposit& deposit :
         caustic_rays_->trace(*lights_, seed_ + changes_, rays_, rays)) {
        sums_[deposit.patch] += glm::dvec3(deposit.flux);
        met_.push_back(deposit.patch);
    }
    rays_ += rays;
    std::sort(met_.begin(), met_.end());
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
    if (met_.empty()) {
        return;
    }
    deposits_.clear();
    for (const std::uint32_t patch : met_) {
        deposits_.emplace_back(glm::vec3(sums_[patch]), std::bit_cast<float>(patch));
    }
    deposit_buffer_.write<glm::vec4>(deposits_, 0);
    deposit_buffer_.bind_storage(BINDING_CAUSTIC_DEPOSITS);
    flux_.bind_storage(BINDING_CAUSTIC_FLUX);
    deposit_.set("deposit_count", static_cast<unsigned>(deposits_.size()));
    deposit_.dispatch(deposits_.size());
}

/// What sides reflect, cd/m²: all that their patches send but their emission. Mirrors and glass do
/// not count, whose light is on its way.
std::vector<glm::vec3> Caustics::reflected(std::span<const glm::vec4> radiance) const {
    const std::vector<glm::vec3> emission = patch_means(mesh_, mesh_.emission);
    std::vector<glm::vec3> result(mesh_.side_count(), glm::vec3(0.0F));
    for (std::uint32_t i = 0; i < result.size(); ++i) {
        const std::uint32_t material = mesh_.triangle_material[mesh_.side_triangle[i]];
        const SpecularKind kind = scene_.specular_rays()->surface_of(material).kind;
        if (kind == SpecularKind::none || kind == SpecularKind::coat) {
            const std::uint32_t patch = mesh_.patch_of(i);
            result[i] = glm::max(
                glm::vec3(radiance[patch]) * scene_.radiance_unit() - emission[patch], 0.0F);
        }
    }
    return result;
}

void Caustics::request(const Buffer& sent) {
    readback_.request(sent, sums_.size() * sizeof(glm::vec4));
}

void Caustics::trace_surfaces(std::span<const glm::vec4> radiance) {
    const CausticLights surfaces(scene_, mesh_, reflected(radiance), CausticLights::Kind::others,
                                 scene_.specular_rays()->boxes(SpecularRays::Coats::passed));
    if (surfaces.empty()) {
        surface_flux_.assign(surface_flux_.size(), glm::vec4(0.0F));
        return;
    }
    const auto weight = static_cast<double>(surface_batches_ + 1);
    for (const CausticDeposit& deposit : caustic_rays_->trace(
             surfaces, ~(seed_ + changes_), surface_batches_ * surface_rays, surface_rays)) {
        surface_sums_[deposit.patch] += weight * glm::dvec3(deposit.flux);
        ++surface_counts_[deposit.patch];
    }
    ++surface_batches_;
    const double all = std::accumulate(surface_counts_.begin(), surface_counts_.end(), 0.0);
    const std::vector<glm::vec3> spread =
        cells_.spread(surface_sums_, surface_counts_,
                      static_cast<std::uint64_t>(division_factor * std::sqrt(all)) + 1);
    const double weights = 0.5 * weight * (weight + 1.0);
    const auto share = static_cast<float>(
        1.0 / (weights * surface_rays * static_cast<double>(scene_.radiance_unit())));
    surface_flux_.clear();
    for (const glm::vec3& flux : spread) {
        surface_flux_.emplace_back(share * flux, 0.0F);
    }
}

void Caustics::upload_surfaces() {
    if (air_) {
        std::vector<glm::vec4> flux = surface_flux_;
        flux.resize(sums_.size(), glm::vec4(0.0F));
        for (std::size_t i = 0; i < flux.size(); ++i) {
            flux[i] += glm::vec4(air_->flux()[i] / scene_.radiance_unit(), 0.0F);
        }
        flux_.write<glm::vec4>(flux, deposit_buffer_.bytes());
    } else if (!surface_flux_.empty()) {
        flux_.write<glm::vec4>(surface_flux_, deposit_buffer_.bytes());
    }
}

/// The patches' irradiance and what they send of it.
void Caustics::reflect() {
    const GlScope scope("caustics");
    flux_.bind_storage(BINDING_CAUSTIC_FLUX);
    irradiance_.bind_storage(BINDING_CAUSTIC_IRRADIANCE);
    radiance_.bind_storage(BINDING_CAUSTICS);
    const double rays = static_cast<double>(std::max<std::uint64_t>(rays_, 1));
    reflect_.set("patch_count", scene_.patch_count());
    reflect_.set("flux_share",
                 static_cast<float>(1.0 / (rays * static_cast<double>(scene_.radiance_unit()))));
    reflect_.set("scale", scale_);
    reflect_.dispatch(scene_.patch_count());
    scale_ = glm::vec3(1.0F);
    unit_ = scene_.radiance_unit();
    irradiance_.bind_storage(BINDING_IRRADIANCE);
    vertices_.bind_storage(BINDING_VERTEX_IRRADIANCE);
    interpolate_.set("vertex_count", scene_.vertex_count());
    interpolate_.dispatch(scene_.vertex_count());
}

std::vector<glm::vec4> Caustics::read_irradiance() const {
    std::vector<glm::vec4> values(sums_.size());
    irradiance_.read<glm::vec4>(values);
    return values;
}

glm::vec3 Caustics::read_irradiance(std::uint32_t patch) const {
    glm::vec4 value(0.0F);
    irradiance_.read<glm::vec4>(std::span(&value, 1), sizeof(glm::vec4) * patch);
    return glm::vec3(value);
}

void Caustics::bind() const {
    radiance_.bind_storage(BINDING_CAUSTICS);
    glBindTextureUnit(UNIT_VERTEX_CAUSTICS, vertex_texture_.get());
}

std::size_t Caustics::bytes() const {
    return flux_.bytes() + 3 * deposit_buffer_.bytes() + vertices_.bytes() +
           (air_ ? air_->bytes() : 0);
}

}  // namespace raybundle
