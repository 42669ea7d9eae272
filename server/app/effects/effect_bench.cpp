// SPDX-License-Identifier: Apache-2.0
#include "app/effects/effect_bench.h"

#include <spdlog/spdlog.h>

#include "app/effects/effect_costs.h"
#include "session/scene_messages.h"

namespace raybundle {

void EffectBench::measure(const ClientEvent& request, const Scene& scene, const PatchMesh& mesh) {
    if (busy_.exchange(true)) {
        server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED,
                            "measureEffects: somebody has the effects measured now");
        return;
    }
    thread_ = std::jthread([this, request, scene, mesh](const std::stop_token& stop) {
        run(request, scene, mesh, stop);
        busy_ = false;
    });
}

void EffectBench::run(const ClientEvent& request, const Scene& scene, const PatchMesh& mesh,
                      const std::stop_token& stop) {
    EffectsPlan plan = plan_effects(scene, mesh.patch_count());
    try {
        measure_effects(options_, scene, mesh, plan, stop);
    } catch (const std::exception& error) {
        spdlog::error("effects cannot be measured: {}", error.what());
        server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED,
                            "measureEffects: the server has no room for it now");
        return;
    }
    if (!stop.stop_requested()) {
        v1::ServerMessage answer;
        for (const Effect& effect : plan.effects) {
            to_message(effect, answer.mutable_effect_costs()->add_effects());
        }
        server_.reply(request, answer);
    }
}

}  // namespace raybundle
