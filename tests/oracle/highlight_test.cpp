// SPDX-License-Identifier: Apache-2.0
// Highlights of lights without extent in smooth surfaces, whose other reflections view rays show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "../reference/lit_room.h"
#include "scene/material/brdf.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::highlight_test {
namespace {

/// Black plastic, which does nothing but mirror.
Material polished() {
    Material material;
    material.base_colour = glm::vec3(0.0F);
    material.metallic = 0.0F;
    material.roughness = 0.08F;
    return material;
}

constexpr glm::vec3 lamp(0.0F, 2.0F, 1.0F);
constexpr glm::vec3 to_lamp_from_middle(0.0F, 2.0F, 1.0F);

/// A floor under one light, and a narrow view of where that mirrors it.
struct MirroredLight {
    MirroredLight(const Material& floor, PunctualKind kind, float intensity, bool of_sky) {
        b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 4, 4, b.add_material(floor));
        add_punctual_light(b, glm::mat4(1.0F), kind, lamp, -to_lamp_from_middle,
                           glm::vec3(intensity));
        b.scene.punctual_lights[0].of_sky = of_sky;
        solver.emplace(b.scene, b.mesh);
        programs.emplace(solver->scene());
        image.emplace(solver->scene(), solver->store(), *programs, glm::uvec2(16, 16));
        camera.eye = {0.0F, 2.0F, -1.0F};
        camera.target = glm::vec3(0.0F);
        camera.vertical_fov = 0.02F;
        image->set_camera(camera);
        picture = image->read_radiance();
    }

    SceneBuilder b;
    Camera camera;
    std::optional<Solver> solver;
    std::optional<ViewPrograms> programs;
    std::optional<ViewerImage> image;
    std::vector<glm::vec4> picture;
};

/// Greatest deviation of a pixel from the light's image by the whole BRDF, relative to its maximum.
double greatest_deviation(const Material& floor) {
    constexpr float intensity = 100.0F;  // cd
    MirroredLight view(floor, PunctualKind::point, intensity, false);
    const Brdf brdf = make_brdf(floor, floor.base_colour);
    const auto local = [](const glm::vec3& w) { return glm::vec3(w.x, w.z, w.y); };
    double greatest = 0.0;
    double deviation = 0.0;
    for (unsigned i = 0; i < view.picture.size(); ++i) {
        const auto probed = view.image->probe(glm::uvec2(i % 16, i / 16));
        const glm::vec3 to_lamp = lamp - probed->position;
        const glm::vec3 w_in = glm::normalize(to_lamp);
        const glm::vec3 w_out = glm::normalize(view.camera.eye - probed->position);
        const float exact = intensity * w_in.y / glm::dot(to_lamp, to_lamp) *
                            evaluate(brdf, local(w_in), local(w_out)).g;
        greatest = std::max(greatest, static_cast<double>(exact));
        deviation = std::max(deviation, static_cast<double>(std::abs(view.picture[i].g - exact)));
    }
    EXPECT_GT(greatest, 1000.0);  // cd/m²
    return deviation / greatest;
}

TEST(Highlight, IsThatOfTheWholeBrdf) {
    EXPECT_LT(greatest_deviation(polished()), 0.02);
    Material coated = polished();
    coated.specular = 0.0F;
    coated.clear_coat = 1.0F;
    coated.clear_coat_roughness = 0.08F;
    EXPECT_LT(greatest_deviation(coated), 0.02);
    coated.specular = 1.0F;  // and polished below
    EXPECT_LT(greatest_deviation(coated), 0.02);
}

/// View rays show the sun's disc, so that the lights that stand for it have none.
TEST(Highlight, OfTheSunIsItsDisc) {
    const auto brightest = [](bool of_sky) {
        const MirroredLight view(polished(), PunctualKind::directional, 1000.0F, of_sky);
        float result = 0.0F;
        for (const glm::vec4& pixel : view.picture) {
            result = std::max(result, pixel.g);
        }
        return result;
    };
    EXPECT_GT(brightest(false), 1000.0F);
    EXPECT_LT(brightest(true), 1.0F);
}

/// Radiance that a lamp of 0.5 m by 0.5 m, 1.5 m above and 1 m beside the origin, has in a floor
/// there, cd/m².
double exact_highlight(const Material& floor, const glm::vec3& eye, float luminance) {
    const Brdf brdf = make_brdf(floor, floor.base_colour);
    const auto local = [](const glm::vec3& w) { return glm::vec3(w.x, w.z, w.y); };
    constexpr int steps = 32;
    double sum = 0.0;
    for (int i = 0; i < steps * steps; ++i) {
        const glm::vec2 at =
            (glm::vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps) * 0.5F - 0.25F;
        const glm::vec3 to(at.x, 1.5F, 1.0F + at.y);
        const float square = glm::dot(to, to);
        const glm::vec3 w = to / std::sqrt(square);
        const float area = 0.25F / static_cast<float>(steps * steps);
        sum += static_cast<double>(luminance * area * w.y * w.y / square *
                                   evaluate(brdf, local(w), local(glm::normalize(eye))).g);
    }
    return sum;
}

/// A highlight of a broad lobe comes from bundles. It is right in the mean from the first ones on:
/// what is not known yet is not taken for dark.
TEST(Highlight, OfABroadLobeIsNotDimmedAtFirst) {
    Material floor = polished();
    floor.roughness = 0.4F;
    constexpr float luminance = 1000.0F;
    constexpr int seeds = 24;
    Camera camera;
    camera.eye = {0.0F, 1.5F, -1.0F};
    camera.target = glm::vec3(0.0F);
    camera.vertical_fov = 0.02F;
    SceneBuilder b;
    b.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 12, 12, b.add_material(floor));
    const auto lamp_material = b.add_material(glm::vec3(0.0F), glm::vec3(luminance));
    b.add_quad({-0.25F, 1.5F, 0.75F}, {0.5F, 0, 0}, {0, 0, 0.5F}, 1, 1, lamp_material);
    double mean = 0.0;
    double square = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
        SolverSettings settings;
        settings.seed = static_cast<std::uint64_t>(seed);
        Solver solver(b.scene, b.mesh, settings);
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, glm::uvec2(4, 4));
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < 24; ++i) {
            solver.step(receivers);
        }
        const double shown = static_cast<double>(image.read_radiance()[5].g);
        mean += shown / seeds;
        square += shown * shown / seeds;
    }
    const double error = std::sqrt((square - mean * mean) / (seeds - 1));
    const double exact = exact_highlight(floor, camera.eye, luminance);
    EXPECT_LT(error, 0.1 * exact);  // the test can tell 30 %
    EXPECT_NEAR(mean, exact, 3.0 * error);
}

}  // namespace
}  // namespace raybundle::highlight_test
