// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_max_phong.h"

#include <fmt/format.h>

namespace raybundle {
namespace {

class Reader {
  public:
    Reader(const GltfDocument& document, std::string path)
        : document_(document), path_(std::move(path)) {}

    /// The member `key` of an object in our own part of extras.
    [[nodiscard]] const Json& member(const Json& object, const char* key) const {
        const Json* found = find_member(object, key);
        if (found == nullptr) {
            document_.fail(path_ + "." + key, "is missing");
        }
        return *found;
    }

    [[nodiscard]] float number(const Json& value, const std::string& path, float min,
                               float max) const {
        if (!value.is_number()) {
            document_.fail(path, "must be a number");
        }
        const auto x = value.get<double>();
        if (!(x >= static_cast<double>(min) && x <= static_cast<double>(max))) {
            document_.fail(path, fmt::format("{} is not in [{}, {}]", x, min, max));
        }
        return static_cast<float>(x);
    }

    [[nodiscard]] MaxPhong read(const Json& object) const {
        if (!object.is_object()) {
            document_.fail(path_, "must be an object");
        }
        MaxPhong result;
        const Json& specular = member(object, "specular");
        const std::string specular_path = path_ + ".specular";
        if (!specular.is_array() || specular.size() != 3) {
            document_.fail(specular_path, "must be an array of 3 numbers");
        }
        for (int c = 0; c < 3; ++c) {
            result.specular[c] = number(specular[static_cast<std::size_t>(c)],
                                        fmt::format("{}[{}]", specular_path, c), 0.0F, 1.0F);
        }
        result.exponent = number(member(object, "exponent"), path_ + ".exponent",
                                 MaxPhong::min_exponent, MaxPhong::max_exponent);
        return result;
    }

  private:
    const GltfDocument& document_;
    std::string path_;
};

}  // namespace

std::optional<MaxPhong> read_max_phong(const GltfDocument& document, const Json& material,
                                       const std::string& path) {
    const Json* at = &material;
    for (const char* key : {"extras", "raybundle", "maxPhong"}) {
        at = at->is_object() ? find_member(*at, key) : nullptr;
        if (at == nullptr) {
            return std::nullopt;
        }
    }
    return Reader(document, path + ".extras.raybundle.maxPhong").read(*at);
}

}  // namespace raybundle
