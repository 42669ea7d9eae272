// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/gltf/file/gltf_document.h"

namespace raybundle {

/// Checks component types, alignment, stride and ranges of all accessors and their sparse parts.
/// Throws SceneError.
void check_accessors(const GltfDocument& document);

/// All components of all elements, normalised integers converted, sparse values applied. Throws
/// SceneError at `json_path` if the accessor has another number of components or a value is NaN or
/// infinite.
std::vector<float> read_floats(const GltfDocument& document, int accessor, std::size_t components,
                               const std::string& json_path);

/// A scalar accessor of unsigned integers, as for triangle indices. Throws SceneError, also for the
/// primitive restart value.
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor,
                                        const std::string& json_path);

}  // namespace raybundle
