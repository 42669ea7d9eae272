// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace raybundle {
namespace {

constexpr double default_seconds = 10.0;
constexpr double reference_factor =
    60.0;  // of a run's time, where --reference-seconds is not given
constexpr std::size_t most_methods = 32;

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> names;
    std::istringstream stream(list);
    for (std::string name; std::getline(stream, name, ',');) {
        names.push_back(name);
    }
    return names;
}

/// All that solve the whole transport but the reference's own, unless the user names some.
std::vector<std::string> chosen_methods(const Options& options) {
    if (options.accuracy.methods.empty()) {
        std::vector<std::string> names = method_names();
        std::erase(names, "ray-cast");
        std::erase(names, "path-reuse");
        return names;
    }
    std::vector<std::string> names = split(options.accuracy.methods);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
            names.begin() + static_cast<std::ptrdiff_t>(i)) {
            throw UsageError("--methods: '" + names[i] + "' is there twice");
        }
    }
    if (names.empty() || names.size() > most_methods) {
        throw UsageError("--methods: names between commas are wanted, as combined,path");
    }
    return names;
}

PlannedCurve planned(const std::string& method, const Options& options) {
    PlannedCurve curve{method, method, "", parse_method(method), {}, 1.0, PixelGrid::adaptive, ""};
    curve.solver.seed = options.scene.seed;
    if (const auto* probabilities = std::get_if<StrategyProbabilities>(&curve.how)) {
        curve.solver.probabilities = *probabilities;
    }
    return curve;
}

void add_patch_sizes(std::vector<PlannedCurve>& curves, const PlannedCurve& base) {
    for (const auto& [name, scale] : {std::pair{"edges halved", 0.5}, {"edges doubled", 2.0}}) {
        PlannedCurve curve = base;
        curve.knob = "patch size";
        curve.name = name;
        curve.patch_scale = scale;
        curves.push_back(curve);
    }
}

void add_resolutions(std::vector<PlannedCurve>& curves, const PlannedCurve& base) {
    for (const BundleResolution resolution :
         {BundleResolution{128, 200}, {256, 400}, {512, 800}, {1024, 1600}}) {
        PlannedCurve curve = base;
        curve.knob = "bundle resolution";
        curve.name = fmt::format("always {}, {}", resolution.hemicube, resolution.window);
        curve.solver.coarse = curve.solver.fine = resolution;
        curve.solver.coarse_iterations = std::numeric_limits<std::uint64_t>::max();
        curves.push_back(curve);
    }
}

void add_probabilities(std::vector<PlannedCurve>& curves, const PlannedCurve& base) {
    for (const StrategyProbabilities p : {StrategyProbabilities{0.05F, 0.0F, 0.95F},
                                          {0.15F, 0.0F, 0.85F},
                                          {0.3F, 0.0F, 0.7F},
                                          {0.6F, 0.0F, 0.4F},
                                          {0.15F, 0.15F, 0.7F}}) {
        PlannedCurve curve = base;
        curve.knob = "strategy probabilities";
        curve.name = fmt::format("P {:.2f}, {:.2f}, {:.2f}", p.layered, p.plane, p.perspective);
        curve.solver.probabilities = p;
        curve.solver.adapt_probabilities = false;
        curves.push_back(curve);
    }
}

/// Bias traded for noise over some horizons, and no separated main part.
void add_variants(std::vector<PlannedCurve>& curves, const PlannedCurve& base) {
    for (const std::uint64_t horizon : {50U, 500U, 5000U}) {
        PlannedCurve curve = base;
        curve.knob = "bias for noise";
        curve.name = fmt::format("biased for {} iterations", horizon);
        curve.solver.noise_horizon = horizon;
        curves.push_back(curve);
    }
    PlannedCurve faces = base;
    faces.knob = "randomised hemicube";
    faces.name = "some faces of glossy shooters";
    faces.solver.random_faces = true;
    curves.push_back(faces);
    PlannedCurve matt = base;
    matt.knob = "glossy part";
    matt.name = "without gloss";
    matt.without = "glossy";
    curves.push_back(matt);
    PlannedCurve constant = base;
    constant.knob = "constant radiance";
    constant.name = "with a constant radiance term";
    constant.solver.constant_radiance = true;
    curves.push_back(constant);
    PlannedCurve centres = base;
    centres.knob = "finer pixels";
    centres.name = "light at the centres of pixels";
    centres.grid = PixelGrid::centres;
    curves.push_back(centres);
    PlannedCurve curve = base;
    curve.knob = "main part";
    curve.name = "without a separated main part";
    curve.solver.main_part = false;
    curves.push_back(curve);
}

/// Every knob of the first ray-bundle method, one at a time.
void add_knobs(std::vector<PlannedCurve>& curves) {
    const auto found = std::find_if(curves.begin(), curves.end(),
                                    [](const PlannedCurve& c) { return c.uses_bundles(); });
    if (found == curves.end()) {
        throw UsageError("--knobs: turns those of a ray-bundle method; --methods names none");
    }
    const PlannedCurve base = *found;
    add_patch_sizes(curves, base);
    add_resolutions(curves, base);
    add_variants(curves, base);
    if (base.solver.probabilities.layered > 0.0F && base.solver.probabilities.perspective > 0.0F) {
        add_probabilities(curves, base);
    }
}

}  // namespace

bool AccuracyJob::needs_gl() const {
    return std::any_of(curves.begin(), curves.end(),
                       [](const PlannedCurve& curve) { return curve.uses_bundles(); });
}

double AccuracyJob::run_seconds() const {
    return seconds * static_cast<double>(repeats * curves.size());
}

AccuracyJob plan_accuracy(const Options& options) {
    AccuracyJob job;
    for (const std::string& method : chosen_methods(options)) {
        job.curves.push_back(planned(method, options));
    }
    if (options.accuracy.knobs) {
        add_knobs(job.curves);
    }
    job.size = parse_size(options.accuracy.size);
    job.seconds = options.stop.seconds.value_or(default_seconds);
    job.repeats = options.accuracy.repeats;
    job.reference_seconds =
        options.accuracy.reference_seconds.value_or(reference_factor * job.seconds);
    return job;
}

}  // namespace raybundle
