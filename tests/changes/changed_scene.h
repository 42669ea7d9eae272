// SPDX-License-Identifier: Apache-2.0
// Changes of scenes whose light is known before and after, and what is served of it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

/// One edit of a scene: an object elsewhere, a light or a material as it shall be. By names.
struct Edit {
    enum class Kind { move, shift, light, material };
    Kind kind = Kind::move;
    std::string name;
    glm::vec3 value{0.0F};                 ///< m (move, shift), linear colour (material)
    float scale = 1.0F;                    ///< of a moved object
    float turn = 0.0F;                     ///< likewise, degrees about Y
    float luminance = 0.0F;                ///< of a light, cd/m²; 0: off
    std::optional<glm::vec3> colour = {};  ///< of a light
    std::optional<float> metallic = {};    ///< of a material
};

Edit move_to(const std::string& object, const glm::vec3& translation, float scale = 1.0F);
/// Translated by so much from where it is, and as it is else.
Edit shift_by(const std::string& object, const glm::vec3& by);
Edit set_light(const std::string& light, float luminance);
Edit paint(const std::string& material, float albedo);

/// A scene, what changes in it, and where its light is looked at.
struct ChangeCase {
    std::string name;
    std::string file;                        ///< in tests/cases/changes, where nothing builds it
    Scene (*build)() = nullptr;              ///< see changed_rooms.h
    std::vector<Edit> before;                ///< makes the first state of what the file has
    std::vector<std::vector<Edit>> changes;  ///< one after another
    std::uint64_t between = 8;               ///< iterations after each change but the last
    glm::vec3 eye{0.0F}, target{0.0F};
    float field_of_view = 75.0F;  ///< degrees, vertical
    float patch_size = 0.3F;      ///< m
    unsigned picture = 96;        ///< pixels along an edge
    BundleResolution coarse{256, 400};
    double bright = 100.0;  ///< lx: order of the light before or after, the brighter of both
};

/// Names the case in lists and failures of tests.
inline void PrintTo(const ChangeCase& c, std::ostream* out) {
    *out << c.name;
}

/// The cases of numerics.md (second part, Changes) that fit into some seconds each.
std::vector<ChangeCase> change_cases();
const ChangeCase& change_case(const std::string& name);

/// What a picture serves, and 5 x 5 points of it.
struct Served {
    std::uint64_t iterations = 0;  ///< since the last change
    double mean = 0.0;             ///< of the illuminance, lx
    std::vector<double> points;    ///< likewise of each
    double settled = 0.0;
    ImageStatistics stated;           ///< of the picture
    std::vector<glm::vec4> radiance;  ///< of the smoothed picture, cd/m², row 0 at the top
};

/// The scene as it is after all changes, and how one looks at it.
Scene last_scene(const ChangeCase& c);
Camera camera_of(const ChangeCase& c);
/// Solves the last state of a case anew; `at`: iterations, ascending.
std::vector<Served> solve_anew(const ChangeCase& c, std::uint64_t seed,
                               std::span<const std::uint64_t> at);
/// Solves the first state for so many iterations, makes the changes, and goes on.
std::vector<Served> change_and_solve(const ChangeCase& c, std::uint64_t seed,
                                     std::uint64_t iterations_before,
                                     std::span<const std::uint64_t> at);
/// Root mean square distance of the points from the truth, relative to its root mean square; where
/// the truth is dark, to `scale` lx.
double error_of(const Served& served, std::span<const double> truth, double scale);

}  // namespace raybundle
