// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/caustic_rays.h"
#include "solution/gpu_scene.h"

namespace raybundle {

/// Light that lamps throw through mirrors and glass on other surfaces: a correction of what bundles
/// bring (solution/caustic_rays.h), as irradiance per patch, either sign. A progressive mean: every
/// batch of rays counts alike until something changes. It is kept apart from the mean of the random
/// iteration, whose source is its first reflection; pixels interpolate it over the vertices.
/// Deterministic. Exists only where GpuScene::caustics() says so.
class Caustics {
  public:
    static constexpr std::uint32_t batch_rays = 4096;
    static constexpr std::uint32_t first_rays = 4 * batch_rays;  ///< after a change

    /// Nothing is estimated yet. The mesh is copied where it is needed.
    Caustics(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
             std::uint64_t seed);

    /// Another batch. The patches' radiance takes on the difference. The solution's buffers are
    /// bound, and must be bound again.
    void refine();
    /// All light has been multiplied by this, the patches' radiance, too.
    void scale(const glm::vec3& factor);
    /// Objects are elsewhere: forgets all rays and traces first_rays. As refine().
    void restart();
    /// Materials have changed, and with them the patches' emission, cd/m². restart() has to follow.
    void update(const Scene& scene, std::span<const std::uint32_t> materials,
                std::span<const glm::vec3> emission);

    void bind() const;
    /// Irradiance per patch, radiance units, either sign.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const;
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    void trace(std::uint32_t rays);
    void reflect();

    const GpuScene& scene_;
    PatchMesh mesh_;  // without what tells colours
    CausticRays caustic_rays_;
    std::optional<CausticLights> lights_;  // of the present places
    std::vector<glm::dvec3> sums_;         // flux per patch, lm, of all rays
    std::vector<std::uint32_t> met_;       // patches, by the last batch
    std::vector<glm::vec4> deposits_;      // their sums, to be uploaded
    std::uint64_t seed_;
    std::uint64_t rays_ = 0;
    std::uint64_t changes_ = 0;
    glm::vec3 scale_{1.0F};  // of the radiance since the last estimate
    Buffer flux_, deposit_buffer_, irradiance_, radiance_, vertices_;
    Texture2D vertex_texture_;
    ShaderProgram deposit_, reflect_, interpolate_;
};

}  // namespace raybundle
