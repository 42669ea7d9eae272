// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <utility>
#include <vector>

#include "raybundle.pb.h"
#include "scene/scene.h"
#include "scheduling/clock.h"

namespace raybundle {

/// What lamps shine with, by their numbers: see lamp_output().
using LampOutputs = std::map<std::uint32_t, glm::vec3>;

/// Lamps on their way to how the scene has them set. A fade is linear in light: each of the three
/// channels goes straight from what it was to what it shall be, so that a dimmer goes evenly and a
/// colour as if two lamps were mixed. The scene itself has the new setting at once; what the lamps
/// shine with meanwhile is ShownLamps'. Makes no change, and reads no clock.
class LightFades {
  public:
    /// A change has been made, which the scene has. shown: what the lamps of changes shone with
    /// before it. Begins the fade that it asks for; without one a change of a lamp's light ends
    /// what fades there. Other changes, as of its place, leave the fade be.
    void follow(const v1::SceneChanged& change, const LampOutputs& shown, const Scene& scene,
                TimePoint now);

    /// Goes on to a time. Returns the lamps that shine otherwise from now on; those that have come
    /// to their end do not fade any more.
    std::vector<std::uint32_t> advance(TimePoint now);

    [[nodiscard]] bool running() const { return !fades_.empty(); }
    /// Whether a step is worth its time: some fade has come to its end, or somebody watches.
    [[nodiscard]] bool due(TimePoint now, bool watched) const;
    /// Lamps that fade, in order.
    [[nodiscard]] std::vector<std::uint32_t> lamps() const;
    /// How often something has been shown otherwise, by advance() or follow().
    [[nodiscard]] std::uint64_t steps() const { return steps_; }

    /// What each of the lamps is shown with, in a scene that has them as they are set.
    [[nodiscard]] LampOutputs outputs(const Scene& scene) const;

    /// What runs at a time, for who comes late.
    void describe(TimePoint now, v1::Scene* message) const;

  private:
    struct Fade {
        glm::vec3 from{0.0F};
        TimePoint begun;
        double seconds = 0.0;
        float share = 0.0F;  ///< of the way, 0..1, as shown last
    };

    std::map<std::uint32_t, Fade> fades_;  // by number of the lamp
    std::uint64_t steps_ = 0;
};

/// While it lives, the lamps of the scene shine as they are shown; then again as they are set.
class ShownLamps {
  public:
    ShownLamps(Scene& scene, const LightFades& fades);
    ~ShownLamps();
    ShownLamps(const ShownLamps&) = delete;
    ShownLamps& operator=(const ShownLamps&) = delete;

  private:
    Scene& scene_;
    std::vector<std::pair<std::uint32_t, glm::vec3>> set_;
};

}  // namespace raybundle
