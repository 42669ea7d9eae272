// SPDX-License-Identifier: Apache-2.0
// Runs of small pictures whose true error is known, for tests of the error bars.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "research/accuracy/reference_picture.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "view/final_picture.h"

namespace raybundle {

/// What a final picture says about its error, with the true error of some pixels measured, and a
/// viewer's beside it, by its samples alone; and what their errors are.
struct JudgedPicture {
    std::uint64_t iterations = 0;
    double error = 0.0;  ///< relRMSE against the reference, whose own noise is subtracted
    ErrorInterval said;
    double samples_factor = 1.0;  ///< to the target of the run
    double viewer_error = 0.0;
    ErrorInterval viewer_said;
};

/// A shipped scene, 48x48 pixels, with a path-traced reference.
class JudgedScene {
  public:
    /// file: in scenes/; patch_size: m; passes: samples a pixel of the reference.
    JudgedScene(const std::string& file, float patch_size, unsigned passes);

    /// Solves with a seed, judges the picture every 16 iterations, and ends when `goes_on` says no.
    void run(std::uint64_t seed, double target,
             const std::function<bool(const JudgedPicture&)>& goes_on) const;
    [[nodiscard]] double reference_noise() const { return reference_.noise->relative_rmse; }

  private:
    [[nodiscard]] double error_of(const std::vector<glm::vec4>& radiance) const;

    Scene scene_;
    PatchMesh mesh_;
    Camera camera_;
    std::vector<bool> measured_;
    ReferencePicture reference_;
};

/// How many of some pictures their intervals cover, and how wide those are.
struct Coverage {
    unsigned pictures = 0, covered = 0, above = 0, below = 0;
    double widths = 0.0;  ///< sum of (high - low) / (2 error)

    void add(double error, const ErrorInterval& said);
    [[nodiscard]] double share() const { return static_cast<double>(covered) / pictures; }
    [[nodiscard]] double half_width() const { return widths / pictures; }
    [[nodiscard]] std::string text() const;
};

}  // namespace raybundle
