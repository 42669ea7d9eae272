// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gpu/egl_context.h"
#include "solution/gpu_scene.h"

namespace raybundle {
namespace {

// Of the picture of the environment that views show.
constexpr int background_width = 1024;
constexpr int background_height = 512;

}  // namespace

glm::vec3 GpuScene::sky_towards(const glm::vec3& direction) const {
    const glm::vec3 sum =
        environment_ ? uniform_sky_ + glm::vec3(environment_->radiance(glm::dvec3(direction)))
                     : uniform_sky_;
    return sum / radiance_unit_;
}

void GpuScene::set_background(layout::ViewParameters& view) const {
    view.sky = glm::vec4(uniform_sky_ / radiance_unit_, 1.0F / radiance_unit_);
    view.sun = glm::vec4(0.0F, 1.0F, 0.0F, 2.0F);
    view.sun_radiance = glm::vec4(0.0F);
    if (!environment_ || !environment_->draws_sources() || environment_->sources().empty()) {
        return;
    }
    const SkySource& sun = environment_->sources().front();
    const float sine = std::max(std::sin(sun.angular_radius), 1e-4F);
    view.sun = glm::vec4(glm::vec3(sun.direction), std::sqrt(1.0F - sine * sine));
    view.sun_radiance = glm::vec4(sun.illuminance / (glm::pi<float>() * sine * sine), 0.0F);
}

/// The environment as views show it, but for suns that are drawn as discs.
void GpuScene::upload_environment() {
    if (!environment_) {
        return;
    }
    const bool discs = environment_->draws_sources();
    constexpr float most = 1e30F;
    std::vector<glm::vec4> texels;
    texels.reserve(std::size_t{background_width} * background_height);
    for (int y = 0; y < background_height; ++y) {
        const double elevation = glm::pi<double>() * (0.5 - (y + 0.5) / background_height);
        for (int x = 0; x < background_width; ++x) {
            const double azimuth = glm::two_pi<double>() * ((x + 0.5) / background_width - 0.5);
            const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                       -std::cos(elevation) * std::cos(azimuth));
            const glm::dvec3 radiance =
                discs ? environment_->radiance(direction) : environment_->shown(direction);
            texels.emplace_back(glm::min(glm::vec3(radiance), most), 1.0F);
        }
    }
    environment_texture_ =
        create_texture_2d("environment", GL_RGBA32F, background_width, background_height);
    glTextureSubImage2D(environment_texture_.get(), 0, 0, 0, background_width, background_height,
                        GL_RGBA, GL_FLOAT, texels.data());
    glTextureParameteri(environment_texture_.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(environment_texture_.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(environment_texture_.get(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(environment_texture_.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    environment_bytes_ = texels.size() * sizeof(glm::vec4);
}

}  // namespace raybundle
