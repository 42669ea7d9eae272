// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gpu/gl_objects.h"
#include "scene/reflectance_table.h"
#include "scene/scene.h"

namespace raybundle {

/// The reflectance of a scene's materials for brdf.glsl: a record per material, and a table per
/// distinct BRDF. Importance is tabulated for the mean base colour of a material's texture.
class ReflectanceTables {
  public:
    /// Integrates the tables on the CPU, about 6 ms for each distinct glossy BRDF, and uploads
    /// them. Throws GpuError if they exceed what a buffer texture holds.
    explicit ReflectanceTables(const Scene& scene);

    void bind() const;  ///< the buffer texture, to UNIT_REFLECTANCE
    /// Macros that brdf.glsl wants for this scene: MAX_PHONG.
    [[nodiscard]] const std::vector<std::string>& defines() const { return defines_; }
    /// Whether any material has a specular lobe.
    [[nodiscard]] bool glossy() const { return glossy_; }

    /// The table that stands for a material.
    [[nodiscard]] const ReflectanceTable& table(std::size_t material) const {
        return tables_[table_of_material_[material]];
    }
    [[nodiscard]] std::size_t table_count() const { return tables_.size(); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    void upload(const Scene& scene);

    std::vector<ReflectanceTable> tables_;
    std::vector<std::size_t> table_of_material_;
    std::vector<std::string> defines_;
    bool glossy_ = false;
    Buffer buffer_;
    Texture2D texture_;
};

}  // namespace raybundle
