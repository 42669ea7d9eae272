// SPDX-License-Identifier: Apache-2.0
// Objects that are added to a scene which is shown: its mesh grows, and what was there stays.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// How an object was made that has been added.
struct AddedObject {
    std::uint32_t copy_of = 0;          ///< Object::id; 0: of a file
    std::string library;                ///< that file, of SceneFolder
    std::string name;                   ///< empty: that of what is copied, or of the file
    Transform transform;                ///< as Object::transform
    std::vector<Material> materials{};  ///< of the file, as Scene::materials got them
};

constexpr std::size_t max_added_objects = 1024;
/// Of all objects together; as TessellationSettings::max_patches.
constexpr std::size_t max_grown_patches = 4'000'000;

/// Why an object cannot be added; empty where it can. Reads no file.
std::string addition_problem(const Scene& scene, const PatchMesh& mesh, const AddedObject& added);

/// Adds an object, removed: its number is that of the last one then. Materials and textures of a
/// file come behind those that are there, all its objects become one; its cameras and lights
/// without extent are left out. Throws SceneError where a file cannot be read or is too large, with
/// nothing changed. A copy has the patches of what it is a copy of.
void add_object(Scene& scene, PatchMesh& mesh, const AddedObject& added);

/// What add_object() takes back.
struct GrowthMark {
    std::size_t vertices, triangles, objects, materials, textures;
};
GrowthMark mark_growth(const Scene& scene);
/// Takes back what has been added to the scene since; its mesh is to be replaced by an earlier one.
void take_back(Scene& scene, const GrowthMark& mark);

/// The part of a mesh that is one object's.
PatchMesh part_of(const PatchMesh& mesh, std::uint32_t object);
/// Adds another mesh, of other objects of the scene. Triangles, facets, sides of fronts and patches
/// that are fronts keep their numbers; those of backs follow on the new fronts.
void append(const PatchMesh& addition, const Scene& scene, PatchMesh& mesh);

}  // namespace raybundle
