// SPDX-License-Identifier: Apache-2.0
#include "solution/caustics.h"

#include "gpu/gl_scope.h"

namespace raybundle {
namespace {

/// Geometry and emission; the rest is not looked at.
PatchMesh without_colours(const PatchMesh& mesh) {
    PatchMesh result;
    result.positions = mesh.positions;
    result.vertex_object = mesh.vertex_object;
    result.triangles = mesh.triangles;
    result.patch_triangle = mesh.patch_triangle;
    result.emission = mesh.emission;
    return result;
}

}  // namespace

Caustics::Caustics(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                   std::uint64_t seed)
    : scene_(gpu_scene),
      mesh_(without_colours(mesh)),
      caustic_rays_(scene, mesh, *gpu_scene.specular_rays()),
      inverse_areas_(mesh.patch_count()),
      sums_(mesh.patch_count(), glm::dvec3(0.0)),
      values_(mesh.patch_count(), glm::vec4(0.0F)),
      seed_(seed),
      irradiance_("caustic irradiance", mesh.patch_count() * sizeof(glm::vec4)),
      radiance_("caustic radiance", irradiance_.bytes()),
      vertices_("vertex caustics", 2 * mesh.positions.size() * sizeof(glm::uvec2)),
      vertex_texture_(create_buffer_texture("vertex caustics", GL_RGBA16F, vertices_)),
      reflect_({"solution_caustics.comp"}, gpu_scene.defines()),
      interpolate_({"view_vertex_irradiance.comp"}) {
    irradiance_.clear();
    radiance_.clear();
    vertices_.clear();
}

void Caustics::refine() {
    if (lights_ && !lights_->empty()) {
        trace(batch_rays);
        upload();
    }
}

void Caustics::scale(const glm::vec3& factor) {
    scale_ *= factor;
}

void Caustics::restart() {
    measure_patches();
    lights_.emplace(scene_, mesh_, mesh_.emission, scene_.specular_rays()->boxes());
    sums_.assign(sums_.size(), glm::dvec3(0.0));
    rays_ = 0;
    ++changes_;
    if (!lights_->empty()) {
        trace(first_rays);
    }
    upload();
}

void Caustics::update(const Scene& scene, std::span<const std::uint32_t> materials,
                      std::span<const glm::vec3> emission) {
    for (const std::uint32_t material : materials) {
        caustic_rays_.update(scene, material);
    }
    mesh_.emission.assign(emission.begin(), emission.end());
}

void Caustics::trace(std::uint32_t rays) {
    for (const CausticDeposit& deposit :
         caustic_rays_.trace(*lights_, seed_ + changes_, rays_, rays)) {
        sums_[deposit.patch] += glm::dvec3(deposit.flux);
    }
    rays_ += rays;
}

void Caustics::measure_patches() {
    for (std::size_t i = 0; i < inverse_areas_.size(); ++i) {
        const glm::uvec3& t = mesh_.triangles[mesh_.patch_triangle[i]];
        const glm::mat3 world(scene_.world_from_object(mesh_.vertex_object[t.x], Place::now));
        const glm::vec3 e1 = world * (mesh_.positions[t.y] - mesh_.positions[t.x]);
        const glm::vec3 e2 = world * (mesh_.positions[t.z] - mesh_.positions[t.x]);
        const float area = 0.5F * glm::length(glm::cross(e1, e2));
        inverse_areas_[i] = area > 0.0F ? 1.0F / area : 0.0F;
    }
}

glm::vec3 Caustics::irradiance(std::size_t patch) const {
    return rays_ == 0
               ? glm::vec3(0.0F)
               : glm::vec3(sums_[patch] / static_cast<double>(rays_)) * inverse_areas_[patch];
}

void Caustics::upload() {
    const GlScope scope("caustics");
    const float lux_to_units = 1.0F / scene_.radiance_unit();
    for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] = glm::vec4(lux_to_units * irradiance(i), 0.0F);
    }
    irradiance_.write<glm::vec4>(values_, 0);
    irradiance_.bind_storage(BINDING_CAUSTIC_IRRADIANCE);
    radiance_.bind_storage(BINDING_CAUSTICS);
    reflect_.set("patch_count", scene_.patch_count());
    reflect_.set("scale", scale_);
    reflect_.dispatch(scene_.patch_count());
    scale_ = glm::vec3(1.0F);
    irradiance_.bind_storage(BINDING_IRRADIANCE);
    vertices_.bind_storage(BINDING_VERTEX_IRRADIANCE);
    interpolate_.set("vertex_count", scene_.vertex_count());
    interpolate_.dispatch(scene_.vertex_count());
}

void Caustics::bind() const {
    radiance_.bind_storage(BINDING_CAUSTICS);
    glBindTextureUnit(UNIT_VERTEX_CAUSTICS, vertex_texture_.get());
}

std::size_t Caustics::bytes() const {
    return irradiance_.bytes() + radiance_.bytes() + vertices_.bytes();
}

}  // namespace raybundle
