// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>
#include <string_view>

#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/other_file.h"

namespace raybundle {
namespace {

constexpr std::uint64_t max_image_file_bytes = 512ULL << 20U;
constexpr std::int64_t max_image_pixels = 64LL << 20U;

bool starts_with(std::span<const std::uint8_t> bytes, std::string_view magic,
                 std::size_t offset = 0) {
    return bytes.size() >= offset + magic.size() &&
           std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

/// OpenImageIO's name of the format. Only what glTF allows: other decoders need not meet bytes from
/// outside.
const char* format_of(std::span<const std::uint8_t> bytes) {
    if (starts_with(bytes, "\x89PNG")) {
        return "png";
    }
    if (starts_with(bytes, "\xff\xd8\xff")) {
        return "jpeg";
    }
    return starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8) ? "webp" : nullptr;
}

[[noreturn]] void fail_unknown_format(const GltfDocument& document, const std::string& path,
                                      std::span<const std::uint8_t> bytes) {
    if (starts_with(bytes, "\xabKTX 2")) {
        document.fail(path, "KTX2 images (KHR_texture_basisu) are not supported");
    }
    const std::string kind = other_file_kind(bytes);
    document.fail(path, "is not a PNG, JPEG or WebP image" + (kind.empty() ? "" : ": " + kind));
}

/// Grey, grey and alpha, RGB or RGBA to RGBA.
std::vector<std::uint8_t> expand_to_rgba(const std::vector<std::uint8_t>& pixels,
                                         std::size_t channels) {
    const std::size_t count = pixels.size() / channels;
    std::vector<std::uint8_t> rgba(count * 4);
    const bool grey = channels < 3;
    const bool has_alpha = channels == 2 || channels == 4;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* in = pixels.data() + i * channels;
        for (std::size_t c = 0; c < 3; ++c) {
            rgba[i * 4 + c] = in[grey ? 0 : c];
        }
        rgba[i * 4 + 3] = has_alpha ? in[channels - 1] : 255;
    }
    return rgba;
}

std::vector<std::uint8_t> image_bytes(const GltfDocument& document, int image,
                                      const std::string& path) {
    const tinygltf::Image& source = item(document.model().images, image);
    if (source.bufferView >= 0) {
        const std::span<const std::uint8_t> bytes = document.view_bytes(source.bufferView);
        return {bytes.begin(), bytes.end()};
    }
    return read_uri(document.path(), path + ".uri", source.uri, max_image_file_bytes);
}

void check_spec(const GltfDocument& document, const std::string& path,
                const OIIO::ImageSpec& spec) {
    const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
    if (spec.width < 1 || spec.height < 1 || pixels > max_image_pixels) {
        document.fail(path, fmt::format("{} x {} pixels; the limit is {} pixels", spec.width,
                                        spec.height, max_image_pixels));
    }
    if (spec.nchannels < 1 || spec.nchannels > 4) {
        document.fail(path, fmt::format("has {} channels", spec.nchannels));
    }
}

/// Reads the header of an image; its size is checked before a pixel is decoded.
std::unique_ptr<OIIO::ImageInput> open_image(const GltfDocument& document, const std::string& path,
                                             std::span<const std::uint8_t> bytes,
                                             OIIO::Filesystem::IOProxy* reader) {
    const char* format = format_of(bytes);
    if (format == nullptr) {
        fail_unknown_format(document, path, bytes);
    }
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    // The name only chooses the decoder: the bytes come from the reader, which has to be among the
    // hints (beside hints without it, OpenImageIO 2.4 forgets a reader given as an argument).
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&reader));
    auto input = OIIO::ImageInput::open(std::string("image.") + format, &hints);
    if (!input) {
        document.fail(path, fmt::format("cannot be decoded: {}", plain_message(OIIO::geterror())));
    }
    check_spec(document, path, input->spec());
    return input;
}

/// Bytes that it takes once decoded.
std::size_t decoded_bytes(const OIIO::ImageSpec& spec) {
    return 4 * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
}

/// Adds the image of a texture, where it has one.
void add_image(const GltfDocument& document, int texture, std::set<int>& images) {
    if (texture >= 0) {
        const tinygltf::Texture& entry = item(document.model().textures, texture);
        const auto* webp = find_extension(entry.extensions, "EXT_texture_webp");
        images.insert(webp == nullptr ? entry.source : integer_or(*webp, "source", entry.source));
    }
}

void add_image(const GltfDocument& document, const tinygltf::Material& material,
               const char* extension, const char* name, std::set<int>& images) {
    const auto* const value = find_extension(material.extensions, extension);
    if (value != nullptr && value->Has(name)) {
        add_image(document, integer_or(value->Get(name), "index", -1), images);
    }
}

