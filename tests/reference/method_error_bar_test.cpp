// SPDX-License-Identifier: Apache-2.0
// The error bars of the methods on the CPU against their true errors, over the pixels that errors
// are measured of: a lamp is in view, whose neighbours do not count.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "lit_room.h"
#include "reference/measures/emitter_pixels.h"
#include "reference/measures/image_metrics.h"
#include "research/reference_method.h"

namespace raybundle {
namespace {

constexpr glm::uvec2 judged_size(24, 18);
constexpr int runs = 40;
/// Chains of few steps are far from normal.
int samples_of(ReferenceKind kind) {
    return kind == ReferenceKind::metropolis ? 64 : 32;
}
constexpr int samples_of_truth = 2000;

class MethodErrorBar : public testing::TestWithParam<ReferenceKind> {
  protected:
    [[nodiscard]] std::unique_ptr<ReferenceMethod> run(ReferenceKind kind, std::uint64_t seed,
                                                       std::uint64_t iterations) const {
        auto method = make_reference_method(kind, scene_, camera_, judged_size, seed);
        while (method->iterations() < iterations) {
            method->iterate();
        }
        return method;
    }
    [[nodiscard]] const std::vector<bool>& measured() const { return measured_; }

    struct Truth {
        std::vector<glm::dvec3> picture;
        double noise = 0.0;
    };
    /// Made once for all methods.
    [[nodiscard]] const Truth& truth() const {
        static const Truth made = [this] {
            const auto paths = run(ReferenceKind::path_reuse, 1000, samples_of_truth);
            return Truth{paths->picture(), paths->error().relative};
        }();
        return made;
    }

  private:
    SceneBuilder builder_ = lit_room(glm::mat4(1.0F), 4);
    RayScene scene_{builder_.scene, builder_.mesh};
    Camera camera_ = lit_room_camera(glm::mat4(1.0F));
    std::vector<bool> measured_ = measured_pixels(scene_, CameraRays(scene_, camera_, judged_size));
};

TEST_P(MethodErrorBar, CoversTheTrueError) {
    int covered = 0;
    double ratio = 0.0;
    double width = 0.0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const auto method = run(GetParam(), seed, samples_of(GetParam()));
        const double off =
            compare_images(method->picture(), truth().picture, measured()).relative_rmse;
        const double error = std::sqrt(std::max(off * off - truth().noise * truth().noise, 0.0));
        const ImageError said = method->error();
        covered += said.low <= error && error <= said.high ? 1 : 0;
        ratio += error / said.relative / runs;
        width += (said.high - said.low) / (2.0 * said.relative) / runs;
    }
    // Of 95 % of all seeds 33 or fewer of 40 come once in 400 times.
    EXPECT_GE(covered, 34) << "true error over what was said: " << ratio;
    EXPECT_NEAR(ratio, 1.0, 0.05);
    EXPECT_LT(width, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodErrorBar,
                         testing::Values(ReferenceKind::path_reuse, ReferenceKind::light,
                                         ReferenceKind::bidirectional));
INSTANTIATE_TEST_SUITE_P(HeavyMethods, MethodErrorBar,
                         testing::Values(ReferenceKind::path, ReferenceKind::metropolis));

}  // namespace
}  // namespace raybundle
