// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "scene/light/environment.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// How a special iteration phase is carried out.
struct SpecialSettings {
    unsigned bundles = 8;        ///< of the difference; a quarter of them are parallel ones
    unsigned most_bundles = 32;  ///< twice or more of them where these prove noisy, up to so many
    unsigned bounces = 6;        ///< bundles that carry the change on to other surfaces
    float noise = 0.15F;         ///< standard error of the increments to be content with, relative
    float relevant_noise = 0.01F;  ///< or with this, relative to the irradiance, where it is more
    float most_weight = 1e30F;     ///< that any mean keeps, in samples
    bool scissored = true;         ///< transfer differences only where they are
    bool skipped = false;          ///< no phase at all: iterate on from the old solution
};

/// Where somebody waits for the first frame after a change: few bundles, and no carrying on, whose
/// noise would outweigh what it brings; the iterations that follow do it.
constexpr SpecialSettings interactive_special() {
    SpecialSettings settings;
    settings.most_bundles = settings.bundles;
    settings.bounces = 0;
    return settings;
}

/// What a scene emits: of patches radiance, cd/m², and lights without extent, the same ones before
/// and after a change.
struct Emission {
    std::span<const glm::vec3> patches;
    std::span<const PunctualLight> punctual;
    Sky sky{};
};

/// By which colour the solution is best multiplied when what is emitted changes: the weighted
/// median of the ratios, so that the least flux is left to be transferred (1 in doubt). Where all
/// emission changes alike nothing is left, and where the brightest light goes out nothing remains
/// of it, noise included. The sky counts with the area of the scene's bounds.
glm::vec3 common_scale(const Scene& scene, const PatchMesh& mesh, const Emission& before,
                       const Emission& after);

/// Whether some of the sky is to be transferred once the solution has been multiplied.
bool sky_left(const Sky& before, const Sky& after, const glm::vec3& scale);

/// Whether there is something to transfer once the solution has been multiplied.
bool anything_left(const Emission& before, const Emission& after, const glm::vec3& scale);

}  // namespace raybundle
