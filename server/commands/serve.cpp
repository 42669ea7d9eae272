// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <thread>

#include "commands/command.h"
#include "config_file.h"
#include "gpu/egl_context.h"
#include "net/server.h"
#include "render_loop.h"
#include "serve_settings.h"

namespace raybundle {

namespace {

/// Waits for SIGINT or SIGTERM on a thread of its own and then stops the loop.
class SignalWatch {
  public:
    SignalWatch(std::atomic<bool>& stop, Inbox& inbox) {
        sigemptyset(&signals_);
        sigaddset(&signals_, SIGINT);
        sigaddset(&signals_, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &signals_, nullptr);  // inherited by threads started later
        thread_ = std::jthread([this, &stop, &inbox](const std::stop_token& token) {
            const timespec interval{0, 100'000'000};
            while (!token.stop_requested()) {
                if (sigtimedwait(&signals_, nullptr, &interval) > 0) {
                    stop = true;
                    inbox.interrupt();
                    return;
                }
            }
        });
    }

  private:
    sigset_t signals_{};
    std::jthread thread_;
};

/// Lets the server ask the loop for its metrics, and stops it before the loop goes, however that
/// comes.
class Serving {
  public:
    Serving(Server& server, const RenderLoop& loop) : server_(server) {
        server_.set_metrics_source([&loop] { return loop.metrics(); });
        server_.start();
    }
    ~Serving() {
        server_.stop();
        server_.set_metrics_source({});
    }
    Serving(const Serving&) = delete;
    Serving& operator=(const Serving&) = delete;

  private:
    Server& server_;
};

}  // namespace

int run_serve(const Options& options) {
    if (options.print_config) {
        fmt::print("{}", print_config(options));
        return exit_done;
    }
    Server server(server_settings(options));
    std::atomic<bool> stop{false};
    const SignalWatch watch(stop, server.inbox());
    const EglContext context = create_egl_context({options.gpu, false});
    LoadedScene loaded = load_scene(options);
    RenderLoopSettings settings;
    settings.solver.seed = options.seed;
    RenderLoop loop(std::move(loaded.scene), loaded.mesh, settings, server);
    const Serving serving(server, loop);
    fmt::print("raybundle serves {} at {}\n", options.scene, server.address());
    std::fflush(stdout);
    loop.run(stop);
    spdlog::info("stopping");
    return exit_done;
}

}  // namespace raybundle
