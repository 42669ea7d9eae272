// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <chrono>

#include "commands/command.h"
#include "journal/session_journal.h"
#include "scene/gltf_loader.h"

namespace raybundle {

LoadedScene load_scene(const Options& options) {
    return load_scene(options, [] {});
}

LoadedScene load_scene(const Options& options, const std::function<void()>& accepted) {
    const auto start = std::chrono::steady_clock::now();
    spdlog::info("reading {}", options.scene);
    SceneSettings settings;
    settings.metres_per_unit = metres_per_unit(options.unit);
    settings.sky_luminance = options.sky;
    settings.ies = options.ies;
    LoadedScene loaded;
    loaded.scene = load_gltf(options.scene, settings);
    loaded.digest = file_digest(options.scene).value_or("");
    accepted();
    TessellationSettings tessellation;
    tessellation.patch_size = options.patch_size;
    loaded.mesh = tessellate(loaded.scene, tessellation);
    loaded.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const std::string& notice : loaded.scene.notices) {
        spdlog::warn("{}: {}", loaded.scene.name, notice);
    }
    spdlog::info("{}: {} triangles, {} patches, {} objects, {} lights, {:.2f} s", loaded.scene.name,
                 loaded.scene.triangles.size(), loaded.mesh.patch_count(),
                 loaded.scene.objects.size(),
                 loaded.scene.lights.size() + loaded.scene.punctual_lights.size(), loaded.seconds);
    return loaded;
}

}  // namespace raybundle
