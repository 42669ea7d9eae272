// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gl_objects.h"
#include "scene/material/reflectance_grid.h"
#include "scene/material/reflectance_table.h"
#include "scene/scene.h"

namespace raybundle {

/// A material's reflectance between surfaces: a mirror's is a wide lobe, since a random bundle
/// seldom meets the one direction in which it throws light, and then far too much. So is that of a
/// polished dielectric and of a smooth clear coat.
ReflectanceModel transported_model(const Material& material);

/// The reflectance of a scene's materials for brdf.glsl: a record per material, one for each place
/// in the grid of a material whose roughness or metalness is textured (ReflectanceGrid), and a
/// table per distinct BRDF. Mirrors reflect into a wide lobe here; what is seen in them,
/// SpecularRays tell. A polished material, or one below a smooth clear coat, has two sets of
/// records: its own, for pixels, lack the smooth lobe, which SpecularRays show, and those of its
/// patches have it wide.
/// Importance is tabulated for the mean base colour of a material's texture.
class ReflectanceTables {
  public:
    /// Integrates the tables on the CPU, about 6 ms for each distinct glossy BRDF, and uploads
    /// them. Throws GpuError if they exceed what a buffer texture holds.
    explicit ReflectanceTables(const Scene& scene);

    /// Whether a material as it is in the scene now needs no macro of GpuScene::defines() that the
    /// shaders were not compiled with, and no records that there are not.
    [[nodiscard]] bool covers(const Scene& scene, std::size_t material) const;
    /// Takes over a material that has changed; it must be covered.
    void update(const Scene& scene, std::size_t material);

    void bind() const;  ///< the buffer texture, to UNIT_REFLECTANCE
    /// Macros that brdf.glsl wants for this scene: MAX_PHONG, REFLECTANCE_TEXTURED, CLEAR_COAT.
    [[nodiscard]] const std::vector<std::string>& defines() const { return defines_; }
    /// Whether any material has a specular lobe.
    [[nodiscard]] bool specular() const { return specular_; }
    /// Whether a material's reflection depends on direction so much that the solution follows it
    /// there: more than gloss_threshold of the incident light goes where a Lambert surface of equal
    /// albedo would not send it. Below, only its albedo depends on the angle.
    [[nodiscard]] bool glossy(std::size_t material) const { return glossy_[material]; }
    [[nodiscard]] bool any_glossy() const { return any_glossy_; }
    static constexpr float gloss_threshold = 0.02F;
    /// Whether pixels of any glossy material know a lobe that is narrow enough for rays,
    /// shaders/material/lobe_sampling.glsl.
    [[nodiscard]] bool draws_lobes() const { return draws_lobes_; }

    /// Albedo of a record for light from everywhere alike, with this base colour.
    [[nodiscard]] glm::vec3 mean_albedo(std::size_t record, const glm::vec3& base_colour) const {
        return table(record).mean_albedo(make_brdf(models_[record], base_colour));
    }

    /// Where the metalness and roughness of a material come from; nothing: from its factors.
    [[nodiscard]] const std::optional<ReflectanceGrid>& grid(std::size_t material) const {
        return grids_[material];
    }
    /// Record of a patch where a texture of its material has this metalness and roughness; they do
    /// not matter where the material has no grid.
    [[nodiscard]] std::size_t patch_record(std::size_t material,
                                           const glm::vec2& metallic_roughness) const {
        const std::optional<ReflectanceGrid>& grid = grids_[material];
        return patch_record_[material] + (grid ? grid->nearest(metallic_roughness) : 0);
    }

    /// The table that stands for a record. Those of the materials come first.
    [[nodiscard]] const ReflectanceTable& table(std::size_t record) const {
        return tables_[table_of_record_[record]];
    }
    [[nodiscard]] std::size_t table_count() const { return tables_.size(); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    using Key = std::array<float, 16>;

    static Key key_of(const Brdf& brdf);
    void upload();
    std::size_t table_for(const Brdf& brdf);
    void replace_table(std::size_t record, const Brdf& brdf);
    std::size_t add_grid(const ReflectanceGrid& grid);
    bool fill_grid(const ReflectanceGrid& grid, const Scene& scene, const Material& source,
                   std::size_t first_record);
    void fill_material(const Scene& scene, std::size_t material);

    std::vector<ReflectanceTable> tables_;
    std::vector<Key> keys_;  // of the tables; those of grids match none
    std::vector<std::size_t> table_of_record_;
    std::vector<std::string> defines_;
    std::vector<ReflectanceModel> models_;               // of the records
    std::vector<std::optional<ReflectanceGrid>> grids_;  // of the materials, as the next three
    std::vector<std::size_t> first_record_;              // of a grid
    std::vector<std::size_t> patch_record_;              // of patches, the first of a grid
    std::vector<bool> glossy_;
    bool specular_ = false, any_glossy_ = false, draws_lobes_ = false;
    Buffer buffer_;
    Texture2D texture_;
};

}  // namespace raybundle
