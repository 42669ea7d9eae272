// SPDX-License-Identifier: Apache-2.0
#include "oracle/glossy_oracles.h"

#include <array>
#include <numbers>

#include "oracle/oracle_solve.h"
#include "scene/material/brdf.h"
#include "scene/material/reflectance_table.h"

namespace raybundle {

namespace {

using std::numbers::pi;

/// A rectangle in a horizontal plane: corner and extent in x and z.
struct Rectangle {
    glm::vec3 corner;
    glm::vec2 size;

    [[nodiscard]] glm::vec3 cell(int i, int j, int n) const {
        const auto count = static_cast<float>(n);
        return corner + glm::vec3(size.x * (static_cast<float>(i) + 0.5F) / count, 0.0F,
                                  size.y * (static_cast<float>(j) + 0.5F) / count);
    }
    [[nodiscard]] double area() const { return static_cast<double>(size.x) * size.y; }
};

constexpr float height = 1.0F;
const Rectangle floor_plate{{-1.5F, 0.0F, -1.0F}, {3.0F, 2.0F}};
const Rectangle lamp_plate{{-0.9F, height, -0.2F}, {0.4F, 0.4F}};
const Rectangle black_plate{{0.9F, height, 0.5F}, {0.4F, 0.4F}};
constexpr float lamp_radiance = 1000.0F;

/// Mean illuminance of the plate: L times the integral over lamp, floor and plate of
/// f_r cos cos cos cos / (r1^2 r2^2), by the midpoint rule.
template <typename Reflectance>
double integrate(const Reflectance& f_r) {
    constexpr int fine = 96;
    constexpr int coarse = 4;
    double sum = 0.0;
    const auto each_cell = [](const Rectangle& r, int n, const auto& visit) {
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                visit(r.cell(i, j, n));
            }
        }
    };
    each_cell(floor_plate, fine, [&](const glm::vec3& x) {
        each_cell(lamp_plate, coarse, [&](const glm::vec3& from) {
            const glm::vec3 to_lamp = from - x;
            const double r1 = glm::dot(to_lamp, to_lamp);
            const glm::vec3 w_in = glm::normalize(to_lamp);
            each_cell(black_plate, coarse, [&](const glm::vec3& to) {
                const glm::vec3 to_plate = to - x;
                const double r2 = glm::dot(to_plate, to_plate);
                const glm::vec3 w_out = glm::normalize(to_plate);
                const double cosines = std::pow(static_cast<double>(w_in.y) * w_out.y, 2.0);
                sum += f_r(w_in, w_out) * cosines / (r1 * r2);
            });
        });
    });
    constexpr double cells = static_cast<double>(fine) * fine * coarse * coarse * coarse * coarse;
    return static_cast<double>(lamp_radiance) * sum * floor_plate.area() * lamp_plate.area() /
           cells;
}

Material metal(float roughness) {
    Material material;
    material.base_colour = glm::vec3(0.9F);
    material.metallic = 1.0F;
    material.roughness = roughness;
    return material;
}

/// From y up to the BRDF's z up.
glm::vec3 to_local(const glm::vec3& w) {
    return {w.x, w.z, w.y};
}

void add_plate(SceneBuilder& b, const Rectangle& r, bool up, std::uint32_t cells,
               std::uint32_t material) {
    const glm::vec3 x(r.size.x, 0.0F, 0.0F);
    const glm::vec3 z(0.0F, 0.0F, r.size.y);
    b.add_quad(r.corner, up ? z : x, up ? x : z, cells, cells, material);
}

}  // namespace

GlossyReflection glossy_reflection(float roughness, const OracleSettings& settings) {
    const Material material = metal(roughness);
    const ReflectanceTable table(make_brdf(material, material.base_colour));
    GlossyReflection result;
    result.exact = integrate([&](const glm::vec3& w_in, const glm::vec3& w_out) {
        return static_cast<double>(evaluate(table.brdf(), to_local(w_in), to_local(w_out)).r);
    });
    result.main_part = integrate([&](const glm::vec3& w_in, const glm::vec3&) {
        return static_cast<double>(table.albedo(w_in.y).r) / pi;
    });
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    const auto lamp = b.add_material(glm::vec3(0.0F), glm::vec3(lamp_radiance));
    const auto floor = b.add_material(material);
    add_plate(b, floor_plate, true, 24, floor);
    add_plate(b, lamp_plate, false, 4, lamp);
    const std::size_t receiver = b.mesh.triangles.size();
    add_plate(b, black_plate, false, 2, black);
    const auto irradiance = solve(b, settings).store().read_irradiance();
    result.solved = mean_irradiance(b, irradiance, receiver, irradiance.size());
    return result;
}

double glossy_furnace_mean(float roughness, float albedo, const OracleSettings& settings) {
    constexpr float emission = 100.0F;
    Material material;
    material.base_colour = glm::vec3(1.0F);
    material.metallic = 0.0F;
    material.roughness = roughness;
    material.emission = glm::vec3(emission);
    material.reflectance = albedo;
    SceneBuilder b;
    b.set_transform(odd_rotation());
    b.add_box({0, 0, 0}, {4, 3, 5}, true, 4, b.add_material(material));
    b.join(settings.joined);
    const ReflectanceTable table(make_brdf(material, material.base_colour));
    const double exact =
        pi * static_cast<double>(emission) / (1.0 - static_cast<double>(table.albedo(0.5F).r));
    return mean_irradiance(b, solve(b, settings).store().read_irradiance()) / exact;
}

}  // namespace raybundle
