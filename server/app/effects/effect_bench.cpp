// SPDX-License-Identifier: Apache-2.0
#include "app/effects/effect_bench.h"

#include <spdlog/spdlog.h>

#include "app/effects/effect_costs.h"
#include "net/ws/wire_codec.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

void EffectBench::measure(const ClientEvent& request, const Scene& scene, const PatchMesh& mesh) {
    if (busy_.exchange(true)) {
        server_.reply_error(request, v1::Error::RESOURCE_EXHAUSTED,
                            "measureEffects: somebody has the effects measured now");
        return;
    }
    thread_ = std::jthread([this, request, scene, mesh](const std::stop_token& stop) {
        const std::optional<v1::ServerMessage> answer = measured(scene, mesh, stop);
        // Free before the answer is sent: whoever has it may ask again.
        busy_ = false;
        if (answer) {
            server_.reply(request, *answer);
        }
    });
}

std::optional<v1::ServerMessage> EffectBench::measured(const Scene& scene, const PatchMesh& mesh,
                                                       const std::stop_token& stop) {
    EffectsPlan plan = plan_effects(scene, mesh.patch_count());
    try {
        measure_effects(options_, scene, mesh, plan, stop);
    } catch (const std::exception& error) {
        spdlog::error("effects cannot be measured: {}", error.what());
        return to_message({v1::Error::RESOURCE_EXHAUSTED,
                           "measureEffects: the server has no room for it now", std::nullopt});
    }
    if (stop.stop_requested()) {
        return std::nullopt;
    }
    v1::ServerMessage answer;
    for (const Effect& effect : plan.effects) {
        to_message(effect, answer.mutable_effect_costs()->add_effects());
    }
    return answer;
}

}  // namespace raybundle
