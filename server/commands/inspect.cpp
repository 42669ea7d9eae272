// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/effects/contact_sheet.h"
#include "app/effects/effect_costs.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "scene/scene_report.h"
#include "view/image/whole_file.h"

namespace raybundle {
namespace {

void print_plan(std::ostream& out, const EffectsPlan& plan) {
    out << fmt::format("effects     {} bytes a patch\n", plan.bytes_per_patch);
    for (const Effect& effect : plan.effects) {
        out << fmt::format("  {} {:<20} {}\n", effect.active ? "on " : "off", effect.name,
                           effect.reason);
        if (!effect.active) {
            continue;
        }
        out << fmt::format("      {:<20} {}, share at most {:.3g}, {} bytes a patch", "",
                           effect.path_class, effect.share_bound, effect.bytes_per_patch);
        if (effect.ms_per_iteration) {
            out << fmt::format(", {:.2f} ms an iteration", *effect.ms_per_iteration);
        }
        out << "\n";
    }
}

/// Of one effect, with its picture.
int inspect_effect(const Options& options, const LoadedScene& loaded) {
    const EffectCost cost = write_contact_sheet(options, loaded);
    constexpr double megabyte = 1e-6;
    const nlohmann::json json = {
        {"effect", options.inspect.effect},
        {"msPerIteration", {{"with", cost.ms_with}, {"without", cost.ms_without}}},
        {"megabytes",
         {{"with", megabyte * static_cast<double>(cost.bytes_with)},
          {"without", megabyte * static_cast<double>(cost.bytes_without)}}}};
    std::cout << (options.inspect.json_to_stdout
                      ? json.dump(2)
                      : fmt::format(
                            "{}: {:.2f} ms an iteration (without: {:.2f}), {:.1f} MB ({:.1f})",
                            options.inspect.effect, cost.ms_with, cost.ms_without,
                            megabyte * static_cast<double>(cost.bytes_with),
                            megabyte * static_cast<double>(cost.bytes_without)))
              << "\n";
    return exit_done;
}

}  // namespace

int run_inspect(const Options& options) {
    if (!options.inspect.contact_sheet.empty()) {
        require_writable(options.inspect.contact_sheet);
    }
    const LoadedScene loaded = load_scene(options);
    if (!options.inspect.contact_sheet.empty()) {
        return inspect_effect(options, loaded);
    }
    const SceneReport report = make_scene_report(loaded.scene, loaded.mesh);
    EffectsPlan plan =
        plan_effects(loaded.scene, loaded.mesh.patch_count(), options.stop.error.value_or(0.0));
    if (options.inspect.costs) {
        try {
            measure_effects(options, loaded.scene, loaded.mesh, plan);
        } catch (const GpuError& error) {
            spdlog::warn("the costs of the effects are not measured: {}", error.what());
        }
    }
    if (options.inspect.json_to_stdout) {
        nlohmann::json json = scene_report_json(loaded.scene, report);
        json.update(effects_plan_json(plan));
        std::cout << json.dump(2) << "\n";
    } else {
        print_scene_report(std::cout, loaded.scene, report);
        print_plan(std::cout, plan);
    }
    return exit_done;
}

}  // namespace raybundle
