// SPDX-License-Identifier: Apache-2.0
#include "scene/animation_script.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "scene/object_limits.h"

namespace raybundle {

namespace {

using Json = nlohmann::json;

constexpr double max_number = 1e9;
constexpr double max_time = 86400.0;
constexpr std::size_t max_keys = 1'000'000;
constexpr float smallest = 1e-6F;

/// A value of the file with its place in it.
struct Node {
    const Json& json;
    std::string path;
    const std::string& file;

    [[noreturn]] void refuse(const std::string& reason) const {
        throw ScriptError(file + ": " + (path.empty() ? "the script" : path) + ": " + reason);
    }
    [[nodiscard]] Node at(const std::string& key) const {
        return {json.at(key), path.empty() ? key : path + "." + key, file};
    }
    [[nodiscard]] Node at(std::size_t index) const {
        return {json.at(index), path + "[" + std::to_string(index) + "]", file};
    }
    [[nodiscard]] bool has(const char* key) const { return json.contains(key); }

    void require_fields(std::initializer_list<std::string_view> known) const {
        if (!json.is_object()) {
            refuse("must be an object");
        }
        for (const auto& [key, value] : json.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                at(key).refuse("is not known here");
            }
        }
    }

    [[nodiscard]] double number(double min, double max) const {
        const double value = json.is_number() ? json.get<double>() : std::nan("");
        if (!(value >= min && value <= max)) {
            refuse(fmt::format("must be a number from {} to {}", min, max));
        }
        return value;
    }

    [[nodiscard]] bool boolean() const {
        if (!json.is_boolean()) {
            refuse("must be true or false");
        }
        return json.get<bool>();
    }

    template <glm::length_t N>
    [[nodiscard]] glm::vec<N, float> vector(double min, double max) const {
        if (!json.is_array() || json.size() != static_cast<std::size_t>(N)) {
            refuse("must be an array of " + std::to_string(N) + " numbers");
        }
        glm::vec<N, float> result(0.0F);
        for (glm::length_t i = 0; i < N; ++i) {
            result[i] = static_cast<float>(at(static_cast<std::size_t>(i)).number(min, max));
        }
        return result;
    }
};

struct LightName {
    std::string name;
};

/// Index of what a key is about: by number (id) or name.
template <typename Named>
std::uint32_t find(const Node& node, const std::vector<Named>& all) {
    if (node.json.is_number_unsigned()) {
        const auto id = node.json.get<std::uint64_t>();
        if (id >= 1 && id <= all.size()) {
            return static_cast<std::uint32_t>(id - 1);
        }
    } else if (node.json.is_string()) {
        const auto name = node.json.get<std::string>();
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&name](const Named& one) { return one.name == name; });
        if (found != all.end()) {
            return static_cast<std::uint32_t>(found - all.begin());
        }
    }
    std::string names;
    for (const Named& one : all) {
        names += (names.empty() ? "" : ", ") + one.name;
    }
    node.refuse(node.json.dump() + " is not in the scene; there are: " + names);
}

/// All lights in the order of their numbers.
std::vector<LightName> light_names(const Scene& scene) {
    std::vector<LightName> names;
    for (const Light& light : scene.lights) {
        names.push_back({light.name});
    }
    for (const PunctualLight& light : scene.punctual_lights) {
        names.push_back({light.name});
    }
    return names;
}

/// The keys round a time and how far it is from the first to the second.
template <typename Keys>
auto between(const Keys& keys, double time) {
    const auto later = keys.upper_bound(time);
    const auto before = later == keys.begin() ? later : std::prev(later);
    const auto after = later == keys.end() ? before : later;
    const double span = after->first - before->first;
    const double share = span > 0.0 ? std::clamp((time - before->first) / span, 0.0, 1.0) : 0.0;
    return std::tuple(before->second, after->second, static_cast<float>(share));
}

template <typename Value>
std::vector<Value> between(const std::multimap<double, Value>& keys, double after, double until) {
    std::vector<Value> result;
    for (auto key = keys.upper_bound(after); key != keys.end() && key->first <= until; ++key) {
        result.push_back(key->second);
    }
    return result;
}

/// "[json.exception.parse_error.101] parse error at line 1 ..." without the bracket.
std::string without_exception_id(const std::string& what) {
    const std::size_t end = what.find("] ");
    return end == std::string::npos ? what : what.substr(end + 2);
}

Json parsed(const std::string& text, const std::string& name) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        throw ScriptError(name + ": " + without_exception_id(error.what()));
    }
}

}  // namespace

