// SPDX-License-Identifier: Apache-2.0
#include "cli_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <map>

namespace raybundle {

namespace {

struct CommandRow {
    const char* name;
    const char* help;
    Options::Command command;
    bool scene_required;
};

constexpr CommandRow command_table[] = {
    {"serve", "Serve a scene to browsers", Options::Command::serve, true},
    {"render", "Render a picture to EXR or PNG", Options::Command::render, true},
    {"inspect", "Report on a scene: size, objects, lights, defects", Options::Command::inspect,
     true},
    {"bench", "Measure speed on this machine", Options::Command::bench, false},
    {"selftest", "Compare with closed forms on this machine", Options::Command::selftest, false},
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
    {"single-ray", ReferenceKind::single_ray},
    {"ray-cast", ReferenceKind::ray_cast},
};

std::string method_names() {
    std::string names;
    for (const MethodRow& row : method_table) {
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    return names;
}

void add_common(CLI::App& app, Options& o) {
    app.add_option("--gpu", o.gpu, "EGL device number, see --list-gpus")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--unit", o.unit, "Length unit of the scene file: m, cm, mm, in, ft")
        ->capture_default_str();
    app.add_option("--sky", o.sky, "Luminance of a uniform sky, cd/m²")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--log-level", o.log_level, "trace, debug, info, warn, error, off")
        ->capture_default_str()
        ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
}

void add_scene(CLI::App& app, Options& o, bool required) {
    auto* scene = app.add_option("SCENE", o.scene, "glTF 2.0 file, .gltf or .glb");
    if (required) {
        scene->required();
    }
    app.add_option("--patch-size", o.patch_size,
                   "Target edge of the patches, m (default: about 25 000 patches)")
        ->check(CLI::PositiveNumber);
    app.add_option("--seed", o.seed, "Of all random numbers")->capture_default_str();
}

void add_serve(CLI::App& app, Options& o) {
    app.add_option("--listen", o.listen, "Address and port; port 0: any free one")
        ->capture_default_str();
    app.add_flag("--allow-remote", o.allow_remote, "Listen beyond this machine without tokens");
    app.add_option("--tls-cert", o.tls_cert, "PEM certificate chain");
    app.add_option("--tls-key", o.tls_key, "PEM private key");
}

void add_render(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.output, "Picture to write: .exr (linear, cd/m²) or .png")
        ->required();
    app.add_option("--camera", o.camera, "Camera of the scene, by name or index from 0");
    app.add_option("--eye", o.eye, "Eye, x,y,z in metres (with --target)");
    app.add_option("--target", o.target, "Point looked at, x,y,z in metres");
    app.add_option("--fov", o.fov, "Vertical field of view, degrees")
        ->capture_default_str()
        ->check(CLI::Range(0.1F, 179.0F));
    app.add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    app.add_option("--seconds", o.seconds, "Solving time")->check(CLI::PositiveNumber);
    app.add_option("--iterations", o.iterations, "Number of iterations; no clock decides anything")
        ->check(CLI::PositiveNumber);
    app.add_option("--error", o.error, "Stop when the estimated relative error is below, e.g. 0.02")
        ->check(CLI::PositiveNumber);
    app.add_option("--method", o.method,
                   "On the GPU combined, parallel-layered, perspective; on the CPU, as references, "
                   "path, single-ray, ray-cast (direct light alone)")
        ->capture_default_str();
    app.add_option("--stats", o.stats, "Write statistics as JSON");
}

float parse_float(const std::string& option, const std::string& text) {
    float value = 0.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw UsageError(option + ": '" + text + "' is not a number");
    }
    return value;
}

}  // namespace

void define_options(CLI::App& app, Options& options) {
    app.description("Raybundle: global illumination in object space, served to browsers");
    app.set_version_flag("--version", "raybundle " RAYBUNDLE_VERSION);
    app.add_flag("--list-gpus", options.list_gpus, "List the EGL devices and exit");
    for (const CommandRow& row : command_table) {
        CLI::App* command = app.add_subcommand(row.name, row.help);
        command->callback([&options, row] { options.command = row.command; });
        add_common(*command, options);
        if (row.command != Options::Command::selftest) {
            add_scene(*command, options, row.scene_required);
        }
        if (row.command == Options::Command::serve) {
            add_serve(*command, options);
        } else if (row.command == Options::Command::render) {
            add_render(*command, options);
        } else if (row.command == Options::Command::inspect) {
            command->add_flag("--json", options.json_to_stdout, "Print JSON");
        } else {
            command->add_option("--json", options.json_file, "Also write the results as JSON");
        }
    }
    app.require_subcommand(0, 1);
}

glm::uvec2 parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    unsigned width = 0;
    unsigned height = 0;
    const char* end = text.data() + text.size();
    const bool ok =
        cross != std::string::npos &&
        std::from_chars(text.data(), text.data() + cross, width).ptr == text.data() + cross &&
        std::from_chars(text.data() + cross + 1, end, height).ptr == end;
    if (!ok || width < 1 || height < 1 || width > 16384 || height > 16384) {
        throw UsageError("--size: '" + text + "' is not WIDTHxHEIGHT with 1..16384 pixels each");
    }
    return {width, height};
}

glm::vec3 parse_vector(const std::string& option, const std::string& text) {
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos) {
        throw UsageError(option + ": '" + text + "' is not x,y,z");
    }
    return {parse_float(option, text.substr(0, first)),
            parse_float(option, text.substr(first + 1, second - first - 1)),
            parse_float(option, text.substr(second + 1))};
}

std::pair<std::string, std::uint16_t> parse_address(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    unsigned port = 0;
    const char* end = text.data() + text.size();
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size() ||
        std::from_chars(text.data() + colon + 1, end, port).ptr != end || port > 65535) {
        throw UsageError("--listen: '" + text + "' is not HOST:PORT, e.g. 127.0.0.1:8080");
    }
    std::string host = text.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    }
    return {host, static_cast<std::uint16_t>(port)};
}

float metres_per_unit(const std::string& unit) {
    static const std::map<std::string, float> units = {
        {"m", 1.0F}, {"cm", 0.01F}, {"mm", 0.001F}, {"in", 0.0254F}, {"ft", 0.3048F}};
    const auto found = units.find(unit);
    if (found == units.end()) {
        throw UsageError("--unit: '" + unit + "' is none of m, cm, mm, in, ft");
    }
    return found->second;
}

RenderMethod parse_method(const std::string& method) {
    for (const MethodRow& row : method_table) {
        if (method == row.name) {
            return row.method;
        }
    }
    throw UsageError("--method: '" + method + "' is none of " + method_names());
}

}  // namespace raybundle
