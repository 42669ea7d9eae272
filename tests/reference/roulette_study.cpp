// SPDX-License-Identifier: Apache-2.0
#include "roulette_study.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace raybundle {
WalkScene constant_scene() {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto wall = b.add_material(glm::vec3(0.1F * glm::pi<float>()), glm::vec3(1.0F));
    add_sphere(b, glm::vec3(0.0F), 1.0F, 24, true, wall);
    return {b, camera_at({0.2F, 0.1F, -0.5F}, {0, 0, 1}, 1.2F)};
}

WalkScene lamp_scene(float albedo) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto add_ball = [&](const glm::vec3& centre, float radius, float emission) {
        add_sphere(b, centre, radius, 12, false,
                   b.add_material(glm::vec3(albedo), glm::vec3(emission)));
    };
    add_sphere(b, glm::vec3(0.0F), 1.0F, 24, true, b.add_material(glm::vec3(albedo)));
    add_ball({0.3F, -0.2F, 0.3F}, 0.25F, 0.5F);
    add_ball({-0.4F, -0.1F, 0.2F}, 0.15F, 1.0F);
    add_ball({0.0F, 0.3F, 0.5F}, 0.1F, 0.2F);
    b.add_quad({-0.2F, 0.7F, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}, 1, 1,
               b.add_material(glm::vec3(albedo), glm::vec3(10.0F)));  // faces down
    b.add_quad({-0.2F, 0.7F, -0.2F}, {0, 0, 0.4F}, {0.4F, 0, 0}, 1, 1,
               b.add_material(glm::vec3(albedo)));
    return {b, camera_at({0.0F, 0.0F, -0.8F}, {0, 0, 1}, 1.2F)};
}

WalkScene room_scene() {
    SceneBuilder b = enclosure(0.7F);
    const auto red = b.add_material({0.7F, 0.1F, 0.1F});
    const auto dark = b.add_material(glm::vec3(0.2F));
    for (std::size_t i = 0; i < b.mesh.triangle_count(); ++i) {
        if (b.cell_centre(i).x < 0.01F) {
            b.set_triangle_material(i, red);
        } else if (b.cell_centre(i).y < 0.01F) {
            b.set_triangle_material(i, dark);
        }
    }
    b.add_box({2.0F, 0, 1.5F}, {3.0F, 1.6F, 2.5F}, false, 1, b.add_material({0.3F, 0.5F, 0.8F}));
    return {b, camera_at({0.6F, 2.0F, 0.3F}, {2.4F, 1.0F, 3.5F}, 1.1F)};
}

WalkVariance measure_variance(const WalkScene& walk_scene, double survival, std::uint32_t walks,
                              double rays_per_pixel) {
    PathSettings settings;
    settings.next_event = false;
    settings.certain_bounces = 1;
    settings.survival = Survival::fixed;
    settings.survival_probability = survival;
    const Tracing tracing(walk_scene.builder, settings);
    const CameraRays camera(tracing.scene, walk_scene.camera, study_size);
    std::vector<double> variances(std::size_t{study_size.x} * study_size.y);
    tbb::parallel_for(std::size_t{0}, variances.size(), [&](std::size_t pixel) {
        const glm::dvec2 centre = camera.corner(pixel) + 0.5;
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t i = 0; i < walks; ++i) {
            PixelSampler sampler(1, static_cast<std::uint32_t>(pixel), i, 0);
            const glm::dvec3 found =
                tracing.tracer.radiance(camera.origin(), camera.direction(centre), sampler);
            const double value = luminance(glm::vec3(found));
            sum += value;
            squares += value * value;
        }
        variances[pixel] = (squares - sum * sum / walks) / (walks - 1.0);
    });
    // Variance after N rays: N (1 - s) walks.
    const double scale = 1.0 / (rays_per_pixel * (1.0 - survival));
    WalkVariance result{survival, 0.0, 0.0};
    const auto count = static_cast<double>(variances.size());
    double squares = 0.0;
    for (const double variance : variances) {
        result.variance += scale * variance / count;
        squares += scale * scale * variance * variance;
    }
    // Of the pixels' own noise, as large as if every one had the kurtosis of the picture; pixels
    // that differ make it larger than it is.
    result.standard_error =
        std::sqrt(std::max(squares / count - result.variance * result.variance, 0.0) / count);
    return result;
}

}  // namespace raybundle