/// Reads the keys of a script.
class ScriptReader {
  public:
    ScriptReader(AnimationScript& script, const Scene& scene, const Camera& camera)
        : script_(script), scene_(scene), camera_(camera) {}

    void read(const Node& root) {
        root.require_fields({"framesPerSecond", "frames", "keys"});
        if (root.has("framesPerSecond")) {
            script_.frames_per_second_ = root.at("framesPerSecond").number(0.001, 1000.0);
        }
        if (!root.has("frames")) {
            root.refuse("needs \"frames\"");
        }
        const double frames = root.at("frames").number(1, AnimationScript::max_frames);
        if (frames != std::floor(frames)) {
            root.at("frames").refuse("must be a whole number");
        }
        script_.frames_ = static_cast<unsigned>(frames);
        if (!root.has("keys") || !root.json.at("keys").is_array() ||
            root.json.at("keys").size() > max_keys) {
            root.refuse("needs \"keys\", an array of at most 1000000");
        }
        const Node keys = root.at("keys");
        for (std::size_t i = 0; i < keys.json.size(); ++i) {
            read_key(keys.at(i));
        }
        for (const std::uint32_t object : script_.playback_.objects(scene_)) {
            if (script_.transforms_.contains(object)) {
                keys.refuse("object '" + scene_.objects[object].name +
                            "' has keys, and an animation moves it");
            }
        }
    }

  private:
    void read_key(const Node& key) {
        if (!key.json.is_object() || !key.has("time")) {
            key.refuse("must be an object with a \"time\"");
        }
        const double time = key.at("time").number(0.0, max_time);
        const int kinds = static_cast<int>(key.has("camera")) +
                          static_cast<int>(key.has("object")) + static_cast<int>(key.has("light")) +
                          static_cast<int>(key.has("material")) +
                          static_cast<int>(key.has("animation"));
        if (kinds != 1) {
            key.refuse("needs one of camera, object, light, material, animation");
        }
        if (key.has("camera")) {
            key.require_fields({"time", "camera"});
            read_camera(key.at("camera"), time);
        } else if (key.has("object")) {
            read_object(key, time);
        } else if (key.has("light")) {
            read_light(key, time);
        } else if (key.has("animation")) {
            read_animation(key, time);
        } else {
            read_material(key, time);
        }
    }

    void read_camera(const Node& node, double time) {
        node.require_fields({"eye", "target", "up", "verticalFov"});
        const auto earlier = script_.cameras_.upper_bound(time);
        Camera camera = earlier == script_.cameras_.begin() ? camera_ : std::prev(earlier)->second;
        if (node.has("eye")) {
            camera.eye = node.at("eye").vector<3>(-max_number, max_number);
        }
        if (node.has("target")) {
            camera.target = node.at("target").vector<3>(-max_number, max_number);
        }
        if (node.has("up")) {
            camera.up = node.at("up").vector<3>(-max_number, max_number);
        }
        if (node.has("verticalFov")) {
            camera.vertical_fov = static_cast<float>(node.at("verticalFov").number(0.001, 3.14));
        }
        const glm::vec3 sight = camera.target - camera.eye;
        if (glm::length(sight) < smallest) {
            node.refuse("target must differ from eye");
        }
        if (glm::length(glm::cross(sight, camera.up)) < smallest * glm::length(sight)) {
            node.refuse("up must not lie along the line of sight");
        }
        script_.cameras_.emplace(time, camera);
    }

    void read_object(const Node& key, double time) {
        key.require_fields({"time", "object", "translation", "rotation", "scale"});
        const std::uint32_t object = find(key.at("object"), scene_.objects);
        if (!scene_.objects[object].movable) {
            key.at("object").refuse("cannot be moved");
        }
        auto& keys = script_.transforms_[object];
        if (keys.empty()) {
            keys.emplace(0.0, scene_.objects[object].transform);
        }
        Transform transform = std::prev(keys.upper_bound(time))->second;
        if (key.has("translation")) {
            transform.translation = key.at("translation").vector<3>(-max_number, max_number);
        }
        if (key.has("rotation")) {
            const glm::vec4 q = key.at("rotation").vector<4>(-max_number, max_number);
            if (glm::length(q) < smallest) {
                key.at("rotation").refuse("must not be zero");
            }
            transform.rotation = glm::normalize(glm::quat(q.w, q.x, q.y, q.z));
        }
        if (key.has("scale")) {
            transform.scale = key.at("scale").vector<3>(-max_number, max_number);
            const glm::vec3 size = glm::abs(transform.scale);
            if (std::min({size.x, size.y, size.z}) < smallest) {
                key.at("scale").refuse("must not be zero");
            }
        }
        if (const std::string problem = problem_of(scene_, object, transform); !problem.empty()) {
            key.refuse(problem);
        }
        if (time == 0.0) {
            keys.erase(0.0);
        }
        keys.emplace(time, transform);
    }

