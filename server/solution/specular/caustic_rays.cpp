// SPDX-License-Identifier: Apache-2.0
#include "solution/specular/caustic_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/contact/facet_walk.h"
#include "scene/mesh/patch_colour.h"
#include "scene/mesh/patch_means.h"
#include "scene/mix_bits.h"
#include "solution/geometry/reflectance_tables.h"

namespace raybundle {
namespace {

constexpr std::uint32_t chunk_rays = 128;
constexpr int most_bundle_surfaces = 64;
constexpr int certain_surfaces = 4;  // before Russian roulette

float unit(std::uint64_t bits) {
    return static_cast<float>(bits >> 40U) * 0x1.0p-24F;
}

/// Numbers of one ray: the additive recurrence of Roberts 2018 ("The Unreasonable Effectiveness of
/// Quasirandom Sequences") in 64-bit fixed point, shifted by the seed.
CausticLights::Numbers numbers_of(std::uint64_t seed, std::uint64_t index) {
    constexpr double root = 1.1127756842787055;  // of x^7 = x + 1
    CausticLights::Numbers numbers{};
    double step = 1.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        step /= root;
        const auto fixed = static_cast<std::uint64_t>(step * 0x1.0p63) << 1U;
        numbers[i] = unit(mix_bits(seed + i) + index * fixed);
    }
    return numbers;
}

}  // namespace

/// What chance decides on the way of one ray.
class CausticRays::Random {
  public:
    Random(std::uint64_t seed, std::uint64_t index) : state_(mix_bits(mix_bits(~seed) + index)) {}
    float next() { return unit(mix_bits(++state_)); }
    std::uint32_t bits() { return static_cast<std::uint32_t>(mix_bits(++state_) >> 32U); }

  private:
    std::uint64_t state_;
};

/// About z, by the cosine.
glm::vec3 CausticRays::cosine_direction(Random& random) {
    const float square = random.next();
    const float turn = 2.0F * std::numbers::pi_v<float> * random.next();
    const float radius = std::sqrt(square);
    return {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1.0F - square)};
}

CausticRays::CausticRays(const Scene& scene, const PatchMesh& mesh, const SpecularRays& rays)
    : rays_(rays),
      lobes_(scene.materials.size()),
      glass_(scene.materials.size()),
      facet_material_(mesh.facets.empty() ? mesh.triangle_material : mesh.facet_material),
      back_side_(mesh.back_side),
      side_triangle_(mesh.side_triangle),
      sets_(mesh.patch_sets),
      triangles_(mesh.triangles),
      facet_roots_(mesh.facets.empty() ? std::vector<FacetNode>{} : mesh.facet_roots),
      facet_tree_(mesh.facet_tree) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        update(scene, i);
    }
    for (std::uint32_t patch = 0; patch < mesh.patch_count() && !sets_.empty(); ++patch) {
        bent_.push_back(is_bent(mesh, patch));
    }
}

void CausticRays::update(const Scene& scene, std::size_t material) {
    const Material& m = scene.materials[material];
    if (specular_kind(m) == SpecularKind::mirror) {
        lobes_[material] = make_brdf(transported_model(m), mean_base_colour(scene, m));
    }
    glass_[material] = bundle_glass(scene, material);
}

std::uint32_t CausticRays::triangle_of(std::uint32_t facet, const glm::vec3& position) const {
    return facet_roots_.empty()
               ? facet
               : triangle_at(facet_roots_[facet], facet_tree_, rays_.weights(facet, position));
}

std::uint32_t CausticRays::patch_at(std::uint32_t facet, bool front,
                                    const glm::vec3& position) const {
    const std::uint32_t triangle = triangle_of(facet, position);
    const std::uint32_t side = front ? triangle : back_side_[triangle];
    return side == PatchMesh::no_patch || sets_.empty() ? side : sets_.side_patch[side];
}

/// As light goes.
void CausticRays::follow(const LightRay& ray, Random& random,
                         std::vector<CausticDeposit>& deposits) const {
    std::array<ContinuedRay, SpecularRays::most_ends> ends;
    const std::size_t count =
        rays_.follow(ray.origin, ray.direction, random.bits(), ends, SpecularRays::Coats::passed);
    for (std::size_t i = 0; i < count; ++i) {
        const ContinuedRay& end = ends[i];
        if (end.surface == ContinuedRay::sky) {
            continue;
        }
        const std::uint32_t patch =
            patch_at(end.surface >> 1U, (end.surface & 1U) == 0, end.position);
        if (patch != PatchMesh::no_patch) {
            deposits.push_back({patch, ray.flux * end.throughput});
        }
    }
    if (count > 0) {
        follow_as_bundles(ray, random, deposits);
    }
}

/// Of the patch that has been met, by area.
CausticRays::Face CausticRays::random_face(const SpecularRays::Hit& hit, Random& random) const {
    const auto facing = [](const std::array<glm::vec3, 3>& corners) {
        return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    };
    const std::uint32_t met = triangle_of(hit.facet, hit.position);
    const std::uint32_t side = hit.front ? met : back_side_[met];
    Face face{rays_.corners(triangles_[met]), glm::vec3(0.0F), !hit.front};
    if (sets_.empty() || side == PatchMesh::no_patch) {
        face.facing = facing(face.corners);
        return face;
    }
    const std::uint32_t patch = sets_.side_patch[side];
    const PatchSides sides(sets_, patch);
    face.bent = bent_[patch];
    float all = 0.0F;
    for (const std::uint32_t member : sides) {  // reservoir sampling (Chao 1982)
        const std::array<glm::vec3, 3> corners = rays_.corners(triangles_[side_triangle_[member]]);
        const glm::vec3 own = facing(corners);
        face.facing += own;
        all += glm::length(own);
        if (sides.size() == 1 || random.next() * all < glm::length(own)) {
            face.corners = corners;
        }
    }
    return face;
}

