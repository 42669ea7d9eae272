// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/air/scattered_light.h"
#include "solution/geometry/gpu_scene.h"
#include "solution/geometry/patch_cells.h"
#include "solution/specular/caustic_rays.h"

namespace raybundle {

/// Light that lamps and all other surfaces throw through mirrors and glass on other surfaces: a
/// correction of what bundles bring (solution/specular/caustic_rays.h), as irradiance per patch,
/// either sign. A progressive mean: every batch of rays of lamps counts alike until something
/// changes; those of other surfaces, which send what the random iteration says by then, count the
/// more the later. Their light is smoother, and is spread over cells of patches that shrink as rays
/// add up. The correction is kept apart from the mean of the random iteration, whose source is its
/// first reflection; pixels interpolate it over the vertices. Deterministic. Exists only where
/// GpuScene::caustics() says so.
class Caustics {
  public:
    static constexpr std::uint32_t batch_rays = 4096;
    static constexpr std::uint32_t first_rays = 4 * batch_rays;  ///< after a change
    static constexpr std::uint32_t surface_interval = 4;  ///< batches for one of other surfaces
    static constexpr std::uint32_t surface_rays = 2 * batch_rays;  ///< of that

    /// Nothing is estimated yet. The mesh is copied where it is needed.
    Caustics(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
             std::uint64_t seed);

    /// Another batch. The patches' radiance takes on the difference. sent: that radiance, in
    /// radiance units; what is read of it is a batch old, so that nothing waits. The solution's
    /// buffers are bound, and must be bound again.
    void refine(const Buffer& sent);
    /// All light has been multiplied by this, the patches' radiance, too.
    void scale(const glm::vec3& factor);
    /// Objects are elsewhere: forgets all rays and traces first_rays of lamps; the light of other
    /// surfaces stays what it was until refine(). As refine().
    void restart();
    /// Materials have changed, and with them the patches' emission, cd/m². restart() has to follow.
    void update(const Scene& scene, std::span<const std::uint32_t> materials,
                std::span<const glm::vec3> emission);

    /// Takes over the estimates of another scene's caustics, from which this one differs by objects
    /// that have no size yet, or by materials and lamps; null: it had none. The patches' radiance
    /// is the other one's, too. refresh() or, after a change, scale() and restart() have to follow.
    void adopt(const Caustics* other);
    /// The estimates are others, and no light is. As refine().
    void refresh();

    void bind() const;
    /// Irradiance of patches, for one pass that takes it from there: the binding is shared.
    void bind_irradiance() const { irradiance_.bind_storage(BINDING_CAUSTIC_IRRADIANCE); }
    /// Irradiance per patch, radiance units, either sign.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const;
    [[nodiscard]] glm::vec3 read_irradiance(std::uint32_t patch) const;
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    /// Null where the air is clear.
    [[nodiscard]] const ScatteredLight* air() const { return air_ ? &*air_ : nullptr; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    void trace(std::uint32_t rays);
    void request(const Buffer& sent);
    void trace_surfaces(std::span<const glm::vec4> radiance);
    void scatter(std::span<const glm::vec4> radiance);
    [[nodiscard]] std::vector<glm::vec3> reflected(std::span<const glm::vec4> radiance) const;
    void upload_surfaces();
    void reflect();

    const GpuScene& scene_;
    PatchMesh mesh_;                           // without what tells colours
    std::optional<CausticRays> caustic_rays_;  // only where there are mirrors or glass
    PatchCells cells_;
    std::optional<ScatteredLight> air_;          // only where it scatters
    std::optional<CausticLights> lights_;        // of the present places
    std::vector<glm::dvec3> sums_;               // flux per patch, lm, of all rays of lamps
    std::vector<std::uint32_t> met_;             // patches, by the last batch
    std::vector<glm::vec4> deposits_;            // their sums, to be uploaded
    std::vector<glm::dvec3> surface_sums_;       // flux of other surfaces, times the batch's weight
    std::vector<std::uint32_t> surface_counts_;  // rays that have met each patch
    std::vector<glm::vec4> surface_flux_;        // spread, radiance units times m²; empty: none
    std::uint64_t surface_batches_ = 0;
    std::uint64_t seed_;
    std::uint64_t rays_ = 0;
    std::uint64_t batches_ = 0;
    std::uint64_t changes_ = 0;
    glm::vec3 scale_{1.0F};  // of the radiance since the last estimate
    float unit_ = 1.0F;      // of radiance, cd/m², at that time
    Readback readback_;
    Buffer flux_, deposit_buffer_, irradiance_, radiance_, vertices_;
    Texture2D vertex_texture_;
    ShaderProgram deposit_, reflect_, interpolate_;
};

}  // namespace raybundle
