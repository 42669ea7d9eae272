// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/material/brdf.h"
#include "scene/mesh/patch_mesh.h"
#include "solution/specular/caustic_lights.h"
#include "solution/specular/specular_rays.h"

namespace raybundle {

/// Flux that arrives at a patch, lm; below 0: what bundles bring there without being right.
struct CausticDeposit {
    std::uint32_t patch = 0;
    glm::vec3 flux{0.0F};
};

/// Single rays of light from lamps, other surfaces or the sky through mirrors and glass to the
/// first other surface (ch. 4.2; class (L|D)S+D). Bundles carry that class, too, but not as it is:
/// they go straight through glass, which absorbs without colour, and mirrors scatter them into a
/// wide lobe (solution/geometry/reflectance_tables.h). So every ray goes two ways: as light does,
/// and, with its flux taken away where it ends, as bundles do. The sum is the correction that
/// belongs to what bundles bring, without bias but for branches of less than
/// SpecularRays::least_throughput.
class CausticRays {
  public:
    CausticRays(const Scene& scene, const PatchMesh& mesh, const SpecularRays& rays);

    /// Takes over a material that has changed.
    void update(const Scene& scene, std::size_t material);
    /// Deposits of rays [first, first + count) of the sequence that the seed stands for, in their
    /// order: of flux per ray. On all cores; the same bits always.
    [[nodiscard]] std::vector<CausticDeposit> trace(const CausticLights& lights, std::uint64_t seed,
                                                    std::uint64_t first, std::uint32_t count) const;

  private:
    class Random;

    void follow(const LightRay& ray, Random& random, std::vector<CausticDeposit>& deposits) const;
    void follow_as_bundles(LightRay ray, Random& random,
                           std::vector<CausticDeposit>& deposits) const;
    [[nodiscard]] bool scatter(LightRay& ray, const SpecularRays::Hit& hit, Random& random) const;
    /// A point of a patch, the normal there, and that of all of the patch.
    struct Start {
        glm::vec3 point{0.0F}, normal{0.0F}, mean_normal{0.0F};
        bool bent = false;
    };
    /// One of a patch's triangles, and the sum of all of them times their normals (twice), which
    /// are those of backs where `back`.
    struct Face {
        std::array<glm::vec3, 3> corners;
        glm::vec3 facing{0.0F};
        bool back = false, bent = false;
    };
    [[nodiscard]] Face random_face(const SpecularRays::Hit& hit, Random& random) const;
    static glm::vec3 cosine_direction(Random& random);
    [[nodiscard]] Start random_point(const SpecularRays::Hit& hit, Random& random) const;
    [[nodiscard]] std::uint32_t triangle_of(std::uint32_t facet, const glm::vec3& position) const;
    [[nodiscard]] std::uint32_t patch_at(std::uint32_t facet, bool front,
                                         const glm::vec3& position) const;

    const SpecularRays& rays_;
    std::vector<Brdf> lobes_;         // of mirrors, as bundles know them; by material
    std::vector<BundleGlass> glass_;  // likewise
    std::vector<std::uint32_t> facet_material_, back_side_;
    std::vector<std::uint32_t> side_triangle_;
    PatchSets sets_;
    std::vector<bool> bent_;  // by patch, see is_bent()
    std::vector<glm::uvec3> triangles_;
    std::vector<FacetNode> facet_roots_, facet_tree_;  // empty: facets are triangles
};

}  // namespace raybundle
