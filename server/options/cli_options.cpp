// SPDX-License-Identifier: Apache-2.0
#include "options/cli_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "options/cli_checks.h"
#include "options/config_file.h"
#include "options/method_options.h"
#include "options/option_table.h"

namespace raybundle {

namespace {

struct CommandRow {
    const char* name;
    const char* help;
    Options::Command command;
    bool scene_required;
};

constexpr CommandRow command_table[] = {
    {"serve", "Serve a scene to browsers", Options::Command::serve, false},
    {"work", "Solve for the servers of a project, without viewers of its own",
     Options::Command::work, false},
    {"projects",
     "Serve many scenes at one address, each by a server that sleeps while nobody looks",
     Options::Command::projects, false},
    {"render", "Render a picture to EXR or PNG", Options::Command::render, true},
    {"export", "Write a walkthrough for any web server, and glTF with the light baked in",
     Options::Command::export_scene, true},
    {"save", "Write the scene as it has been edited as one GLB file", Options::Command::save, true},
    {"accuracy", "Measure error over time of several methods against a reference",
     Options::Command::accuracy, true},
    {"inspect", "Report on a scene: size, objects, lights, defects", Options::Command::inspect,
     true},
    {"bench", "Measure speed on this machine", Options::Command::bench, false},
    {"measure", "Measure light at points in the air: illuminance, daylight factor",
     Options::Command::measure, true},
    {"selftest", "Compare with closed forms on this machine", Options::Command::selftest, false},
    {"token", "Make an access token for serve", Options::Command::token, false},
};

struct MethodRow {
    const char* name;
    RenderMethod method;
};

/// Methods of `render`: ray bundles on the GPU, then references on the CPU.
const MethodRow method_table[] = {
    {"combined", StrategyProbabilities{}},
    {"parallel-layered", StrategyProbabilities{1.0F, 0.0F, 0.0F}},
    {"parallel-plane", StrategyProbabilities{0.0F, 1.0F, 0.0F}},
    {"perspective", StrategyProbabilities{0.0F, 0.0F, 1.0F}},
    {"path", ReferenceKind::path},
    {"path-reuse", ReferenceKind::path_reuse},
    {"single-ray", ReferenceKind::single_ray},
    {"ray-cast", ReferenceKind::ray_cast},
    {"light", ReferenceKind::light},
    {"bidirectional", ReferenceKind::bidirectional},
    {"metropolis", ReferenceKind::metropolis},
    {"photon-map", ReferenceKind::photon_map},
};

/// Adds a row of the table of `serve`.
void add_row(CLI::App& app, Options& o, const OptionRow& row) {
    const auto add = [&](const auto& field) {
        auto& value = field(o);
        using Value = std::remove_reference_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>) {
            app.add_flag(flag_of(row.key), value, row.help);
        } else if constexpr (std::is_same_v<Value, SkyChoice>) {
            app.add_option(flag_of(row.key), value.text, row.help);
        } else {
            app.add_option(flag_of(row.key), value, row.help)->capture_default_str();
        }
    };
    std::visit(add, row.field);
}

void add_common(CLI::App& app, Options& o) {
    for (const OptionRow& row : option_table()) {
        if (row.common) {
            add_row(app, o, row);
        }
    }
}

/// Throws UsageError where a value of the command line is out of range.
void check_rows(const CLI::App& app, const Options& o) {
    for (const OptionRow& row : option_table()) {
        const CLI::Option* const option = app.get_option_no_throw(flag_of(row.key));
        const bool given = option != nullptr && option->count() > 0;
        if (const std::string problem = given ? problem_of(row, o) : ""; !problem.empty()) {
            throw UsageError(flag_of(row.key) + ": " + problem);
        }
    }
}

void add_scene(CLI::App& app, Options& o, bool required) {
    auto* scene = app.add_option("SCENE", o.scene.file, "glTF 2.0 file, .gltf or .glb");
    if (required) {
        scene->required();
    }
    app.add_option(
           "--patch-size", o.scene.patch_size,
           "Target edge of the patches, m; smaller where light changes beside other surfaces "
           "(default: about 25 000 patches)")
        ->check(positive());
    app.add_option("--seed", o.scene.seed, "Of all random numbers")->capture_default_str();
}

void add_serve(CLI::App& app, Options& o) {
    app.add_option("SCENE", o.scene.file, "glTF 2.0 file, .gltf or .glb");
    app.add_option("--config", o.config.file, "JSON file with these options; those given here win");
    app.add_flag("--print-config", o.config.print, "Print the configuration in effect and exit");
    for (const OptionRow& row : option_table()) {
        if (!row.common) {
            add_row(app, o, row);
        }
    }
}

void add_work(CLI::App& app, Options& o) {
    app.add_option("SCENE", o.scene.file, "glTF 2.0 file, .gltf or .glb");
    app.add_option("--config", o.config.file,
                   "JSON file of the servers, of which this command takes what it knows; options "
                   "given here win");
    for (const OptionRow& row : option_table()) {
        for (const std::string_view key :
             {"redis", "project", "scenes", "patchSize", "seed", "logFormat"}) {
            if (row.key == key) {
                add_row(app, o, row);
            }
        }
    }
}

/// Completes the options of `serve` and `work` from the configuration file.
void finish_serve(const CLI::App& app, Options& o) {
    for (const OptionRow& row : option_table()) {
        const CLI::Option* const option = app.get_option_no_throw(flag_of(row.key));
        if (option != nullptr && option->count() > 0) {
            o.config.on_command_line.insert(row.key);
        }
    }
    if (!o.scene.file.empty()) {
        o.config.on_command_line.insert("scene");
    }
    if (!o.config.file.empty()) {
        apply_config_file(o.config.file, o);
    }
    if (o.scene.file.empty() && !o.config.print) {
        throw UsageError(app.get_name() +
                         ": needs a SCENE, on the command line or in the --config file");
    }
}

void finish_work(const CLI::App& app, Options& o) {
    finish_serve(app, o);
    if (o.serve.redis.empty()) {
        throw UsageError(
            "work: needs --redis HOST:PORT, by which it works for the servers of a project");
    }
}

void add_projects(CLI::App& app, Options& o) {
    app.add_option("PROJECTS", o.projects.source,
                   "JSON file that names the projects, or a folder of .gltf and .glb files")
        ->required();
    app.add_option("--listen", o.network.listen, "Address and port; port 0: any free one")
        ->capture_default_str();
    app.add_flag("--allow-remote", o.network.allow_remote,
                 "Listen beyond this machine though projects have no tokens");
    app.add_option("--state", o.projects.state,
                   "Folder of journals and pictures (default: ~/.local/state/raybundle/projects)");
    app.add_option("--sleep-after-seconds", o.projects.sleep_after_s,
                   "A project falls asleep when nobody has been there for so long")
        ->capture_default_str()
        ->check(number_that([](double value) { return value >= 0.0 && value <= 1e9; },
                            "a number of 0 to 1e9"));
    app.add_option("--memory-megabytes", o.projects.memory_megabytes,
                   "Of all projects; beyond that those asleep end (0: no limit)")
        ->capture_default_str()
        ->check(CLI::Range(0, 1'000'000'000));
}

/// What the command line says of `projects` wins over its file.
void finish_projects(const CLI::App& app, Options& o) {
    for (const char* key :
         {"listen", "allowRemote", "state", "sleepAfterSeconds", "memoryMegabytes"}) {
        if (app.get_option(flag_of(key))->count() > 0) {
            o.config.on_command_line.insert(key);
        }
    }
}

void add_token(CLI::App& app, Options& o) {
    app.add_option("--name", o.token.name, "Whom it is for; appears in the log");
    app.add_option("--role", o.token.role, "VIEWER, REVIEWER or EDITOR")->capture_default_str();
}

void add_camera(CLI::App& app, Options& o) {
    app.add_option("--camera", o.camera.name, "Camera of the scene, by name or index from 0");
    app.add_option("--eye", o.camera.eye, "Eye, x,y,z in metres (with --target)");
    app.add_option("--target", o.camera.target, "Point looked at, x,y,z in metres");
    app.add_option("--fov", o.camera.fov, "Vertical field of view, degrees")
        ->capture_default_str()
        ->check(number_that([](double value) { return value >= 0.1 && value <= 179.0; },
                            "an angle of 0.1 to 179 degrees"));
}

void add_solving_time(CLI::App& app, Options& o) {
    app.add_option("--seconds", o.stop.seconds,
                   "Solving time (default: 10, without --iterations and --error)")
        ->check(positive());
    app.add_option("--iterations", o.stop.iterations,
                   "Number of iterations; no clock decides anything")
        ->check(positive());
}

void add_export(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output.file, "Folder to make: index.html and what it needs")
        ->required();
    app.add_flag("--force", o.export_scene.force,
                 "Replace an earlier walkthrough with all that is in its folder");
    add_camera(app, o);
    add_solving_time(app, o);
    app.add_option("--error", o.stop.error,
                   "Stop when the estimated relative error of a picture from the camera is below")
        ->check(relative_error());
}

void add_save(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output.file, "GLB file to write, with all that it needs")
        ->required();
    app.add_option(
        "--journal", o.serve.journal,
        "Journal of serve with the changes; none: the scene as its file has it (default: "
        "that of the scene in ~/.local/state/raybundle)");
    app.add_option("--scenes", o.serve.scenes,
                   "Folder that serve had, of photometric files and objects that were added");
}

void add_render(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output.file, "Picture to write: .exr (linear, cd/m²) or .png")
        ->required();
    add_camera(app, o);
    app.add_option("--size", o.render.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    add_solving_time(app, o);
    app.add_option("--error", o.stop.error,
                   "Stop when the estimated relative error is below, e.g. 0.02; "
                   "caustics that cannot be a tenth of it are skipped (not with --script, where "
                   "things move)")
        ->check(relative_error());
    app.add_option("--method", o.render.method,
                   "On the GPU combined, parallel-layered, parallel-plane, perspective; on the "
                   "CPU, as references, "
                   "path, path-reuse (path tracing, shared by neighbouring pixels), single-ray, "
                   "ray-cast (direct light alone), light, bidirectional, metropolis, photon-map")
        ->capture_default_str();
    app.add_option(
           "--bias-for-noise", o.render.bias_for_noise,
           "Cut off rare bright contributions as fits so many planned iterations; the result "
           "is then biased (0: never)")
        ->check(number_that([](double value) { return value >= 0.0 && value <= 1e9; },
                            "a number of 0 to 1e9"));
    app.add_flag("--constant-radiance", o.render.constant_radiance,
                 "Transfer only what radiance is beyond its mean; for matt, closed, evenly lit "
                 "rooms");
    app.add_flag("--random-faces", o.render.random_faces,
                 "Glossy surfaces send through the faces of their hemicubes that matter most, and "
                 "now and then through the others");
    app.add_flag("--patches", o.render.patches,
                 "Show the light of patches, interpolated, without gathering any at pixels: what a "
                 "walkthrough shows");
    add_method_options(app, o.render);
    app.add_option("--stats", o.render.stats, "Write statistics as JSON");
    app.add_option("--script", o.render.script,
                   "JSON file with keys over time: an image sequence, -o frame_%04d.png; seconds, "
                   "iterations and error are those of each frame")
        ->check(CLI::ExistingFile);
}

void add_accuracy(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output.file,
                   "Folder to write index.html, accuracy.json, plots to")
        ->required();
    add_camera(app, o);
    app.add_option("--size", o.accuracy.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    app.add_option("--seconds", o.stop.seconds, "Solving time of each run (default: 10)")
        ->check(number_that([](double value) { return value >= 0.1 && value <= 86400.0; },
                            "a number of 0.1 to 86400"));
    app.add_option("--methods", o.accuracy.methods,
                   "Methods of render, between commas (default: all but ray-cast and path-reuse)");
    app.add_option("--repeats", o.accuracy.repeats, "Runs of each method, with seeds one apart")
        ->capture_default_str()
        ->check(CLI::Range(1, 16));
    app.add_flag("--knobs", o.accuracy.knobs,
                 "Also vary patch size, bundle resolution, strategy probabilities, bias for noise, "
                 "gloss and variants of the iteration, one at a time");
    app.add_flag("--early", o.accuracy.early,
                 "Instead measure a viewer's pictures after 8 to 256 iterations, since nothing and "
                 "since a turn of the camera")
        ->excludes("--methods", "--knobs");
    app.add_option("--reference", o.accuracy.reference,
                   "Reference to compare with, .exr (default: path-traced, kept in the folder)");
    app.add_option("--reference-seconds", o.accuracy.reference_seconds,
                   "At most for each reference (default: 60 times --seconds)")
        ->check(positive());
}

}  // namespace

