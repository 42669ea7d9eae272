// SPDX-License-Identifier: Apache-2.0
// Temporal change of the picture on a slow camera path, after compensation: every pixel is compared
// with what the frame before shows at the same surface point.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <vector>

#include "../oracle/moved_box.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 size(320, 240);
constexpr int frames = 24;
constexpr std::uint64_t iterations_a_frame = 2;

Camera camera_at(int frame) {
    const float t = static_cast<float>(frame) / frames;
    Camera camera;
    camera.eye = {0.2F + 0.5F * t, 1.6F, 0.2F};  // 2 cm a frame
    camera.target = {3.0F - 0.5F * t, 0.8F, 3.0F};
    return camera;
}

/// A picture with the surface points that its pixels show, row 0 at the top.
struct Frame {
    Camera camera;
    std::vector<glm::vec4> radiance;
    std::vector<std::optional<PixelProbe>> points;
};

/// Surface points of all pixels, row 0 at the top; in parts that one dispatch has room for.
std::vector<std::optional<PixelProbe>> points_of(ViewerImage& image) {
    constexpr unsigned rows = 16;
    std::vector<std::optional<PixelProbe>> points;
    for (unsigned first = 0; first < size.y; first += rows) {
        std::vector<glm::uvec2> pixels;
        for (unsigned i = 0; i < rows * size.x; ++i) {
            pixels.emplace_back(i % size.x, first + i / size.x);
        }
        const auto some = image.probe(pixels);
        points.insert(points.end(), some.begin(), some.end());
    }
    return points;
}

/// Pixel coordinates of a world point, whole at the centres of pixels.
glm::vec2 project(const Camera& camera, const glm::vec3& point) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const glm::vec4 clip = glm::perspective(camera.vertical_fov, aspect, 0.01F, 100.0F) *
                           glm::lookAt(camera.eye, camera.target, camera.up) *
                           glm::vec4(point, 1.0F);
    const glm::vec2 ndc = glm::vec2(clip) / clip.w;
    return glm::vec2(0.5F + 0.5F * ndc.x, 0.5F - 0.5F * ndc.y) * glm::vec2(size) - 0.5F;
}

bool same_surface(const std::optional<PixelProbe>& a, const std::optional<PixelProbe>& b) {
    return a && b && a->object == b->object && glm::dot(a->normal, b->normal) > 0.99F;
}

/// What a frame shows at a surface point, interpolated; nothing at edges, out of sight and outside.
std::optional<float> shown_at(const Frame& frame, const std::optional<PixelProbe>& point) {
    const glm::vec2 place = project(frame.camera, point->position);
    const glm::vec2 low = glm::floor(place);
    if (low.x < 0.0F || low.y < 0.0F || low.x + 1.0F >= static_cast<float>(size.x) ||
        low.y + 1.0F >= static_cast<float>(size.y)) {
        return std::nullopt;
    }
    const glm::vec2 f = place - low;
    const std::size_t corner =
        static_cast<std::size_t>(low.y) * size.x + static_cast<std::size_t>(low.x);
    const std::array<std::pair<std::size_t, float>, 4> corners = {
        {{corner, (1.0F - f.x) * (1.0F - f.y)},
         {corner + 1, f.x * (1.0F - f.y)},
         {corner + size.x, (1.0F - f.x) * f.y},
         {corner + size.x + 1, f.x * f.y}}};
    float sum = 0.0F;
    for (const auto& [pixel, share] : corners) {
        if (!same_surface(frame.points[pixel], point)) {
            return std::nullopt;
        }
        sum += share * frame.radiance[pixel].g;
    }
    return sum;
}

/// <= 1 % of their value, on average over all pixels that both frames show. Just so: 0.98 % here,
/// with one seed. Small pictures do not keep to it, at bundles of any size: 1.17 % at 96x72 with
/// these, 1.15 % with 256 and 400 pixels.
TEST(Flicker, OfASlowCameraPathIsBelowOnePercent) {
    const SceneBuilder b = room_with_box({1.9F, 0.0F, 2.0F});
    Solver solver(b.scene, b.mesh, quick_settings(41, {96, 150}));
    const ViewPrograms programs(solver.scene());
    ViewerImage image(solver.scene(), solver.store(), programs, size);
    BundleReceiver* const receivers[] = {&image};
    constexpr std::size_t pixels = std::size_t{size.x} * size.y;
    const auto next_frame = [&](int frame, std::uint64_t iterations) {
        image.set_camera(camera_at(frame));
        const std::uint64_t end = solver.iterations() + iterations;
        while (solver.iterations() < end) {
            solver.step(receivers);
        }
        return Frame{camera_at(frame), image.read_radiance(), points_of(image)};
    };
    Frame before = next_frame(0, 768);
    for (std::size_t i = 0; i < pixels; i += 97) {
        ASSERT_TRUE(before.points[i].has_value());
        const glm::vec2 place = project(before.camera, before.points[i]->position);
        ASSERT_LT(glm::distance(place, glm::vec2(i % size.x, i / size.x)), 0.05F) << i;
    }
    double change = 0.0;
    std::size_t compared = 0;
    for (int k = 1; k <= frames; ++k) {
        const Frame now = next_frame(k, iterations_a_frame);
        for (std::size_t i = 0; i < pixels; ++i) {
            if (const auto shown = shown_at(before, now.points[i])) {
                const float value = now.radiance[i].g;
                change += static_cast<double>(std::abs(value - *shown) / std::max(value, 1e-6F));
                ++compared;
            }
        }
        before = now;
    }
    EXPECT_GT(compared, pixels * frames * 7 / 10);
    EXPECT_LT(change / static_cast<double>(compared), 0.01);
    RecordProperty("change", std::to_string(change / static_cast<double>(compared)));
}

}  // namespace
}  // namespace raybundle
