// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace raybundle {
namespace {

// Bounds what one accessor can make the loader allocate.
constexpr std::size_t max_elements = 25'000'000;

/// How the elements of an accessor, or of one array of a sparse accessor, lie in a buffer view.
struct Layout {
    int component_type = 0;  ///< TINYGLTF_COMPONENT_TYPE_...
    std::size_t components = 0;
    std::size_t component_bytes = 0;
    std::size_t element_bytes = 0;
    std::size_t count = 0;
    std::size_t offset = 0;  ///< bytes from the start of the view
    std::size_t stride = 0;  ///< bytes from element to element
    bool normalized = false;
    int view = -1;  ///< -1: all zeros, where not sparse
};

std::size_t component_count(const tinygltf::Accessor& accessor) {
    return static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
}

std::size_t column_count(int type) {
    switch (type) {
        case TINYGLTF_TYPE_MAT2:
            return 2;
        case TINYGLTF_TYPE_MAT3:
            return 3;
        case TINYGLTF_TYPE_MAT4:
            return 4;
        default:
            return 1;
    }
}

/// The layout of an accessor whose view has no stride. The columns of matrices start at multiples
/// of four bytes, which Accessor::ByteStride() leaves out.
Layout packed_layout(const tinygltf::Accessor& accessor) {
    Layout layout;
    layout.component_type = accessor.componentType;
    layout.components = component_count(accessor);
    layout.component_bytes = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const std::size_t columns = column_count(accessor.type);
    const std::size_t column_bytes = layout.components / columns * layout.component_bytes;
    const std::size_t padding = columns > 1 ? (4 - column_bytes % 4) % 4 : 0;
    layout.stride = columns * (column_bytes + padding);
    layout.element_bytes = layout.stride - padding;
    layout.count = accessor.count;
    layout.offset = accessor.byteOffset;
    layout.normalized = accessor.normalized;
    layout.view = accessor.bufferView;
    return layout;
}

Layout layout_of(const GltfDocument& document, const tinygltf::Accessor& accessor) {
    Layout layout = packed_layout(accessor);
    if (layout.view >= 0) {
        const std::size_t stride = item(document.model().bufferViews, layout.view).byteStride;
        layout.stride = stride > 0 ? stride : layout.stride;
    }
    return layout;
}

/// The two packed arrays of a sparse accessor: which elements, and their values.
Layout sparse_indices(const tinygltf::Accessor& accessor) {
    tinygltf::Accessor indices;
    indices.type = TINYGLTF_TYPE_SCALAR;
    indices.componentType = accessor.sparse.indices.componentType;
    indices.count = static_cast<std::size_t>(accessor.sparse.count);
    indices.byteOffset = static_cast<std::size_t>(accessor.sparse.indices.byteOffset);
    indices.bufferView = accessor.sparse.indices.bufferView;
    return packed_layout(indices);
}

Layout sparse_values(const tinygltf::Accessor& accessor) {
    Layout values = packed_layout(accessor);
    values.count = static_cast<std::size_t>(accessor.sparse.count);
    values.offset = static_cast<std::size_t>(accessor.sparse.values.byteOffset);
    values.view = accessor.sparse.values.bufferView;
    return values;
}

template <typename T>
T load(const std::uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

/// glTF 2.0, 3.6.2.2: signed normalised integers are clamped at -1.
float load_as_float(const std::uint8_t* at, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const auto x = static_cast<float>(load<std::int8_t>(at));
            return normalized ? std::max(x / 127.0F, -1.0F) : x;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
            const auto x = static_cast<float>(load<std::uint8_t>(at));
            return normalized ? x / 255.0F : x;
        }
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const auto x = static_cast<float>(load<std::int16_t>(at));
            return normalized ? std::max(x / 32767.0F, -1.0F) : x;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            const auto x = static_cast<float>(load<std::uint16_t>(at));
            return normalized ? x / 65535.0F : x;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return static_cast<float>(load<std::uint32_t>(at));
        default:
            return load<float>(at);
    }
}

std::uint32_t load_as_index(const std::uint8_t* at, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// The largest index of a type does not name a vertex (glTF 2.0, 3.7.2.1).
std::uint32_t restart_value(const Layout& layout) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << (8 * layout.component_bytes)) - 1);
}

/// Alignment and range of one array in its view.
void check_layout(const GltfDocument& document, const std::string& path, const Layout& layout) {
    if (layout.view < 0) {
        return;
    }
    // Compressed views are decoded to memory of their own, where only the element matters.
    const std::size_t start =
        layout.offset + item(document.model().bufferViews, layout.view).byteOffset;
    if (start % layout.component_bytes != 0 || layout.offset % layout.component_bytes != 0) {
        document.fail(path + ".byteOffset",
                      fmt::format("byte {} of the buffer is not aligned to {}-byte components",
                                  start, layout.component_bytes));
    }
    if (layout.stride < layout.element_bytes || layout.stride % layout.component_bytes != 0) {
        document.fail(item_path("bufferViews", layout.view) + ".byteStride",
                      fmt::format("{} does not fit the {}-byte elements of {}", layout.stride,
                                  layout.element_bytes, path));
    }
    const std::size_t end =
        layout.offset + (layout.count - 1) * layout.stride + layout.element_bytes;
    const std::size_t available = document.view_bytes(layout.view).size();
    if (end > available) {
        document.fail(path, fmt::format("needs {} bytes, bufferViews[{}] has {}", end, layout.view,
                                        available));
    }
}

