// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scene/animation/scene_animations.h"

namespace raybundle {

/// Which of a scene's animations a script plays, and from when on. Times in s.
class ScriptPlayback {
  public:
    /// What a script says of an animation from a time on.
    struct Play {
        double seconds = 0.0;  ///< where in it
        double speed = 1.0;    ///< 0: it stands
        bool loop = false;
    };

    /// From `time` on, until the next one of that animation.
    void add(std::size_t animation, double time, const Play& play);
    /// Where an animation is by what has been added so far, in whole what it is then; nothing
    /// before its first one.
    [[nodiscard]] Play at(const Scene& scene, std::size_t animation, double time) const;

    /// Objects that are ever moved, sorted.
    [[nodiscard]] std::vector<std::uint32_t> objects(const Scene& scene) const;
    [[nodiscard]] std::map<std::uint32_t, Transform> objects_at(const Scene& scene,
                                                                double time) const;
    /// Puts what is deformed to where it is at a time, see pose_shapes().
    bool deform(Scene& scene, double time) const;
    /// Lights and materials that are not what they were at the time `before`; all where that is
    /// negative.
    [[nodiscard]] std::vector<LightEdit> lights_between(const Scene& scene, double before,
                                                        double time) const;
    [[nodiscard]] std::vector<MaterialEdit> materials_between(const Scene& scene, double before,
                                                              double time) const;

  private:
    /// Of those that have begun, the one that has begun last being the last.
    [[nodiscard]] std::vector<AnimationPlace> places(const Scene& scene, double time) const;

    std::map<std::size_t, std::map<double, Play>> plays_;
};

}  // namespace raybundle