void define_options(CLI::App& app, Options& options) {
    app.description("Raybundle: global illumination in object space, served to browsers");
    app.set_version_flag("--version", "raybundle " RAYBUNDLE_VERSION);
    app.add_flag("--list-gpus", options.device.list_gpus, "List the EGL devices and exit");
    for (const CommandRow& row : command_table) {
        CLI::App* command = app.add_subcommand(row.name, row.help);
        command->callback([&options, row, command] {
            options.command = row.command;
            check_rows(*command, options);
            if (row.command == Options::Command::serve) {
                finish_serve(*command, options);
            } else if (row.command == Options::Command::work) {
                finish_work(*command, options);
            } else if (row.command == Options::Command::projects) {
                finish_projects(*command, options);
            }
        });
        if (row.command == Options::Command::token) {
            add_token(*command, options);
            continue;
        }
        if (row.command == Options::Command::projects) {
            add_projects(*command, options);
            continue;
        }
        add_common(*command, options);
        if (row.command == Options::Command::serve) {
            add_serve(*command, options);
            continue;
        }
        if (row.command == Options::Command::work) {
            add_work(*command, options);
            continue;
        }
        if (row.command != Options::Command::selftest) {
            add_scene(*command, options, row.scene_required);
        }
        if (row.command == Options::Command::render) {
            add_render(*command, options);
        } else if (row.command == Options::Command::export_scene) {
            add_export(*command, options);
        } else if (row.command == Options::Command::save) {
            add_save(*command, options);
        } else if (row.command == Options::Command::accuracy) {
            add_accuracy(*command, options);
        } else if (row.command == Options::Command::measure) {
            add_measure(*command, options);
        } else if (row.command == Options::Command::inspect) {
            command->add_flag("--json", options.inspect.json_to_stdout, "Print JSON");
            command->add_flag("--costs", options.inspect.costs,
                              "Measure what each effect costs on this machine, in some seconds");
            command
                ->add_option("--error", options.stop.error,
                             "Plan for pictures of this relative error: effects that cannot be a "
                             "tenth of it are skipped, as render --error does")
                ->check(relative_error());
            CLI::Option* const sheet =
                command->add_option("--contact-sheet", options.inspect.contact_sheet,
                                    "PNG of the scene with --effect and without, and its cost");
            CLI::Option* const effect = command->add_option("--effect", options.inspect.effect,
                                                            "Name of an effect of the plan");
            sheet->needs(effect);
            effect->needs(sheet);
        } else {
            command->add_option("--json", options.output.json_file,
                                "Also write the results as JSON (bench: plots beside it)");
            if (row.command == Options::Command::selftest) {
                command->add_flag("--photometry", options.selftest.photometry,
                                  "Points in the air against the cases of CIE 171:2006, chapter "
                                  "5, instead; needs no OpenGL");
            }
            if (row.command == Options::Command::bench) {
                command
                    ->add_option("--seconds", options.stop.seconds,
                                 "How long moves are followed (default: 3, and fewer variants)")
                    ->check(number_that([](double value) { return value >= 0.5 && value <= 600.0; },
                                        "a number of 0.5 to 600"));
                command->add_flag("--changes", options.bench.changes,
                                  "Only the time from a change to its corrected frame");
            }
        }
    }
    app.require_subcommand(0, 1);
}

RenderMethod parse_method(const std::string& method) {
    for (const MethodRow& row : method_table) {
        if (method == row.name) {
            return row.method;
        }
    }
    std::string names;
    for (const std::string& name : method_names()) {
        names += (names.empty() ? "" : ", ") + name;
    }
    throw UsageError("--method: '" + method + "' is none of " + names);
}

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MethodRow& row : method_table) {
        names.emplace_back(row.name);
    }
    return names;
}

}  // namespace raybundle
