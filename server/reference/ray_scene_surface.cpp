// SPDX-License-Identifier: Apache-2.0
// What the ray scene knows of its surfaces: places, normals and colours.
#include <algorithm>
#include <cmath>

#include "reference/ray_scene.h"
#include "reference/texture_lookup.h"
#include "scene/material/normal_map.h"

namespace raybundle {
namespace {

/// Largest power of two that keeps the scene's diameter below 2.
double normalising_scale(const Bounds& bounds) {
    const double diameter = glm::length(glm::dvec3(bounds.extent()));
    return diameter > 0.0 ? std::exp2(-std::floor(std::log2(diameter))) : 1.0;
}

/// Whether a triangle's vertex normals bend away from its plane.
bool is_smooth(const PatchMesh& mesh, const glm::uvec3& triangle) {
    constexpr float flat_cosine = 0.9999F;
    const glm::vec3& a = mesh.positions[triangle.x];
    const glm::vec3 plane =
        glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
    const float limit = flat_cosine * glm::length(plane);
    return glm::dot(mesh.normals[triangle.x], plane) < limit ||
           glm::dot(mesh.normals[triangle.y], plane) < limit ||
           glm::dot(mesh.normals[triangle.z], plane) < limit;
}

const Texture* texture_of(const Scene& scene, const TextureSlot& slot) {
    return slot.texture < 0 ? nullptr : &scene.textures[static_cast<std::size_t>(slot.texture)];
}

template <typename T>
T interpolated(const T& a, const T& b, const T& c, const glm::dvec2& barycentric) {
    return (1.0 - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

}  // namespace

void RayScene::place_vertices() {
    scale_ = normalising_scale(scene_.bounds);
    std::vector<glm::dmat4> matrices;
    matrices.reserve(scene_.objects.size());
    for (const Object& object : scene_.objects) {
        matrices.emplace_back(object.world_from_object());
    }
    positions_.reserve(mesh_.positions.size());
    normals_.reserve(mesh_.positions.size());
    for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
        const glm::dmat4& m = matrices[mesh_.vertex_object[i]];
        const glm::dvec4 world = m * glm::dvec4(glm::dvec3(mesh_.positions[i]), 1.0);
        positions_.emplace_back(from_world(glm::dvec3(world)));
        // Normals transform by the cofactor matrix (the inverse transpose times the determinant).
        const glm::dvec3 x(m[0]);
        const glm::dvec3 y(m[1]);
        const glm::dvec3 z(m[2]);
        const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
        normals_.emplace_back(cofactors * glm::dvec3(mesh_.normals[i]));
    }
}

void RayScene::find_smooth_triangles() {
    smooth_.reserve(mesh_.triangle_count());
    for (const glm::uvec3& triangle : mesh_.triangles) {
        smooth_.push_back(is_smooth(mesh_, triangle));
    }
}

SurfacePoint RayScene::point_on_triangle(std::uint32_t triangle, bool front,
                                         const glm::dvec2& barycentric) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    const glm::dvec3 a(positions_[t.x]);
    const glm::dvec3 e1 = glm::dvec3(positions_[t.y]) - a;
    const glm::dvec3 e2 = glm::dvec3(positions_[t.z]) - a;
    const glm::dvec3 normal = glm::normalize(glm::cross(e1, e2));
    SurfacePoint point;
    point.triangle = triangle;
    point.patch = front ? triangle : mesh_.back_side[triangle];
    point.barycentric = barycentric;
    point.position = a + barycentric.x * e1 + barycentric.y * e2;
    point.normal = front ? normal : -normal;
    return point;
}

double RayScene::diameter() const {
    return scale_ * glm::length(glm::dvec3(scene_.bounds.extent()));
}

SurfacePoint RayScene::point_on_patch(std::uint32_t patch, const glm::dvec2& barycentric) const {
    return point_on_triangle(mesh_.side_triangle[patch], patch < mesh_.triangle_count(),
                             barycentric);
}

double RayScene::patch_area(std::uint32_t patch) const {
    const glm::uvec3& t = mesh_.triangles[mesh_.side_triangle[patch]];
    const glm::dvec3 a(positions_[t.x]);
    return 0.5 * glm::length(
                     glm::cross(glm::dvec3(positions_[t.y]) - a, glm::dvec3(positions_[t.z]) - a));
}

glm::dvec2 RayScene::mesh_uv(const SurfacePoint& point) const {
    const glm::uvec3& t = mesh_.triangles[point.triangle];
    return interpolated(glm::dvec2(mesh_.uvs[t.x]), glm::dvec2(mesh_.uvs[t.y]),
                        glm::dvec2(mesh_.uvs[t.z]), point.barycentric);
}

const Material& RayScene::material(const SurfacePoint& point) const {
    return scene_.materials[mesh_.triangle_material[point.triangle]];
}

SurfacePoint RayScene::other_side(const SurfacePoint& point) const {
    SurfacePoint other = point;
    other.patch = point.patch == point.triangle ? mesh_.back_side[point.triangle] : point.triangle;
    other.normal = -point.normal;
    return other;
}

bool RayScene::transmitting() const {
    return std::any_of(scene_.materials.begin(), scene_.materials.end(), transmits);
}

bool RayScene::covered(std::uint32_t triangle, const glm::dvec2& barycentric) const {
    const Material& m = scene_.materials[mesh_.triangle_material[triangle]];
    if (m.alpha_mode != AlphaMode::mask) {
        return true;
    }
    double alpha = m.alpha;
    if (const Texture* texture = texture_of(scene_, m.base_colour_texture)) {
        SurfacePoint point;
        point.triangle = triangle;
        point.barycentric = barycentric;
        alpha *= look_up(*texture, m.base_colour_texture.uv_from_mesh_uv, mesh_uv(point)).w;
    }
    return alpha >= static_cast<double>(m.alpha_cutoff);
}

glm::vec3 RayScene::base_colour(const SurfacePoint& point) const {
    const Material& m = material(point);
    const Texture* texture = texture_of(scene_, m.base_colour_texture);
    glm::vec3 factor = m.base_colour;
    if (!mesh_.colours.empty()) {
        const glm::uvec3& t = mesh_.triangles[point.triangle];
        factor *=
            glm::vec3(interpolated(glm::dvec3(mesh_.colours[t.x]), glm::dvec3(mesh_.colours[t.y]),
                                   glm::dvec3(mesh_.colours[t.z]), point.barycentric));
    }
    if (texture == nullptr) {
        return factor;
    }
    return factor *
           glm::vec3(look_up(*texture, m.base_colour_texture.uv_from_mesh_uv, mesh_uv(point)));
}

glm::vec2 RayScene::metallic_roughness(const SurfacePoint& point) const {
    const Material& m = material(point);
    const glm::vec2 factors(m.metallic, m.roughness);
    const TextureSlot& slot = m.metallic_roughness_texture;
    if (slot.texture < 0) {
        return factors;
    }
    const glm::vec3 texel(
        look_up_data(*texture_of(scene_, slot), slot.uv_from_mesh_uv, mesh_uv(point)));
    return factors * glm::vec2(texel.b, texel.g);
}

Brdf RayScene::brdf(const SurfacePoint& point) const {
    const auto& textured = textured_models_[mesh_.triangle_material[point.triangle]];
    if (textured) {
        return make_brdf(textured->at(metallic_roughness(point)), base_colour(point));
    }
    return make_brdf(models_[mesh_.triangle_material[point.triangle]], base_colour(point));
}

glm::dvec3 RayScene::emission(const SurfacePoint& point) const {
    const Material& m = material(point);
    const Texture* texture = texture_of(scene_, m.emission_texture);
    if (point.absorbs() || !covered(point.triangle, point.barycentric)) {
        return glm::dvec3(0.0);
    }
    if (texture == nullptr) {
        return glm::dvec3(mesh_.emission[point.patch]);
    }
    return glm::dvec3(m.emission) *
           glm::dvec3(look_up(*texture, m.emission_texture.uv_from_mesh_uv, mesh_uv(point)));
}

glm::dvec3 RayScene::shown_emission(const SurfacePoint& point) const {
    if (material(point).unlit && !point.absorbs()) {
        return double{unlit_white} * glm::dvec3(glm::clamp(base_colour(point), 0.0F, 1.0F));
    }
    return emission(point);
}

glm::dvec3 RayScene::shading_normal(const SurfacePoint& point, const glm::dvec3& to_eye) const {
    const Material& m = material(point);
    const glm::dvec3 smooth = shading_normal(point);
    const Texture* texture = texture_of(scene_, m.normal_texture);
    if (texture == nullptr) {
        return smooth;
    }
    const glm::uvec3& t = mesh_.triangles[point.triangle];
    const glm::dmat2 turned(glm::mat2(m.normal_texture.uv_from_mesh_uv));
    const glm::dvec3 a(positions_[t.x]);
    const glm::dvec2 uv(mesh_.uvs[t.x]);
    const TangentEdges edges{glm::dvec3(positions_[t.y]) - a, glm::dvec3(positions_[t.z]) - a,
                             turned * (glm::dvec2(mesh_.uvs[t.y]) - uv),
                             turned * (glm::dvec2(mesh_.uvs[t.z]) - uv)};
    const double side = point.patch == point.triangle ? 1.0 : -1.0;
    const glm::dvec3 texel(
        look_up_data(*texture, m.normal_texture.uv_from_mesh_uv, mesh_uv(point)));
    const double scale = m.normal_scale;
    return facing_normal(side * mapped_normal(edges, side * smooth, texel, scale), to_eye);
}

glm::dvec3 RayScene::shading_normal(const SurfacePoint& point) const {
    if (!smooth_[point.triangle]) {
        return point.normal;
    }
    const glm::uvec3& t = mesh_.triangles[point.triangle];
    const glm::dvec3 n = interpolated(glm::dvec3(normals_[t.x]), glm::dvec3(normals_[t.y]),
                                      glm::dvec3(normals_[t.z]), point.barycentric);
    const double length = glm::length(n);
    if (!(length > 0.0)) {
        return point.normal;
    }
    return glm::dot(n, point.normal) < 0.0 ? -n / length : n / length;
}

}  // namespace raybundle
