// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>

#include "raybundle.pb.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

/// The scene as it was right after an earlier change, with a solver of its own: to compare with
/// what is. It needs as much memory as the present one, so there is one at a time. Thread of the GL
/// context; touches nothing of the present solution.
class EarlierScene {
  public:
    /// scene, mesh: the present ones, copied. changes: what brings them back (SceneHistory). Throws
    /// GpuError where there is no memory.
    EarlierScene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh,
                 std::span<const v1::SceneChanged> changes, const SolverSettings& settings);
    EarlierScene(const EarlierScene&) = delete;
    EarlierScene& operator=(const EarlierScene&) = delete;

    [[nodiscard]] std::uint32_t epoch() const { return epoch_; }
    [[nodiscard]] const Solver& solver() const { return solver_; }
    [[nodiscard]] const ViewPrograms& programs() const { return programs_; }
    /// One iteration. The picture stays the same within a group of them.
    void step(ViewerImage& picture);
    [[nodiscard]] bool between_groups() const { return solver_.between_groups(); }

  private:
    std::uint32_t epoch_;
    Scene scene_;
    PatchMesh mesh_;
    Solver solver_;
    ViewPrograms programs_;
};

}  // namespace raybundle
