// SPDX-License-Identifier: Apache-2.0
#include "solution/store/radiance_store.h"

#include <algorithm>

#include "solution/direct/many_lamps.h"
#include "solution/geometry/patch_growth.h"

namespace raybundle {

RadianceStore::Light::Light(std::size_t patch_count)
    : radiance("radiance", patch_count * sizeof(glm::vec4)),
      irradiance("irradiance", patch_count * sizeof(glm::vec4)),
      iterate("irradiance iterate", patch_count * sizeof(glm::vec4)),
      sums("accumulator", patch_count * 6 * sizeof(std::uint32_t)) {
    for (const Buffer* buffer : {&radiance, &irradiance, &iterate, &sums}) {
        buffer->clear();
    }
}

RadianceStore::RadianceStore(const GpuScene& scene, ZoneBalance& zones, Caustics* caustics)
    : scene_(scene),
      zones_(zones),
      patch_count_(scene.patch_count()),
      light_(patch_count_),
      sent_(scene, light_.radiance),
      gloss_(patch_count_, scene.reflectance().any_glossy()),
      slopes_(scene),
      selection_(scene),
      measures_(patch_count_),
      caustics_(caustics),
      update_({"solution_update.comp"}, scene.defines()),
      complete_({"solution_complete.comp"}, scene.defines()) {
    if (scene_.transmitting()) {
        level_.emplace(std::vector<std::string>{"solution_level.comp"});
    }
    if (!scene_.punctual_lights().empty()) {
        first_shot_.emplace(scene_);
        forget_ = ShaderProgram({"solution_forget.comp"}, scene_.defines());
    }
    bind();
    const ShaderProgram emit({"solution_emit.comp"});
    emit.set("patch_count", patch_count_);
    emit.dispatch(patch_count_);
    if (first_shot_) {
        first_shot_->update();
    }
    if (caustics_ != nullptr) {
        caustics_->restart();
        bind();
    }
    refresh_power();
}

void RadianceStore::bind() const {
    scene_.bind();
    sent_.bind(light_.radiance);
    slopes_.bind();
    light_.irradiance.bind_storage(BINDING_IRRADIANCE);
    light_.iterate.bind_storage(BINDING_SOURCE);
    light_.sums.bind_storage(BINDING_ACCUMULATOR);
    selection_.bind();
    measures_.bind();
    zones_.bind();
    gloss_.bind();
    if (first_shot_) {
        first_shot_->bind();
    }
    if (caustics_ != nullptr) {
        caustics_->bind();
    }
}

void RadianceStore::bind_caustics_of_patches() const {
    if (caustics_ != nullptr) {
        caustics_->bind_irradiance();
    }
}

void RadianceStore::remember_first_shot(const RadianceStore& other) {
    if (first_shot_ && other.first_shot_) {
        first_shot_->remember(*other.first_shot_);
    } else if (first_shot_) {
        first_shot_->remember_darkness();
    }
}

void RadianceStore::renew_first_shot(std::span<const std::uint32_t> reflecting) {
    if (first_shot_) {
        bind();
        first_shot_->update(false, reflecting);
    }
}

void RadianceStore::look_at_lamps() const {
    constexpr std::size_t points = 4096;  // some 10 ms on a core
    if (first_shot_ && first_shot_->many() != nullptr && first_shot_->many()->advance(points)) {
        bind();
    }
}

void RadianceStore::take_lamps(std::uint32_t group) {
    if (first_shot_ && first_shot_->many() != nullptr) {
        first_shot_->many()->publish_found();
        first_shot_->many()->draw_proposals(group);
    }
}

void RadianceStore::begin_lights() {
    if (first_shot_) {
        bind();
        first_shot_->begin_lights();
    }
}

void RadianceStore::begin_moves(std::span<const ObjectMove> moves) {
    if (first_shot_) {
        reflected_before_ = first_shot_->read_reflected();
        bind();
        first_shot_->begin_moves(moves);
    }
}

void RadianceStore::reshoot(float phase_weight) {
    if (!first_shot_) {
        return;
    }
    const std::vector<glm::vec4> before = std::move(reflected_before_);
    bind();
    first_shot_->update();
    const std::vector<glm::vec4> after = first_shot_->read_reflected();
    std::vector<glm::vec4> sent(patch_count_);
    light_.radiance.read<glm::vec4>(sent);
    double change = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const double area = after[i].w;
        change += area * static_cast<double>(luminance(glm::abs(glm::vec3(after[i] - before[i]))));
        all += area * static_cast<double>(luminance(glm::vec3(sent[i])));
    }
    const double q = all > 0.0 ? std::min(change / all, 1.0) : 0.0;
    forgetting_ = static_cast<float>(q * q) / phase_weight;
    if (q > 0.0) {
        forget_.set("patch_count", patch_count_);
        forget_.set("forgetting", forgetting_);
        forget_.set("change", static_cast<float>(q));
        forget_.dispatch(patch_count_);
    }
}

