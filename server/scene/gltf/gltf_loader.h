// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/light/daylight.h"
#include "scene/scene.h"

namespace raybundle {

/// A scene file that cannot be used: which file, where in it (JSON path such as
/// "meshes[2].primitives[0].indices", empty if the whole file), and why. Exit status 3.
class SceneError : public std::runtime_error {
  public:
    SceneError(std::string file, std::string json_path, std::string reason);
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] const std::string& json_path() const { return json_path_; }
    [[nodiscard]] const std::string& reason() const { return reason_; }

  private:
    std::string file_, json_path_, reason_;
};

struct SceneSettings {
    float metres_per_unit = 1.0F;           ///< --unit
    std::optional<float> sky_luminance;     ///< --sky, cd/m², of a uniform sky
    Daylight daylight;                      ///< --sky, --environment and what belongs to them
    float default_sky_luminance = 1000.0F;  ///< where a scene has no emitter at all, cd/m²
    std::vector<std::string> ies;           ///< --ies, LIGHT=FILE
};

/// Reads a .gltf or .glb file. Throws SceneError; never returns a half-read scene.
Scene load_gltf(const std::string& path, const SceneSettings& settings = {});

/// The same of the bytes of such a file; what it refers to is looked for beside `path`.
Scene load_gltf(const std::string& path, std::span<const std::uint8_t> bytes,
                const SceneSettings& settings = {});

}  // namespace raybundle
