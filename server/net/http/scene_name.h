// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace raybundle {

/// Why a name cannot be that of a scene file in the server's folder; empty where it can. A name is
/// one path component of at most 128 bytes of UTF-8 without control characters, quotes or slashes,
/// does not begin with a dot and ends with .glb or .gltf.
std::string scene_name_problem(std::string_view name);

/// The same of a photometric file: ends with .ies or .ldt, in any case.
std::string photometry_name_problem(std::string_view name);

/// The name in "/photometry/NAME", likewise.
std::string_view photometry_of_path(std::string_view path);

/// The name in "/scenes/NAME", a path that has been decoded; empty for any other path.
std::string_view scene_of_path(std::string_view path);

}  // namespace raybundle
