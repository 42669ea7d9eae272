// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "session/changes/change_log.h"
#include "session/light_fades.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

/// The scene that is served, its log of changes and its solution. ChangeCoordinator changes the
/// scene, SolverDriver the solution; everything else only reads. Thread of the GL context.
class LiveScene {
  public:
    /// Throws GpuError where there is no memory for the solution.
    LiveScene(Scene scene, PatchMesh mesh, const SolverSettings& settings, ChangeLog& log);
    LiveScene(const LiveScene&) = delete;
    LiveScene& operator=(const LiveScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const PatchMesh& mesh() const { return mesh_; }
    /// Lamps that fade: the scene has them as they are set, the solution and the mesh as shown.
    [[nodiscard]] const LightFades& fades() const { return fades_; }
    /// The mesh with all lamps as they are set.
    [[nodiscard]] PatchMesh settled_mesh() const;
    [[nodiscard]] const Solver& solver() const { return *solver_; }
    [[nodiscard]] const ViewPrograms& programs() const { return *programs_; }
    [[nodiscard]] const ChangeLog& log() const { return log_; }
    [[nodiscard]] const SolverSettings& solver_settings() const { return settings_; }
    /// Number of the last change.
    [[nodiscard]] std::uint32_t epoch() const { return log_.epoch(); }
    /// A picture of this scene. Throws GpuError where there is no memory for it.
    [[nodiscard]] std::unique_ptr<ViewerImage> make_picture(glm::uvec2 size) const;
    /// Mean illuminance of a patch, lx, in whose mesh it is the side of this number.
    [[nodiscard]] float patch_illuminance(std::uint32_t side) const;

    /// The scene has been changed since it was opened.
    [[nodiscard]] bool changed() const { return iterations_at_change_ != 0; }
    [[nodiscard]] std::uint64_t iterations_since_change() const {
        return solver_->iterations() - iterations_at_change_;
    }

    /// Held by threads that read the scene's triangles, and while objects are added to it.
    [[nodiscard]] std::mutex& geometry_mutex() { return geometry_mutex_; }

    // For those who write it.
    [[nodiscard]] Scene& scene() { return scene_; }
    [[nodiscard]] PatchMesh& mesh() { return mesh_; }
    [[nodiscard]] LightFades& fades() { return fades_; }
    [[nodiscard]] Solver& solver() { return *solver_; }
    [[nodiscard]] ChangeLog& log() { return log_; }
    void note_change() { iterations_at_change_ = solver_->iterations(); }
    /// Another solver has taken over the solution.
    void replace(std::unique_ptr<Solver> solver, std::unique_ptr<ViewPrograms> programs);

  private:
    std::mutex geometry_mutex_;
    Scene scene_;
    PatchMesh mesh_;
    LightFades fades_;
    SolverSettings settings_;
    ChangeLog& log_;
    std::unique_ptr<Solver> solver_;
    std::unique_ptr<ViewPrograms> programs_;
    std::uint64_t iterations_at_change_ = 0;
};

}  // namespace raybundle