/// Evenly on the patch that has been met, in front of it.
CausticRays::Start CausticRays::random_point(const SpecularRays::Hit& hit, Random& random) const {
    const auto [corners, facing, back, bent] = random_face(hit, random);
    const float root = std::sqrt(random.next());
    const float along = root * random.next();
    Start start{glm::vec3(0.0F), hit.geometric, hit.geometric, bent};
    if (!sets_.empty()) {
        const float sign = back ? -1.0F : 1.0F;
        const auto unit_normal = [sign](const glm::vec3& across) {
            return across * (sign / std::max(glm::length(across), 1e-30F));
        };
        start.normal = unit_normal(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        start.mean_normal = unit_normal(facing);
    }
    start.point = corners[0] + (root - along) * (corners[1] - corners[0]) +
                  along * (corners[2] - corners[0]) + rays_.offset() * start.normal;
    return start;
}

/// A mirror as bundles know it: all of a patch sends what has come in on it, each of its points
/// about the mirrored direction to where that came from; alike in all directions where the patch is
/// bent (is_bent()), or the light from below its mean plane. False where the ray ends.
bool CausticRays::scatter(LightRay& ray, const SpecularRays::Hit& hit, Random& random) const {
    const Start start = random_point(hit, random);
    const glm::mat3 world = frame_about(start.mean_normal);
    glm::vec3 towards = glm::normalize(ray.origin - start.point) * world;  // its transpose
    const Brdf& lobe = lobes_[facet_material_[hit.facet]];
    const glm::vec2 u(random.next(), random.next());
    const float choice = random.next();
    const bool spreads = !sets_.empty() && (start.bent || towards.z <= 0.0F);
    if (start.bent) {
        towards = cosine_direction(random);
    } else if (spreads) {
        towards.z = -towards.z;
    }
    const BrdfSample drawn = sample(lobe, towards, u, choice);
    if (!(drawn.pdf > 0.0F) || drawn.w_in.z <= 0.0F) {
        return false;
    }
    ray.direction = glm::normalize(world * drawn.w_in);
    float cosine = drawn.w_in.z;
    if (spreads) {  // what has been drawn tells the albedo
        ray.direction = glm::normalize(frame_about(start.normal) * cosine_direction(random));
    } else if (!sets_.empty()) {
        cosine = std::max(glm::dot(ray.direction, start.normal), 0.0F);
    }
    // Reciprocal: what is drawn as coming in is where the light goes.
    ray.flux *= evaluate(lobe, towards, drawn.w_in) * (cosine / drawn.pdf);
    ray.origin = start.point;
    return ray.flux != glm::vec3(0.0F);
}

/// As bundles go, with what glass absorbs of them in the mean; what arrives is taken away.
void CausticRays::follow_as_bundles(LightRay ray, Random& random,
                                    std::vector<CausticDeposit>& deposits) const {
    glm::vec3 from = ray.origin;  // straight through glass: behind the last of it
    for (int i = 0; i < most_bundle_surfaces; ++i) {
        const std::optional<SpecularRays::Hit> hit = rays_.meet(from, ray.direction);
        if (!hit || rays_.absorbs(hit->facet, hit->front)) {
            return;
        }
        ray.flux *= rays_.left_by_air(from, ray.direction, static_cast<double>(hit->distance));
        const SpecularKind kind = rays_.surface(*hit).kind;
        if (kind == SpecularKind::none || kind == SpecularKind::coat) {
            const std::uint32_t patch = patch_at(hit->facet, hit->front, hit->position);
            if (patch != PatchMesh::no_patch) {
                deposits.push_back({patch, -ray.flux});
            }
            return;
        }
        if (kind != SpecularKind::mirror) {
            if (!ray.punctual) {
                const float cosine = std::abs(glm::dot(ray.direction, hit->geometric));
                ray.flux *= glass_[facet_material_[hit->facet]].passing_share(cosine);
            }
            from = hit->position - rays_.offset() * hit->geometric;
            continue;
        }
        const float before = luminance(ray.flux);
        if (!scatter(ray, *hit, random)) {
            return;
        }
        from = ray.origin;
        ray.punctual = false;
        const float chance = std::clamp(luminance(ray.flux) / before, 0.05F, 1.0F);
        if (i >= certain_surfaces) {
            if (random.next() >= chance) {
                return;
            }
            ray.flux /= chance;
        }
    }
}

std::vector<CausticDeposit> CausticRays::trace(const CausticLights& lights, std::uint64_t seed,
                                               std::uint64_t first, std::uint32_t count) const {
    const std::uint32_t chunks = (count + chunk_rays - 1) / chunk_rays;
    std::vector<std::vector<CausticDeposit>> of_chunk(chunks);
    tbb::parallel_for(std::uint32_t{0}, chunks, [&](std::uint32_t chunk) {
        const std::uint32_t end = std::min((chunk + 1) * chunk_rays, count);
        for (std::uint32_t i = chunk * chunk_rays; i < end; ++i) {
            if (const auto ray = lights.ray(numbers_of(seed, first + i))) {
                Random random(seed, first + i);
                follow(*ray, random, of_chunk[chunk]);
            }
        }
    });
    std::vector<CausticDeposit> deposits;
    for (const auto& part : of_chunk) {
        deposits.insert(deposits.end(), part.begin(), part.end());
    }
    return deposits;
}

}  // namespace raybundle
