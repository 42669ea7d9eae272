// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_measurement.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/render_job.h"
#include "commands/accuracy_reference.h"
#include "journal/session_journal.h"
#include "reference/measures/emitter_pixels.h"
#include "research/accuracy/error_map.h"
#include "research/accuracy/scene_fingerprint.h"
#include "scene/effects/effect_removal.h"
#include "scene/effects/effects_plan.h"
#include "view/image/tone_curve.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// "Intel(R) Xeon(R) CPU, 2 threads".
std::string processor_name() {
    std::ifstream stream("/proc/cpuinfo");
    std::string name = "CPU";
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            name = line.substr(colon + 2);
            break;
        }
    }
    return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

/// The mesh with longer or shorter edges; the scene itself stays as it is.
PatchMesh mesh_with_edges(const Scene& scene, const Options& options, double scale) {
    Scene copy = scene;
    TessellationSettings settings;
    settings.patch_size = options.scene.patch_size * static_cast<float>(scale);
    settings.target_patches =
        static_cast<std::size_t>(static_cast<double>(settings.target_patches) / (scale * scale));
    return tessellate(copy, settings);
}

/// All options of daylight; an image by its content.
std::string daylight_text(const Options& options) {
    std::string text = options.daylight.sky.text.empty() ? "own sky" : options.daylight.sky.text;
    for (const auto& number :
         {options.daylight.sky_zenith, options.daylight.sun_elevation, options.daylight.sun_azimuth,
          options.daylight.sun_illuminance, options.daylight.sun_diameter,
          options.daylight.ground_albedo, options.daylight.environment_rotation,
          options.daylight.environment_scale}) {
        text += number ? fmt::format(" {}", *number) : " -";
    }
    return options.daylight.environment.empty()
               ? text
               : text + " " + file_digest(options.daylight.environment).value_or("");
}

/// What decides how a scene's files are read, for the cache's key.
std::string reading_options(const Options& options) {
    return fmt::format("{} {} {} {}", RAYBUNDLE_VERSION, options.scene.unit, daylight_text(options),
                       fmt::join(options.scene.ies, " "));
}

}  // namespace

AccuracyMeasurement::AccuracyMeasurement(const Options& options, const AccuracyJob& job,
                                         const LoadedScene& loaded)
    : options_(options),
      job_(job),
      loaded_(loaded),
      camera_(choose_camera(loaded.scene, options)),
      ray_scene_(loaded.scene, loaded.mesh),
      lights_(ray_scene_),
      rays_(ray_scene_, camera_, job.size),
      measured_(measured_pixels(ray_scene_, rays_)),
      pictures_(std::size_t{job.size.x} * job.size.y) {
    leave_out_unable();
    if (std::find(measured_.begin(), measured_.end(), true) == measured_.end()) {
        throw std::runtime_error("every pixel sees a lamp or the sky: nothing to measure");
    }
}

/// Of the methods that nobody has named, those go that do not find all of the scene's light, and
/// knobs for what the scene has not. Throws std::runtime_error for named ones that cannot run.
void AccuracyMeasurement::leave_out_unable() {
    const EffectsPlan plan = plan_effects(loaded_.scene, loaded_.mesh.patch_count(), 0.0);
    std::erase_if(job_.curves, [&plan](const PlannedCurve& curve) {
        return !curve.without.empty() && !is_active(plan, curve.without);
    });
    std::erase_if(job_.curves, [this](const PlannedCurve& curve) {
        const auto* kind = std::get_if<ReferenceKind>(&curve.how);
        if (!kind) {
            return false;
        }
        const bool named = !options_.accuracy.methods.empty();
        const std::string reason = reason_against(*kind, ray_scene_);
        if (!reason.empty() && named) {
            throw std::runtime_error("--methods: " + curve.method + ": " + reason);
        }
        // What paths from the eye miss is missing in the reference, too.
        const std::string missed = *kind == ReferenceKind::light
                                       ? light_missed(*kind, ray_scene_, camera_, job_.size)
                                       : "";
        const bool left_out = !reason.empty() || (!missed.empty() && !named);
        if (!reason.empty() || !missed.empty()) {
            spdlog::warn("{}{}: {}", curve.method, left_out ? " is left out" : "",
                         reason.empty() ? missed : reason);
        }
        return left_out;
    });
    const std::string missed = light_missed(ReferenceKind::path, ray_scene_, camera_, job_.size);
    if (!missed.empty() && options_.accuracy.reference.empty()) {
        spdlog::warn(
            "the reference is path traced: {}. Methods that find that light look wrong "
            "beside it.",
            missed);
    }
}

