// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/contact/near_field.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/edge_refinement.h"
#include "scene/mesh/joins/join_plan.h"
#include "scene/mesh/mesh_builder.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {
namespace {

constexpr int max_search_steps = 7;
constexpr double close_enough = 0.05;        // relative, of the patch count
constexpr double misplaced_share = 1e-6;     // of the direct flux, that a patch may misplace
constexpr std::size_t flux_samples = 1'000;  // patches that it is found from
constexpr int max_rounds = 12;               // of splitting them

/// Patches to aim for. A file whose triangles alone use up the target still gets half as many on
/// top, so that its large walls are not left whole.
std::size_t goal_of(const TessellationSettings& settings, std::size_t unrefined) {
    const std::size_t target = settings.target_patches;
    return std::min(settings.max_patches, std::max(target, unrefined + target / 2));
}

/// What refinement ends in, and the target edge that it had, m.
struct Refined {
    EdgeRefinement refinement;
    double edge = 0.0;
};

/// Of patches of which so many cover all sides, m.
double edge_for(const JoinPlan& plan, double goal) {
    return std::sqrt(plan.total_area() / (mean_area * goal));
}

/// Finds the target edge whose patch count comes closest to the goal, by a bracketed search that
/// takes the number of added patches as proportional to edge^-2. Where triangles are joined no
/// patches are there from the beginning.
Refined refine_to_count(EdgeRefinement unrefined, const JoinPlan& plan, bool join,
                        std::size_t goal_count) {
    const std::size_t own = unrefined.patch_count();
    const auto base = join ? 0.0 : static_cast<double>(own);
    const auto goal = static_cast<double>(goal_count);
    const std::size_t give_up = goal_count + goal_count / 2;
    const std::size_t most = join ? give_up + 8 * own : give_up;
    double too_fine = 0.0;
    double too_coarse = 1e30;
    double edge = edge_for(plan, goal);
    Refined best{std::move(unrefined), edge};
    EdgeRefinement attempt = best.refinement;
    double best_error = join ? 1e30 : std::abs(std::log(base / goal));
    for (int step = 0; step < max_search_steps && best_error > close_enough; ++step) {
        attempt.restart();
        if (join) {
            plan.mark_small(attempt, edge);
        }
        const bool finished = attempt.refine(edge, most);
        const auto count =
            static_cast<double>(join ? JoinPlan::patches(attempt, edge) : attempt.patch_count());
        (count > goal ? too_fine : too_coarse) = edge;
        if (finished && std::abs(std::log(count / goal)) < best_error) {
            best_error = std::abs(std::log(count / goal));
            std::swap(best.refinement, attempt);
            best.edge = edge;
        }
        edge *= std::sqrt(std::clamp((count - base) / std::max(goal - base, 1.0), 0.1, 10.0));
        if (edge <= too_fine || edge >= too_coarse) {
            edge = std::sqrt(too_fine * too_coarse);
        }
    }
    return best;
}

NearField::Face face_of(const EdgeRefinement& refinement,
                        const EdgeRefinement::RefinedTriangle& triangle) {
    return {refinement.world_corners(triangle), triangle.material, triangle.two_sided};
}

/// Direct flux on all patches, lm, from some of them.
double direct_flux(const EdgeRefinement& refinement, const NearField& field) {
    const auto& triangles = refinement.triangles();
    const std::size_t stride = std::max<std::size_t>(triangles.size() / flux_samples, 1);
    double sum = 0.0;
    for (std::size_t t = 0; t < triangles.size(); t += stride) {
        sum += field.direct_flux(face_of(refinement, triangles[t]));
    }
    return sum * static_cast<double>(stride);
}

/// Patches of triangles that will not be joined.
std::size_t large_patches(const EdgeRefinement& refinement) {
    std::size_t count = 0;
    for (const EdgeRefinement::RefinedTriangle& triangle : refinement.triangles()) {
        count += triangle.small ? 0 : triangle.two_sided ? 2 : 1;
    }
    return count;
}

/// Splits patches on which light changes, as surfaces close by see, the worst first where not all
/// can be. What is split is not joined to others.
void refine_near_field(const Scene& scene, const TessellationSettings& settings, bool join,
                       Refined& refined) {
    const NearField field(scene);
    EdgeRefinement& refinement = refined.refinement;
    const auto& triangles = refinement.triangles();
    const std::size_t patches =
        join ? JoinPlan::patches(refinement, refined.edge) : refinement.patch_count();
    const std::size_t most = refinement.patch_count() + patches / 2;
    const auto most_patches = [&] {
        if (!join) {
            return std::min(settings.max_patches, most);
        }
        // Of a small triangle that is split both halves count, and one is new.
        const std::size_t room = patches + patches / 2;
        const std::size_t taken = std::min(room, large_patches(refinement));
        return std::min(settings.max_patches, refinement.patch_count() + (room - taken) / 2);
    };
    const double least = misplaced_share * direct_flux(refinement, field);
    double threshold = least;      // lm
    std::vector<float> misplaced;  // lm, by node; below zero: not known yet
    for (int round = 0; least > 0.0 && round < max_rounds; ++round) {
        misplaced.resize(refinement.nodes().size(), -1.0F);
        tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
            float& value = misplaced[triangles[t].node];
            if (value < 0.0F) {
                value = static_cast<float>(
                    field.misplaced_flux(face_of(refinement, triangles[t]), least));
            }
        });
        std::vector<bool> chosen(triangles.size());
        do {
            std::transform(triangles.begin(), triangles.end(), chosen.begin(),
                           [&](const auto& t) { return double{misplaced[t.node]} > threshold; });
            if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) {
                return;
            }
            threshold *= 2.0;
        } while (!refinement.split(chosen, most_patches()));
        threshold *= 0.5;
    }
}

