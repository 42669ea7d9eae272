// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/reference_cache.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "view/image/image_file.h"
#include "view/image/whole_file.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json json_of(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json json_of(const ReferenceKey& key) {
    return {{"scene", key.scene},
            {"eye", json_of(key.camera.eye)},
            {"target", json_of(key.camera.target)},
            {"up", json_of(key.camera.up)},
            {"verticalFov", key.camera.vertical_fov},
            {"size", {key.size.x, key.size.y}},
            {"pixelFilter", filter_name(key.filter)}};
}

/// The sidecar's content; null where there is none or it is no JSON object of ours.
Json read_sidecar(const std::string& exr) {
    std::ifstream stream(sidecar_of(exr));
    if (!stream) {
        return nullptr;
    }
    Json json = Json::parse(stream, nullptr, false);
    const bool ours = json.is_object() && json.contains("of") && json.contains("relativeError") &&
                      json.contains("mrse") && json.contains("samples") && json.contains("seed") &&
                      json.contains("seconds");
    return ours ? json : Json(nullptr);
}

ReferencePicture read_picture(const std::string& exr, glm::uvec2 size) {
    const LinearPicture file = read_exr(exr);
    if (file.width != static_cast<int>(size.x) || file.height != static_cast<int>(size.y)) {
        throw std::runtime_error(exr + ": is " + std::to_string(file.width) + "x" +
                                 std::to_string(file.height) + " pixels, not " +
                                 std::to_string(size.x) + "x" + std::to_string(size.y));
    }
    ReferencePicture result;
    result.radiance.assign(file.radiance.begin(), file.radiance.end());
    return result;
}

ReferencePicture read_with_sidecar(const std::string& exr, const ReferenceKey& key,
                                   const Json& sidecar) {
    ReferencePicture result = read_picture(exr, key.size);
    try {
        result.filter = key.filter;
        result.method = sidecar.value("method", "");
        result.noise = {sidecar.at("relativeError").get<double>(),
                        sidecar.at("mrse").get<double>()};
        result.samples = sidecar.at("samples").get<std::uint64_t>();
        result.seed = sidecar.at("seed").get<std::uint64_t>();
        result.seconds = sidecar.at("seconds").get<double>();
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(sidecar_of(exr) + ": is not as `raybundle accuracy` writes it");
    }
    if (!std::isfinite(result.noise->relative_rmse) || !(result.noise->relative_rmse >= 0.0)) {
        throw std::runtime_error(sidecar_of(exr) + ": relativeError is not an error");
    }
    return result;
}

}  // namespace

std::string sidecar_of(const std::string& exr) {
    return fs::path(exr).replace_extension(".json").string();
}

std::optional<ReferencePicture> load_cached_reference(const std::string& exr,
                                                      const ReferenceKey& key) {
    const Json sidecar = read_sidecar(exr);
    if (sidecar.is_null() || sidecar["of"] != json_of(key) || !fs::exists(exr)) {
        return std::nullopt;
    }
    return read_with_sidecar(exr, key, sidecar);
}

ReferencePicture load_named_reference(const std::string& exr, const ReferenceKey& key) {
    const Json sidecar = read_sidecar(exr);
    if (sidecar.is_null()) {
        return read_picture(exr, key.size);
    }
    for (const PixelFilter filter : {PixelFilter::centre, PixelFilter::box}) {
        ReferenceKey other = key;
        other.filter = filter;
        if (sidecar["of"] == json_of(other)) {
            return read_with_sidecar(exr, other, sidecar);
        }
    }
    throw std::runtime_error(exr + ": is of another scene, camera or size, says " +
                             sidecar_of(exr));
}

void save_reference(const std::string& exr, const ReferenceKey& key,
                    const ReferencePicture& reference) {
    std::vector<glm::vec4> pixels;
    pixels.reserve(reference.radiance.size());
    for (const glm::dvec3& value : reference.radiance) {
        pixels.emplace_back(value, 1.0);
    }
    // Never a new picture with old words, nor the other way round.
    std::error_code ignored;
    fs::remove(sidecar_of(exr), ignored);
    write_exr(exr, static_cast<int>(key.size.x), static_cast<int>(key.size.y), pixels);
    const ReferenceNoise noise = reference.noise.value_or(ReferenceNoise{});
    const Json json = {{"of", json_of(key)},
                       {"method", reference.method},
                       {"relativeError", noise.relative_rmse},
                       {"mrse", noise.mrse},
                       {"samples", reference.samples},
                       {"seed", reference.seed},
                       {"seconds", reference.seconds}};
    write_file(sidecar_of(exr), json.dump(2) + "\n");
}

}  // namespace raybundle
