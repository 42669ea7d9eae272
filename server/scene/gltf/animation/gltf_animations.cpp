// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/animation/gltf_animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "scene/gltf/animation/animation_pointer.h"
#include "scene/gltf/file/gltf_accessor.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

// Derived: hours of 60 keys a second of tens of nodes; each step looks at all channels, each key
// takes up to 52 bytes.
constexpr std::size_t most_animations = 1000;
constexpr std::size_t most_channels = 10'000;       // of all animations
constexpr std::size_t most_track_keys = 4'000'000;  // likewise
constexpr float longest_track = 86400.0F;

std::size_t components_of(AnimatedValue value) {
    switch (value) {
        case AnimatedValue::translation:
        case AnimatedValue::scale:
        case AnimatedValue::colour:
        case AnimatedValue::emissive_factor:
            return 3;
        case AnimatedValue::rotation:
        case AnimatedValue::base_colour:
            return 4;
        default:
            return 1;
    }
}

class AnimationReader {
  public:
    AnimationReader(GltfDocument& document, const GltfNodeTree& tree)
        : document_(document), tree_(tree) {
        result_.moved.resize(tree.nodes.size());
        result_.morphed.resize(tree.nodes.size());
        if (const Json* extension = document.extension("KHR_lights_punctual")) {
            lights_ = array_or_empty(*extension, "lights").size();
        }
    }

    FileAnimations read() {
        const Json& all = document_.animations();
        const std::size_t count = all.is_array() ? all.size() : 0;
        if (!all.is_array()) {
            leave_out("animations", "must be an array", "they are left out");
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (i == most_animations) {
                leave_out("animations", fmt::format("more than {}", most_animations),
                          "the others are left out");
                break;
            }
            read_whole(all[i], i);
        }
        return std::move(result_);
    }

  private:
    void leave_out(const std::string& path, const std::string& reason, const std::string& what) {
        document_.note(fmt::format("{}: {}: {}", path, reason, what));
    }

    /// One animation, or nothing of it.
    void read_whole(const Json& source, std::size_t index) {
        const std::size_t tracks = result_.tracks.size();
        try {
            tracks_of_samplers_.clear();
            FileAnimation animation = read_one(source, item_path("animations", index), index);
            if (animation.channels.empty()) {
                return;
            }
            for (const FileChannel& channel : animation.channels) {
                if (channel.value <= AnimatedValue::scale) {
                    result_.moved[channel.target] = true;
                }
                if (channel.value == AnimatedValue::morph_weights) {
                    result_.morphed[channel.target] = true;
                }
            }
            result_.animations.push_back(std::move(animation));
        } catch (const SceneError& error) {
            result_.tracks.resize(tracks);
            leave_out(error.json_path(), error.reason(), "the animation is left out");
        }
    }

