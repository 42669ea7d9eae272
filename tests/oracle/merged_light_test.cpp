// SPDX-License-Identifier: Apache-2.0
// The light of several workers is one: what others have brought counts beside own samples, and no
// sample counts twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fresh_solves.h"
#include "moved_box.h"
#include "view/view_programs.h"
#include "view/viewer_image.h"

namespace raybundle::merged_light_test {
namespace {

constexpr glm::vec3 box_place(1.2F, 0.0F, 1.5F);

/// A worker: a solver with a seed of its own.
struct Worker {
    explicit Worker(std::uint64_t seed, std::uint64_t iterations = 0,
                    SceneBuilder room = room_with_box(box_place))
        : builder(std::move(room)),
          solver(builder.scene, builder.mesh, quick_settings(seed, {48, 64})) {
        iterate(solver, iterations);
    }

    /// As another worker gets it, in radiance units.
    [[nodiscard]] std::vector<glm::vec4> own() const {
        std::vector<glm::vec4> means(solver.scene().patch_count());
        const Buffer* const light = solver.store().own_light();
        if (light == nullptr) {
            return {};
        }
        light->read<glm::vec4>(means);
        return means;
    }

    SceneBuilder builder;
    Solver solver;
};

constexpr std::uint64_t iterations = 128;

/// Served means in radiance units.
std::vector<glm::vec4> served(const Worker& worker) {
    std::vector<glm::vec4> means = worker.solver.store().read_irradiance();
    const float unit = worker.solver.scene().radiance_unit();
    for (glm::vec4& mean : means) {
        mean = glm::vec4(glm::vec3(mean) / unit, mean.w);
    }
    return means;
}

void expect_weighted_mean(const std::vector<glm::vec4>& merged, const std::vector<glm::vec4>& a,
                          const std::vector<glm::vec4>& b) {
    ASSERT_EQ(merged.size(), a.size());
    for (std::size_t i = 0; i < merged.size(); ++i) {
        const glm::vec3 mean =
            (glm::vec3(a[i]) * a[i].w + glm::vec3(b[i]) * b[i].w) / (a[i].w + b[i].w);
        EXPECT_NEAR(merged[i].g, mean.g, 1e-5F * (1.0F + mean.g)) << "patch " << i;
        EXPECT_NEAR(merged[i].w, a[i].w + b[i].w, 1e-4F * merged[i].w) << "patch " << i;
    }
}

TEST(MergedLight, IsTheWeightedMeanOfAllWorkers) {
    Worker here(1, iterations);
    const Worker there(2, iterations / 2);
    const std::vector<glm::vec4> own = here.own();
    const std::vector<glm::vec4> others = there.own();
    EXPECT_EQ(own, served(here)) << "alone, all is own light";
    here.solver.store().merge(others, 2.0F);
    expect_weighted_mean(served(here), own, others);
    EXPECT_EQ(here.own(), own) << "what others have brought is not given back";
    // What comes in later is own light; what others publish later takes the place of the earlier.
    iterate(here.solver, iterations);
    const std::vector<glm::vec4> more = here.own();
    EXPECT_NEAR(more.front().w / own.front().w,
                Worker(1, 2 * iterations).own().front().w / own.front().w, 1e-4F);
    expect_weighted_mean(served(here), more, others);
    here.solver.store().merge(own, 2.0F);
    expect_weighted_mean(served(here), more, own);
}

/// Iterations know nothing of it: the worker's own light is what it would be alone.
TEST(MergedLight, LeavesOwnIterationsAsTheyAre) {
    Worker alone(1, iterations);
    Worker merging(1);
    const Worker there(2, iterations);
    merging.solver.store().merge(there.own(), 2.0F);  // before the first iteration
    iterate(merging.solver, iterations);
    EXPECT_LT(relative_difference(merging.own(), alone.own()), 0.02)
        << "but for slopes, which follow the merged light";
}

TEST(MergedLight, OfBeforeAChangeDoesNotCountAsSamplesSince) {
    Worker here(1, iterations);
    const Worker there(2, iterations);
    here.solver.store().merge(there.own(), 2.0F);
    const double settled_weight = static_cast<double>(served(here).front().w);
    move_box(here.solver, {2.6F, 0.0F, 2.4F});
    EXPECT_EQ(here.solver.store().sequences(), 1.0F);
    const std::vector<glm::vec4> own = here.own();
    ASSERT_FALSE(own.empty());
    EXPECT_EQ(own.front().w, 0.0F) << "own samples are counted from the change on";
    EXPECT_LE(static_cast<double>(served(here).front().w), settled_weight * 1.001)
        << "what was kept over it was merged once";
    iterate(here.solver, 16);
    EXPECT_GT(here.own().front().w, 0.0F);
    EXPECT_EQ(here.solver.own_light(), nullptr) << "it has not warmed up";
}

/// Mean squared relative deviation of patches from the mean of long solves.
double squared_error(const std::vector<glm::vec4>& light, const std::vector<double>& truth) {
    double sum = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double error = static_cast<double>(light[i].g) - truth[i];
        sum += error * error;
        all += truth[i] * truth[i];
    }
    return sum / all;
}

/// Two workers have half of the variance of one at as many iterations each.
TEST(MergedLight, HalvesTheVariance) {
    constexpr std::uint64_t pairs = 8;
    std::vector<std::vector<glm::vec4>> singles;
    for (std::uint64_t seed = 1; seed <= 2 * pairs; ++seed) {
        singles.push_back(Worker(seed, iterations).own());
    }
    std::vector<double> mean(singles.front().size(), 0.0);
    for (const auto& light : singles) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += static_cast<double>(light[i].g) / (2.0 * pairs);
        }
    }
    double alone = 0.0;
    double merged = 0.0;
    for (std::uint64_t pair = 0; pair < pairs; ++pair) {
        Worker here(2 * pair + 1, iterations);
        here.solver.store().merge(singles[2 * pair + 1], 2.0F);
        merged += squared_error(served(here), mean) / pairs;
        alone +=
            0.5 *
            (squared_error(singles[2 * pair], mean) + squared_error(singles[2 * pair + 1], mean)) /
            pairs;
    }
    // Deviations from the mean of the same solves: of singles 1 - 1/16, of pairs 1/2 - 1/16.
    alone /= 1.0 - 1.0 / (2.0 * pairs);
    merged += alone / (2.0 * pairs);
    RecordProperty("variance_of_two_over_one", std::to_string(merged / alone));
    EXPECT_NEAR(merged / alone, 0.5, 0.12);
}

