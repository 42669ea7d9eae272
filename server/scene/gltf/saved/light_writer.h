// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/saved/node_writer.h"
#include "scene/gltf/saved/object_writer.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle {

/// Writes the lights of a scene that are no surfaces: as glTF's extensions say what shines now,
/// and beside it how they are set, dimmed and grouped.
class LightWriter {
  public:
    LightWriter(const SceneToSave& scene, const ObjectWriter& objects, NodeWriter& nodes,
                GlbParts& parts);

    void write();
    /// What the file calls lamps, by Light::id.
    [[nodiscard]] const std::map<std::uint32_t, Json>& names() const { return names_; }

  private:
    void write_file_light(std::size_t index);
    void write_added(const PunctualLight& light);
    /// The light's node: its own, or a new one where it has been moved.
    int place(std::size_t index, int node);
    int new_node(const PunctualLight& light, int parent);
    void shine(const PunctualLight& light, int node, const Json& before);
    Json photometric_use(const PunctualLight& light, const Json& before);
    Json punctual_use(const PunctualLight& light, const Json& before);
    std::size_t definition(const PunctualLight& light);
    [[nodiscard]] std::string photometric_file(const PunctualLight& light) const;
    void state(const PunctualLight& light, int node, const char* key);

    const SceneToSave& scene_;
    const ObjectWriter& objects_;
    NodeWriter& nodes_;
    GlbParts& parts_;
    std::map<std::string, std::size_t> definitions_;  // of photometric files, by path
    std::map<std::uint32_t, Json> names_;
    std::size_t written_ = 0;
};

}  // namespace raybundle