    void read_light(const Node& key, double time) {
        key.require_fields({"time", "light", "intensity", "colour", "on"});
        LightEdit edit;
        edit.light = find(key.at("light"), light_names(scene_)) + 1;
        if (key.has("intensity")) {
            edit.intensity = static_cast<float>(key.at("intensity").number(0.0, max_number));
        }
        if (key.has("colour")) {
            edit.colour = key.at("colour").vector<3>(0.0, max_number);
            if (glm::length(*edit.colour) < smallest) {
                key.at("colour").refuse("must not be black");
            }
        }
        if (key.has("on")) {
            edit.on = key.at("on").boolean();
        }
        if (const std::string problem = problem_of(scene_, edit); !problem.empty()) {
            key.at("light").refuse(problem);
        }
        script_.lights_.emplace(time, edit);
    }

    void read_animation(const Node& key, double time) {
        key.require_fields({"time", "animation", "seconds", "speed", "loop"});
        static const std::vector<Animation> none;
        const std::uint32_t animation =
            find(key.at("animation"), scene_.animations ? scene_.animations->animations : none);
        ScriptPlayback::Play play = script_.playback_.at(scene_, animation, time);
        play.speed = key.has("speed") ? key.at("speed").number(-100.0, 100.0) : 1.0;
        if (key.has("seconds")) {
            play.seconds = key.at("seconds").number(0.0, max_time);
        }
        if (key.has("loop")) {
            play.loop = key.at("loop").boolean();
        }
        script_.playback_.add(animation, time, play);
    }

    void read_material(const Node& key, double time) {
        key.require_fields({"time", "material", "baseColour", "roughness", "metallic"});
        MaterialEdit edit;
        edit.material = find(key.at("material"), scene_.materials) + 1;
        if (key.has("baseColour")) {
            edit.base_colour = key.at("baseColour").vector<3>(0.0, 1.0);
        }
        if (key.has("roughness")) {
            edit.roughness = static_cast<float>(key.at("roughness").number(0.0, 1.0));
        }
        if (key.has("metallic")) {
            edit.metallic = static_cast<float>(key.at("metallic").number(0.0, 1.0));
        }
        if (const std::string problem = problem_of(scene_, edit); !problem.empty()) {
            key.at("material").refuse(problem);
        }
        script_.materials_.emplace(time, edit);
    }

    AnimationScript& script_;
    const Scene& scene_;
    const Camera& camera_;
};

void AnimationScript::require_json(const std::string& text, const std::string& name) {
    (void)parsed(text, name);
}

AnimationScript::AnimationScript(const std::string& text, const std::string& name,
                                 const Scene& scene, const Camera& camera) {
    try {
        const Json json = parsed(text, name);
        ScriptReader(*this, scene, camera).read({json, "", name});
    } catch (const Json::exception& error) {
        throw ScriptError(name + ": " + without_exception_id(error.what()));
    }
    if (cameras_.empty()) {
        cameras_.emplace(0.0, camera);
    }
}

Camera AnimationScript::camera_at(double time) const {
    const auto [a, b, share] = between(cameras_, time);
    Camera camera = a;
    camera.eye = glm::mix(a.eye, b.eye, share);
    camera.target = glm::mix(a.target, b.target, share);
    camera.up = glm::mix(a.up, b.up, share);
    camera.vertical_fov = glm::mix(a.vertical_fov, b.vertical_fov, share);
    return camera;
}

std::vector<std::uint32_t> AnimationScript::moving_objects() const {
    std::vector<std::uint32_t> objects;
    for (const auto& [object, keys] : transforms_) {
        objects.push_back(object);
    }
    return objects;
}

Transform AnimationScript::transform_at(std::uint32_t object, double time) const {
    const auto [a, b, share] = between(transforms_.at(object), time);
    Transform transform;
    transform.translation = glm::mix(a.translation, b.translation, share);
    transform.rotation = glm::slerp(a.rotation, b.rotation, share);
    transform.scale = glm::mix(a.scale, b.scale, share);
    return transform;
}

std::vector<LightEdit> AnimationScript::lights_between(double after, double until) const {
    return between(lights_, after, until);
}

std::vector<MaterialEdit> AnimationScript::materials_between(double after, double until) const {
    return between(materials_, after, until);
}

}  // namespace raybundle
