// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "gpu/gl_objects.h"
#include "scene/reflectance_table.h"
#include "scene/scene.h"

namespace raybundle {

/// The reflectance of a scene's materials for brdf.glsl: a record per material, and a table per
/// distinct BRDF. Mirrors reflect into a wide lobe here; what is seen in them, SpecularRays tell.
/// Importance is tabulated for the mean base colour of a material's texture.
class ReflectanceTables {
  public:
    /// Integrates the tables on the CPU, about 6 ms for each distinct glossy BRDF, and uploads
    /// them. Throws GpuError if they exceed what a buffer texture holds.
    explicit ReflectanceTables(const Scene& scene);

    /// Whether a material as it is in the scene now needs no macro of GpuScene::defines() that the
    /// shaders were not compiled with.
    [[nodiscard]] bool covers(const Scene& scene, std::size_t material) const;
    /// Takes over a material that has changed; it must be covered.
    void update(const Scene& scene, std::size_t material);

    void bind() const;  ///< the buffer texture, to UNIT_REFLECTANCE
    /// Macros that brdf.glsl wants for this scene: MAX_PHONG.
    [[nodiscard]] const std::vector<std::string>& defines() const { return defines_; }
    /// Whether any material has a specular lobe.
    [[nodiscard]] bool specular() const { return specular_; }
    /// Whether a material's reflection depends on direction so much that the solution follows it
    /// there: more than gloss_threshold of the incident light goes where a Lambert surface of equal
    /// albedo would not send it. Below, only its albedo depends on the angle.
    [[nodiscard]] bool glossy(std::size_t material) const {
        return table(material).mean_importance() > gloss_threshold;
    }
    [[nodiscard]] bool any_glossy() const { return any_glossy_; }
    static constexpr float gloss_threshold = 0.02F;

    /// Albedo of a material for light from everywhere alike, with this base colour.
    [[nodiscard]] glm::vec3 mean_albedo(std::size_t material, const glm::vec3& base_colour) const {
        return table(material).mean_albedo(make_brdf(models_[material], base_colour));
    }

    /// The table that stands for a material.
    [[nodiscard]] const ReflectanceTable& table(std::size_t material) const {
        return tables_[table_of_material_[material]];
    }
    [[nodiscard]] std::size_t table_count() const { return tables_.size(); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    void upload();
    std::size_t table_for(const Scene& scene, const Material& material);

    std::vector<ReflectanceTable> tables_;
    std::vector<std::array<float, 13>> keys_;  // of the tables
    std::vector<std::size_t> table_of_material_;
    std::vector<std::string> defines_;
    std::vector<ReflectanceModel> models_;
    bool specular_ = false, any_glossy_ = false;
    Buffer buffer_;
    Texture2D texture_;
};

}  // namespace raybundle
