// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "solution/geometry/gpu_scene.h"
#include "solution/store/radiance_store.h"

namespace raybundle {

/// How noisy a stage of a special phase is; see change_noise.comp.
struct ChangeNoise {
    double change = 0.0;    ///< root mean square of the increments, relative to the irradiance
    double relative = 0.0;  ///< their standard error, relative to the increments
};

/// What a special iteration phase (ch. 7.4) keeps for every patch: the signed increments of the
/// irradiance with their measured variance, and the radiance that it sends. The store's buffers
/// must be bound where nothing else is said.
class ChangeStore {
  public:
    ChangeStore(const GpuScene& scene, RadianceStore& store);

    /// Copies surfaces as they are before they change; of this scene, or one with the same patches.
    void remember_surfaces(const GpuScene& scene) const;
    /// Multiplies the solution by a colour.
    void scale(const glm::vec3& factor) const;
    /// Sets what changed surfaces send more than before; `scale` is what the solution, and with it
    /// the light before, has been multiplied by. reflecting: materials whose reflection is another.
    void set_source(const glm::vec3& scale, std::span<const std::uint32_t> reflecting) const;

    /// Forgets all increments.
    void begin() const;
    /// Sends the changed radiance from now on, with selection probabilities proportional to it,
    /// until stop_sending().
    void send() const;
    void stop_sending() const { store_.stop_sending_other(); }
    /// Shooting points for it, as RadianceStore::choose_shooters(). Lambert: the glossy part of a
    /// change is left to the iterations that follow.
    [[nodiscard]] std::vector<layout::Shooter> choose_shooters(
        std::span<const glm::vec4> numbers) const;
    /// Sets the changed radiance to what is reflected of the increments so far; bundles: of the
    /// running stage.
    void reflect(unsigned bundles) const;

    /// A bundle, or the pair of one before and one after a move, has been transferred with the
    /// weight 1/bundles.
    void take(unsigned bundles) const;
    [[nodiscard]] ChangeNoise noise(unsigned bundles) const;
    /// Reflected flux of the increments of all stages that have ended, of either sign alike, over
    /// that of all light: how much the change may change further on.
    [[nodiscard]] double reflected_share() const;
    /// Ends a stage. unseen: share of its mean that may be missing altogether.
    void fold(unsigned bundles, float unseen) const;
    /// Adds the increments to the solution, whose weights shrink where these are uncertain.
    /// bundles_noise: 1 / bundles. most_weight: that any patch keeps.
    void correct(float bundles_noise, float most_weight) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    const GpuScene& scene_;
    RadianceStore& store_;
    unsigned patch_count_, block_count_;
    Buffer increments_, stage_, changed_, old_surfaces_;
    Texture2D changed_texture_;
    ShaderProgram scale_, source_, power_sum_, power_scan_, power_density_;
    ShaderProgram reflect_, take_, noise_, flux_, fold_, correct_;
};

}  // namespace raybundle
