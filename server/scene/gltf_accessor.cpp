// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

namespace raybundle {
namespace {

enum ComponentType {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

// Bounds what one accessor can make the loader allocate.
constexpr std::size_t max_elements = 25'000'000;

std::size_t component_size(int type) {
    switch (type) {
        case int8:
        case uint8:
            return 1;
        case int16:
        case uint16:
            return 2;
        case uint32:
        case float32:
            return 4;
        default:
            return 0;
    }
}

std::size_t component_count(std::string_view type) {
    if (type == "SCALAR") {
        return 1;
    }
    const auto n = static_cast<std::size_t>(type.back() - '0');
    return type.starts_with("MAT") ? n * n : n;
}

/// Bytes from one packed element to the next, and of one element alone. They differ for matrices,
/// whose columns start at multiples of four bytes.
struct ElementSize {
    std::size_t packed, alone;
};

ElementSize element_size(std::string_view type, std::size_t component_bytes) {
    if (!type.starts_with("MAT")) {
        const std::size_t bytes = component_count(type) * component_bytes;
        return {bytes, bytes};
    }
    const auto rows = static_cast<std::size_t>(type.back() - '0');
    const std::size_t column_bytes = (rows * component_bytes + 3) / 4 * 4;
    return {rows * column_bytes, (rows - 1) * column_bytes + rows * component_bytes};
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
        case int8: {
            const auto x = static_cast<float>(load<std::int8_t>(at));
            return normalized ? std::max(x / 127.0F, -1.0F) : x;
        }
        case uint8: {
            const auto x = static_cast<float>(load<std::uint8_t>(at));
            return normalized ? x / 255.0F : x;
        }
        case int16: {
            const auto x = static_cast<float>(load<std::int16_t>(at));
            return normalized ? std::max(x / 32767.0F, -1.0F) : x;
        }
        case uint16: {
            const auto x = static_cast<float>(load<std::uint16_t>(at));
            return normalized ? x / 65535.0F : x;
        }
        case uint32:
            return static_cast<float>(load<std::uint32_t>(at));
        default:
            return load<float>(at);
    }
}

std::uint32_t load_as_index(const std::uint8_t* at, int type) {
    switch (type) {
        case uint8:
            return load<std::uint8_t>(at);
        case uint16:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

bool is_index_type(int type) {
    return type == uint8 || type == uint16 || type == uint32;
}

/// The largest index of a type does not name a vertex (glTF 2.0, 3.7.2.1).
std::uint32_t restart_value(int type) {
    return type == uint8 ? 0xffU : type == uint16 ? 0xffffU : 0xffffffffU;
}

/// The two packed arrays of a sparse accessor: which elements, and their values.
struct SparseLayout {
    AccessorLayout indices, values;
};

SparseLayout sparse_layout(const Json& sparse, const AccessorLayout& base) {
    SparseLayout layout;
    layout.indices.count = sparse.at("count").get<std::size_t>();
    layout.indices.components = 1;
    layout.indices.component_type = sparse.at("indices").at("componentType").get<int>();
    layout.indices.component_bytes = component_size(layout.indices.component_type);
    layout.indices.element_bytes = layout.indices.stride = layout.indices.component_bytes;
    layout.indices.view = sparse.at("indices").at("bufferView").get<int>();
    layout.indices.offset = size_or(sparse.at("indices"), "byteOffset", 0);
    layout.values = base;
    layout.values.count = layout.indices.count;
    layout.values.stride = base.packed_bytes;
    layout.values.view = sparse.at("values").at("bufferView").get<int>();
    layout.values.offset = size_or(sparse.at("values"), "byteOffset", 0);
    return layout;
}

/// Alignment and range of one array in its view.
void check_layout(const GltfDocument& document, const std::string& path,
                  const AccessorLayout& layout) {
    if (layout.view < 0) {
        return;
    }
    const Json& view = document.item("bufferViews", layout.view);
    // Compressed views are decoded to memory of their own, where only the element matters.
    const std::size_t start = layout.offset + size_or(view, "byteOffset", 0);
    if (start % layout.component_bytes != 0 || layout.offset % layout.component_bytes != 0) {
        document.fail(path + ".byteOffset",
                      fmt::format("byte {} of the buffer is not aligned to {}-byte components",
                                  start, layout.component_bytes));
    }
    if (layout.stride < layout.element_bytes || layout.stride % layout.component_bytes != 0) {
        document.fail(
            item_path("bufferViews", static_cast<std::size_t>(layout.view)) + ".byteStride",
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

void check_sparse(const GltfDocument& document, const std::string& path, const Json& sparse,
                  const AccessorLayout& base) {
    const SparseLayout layout = sparse_layout(sparse, base);
    if (layout.indices.count > base.count) {
        document.fail(path + ".sparse.count", "is larger than the accessor's count");
    }
    if (!is_index_type(layout.indices.component_type)) {
        document.fail(path + ".sparse.indices.componentType", "must be an unsigned integer type");
    }
    check_layout(document, path + ".sparse.indices", layout.indices);
    check_layout(document, path + ".sparse.values", layout.values);
    const std::uint8_t* bytes =
        document.view_bytes(layout.indices.view).data() + layout.indices.offset;
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < layout.indices.count; ++i) {
        const std::uint32_t index =
            load_as_index(bytes + i * layout.indices.stride, layout.indices.component_type);
        if (index < next || index >= base.count) {
            document.fail(path + ".sparse.indices",
                          fmt::format("entry {} ({}) is out of order or range", i, index));
        }
        next = std::uint64_t{index} + 1;
    }
}

void check_accessor(const GltfDocument& document, int accessor) {
    const std::string path = item_path("accessors", static_cast<std::size_t>(accessor));
    const AccessorLayout layout = accessor_layout(document, accessor);
    if (layout.component_bytes == 0) {
        document.fail(path + ".componentType",
                      fmt::format("{} is no component type", layout.component_type));
    }
    if (layout.normalized && layout.component_type >= uint32) {
        document.fail(path + ".normalized", "32-bit components cannot be normalized");
    }
    if (layout.count > max_elements) {
        document.fail(path + ".count",
                      fmt::format("{} is more than the limit of {}", layout.count, max_elements));
    }
    check_layout(document, path, layout);
    if (const Json* sparse = find_member(document.item("accessors", accessor), "sparse")) {
        check_sparse(document, path, *sparse, layout);
    }
}

void read_elements(const GltfDocument& document, const AccessorLayout& layout,
                   std::vector<float>& out) {
    const std::uint8_t* bytes = document.view_bytes(layout.view).data() + layout.offset;
    for (std::size_t i = 0; i < layout.count; ++i) {
        for (std::size_t c = 0; c < layout.components; ++c) {
            out[i * layout.components + c] =
                load_as_float(bytes + i * layout.stride + c * layout.component_bytes,
                              layout.component_type, layout.normalized);
        }
    }
}

void apply_sparse(const GltfDocument& document, const Json& sparse, const AccessorLayout& base,
                  std::vector<float>& out) {
    const SparseLayout layout = sparse_layout(sparse, base);
    std::vector<float> values(layout.values.count * base.components);
    read_elements(document, layout.values, values);
    const std::uint8_t* bytes =
        document.view_bytes(layout.indices.view).data() + layout.indices.offset;
    for (std::size_t i = 0; i < layout.indices.count; ++i) {
        const std::size_t index =
            load_as_index(bytes + i * layout.indices.stride, layout.indices.component_type);
        for (std::size_t c = 0; c < base.components; ++c) {
            out[index * base.components + c] = values[i * base.components + c];
        }
    }
}

}  // namespace

AccessorLayout accessor_layout(const GltfDocument& document, int accessor) {
    const Json& json = document.item("accessors", accessor);
    const auto type = json.at("type").get<std::string>();
    AccessorLayout layout;
    layout.component_type = json.at("componentType").get<int>();
    layout.components = component_count(type);
    layout.component_bytes = component_size(layout.component_type);
    const ElementSize size = element_size(type, layout.component_bytes);
    layout.element_bytes = size.alone;
    layout.packed_bytes = size.packed;
    layout.count = json.at("count").get<std::size_t>();
    layout.offset = size_or(json, "byteOffset", 0);
    layout.normalized = value_or(json, "normalized", false);
    layout.view = index_or_none(json, "bufferView");
    layout.stride = layout.packed_bytes;
    if (layout.view >= 0) {
        layout.stride =
            size_or(document.item("bufferViews", layout.view), "byteStride", layout.packed_bytes);
    }
    return layout;
}

void check_accessors(const GltfDocument& document) {
    const auto count = static_cast<int>(document.array("accessors").size());
    for (int i = 0; i < count; ++i) {
        check_accessor(document, i);
    }
}

std::vector<float> read_floats(const GltfDocument& document, int accessor, std::size_t components,
                               const std::string& json_path) {
    const AccessorLayout layout = accessor_layout(document, accessor);
    if (layout.components != components) {
        document.fail(json_path, fmt::format("accessors[{}] has {} components, {} are expected",
                                             accessor, layout.components, components));
    }
    std::vector<float> values(layout.count * components);
    if (layout.view >= 0) {
        read_elements(document, layout, values);
    }
    if (const Json* sparse = find_member(document.item("accessors", accessor), "sparse")) {
        apply_sparse(document, *sparse, layout, values);
    }
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
    const AccessorLayout layout = accessor_layout(document, accessor);
    if (layout.components != 1 || !is_index_type(layout.component_type) || layout.normalized) {
        document.fail(json_path,
                      fmt::format("accessors[{}] must hold unsigned integers", accessor));
    }
    std::vector<std::uint32_t> indices(layout.count, 0);
    if (layout.view >= 0) {
        const std::uint8_t* bytes = document.view_bytes(layout.view).data() + layout.offset;
        for (std::size_t i = 0; i < layout.count; ++i) {
            indices[i] = load_as_index(bytes + i * layout.stride, layout.component_type);
        }
    }
    const Json* sparse = find_member(document.item("accessors", accessor), "sparse");
    if (sparse != nullptr) {
        const SparseLayout at = sparse_layout(*sparse, layout);
        const std::uint8_t* where = document.view_bytes(at.indices.view).data() + at.indices.offset;
        const std::uint8_t* what = document.view_bytes(at.values.view).data() + at.values.offset;
        for (std::size_t i = 0; i < at.indices.count; ++i) {
            const std::uint32_t index =
                load_as_index(where + i * at.indices.stride, at.indices.component_type);
            indices[index] = load_as_index(what + i * at.values.stride, layout.component_type);
        }
    }
    const std::uint32_t restart = restart_value(layout.component_type);
    const auto found = std::find(indices.begin(), indices.end(), restart);
    if (found != indices.end()) {
        document.fail(json_path, fmt::format("entry {} is {}, the primitive restart value",
                                             found - indices.begin(), restart));
    }
    return indices;
}

}  // namespace raybundle
