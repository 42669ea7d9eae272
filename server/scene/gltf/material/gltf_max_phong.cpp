// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/material/gltf_max_phong.h"

#include <fmt/format.h>

#include <utility>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

class MaxPhongChecker {
  public:
    MaxPhongChecker(const std::string& file, std::string path)
        : file_(file), path_(std::move(path)) {}

    void check(const Json& max_phong) const {
        if (!max_phong.is_object()) {
            throw SceneError(file_, path_, "must be an object");
        }
        const Json& specular = member(max_phong, "specular");
        if (!specular.is_array() || specular.size() != 3) {
            throw SceneError(file_, path_ + ".specular", "must be an array of 3 numbers");
        }
        for (std::size_t c = 0; c < specular.size(); ++c) {
            check_number(specular[c], fmt::format("{}.specular[{}]", path_, c), 0.0F, 1.0F);
        }
        check_number(member(max_phong, "exponent"), path_ + ".exponent", MaxPhong::min_exponent,
                     MaxPhong::max_exponent);
    }

  private:
    [[nodiscard]] const Json& member(const Json& object, const char* key) const {
        const Json* found = find_member(object, key);
        if (found == nullptr) {
            throw SceneError(file_, path_ + "." + key, "is missing");
        }
        return *found;
    }

    void check_number(const Json& value, const std::string& path, float min, float max) const {
        if (!value.is_number()) {
            throw SceneError(file_, path, "must be a number");
        }
        const auto x = value.get<double>();
        if (!(x >= static_cast<double>(min) && x <= static_cast<double>(max))) {
            throw SceneError(file_, path, fmt::format("{} is not in [{}, {}]", x, min, max));
        }
    }

    const std::string& file_;
    std::string path_;
};

}  // namespace

void check_max_phong(const std::string& file, const Json& json) {
    const Json& materials = array_or_empty(json, "materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Json* at = &materials[i];
        for (const char* key : {"extras", "raybundle", "maxPhong"}) {
            at = at != nullptr && at->is_object() ? find_member(*at, key) : nullptr;
        }
        if (at != nullptr) {
            const std::string path = item_path("materials", i) + ".extras.raybundle.maxPhong";
            MaxPhongChecker(file, path).check(*at);
        }
    }
}

std::optional<MaxPhong> read_max_phong(const tinygltf::Value& extras) {
    if (!extras.Has("raybundle") || !extras.Get("raybundle").Has("maxPhong")) {
        return std::nullopt;
    }
    const tinygltf::Value& object = extras.Get("raybundle").Get("maxPhong");
    return MaxPhong{vector_or(object, "specular", glm::vec3(0.0F)),
                    number_or(object, "exponent", MaxPhong::min_exponent)};
}

}  // namespace raybundle