/// First element of an array in its view.
const std::uint8_t* bytes_of(const GltfDocument& document, const Layout& layout) {
    return document.view_bytes(layout.view).data() + layout.offset;
}

std::vector<std::uint32_t> load_indices(const GltfDocument& document, const Layout& layout) {
    const std::uint8_t* bytes = bytes_of(document, layout);
    std::vector<std::uint32_t> indices(layout.count);
    for (std::size_t i = 0; i < layout.count; ++i) {
        indices[i] = load_as_index(bytes + i * layout.stride, layout.component_type);
    }
    return indices;
}

std::vector<float> load_floats(const GltfDocument& document, const Layout& layout) {
    const std::uint8_t* bytes = bytes_of(document, layout);
    std::vector<float> values(layout.count * layout.components);
    for (std::size_t i = 0; i < layout.count; ++i) {
        for (std::size_t c = 0; c < layout.components; ++c) {
            values[i * layout.components + c] =
                load_as_float(bytes + i * layout.stride + c * layout.component_bytes,
                              layout.component_type, layout.normalized);
        }
    }
    return values;
}

/// All values of an accessor by `load`, zeros where it has no view, sparse ones put in place.
template <typename T>
std::vector<T> load_all(const GltfDocument& document, const tinygltf::Accessor& accessor,
                        std::vector<T> (*load)(const GltfDocument&, const Layout&)) {
    const Layout layout = layout_of(document, accessor);
    std::vector<T> values = layout.view >= 0 ? load(document, layout)
                                             : std::vector<T>(layout.count * layout.components);
    if (accessor.sparse.isSparse) {
        const std::vector<std::uint32_t> elements =
            load_indices(document, sparse_indices(accessor));
        const std::vector<T> replaced = load(document, sparse_values(accessor));
        const auto n = static_cast<std::ptrdiff_t>(layout.components);
        for (std::size_t i = 0; i < elements.size(); ++i) {
            std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(i) * n, n,
                        values.begin() + static_cast<std::ptrdiff_t>(elements[i]) * n);
        }
    }
    return values;
}

void check_sparse(const GltfDocument& document, const std::string& path,
                  const tinygltf::Accessor& accessor) {
    const Layout indices = sparse_indices(accessor);
    if (indices.count > accessor.count) {
        document.fail(path + ".sparse.count", "is larger than the accessor's count");
    }
    if (!is_index_type(indices.component_type)) {
        document.fail(path + ".sparse.indices.componentType", "must be an unsigned integer type");
    }
    check_layout(document, path + ".sparse.indices", indices);
    check_layout(document, path + ".sparse.values", sparse_values(accessor));
    document.charge_components(indices.count, path + ".sparse");
    const std::vector<std::uint32_t> elements = load_indices(document, indices);
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i] < next || elements[i] >= accessor.count) {
            document.fail(path + ".sparse.indices",
                          fmt::format("entry {} ({}) is out of order or range", i, elements[i]));
        }
        next = std::uint64_t{elements[i]} + 1;
    }
}

void check_accessor(const GltfDocument& document, const tinygltf::Accessor& accessor,
                    const std::string& path) {
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT) {
        document.fail(path + ".componentType",
                      fmt::format("{} is no component type", accessor.componentType));
    }
    if (accessor.normalized && accessor.componentType >= TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        document.fail(path + ".normalized", "32-bit components cannot be normalized");
    }
    if (accessor.count > max_elements) {
        document.fail(path + ".count",
                      fmt::format("{} is more than the limit of {}", accessor.count, max_elements));
    }
    check_layout(document, path, layout_of(document, accessor));
    if (accessor.sparse.isSparse) {
        check_sparse(document, path, accessor);
    }
}

}  // namespace

void check_accessors(const GltfDocument& document) {
    const std::vector<tinygltf::Accessor>& accessors = document.model().accessors;
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        check_accessor(document, accessors[i], item_path("accessors", i));
    }
}

std::vector<float> read_floats(const GltfDocument& document, int accessor, std::size_t components,
                               const std::string& json_path) {
    const tinygltf::Accessor& source = item(document.model().accessors, accessor);
    if (component_count(source) != components) {
        document.fail(json_path, fmt::format("accessors[{}] has {} components, {} are expected",
                                             accessor, component_count(source), components));
    }
    document.charge_components(source.count * components, json_path);
    std::vector<float> values = load_all<float>(document, source, load_floats);
    const auto bad =
        std::find_if(values.begin(), values.end(), [](float x) { return !std::isfinite(x); });
    if (bad != values.end()) {
        const auto element = static_cast<std::size_t>(bad - values.begin()) / components;
        document.fail(json_path, fmt::format("accessors[{}] element {} is NaN or infinite",
                                             accessor, element));
    }
    return values;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor,
                                        const std::string& json_path) {
    const tinygltf::Accessor& source = item(document.model().accessors, accessor);
    if (source.type != TINYGLTF_TYPE_SCALAR || !is_index_type(source.componentType) ||
        source.normalized) {
        document.fail(json_path,
                      fmt::format("accessors[{}] must hold unsigned integers", accessor));
    }
    document.charge_components(source.count, json_path);
    std::vector<std::uint32_t> indices = load_all<std::uint32_t>(document, source, load_indices);
    const std::uint32_t restart = restart_value(packed_layout(source));
    const auto found = std::find(indices.begin(), indices.end(), restart);
    if (found != indices.end()) {
        document.fail(json_path, fmt::format("entry {} is {}, the primitive restart value",
                                             found - indices.begin(), restart));
    }
    return indices;
}

}  // namespace raybundle
