// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>

#include "app/effects/effect_bench.h"
#include "app/journal_choice.h"
#include "app/metrics_source.h"
#include "app/preparation.h"
#include "app/scene_opener.h"
#include "app/scene_watch.h"
#include "app/signal_watch.h"
#include "app/span_export.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "net/server.h"
#include "options/config_file.h"
#include "options/log_settings.h"
#include "options/serve_settings.h"
#include "scene/gltf/file/gltf_confinement.h"
#include "session/changes/change_log.h"
#include "session/render_loop.h"
#include "view/image/whole_file.h"

namespace raybundle {

namespace {

/// Reads tokens, origins, log level and certificate again, and opens the audit log again. What is
/// wrong is logged and changes nothing.
void reload_settings(const Options& options, Server& server) {
    if (AuditLog* const audit = server.audit()) {
        audit->reopen();
    }
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

/// Why a loop ends: `leave` is set last.
struct Control {
    explicit Control(Server& server) : preparation(server, times) {}

    std::atomic<bool> stop{false};   ///< the program ends
    std::atomic<bool> leave{false};  ///< that, or another scene waits
    std::mutex serving_mutex;
    bool serving = false;  ///< a loop runs that looks at `leave`, or the program ends
    OpeningTimes times;
    Preparation preparation;
    std::optional<SceneWatch> watch;
    std::optional<SceneOpener> opener;
};

/// Stops the network however the program ends; signals leave that to it from then on.
class NetworkEnd {
  public:
    NetworkEnd(Control& control, Server& server) : control_(control), server_(server) {}
    ~NetworkEnd() {
        const std::lock_guard lock(control_.serving_mutex);
        control_.serving = true;
        server_.stop();
    }
    NetworkEnd(const NetworkEnd&) = delete;
    NetworkEnd& operator=(const NetworkEnd&) = delete;

  private:
    Control& control_;
    Server& server_;
};

/// A scene that is being served.
struct ServedScene {
    ServedScene(const JournalChoice& journals, LoadedScene loaded,
                const std::shared_ptr<const SceneFolder>& folder,
                const RenderLoopSettings& settings, const Options& options, Server& server,
                const SpanExporter* spans)
        : log(open_change_log(journals, loaded)),
          workers(open_exchange(journals, loaded, options)),
          restored((loaded.scene.folder = folder, log.restore(loaded.scene, loaded.mesh), true)),
          loop(std::move(loaded.scene), std::move(loaded.mesh), shared_by(workers, settings),
               server, log),
          metrics(server, loop, log, spans) {}

    ChangeLog log;
    WorkerExchange workers;
    bool restored;  // before anything is moved from
    RenderLoop loop;
    MetricsSource metrics;
};

constexpr int most_recoveries = 2;

/// Iterations after a change at which a test wants the GPU to fail; 0: none does.
std::uint64_t injected_fault() {
    const char* const text =
        std::getenv("RAYBUNDLE_TEST_GPU_LOST_AFTER");  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
}

/// Stands for a scene whose shaders take for ever, where a test wants one.
void compile_for_ever() {
    if (std::getenv("RAYBUNDLE_TEST_COMPILES_FOR_EVER") !=
        nullptr) {  // NOLINT(concurrency-mt-unsafe)
        std::this_thread::sleep_for(std::chrono::hours(1));
    }
}

/// Serves one scene after the other.
class SceneServer {
  public:
    /// spans: takes traces; null: nobody wants any.
    SceneServer(const Options& options, Server& server, Control& control, SpanExporter* spans)
        : options_(options),
          server_(server),
          control_(control),
          spans_(spans),
          journals_(options),
          context_(create_egl_context({options.device.gpu, false})),
          effect_bench_(options, server) {
        settings_.solver.seed = options.scene.seed;
        settings_.solver.special = interactive_special();
        settings_.rehearse = true;
        settings_.scheduling.min_frames_per_second = options.serve.min_frames_per_second;
        settings_.renderer = context_->renderer();
        settings_.software_rendering = context_->is_software();
        settings_.lost_after_change = injected_fault();
        settings_.spans = spans;
        settings_.effect_requests = [this](const ClientEvent& request, const Scene& scene,
                                           const PatchMesh& mesh) {
            effect_bench_.measure(request, scene, mesh);
        };
        if (control.opener) {
            settings_.scene_requests = [this](const ClientEvent& request, const std::string& name) {
                control_.opener->handle(request, name);
            };
        }
    }

    void run() {
        control_.preparation.begin(options_.scene.file, std::nullopt);
        {
            const std::lock_guard lock(control_.serving_mutex);
            server_.start();
        }
        if (const std::string& file = options_.network.address_file; !file.empty()) {
            write_file(file, server_.address() + "\n");
        }
        auto [file, loaded] = first_scene();
        shown_file_ = file;
        fmt::print("raybundle serves {} at {}\n", file, server_.address());
        std::fflush(stdout);
        control_.preparation.reach(v1::SceneOpening::COMPILING);
        compile_for_ever();
        served_ = serve_scene(std::move(loaded));
        fmt::print("{}\n", where_saved(served_->log));
        std::fflush(stdout);
        watch(file);
        while (!control_.stop) {
            try {
                run_loop();
            } catch (const GpuError& error) {
                recover(error);
                continue;
            }
            control_.leave = false;
            if (!control_.stop) {
                change_scene();
            }
        }
        server_.set_ready(false);
        served_->loop.refuse_waiting();
    }

  private:
    /// Runs the present loop until it is to be left.
    void run_loop() {
        served_->loop.rehearse(control_.leave);
        control_.preparation.end();
        set_serving(true);
        try {
            served_->loop.run(control_.leave);
        } catch (const GpuError&) {
            leave_loop();
            throw;
        }
        leave_loop();
    }

    /// Who comes now hears that a scene is being made ready; unless the program ends.
    void leave_loop() {
        if (!control_.stop) {
            control_.preparation.begin(shown_file_, std::nullopt);
            set_serving(false);
        }
    }

    void set_serving(bool serving) {
        const std::lock_guard lock(control_.serving_mutex);
        control_.serving = serving;
    }

    /// The scene that was shown last time, where the journal knows one; else that of the options.
    std::pair<std::string, LoadedScene> first_scene() {
        const std::string name =
            control_.opener ? journals_.remembered_scene(options_.scene.file) : std::string();
        const std::optional<std::string> file =
            name.empty() ? std::nullopt : control_.opener->library().find(name);
        if (file) {
            try {
                Options options = options_;
                options.scene.file = *file;
                check_confined(*file);
                LoadedScene loaded = load(options);
                control_.opener->set_shown(*file);
                spdlog::info("{} was open last, so it is shown instead of {}", name,
                             options_.scene.file);
                return {*file, std::move(loaded)};
            } catch (const std::exception& error) {
                spdlog::error("could not reopen the previous scene {}: {}", name, error.what());
            }
        }
        return {options_.scene.file, load(options_)};
    }

    std::unique_ptr<ServedScene> serve_scene(LoadedScene loaded) {
        auto folder = control_.opener ? control_.opener->folder() : nullptr;
        return std::make_unique<ServedScene>(journals_, std::move(loaded), folder, settings_,
                                             options_, server_, spans_);
    }

    /// Viewers that wait hear of it.
    LoadedScene load(const Options& options) {
        control_.preparation.begin(options.scene.file, Preparation::Clock::now());
        return load_scene(options,
                          [this] { control_.preparation.reach(v1::SceneOpening::PREPARING); });
    }

    void watch(const std::string& file) {
        if (options_.serve.watch) {
            Options options = options_;
            options.scene.file = file;
            control_.watch.reset();
            control_.watch.emplace(options, [this] {
                control_.leave = true;
                server_.inbox().interrupt();
            });
        }
    }

    void change_scene() {
        std::optional<LoadedScene> replaced =
            control_.watch ? control_.watch->take() : std::nullopt;
        if (replaced) {
            replace(std::move(*replaced));
        }
        std::optional<OpenedScene> opened =
            control_.opener ? control_.opener->take() : std::nullopt;
        if (opened) {
            open(*opened);
        }
    }

    void open(OpenedScene& scene) {
        control_.opener->announce(scene, v1::SceneOpening::COMPILING);
        control_.preparation.begin(scene.file, scene.begun);
        // On disk before anybody is told.
        const auto shown = [&](ChangeLog& log) {
            journals_.remember_scene(log, options_.scene.file, scene.progress.name());
            control_.opener->accept(scene);
        };
        const std::string problem = replace(std::move(scene.loaded), shown);
        if (problem.empty()) {
            shown_file_ = scene.file;
            watch(scene.file);
        } else {
            control_.preparation.begin(shown_file_, std::nullopt);
            control_.opener->reject(scene, problem);
        }
    }

    /// The GPU has lost what it held, or has no memory for it: all begins anew from the file and
    /// the journal, with bundles of half the resolution. Throws what it is given where that has not
    /// helped before.
    void recover(const GpuError& error) {
        if (++recoveries_ > most_recoveries) {
            throw GpuError(std::string(error.what()) +
                           "; smaller bundles have not helped, so the server ends");
        }
        spdlog::error(
            "the GPU has failed, the scene is built anew with smaller bundles{}: {}",
            served_->log.saving() == v1::NOT_SAVED ? " and without the changes made to it" : "",
            error.what());
        server_.set_ready(false);
        served_->loop.refuse_waiting();
        server_.close_all(CloseCode::service_restart, "the graphics processor has failed");
        served_.reset();
        context_.reset();
        context_.emplace(create_egl_context({options_.device.gpu, false}));
        for (BundleResolution* bundles : {&settings_.solver.coarse, &settings_.solver.fine}) {
            bundles->hemicube /= 2;
            bundles->window /= 2;
        }
        Options options = options_;
        options.scene.file = shown_file_;
        LoadedScene loaded = load(options);
        control_.preparation.reach(v1::SceneOpening::COMPILING);
        served_ = serve_scene(std::move(loaded));
    }

    /// Builds the next scene beside the present one, which stays where that fails. The reason in
    /// that case, else empty; `shown` is called, with the new scene's log, before viewers are told
    /// to come back.
    std::string replace(
        LoadedScene next, const std::function<void(ChangeLog&)>& shown = [](ChangeLog&) {}) {
        served_->log.suspend();
        control_.preparation.reach(v1::SceneOpening::COMPILING);
        std::unique_ptr<ServedScene> fresh;
        try {
            fresh = serve_scene(std::move(next));
        } catch (const std::exception& error) {
            spdlog::error("the scene stays as it was: {}", error.what());
            served_->log.resume();
            served_->metrics.use();
            return "the server has no room for it";
        }
        server_.set_ready(false);
        shown(fresh->log);
        served_->loop.refuse_waiting();
        server_.close_all(CloseCode::service_restart, "the scene has been replaced");
        served_ = std::move(fresh);
        served_->metrics.use();
        spdlog::info("{}", where_saved(served_->log));
        return {};
    }

    const Options& options_;
    Server& server_;
    Control& control_;
    SpanExporter* spans_;
    JournalChoice journals_;
    std::optional<EglContext> context_;
    EffectBench effect_bench_;
    RenderLoopSettings settings_;
    std::string shown_file_;
    int recoveries_ = 0;
    std::unique_ptr<ServedScene> served_;
};

/// While a scene is made ready nobody looks at `stop`, for as long as reading and compiling take,
/// and there is nothing yet that only this process knows: it ends at once.
void end_unless_serving(Control& control, Server& server) {
    const std::lock_guard lock(control.serving_mutex);
    if (!control.serving) {
        spdlog::info("stopping before the scene is ready");
        server.stop();
        std::fflush(nullptr);
        std::_Exit(exit_done);
    }
}

}  // namespace

int run_serve(const Options& options) {
    if (options.config.print) {
        fmt::print("{}", print_config(options));
        return exit_done;
    }
    ServerSettings settings = server_settings(options);
    settings.audit = open_audit_log(options);
    Server server(std::move(settings));
    Control control(server);
    const auto leave = [&] {
        control.leave = true;
        server.inbox().interrupt();
    };
    const SignalWatch signals(
        [&] {
            control.stop = true;
            leave();
            end_unless_serving(control, server);
        },
        [&] { reload_settings(options, server); });
    if (!options.serve.scenes.empty()) {
        control.opener.emplace(options, server, control.times, leave);
    }
    const auto spans = make_span_exporter(options);
    const NetworkEnd network_end(control, server);  // before the opener, which uploads use
    SceneServer(options, server, control, spans.get()).run();
    spdlog::info("stopping");
    server.stop();
    return exit_done;
}

}  // namespace raybundle
