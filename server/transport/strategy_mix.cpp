// SPDX-License-Identifier: Apache-2.0
#include "transport/strategy_mix.h"

#include <algorithm>

#include "scene/environment.h"

namespace raybundle {

StrategyProbabilities StrategyMix::at(std::uint64_t iterations) const {
    const float age = static_cast<float>(std::min(iterations, ageing_iterations)) /
                      static_cast<float>(ageing_iterations);
    StrategyProbabilities p;
    p.layered = first_.layered + age * (last_.layered - first_.layered);
    p.plane = first_.plane + age * (last_.plane - first_.plane);
    p.perspective = 1.0F - p.layered - p.plane;
    return p;
}

StrategyMix ageing_mix() {
    return {{0.15F, 0.15F, 0.7F}, {0.3F, 0.0F, 0.7F}};
}

StrategyMix with_sky(const StrategyMix& mix, const Scene& scene) {
    if (!has_sky(scene)) {
        return mix;
    }
    const float least = has_emitter(scene) ? 0.4F : 0.75F;
    const auto raised = [least](StrategyProbabilities p) {
        if (p.layered > 0.0F && p.perspective > 0.0F) {
            p.layered = std::max(p.layered, least);
            p.plane = 0.0F;  // their pixels cannot tell whether a line passes beside a room
            p.perspective = 1.0F - p.layered - p.plane;
        }
        return p;
    };
    return {raised(mix.first()), raised(mix.last())};
}

}  // namespace raybundle
