// SPDX-License-Identifier: Apache-2.0
#include "scene/animation/script_playback.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "scene/animation/shape_pose.h"

namespace raybundle {
namespace {

/// The places with one of them at the end.
std::vector<AnimationPlace> with_last(const std::vector<AnimationPlace>& places, std::size_t last) {
    std::vector<AnimationPlace> result = places;
    std::rotate(result.begin() + static_cast<std::ptrdiff_t>(last),
                result.begin() + static_cast<std::ptrdiff_t>(last) + 1, result.end());
    return result;
}

std::uint32_t number_of(const LightEdit& edit) {
    return edit.light;
}

std::uint32_t number_of(const MaterialEdit& edit) {
    return edit.material;
}

bool same(const LightEdit& a, const LightEdit& b) {
    const auto fields = [](const LightEdit& e) {
        return std::tie(e.intensity, e.colour, e.position, e.aim, e.rotation, e.inner_cone,
                        e.outer_cone);
    };
    return fields(a) == fields(b);
}

bool same(const MaterialEdit& a, const MaterialEdit& b) {
    return a.base_colour == b.base_colour && a.roughness == b.roughness && a.metallic == b.metallic;
}

/// edits: light_edits() or material_edits(). By number.
template <typename Edit, typename Edits>
std::map<std::uint32_t, Edit> edits_of(const Scene& scene, const std::vector<AnimationPlace>& all,
                                       const Edits& edits) {
    std::map<std::uint32_t, Edit> result;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const Edit& edit : edits(scene, with_last(all, i))) {
            result[number_of(edit)] = edit;
        }
    }
    return result;
}

template <typename Edit>
std::vector<Edit> new_ones(const std::map<std::uint32_t, Edit>& before,
                           const std::map<std::uint32_t, Edit>& now) {
    std::vector<Edit> result;
    for (const auto& [number, edit] : now) {
        const auto known = before.find(number);
        if (known == before.end() || !same(known->second, edit)) {
            result.push_back(edit);
        }
    }
    return result;
}

}  // namespace

void ScriptPlayback::add(std::size_t animation, double time, const Play& play) {
    plays_[animation][time] = play;
}

ScriptPlayback::Play ScriptPlayback::at(const Scene& scene, std::size_t animation,
                                        double time) const {
    const auto plays = plays_.find(animation);
    if (plays == plays_.end() || time < plays->second.begin()->first) {
        return {0.0, 0.0, false};
    }
    const auto& [begun, play] = *std::prev(plays->second.upper_bound(time));
    const double length = scene.animations->animations[animation].seconds;
    const double place = play.seconds + play.speed * (time - begun);
    const double wrapped = length > 0.0 ? place - length * std::floor(place / length) : 0.0;
    return {play.loop && play.speed != 0.0 ? wrapped : std::clamp(place, 0.0, length), play.speed,
            play.loop};
}

std::vector<AnimationPlace> ScriptPlayback::places(const Scene& scene, double time) const {
    std::multimap<double, AnimationPlace> begun;
    for (const auto& [animation, plays] : plays_) {
        const auto next = plays.upper_bound(time);
        if (next != plays.begin()) {
            begun.emplace(std::prev(next)->first,
                          AnimationPlace{animation, at(scene, animation, time).seconds});
        }
    }
    std::vector<AnimationPlace> result;
    for (const auto& [since, place] : begun) {
        result.push_back(place);
    }
    return result;
}

std::vector<std::uint32_t> ScriptPlayback::objects(const Scene& scene) const {
    std::set<std::uint32_t> result;
    for (const auto& [animation, plays] : plays_) {
        const std::vector<std::uint32_t>& moved = scene.animations->animations[animation].objects;
        result.insert(moved.begin(), moved.end());
    }
    return {result.begin(), result.end()};
}

std::map<std::uint32_t, Transform> ScriptPlayback::objects_at(const Scene& scene,
                                                              double time) const {
    std::map<std::uint32_t, Transform> result;
    const std::vector<AnimationPlace> all = places(scene, time);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const auto& [object, transform] : object_places(scene, with_last(all, i))) {
            result[object] = transform;
        }
    }
    return result;
}

bool ScriptPlayback::deform(Scene& scene, double time) const {
    return pose_shapes(scene, places(scene, time));
}

std::vector<LightEdit> ScriptPlayback::lights_between(const Scene& scene, double before,
                                                      double time) const {
    return new_ones(edits_of<LightEdit>(scene, places(scene, before), light_edits),
                    edits_of<LightEdit>(scene, places(scene, time), light_edits));
}

std::vector<MaterialEdit> ScriptPlayback::materials_between(const Scene& scene, double before,
                                                            double time) const {
    return new_ones(edits_of<MaterialEdit>(scene, places(scene, before), material_edits),
                    edits_of<MaterialEdit>(scene, places(scene, time), material_edits));
}

}  // namespace raybundle