/// Of the textures that materials are read from.
std::set<int> images_of_materials(const GltfDocument& document) {
    std::set<int> images;
    for (const tinygltf::Material& material : document.model().materials) {
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        for (const int texture : {pbr.baseColorTexture.index, pbr.metallicRoughnessTexture.index,
                                  material.normalTexture.index, material.emissiveTexture.index}) {
            add_image(document, texture, images);
        }
        add_image(document, material, "KHR_materials_pbrSpecularGlossiness", "diffuseTexture",
                  images);
        add_image(document, material, "KHR_materials_clearcoat", "clearcoatTexture", images);
        add_image(document, material, "KHR_materials_clearcoat", "clearcoatRoughnessTexture",
                  images);
    }
    return images;
}

}  // namespace

void check_image_sizes(const GltfDocument& document) {
    const std::vector<tinygltf::Image>& images = document.model().images;
    std::size_t total = 0;
    for (const int image : images_of_materials(document)) {
        if (image < 0 || static_cast<std::size_t>(image) >= images.size() ||
            (item(images, image).bufferView < 0 && !item(images, image).uri.starts_with("data:"))) {
            continue;
        }
        const std::string path = item_path("images", image);
        const std::vector<std::uint8_t> bytes = image_bytes(document, image, path);
        if (format_of(bytes) != nullptr) {
            OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
            total += decoded_bytes(open_image(document, path, bytes, &reader)->spec());
            document.check_image_sum(total, path);
        }
    }
}

std::vector<tinygltf::Image> read_images(const std::string& file, const Json& json) {
    std::vector<tinygltf::Image> images;
    for (const Json& entry : json) {
        const std::string path = item_path("images", images.size());
        tinygltf::Image& image = images.emplace_back();
        image.name = value_or(entry, "name", path);
        image.bufferView = value_or(entry, "bufferView", -1);
        if (const Json* uri = find_member(entry, "uri")) {
            image.uri = uri->get<std::string>();
            check_uri(file, path + ".uri", image.uri);
        } else if (image.bufferView < 0) {
            throw SceneError(file, path, "has neither uri nor bufferView");
        }
    }
    return images;
}

DecodedImage decode_image(const GltfDocument& document, int image) {
    const std::string path = item_path("images", image);
    const std::vector<std::uint8_t> bytes = image_bytes(document, image, path);
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    const auto input = open_image(document, path, bytes, &reader);
    const OIIO::ImageSpec& spec = input->spec();
    document.charge_image(decoded_bytes(spec), path);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(spec.width) *
                                     static_cast<std::size_t>(spec.height) * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) {
        document.fail(path, fmt::format("cannot be decoded: {}", plain_message(input->geterror())));
    }
    return {spec.width, spec.height, expand_to_rgba(pixels, channels)};
}

int image_of(const GltfDocument& document, int texture) {
    const tinygltf::Texture& entry = item(document.model().textures, texture);
    const std::string path = item_path("textures", texture);
    const auto* webp = find_extension(entry.extensions, "EXT_texture_webp");
    const int source = webp == nullptr ? entry.source : integer_or(*webp, "source", entry.source);
    const std::size_t image_count = document.model().images.size();
    if (source >= 0 && static_cast<std::size_t>(source) >= image_count) {
        document.fail(path + ".source", fmt::format("{} is out of range: the file has {} images",
                                                    source, image_count));
    }
    if (source < 0 && find_extension(entry.extensions, "KHR_texture_basisu") != nullptr) {
        document.fail(path + ".extensions.KHR_texture_basisu",
                      "KTX2 images (KHR_texture_basisu) are not supported, and there is no "
                      "fallback image");
    }
    return source;
}

float mean_of_channel(GltfDocument& document, const tinygltf::Value& extension, const char* name,
                      std::size_t channel, const std::string& what) {
    if (!extension.Has(name)) {
        return 1.0F;
    }
    try {
        const int image = image_of(document, integer_or(extension.Get(name), "index", -1));
        if (image < 0) {
            return 1.0F;
        }
        const DecodedImage decoded = decode_image(document, image);
        double sum = 0.0;
        for (std::size_t i = channel; i < decoded.rgba.size(); i += 4) {
            sum += decoded.rgba[i];
        }
        document.note(fmt::format("textures of {} are read as their means", what));
        const std::size_t texels = decoded.rgba.size() / 4;
        return static_cast<float>(sum / (255.0 * static_cast<double>(texels)));
    } catch (const SceneError& error) {
        document.note(fmt::format("a texture of {} is ignored: {}: {}", what, error.json_path(),
                                  error.reason()));
        return 1.0F;
    }
}

}  // namespace raybundle
