// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// The rays of a bundle as its receivers look along them.
struct BundleRays {
    bool perspective = true;
    glm::vec3 source{
        0.0F};            ///< shooting point, or direction (unit) of parallel rays; shifted world
    float spread = 0.0F;  ///< m: how far from its own ray a receiver may look something up
};

/// What gathers from the running bundle besides the patches: the pixels of a viewer. The bundle's
/// parameters, textures and lists are bound when these are called.
class BundleReceiver {
  public:
    struct Context {
        Place place = Place::now;
        float sample_weight = 1.0F;           ///< of the sample in the means
        glm::vec3 constant_irradiance{0.0F};  ///< that the bundle does not carry, of every receiver
        bool special = false;                 ///< signed increments of a special phase
        /// Which of plan_differences() the bundle is one of; NO_PATCH: none, anything may change.
        std::uint32_t difference = NO_PATCH;
        std::uint32_t number = 0;     ///< of the bundle in its phase, the same at both places
        bool glossy_shooter = false;  ///< of a hemicube: its radiance depends on direction
        float window_pixel = 0.0F;    ///< size of a pixel of a layered bundle's window, m
        std::uint32_t seed = 0;       ///< of the solve
    };

    BundleReceiver() = default;
    BundleReceiver(const BundleReceiver&) = delete;
    BundleReceiver& operator=(const BundleReceiver&) = delete;
    virtual ~BundleReceiver() = default;

    /// The next iteration begins; what the last one brought is in the solution. Not in special
    /// phases; nothing is bound yet.
    virtual void begin_sample() {}
    virtual void receive_hemicube(const Context& context) = 0;
    virtual void receive_layers(const Context& context) = 0;
    /// Light of the sky through an opening; of normal iterations only.
    virtual void receive_opening(const Context& context) = 0;
    /// Of normal iterations only.
    virtual void receive_planes(const Context& context) = 0;
    /// A sample was not taken after all: its bundle had no room for all hits.
    virtual void discard_sample(const Context& context) = 0;
    /// The samples so far are of bundles that carried nothing but emission. BINDING_COMPLETION has
    /// what they lack, RadianceStore::complete_start().
    virtual void complete_start() {}
    /// Objects will move: what a first shot takes back of what they can reach.
    virtual void begin_moves() {}
    /// Lights have changed: what a first shot takes back of them as they were.
    virtual void begin_lights() {}
    /// Objects have moved: `Place::before` and `Place::now` differ from here to end_special().
    virtual void begin_special() = 0;
    /// The next pairs of bundles before and after the move, at most MOST_DIFFERENCES: receivers
    /// whose rays do not pass any of the boxes, which hold the objects at both places (shifted
    /// world), receive the same from both and may skip them.
    virtual void plan_differences(std::span<const BundleRays> bundles,
                                  std::span<const Bounds> boxes) = 0;
    /// Surfaces have changed: what has been received so far is multiplied by `scale`. reflecting:
    /// materials whose reflection is another. redraw: what is seen looks different by itself.
    virtual void begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                                bool redraw) = 0;
    /// The increments so far count less: there will be more bundles than planned.
    virtual void scale_special(float factor) = 0;
    /// All increments of the special phase have been received. bundles_noise: 1 / number of its
    /// bundles. most_weight: that anything keeps.
    virtual void end_special(float bundles_noise, float most_weight) = 0;
};

}  // namespace raybundle
