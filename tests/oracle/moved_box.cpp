// SPDX-License-Identifier: Apache-2.0
#include "moved_box.h"

#include <cmath>

namespace raybundle {

SceneBuilder room_with_box(const glm::vec3& box_place) {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.6F, 0.5F, 0.4F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(900.0F, 1000.0F, 800.0F));
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 8, wall);
    b.add_quad({1.5F, 2.98F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 2, 2, lamp);
    Transform transform;
    transform.translation = box_place;
    b.add_object("box", transform);
    b.add_box({-0.4F, 0, -0.4F}, {0.4F, 0.8F, 0.4F}, false, 4, wall);
    return b;
}

SolverSettings quick_settings(std::uint64_t seed, const BundleResolution& resolution) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = resolution;
    settings.coarse_iterations = 1'000'000;
    return settings;
}

void iterate(Solver& solver, std::uint64_t count) {
    const std::uint64_t end = solver.iterations() + count;
    while (solver.iterations() < end) {
        solver.step({});
    }
}

void move_box(Solver& solver, const glm::vec3& place) {
    Transform transform;
    transform.translation = place;
    solver.move_object(box_object, transform.matrix(), {});
    while (solver.correcting()) {
        solver.step({});
    }
}

double relative_difference(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = static_cast<double>(a[i].g) - static_cast<double>(b[i].g);
        difference += d * d;
        size += static_cast<double>(b[i].g) * static_cast<double>(b[i].g);
    }
    return std::sqrt(difference / size);
}

}  // namespace raybundle
