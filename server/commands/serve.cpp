// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>

#include "change_log.h"
#include "commands/command.h"
#include "commands/scene_watch.h"
#include "commands/signal_watch.h"
#include "config_file.h"
#include "gpu/egl_context.h"
#include "log_settings.h"
#include "net/server.h"
#include "render_loop.h"
#include "serve_settings.h"

namespace raybundle {

namespace {

/// Reads tokens, origins, log level and certificate again. What is wrong is logged and changes
/// nothing.
void reload_settings(const Options& options, Server& server) {
    try {
        const Options fresh = reread_config(options);
        const ServerSettings settings = server_settings(fresh);
        server.reload_certificate();
        server.set_access(settings.access);
        set_log_level(fresh);
        spdlog::info("settings have been read again: tokens, origins, log level, certificate");
    } catch (const std::exception& error) {
        spdlog::error("settings stay as they were: {}", error.what());
    }
}

ChangeLog open_change_log(const Options& options, const LoadedScene& loaded) {
    if (options.journal.empty()) {
        return {};
    }
    JournalSettings settings;
    settings.file = options.journal;
    settings.scene_name = loaded.scene.name;
    settings.scene_digest = loaded.digest;
    return ChangeLog(settings);
}

/// Lets the server ask a loop for its metrics while both exist.
class MetricsSource {
  public:
    MetricsSource(Server& server, const RenderLoop& loop) : server_(server) {
        server_.set_metrics_source([&loop] { return loop.metrics(); });
    }
    ~MetricsSource() { server_.set_metrics_source({}); }
    MetricsSource(const MetricsSource&) = delete;
    MetricsSource& operator=(const MetricsSource&) = delete;

  private:
    Server& server_;
};

/// Why a loop ends: `leave` is set last.
struct Control {
    std::atomic<bool> stop{false};   ///< the program ends
    std::atomic<bool> leave{false};  ///< that, or another scene waits
    std::optional<SceneWatch> watch;
};

/// Serves one scene; returns the one to serve next, or nothing where the program is to end.
std::optional<LoadedScene> serve_scene(const Options& options, const EglContext& context,
                                       LoadedScene loaded, Server& server, Control& control) {
    ChangeLog log = open_change_log(options, loaded);
    log.restore(loaded.scene, loaded.mesh);
    RenderLoopSettings settings;
    settings.solver.seed = options.seed;
    settings.solver.special = interactive_special();
    settings.rehearse = true;
    settings.min_frames_per_second = options.min_frames_per_second;
    settings.renderer = context.renderer();
    settings.software_rendering = context.is_software();
    RenderLoop loop(std::move(loaded.scene), std::move(loaded.mesh), settings, server, log);
    const MetricsSource source(server, loop);
    if (server.port() == 0) {
        server.start();
        fmt::print("raybundle serves {} at {}\n", options.scene, server.address());
        std::fflush(stdout);
    }
    std::optional<LoadedScene> next;
    while (!control.stop && !next) {
        loop.run(control.leave);
        control.leave = false;
        next = control.watch ? control.watch->take() : std::nullopt;
    }
    server.set_ready(false);
    loop.refuse_waiting();
    if (!control.stop) {
        server.close_all(CloseCode::service_restart, "the scene has been replaced");
    }
    return next;
}

}  // namespace

int run_serve(const Options& options) {
    if (options.print_config) {
        fmt::print("{}", print_config(options));
        return exit_done;
    }
    Server server(server_settings(options));
    Control control;
    const auto leave = [&] {
        control.leave = true;
        server.inbox().interrupt();
    };
    const SignalWatch signals(
        [&] {
            control.stop = true;
            leave();
        },
        [&] { reload_settings(options, server); });
    const EglContext context = create_egl_context({options.gpu, false});
    std::optional<LoadedScene> loaded = load_scene(options);
    if (options.watch) {
        control.watch.emplace(options, leave);
    }
    while (loaded && !control.stop) {
        loaded = serve_scene(options, context, std::move(*loaded), server, control);
    }
    spdlog::info("stopping");
    server.stop();
    return exit_done;
}

}  // namespace raybundle
