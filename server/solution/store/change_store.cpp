// SPDX-License-Identifier: Apache-2.0
#include "solution/store/change_store.h"

#include <cmath>

namespace raybundle {

ChangeStore::ChangeStore(const GpuScene& scene, RadianceStore& store)
    : scene_(scene),
      store_(store),
      patch_count_(scene.patch_count()),
      block_count_((patch_count_ + POWER_BLOCK - 1) / POWER_BLOCK),
      increments_("increments", std::size_t{patch_count_} * sizeof(glm::vec4)),
      stage_("increments of a stage", increments_.bytes()),
      changed_("changed radiance", increments_.bytes()),
      old_surfaces_("old surfaces", scene.surfaces().bytes()),
      changed_texture_(create_buffer_texture("changed radiance", GL_RGBA32F, changed_)),
      scale_({"solution_scale.comp"}, scene.defines()),
      source_({"change_source.comp"}, scene.defines()),
      power_sum_({"change_power_sum.comp"}, {"CHANGE 1"}),
      power_scan_({"solution_power_scan.comp"}, {"CHANGE 1"}),
      power_density_({"solution_power_density.comp"}, {"CHANGE 1"}),
      reflect_({"change_reflect.comp"}),
      take_({"change_take.comp"}),
      noise_({"change_noise.comp"}),
      flux_({"change_flux.comp"}),
      fold_({"change_fold.comp"}),
      correct_({"solution_correct.comp"}, scene.defines()) {
    begin();
}

void ChangeStore::remember_surfaces(const GpuScene& scene) const {
    glCopyNamedBufferSubData(scene.surfaces().get(), old_surfaces_.get(), 0, 0,
                             static_cast<GLsizeiptr>(old_surfaces_.bytes()));
}

void ChangeStore::scale(const glm::vec3& factor) const {
    scale_.set("patch_count", patch_count_);
    scale_.set("factor", factor);
    scale_.dispatch(patch_count_);
}

void ChangeStore::set_source(const glm::vec3& scale,
                             std::span<const std::uint32_t> reflecting) const {
    old_surfaces_.bind_storage(BINDING_OLD_SURFACES);
    changed_.bind_storage(BINDING_CHANGED_RADIANCE);
    if (store_.first_shot() != nullptr) {
        store_.first_shot()->bind_remembered();
    }
    source_.set("patch_count", patch_count_);
    source_.set("scale", scale);
    source_.set("material", NO_PATCH);
    source_.dispatch(patch_count_);
    for (const std::uint32_t material : reflecting) {
        source_.set("material", material);
        source_.dispatch(patch_count_);
    }
}

void ChangeStore::begin() const {
    increments_.clear();
    stage_.clear();
}

void ChangeStore::send() const {
    store_.send_other(changed_, changed_texture_);
    power_sum_.set("patch_count", patch_count_);
    power_sum_.dispatch(patch_count_);
    power_scan_.set("block_count", block_count_);
    power_scan_.dispatch(1);
    power_density_.set("patch_count", patch_count_);
    power_density_.set("block_count", block_count_);
    power_density_.dispatch(patch_count_);
}

std::vector<layout::Shooter> ChangeStore::choose_shooters(
    std::span<const glm::vec4> numbers) const {
    std::vector<layout::Shooter> shooters = store_.choose_shooters(numbers);
    for (layout::Shooter& shooter : shooters) {
        shooter.glossy = 0;
    }
    return shooters;
}

void ChangeStore::reflect(unsigned bundles) const {
    increments_.bind_storage(BINDING_INCREMENTS);
    stage_.bind_storage(BINDING_STAGE);
    changed_.bind_storage(BINDING_CHANGED_RADIANCE);
    reflect_.set("patch_count", patch_count_);
    reflect_.set("stage_share", bundles > 0 ? 1.0F / static_cast<float>(bundles) : 0.0F);
    reflect_.dispatch(patch_count_);
}

void ChangeStore::take(unsigned bundles) const {
    stage_.bind_storage(BINDING_STAGE);
    take_.set("patch_count", patch_count_);
    take_.set("factor", static_cast<float>(bundles));
    take_.dispatch(patch_count_);
}

ChangeNoise ChangeStore::noise(unsigned bundles) const {
    stage_.bind_storage(BINDING_STAGE);
    noise_.set("bundles", static_cast<float>(bundles));
    const glm::dvec4 sum = store_.reduce(noise_);
    ChangeNoise result;
    result.change = sum.z > 0.0 ? std::sqrt(sum.x / sum.z) : 0.0;
    result.relative = sum.x > 0.0 ? std::sqrt(sum.y / sum.x) : 0.0;
    return result;
}

double ChangeStore::reflected_share() const {
    increments_.bind_storage(BINDING_INCREMENTS);
    const glm::dvec4 sum = store_.reduce(flux_);
    return sum.y > 0.0 ? sum.x / sum.y : (sum.x > 0.0 ? 1.0 : 0.0);
}

void ChangeStore::fold(unsigned bundles, float unseen) const {
    increments_.bind_storage(BINDING_INCREMENTS);
    stage_.bind_storage(BINDING_STAGE);
    fold_.set("patch_count", patch_count_);
    fold_.set("bundles", static_cast<float>(bundles));
    fold_.set("unseen", unseen);
    fold_.dispatch(patch_count_);
}

void ChangeStore::correct(float bundles_noise, float most_weight) const {
    increments_.bind_storage(BINDING_INCREMENTS);
    correct_.set("patch_count", patch_count_);
    scene_.set_move(correct_);
    correct_.set("bundles_noise", bundles_noise);
    correct_.set("most_weight", most_weight);
    correct_.dispatch(patch_count_);
}

std::size_t ChangeStore::bytes() const {
    return increments_.bytes() + stage_.bytes() + changed_.bytes() + old_surfaces_.bytes();
}

}  // namespace raybundle
