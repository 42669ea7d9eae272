// SPDX-License-Identifier: Apache-2.0
// A glossy room by ray bundles against the long-run mean of single rays, an independent method on
// the CPU: no bias within 5 standard errors of the difference, wall by wall. The room is convex:
// single rays know nothing of patches, and boxes on a floor of patches take 1 to 4 % too little
// light by their mesh alone.
#include <gtest/gtest.h>

#include <cmath>

#include "../oracle/methods.h"
#include "../reference/rooms.h"
#include "research/single_ray.h"
#include "transport/solver.h"

namespace raybundle {
namespace {

struct Room {
    SceneBuilder builder;
    std::vector<std::size_t> first;  ///< patch of each surface, and past the last
};

/// Floor of metal, one wall of plastic, one of max-Phong, the rest Lambert; a lamp.
Room glossy_room() {
    Room room;
    SceneBuilder& b = room.builder;
    b.set_transform(odd_rotation());
    const auto materials = glossy_materials();
    const auto plastic = b.add_material(materials[0].material);
    const auto metal = b.add_material(materials[1].material);
    const auto phong = b.add_material(materials[2].material);
    const auto lambert = b.add_material(glm::vec3(0.5F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(1000.0F));
    const auto add = [&](const glm::vec3& at, const glm::vec3& u, const glm::vec3& v,
                         std::uint32_t material) {
        room.first.push_back(b.mesh.patch_count());
        b.add_quad(at, u, v, 12, 12, material);
    };
    add({0, 0, 0}, {0, 0, 5}, {4, 0, 0}, metal);  // floor
    add({0, 3, 0}, {4, 0, 0}, {0, 0, 5}, lambert);
    add({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, plastic);
    add({0, 0, 5}, {0, 3, 0}, {4, 0, 0}, lambert);
    add({0, 0, 0}, {0, 3, 0}, {0, 0, 5}, lambert);
    add({4, 0, 0}, {0, 0, 5}, {0, 3, 0}, phong);
    room.first.push_back(b.mesh.patch_count());
    b.add_quad({1.5F, 2.9F, 2}, {1, 0, 0}, {0, 0, 1}, 4, 4, lamp);
    return room;
}

/// Mean and standard error of independent values.
Estimate estimate_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Estimate e;
    for (const double value : values) {
        e.mean += value / n;
    }
    for (const double value : values) {
        e.standard_error += (value - e.mean) * (value - e.mean);
    }
    e.standard_error = std::sqrt(e.standard_error / (n * (n - 1.0)));
    return e;
}

/// Green channels of the two methods: the materials' other ones are different.
std::vector<double> by_bundles(const SceneBuilder& builder, std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {96, 160};
    settings.coarse_iterations = 1'000'000;
    Solver solver(builder.scene, builder.mesh, settings);
    while (solver.iterations() < 4096) {
        solver.step({});
    }
    std::vector<double> result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.push_back(static_cast<double>(e.y));
    }
    return result;
}

std::vector<std::vector<double>> by_rays(const SceneBuilder& builder) {
    const Tracing tracing(builder);
    SingleRay rays(tracing.scene, tracing.lights, 9);
    for (int i = 0; i < 256; ++i) {
        rays.iterate();
    }
    std::vector<std::vector<double>> batches;
    for (std::uint32_t batch = 0; batch < SingleRay::batches; ++batch) {
        std::vector<double> values;
        for (std::uint32_t patch = 0; patch < builder.mesh.patch_count(); ++patch) {
            values.push_back(rays.batch_irradiance(patch, batch).g);
        }
        batches.push_back(values);
    }
    return batches;
}

TEST(GlossyRoomStatistics, AgreesWithSingleRays) {
    const Room room = glossy_room();
    const PatchMesh& mesh = room.builder.mesh;
    const auto rays = by_rays(room.builder);
    std::vector<std::vector<double>> bundles;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        bundles.push_back(by_bundles(room.builder, seed));
    }
    for (std::size_t k = 0; k + 1 < room.first.size(); ++k) {
        const auto means = [&](const std::vector<std::vector<double>>& runs) {
            std::vector<double> result;
            for (const auto& run : runs) {
                result.push_back(area_mean(mesh, run, room.first[k], room.first[k + 1]));
            }
            return estimate_of(result);
        };
        const Estimate ours = means(bundles);
        const Estimate theirs = means(rays);
        const double error = std::hypot(ours.standard_error, theirs.standard_error);
        RecordProperty(
            "surface" + std::to_string(k),
            std::to_string(ours.mean / theirs.mean) + " +- " + std::to_string(error / theirs.mean));
        EXPECT_LT(error, 0.005 * theirs.mean) << "surface " << k;
        EXPECT_LT(std::abs(ours.mean - theirs.mean), 5.0 * error) << "surface " << k;
    }
}

}  // namespace
}  // namespace raybundle
