// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bundle/hemicube.h"
#include "bundle/layered_window.h"
#include "bundle/low_discrepancy.h"
#include "transport/iteration_schedule.h"

namespace raybundle::bundle_test {
namespace {

TEST(LowDiscrepancy, RadicalInverseMirrorsDigits) {
    EXPECT_DOUBLE_EQ(radical_inverse(2, 0), 0.0);
    EXPECT_DOUBLE_EQ(radical_inverse(2, 1), 0.5);
    EXPECT_DOUBLE_EQ(radical_inverse(2, 6), 0.375);      // 110 -> 0.011
    EXPECT_DOUBLE_EQ(radical_inverse(3, 5), 7.0 / 9.0);  // 12 -> 0.21
}

TEST(LowDiscrepancy, EveryIntervalGetsItsShare) {
    const RandomisedHalton numbers(7);
    std::array<int, 16> counts{};
    for (std::uint64_t i = 1; i <= 1600; ++i) {
        ++counts[static_cast<std::size_t>(numbers.sample(0, i) * 16.0)];
    }
    for (const int count : counts) {
        EXPECT_NEAR(count, 100, 2);
    }
}

TEST(LowDiscrepancy, BatchesAreShiftedIndependently) {
    EXPECT_NE(RandomisedHalton(7).sample(0, 1), RandomisedHalton(8).sample(0, 1));
    EXPECT_EQ(RandomisedHalton(7).sample(0, 1), RandomisedHalton(7).sample(0, 1));
}

TEST(IterationSchedule, StrategiesComeInTheirProbabilities) {
    IterationSchedule schedule(1, {0.3F, 0.0F, 0.7F});
    int layered = 0;
    for (int i = 0; i < 8000; ++i) {
        layered += schedule.next().strategy == Strategy::layered ? 1 : 0;
    }
    EXPECT_NEAR(layered, 2400, 16);
}

/// Boxes of direction and plane get their share of plane bundles, however few there are of the
/// others.
TEST(IterationSchedule, PlanesCoverDirectionsAndScene) {
    IterationSchedule schedule(1, {0.1F, 0.5F, 0.4F});
    std::array<int, 64> counts{};
    int planes = 0;
    for (int i = 0; i < 8192; ++i) {
        const IterationSample sample = schedule.next();
        if (sample.strategy != Strategy::plane) {
            continue;
        }
        ++planes;
        const glm::vec3 d = sample.direction;
        const int z = std::min(static_cast<int>(2.0F * (d.z + 1.0F)), 3);
        const int quadrant = (d.x > 0.0F ? 1 : 0) + (d.y > 0.0F ? 2 : 0);
        const int cell = 16 * z + 4 * quadrant + static_cast<int>(sample.plane * 4.0);
        ++counts[static_cast<std::size_t>(cell)];
    }
    EXPECT_NEAR(planes, 4096, 4);
    for (const int count : counts) {
        EXPECT_NEAR(count, 64, 8);
    }
}

TEST(IterationSchedule, SeveralPlanesShareADirection) {
    IterationSchedule schedule(1, {0.0F, 1.0F, 0.0F}, false, 4);
    const IterationSample first = schedule.next();
    for (int i = 1; i < 4; ++i) {
        const IterationSample sample = schedule.next();
        EXPECT_EQ(sample.direction, first.direction);
        EXPECT_NEAR(std::abs(sample.plane - first.plane) * 4.0,
                    std::round(std::abs(sample.plane - first.plane) * 4.0), 1e-9);
        EXPECT_NE(sample.plane, first.plane);
    }
    EXPECT_NE(schedule.next().direction, first.direction);
}

/// Of 8 equal parts of [0, 1): how many hold the shooter number before one that lies in a narrow
/// interval.
std::size_t parts_before(bool shuffled) {
    IterationSchedule schedule(3, {0.0F, 0.0F, 1.0F}, shuffled);
    std::set<int> parts;
    float before = 0.0F;
    for (int i = 0; i < 4096; ++i) {
        const float now = schedule.next().shooter_numbers.x;
        if (i > 0 && now > 0.40F && now < 0.41F) {
            parts.insert(static_cast<int>(8.0F * before));
        }
        before = now;
    }
    return parts.size();
}

TEST(IterationSchedule, ShufflingBreaksTheTieBetweenASampleAndTheNext) {
    EXPECT_LE(parts_before(false), 2U) << "Halton's own order: the reason for shuffling";
    EXPECT_GE(parts_before(true), 7U);
}

TEST(IterationSchedule, ShufflingKeepsTheSamplesOfABlock) {
    constexpr int count = 4 * IterationSchedule::shooter_block;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        IterationSchedule plain(seed, {0.0F, 0.0F, 1.0F});
        IterationSchedule shuffled(seed, {0.0F, 0.0F, 1.0F}, true);
        std::vector<float> a;
        std::vector<float> b;
        for (int i = 0; i < count; ++i) {
            a.push_back(plain.next().shooter_numbers.x);
            b.push_back(shuffled.next().shooter_numbers.x);
        }
        EXPECT_NE(a, b);
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        EXPECT_EQ(a, b);
    }
}

/// How often one of the next 8 layered bundles goes nearly the way of a bundle, either way along
/// it, in units of how often independent directions would.
double returns(bool shuffled) {
    constexpr int count = 8192;
    constexpr int lags = 8;
    constexpr double cosine = 0.98;
    std::vector<glm::vec3> directions;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        IterationSchedule schedule(seed, {1.0F, 0.0F, 0.0F}, shuffled);
        for (int i = 0; i < count; ++i) {
            directions.push_back(schedule.next().direction);
        }
    }
    int near = 0;
    for (std::size_t i = 0; i + lags < directions.size(); ++i) {
        for (std::size_t lag = 1; lag <= lags; ++lag) {
            const auto along = static_cast<double>(glm::dot(directions[i], directions[i + lag]));
            near += std::abs(along) > cosine ? 1 : 0;
        }
    }
    const double independent = (1.0 - cosine) * lags * static_cast<double>(directions.size());
    return near / independent;
}