/// As room_with_box() without a box, of as many patches as `serve` cuts a room into.
SceneBuilder fine_room() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 40, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    b.add_box({0.8F, 0, 1.1F}, {1.6F, 0.8F, 1.9F}, false, 8, wall);
    return b;
}

/// Pictures of a viewer, and their noise as stated, relative.
struct Seen {
    std::vector<glm::vec4> picture;
    double stated = 0.0;
};

/// Of somebody who has looked since the start, and of somebody who came 64 iterations ago.
struct Viewers {
    Seen first, late;
};

Seen seen_in(ViewerImage& image) {
    image.request_statistics();
    image.finish_statistics();
    return {image.read_radiance(), image.statistics().noise};
}

/// other_seed: of a worker that publishes as often as SolutionSharing does; 0: there is none.
Viewers viewers_of(std::uint64_t seed, std::uint64_t other_seed) {
    constexpr std::uint64_t all = 256;
    constexpr std::uint64_t of_late = 64;
    Worker here(seed, 0, fine_room());
    std::optional<Worker> there;
    if (other_seed != 0) {
        there.emplace(other_seed, 0, fine_room());
    }
    const ViewPrograms programs(here.solver.scene());
    const auto look = [&] {
        auto image = std::make_unique<ViewerImage>(here.solver.scene(), here.solver.store(),
                                                   programs, glm::uvec2(96, 72));
        Camera camera;
        camera.eye = {0.4F, 1.6F, 0.4F};
        camera.target = {3.0F, 0.6F, 4.0F};
        camera.vertical_fov = 1.1F;
        image->set_camera(camera);
        image->rest();
        return image;
    };
    const auto first = look();
    std::unique_ptr<ViewerImage> late;
    std::vector<BundleReceiver*> receivers{first.get()};
    std::uint64_t published = 16;
    for (std::uint64_t i = 1; i <= all; ++i) {
        here.solver.step(receivers);
        if (i == all - of_late) {
            late = look();
            receivers.push_back(late.get());
        }
        if (!there) {
            continue;
        }
        iterate(there->solver, 1);
        if (i % 8 == 0 && 8 * i >= 9 * published) {
            here.solver.store().merge(there->own(), 2.0F);
            published = i;
        }
    }
    return {seen_in(*first), seen_in(*late)};
}

/// Of several runs: mean squared deviation of one from the mean of all, over squared light, where
/// no lamp is seen; and as stated.
struct Noise {
    double measured = 0.0, stated = 0.0;
};

Noise noise_of(const std::vector<Viewers>& runs, Seen Viewers::*of) {
    constexpr double lamp = 300.0;  // cd/m², above all that walls send
    const auto count = static_cast<double>(runs.size());
    Noise noise;
    double light = 0.0;
    for (std::size_t i = 0; i < (runs.front().*of).picture.size(); ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const Viewers& run : runs) {
            const auto l = static_cast<double>((run.*of).picture[i].g);
            sum += l / count;
            squares += l * l / count;
        }
        if (sum < lamp) {
            noise.measured += (squares - sum * sum) * count / (count - 1.0);
            light += sum * sum;
        }
    }
    noise.measured /= light;
    for (const Viewers& run : runs) {
        noise.stated += (run.*of).stated * (run.*of).stated / count;
    }
    return noise;
}

TEST(HeavyMergedLight, MakesPicturesBetterAndTheirStatedErrorSmaller) {
    constexpr std::uint64_t runs = 6;
    std::vector<Viewers> alone;
    std::vector<Viewers> merged;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        alone.push_back(viewers_of(seed, 0));
        merged.push_back(viewers_of(seed, seed + 100));
    }
    for (const auto& [name, of] :
         {std::pair("first", &Viewers::first), std::pair("late", &Viewers::late)}) {
        const Noise one = noise_of(alone, of);
        const Noise two = noise_of(merged, of);
        const std::string viewer = name;
        RecordProperty(viewer + "_variance_of_two_over_one",
                       std::to_string(two.measured / one.measured));
        RecordProperty(viewer + "_stated_variance_of_two_over_one",
                       std::to_string(two.stated / one.stated));
        RecordProperty(viewer + "_stated_over_measured_alone",
                       std::to_string(one.stated / one.measured));
        RecordProperty(viewer + "_stated_over_measured", std::to_string(two.stated / two.measured));
        RecordProperty(viewer + "_noise_alone", std::to_string(std::sqrt(one.measured)));
        EXPECT_LT(two.measured, one.measured) << name;
        EXPECT_LT(two.stated, one.stated) << name;
        EXPECT_GT(two.stated / two.measured, 0.5) << name << ": it states less than there is";
    }
}

}  // namespace
}  // namespace raybundle::merged_light_test