void AccuracyMeasurement::run() {
    run_methods();
    make_reference();
}

void AccuracyMeasurement::run_methods() {
    double left = job_.run_seconds();
    std::size_t count = 0;
    for (const PlannedCurve& plan : job_.curves) {
        curves_.push_back({&plan, {}});
        for (std::size_t repeat = 0; repeat < job_.repeats; ++repeat) {
            left -= job_.seconds;
            progress_.begin(fmt::format("{} ({} of {})", plan.name, ++count,
                                        job_.curves.size() * job_.repeats));
            curves_.back().runs.push_back(run_once(plan, options_.scene.seed + repeat, left));
        }
    }
}

MethodRun AccuracyMeasurement::run_once(const PlannedCurve& plan, std::uint64_t seed,
                                        double seconds_after) {
    Scene scene = loaded_.scene;
    PatchMesh mesh = plan.patch_scale == 1.0
                         ? loaded_.mesh
                         : mesh_with_edges(loaded_.scene, options_, plan.patch_scale);
    if (!plan.without.empty()) {
        remove_effect(plan.without, scene, mesh);
    }
    const RunSurroundings around{scene,     mesh,         loaded_.scene, loaded_.mesh,
                                 camera_,   job_.size,    job_.seconds,  pictures_,
                                 progress_, seconds_after};
    return plan.uses_bundles()
               ? run_bundles(around, plan, seed)
               : run_on_cpu(around, ray_scene_, std::get<ReferenceKind>(plan.how), seed);
}

/// All pictures are means over the pixels' areas, and so is what they are compared with.
ReferenceKey AccuracyMeasurement::key() const {
    return {scene_fingerprint(options_.scene.file, reading_options(options_)), camera_, job_.size,
            PixelFilter::box};
}

std::string AccuracyMeasurement::own_reference_file() const {
    return (fs::path(options_.output.file) / "reference_area.exr").string();
}

void AccuracyMeasurement::take_named_reference() {
    reference_ = load_named_reference(options_.accuracy.reference, key());
    reference_file_ = options_.accuracy.reference;
    if (!reference_.noise) {
        spdlog::warn("{}: has no .json file of ours beside it, so its own noise is taken for 0",
                     options_.accuracy.reference);
    } else if (reference_.filter != PixelFilter::box) {
        throw std::runtime_error(options_.accuracy.reference +
                                 ": shows pixel centres, but pictures show means over pixels");
    }
}

void AccuracyMeasurement::make_reference() {
    if (!options_.accuracy.reference.empty()) {
        take_named_reference();
        return;
    }
    reference_file_ = own_reference_file();
    const ReferenceJob job{ray_scene_,
                           lights_,
                           rays_,
                           measured_,
                           key(),
                           reference_file_,
                           mixed_bits(options_.scene.seed ^ 0x7265666572656e63ULL),
                           job_.reference_seconds,
                           [this](const ReferencePicture& r) { return best_error(r); }};
    reference_ = raybundle::make_reference(job, progress_);
}

ImageMetrics AccuracyMeasurement::metrics(std::size_t picture, const ReferencePicture& r) const {
    return compare_images(pictures_.picture(picture), r.radiance, measured_);
}