/// Whether triangles that have so many sides are to be joined: where the file's own ones would take
/// the goal beyond the target, and some are small.
bool joins(const JoinPlan& plan, const TessellationSettings& settings, std::size_t sides) {
    const double edge = settings.patch_size > 0.0F
                            ? double{settings.patch_size}
                            : edge_for(plan, static_cast<double>(std::min(settings.target_patches,
                                                                          settings.max_patches)));
    return settings.join_triangles && sides > settings.target_patches / 2 && plan.any_small(edge);
}

/// Refines the scene's triangles, those that are cut where others stand on them.
Refined refine(const Scene& scene, const TessellationSettings& settings) {
    const JoinPlan plan(scene);
    EdgeRefinement refinement(scene);
    if (refinement.patch_count() > settings.max_patches) {
        throw SceneError(scene.path, "",
                         fmt::format("{} patches without any tessellation; the limit is {}",
                                     refinement.patch_count(), settings.max_patches));
    }
    bool join = joins(plan, settings, refinement.patch_count());
    const auto goal = [&] {
        return goal_of(settings, join ? std::size_t{0} : refinement.patch_count());
    };
    const double edge = settings.patch_size > 0.0F ? double{settings.patch_size}
                                                   : edge_for(plan, static_cast<double>(goal()));
    refinement.cut(find_contact_lines(scene, edge), contact_resolution * edge);
    join = joins(plan, settings, refinement.patch_count());
    if (join) {
        plan.mark_small(refinement, edge);
    }
    const std::size_t patches = goal();
    Refined refined{std::move(refinement), edge};
    if (!(settings.patch_size > 0.0F)) {
        refined = refine_to_count(std::move(refined.refinement), plan, join, patches);
    } else if (!refined.refinement.refine(edge, settings.max_patches)) {
        throw SceneError(scene.path, "",
                         fmt::format("patch size {} m gives more than {} patches",
                                     settings.patch_size, settings.max_patches));
    }
    refine_near_field(scene, settings, join, refined);
    return refined;
}

JoinSettings join_settings(const TessellationSettings& settings, const Refined& refined) {
    JoinSettings joined;
    joined.edge = refined.edge;
    joined.patch_area = mean_area * refined.edge * refined.edge;
    joined.most_sides = settings.max_patches;
    if (!(settings.patch_size > 0.0F)) {
        joined.most_sides = std::min(2 * settings.target_patches, settings.max_patches);
        joined.wanted_sides =
            std::min(goal_of(settings, settings.target_patches), settings.max_patches);
    }
    return joined;
}

}  // namespace

PatchMesh tessellate(Scene& scene, const TessellationSettings& settings) {
    Refined refined = refine(scene, settings);
    const JoinSettings joined = join_settings(settings, refined);
    return build_mesh(scene, std::move(refined.refinement), joined);
}

}  // namespace raybundle
