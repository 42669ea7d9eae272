// SPDX-License-Identifier: Apache-2.0
#include "methods.h"

#include "oracle/oracle_solve.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "research/single_ray.h"

namespace raybundle {
namespace {

double patch_area(const PatchMesh& mesh, std::size_t patch) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    const glm::dvec3 a(mesh.positions[t.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                        glm::dvec3(mesh.positions[t.z]) - a));
}

std::vector<double> by_bundles(const StrategyProbabilities& probabilities, const Scene& scene,
                               const PatchMesh& mesh, const OracleSettings& settings) {
    OracleSettings with_probabilities = settings;
    with_probabilities.probabilities = probabilities;
    const Solver solver = solve(scene, mesh, with_probabilities);
    std::vector<double> result;
    for (const glm::vec4& e : solver.store().read_irradiance()) {
        result.push_back(static_cast<double>(e.x));
    }
    return result;
}

std::vector<double> by_rays(const Scene& scene, const PatchMesh& mesh,
                            const OracleSettings& settings) {
    const RayScene ray_scene(scene, mesh);
    const LightSampling lights(ray_scene);
    SingleRay rays(ray_scene, lights, settings.seed);
    while (rays.iterations() * SingleRay::particles_per_iteration < 256 * settings.iterations) {
        rays.iterate();
    }
    std::vector<double> result;
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        result.push_back(rays.irradiance(patch).r);
    }
    return result;
}

}  // namespace

const Method& layered() {
    static const Method method{"layered", StrategyProbabilities{1.0F, 0.0F, 0.0F}};
    return method;
}

const Method& plane() {
    static const Method method{"plane", StrategyProbabilities{0.0F, 1.0F, 0.0F}};
    return method;
}

const Method& perspective() {
    static const Method method{"perspective", StrategyProbabilities{0.0F, 0.0F, 1.0F}};
    return method;
}

const Method& combined() {
    static const Method method{"combined", StrategyProbabilities{}};
    return method;
}

const Method& three_strategies() {
    static const Method method{"three_strategies", StrategyProbabilities{0.15F, 0.15F, 0.7F}};
    return method;
}

const Method& single_ray() {
    static const Method method{"single_ray", {}};
    return method;
}

std::vector<double> irradiance_by(const Method& method, const Scene& scene, const PatchMesh& mesh,
                                  const OracleSettings& settings) {
    return method.bundles ? by_bundles(*method.bundles, scene, mesh, settings)
                          : by_rays(scene, mesh, settings);
}

std::vector<double> irradiance_by(const Method& method, const SceneBuilder& builder,
                                  const OracleSettings& settings) {
    return irradiance_by(method, builder.scene, builder.mesh, settings);
}

double area_mean(const PatchMesh& mesh, const std::vector<double>& values,
                 const std::function<bool(std::size_t)>& wanted) {
    double sum = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (wanted(i)) {
            const double a = patch_area(mesh, i);
            sum += a * values[i];
            area += a;
        }
    }
    return sum / area;
}

double area_mean(const PatchMesh& mesh, const std::vector<double>& values, std::size_t first,
                 std::size_t last) {
    return area_mean(mesh, values, [=](std::size_t i) { return i >= first && i < last; });
}

}  // namespace raybundle
