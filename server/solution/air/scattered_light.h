// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "solution/geometry/gpu_scene.h"
#include "solution/geometry/patch_cells.h"
#include "trace/air/air_paths.h"

namespace raybundle {

class PatchGrowth;

/// Light that the air scatters on patches, by single paths that start there. Bundles, the first
/// shot and view rays dim what they carry by the air; this is where what has been taken out of them
/// goes. A progressive mean: what comes from lamps and sky counts alike until something changes;
/// what surfaces have reflected before counts the more the later, as a share of all that surfaces
/// reflect at the time, so that a room that brightens takes its air along. Smooth, so it is spread
/// over cells of patches that shrink as paths add up. Deterministic.
class ScatteredLight {
  public:
    static constexpr std::uint32_t batch_paths = 8192;
    static constexpr std::uint32_t first_paths = 2 * batch_paths;  ///< after a change

    /// Nothing is estimated before restart(). cells: must outlive it, as the scenes.
    ScatteredLight(const Scene& scene, const PatchMesh& mesh, const GpuScene& gpu_scene,
                   const PatchCells& cells, std::uint64_t seed);

    /// Objects, lamps or materials are others: begins anew. emission: of sides, cd/m².
    void restart(std::span<const glm::vec3> emission);
    /// Takes over the estimates of another scene of the same lamps, which lacks objects that have
    /// no size yet.
    void adopt(const ScatteredLight& other, const PatchGrowth& growth);
    void update(const Scene& scene, std::size_t material) { surfaces_.update(scene, material); }
    /// What patches send is known anew; sent: radiance, cd/m², of all patches, emission: of them,
    /// cd/m².
    void set_radiance(std::span<const glm::vec3> sent, std::span<const glm::vec3> emission);
    /// What patches reflect has been multiplied.
    void scale(const glm::vec3& factor);
    /// Another batch of paths.
    void refine() { trace(batch_paths); }
    /// Flux on patches, lm.
    [[nodiscard]] const std::vector<glm::vec3>& flux() const { return flux_; }

    /// Of all patches together: their radiance without emission times their area, cd.
    [[nodiscard]] const glm::dvec3& reflected_flux() const { return reflected_flux_; }
    /// Paths through the air as it is, from anywhere.
    [[nodiscard]] AirPaths paths() const;
    /// Rises with each restart().
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Sample {
        std::uint32_t patch = 0;
        glm::vec3 lamps{0.0F}, surfaces{0.0F};  // flux, lm, of the whole batch were all like it
    };
    void trace(std::uint32_t count);
    [[nodiscard]] Sample sample(const AirPaths& air, std::uint64_t number, double place) const;
    [[nodiscard]] std::vector<glm::mat4> places() const;

    const Scene& scene_;
    const GpuScene& gpu_scene_;
    const PatchCells& cells_;
    AirScene surfaces_;
    std::optional<AirLights> lights_;
    std::vector<double> side_areas_;    // cumulative, m²
    std::vector<glm::vec3> reflected_;  // of patches, cd/m²
    std::vector<float> areas_;          // of patches, m²
    glm::dvec3 reflected_flux_{0.0};    // of all of them, lm / pi
    std::vector<glm::dvec3> lamp_sums_, surface_sums_;
    std::vector<std::uint32_t> counts_;
    double surface_weights_ = 0.0;
    std::uint64_t paths_ = 0, batches_ = 0, seed_, changes_ = 0;
    std::vector<glm::vec3> flux_;
};

}  // namespace raybundle