void RadianceStore::update(const BundleUpdate& bundle) const {
    update_.set("shooter_density", bundle.shooter_density);
    update_.set("patch_count", patch_count_);
    update_.set("scalar", bundle.scalar ? 1 : 0);
    update_.set("weight", bundle.weight);
    update_.set("iterate_age", bundle.iterate_age);
    update_.set("constant_irradiance", bundle.constant_irradiance);
    update_.set("perspective", bundle.from_point ? 1 : 0);
    update_.set("scatter_kind", bundle.scatter);
    update_.set("scout_stride", measures_.scout_stride());
    update_.set("iteration_number", static_cast<std::uint32_t>(bundle.iteration));
    if (first_shot_ && gloss_.any()) {
        first_shot_->set_uniforms(update_);
    }
    if (kept_.keeping()) {
        kept_.since().bind_storage(BINDING_IRRADIANCE);
    }
    update_.dispatch(patch_count_);
    light_.irradiance.bind_storage(BINDING_IRRADIANCE);
    zones_.note_step(bundle.iterate_age, bundle.weight);
}

void RadianceStore::send_other(const Buffer& radiance, const Texture2D& texture) {
    sent_.send_other(radiance, texture);
    bind();
}

void RadianceStore::stop_sending_other() {
    sent_.stop_sending_other();
    bind();
}

void RadianceStore::refresh_power(Levels levels) const {
    if (levels == Levels::found) {
        zones_.balance(kept_.means());
    } else {
        zones_.keep();
    }
    if (scene_.constant_radiance()) {
        selection_.balance_constant();
        zones_.bind();
    }
    serve();
    if (level_) {
        level_->set("patch_count", patch_count_);
        level_->dispatch(patch_count_);
    }
    selection_.refresh();
}

void RadianceStore::adopt(const RadianceStore& other) {
    kept_.adopt();
    const PatchGrowth growth(other.scene_, scene_);
    growth.copy(other.light_.radiance, light_.radiance);
    growth.copy(other.light_.irradiance, light_.irradiance);
    growth.copy(other.light_.iterate, light_.iterate);
    growth.copy(other.measures_.checkpoint_buffer(), measures_.checkpoint_buffer());
    const Buffer& balance = selection_.balance();
    glCopyNamedBufferSubData(other.selection_.balance().get(), balance.get(), 0, 0,
                             static_cast<GLsizeiptr>(balance.bytes()));
}

std::vector<glm::vec4> RadianceStore::read_irradiance() const {
    std::vector<glm::vec4> values(patch_count_);
    light_.irradiance.read<glm::vec4>(values);
    for (glm::vec4& value : values) {
        value = glm::vec4(glm::vec3(value) * scene_.radiance_unit(), value.w);
    }
    if (first_shot_) {
        const std::vector<glm::vec3> first = first_shot_->read_irradiance();
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] += glm::vec4(first[i] * scene_.radiance_unit(), 0.0F);
        }
    }
    if (caustics_ != nullptr) {
        const std::vector<glm::vec4> caustics = caustics_->read_irradiance();
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] += glm::vec4(glm::vec3(caustics[i]) * scene_.radiance_unit(), 0.0F);
        }
    }
    return values;
}

glm::vec4 RadianceStore::read_irradiance(std::uint32_t patch) const {
    glm::vec4 value(0.0F);
    patch = std::min(patch, patch_count_ - 1);
    light_.irradiance.read(std::span(&value, 1), sizeof(glm::vec4) * patch);
    glm::vec3 sum(value);
    if (first_shot_) {
        sum += first_shot_->read_irradiance(patch);
    }
    if (caustics_ != nullptr) {
        sum += caustics_->read_irradiance(patch);
    }
    return {sum * scene_.radiance_unit(), value.w};
}

std::vector<glm::vec3> RadianceStore::read_radiance() const {
    std::vector<glm::vec4> values(patch_count_);
    light_.radiance.read<glm::vec4>(values);
    std::vector<glm::vec3> result;
    result.reserve(values.size());
    for (const glm::vec4& value : values) {
        result.push_back(glm::vec3(value) * scene_.radiance_unit());
    }
    return result;
}

void RadianceStore::write_radiance(std::uint32_t patch, const glm::vec4& value) {
    light_.radiance.write<glm::vec4>(std::span(&value, 1), std::size_t{patch} * sizeof(glm::vec4));
}

std::size_t RadianceStore::bytes() const {
    std::size_t sum = first_shot_ ? first_shot_->bytes() : 0;
    for (const Buffer* buffer :
         {&light_.radiance, &light_.irradiance, &light_.iterate, &light_.sums}) {
        sum += buffer->bytes();
    }
    return sum + sent_.bytes() + gloss_.bytes() + slopes_.bytes() + selection_.bytes() +
           measures_.bytes() + kept_.bytes();
}

}  // namespace raybundle
