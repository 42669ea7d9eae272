// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/gltf_document.h"

namespace raybundle {

/// How the elements of an accessor lie in its buffer view.
struct AccessorLayout {
    int component_type = 0;  ///< 5120 (int8) to 5126 (float)
    std::size_t components = 0;
    std::size_t component_bytes = 0;
    std::size_t element_bytes = 0;
    std::size_t packed_bytes = 0;  ///< element_bytes, for matrices padded to the next column
    std::size_t count = 0;
    std::size_t offset = 0;  ///< bytes from the start of the view
    std::size_t stride = 0;  ///< bytes from element to element
    bool normalized = false;
    int view = -1;  ///< -1: all zeros, where not sparse
};

/// The layout that an entry of "accessors" declares.
AccessorLayout accessor_layout(const GltfDocument& document, int accessor);

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
