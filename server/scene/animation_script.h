// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/animation/script_playback.h"
#include "scene/edit/surface_edit.h"
#include "scene/scene.h"

namespace raybundle {

/// A script that cannot be used: file, JSON path, reason.
class ScriptError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Time-stamped changes of a scene, for an image sequence:
///
///     {"framesPerSecond": 25, "frames": 50, "keys": [
///       {"time": 0, "camera": {"eye": [2.7, 2.7, -7.5], "target": [2.7, 2.7, 2.7]}},
///       {"time": 2, "object": "short box", "translation": [0.5, 0, 0]},
///       {"time": 1, "light": "ceiling", "intensity": 800, "on": true},
///       {"time": 1, "material": "wall", "baseColour": [0.2, 0.5, 0.2], "roughness": 0.4},
///       {"time": 0.5, "animation": "door", "seconds": 0, "speed": 2, "loop": false}]}
///
/// Times in seconds. Cameras (also "up", "verticalFov" in radians) and objects ("translation",
/// "rotation" as x, y, z, w, "scale"; what is absent is as in the key before) move evenly from key
/// to key, objects from where they are at time 0. Lights ("intensity" in cd/m², "colour", "on") and
/// materials ("baseColour", "roughness", "metallic") change at their time. Animations of the file
/// play from their time on, from where they are unless "seconds" says where, and stand at a "speed"
/// of 0. Objects, lights and
/// materials by name or number (id).
class AnimationScript {
  public:
    static constexpr unsigned max_frames = 100000;

    /// What can be said of a script before there is a scene: throws ScriptError where it is no
    /// JSON.
    static void require_json(const std::string& text, const std::string& name);

    /// name: of the file, for messages. Throws ScriptError.
    AnimationScript(const std::string& text, const std::string& name, const Scene& scene,
                    const Camera& camera);

    [[nodiscard]] unsigned frames() const { return frames_; }
    [[nodiscard]] double time_of(unsigned frame) const { return frame / frames_per_second_; }
    [[nodiscard]] Camera camera_at(double time) const;
    /// Objects that ever move: index into Scene::objects.
    [[nodiscard]] std::vector<std::uint32_t> moving_objects() const;
    [[nodiscard]] Transform transform_at(std::uint32_t object, double time) const;
    /// Those with after < time <= until, in order of time.
    [[nodiscard]] std::vector<LightEdit> lights_between(double after, double until) const;
    [[nodiscard]] std::vector<MaterialEdit> materials_between(double after, double until) const;
    /// What the scene's animations do: apart from all of the above.
    [[nodiscard]] const ScriptPlayback& playback() const { return playback_; }

  private:
    friend class ScriptReader;
    template <typename Value>
    using Keys = std::multimap<double, Value>;

    double frames_per_second_ = 25.0;
    unsigned frames_ = 1;
    Keys<Camera> cameras_;
    std::map<std::uint32_t, Keys<Transform>> transforms_;
    Keys<LightEdit> lights_;
    Keys<MaterialEdit> materials_;
    ScriptPlayback playback_;
};

/// "frame_%04d.png" with a number in the place of its %d or %0Nd (N one digit). Throws ScriptError
/// where there is not exactly one.
std::string numbered_file(const std::string& pattern, unsigned number);

}  // namespace raybundle
