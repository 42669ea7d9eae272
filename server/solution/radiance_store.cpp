// SPDX-License-Identifier: Apache-2.0
#include "solution/radiance_store.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solution/many_lamps.h"

namespace raybundle {

namespace {
constexpr std::size_t max_shooters = 16;
constexpr std::size_t statistics_groups = 64;
constexpr float relevant_change = 0.01F;  // smaller relative changes are taken for noise
}  // namespace

RadianceStore::RadianceStore(const GpuScene& scene, ZoneBalance& zones, Caustics* caustics)
    : scene_(scene),
      zones_(zones),
      patch_count_(scene.patch_count()),
      block_count_((scene.patch_count() + POWER_BLOCK - 1) / POWER_BLOCK),
      radiance_("radiance", std::size_t{patch_count_} * sizeof(glm::vec4)),
      irradiance_("irradiance", std::size_t{patch_count_} * sizeof(glm::vec4)),
      source_("irradiance iterate", std::size_t{patch_count_} * sizeof(glm::vec4)),
      accumulator_("accumulator", std::size_t{patch_count_} * 6 * sizeof(std::uint32_t)),
      counters_("counters", sizeof(layout::Counters)),
      power_("power blocks", (std::size_t{block_count_} + 1) * sizeof(glm::vec4)),
      flux_("flux sums", (std::size_t{block_count_} + 1) * sizeof(layout::FluxSums)),
      balance_("energy balance", sizeof(layout::Balance)),
      cdf_("selection cdf", std::size_t{patch_count_} * sizeof(float)),
      shooters_("shooters", max_shooters * sizeof(layout::Shooter)),
      checkpoint_buffer_("checkpoint", std::size_t{patch_count_} * sizeof(glm::vec4)),
      statistics_buffer_("solution statistics", statistics_groups * sizeof(glm::vec4)),
      scout_stride_((patch_count_ + MOST_SCOUTS - 1) / MOST_SCOUTS),
      scatter_("scatter of the strategies", (patch_count_ / scout_stride_ + 1) * sizeof(glm::vec2)),
      caustics_(caustics),
      vertex_light_("vertex light",
                    std::size_t{scene.vertex_count()} * sizeof(layout::VertexLight)),
      slopes_("radiance slopes", std::size_t{patch_count_} * sizeof(layout::RadianceSlope)),
      radiance_texture_(create_buffer_texture("radiance", GL_RGBA32F, radiance_)),
      slope_texture_(create_buffer_texture("radiance slopes", GL_RGBA32UI, slopes_)),
      shooter_readback_("shooter readback", max_shooters * sizeof(layout::Shooter)),
      statistics_readback_("statistics readback", statistics_buffer_.bytes()),
      counters_readback_("counters readback", sizeof(layout::Counters)),
      update_({"solution_update.comp"}, scene.defines()),
      power_sum_({"solution_power_sum.comp"}, scene.defines()),
      power_scan_({"solution_power_scan.comp"}),
      power_density_({"solution_power_density.comp"}, scene.defines()),
      choose_({"solution_shooters.comp"}, scene.defines()),
      complete_({"solution_complete.comp"}, scene.defines()),
      flux_sum_({"solution_flux_sum.comp"}, scene.defines()),
      balance_flux_({"solution_balance.comp"}),
      gather_at_vertices_({"solution_vertex_light.comp"}, scene.set_defines()),
      find_slopes_({"solution_radiance_slopes.comp"}, scene.set_defines()),
      checkpoint_({"solution_checkpoint.comp"}),
      statistics_({"solution_statistics.comp"}),
      measure_scatter_({"solution_scatter.comp"}) {
    for (const Buffer* buffer : {&radiance_, &irradiance_, &source_, &accumulator_, &counters_,
                                 &balance_, &flux_, &checkpoint_buffer_, &scatter_, &slopes_}) {
        buffer->clear();
    }
    if (scene_.transmitting()) {
        level_.emplace(std::vector<std::string>{"solution_level.comp"});
    }
    if (scene_.reflectance().any_glossy()) {
        gloss_ = Buffer("gloss", std::size_t{patch_count_} * sizeof(glm::uvec4));
        chain_ = Buffer("gloss chain", std::size_t{patch_count_} * sizeof(glm::vec2));
        gloss_.clear();
        chain_.clear();
        gloss_texture_ = create_buffer_texture("gloss", GL_RGBA32UI, gloss_);
        sent_ = Buffer("sent radiance", radiance_.bytes());
        sent_texture_ = create_buffer_texture("sent radiance", GL_RGBA32F, sent_);
        send_ = ShaderProgram({"transport_sent_radiance.comp"}, scene_.defines());
        turn_gloss_ = ShaderProgram({"solution_turn_gloss.comp"});
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
    (other_ != nullptr ? *other_ : radiance_).bind_storage(BINDING_RADIANCE);
    glBindTextureUnit(UNIT_RADIANCE,
                      (other_texture_ != nullptr ? *other_texture_ : radiance_texture_).get());
    glBindTextureUnit(UNIT_SLOPES, slope_texture_.get());
    irradiance_.bind_storage(BINDING_IRRADIANCE);
    source_.bind_storage(BINDING_SOURCE);
    accumulator_.bind_storage(BINDING_ACCUMULATOR);
    counters_.bind_storage(BINDING_COUNTERS);
    power_.bind_storage(BINDING_POWER);
    balance_.bind_storage(BINDING_BALANCE);
    zones_.bind();
    cdf_.bind_storage(BINDING_CDF);
    shooters_.bind_storage(BINDING_SHOOTERS);
    checkpoint_buffer_.bind_storage(BINDING_CHECKPOINT);
    scatter_.bind_storage(BINDING_SCATTER);
    if (first_shot_) {
        first_shot_->bind();
    }
    if (caustics_ != nullptr) {
        caustics_->bind();
    }
    if (gloss_.bytes() > 0) {
        gloss_.bind_storage(BINDING_GLOSS);
        chain_.bind_storage(BINDING_CHAIN);
        glBindTextureUnit(UNIT_GLOSS, gloss_texture_.get());
    }
}

void RadianceStore::remember_first_shot(const RadianceStore& other) {
    if (first_shot_ && other.first_shot_) {
        first_shot_->remember(*other.first_shot_);
    }
}

void RadianceStore::renew_first_shot() {
    if (first_shot_) {
        bind();
        first_shot_->update(false);
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

void RadianceStore::reshoot(float phase_weight) {
    if (!first_shot_) {
        return;
    }
    const std::vector<glm::vec4> before = first_shot_->read_reflected();
    first_shot_->update();
    const std::vector<glm::vec4> after = first_shot_->read_reflected();
    std::vector<glm::vec4> sent(patch_count_);
    radiance_.read<glm::vec4>(sent);
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
    update_.set("perspective", bundle.shooter_density > 0.0F ? 1 : 0);
    update_.set("scatter_kind", bundle.scatter);
    update_.set("scout_stride", scout_stride_);
    update_.set("iteration_number", static_cast<std::uint32_t>(bundle.iteration));
    if (first_shot_ && gloss_.bytes() > 0) {
        first_shot_->set_uniforms(update_);
    }
    if (keeping_) {
        since_.bind_storage(BINDING_IRRADIANCE);
    }
    update_.dispatch(patch_count_);
    irradiance_.bind_storage(BINDING_IRRADIANCE);
    zones_.note_step(bundle.iterate_age, bundle.weight);
}

void RadianceStore::send_along_bundle(Place place) const {
    if (sent_.bytes() > 0 && other_ == nullptr) {
        sent_.bind_storage(BINDING_SENT);
        send_.set("patch_count", patch_count_);
        send_.set("patch_base", scene_.patch_base(place));
        send_.set("vertex_base", scene_.vertex_base(place));
        send_.dispatch(patch_count_);
        glBindTextureUnit(UNIT_RADIANCE, sent_texture_.get());
    }
    if (placed_ && scene_.rescaled()) {
        placed_->radiance.bind_storage(BINDING_SENT);
        placed_->program.set("patch_count", patch_count_);
        placed_->program.set("patch_base", scene_.patch_base(place));
        placed_->program.dispatch(patch_count_);
        glBindTextureUnit(UNIT_RADIANCE, placed_->texture.get());
    }
}

void RadianceStore::follow_sizes() {
    if (placed_ || !scene_.rescaled()) {
        return;
    }
    Buffer radiance("placed radiance", radiance_.bytes());
    Texture2D texture = create_buffer_texture("placed radiance", GL_RGBA32F, radiance);
    placed_.emplace(Placed{std::move(radiance), std::move(texture),
                           ShaderProgram({"transport_placed_radiance.comp"})});
}

void RadianceStore::turn_gloss(std::uint32_t object, const glm::mat4& now_from_before) const {
    if (gloss_.bytes() == 0) {
        return;
    }
    turn_gloss_.set("patch_count", patch_count_);
    turn_gloss_.set("object", object);
    turn_gloss_.set("now_from_before", now_from_before);
    turn_gloss_.dispatch(patch_count_);
}

void RadianceStore::send_other(const Buffer& radiance, const Texture2D& texture) {
    other_ = &radiance;
    other_texture_ = &texture;
    bind();
}

void RadianceStore::stop_sending_other() {
    other_ = nullptr;
    other_texture_ = nullptr;
    bind();
}

void RadianceStore::refresh_slopes() const {
    vertex_light_.bind_storage(BINDING_VERTEX_LIGHT);
    gather_at_vertices_.set("vertex_count", scene_.vertex_count());
    gather_at_vertices_.dispatch(scene_.vertex_count());
    slopes_.bind_storage(BINDING_SLOPES);
    find_slopes_.set("patch_count", patch_count_);
    find_slopes_.set("front_count", scene_.front_patch_count());
    find_slopes_.dispatch(patch_count_);
}

void RadianceStore::refresh_power(Levels levels) const {
    if (levels == Levels::found) {
        zones_.balance(keeping_ ? ZoneBalance::Means{&kept_, &since_} : ZoneBalance::Means{});
    } else {
        zones_.keep();
    }
    if (scene_.constant_radiance()) {
        flux_.bind_storage(BINDING_FLUX);
        flux_sum_.set("patch_count", patch_count_);
        flux_sum_.dispatch(patch_count_);
        balance_flux_.set("block_count", block_count_);
        balance_flux_.set("shoots_only", shoots_only_ ? 1 : 0);
        balance_flux_.dispatch(1);
        zones_.bind();
    }
    serve();
    if (level_) {
        level_->set("patch_count", patch_count_);
        level_->dispatch(patch_count_);
    }
    power_sum_.set("patch_count", patch_count_);
    power_sum_.dispatch(patch_count_);
    power_scan_.set("block_count", block_count_);
    power_scan_.dispatch(1);
    power_density_.set("patch_count", patch_count_);
    power_density_.set("block_count", block_count_);
    power_density_.dispatch(patch_count_);
}

std::vector<layout::Shooter> RadianceStore::choose_shooters(std::span<const glm::vec4> numbers) {
    const std::size_t count = std::min(numbers.size(), max_shooters);
    if (count == 0) {
        return {};
    }
    choose_.set("patch_count", patch_count_);
    choose_.set("block_count", block_count_);
    choose_.set("diameter", scene_.diameter());
    choose_.set("shooter_count", static_cast<unsigned>(count));
    choose_.set("random_numbers", numbers.first(count));
    choose_.dispatch(count);
    shooter_readback_.request(shooters_, count * sizeof(layout::Shooter));
    const auto chosen = shooter_readback_.take_as<layout::Shooter>();
    return {chosen.begin(), chosen.end()};
}

void RadianceStore::adopt(const RadianceStore& other) const {
    const auto copy = [](const Buffer& from, const Buffer& to) {
        glCopyNamedBufferSubData(from.get(), to.get(), 0, 0, static_cast<GLsizeiptr>(to.bytes()));
    };
    copy(other.radiance_, radiance_);
    copy(other.irradiance_, irradiance_);
    copy(other.source_, source_);
    copy(other.balance_, balance_);
    copy(other.checkpoint_buffer_, checkpoint_buffer_);
}

void RadianceStore::checkpoint(bool unsettled) const {
    checkpoint_.set("unsettled", unsettled ? 1 : 0);
    checkpoint_.set("patch_count", patch_count_);
    checkpoint_.dispatch(patch_count_);
}

glm::dvec4 RadianceStore::reduce(const ShaderProgram& program) const {
    statistics_buffer_.bind_storage(BINDING_STATISTICS);
    program.set("patch_count", patch_count_);
    program.dispatch(statistics_groups * 256);
    statistics_readback_.request(statistics_buffer_, statistics_buffer_.bytes());
    glm::dvec4 sum(0.0);
    for (const glm::vec4& p : statistics_readback_.take_as<glm::vec4>()) {
        sum += glm::dvec4(p);
    }
    return sum;
}

SolutionStatistics RadianceStore::statistics() const {
    statistics_.set("relevance", relevant_change);
    const glm::dvec4 sum = reduce(statistics_);
    SolutionStatistics result;
    result.distance = sum.z > 0.0 ? std::sqrt(sum.w / sum.z) : 0.0;
    result.settled = sum.x > 0.0 ? std::clamp(1.0 - std::sqrt(sum.y / sum.x), 0.0, 1.0) : 1.0;
    return result;
}

glm::dvec2 RadianceStore::take_scatter() const {
    scatter_.bind_storage(BINDING_SCATTER);
    measure_scatter_.set("scout_stride", scout_stride_);
    return glm::dvec2(reduce(measure_scatter_));
}

layout::Counters RadianceStore::take_counters() const {
    counters_readback_.request(counters_, sizeof(layout::Counters));
    clear_counters();
    return counters_readback_.take_as<layout::Counters>().front();
}

void RadianceStore::clear_counters() const {
    counters_.clear();
}

std::vector<glm::vec4> RadianceStore::read_irradiance() const {
    std::vector<glm::vec4> values(patch_count_);
    irradiance_.read<glm::vec4>(values);
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
    irradiance_.read(std::span(&value, 1), sizeof(glm::vec4) * patch);
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
    radiance_.read<glm::vec4>(values);
    std::vector<glm::vec3> result;
    result.reserve(values.size());
    for (const glm::vec4& value : values) {
        result.push_back(glm::vec3(value) * scene_.radiance_unit());
    }
    return result;
}

void RadianceStore::write_radiance(std::uint32_t patch, const glm::vec4& value) {
    radiance_.write<glm::vec4>(std::span(&value, 1), std::size_t{patch} * sizeof(glm::vec4));
}

std::size_t RadianceStore::bytes() const {
    std::size_t sum =
        (first_shot_ ? first_shot_->bytes() : 0) + (placed_ ? placed_->radiance.bytes() : 0);
    for (const Buffer* buffer :
         {&radiance_, &irradiance_, &source_, &accumulator_, &power_, &cdf_, &checkpoint_buffer_,
          &gloss_, &chain_, &sent_, &vertex_light_, &slopes_, &kept_, &since_}) {
        sum += buffer->bytes();
    }
    return sum;
}

}  // namespace raybundle
