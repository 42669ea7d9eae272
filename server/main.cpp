// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "app/signal_watch.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "options/cli_options.h"
#include "options/log_settings.h"
#include "options/usage_message.h"
#include "scene/gltf/gltf_loader.h"
#include "trace/bundle_builder.h"

namespace {

using raybundle::Options;

int list_gpus() {
    const auto devices = raybundle::list_gpu_devices();
    for (const auto& device : devices) {
        fmt::print("{}: {}{}\n", device.index, device.usable ? "" : "unusable: ", device.renderer);
    }
    if (devices.empty()) {
        fmt::print("no EGL devices\n");
    }
    try {
        const raybundle::EglContext context = raybundle::create_egl_context();
        fmt::print("without --gpu: {}\n", context.renderer());
    } catch (const raybundle::GpuError& error) {
        fmt::print("without --gpu: {}\n", error.what());
    }
    return raybundle::exit_done;
}

int run(const Options& options, const CLI::App& app) {
    const bool reloads = options.command == Options::Command::serve ||
                         options.command == Options::Command::projects ||
                         options.command == Options::Command::work;
    if (!reloads) {
        raybundle::release_hangup();
    }
    if (options.device.list_gpus) {
        return list_gpus();
    }
    switch (options.command) {
        case Options::Command::serve:
            return raybundle::run_serve(options);
        case Options::Command::work:
            return raybundle::run_work(options);
        case Options::Command::projects:
            return raybundle::run_projects(options);
        case Options::Command::render:
            return raybundle::run_render(options);
        case Options::Command::export_scene:
            return raybundle::run_export(options);
        case Options::Command::save:
            return raybundle::run_save(options);
        case Options::Command::accuracy:
            return raybundle::run_accuracy(options);
        case Options::Command::inspect:
            return raybundle::run_inspect(options);
        case Options::Command::bench:
            return raybundle::run_bench(options);
        case Options::Command::measure:
            return raybundle::run_measure(options);
        case Options::Command::selftest:
            return raybundle::run_selftest(options);
        case Options::Command::token:
            return raybundle::run_token(options);
        default:
            fmt::print(stderr, "{}", app.help());
            return raybundle::exit_usage;
    }
}

int report(int status, const std::exception& error) {
    fmt::print(stderr, "raybundle: {}\n", error.what());
    return status;
}

int parse_and_run(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("raybundle"));
    CLI::App app;
    Options options;
    raybundle::define_options(app, options);
    app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
        return raybundle::usage_message(*failed, error);
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? raybundle::exit_done : raybundle::exit_usage;
    } catch (const raybundle::UsageError& error) {
        return report(raybundle::exit_usage, error);
    }
    try {
        raybundle::set_log(options);
        raybundle::set_bundle_builder(raybundle::bundle_builder_named(options.device.bundles)
                                          .value_or(raybundle::BundleBuilder::automatic));
        return run(options, app);
    } catch (const raybundle::UsageError& error) {
        return report(raybundle::exit_usage, error);
    } catch (const raybundle::SceneError& error) {
        return report(raybundle::exit_scene_rejected, error);
    } catch (const raybundle::GlError& error) {
        return report(raybundle::exit_failed, error);
    } catch (const raybundle::GpuError& error) {
        return report(raybundle::exit_no_gpu, error);
    }
}

}  // namespace

/// Runs before the constructors of libraries, which take longer than all that main() does first.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const hold_hangup_first)() = raybundle::hold_hangup;

int main(int argc, char** argv) {
    try {
        return parse_and_run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raybundle: %s\n", error.what());
    } catch (...) {
        std::fprintf(stderr, "raybundle: unknown error\n");
    }
    return raybundle::exit_failed;
}
