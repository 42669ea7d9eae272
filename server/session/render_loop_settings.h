// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "journal/solution_exchange.h"
#include "scheduling/scheduling_settings.h"
#include "session/scene_service.h"
#include "telemetry/span.h"
#include "transport/solver.h"

namespace raybundle {

struct RenderLoopSettings {
    SolverSettings solver;
    SchedulingSettings scheduling;
    /// All that viewers and moves need is done once before anybody waits for it.
    bool rehearse = false;
    std::string renderer;             ///< what viewers are told that draws
    bool software_rendering = false;  ///< and that it is no GPU
    /// Fault injection of tests: the GPU is lost so many iterations after a change; 0: never.
    std::uint64_t lost_after_change = 0;
    SolutionExchange* exchange = nullptr;  ///< with other workers; null: there are none
    std::uint64_t fingerprint = 0;         ///< of what these must have in common beside the mesh
    SpanSink* spans = nullptr;             ///< takes traces of changes; null: nobody wants any
    SceneService::SceneRequests scene_requests;    ///< empty: there are no scenes to open
    SceneService::EffectRequests effect_requests;  ///< empty: effects are not measured
};

}  // namespace raybundle