double AccuracyMeasurement::best_error(const ReferencePicture& reference) const {
    double best = std::numeric_limits<double>::infinity();
    for (const CurveRuns& curve : curves_) {
        for (const MethodRun& run : curve.runs) {
            for (const RunCheckpoint& checkpoint : run.checkpoints) {
                CurvePoint point;
                set_measured(point, metrics(checkpoint.picture, reference), *reference.noise);
                best = std::min(best, point.relative_rmse);
            }
        }
    }
    return best;
}

ErrorCurve AccuracyMeasurement::measured_curve(const CurveRuns& curve) const {
    std::vector<ErrorCurve> runs;
    for (const MethodRun& run : curve.runs) {
        ErrorCurve measured{curve.plan->method,         curve.plan->name, curve.plan->knob,
                            curve.plan->uses_bundles(), run.settings,     {}};
        for (const RunCheckpoint& checkpoint : run.checkpoints) {
            measured.points.push_back(checkpoint.point);
            set_measured(measured.points.back(), metrics(checkpoint.picture, reference_),
                         reference_.noise.value_or(ReferenceNoise{}));
        }
        runs.push_back(std::move(measured));
    }
    return merged_runs(runs);
}

/// In the order of the plan; each knob begins with the curve whose settings are varied.
std::vector<ErrorCurve> AccuracyMeasurement::curves() const {
    std::vector<ErrorCurve> result;
    result.reserve(2 * curves_.size());  // so that base stays where it is
    const ErrorCurve* base = nullptr;
    for (const CurveRuns& curve : curves_) {
        ErrorCurve measured = measured_curve(curve);
        if (!measured.knob.empty() && base != nullptr && result.back().knob != measured.knob) {
            result.push_back(*base);
            result.back().knob = measured.knob;
            result.back().name = base->name + " as it comes";
        }
        result.push_back(std::move(measured));
        if (base == nullptr && curve.plan->uses_bundles()) {
            base = &result.back();
        }
    }
    return result;
}

void AccuracyMeasurement::add_pictures(AccuracyReport& report) const {
    const double factor = automatic_display_factor(reference_.radiance, measured_);
    report.pictures.push_back(
        {"reference", 0.0, 0.0, png_of(tone_mapped(reference_.radiance, factor), job_.size), ""});
    double p95 = 1.0;
    for (const CurveRuns& curve : curves_) {
        const auto& last = curve.runs.front().checkpoints.back();
        p95 = std::min(p95, metrics(last.picture, reference_).p95);
    }
    report.map_scale = error_map_scale(p95);
    for (const CurveRuns& curve : curves_) {
        if (!curve.plan->knob.empty()) {
            continue;
        }
        const auto& last = curve.runs.front().checkpoints.back();
        const std::vector<glm::dvec3> picture = pictures_.picture(last.picture);
        CurvePoint point;
        set_measured(point, metrics(last.picture, reference_),
                     reference_.noise.value_or(ReferenceNoise{}));
        report.pictures.push_back(
            {curve.plan->name, last.point.seconds, point.relative_rmse,
             png_of(tone_mapped(picture, factor), job_.size),
             png_of(error_map(picture, reference_.radiance, measured_, report.map_scale),
                    job_.size)});
    }
}

AccuracyReport AccuracyMeasurement::report(const std::string& device) const {
    AccuracyReport report;
    report.scene = loaded_.scene.name;
    report.camera = options_.camera.eye.empty()
                        ? camera_.name
                        : options_.camera.eye + " to " + options_.camera.target;
    report.device = device;
    report.processor = processor_name();
    report.size = job_.size;
    report.patches = loaded_.mesh.patch_count();
    report.seconds = job_.seconds;
    report.seed = options_.scene.seed;
    report.repeats = job_.repeats;
    // In the report's own folder a name is enough, and stays right where that is moved.
    const fs::path file = reference_file_;
    const bool beside = file == fs::path(own_reference_file());
    report.references.push_back({reference_.filter, reference_.method,
                                 (beside ? file.filename() : file).string(), reference_.noise,
                                 reference_.samples, reference_.seconds});
    report.curves = curves();
    add_pictures(report);
    return report;
}

}  // namespace raybundle
