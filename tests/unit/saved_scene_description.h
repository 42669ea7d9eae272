// SPDX-License-Identifier: Apache-2.0
// Everything that people see of a scene, to compare it exactly.
#pragma once

#include <string>

#include "gltf_builder.h"
#include "scene/gltf/saved/scene_to_save.h"

namespace raybundle::test {

/// Objects, materials, lights, daylight, air and lighting scenes, by name and to the last bit;
/// without numbers, which close up where something has been removed, and without what a light
/// was in the file.
Json description_of(const Scene& scene);

/// The scene saved in the folder and loaded again.
Scene saved_and_loaded(const Scene& scene, const TemporaryFolder& folder);

/// The bytes of the saved scene.
std::string saved_bytes(const Scene& scene);

/// What is wrong with a GLB file, by the rules that validators check first; empty: nothing.
std::string glb_problem(const std::string& bytes);

}  // namespace raybundle::test
