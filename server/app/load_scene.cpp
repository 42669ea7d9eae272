// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "app/load_scene.h"
#include "journal/session_journal.h"
#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/material/specular_surface.h"
#include "scene/scene_report.h"

namespace raybundle {

namespace {

constexpr std::uint64_t max_environment_bytes = 512ULL << 20U;

Daylight daylight_of(const Options& options) {
    Daylight daylight;
    if (!options.daylight.sky.text.empty() && !options.daylight.sky.luminance()) {
        daylight.sky = options.daylight.sky.text;
    }
    daylight.zenith_luminance = options.daylight.sky_zenith;
    daylight.sun_elevation = options.daylight.sun_elevation;
    daylight.sun_azimuth = options.daylight.sun_azimuth;
    daylight.sun_illuminance = options.daylight.sun_illuminance;
    daylight.sun_diameter = options.daylight.sun_diameter;
    daylight.ground_albedo = options.daylight.ground_albedo;
    daylight.environment_rotation = options.daylight.environment_rotation;
    daylight.environment_scale = options.daylight.environment_scale;
    if (!options.daylight.environment.empty()) {
        if (!options.daylight.sky.text.empty()) {
            throw UsageError("--environment: cannot be combined with --sky");
        }
        daylight.environment = options.daylight.environment;
        daylight.environment_bytes = read_file_bounded(
            options.daylight.environment, max_environment_bytes, options.daylight.environment, "");
    }
    return daylight;
}

/// Says what pictures lack of the air.
void note_air(Scene& scene) {
    const bool deflects =
        std::any_of(scene.materials.begin(), scene.materials.end(),
                    [](const Material& m) { return specular_kind(m) != SpecularKind::none; });
    if (deflects) {
        scene.notices.emplace_back(
            "the air dims what is seen in mirrors, coats and through glass, but what the air "
            "behind them scatters towards the eye is missing; --method path shows it");
    }
}

/// What the options say of the air, over what the file says.
void set_air(Scene& scene, const AirOptions& air) {
    if (air.fog && *air.fog == 0.0F) {
        scene.medium.reset();
        return;
    }
    if (!scene.medium && !air.fog) {
        if (air.fog_albedo || air.fog_anisotropy) {
            scene.notices.emplace_back(
                "fogAlbedo and fogAnisotropy change nothing: the scene's air is clear, and there "
                "is "
                "no fog");
        }
        return;
    }
    Medium medium = scene.medium.value_or(Medium{});
    if (air.fog) {
        medium.extinction = Medium::extinction_of(*air.fog);
    }
    medium.albedo = air.fog_albedo ? glm::vec3(*air.fog_albedo) : medium.albedo;
    medium.anisotropy = air.fog_anisotropy.value_or(static_cast<float>(medium.anisotropy));
    if (const std::string problem = problem_of(medium); !problem.empty()) {
        throw UsageError("--fog: " + problem);
    }
    scene.medium = medium;
}

}  // namespace

TessellationSettings tessellation_settings(const Options& options) {
    TessellationSettings settings;
    settings.patch_size = options.scene.patch_size;
    return settings;
}

LoadedScene load_scene(const Options& options) {
    return load_scene(options, [] {});
}

LoadedScene load_scene(const Options& options, const std::function<void()>& accepted) {
    const auto start = std::chrono::steady_clock::now();
    spdlog::info("reading {}", options.scene.file);
    SceneSettings settings;
    settings.metres_per_unit = metres_per_unit(options.scene.unit);
    settings.sky_luminance = options.daylight.sky.luminance();
    settings.daylight = daylight_of(options);
    settings.ies = options.scene.ies;
    LoadedScene loaded;
    loaded.scene = load_gltf(options.scene.file, settings);
    set_air(loaded.scene, options.air);
    if (loaded.scene.medium) {
        note_air(loaded.scene);
    }
    loaded.digest = file_digest(options.scene.file).value_or("");
    accepted();
    loaded.mesh = tessellate(loaded.scene, tessellation_settings(options));
    loaded.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const std::string& notice : loaded.scene.notices) {
        spdlog::warn("{}: {}", loaded.scene.name, notice);
    }
    if (const auto hint = unit_hint(loaded.scene.bounds)) {
        spdlog::warn("{}: {}", loaded.scene.name, *hint);
    }
    spdlog::info("{}: {} triangles, {} patches, {} objects, {} lights, {:.2f} s", loaded.scene.name,
                 loaded.scene.triangles.size(), loaded.mesh.patch_count(),
                 loaded.scene.objects.size(),
                 loaded.scene.lights.size() + loaded.scene.punctual_lights.size(), loaded.seconds);
    return loaded;
}

}  // namespace raybundle
