// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <utility>

#include "app/journal_choice.h"
#include "app/signal_watch.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "net/server.h"
#include "scene/scene_folder.h"
#include "session/render_loop.h"

namespace raybundle {

namespace {

/// Iterations after which the light of a scene that nobody changes is left as it is.
constexpr std::uint64_t most_iterations = 1U << 20U;

/// Whether the loop runs that looks at `stop`: before that nothing is lost by ending at once.
struct Stopping {
    std::atomic<bool> stop{false};
    std::mutex mutex;
    bool solving = false;
};

void stop_working(Stopping& stopping, Server& server) {
    const std::lock_guard lock(stopping.mutex);
    stopping.stop = true;
    server.inbox().interrupt();
    if (!stopping.solving) {
        std::fflush(nullptr);
        std::_Exit(exit_done);
    }
}

}  // namespace

int run_work(const Options& options) {
    Server server(ServerSettings{});  // is never started, so that nobody comes
    Stopping stopping;
    const SignalWatch signals([&] { stop_working(stopping, server); }, [] {});
    LoadedScene loaded = load_scene(options);
    if (!options.serve.scenes.empty()) {
        loaded.scene.folder = std::make_shared<const SceneFolder>(options.serve.scenes);
    }
    const JournalChoice journals(options);
    ChangeLog log = open_change_log(journals, loaded);
    if (!log.shared()) {
        return exit_failed;  // the log says why
    }
    const WorkerExchange workers = open_exchange(journals, loaded, options);
    log.restore(loaded.scene, loaded.mesh);
    const EglContext context = create_egl_context({options.device.gpu, false});
    RenderLoopSettings settings;
    settings.renderer = context.renderer();
    settings.software_rendering = context.is_software();
    settings.scheduling.idle_iterations = most_iterations;
    RenderLoop loop(std::move(loaded.scene), std::move(loaded.mesh), shared_by(workers, settings),
                    server, log);
    fmt::print("raybundle works for {}\n", log.place());
    std::fflush(stdout);
    {
        const std::lock_guard lock(stopping.mutex);
        stopping.solving = true;
    }
    loop.run(stopping.stop);
    spdlog::info("stopping");
    return exit_done;
}

}  // namespace raybundle
