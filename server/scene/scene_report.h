// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "scene/contact/solid_shells.h"
#include "scene/mesh/geometry_defects.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// What `raybundle inspect` says about a scene beyond the scene itself.
struct SceneReport {
    std::size_t referenced_vertices = 0;  ///< of the file's triangles
    std::size_t textured_materials = 0;
    std::size_t double_sided_materials = 0;
    std::size_t texture_bytes = 0;  ///< decoded
    double area = 0.0;              ///< of all triangles, one side, m²
    EdgeDefects edges;
    std::optional<std::string> unit_hint;  ///< set where the size suggests a wrong unit
    std::vector<EnclosedLight> enclosed;   ///< lamps whose light does not get out
    std::size_t patches = 0;               ///< of the tessellation
    std::size_t patch_triangles = 0;
    std::size_t joined_triangles = 0;  ///< that share a patch with others
    std::size_t joined_patches = 0;    ///< patches of several triangles, fronts only
    std::size_t patch_vertices = 0;
};

/// Says so if a scene is larger than 1 km or smaller than 1 cm, and names the `--unit` that would
/// bring it to the size of a room or a building.
std::optional<std::string> unit_hint(const Bounds& bounds);

SceneReport make_scene_report(const Scene& scene, const PatchMesh& mesh);

/// For people: a summary, then lists of objects, materials, lights, cameras, textures and notices.
void print_scene_report(std::ostream& out, const Scene& scene, const SceneReport& report);

/// For scripts: the same as one JSON object.
nlohmann::json scene_report_json(const Scene& scene, const SceneReport& report);

}  // namespace raybundle
