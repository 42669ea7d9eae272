// SPDX-License-Identifier: Apache-2.0
#include "stated_error.h"

#include <algorithm>
#include <cmath>

#include "reference/measures/emitter_pixels.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {

namespace {

constexpr double noise_wanted = 0.007;
constexpr unsigned max_passes = 4096;

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

KnownPicture::KnownPicture(const ChangeCase& c) {
    Scene scene = last_scene(c);
    const PatchMesh mesh = tessellate(scene, {.patch_size = c.patch_size});
    const RayScene ray_scene(scene, mesh);
    const LightSampling lights(ray_scene);
    const CameraRays rays(ray_scene, camera_of(c), glm::uvec2(c.picture));
    measured_ = measured_pixels(ray_scene, rays);
    ReferenceMaker maker(ray_scene, lights, rays, measured_, PixelFilter::box, 77, std::nullopt);
    for (unsigned pass = 0; pass < max_passes && maker.noise() > noise_wanted; pass += 16) {
        for (int i = 0; i < 16; ++i) {
            maker.add_pass();
        }
    }
    reference_ = maker.result();
    double sum = 0.0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (measured_[i]) {
            sum += glm::dot(reference_.radiance[i], reference_.radiance[i]) / 3.0;
            ++pixels;
        }
    }
    light_ = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(pixels, 1)));
}

StatedError KnownPicture::judge(const Served& served) const {
    double sum = 0.0;
    double light = 0.0;
    double along = 0.0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (measured_[i]) {
            along += glm::dot(glm::dvec3(glm::vec3(served.radiance[i])), reference_.radiance[i]);
            const glm::dvec3 difference =
                glm::dvec3(glm::vec3(served.radiance[i])) - reference_.radiance[i];
            sum += glm::dot(difference, difference);
            light += glm::dot(reference_.radiance[i], reference_.radiance[i]);
        }
    }
    StatedError result;
    const double square = light > 0.0 ? sum / light : 0.0;
    result.error = std::sqrt(std::max(square - noise() * noise(), 0.0));
    result.level = light > 0.0 ? along / light : 0.0;
    result.stated = served.stated.relative_error;
    result.low = served.stated.error_low;
    result.high = served.stated.error_high;
    return result;
}

StatedSummary summary_of(const std::vector<StatedError>& stated) {
    StatedSummary summary;
    std::vector<double> middle, low, high, ratio;
    double log_sum = 0.0, log_squares = 0.0;
    for (const StatedError& s : stated) {
        ++summary.pictures;
        summary.covered += s.error >= s.low && s.error <= s.high ? 1 : 0;
        summary.above += s.error > s.high ? 1 : 0;
        summary.level += s.level / static_cast<double>(stated.size());
        summary.error += s.error * s.error / static_cast<double>(stated.size());
        middle.push_back(s.stated);
        low.push_back(s.low);
        high.push_back(s.high);
        ratio.push_back(s.error > 0.0 ? s.high / s.error : 0.0);
        const double logarithm =
            s.error > 0.0 && s.stated > 0.0 ? std::log(s.error / s.stated) : 0.0;
        log_sum += logarithm;
        log_squares += logarithm * logarithm;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(stated.size(), 1));
    summary.log_mean = log_sum / count;
    summary.log_deviation =
        std::sqrt(std::max(log_squares / count - summary.log_mean * summary.log_mean, 0.0));
    summary.error = std::sqrt(summary.error);
    summary.stated = median(middle);
    summary.low = median(low);
    summary.high = median(high);
    summary.high_over_error = median(ratio);
    return summary;
}

}  // namespace raybundle