TEST(IterationSchedule, ShuffledDirectionsComeBackNearlyAsOftenAsIndependentOnes) {
    EXPECT_LT(returns(false), 0.4) << "Halton's own order: the reason for shuffling";
    // 5 standard errors. A block of 216 points has 4.3 others in a cap of 2 %, but for its own.
    EXPECT_NEAR(returns(true), 1.0 - 1.0 / 4.3, 0.08);
}

TEST(IterationSchedule, DirectionsCoverTheSphereEvenly) {
    glm::dvec3 sum(0.0);
    double z_squared = 0.0;
    constexpr int n = 4096;
    for (int i = 0; i < n; ++i) {
        const glm::vec3 d = uniform_direction(radical_inverse(2, static_cast<unsigned>(i)),
                                              radical_inverse(3, static_cast<unsigned>(i)));
        EXPECT_NEAR(glm::length(d), 1.0F, 1e-5F);
        sum += glm::dvec3(d);
        z_squared += static_cast<double>(d.z * d.z);
    }
    EXPECT_LT(glm::length(sum) / n, 2e-3);
    EXPECT_NEAR(z_squared / n, 1.0 / 3.0, 1e-3);
}

/// The rectangles of a box must hold every point of the box, whichever way the shooter looks.
TEST(Hemicube, CoveringRectanglesHoldTheBox) {
    const Hemicube hemicube(128);
    const Bounds box{{1.0F, 0.2F, 1.5F}, {1.4F, 0.9F, 2.0F}};
    for (int turn = 0; turn < 16; ++turn) {
        const BundleFrame frame =
            make_frame({0.0F, 0.1F, 0.0F}, glm::normalize(glm::vec3(0.2F, 0.5F, 1.0F)),
                       0.4F * static_cast<float>(turn));
        const auto rectangles = hemicube.covering(frame, std::array{box});
        int inside = 0;
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec3 d = frame.to_bundle(corner);
            ASSERT_GT(d.z, 0.0F);
            if (d.z < std::max(std::abs(d.x), std::abs(d.y))) {
                continue;  // on a side face
            }
            const glm::vec2 pixel = (glm::vec2(d.y, d.x) / d.z * 0.5F + 0.5F) * 128.0F;
            const PixelRectangle& top = rectangles[0];
            EXPECT_GE(pixel.x, static_cast<float>(top.x0));
            EXPECT_LE(pixel.x, static_cast<float>(top.x1));
            EXPECT_GE(pixel.y, static_cast<float>(top.y0));
            EXPECT_LE(pixel.y, static_cast<float>(top.y1));
            ++inside;
        }
        EXPECT_GT(inside, 0);
    }
}

TEST(Hemicube, ABoxRoundTheShooterNeedsEveryPixel) {
    const Hemicube hemicube(64);
    const Bounds box{glm::vec3(-1.0F), glm::vec3(1.0F)};
    const auto rectangles = hemicube.covering(make_frame({}, {0, 0, 1}, 0.3F), std::array{box});
    const auto full = hemicube.full();
    for (std::size_t face = 0; face < full.size(); ++face) {
        EXPECT_EQ(rectangles[face].width(), full[face].width());
        EXPECT_EQ(rectangles[face].height(), full[face].height());
    }
}

}  // namespace
}  // namespace raybundle::bundle_test
