// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/first_shot.h"

#include <algorithm>
#include <cmath>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"
#include "solution/direct/many_lamps.h"

namespace raybundle {

namespace {

constexpr float tie_share = 4e-6F;  // of the scene's diameter: closer surfaces coincide
/// Rays to lights that one invocation follows. llvmpipe ends an invocation's loops after 65 535
/// rounds, all loops together: 4000 boxes a ray are left.
constexpr unsigned most_rays = 16;

/// Parts along an edge of a patch: many patches are small ones, and many lights average over what
/// each of them misses.
unsigned divisions_of(std::uint32_t patches, std::size_t lights) {
    constexpr std::uint32_t many_patches = 100'000;
    constexpr std::size_t many_pairs = 160'000;
    return patches < many_patches && patches * lights < many_pairs ? 4 : 2;
}

/// A profile at the directions of shaders/solution/first_shot.glsl, cd.
void append_table(const IesProfile& profile, std::vector<float>& values) {
    for (int column = 0; column < IES_COLUMNS; ++column) {
        const double phi = glm::radians(2.5 * column);
        for (int row = 0; row < IES_ROWS; ++row) {
            const double theta = glm::radians(0.5 * row);
            const double across = std::sin(theta);
            values.push_back(static_cast<float>(profile.candela(
                {across * std::cos(phi), across * std::sin(phi), -std::cos(theta)})));
        }
    }
}

}  // namespace

FirstShot::FirstShot(const GpuScene& scene)
    : scene_(scene),
      ies_(profiles_of(scene.punctual_lights())),
      lights_("punctual lights", scene.punctual_lights().size() * sizeof(layout::PunctualData)),
      patches_("first shot", 2 * std::size_t{scene.patch_count()} * sizeof(glm::vec4)) {
    patches_.clear();
    std::vector<float> tables;
    for (const auto& profile : ies_) {
        append_table(*profile, tables);
    }
    if (!tables.empty()) {
        check_storage("ies profiles", tables.size() * sizeof(float));
        profiles_ = Buffer::from<float>("ies profiles", tables);
    }
    if (scene.many_lamps()) {
        many_ = std::make_unique<ManyLamps>(scene);
    } else {
        maps_.emplace(scene);
        shoot_ = ShaderProgram({"solution_first_shot.comp"}, scene.defines());
    }
}

FirstShot::~FirstShot() = default;
FirstShot::FirstShot(FirstShot&&) noexcept = default;

void FirstShot::remember(const FirstShot& other) {
    if (remembered_.bytes() == 0) {
        remembered_ = Buffer("first shot before", patches_.bytes());
    }
    glCopyNamedBufferSubData(other.patches_.get(), remembered_.get(), 0, 0,
                             static_cast<GLsizeiptr>(patches_.bytes()));
}

void FirstShot::remember_darkness() {
    if (remembered_.bytes() == 0) {
        remembered_ = Buffer("first shot before", patches_.bytes());
    }
    remembered_.clear();
}

void FirstShot::update(bool radiance_follows) {
    if (many_) {
        bind();
        many_->update(lights_, ies_, radiance_follows);
        return;
    }
    lights_.write(maps_->draw(), 0);
    const GlScope scope("first shot");
    bind();
    set_uniforms(shoot_);
    const unsigned divisions = divisions_of(scene_.patch_count(), scene_.punctual_lights().size());
    shoot_.set("patch_count", scene_.patch_count());
    shoot_.set("radiance_follows", radiance_follows);
    shoot_.set("divisions", divisions);
    dispatch(shoot_, scene_.patch_count(), most_rays / (divisions * divisions));
}

void FirstShot::dispatch(const ShaderProgram& program, std::size_t threads) const {
    dispatch(program, threads, most_rays);
}

void FirstShot::dispatch(const ShaderProgram& program, std::size_t threads,
                         unsigned most_lights) const {
    const auto lights = static_cast<unsigned>(scene_.punctual_lights().size());
    for (unsigned first = 0; first < lights; first += most_lights) {
        program.set("first_light", first);
        program.set("end_light", std::min(first + most_lights, lights));
        program.dispatch(threads);
    }
}

void FirstShot::bind() const {
    if (maps_) {
        maps_->bind();
    } else {
        many_->bind();
    }
    lights_.bind_storage(BINDING_PUNCTUAL);
    patches_.bind_storage(BINDING_FIRST_SHOT);
    if (profiles_.bytes() > 0) {
        profiles_.bind_storage(BINDING_IES);
    }
}

void FirstShot::set_uniforms(const ShaderProgram& program) const {
    program.set("punctual_count", static_cast<unsigned>(scene_.punctual_lights().size()));
    program.set("shadow_tie", tie_share * scene_.diameter());
}

std::vector<glm::vec3> FirstShot::read_irradiance() const {
    std::vector<glm::vec4> values(2 * std::size_t{scene_.patch_count()});
    patches_.read<glm::vec4>(values);
    std::vector<glm::vec3> irradiance;
    irradiance.reserve(scene_.patch_count());
    for (std::size_t i = 0; i < values.size(); i += 2) {
        irradiance.emplace_back(values[i]);
    }
    return irradiance;
}

glm::vec3 FirstShot::read_irradiance(std::uint32_t patch) const {
    glm::vec4 value(0.0F);
    patches_.read<glm::vec4>(std::span(&value, 1), 2 * sizeof(glm::vec4) * patch);
    return glm::vec3(value);
}

std::vector<glm::vec4> FirstShot::read_reflected() const {
    std::vector<glm::vec4> values(2 * std::size_t{scene_.patch_count()});
    patches_.read<glm::vec4>(values);
    std::vector<glm::vec4> reflected;
    reflected.reserve(scene_.patch_count());
    for (std::size_t i = 1; i < values.size(); i += 2) {
        reflected.push_back(values[i]);
    }
    return reflected;
}

std::size_t FirstShot::bytes() const {
    return (maps_ ? maps_->bytes() : many_->bytes()) + lights_.bytes() + patches_.bytes() +
           profiles_.bytes() + remembered_.bytes();
}

}  // namespace raybundle
