// SPDX-License-Identifier: Apache-2.0
// Textures in the picture: a pixel shows the mean over what it covers, near and far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <vector>

#include "oracle/scene_builder.h"
#include "scene/walk/camera_axes.h"
#include "solution/geometry/texture_levels.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle::texture_filter_test {
namespace {

constexpr float cell = 0.25F;   // m, of the pattern
constexpr double white = 80.0;  // cd/m², of what is unlit, see scene/scene.h

/// A chequered floor of 40 x 40 m, unlit, so that a pixel's radiance is its colour.
SceneBuilder chequered_floor() {
    SceneBuilder b;
    Texture chequers{"chequers", 16, 16, true, true, {}};
    for (int i = 0; i < 256; ++i) {
        const std::uint8_t value = (i % 16 < 8) == (i / 16 < 8) ? 255 : 0;
        chequers.rgba.insert(chequers.rgba.end(), {value, value, value, 255});
    }
    b.scene.textures.push_back(chequers);
    Material material;
    material.base_colour = glm::vec3(0.999F);
    material.base_colour_texture.texture = 0;
    material.metallic = 0.0F;
    material.specular = 0.0F;
    material.unlit = true;
    b.add_quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, 2, 2, b.add_material(material));
    b.add_quad({-1, 9, -1}, {2, 0, 0}, {0, 0, 2}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(1.0F)));
    for (std::size_t v = 0; v < b.mesh.positions.size(); ++v) {
        b.mesh.uvs[v] = glm::vec2(b.mesh.positions[v].x, b.mesh.positions[v].z) / (2.0F * cell);
    }
    return b;
}

/// The texture's stripes along one axis, linear between its texels.
double stripes(double along) {
    const double texel = along / double{cell} * 8.0 - 0.5;
    const auto at = [](double i) { return std::fmod(std::fmod(i, 16.0) + 16.0, 16.0) < 8.0; };
    const double below = std::floor(texel);
    const double share = texel - below;
    return (at(below) ? 1.0 - share : 0.0) + (at(below + 1.0) ? share : 0.0);
}

double pattern(double x, double z) {
    const double a = stripes(x);
    const double b = stripes(z);
    return a * b + (1.0 - a) * (1.0 - b);
}

/// Mean of the pattern over a pixel (row 0 at the top), from a grid of n x n rays.
double mean_in_pixel(const Camera& camera, glm::uvec2 size, glm::uvec2 pixel, int n) {
    const CameraAxes axes = camera_axes(camera, size);
    double sum = 0.0;
    for (int k = 0; k < n * n; ++k) {
        const glm::dvec2 at =
            (glm::dvec2(pixel) + (glm::dvec2(k % n, k / n) + 0.5) / double(n)) / glm::dvec2(size);
        const glm::dvec3 d = glm::dvec3(axes.forward) +
                             (2.0 * at.x - 1.0) * glm::dvec3(axes.right) +
                             (1.0 - 2.0 * at.y) * glm::dvec3(axes.up);
        const double t = -static_cast<double>(camera.eye.y) / d.y;
        sum += pattern(static_cast<double>(camera.eye.x) + t * d.x,
                       static_cast<double>(camera.eye.z) + t * d.z);
    }
    return sum / (n * n);
}

struct Deviation {
    double rms = 0.0, greatest = 0.0;
    void add(double difference) {
        rms += difference * difference;
        greatest = std::max(greatest, std::abs(difference));
    }
};

class TextureFilter : public testing::TestWithParam<float> {};

TEST_P(TextureFilter, APixelShowsTheMeanOfWhatItCovers) {
    const SceneBuilder b = chequered_floor();
    const Solver solver(b.scene, b.mesh, {});
    const ViewPrograms programs(solver.scene());
    constexpr glm::uvec2 size(64, 64);
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    Camera camera;
    camera.eye = {0.1F, 1.0F, -8.0F};
    camera.target = camera.eye + glm::vec3(0.3F, -std::tan(GetParam()), 1.0F);
    camera.vertical_fov = 0.12F;
    image.set_camera(camera);
    const std::vector<glm::vec4> picture = image.read_radiance();
    Deviation filtered;
    Deviation centre;
    for (unsigned i = 0; i < size.x * size.y; ++i) {
        const glm::uvec2 pixel(i % size.x, i / size.x);
        const double exact = mean_in_pixel(camera, size, pixel, 24);
        filtered.add(static_cast<double>(picture[i].g) / white - exact);
        centre.add(mean_in_pixel(camera, size, pixel, 1) - exact);
    }
    filtered.rms = std::sqrt(filtered.rms / (size.x * size.y));
    centre.rms = std::sqrt(centre.rms / (size.x * size.y));
    // Seen: 0.001, 0.008, 0.020, 0.025 rms, 0.18 at most; by centres alone 0.001, 0.008, 0.11,
    // 0.29.
    EXPECT_LT(filtered.rms, 0.03);
    EXPECT_LT(filtered.greatest, 0.22);
    EXPECT_LT(filtered.rms, 0.2 * centre.rms + 0.01);
}

// From a steep view of large cells to a grazing one, where a pixel covers many of them.
INSTANTIATE_TEST_SUITE_P(Angles, TextureFilter, testing::Values(1.2F, 0.4F, 0.17F, 0.1F));

TEST(TextureLevels, AreMeansOfLight) {
    // 5 x 3: halves are not whole texels. Levels: 5x3, 2x1, 1x1.
    Texture texture{"odd", 5, 3, true, true, {}};
    for (int i = 0; i < 15; ++i) {
        const std::uint8_t value = i % 5 < 2 ? 255 : 0;
        texture.rgba.insert(texture.rgba.end(), {value, value, 0, 255});
    }
    std::vector<std::uint32_t> texels = {7};
    append_colour_levels(texture, texels);
    ASSERT_EQ(texels.size(), 1U + 15U + 2U + 1U);
    EXPECT_EQ(texels[1], 0xff00ffffU);
    EXPECT_EQ(texels[3], 0xff000000U);
    EXPECT_EQ(texels[16] & 0xffU, 231U);  // 2 of 2.5 columns: light 0.8
    EXPECT_EQ(texels[17] & 0xffU, 0U);
    EXPECT_EQ(texels[18], 0xff00aaaaU);  // light 0.4
}

}  // namespace
}  // namespace raybundle::texture_filter_test
