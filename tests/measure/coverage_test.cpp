// SPDX-License-Identifier: Apache-2.0
// How often the 95 % intervals of calculation points hold the truth, which is what many more paths
// of another seed find.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "lit_room.h"
#include "measure/point_measurement.h"
#include "measure/work_plane.h"
#include "rooms.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr std::uint64_t stages[] = {PointMeasurement::least_rounds, 32, 128};  // of 16 paths
constexpr std::uint64_t truth_rounds = 1000;

struct Judged {
    std::string name;
    Scene scene;
    PatchMesh mesh;
    MeasuredArea area;
};

/// A horizontal area amid the scene, in its own axes.
Judged judged(const std::string& name, const SceneBuilder& builder, const glm::mat4& where,
              const glm::vec3& low, const glm::vec3& high) {
    const auto place = [&](const glm::vec3& p) { return glm::dvec3(where * glm::vec4(p, 1.0F)); };
    const glm::dvec3 origin = place(low);
    return {
        name,
        builder.scene,
        builder.mesh,
        {origin, place({high.x, low.y, low.z}) - origin, place({low.x, low.y, high.z}) - origin}};
}

std::optional<Judged> file_scene(const std::string& name, const std::string& path,
                                 const MeasuredArea& area) {
    if (!std::filesystem::exists(path)) {
        return std::nullopt;
    }
    Scene scene = load_gltf(path);
    PatchMesh mesh = tessellate(scene, {});
    return Judged{name, std::move(scene), std::move(mesh), area};
}

struct Count {
    int held = 0, all = 0;
    void add(const Count& other) {
        held += other.held;
        all += other.all;
    }
    [[nodiscard]] double share() const { return all > 0 ? static_cast<double>(held) / all : 0.0; }
};

struct Counts {
    Count points[std::size(stages)], means, minima, ratios;
};

void count(const Interval& found, const Interval& truth, Count& count) {
    count.held += found.low <= truth.value && truth.value <= found.high ? 1 : 0;
    ++count.all;
}

/// By `seeds` measurements of every quantity, each of 5 x 5 points.
Counts count_coverage(const Judged& judged, int seeds) {
    const auto scene = std::make_shared<const MeasuredScene>(judged.scene, judged.mesh);
    Counts counts;
    for (const Quantity quantity : {Quantity::horizontal, Quantity::vertical, Quantity::cylindrical,
                                    Quantity::semicylindrical}) {
        std::vector<CalculationPoint> places;
        for (const glm::dvec3& position : points_of(judged.area, {5, 5})) {
            places.push_back({position, {1, 0, 0.5}});
        }
        PointMeasurement truth(scene, places, {quantity, false, 1.0, 1'000'000});
        truth.add_samples(truth_rounds * places.size());
        if (truth.measured() == 0) {
            continue;
        }
        const std::vector<Interval> right_values = truth.values();
        for (int seed = 0; seed < seeds; ++seed) {
            PointMeasurement points(scene, places,
                                    {quantity, false, 1.0, static_cast<std::uint64_t>(seed)});
            for (std::size_t stage = 0; stage < std::size(stages); ++stage) {
                points.add_samples((stages[stage] - points.rounds()) * places.size());
                const std::vector<Interval> values = points.values();
                for (std::size_t i = 0; i < places.size(); ++i) {
                    if (!points.inside(i) && right_values[i].value > 0.0) {
                        count(values[i], right_values[i], counts.points[stage]);
                    }
                }
                const MeasurementSummary found = points.summary();
                const MeasurementSummary right = truth.summary();
                count(found.mean, right.mean, counts.means);
                count(found.minimum, right.minimum, counts.minima);
                count(found.uniformity, right.uniformity, counts.ratios);
            }
        }
    }
    return counts;
}

std::vector<Judged> all_scenes() {
    std::vector<Judged> scenes;
    const glm::mat4 turned = odd_rotation();
    scenes.push_back(
        judged("enclosure 0.5", enclosure(0.5F), turned, {0.5F, 0.8F, 0.5F}, {3.5F, 0.8F, 3.5F}));
    scenes.push_back(
        judged("enclosure 0.9", enclosure(0.9F), turned, {0.5F, 0.8F, 0.5F}, {3.5F, 0.8F, 3.5F}));
    scenes.push_back(judged("lit room", lit_room(glm::mat4(1.0F), 8), glm::mat4(1.0F),
                            {0.3F, 0.75F, 0.3F}, {3.7F, 0.75F, 3.7F}));
    const std::string own = RAYBUNDLE_SCENES;
    const std::string others = RAYBUNDLE_SCENES "/../../shared/data/scenes";
    const std::optional<Judged> files[] = {
        file_scene("Cornell box", own + "/cornell_box.gltf",
                   {{0.5, 0.75, 0.5}, {4.5, 0, 0}, {0, 0, 4.5}}),
        file_scene("living room", own + "/living_room.gltf", {{1, 0.75, 1}, {5, 0, 0}, {0, 0, 3}}),
        file_scene("nvpro", others + "/nvpro_cornell_box/cornellBox.gltf",
                   {{-0.8, 0.5, -0.8}, {1.6, 0, 0}, {0, 0, 1.6}}),
        file_scene("bevy", others + "/bevy_cornell_box/CornellBox.glb",
                   {{-0.8, 0.5, -0.8}, {1.6, 0, 0}, {0, 0, 1.6}}),
        file_scene("bevy chair", others + "/bevy_mixed_lighting_chair/MixedLightingExample.gltf",
                   {{-1.5, 1, -1.5}, {3, 0, 0}, {0, 0, 3}}),
    };
    for (const auto& file : files) {
        if (file) {
            scenes.push_back(*file);
        }
    }
    return scenes;
}

/// With 95 % +- 3 %, or more often: no point's noise is taken to be less than that of all.
TEST(MeasuredCoverageHeavy, IntervalsHoldAsOftenAsTheySay) {
    constexpr int seeds = 3;
    Counts all;
    for (const Judged& scene : all_scenes()) {
        SCOPED_TRACE(scene.name);
        const Counts found = count_coverage(scene, seeds);
        for (std::size_t i = 0; i < std::size(stages); ++i) {
            EXPECT_GE(found.points[i].share(), 0.85) << stages[i] << " rounds";
            all.points[i].add(found.points[i]);
        }
        all.means.add(found.means);
        all.minima.add(found.minima);
        all.ratios.add(found.ratios);
    }
    for (const Count& count : all.points) {
        EXPECT_GE(count.all, 1500);
        EXPECT_GE(count.share(), 0.92);
        std::printf("points: %.4f of %d\n", count.share(), count.all);
    }
    EXPECT_GE(all.means.share(), 0.90);
    EXPECT_GE(all.minima.share(), 0.95);
    EXPECT_GE(all.ratios.share(), 0.95);
    std::printf("means: %.4f, minima %.4f, ratios %.4f of %d\n", all.means.share(),
                all.minima.share(), all.ratios.share(), all.means.all);
}

}  // namespace
}  // namespace raybundle
