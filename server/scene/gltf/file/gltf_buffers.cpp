// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_buffers.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <utility>

#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr std::size_t max_buffer_bytes = 2ULL << 30U;
constexpr std::size_t max_decoded_bytes = 2ULL << 30U;

/// The preconditions that meshoptimizer asserts instead of reporting.
const char* meshopt_fault(const std::string& mode, const std::string& filter, std::size_t count,
                          std::size_t stride) {
    if (mode == "ATTRIBUTES") {
        if (stride % 4 != 0) {
            return "byteStride must be a multiple of 4";
        }
        const bool octahedral_fits = stride == 4 || stride == 8;
        if ((filter == "OCTAHEDRAL" && !octahedral_fits) ||
            (filter == "QUATERNION" && stride != 8)) {
            return "byteStride does not fit the filter";
        }
        return nullptr;
    }
    if (stride != 2 && stride != 4) {
        return "byteStride must be 2 or 4";
    }
    return mode == "TRIANGLES" && count % 3 != 0 ? "count must be a multiple of 3" : nullptr;
}

int decode_meshopt_stream(const std::string& mode, std::vector<std::uint8_t>& out,
                          std::size_t count, std::size_t stride, std::span<const std::uint8_t> in) {
    if (mode == "ATTRIBUTES") {
        return meshopt_decodeVertexBuffer(out.data(), count, stride, in.data(), in.size());
    }
    if (mode == "TRIANGLES") {
        return meshopt_decodeIndexBuffer(out.data(), count, stride, in.data(), in.size());
    }
    return meshopt_decodeIndexSequence(out.data(), count, stride, in.data(), in.size());
}

void apply_meshopt_filter(const std::string& filter, std::vector<std::uint8_t>& data,
                          std::size_t count, std::size_t stride) {
    if (filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(data.data(), count, stride);
    } else if (filter == "QUATERNION") {
        meshopt_decodeFilterQuat(data.data(), count, stride);
    } else if (filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(data.data(), count, stride);
    }
}

/// Where the compressed bytes of a view are.
tinygltf::BufferView compressed_range(const tinygltf::Value& compression) {
    tinygltf::BufferView range;
    range.buffer = integer_or(compression, "buffer", -1);
    range.byteOffset = static_cast<std::size_t>(integer_or(compression, "byteOffset", 0));
    range.byteLength = static_cast<std::size_t>(integer_or(compression, "byteLength", 0));
    return range;
}

}  // namespace

GltfBuffers::GltfBuffers(const std::string& file, const Json& buffers,
                         std::optional<std::vector<std::uint8_t>> glb_binary,
                         const std::vector<tinygltf::BufferView>& views) {
    load_buffers(file, buffers, std::move(glb_binary));
    slice_views(file, views);
}

void GltfBuffers::load_buffers(const std::string& file, const Json& buffers,
                               std::optional<std::vector<std::uint8_t>> glb_binary) {
    std::size_t total = 0;
    for (const Json& buffer : buffers) {
        const std::string path = item_path("buffers", buffers_.size());
        const auto length = buffer.at("byteLength").get<std::size_t>();
        total += length;
        if (total > max_buffer_bytes) {
            throw SceneError(file, path + ".byteLength",
                             fmt::format("buffers exceed {} bytes", max_buffer_bytes));
        }
        std::vector<std::uint8_t> bytes;
        if (const Json* uri = find_member(buffer, "uri")) {
            bytes =
                read_uri(file, path + ".uri", uri->get_ref<const std::string&>(), max_buffer_bytes);
        } else if (buffers_.empty() && glb_binary) {
            bytes = std::move(*glb_binary);
        } else {
            // A placeholder, as for what meshopt decodes to. Views of it are refused later.
            buffers_.emplace_back();
            continue;
        }
        if (bytes.size() < length) {
            throw SceneError(
                file, path,
                fmt::format("holds {} bytes, byteLength says {}", bytes.size(), length));
        }
        bytes.resize(length);
        buffers_.push_back(std::move(bytes));
    }
}

void GltfBuffers::slice_views(const std::string& file,
                              const std::vector<tinygltf::BufferView>& views) {
    for (const tinygltf::BufferView& view : views) {
        const std::string path = item_path("bufferViews", views_.size());
        const auto* compression = find_extension(view.extensions, "EXT_meshopt_compression");
        views_.push_back(compression == nullptr ? slice(file, path, view)
                                                : decode_meshopt(file, path, view, *compression));
    }
}

std::span<const std::uint8_t> GltfBuffers::slice(const std::string& file,
                                                 const std::string& json_path,
                                                 const tinygltf::BufferView& range) const {
    const std::vector<std::uint8_t>& buffer = item(buffers_, range.buffer);
    if (buffer.empty()) {
        throw SceneError(file, item_path("buffers", range.buffer) + ".uri",
                         "is missing, and there is no GLB binary chunk");
    }
    if (range.byteOffset > buffer.size() || range.byteLength > buffer.size() - range.byteOffset) {
        throw SceneError(
            file, json_path,
            fmt::format("bytes {} to {} are outside of the buffer's {} bytes", range.byteOffset,
                        range.byteOffset + range.byteLength, buffer.size()));
    }
    return std::span(buffer).subspan(range.byteOffset, range.byteLength);
}

std::span<const std::uint8_t> GltfBuffers::decode_meshopt(const std::string& file,
                                                          const std::string& json_path,
                                                          const tinygltf::BufferView& view,
                                                          const tinygltf::Value& compression) {
    const std::string path = json_path + ".extensions.EXT_meshopt_compression";
    const auto count = static_cast<std::size_t>(integer_or(compression, "count", 0));
    const auto stride = static_cast<std::size_t>(integer_or(compression, "byteStride", 0));
    const auto& mode = compression.Get("mode").Get<std::string>();
    const auto& filter = compression.Get("filter").Get<std::string>();  // empty if absent
    if (const char* fault = meshopt_fault(mode, filter, count, stride)) {
        throw SceneError(file, path, fault);
    }
    const std::size_t bytes = count * stride;
    if (bytes != view.byteLength) {
        throw SceneError(file, path, "count * byteStride differs from the view's byteLength");
    }
    decoded_bytes_ += bytes;
    if (decoded_bytes_ > max_decoded_bytes) {
        throw SceneError(file, path,
                         fmt::format("decoded data exceeds {} bytes", max_decoded_bytes));
    }
    std::vector<std::uint8_t>& out = decoded_.emplace_back(bytes);
    if (decode_meshopt_stream(mode, out, count, stride,
                              slice(file, path, compressed_range(compression))) != 0) {
        throw SceneError(file, path, "compressed data is corrupt");
    }
    apply_meshopt_filter(filter, out, count, stride);
    return out;
}

}  // namespace raybundle
