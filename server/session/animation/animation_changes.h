// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "raybundle.pb.h"
#include "scene/animation/scene_animations.h"

namespace raybundle {

/// What is to be changed so that what the last of the animations moves is where it has it; what is
/// there already only where it is one of the objects `always`.
std::vector<v1::SceneChanged> changes_to(const Scene& scene, std::span<const AnimationPlace> places,
                                         const std::set<std::uint32_t>& always);

}  // namespace raybundle
