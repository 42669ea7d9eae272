// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_air.h"

#include "scene/gltf/file/gltf_model.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

class AirReader {
  public:
    AirReader(const std::string& file, std::string path) : file_(file), path_(std::move(path)) {}

    [[nodiscard]] Medium read(const Json& json) const {
        if (!json.is_object()) {
            throw SceneError(file_, path_, "must be an object");
        }
        const std::optional<double> visibility = number(json, "visibility");
        const std::optional<double> extinction = number(json, "extinction");
        if (visibility.has_value() == extinction.has_value()) {
            throw SceneError(file_, path_, "must have one of visibility and extinction");
        }
        Medium medium;
        medium.extinction = visibility ? Medium::extinction_of(*visibility) : *extinction;
        medium.albedo = albedo(json);
        medium.anisotropy = number(json, "anisotropy").value_or(0.0);
        if (const std::string problem = problem_of(medium); !problem.empty()) {
            throw SceneError(file_, path_, problem);
        }
        return medium;
    }

  private:
    [[nodiscard]] std::optional<double> number(const Json& json, const char* key) const {
        const Json* found = find_member(json, key);
        if (found == nullptr) {
            return std::nullopt;
        }
        if (!found->is_number()) {
            throw SceneError(file_, path_ + "." + key, "must be a number");
        }
        return found->get<double>();
    }

    [[nodiscard]] glm::vec3 albedo(const Json& json) const {
        const Json* found = find_member(json, "albedo");
        if (found == nullptr) {
            return glm::vec3(1.0F);
        }
        if (found->is_number()) {
            return glm::vec3(found->get<float>());
        }
        glm::vec3 colour(0.0F);
        const bool three = found->is_array() && found->size() == 3;
        for (int c = 0; c < 3; ++c) {
            if (!three || !(*found)[static_cast<std::size_t>(c)].is_number()) {
                throw SceneError(file_, path_ + ".albedo", "must be a number or three");
            }
            colour[c] = (*found)[static_cast<std::size_t>(c)].get<float>();
        }
        return colour;
    }

    const std::string& file_;
    std::string path_;
};

}  // namespace

std::optional<Medium> read_air(const std::string& file, const Json& json) {
    const Json& scenes = array_or_empty(json, "scenes");
    const auto index = value_or<std::size_t>(json, "scene", 0);
    if (index >= scenes.size()) {
        return std::nullopt;
    }
    const Json* at = &scenes[index];
    for (const char* key : {"extras", "raybundle", "air"}) {
        at = at != nullptr && at->is_object() ? find_member(*at, key) : nullptr;
    }
    if (at == nullptr) {
        return std::nullopt;
    }
    return AirReader(file, item_path("scenes", index) + ".extras.raybundle.air").read(*at);
}

}  // namespace raybundle