    FileAnimation read_one(const Json& source, const std::string& path, std::size_t index) {
        if (!source.is_object()) {
            document_.fail(path, "must be an object");
        }
        FileAnimation animation;
        animation.name = name_of(source, path, index);
        const Json& channels = array_of(source, path, "channels");
        channels_ += channels.size();
        if (channels_ > most_channels) {
            document_.fail(path + ".channels",
                           fmt::format("more than {} channels in all", most_channels));
        }
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const std::string channel_path = path + "." + item_path("channels", c);
            const auto target = target_of(channels[c], channel_path);
            if (target) {
                FileChannel channel{target->value, target->index, 0};
                channel.track = track_of(source, path, channels[c], channel_path, *target);
                animation.seconds =
                    std::max(animation.seconds, double{result_.tracks[channel.track].times.back()});
                animation.channels.push_back(channel);
            }
        }
        return animation;
    }

    std::string name_of(const Json& source, const std::string& path, std::size_t index) {
        std::string name = fmt::format("animation {}", index + 1);
        if (const Json* given = find_member(source, "name")) {
            if (!given->is_string()) {
                document_.fail(path + ".name", "must be a string");
            }
            name = given->get<std::string>().empty() ? name : given->get<std::string>();
        }
        const std::string first = name;
        for (int n = 2; !names_.insert(name).second; ++n) {
            name = fmt::format("{} ({})", first, n);
        }
        return name;
    }

    const Json& array_of(const Json& source, const std::string& path, const char* key) {
        const Json* array = find_member(source, key);
        if (array == nullptr || !array->is_array() || array->empty()) {
            document_.fail(path + "." + key, "must be an array that is not empty");
        }
        return *array;
    }

    std::size_t index_of(const Json& source, const std::string& path, const char* key,
                         std::size_t count) {
        const Json* index = find_member(source, key);
        if (index == nullptr || !index->is_number_unsigned()) {
            document_.fail(path + "." + key, "must be an index");
        }
        if (index->get<std::uint64_t>() >= count) {
            document_.fail(path + "." + key,
                           fmt::format("{} is out of range, there are {}", index->dump(), count));
        }
        return index->get<std::size_t>();
    }

    /// Nothing for what stays as it is, with a notice.
    std::optional<PointerTarget> target_of(const Json& channel, const std::string& path) {
        const Json* target = channel.is_object() ? find_member(channel, "target") : nullptr;
        if (target == nullptr || !target->is_object()) {
            document_.fail(path + ".target", "must be an object");
        }
        const Json* kind = find_member(*target, "path");
        if (kind == nullptr || !kind->is_string()) {
            document_.fail(path + ".target.path", "must be a string");
        }
        const auto name = kind->get<std::string>();
        std::optional<PointerTarget> found;
        if (name == "pointer") {
            found = pointed(*target, path);
        } else if (find_member(*target, "node") == nullptr) {
            return std::nullopt;  // glTF 2.0, 3.11: such a channel is to be ignored
        } else {
            const std::size_t node =
                index_of(*target, path + ".target", "node", tree_.nodes.size());
            found = name == "weights" ? weights_of(node) : node_value(name, node);
            if (!found && name != "weights") {
                document_.fail(
                    path + ".target.path",
                    fmt::format("'{}' is none of translation, rotation, scale, weights", name));
            }
        }
        if (found && found->value <= AnimatedValue::scale &&
            !document_.model().nodes[found->index].matrix.empty()) {
            document_.fail(
                path + ".target.node",
                fmt::format("node {} has a matrix, which cannot be animated", found->index));
        }
        return found;
    }

    /// Nothing for a node that has nothing to morph.
    [[nodiscard]] std::optional<PointerTarget> weights_of(std::size_t node) const {
        return target_count(node) == 0
                   ? std::nullopt
                   : std::optional(PointerTarget{AnimatedValue::morph_weights, node});
    }

    /// Morph targets of a node's mesh, which glTF wants to be the same for all primitives.
    [[nodiscard]] std::size_t target_count(std::size_t node) const {
        const int mesh = document_.model().nodes[node].mesh;
        if (mesh < 0) {
            return 0;
        }
        const auto& primitives = item(document_.model().meshes, mesh).primitives;
        return primitives.empty() ? 0 : primitives.front().targets.size();
    }

    std::optional<PointerTarget> pointed(const Json& target, const std::string& path) {
        const Json* extensions = find_member(target, "extensions");
        const Json* extension = extensions != nullptr && extensions->is_object()
                                    ? find_member(*extensions, "KHR_animation_pointer")
                                    : nullptr;
        const Json* pointer = extension != nullptr && extension->is_object()
                                  ? find_member(*extension, "pointer")
                                  : nullptr;
        const std::string pointer_path = path + ".target.extensions.KHR_animation_pointer.pointer";
        if (pointer == nullptr || !pointer->is_string()) {
            document_.fail(pointer_path, "must be a string");
        }
        const auto text = pointer->get<std::string>();
        auto found = parse_animation_pointer(text);
        if (!found) {
            document_.note(fmt::format("animated, but left as it is: {}", text));
            return std::nullopt;
        }
        const bool of_node = found->value <= AnimatedValue::scale;
        const bool of_light = !of_node && found->value <= AnimatedValue::outer_cone;
        const std::size_t count = of_node    ? tree_.nodes.size()
                                  : of_light ? lights_
                                             : document_.model().materials.size();
        if (found->index >= count) {
            document_.fail(pointer_path,
                           fmt::format("{} does not exist: there are {}", text, count));
        }
        return found;
    }

    std::size_t track_of(const Json& animation, const std::string& path, const Json& channel,
                         const std::string& channel_path, const PointerTarget& target) {
        const std::size_t components = target.value == AnimatedValue::morph_weights
                                           ? target_count(target.index)
                                           : components_of(target.value);
        const Json& samplers = array_of(animation, path, "samplers");
        const std::size_t index = index_of(channel, channel_path, "sampler", samplers.size());
        const auto known = tracks_of_samplers_.find({index, target.value, components});
        if (known != tracks_of_samplers_.end()) {
            return known->second;
        }
        result_.tracks.push_back(read_track(
            samplers[index], path + "." + item_path("samplers", index), target.value, components));
        return tracks_of_samplers_[{index, target.value, components}] = result_.tracks.size() - 1;
    }

    KeyTrack read_track(const Json& sampler, const std::string& path, AnimatedValue value,
                        std::size_t components) {
        if (!sampler.is_object()) {
            document_.fail(path, "must be an object");
        }
        KeyTrack track;
        track.components = components;
        track.interpolation = interpolation_of(sampler, path);
        const std::size_t accessors = document_.model().accessors.size();
        const auto input = static_cast<int>(index_of(sampler, path, "input", accessors));
        const auto output = static_cast<int>(index_of(sampler, path, "output", accessors));
        const std::size_t keys = item(document_.model().accessors, input).count;
        // Morph weights are single numbers in a row.
        const bool single = value == AnimatedValue::morph_weights;
        const std::size_t parts = (track.interpolation == Interpolation::cubic_spline ? 3 : 1) *
                                  (single ? components : 1);
        keys_ += single ? keys * components : keys;
        if (keys_ > most_track_keys) {
            document_.fail(path + ".input",
                           fmt::format("more than {} keys in all", most_track_keys));
        }
        if (item(document_.model().accessors, output).count != keys * parts) {
            document_.fail(
                path + ".output",
                fmt::format("accessors[{}] has {} elements, {} keys need {}", output,
                            item(document_.model().accessors, output).count, keys, keys * parts));
        }
        track.times = read_floats(document_, input, 1, path + ".input");
        check_times(track.times, path + ".input", track.interpolation);
        track.values = read_floats(document_, output, single ? 1 : components, path + ".output");
        if (value == AnimatedValue::rotation) {
            check_rotations(track, path + ".output");
        }
        return track;
    }

    Interpolation interpolation_of(const Json& sampler, const std::string& path) {
        const Json* name = find_member(sampler, "interpolation");
        if (name == nullptr || *name == "LINEAR") {
            return Interpolation::linear;
        }
        if (*name == "STEP") {
            return Interpolation::step;
        }
        if (*name != "CUBICSPLINE") {
            document_.fail(path + ".interpolation",
                           name->dump() + " is none of LINEAR, STEP, CUBICSPLINE");
        }
        return Interpolation::cubic_spline;
    }

    void check_times(const std::vector<float>& times, const std::string& path,
                     Interpolation interpolation) {
        if (times.empty() || (interpolation == Interpolation::cubic_spline && times.size() < 2)) {
            document_.fail(path, "has too few keys");
        }
        if (!(times.front() >= 0.0F && times.back() <= longest_track)) {
            document_.fail(path, fmt::format("times must be 0..{} s", longest_track));
        }
        for (std::size_t i = 1; i < times.size(); ++i) {
            if (!(times[i] > times[i - 1])) {
                document_.fail(path,
                               fmt::format("key {} is at {} s and key {} at {} s: times must grow",
                                           i - 1, times[i - 1], i, times[i]));
            }
        }
    }

    void check_rotations(const KeyTrack& track, const std::string& path) {
        const bool spline = track.interpolation == Interpolation::cubic_spline;
        for (std::size_t i = spline ? 1 : 0; i < track.values.size() / 4; i += spline ? 3 : 1) {
            const glm::vec4 q(track.values[4 * i], track.values[4 * i + 1], track.values[4 * i + 2],
                              track.values[4 * i + 3]);
            if (glm::length(q) < 1e-6F) {
                document_.fail(path, fmt::format("element {} is zero, not a unit quaternion", i));
            }
        }
    }

    GltfDocument& document_;
    const GltfNodeTree& tree_;
    FileAnimations result_;
    std::size_t lights_ = 0;
    std::size_t channels_ = 0, keys_ = 0;  // so far
    std::set<std::string> names_;
    std::map<std::tuple<std::size_t, AnimatedValue, std::size_t>, std::size_t> tracks_of_samplers_;
};

}  // namespace

std::vector<bool> carried_nodes(const GltfNodeTree& tree, const FileAnimations& animations) {
    std::vector<bool> carried(tree.nodes.size());
    for (const int node : tree.order) {
        const auto n = static_cast<std::size_t>(node);
        const int parent = tree.nodes[n].parent;
        carried[n] =
            animations.moved[n] || (parent >= 0 && carried[static_cast<std::size_t>(parent)]);
    }
    return carried;
}

FileAnimations read_animations(GltfDocument& document, const GltfNodeTree& tree) {
    return AnimationReader(document, tree).read();
}

}  // namespace raybundle
