// SPDX-License-Identifier: Apache-2.0
// Runs of methods whose pictures are kept at checkpoints.
#pragma once

#include <cstdint>
#include <vector>

#include "app/progress.h"
#include "commands/accuracy_job.h"
#include "reference/ray_scene.h"
#include "research/accuracy/error_curve.h"
#include "research/accuracy/picture_store.h"

namespace raybundle {

/// Where a run stood at a checkpoint; its errors against the reference are still to be measured.
struct RunCheckpoint {
    CurvePoint point;
    std::size_t picture = 0;  ///< in the store
};

struct MethodRun {
    std::vector<RunCheckpoint> checkpoints;
    nlohmann::ordered_json settings;  ///< and sizes: what the curve was measured with
};

/// What all runs have in common.
struct RunSurroundings {
    const Scene& scene;
    const PatchMesh& mesh;
    const Scene&
        whole_scene;  ///< with the effects that a knob leaves out: errors are measured by it
    const PatchMesh& whole_mesh;
    const Camera& camera;
    glm::uvec2 size;
    double seconds;  ///< of solving
    PictureStore& pictures;
    Progress& progress;
    double seconds_after;  ///< of the runs after this one, for the time left
};

/// Solves progressively for the given time with ray bundles, once. Setting up, and reading the
/// pictures at the checkpoints, do not count. Needs a GL context.
MethodRun run_bundles(const RunSurroundings& around, const PlannedCurve& curve, std::uint64_t seed);

/// The same with a method on the CPU.
MethodRun run_on_cpu(const RunSurroundings& around, const RayScene& ray_scene, ReferenceKind kind,
                     std::uint64_t seed);

}  // namespace raybundle
