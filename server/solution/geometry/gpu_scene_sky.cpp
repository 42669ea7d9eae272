// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "gpu/egl_context.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {
namespace {

// Of the picture of the environment that views show.
constexpr int background_width = 1024;
constexpr int background_height = 512;

}  // namespace

glm::vec3 GpuScene::sky_towards(const glm::vec3& direction) const {
    return glm::vec3(sky_.towards(glm::dvec3(direction))) / radiance_unit_;
}

glm::vec3 GpuScene::sky_change_towards(const glm::vec3& direction) const {
    const glm::dvec3 towards(direction);
    const glm::dvec3 change =
        sky_.towards(towards) - glm::dvec3(sky_factor_) * sky_before_.towards(towards);
    return glm::vec3(change) / radiance_unit_;
}

void GpuScene::set_background(layout::ViewParameters& view) const {
    view.sky = glm::vec4(sky_.uniform / radiance_unit_, 1.0F / radiance_unit_);
    view.sun = glm::vec4(0.0F, 1.0F, 0.0F, 2.0F);
    view.sun_radiance = glm::vec4(0.0F);
    const Environment* const environment = sky_.environment.get();
    if (environment == nullptr || !environment->draws_sources() || environment->sources().empty()) {
        return;
    }
    const SkySource& sun = environment->sources().front();
    const float sine = std::max(std::sin(sun.angular_radius), 1e-4F);
    view.sun = glm::vec4(glm::vec3(sun.direction), std::sqrt(1.0F - sine * sine));
    view.sun_radiance = glm::vec4(sun.illuminance / (glm::pi<float>() * sine * sine), 0.0F);
}

namespace {

/// An equirectangular picture of radiance over direction, cd/m².
Texture2D make_sky_texture(const std::string& label,
                           const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    constexpr float most = 1e30F;
    std::vector<glm::vec4> texels(std::size_t{background_width} * background_height);
    tbb::parallel_for(0, background_height, [&](int y) {
        const double elevation = glm::pi<double>() * (0.5 - (y + 0.5) / background_height);
        for (int x = 0; x < background_width; ++x) {
            const double azimuth = glm::two_pi<double>() * ((x + 0.5) / background_width - 0.5);
            const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                       -std::cos(elevation) * std::cos(azimuth));
            texels[static_cast<std::size_t>(y) * background_width + static_cast<std::size_t>(x)] =
                glm::vec4(glm::min(glm::vec3(radiance(direction)), most), 1.0F);
        }
    });
    Texture2D texture = create_texture_2d(label, GL_RGBA32F, background_width, background_height);
    glTextureSubImage2D(texture.get(), 0, 0, 0, background_width, background_height, GL_RGBA,
                        GL_FLOAT, texels.data());
    glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

/// The environment as views show it, but for suns that are drawn as discs, and as bundles carry it:
/// without its sources.
void GpuScene::upload_environment() {
    if (!sky_.environment) {
        return;
    }
    const Environment& environment = *sky_.environment;
    const auto carried = [&](const glm::dvec3& d) { return environment.radiance(d); };
    const auto shown = [&](const glm::dvec3& d) { return environment.shown(d); };
    constexpr std::size_t bytes =
        sizeof(glm::vec4) * std::size_t{background_width} * background_height;
    if (environment.draws_sources()) {
        environment_texture_ = make_sky_texture("environment", carried);
        carried_sky_texture_ = Texture2D();
        environment_bytes_ = bytes;
    } else {
        environment_texture_ = make_sky_texture("environment", shown);
        carried_sky_texture_ = make_sky_texture("environment without sources", carried);
        environment_bytes_ = 2 * bytes;
    }
}

/// Air and its box as constants of shaders/scene/air.glsl.
void GpuScene::define_air() {
    if (!medium_) {
        return;
    }
    const auto corner = [](const glm::vec3& p) {
        return fmt::format("vec3({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z);
    };
    defines_.emplace_back("MEDIUM 1");
    defines_.push_back(fmt::format("AIR_EXTINCTION float({:.9g})", medium_->extinction));
    defines_.push_back("AIR_LOW " + corner(air_box_.min));
    defines_.push_back("AIR_HIGH " + corner(air_box_.max));
}

}  // namespace raybundle
