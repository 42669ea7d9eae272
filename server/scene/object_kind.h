// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace raybundle {

/// What names say that an object is: of the node, its mesh and all below it, in English, German,
/// French, Spanish, Italian, Dutch and the classes of IFC. A word that tells a thing ("floor lamp",
/// "wall clock") makes it one.
ObjectKind kind_of_names(std::span<const std::string> names);

/// Whether a name is a number for programs: IFC's GlobalId, a UUID (both with "product-" and
/// "-body" of IfcConvert around them), or digits alone.
bool is_identifier(std::string_view name);

/// What people call an object: its own name, unless that is an identifier. Then what `others` say
/// (its mesh, its material, the class of IFC), the storey, and the first characters of the name:
/// "Wall, Ground floor, 2O2Fr$t4". path: names of its ancestors, the outermost first.
std::string readable_name(const std::string& name, std::span<const std::string> others,
                          std::span<const std::string> path);

/// The storey among the ancestors of an object, the innermost that is called one ("Level 1", "EG",
/// "2nd floor", "IfcBuildingStorey/..."), without its class; empty: none is.
std::string storey_of(std::span<const std::string> path);

}  // namespace raybundle
