// SPDX-License-Identifier: Apache-2.0
// `accuracy`: every method over the same time, against a reference.
#include <fmt/core.h>

#include <filesystem>

#include "commands/accuracy_early.h"
#include "commands/accuracy_measurement.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "research/accuracy/accuracy_report.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

void write_report(const AccuracyReport& report, const fs::path& folder) {
    for (const NamedPlot& plot : accuracy_plots(report)) {
        write_file((folder / plot.file).string(), svg_of(plot.plot));
    }
    for (const PictureReport& picture : report.pictures) {
        write_file((folder / ("picture_" + picture.name + ".png")).string(), picture.png);
        if (!picture.map_png.empty()) {
            write_file((folder / ("error_" + picture.name + ".png")).string(), picture.map_png);
        }
    }
    write_file((folder / "accuracy.json").string(), accuracy_json(report).dump(2) + "\n");
    write_file((folder / "index.html").string(), accuracy_page(report));
}

void print_table(const AccuracyReport& report) {
    fmt::print("{:<28}", "seconds to");
    for (const double target : target_errors) {
        fmt::print("{:>9.0f} %", 100.0 * target);
    }
    fmt::print("{:>12}\n", "at the end");
    for (const ErrorCurve& curve : report.curves) {
        if (curve.points.empty()) {
            continue;
        }
        fmt::print("{:<28}", curve.knob.empty() ? curve.name : "  " + curve.name);
        for (const double target : target_errors) {
            const auto time = time_to_error(curve, target);
            fmt::print(
                "{:>11}",
                time ? fmt::format("{}{:.2f}", time->at_most ? "<= " : "", time->seconds) : "-");
        }
        fmt::print("{:>10.2f} %\n", 100.0 * curve.points.back().relative_rmse);
    }
}

void create_folder(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error || !fs::is_directory(path)) {
        throw std::runtime_error(path + ": this folder cannot be made");
    }
}

}  // namespace

int run_accuracy(const Options& options) {
    if (options.accuracy.early) {
        return run_accuracy_early(options);
    }
    const AccuracyJob job = plan_accuracy(options);
    std::optional<EglContext> context;
    if (job.needs_gl()) {
        context.emplace(create_egl_context({options.device.gpu, false}));
    }
    const LoadedScene loaded = load_scene(options);
    AccuracyMeasurement measurement(options, job, loaded);
    create_folder(options.output.file);
    measurement.run();
    const AccuracyReport report = measurement.report(context ? context->renderer() : "");
    write_report(report, options.output.file);
    print_table(report);
    fmt::print("{}\n", (fs::path(options.output.file) / "index.html").string());
    return exit_done;
}

}  // namespace raybundle
