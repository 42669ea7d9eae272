// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// A ray of light that leaves a lamp, another surface or the sky.
struct LightRay {
    glm::vec3 origin{0.0F};  ///< shifted world, m
    glm::vec3 direction{0.0F};
    glm::vec3 flux{0.0F};   ///< lm of a ray, over its density: the mean of all rays is what arrives
    bool punctual = false;  ///< of a punctual light, whose first shot sees through glass undimmed
};

/// Columns x, y and z of a frame about a unit vector z (Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited").
glm::mat3 frame_about(const glm::vec3& z);

/// What of a scene shines at its mirrors and glass: its lamps, which are emitting patches and
/// punctual lights (suns among them), or the others, which are patches that reflect and the sky.
/// Rays are aimed at the spheres round the specular objects, with the density of the whole mixture,
/// so that each is worth about the same. A snapshot of the present places and radiances.
class CausticLights {
  public:
    static constexpr std::size_t numbers_per_ray = 6;
    using Numbers = std::array<float, numbers_per_ray>;  ///< each uniform in [0, 1)

    enum class Kind { lamps, others };
    /// radiance: that sides send, cd/m². targets: boxes to aim at, shifted world.
    CausticLights(const GpuScene& scene, const PatchMesh& mesh, std::span<const glm::vec3> radiance,
                  Kind kind, std::span<const Bounds> targets);
    /// Whether no light can reach a target.
    [[nodiscard]] bool empty() const { return chances_.empty() || chances_.back() <= 0.0; }
    /// Nothing where the ray drawn carries nothing. Usable by any number of threads.
    [[nodiscard]] std::optional<LightRay> ray(const Numbers& numbers) const;

  private:
    struct Sphere {
        glm::vec3 centre{0.0F};
        float radius = 0.0F;
    };
    struct Emitter {
        glm::vec3 a{0.0F}, e1{0.0F}, e2{0.0F};  // a corner and two edges, m
        glm::vec3 normal{0.0F};
        glm::vec3 flux_density{0.0F};  // radiance times area
    };
    /// A direction and its density, 1/sr.
    struct Aim {
        glm::vec3 direction{0.0F};
        float density = 0.0F;
    };

    void add_emitters(const GpuScene& scene, const PatchMesh& mesh,
                      std::span<const glm::vec3> radiance);
    void add_punctual();
    void add_sky();
    [[nodiscard]] double target_discs() const;
    void add_chance(double flux);
    [[nodiscard]] float solid_angle(const Sphere& sphere, const glm::vec3& origin) const;
    [[nodiscard]] float reachable_share(const glm::vec3& origin) const;
    [[nodiscard]] Aim aim(const glm::vec3& origin, const glm::vec3* normal,
                          const Numbers& numbers) const;
    [[nodiscard]] std::optional<LightRay> from_emitter(const Emitter& emitter, double chance,
                                                       const Numbers& numbers) const;
    [[nodiscard]] std::optional<LightRay> from_point(const PlacedLight& light, double chance,
                                                     const Numbers& numbers) const;
    [[nodiscard]] std::optional<LightRay> from_far(const PlacedLight& light, double chance,
                                                   const Numbers& numbers) const;
    [[nodiscard]] std::optional<LightRay> from_sky(std::size_t cell, double chance,
                                                   const Numbers& numbers) const;
    [[nodiscard]] LightRay from_outside(const glm::vec3& direction, const glm::vec3& radiance,
                                        const Numbers& numbers) const;

    std::vector<Sphere> targets_;
    std::vector<Emitter> emitters_;
    std::vector<PlacedLight> punctual_;
    const GpuScene& scene_;
    std::vector<double> chances_;  // cumulative, of emitters, then of punctual lights or sky cells
    float diameter_;
    float offset_;  // m: so far in front of a surface rays start
};

}  // namespace raybundle
