// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "research/photon_map.h"

namespace raybundle {

struct PhotonSettings {
    std::uint32_t emitted = 1U << 16U;  ///< particles per pair of maps
    std::size_t nearest = 32;           ///< photons per estimate
    double radius = 0.05;               ///< largest, of the scene's diameter
    /// Lobes narrower than this (GGX alpha, or that of a max-Phong lobe of about the same width)
    /// are followed by rays and make caustics; light on other surfaces is kept in the maps.
    float sharp_alpha = 0.3F;
};

/// Whether a surface is followed by rays (S) or keeps photons (D).
inline bool is_sharp(const Scattering& scattering, const PhotonSettings& settings) {
    return !scattering.is_lambert() && scattering.brdf().lobe.alpha < settings.sharp_alpha;
}

/// The maps of Jensen 2001: all light on D surfaces, and the part that has come by S surfaces
/// alone, light path classes L(S|D)*D and LS+D.
struct PhotonMaps {
    PhotonMap global, caustic;
};

/// Independent maps for every number; the same for a seed and number whatever the threads do.
PhotonMaps trace_photons(const RayScene& scene, const LightSampling& lights,
                         const PhotonSettings& settings, std::uint64_t seed, std::uint64_t number);

}  // namespace raybundle
