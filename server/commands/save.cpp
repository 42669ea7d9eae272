// SPDX-License-Identifier: Apache-2.0
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/journal_choice.h"
#include "commands/command.h"
#include "scene/gltf/saved/scene_to_save.h"
#include "scene/scene_folder.h"
#include "session/changes/change_log.h"
#include "session/changes/lighting_scenes.h"

namespace raybundle {

namespace {

/// What `serve` would show: the scene with the changes of its journal. A journal that is named has
/// to be there; without one in the user's folder nothing has been changed.
std::optional<JournalSettings> journal_of(const Options& options, const LoadedScene& loaded) {
    JournalSettings settings;
    settings.file = JournalChoice(options).file_for(loaded.digest);
    const bool named = !options.serve.journal.empty();
    if (settings.file.empty() || !std::filesystem::exists(settings.file)) {
        if (named && !settings.file.empty()) {
            throw std::runtime_error(settings.file + ": there is no such journal");
        }
        spdlog::info("there is no journal: the scene is saved as its file has it");
        return std::nullopt;
    }
    settings.scene_name = loaded.scene.name;
    settings.scene_digest = loaded.digest;
    return settings;
}

}  // namespace

int run_save(const Options& options) {
    if (std::filesystem::path(options.output.file).extension() != ".glb") {
        throw UsageError("--output: '" + options.output.file + "' does not end in .glb");
    }
    require_writable(options.output.file);
    LoadedScene loaded = load_scene(options);
    if (!options.serve.scenes.empty()) {
        loaded.scene.folder = std::make_shared<const SceneFolder>(options.serve.scenes);
    }
    const auto journal = journal_of(options, loaded);
    ChangeLog log = journal ? ChangeLog(*journal) : ChangeLog();
    log.restore(loaded.scene, loaded.mesh);
    if (!log.working()) {
        throw std::runtime_error(journal->file + ": the journal cannot be read, see above");
    }
    LightingScenes lighting(log);
    lighting.take_up(loaded.scene);
    const SavedFile file = save_scene(scene_to_save(loaded.scene, lighting.saved()));
    for (const std::string& note : file.notes) {
        spdlog::warn("{}: {}", loaded.scene.name, note);
    }
    write_file(options.output.file, file.bytes);
    spdlog::info("{}: {:.2f} MB, after change {}", options.output.file,
                 static_cast<double>(file.bytes.size()) / 1e6, log.epoch());
    return exit_done;
}

}  // namespace raybundle
