// SPDX-License-Identifier: Apache-2.0
// A room whose lights change while the solution is there, against fresh solves of the changed
// scene.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "oracle/scene_builder.h"
#include "scene/edit/surface_edit.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

/// A solver with a picture from the front of a room of 6 x 3 x 4 m.
struct Solved {
    explicit Solved(SceneBuilder scene, std::uint64_t seed = 1);

    void iterate(std::uint64_t count);
    /// Of a light that is no surface.
    void change(const LightEdit& edit);

    SceneBuilder b;
    Solver solver;
    ViewPrograms programs;
    ViewerImage image;
};

/// Sum and root mean square difference, green, relative to those of the truth.
template <typename Vector>
std::pair<double, double> compared(const std::vector<Vector>& found,
                                   const std::vector<Vector>& truth) {
    double sum = 0.0;
    double exact = 0.0;
    double square = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto a = static_cast<double>(found[i].g);
        const auto e = static_cast<double>(truth[i].g);
        sum += a;
        exact += e;
        square += (a - e) * (a - e);
        size += e * e;
    }
    return {sum / exact, std::sqrt(square / size)};
}

/// Largest relative difference of the levels of a changed and a fresh solve, and of those of their
/// pictures.
struct LevelBounds {
    double solution = 0.012;
    double picture = 0.015;
};

/// The solution and the picture are those of a fresh solve of the scene as it is now.
void expect_fresh(Solved& changed, std::uint64_t iterations, const char* what,
                  const LevelBounds& bounds = {});

}  // namespace raybundle
