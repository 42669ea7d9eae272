// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/animation/scene_animations.h"
#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_node_tree.h"

namespace raybundle {

/// A channel as the file has it.
struct FileChannel {
    AnimatedValue value = AnimatedValue::translation;
    std::size_t target = 0;  ///< a node (of morph_weights, too), an entry of KHR_lights_punctual's
                             ///< lights, or a material
    std::size_t track = 0;   ///< index into FileAnimations::tracks
};

struct FileAnimation {
    std::string name;  ///< unlike all others
    double seconds = 0.0;
    std::vector<FileChannel> channels;
};

/// What "animations" says, before it is known what becomes an object.
struct FileAnimations {
    std::vector<FileAnimation> animations;
    std::vector<KeyTrack> tracks;
    std::vector<bool> moved;    ///< of each node: whether a channel moves it
    std::vector<bool> morphed;  ///< likewise: whether a channel changes its morph weights
};

/// Of each node, whether animations move it or one above it.
std::vector<bool> carried_nodes(const GltfNodeTree& tree, const FileAnimations& animations);

/// Reads "animations" with KHR_animation_pointer. One that is malformed is left out with a notice
/// that names place and reason; so are channels that change what cannot be changed while a scene is
/// shown.
FileAnimations read_animations(GltfDocument& document, const GltfNodeTree& tree);

}  // namespace raybundle
