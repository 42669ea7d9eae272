// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "scene/scene_report.h"

namespace raybundle {

int run_inspect(const Options& options) {
    const LoadedScene loaded = load_scene(options);
    const SceneReport report = make_scene_report(loaded.scene, loaded.mesh);
    if (options.json_to_stdout) {
        std::cout << scene_report_json(loaded.scene, report).dump(2) << "\n";
    } else {
        print_scene_report(std::cout, loaded.scene, report);
    }
    return exit_done;
}

}  // namespace raybundle
