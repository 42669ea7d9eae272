// SPDX-License-Identifier: Apache-2.0
#include "judged_scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "reference/measures/emitter_pixels.h"
#include "reference/measures/image_metrics.h"
#include "scene/gltf/gltf_loader.h"
#include "transport/solver.h"

namespace raybundle {
namespace {

const glm::uvec2 size(48, 48);
constexpr std::uint64_t interval = 16;
constexpr std::uint64_t reference_seed = 77;

Scene shipped_scene(const std::string& file) {
    return load_gltf(std::string(RAYBUNDLE_SCENES) + "/" + file);
}

PatchMesh mesh_of(Scene& scene, float patch_size) {
    TessellationSettings settings;
    settings.patch_size = patch_size;
    return tessellate(scene, settings);
}

ErrorInterval interval_of(const ImageStatistics& s) {
    return {s.relative_error, s.error_low, s.error_high};
}

}  // namespace

JudgedScene::JudgedScene(const std::string& file, float patch_size, unsigned passes)
    : scene_(shipped_scene(file)),
      mesh_(mesh_of(scene_, patch_size)),
      camera_(scene_.cameras.front()) {
    const RayScene ray_scene(scene_, mesh_);
    const LightSampling lights(ray_scene);
    const CameraRays rays(ray_scene, camera_, size);
    measured_ = measured_pixels(ray_scene, rays);
    ReferenceMaker maker(ray_scene, lights, rays, measured_, PixelFilter::box, reference_seed,
                         std::nullopt);
    for (unsigned pass = 0; pass < passes; ++pass) {
        maker.add_pass();
    }
    reference_ = maker.result();
}

double JudgedScene::error_of(const std::vector<glm::vec4>& radiance) const {
    const std::vector<glm::dvec3> picture(radiance.begin(), radiance.end());
    const double measured = compare_images(picture, reference_.radiance, measured_).relative_rmse;
    return std::sqrt(std::max(measured * measured - reference_noise() * reference_noise(), 0.0));
}

void JudgedScene::run(std::uint64_t seed, double target,
                      const std::function<bool(const JudgedPicture&)>& goes_on) const {
    SolverSettings settings;
    settings.seed = seed;
    Solver solver(scene_, mesh_, settings);
    const ViewPrograms programs(solver.scene());
    FinalPicture picture(solver.scene(), solver.store(), programs, camera_, size);
    picture.check_by(std::make_unique<SpotCheck>(std::make_shared<const TracedScene>(scene_, mesh_),
                                                 camera_, size, mixed_bits(seed)));
    ViewerImage viewer(solver.scene(), solver.store(), programs, size);
    viewer.set_camera(camera_);
    viewer.smooth();
    BundleReceiver* const receivers[] = {&picture.receiver(), &viewer};
    JudgedPicture judged;
    do {
        for (std::uint64_t i = 0; i < interval; ++i) {
            picture.prepare();
            solver.step(receivers);
        }
        viewer.request_statistics();
        viewer.finish_statistics();
        judged = {solver.iterations(),
                  error_of(picture.read_radiance()),
                  interval_of(picture.measure()),
                  picture.samples_factor_to(target),
                  error_of(viewer.read_radiance()),
                  interval_of(viewer.statistics())};
    } while (goes_on(judged));
}

void Coverage::add(double error, const ErrorInterval& said) {
    ++pictures;
    above += error > said.high ? 1 : 0;
    below += error < said.low ? 1 : 0;
    covered = pictures - above - below;
    widths += 0.5 * (said.high - said.low) / said.error;
}

std::string Coverage::text() const {
    std::ostringstream out;
    out << pictures << " pictures, " << 100.0 * share() << " % covered, " << above << " above, "
        << below << " below, +-" << 100.0 * half_width() << " %";
    return out.str();
}

}  // namespace raybundle
