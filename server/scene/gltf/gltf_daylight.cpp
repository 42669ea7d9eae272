// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_daylight.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "scene/gltf/file/gltf_model.h"
#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/light/cie_sky.h"

namespace raybundle {
namespace {

constexpr std::uint64_t max_image_bytes = 512ULL << 20U;

struct NumberMember {
    const char* key;
    std::optional<float> Daylight::*member;
    double min, max;
};

constexpr std::array<NumberMember, 8> numbers = {{
    {"zenithLuminance", &Daylight::zenith_luminance, 0.0, 1e9},
    {"sunElevation", &Daylight::sun_elevation, 0.0, 90.0},
    {"sunAzimuth", &Daylight::sun_azimuth, -360.0, 360.0},
    {"sunIlluminance", &Daylight::sun_illuminance, 0.0, 1e9},
    {"sunDiameter", &Daylight::sun_diameter, 0.0, 10.0},
    {"groundAlbedo", &Daylight::ground_albedo, 0.0, 1.0},
    {"environmentRotation", &Daylight::environment_rotation, -360.0, 360.0},
    {"environmentScale", &Daylight::environment_scale, 0.0, 1e9},
}};

class Reader {
  public:
    Reader(const std::string& file, std::string path) : file_(file), path_(std::move(path)) {}

    Daylight read(const Json& json) const {
        if (!json.is_object()) {
            throw SceneError(file_, path_, "must be an object");
        }
        Daylight daylight;
        daylight.sky = text(json, "sky");
        daylight.environment = text(json, "environment");
        if (daylight.sky.has_value() == daylight.environment.has_value()) {
            throw SceneError(file_, path_, "must have one of sky and environment");
        }
        if (daylight.sky && cie_sky_type(*daylight.sky) == 0) {
            throw SceneError(file_, path_ + ".sky",
                             fmt::format("'{}' is none of {}", *daylight.sky, cie_sky_names()));
        }
        for (const NumberMember& row : numbers) {
            daylight.*row.member = number(json, row);
        }
        if (daylight.environment) {
            daylight.environment_bytes =
                read_uri(file_, path_ + ".environment", *daylight.environment, max_image_bytes);
        }
        return daylight;
    }

  private:
    [[nodiscard]] std::optional<std::string> text(const Json& json, const char* key) const {
        const Json* found = find_member(json, key);
        if (found == nullptr) {
            return std::nullopt;
        }
        if (!found->is_string()) {
            throw SceneError(file_, path_ + "." + key, "must be a text");
        }
        return found->get<std::string>();
    }

    [[nodiscard]] std::optional<float> number(const Json& json, const NumberMember& row) const {
        const Json* found = find_member(json, row.key);
        if (found == nullptr) {
            return std::nullopt;
        }
        const std::string path = path_ + "." + row.key;
        if (!found->is_number()) {
            throw SceneError(file_, path, "must be a number");
        }
        const auto value = found->get<double>();
        if (!(value >= row.min && value <= row.max)) {
            throw SceneError(file_, path,
                             fmt::format("{} is not in [{}, {}]", value, row.min, row.max));
        }
        return static_cast<float>(value);
    }

    const std::string& file_;
    std::string path_;
};

}  // namespace

Daylight read_daylight(const std::string& file, const Json& json) {
    const Json& scenes = array_or_empty(json, "scenes");
    const auto index = value_or<std::size_t>(json, "scene", 0);
    if (index >= scenes.size()) {
        return {};
    }
    const Json* at = &scenes[index];
    for (const char* key : {"extras", "raybundle", "daylight"}) {
        at = at != nullptr && at->is_object() ? find_member(*at, key) : nullptr;
    }
    return at == nullptr
               ? Daylight{}
               : Reader(file, item_path("scenes", index) + ".extras.raybundle.daylight").read(*at);
}

}  // namespace raybundle
