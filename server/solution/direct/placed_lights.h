// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gpu/layouts.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

using IesProfiles = std::vector<std::shared_ptr<const IesProfile>>;

/// Those of lights, each once.
IesProfiles profiles_of(std::span<const PunctualLight> lights);

/// The scene's punctual lights at their present places as shaders want them, in radiance units,
/// without shadow maps. profiles: of all of them.
std::vector<layout::PunctualData> placed_lights(const GpuScene& scene, const IesProfiles& profiles);

}  // namespace raybundle
