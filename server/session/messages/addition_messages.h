// SPDX-License-Identifier: Apache-2.0
// What is added to a scene, and removed from it.
#pragma once

#include <string>
#include <vector>

#include "raybundle.pb.h"
#include "scene/mesh/mesh_growth.h"
#include "scene/scene.h"

namespace raybundle {

AddedLuminaire from_message(const v1::AddLuminaire& luminaire);

/// The luminaires of a field row by row, each with its number and name.
std::vector<v1::AddLuminaire> field_of(const Scene& scene, const v1::AddLuminaire& request);

/// Why a change that adds or removes a light cannot be made of this scene; empty where it can.
std::string problem_of(const Scene& scene, const v1::AddLuminaire& change);
/// Whether the light that a change adds or removes is there, with how it was made; what has never
/// been there is as the change makes it, but removed.
v1::AddLuminaire state_of_addition(const Scene& scene, const v1::AddLuminaire& change);
/// Makes a change without problem.
void apply(Scene& scene, const v1::AddLuminaire& change);

AddedObject from_message(const v1::AddObject& object);
/// The same for an object: what has never been there cannot be removed, and is added with its mesh.
std::string problem_of(const Scene& scene, const v1::AddObject& change);
v1::AddObject state_of_addition(const Scene& scene, const v1::AddObject& change);
void apply(Scene& scene, const v1::AddObject& change);
/// Whether a change adds an object that the scene has never had, so that its mesh grows.
bool grows(const Scene& scene, const v1::SceneChanged& change);
/// What a request adds, with its number, name and place.
v1::AddObject numbered(const Scene& scene, const v1::AddObject& request);
/// Why a change cannot be asked for, although it could be made: its subject has been removed, or is
/// to come back and has not been removed.
v1::Error problem_of_presence(const Scene& scene, const v1::SceneChanged& change);

/// A change as viewers hear of it: of what it has added or exchanged all that there is to know.
v1::SceneChanged announced(const Scene& scene, const v1::SceneChanged& change);

/// What has been removed is named so, and not as what was added once.
void name_removal(v1::SceneChanged& change);

/// What `welcome` says of the luminaires. message: has its lights.
void describe_luminaires(v1::Scene* message);

}  // namespace raybundle
