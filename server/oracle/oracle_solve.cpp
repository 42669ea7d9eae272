// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracle_solve.h"

namespace raybundle {

namespace {

SolverSettings solver_settings(const OracleSettings& settings) {
    SolverSettings result;
    result.seed = settings.seed;
    result.probabilities = settings.probabilities;
    result.coarse = settings.resolution;
    result.fine = settings.resolution;
    result.coarse_iterations = settings.iterations + 1;
    result.density_error = settings.density_error;
    result.constant_radiance = settings.constant_radiance;
    return result;
}

double side_area(const PatchMesh& mesh, std::size_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    const glm::dvec3 a(mesh.positions[t.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                        glm::dvec3(mesh.positions[t.z]) - a));
}

}  // namespace

glm::mat4 odd_rotation() {
    return glm::rotate(glm::mat4(1.0F), 0.7F, glm::normalize(glm::vec3(0.3F, 1.0F, 0.5F)));
}

Solver solve(const Scene& scene, const PatchMesh& mesh, const OracleSettings& settings) {
    Solver solver(scene, mesh, solver_settings(settings));
    while (solver.iterations() < settings.iterations) {
        solver.step({});
    }
    return solver;
}

Solver solve(const SceneBuilder& builder, const OracleSettings& settings) {
    return solve(builder.scene, builder.mesh, settings);
}

double mean_irradiance(const SceneBuilder& builder, const std::vector<glm::vec4>& irradiance,
                       std::size_t first, std::size_t last) {
    double sum = 0.0;
    double area = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        const double a = side_area(builder.mesh, i);
        sum += a * static_cast<double>(
                       irradiance[builder.mesh.patch_of(static_cast<std::uint32_t>(i))].x);
        area += a;
    }
    return sum / area;
}

double mean_irradiance(const SceneBuilder& builder, const std::vector<glm::vec4>& irradiance) {
    return mean_irradiance(builder, irradiance, 0, builder.mesh.side_count());
}

}  // namespace raybundle
