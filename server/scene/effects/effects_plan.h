// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// One entry of the effects plan: what a scene calls for, why, and what it costs.
struct Effect {
    std::string name;        ///< fixed: scripts and clients know them
    bool active = false;     ///< simulated
    std::string reason;      ///< why, or why not
    std::string path_class;  ///< light paths in Heckbert's notation, G: glossy
    /// Upper bound of the share that such paths can have: of the light that a surface reflects, for
    /// a kind of reflection; of the light that crosses the scene, for air; of the flux that all
    /// lights send, for a kind of light, and for
    /// caustics, to whose bound of the light of lamps and skies reflected light adds what it would
    /// be if it were the same everywhere. 0..1, 0 where the scene has no such paths.
    double share_bound = 0.0;
    std::size_t bytes_per_patch = 0;  ///< of GPU memory that grows with the patches
    /// Measured; nothing where it was not, or the effect is not active.
    std::optional<double> ms_per_iteration;
};

struct EffectsPlan {
    std::size_t patches = 0;
    std::size_t bytes_per_patch = 0;  ///< solution state, of all active effects
    std::vector<Effect> effects;      ///< all that there are, always in the same order
};

/// What loading ends with (design: effects plan): which effects the scene calls for. Buffers and
/// shader variants of the others do not exist. accuracy: relative error of the picture that is
/// asked for; what is bounded by less than a tenth of it is skipped, where it can be told:
/// caustics. 0: no such wish, nothing is skipped.
EffectsPlan plan_effects(const Scene& scene, std::size_t patches, double accuracy = 0.0);

/// Whether an effect of that name is simulated.
bool is_active(const EffectsPlan& plan, std::string_view name);

/// {"patches", "bytesPerPatch", "effects": [{"name", "active", "reason", "pathClass", "shareBound",
/// "bytesPerPatch", "msPerIteration"}]}; msPerIteration is null where it was not measured.
nlohmann::json effects_plan_json(const EffectsPlan& plan);

}  // namespace raybundle
