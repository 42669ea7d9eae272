// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/mix_bits.h"
#include "solution/specular/specular_rays.h"

namespace raybundle {

/// One view ray's way.
class SpecularRays::Walk {
  public:
    Walk(const SpecularRays& rays, std::uint32_t seed, std::span<ContinuedRay, most_ends> ends,
         Coats coats, std::span<const std::uint32_t> hidden)
        : rays_(rays), state_(seed), ends_(ends), coats_(coats), hidden_(hidden) {}

    std::size_t run(const glm::vec3& origin, const glm::vec3& direction) {
        const std::optional<Hit> first = rays_.meet(origin, direction, hidden_);
        if (!first || !is_specular(*first) || rays_.absorbs(first->facet, first->front)) {
            return 0;
        }
        added_ = rays_.surface(*first).kind == SpecularKind::coat;
        deflect(dimmed({origin, direction, glm::vec3(1.0F), 0}, first), *first);
        while (open_count_ > 0) {
            const Branch open = open_[--open_count_];
            const std::optional<Hit> hit = rays_.meet(open.origin, open.direction, hidden_);
            const Branch branch = dimmed(open, hit);
            if (!hit || !is_specular(*hit)) {
                end(branch, hit);
            } else if (!rays_.absorbs(hit->facet, hit->front)) {
                deflect(branch, *hit);
            }
        }
        if (count_ == 0) {  // all light is lost on the way: black
            ends_[count_++] = {origin, ContinuedRay::sky, glm::vec3(0.0F), -direction, 0.0F,
                               added_};
        }
        const auto strongest =
            std::max_element(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(count_),
                             [](const ContinuedRay& a, const ContinuedRay& b) {
                                 return luminance(a.throughput) < luminance(b.throughput);
                             });
        std::swap(*strongest, ends_.front());
        return count_;
    }

  private:
    struct Branch {
        glm::vec3 origin, direction, throughput;
        int surfaces = 0;
    };

    /// By the air on its way, of which there is none inside of glass.
    [[nodiscard]] Branch dimmed(Branch branch, const std::optional<Hit>& hit) const {
        if (!hit || hit->front || rays_.surface(*hit).kind != SpecularKind::glass) {
            constexpr double endless = std::numeric_limits<double>::infinity();
            branch.throughput *=
                rays_.left_by_air(branch.origin, branch.direction,
                                  hit ? static_cast<double>(hit->distance) : endless);
        }
        return branch;
    }

    [[nodiscard]] bool is_specular(const Hit& hit) const {
        const SpecularKind kind = rays_.surface(hit).kind;
        return kind != SpecularKind::none &&
               (kind != SpecularKind::coat || coats_ == Coats::followed);
    }

    void end(const Branch& branch, const std::optional<Hit>& hit) {
        if (hit && rays_.absorbs(hit->facet, hit->front)) {
            return;
        }
        ContinuedRay& ray = ends_[count_++];
        ray.position = hit ? hit->position : branch.origin;
        ray.surface = hit ? 2 * hit->facet + (hit->front ? 0U : 1U) : ContinuedRay::sky;
        ray.throughput = branch.throughput;
        ray.towards = -branch.direction;
        ray.way = hit ? hit->distance : 0.0F;
        ray.added = added_;
    }

    void deflect(const Branch& branch, const Hit& hit) {
        const SpecularSurface& surface = rays_.surface(hit);
        const float cosine = -glm::dot(branch.direction, hit.normal);
        if (surface.kind == SpecularKind::mirror) {
            follow(branch, hit, mirrored(branch.direction, hit),
                   mirror_reflectance(surface, cosine));
        } else if (surface.kind == SpecularKind::pane) {
            const PaneShares shares = pane_shares(surface, cosine);
            split(branch, hit, shares.reflected, shares.transmitted, branch.direction);
        } else if (surface.kind == SpecularKind::coat) {
            cover(branch, hit, mirror_reflectance(surface, cosine));
        } else {
            refract(branch, hit, surface, cosine);
        }
    }

    void refract(Branch branch, const Hit& hit, const SpecularSurface& surface, float cosine) {
        const float index = hit.front ? surface.ior : 1.0F / surface.ior;
        if (!hit.front) {  // it came through the body
            branch.throughput *= glm::exp(-surface.absorption * hit.distance);
        }
        const std::optional<glm::vec3> behind = refracted(branch.direction, hit.normal, index);
        const float reflected = behind ? fresnel_reflectance(cosine, index) : 1.0F;
        split(branch, hit, glm::vec3(reflected), (1.0F - reflected) * surface.tint,
              behind.value_or(branch.direction));
    }

    /// What a coat reflects, and what is seen through it: the surface's own record lacks the coat's
    /// lobe, but is dimmed by it (solution/geometry/reflectance_tables.h).
    void cover(const Branch& branch, const Hit& hit, glm::vec3 share) {
        if (branch.surfaces > 0) {
            Branch below = branch;
            if (count_ + open_count_ + 2 > most_ends) {
                const float reflected = luminance(share);
                const float chance = reflected / (reflected + 1.0F);
                const bool reflects = random() < chance;
                share = reflects ? share / chance : glm::vec3(0.0F);
                below.throughput *= reflects ? 0.0F : 1.0F / (1.0F - chance);
            }
            if (below.throughput != glm::vec3(0.0F)) {
                end(below, hit);
            }
        }
        follow(branch, hit, mirrored(branch.direction, hit), share);
    }

    /// Both ways, or one of them where there is no room for both.
    void split(const Branch& branch, const Hit& hit, glm::vec3 reflected, glm::vec3 passed,
               const glm::vec3& behind) {
        if (count_ + open_count_ + 2 > most_ends && reflected != glm::vec3(0.0F) &&
            passed != glm::vec3(0.0F)) {
            const float chance = luminance(reflected) / luminance(reflected + passed);
            if (random() < chance) {
                reflected /= chance;
                passed = glm::vec3(0.0F);
            } else {
                passed /= 1.0F - chance;
                reflected = glm::vec3(0.0F);
            }
        }
        follow(branch, hit, mirrored(branch.direction, hit), reflected);
        follow(branch, hit, behind, passed);
    }

    void follow(const Branch& branch, const Hit& hit, const glm::vec3& direction,
                const glm::vec3& share) {
        const glm::vec3 throughput = branch.throughput * share;
        if (std::max({throughput.r, throughput.g, throughput.b}) < least_throughput ||
            branch.surfaces + 1 >= most_surfaces) {
            return;
        }
        const float side = glm::dot(direction, hit.geometric) < 0.0F ? -1.0F : 1.0F;
        open_[open_count_++] = {hit.position + side * rays_.offset_ * hit.geometric, direction,
                                throughput, branch.surfaces + 1};
    }

    /// About the interpolated normal, or the plane's where that would lead into the surface.
    static glm::vec3 mirrored(const glm::vec3& direction, const Hit& hit) {
        const glm::vec3 smooth = glm::reflect(direction, hit.normal);
        return glm::dot(smooth, hit.geometric) > 0.0F ? smooth
                                                      : glm::reflect(direction, hit.geometric);
    }

    /// Uniform in [0, 1).
    float random() {
        state_ = mix_bits(state_);
        return static_cast<float>(state_ >> 40U) * 0x1.0p-24F;
    }

    const SpecularRays& rays_;
    std::uint64_t state_;
    std::span<ContinuedRay, most_ends> ends_;
    Coats coats_;
    std::span<const std::uint32_t> hidden_;
    bool added_ = false;  // the first surface is a coat
    std::size_t count_ = 0;
    std::array<Branch, most_ends> open_{};
    std::size_t open_count_ = 0;
};

std::size_t SpecularRays::follow(const glm::vec3& origin, const glm::vec3& direction,
                                 std::uint32_t seed, std::span<ContinuedRay, most_ends> ends,
                                 Coats coats, std::span<const std::uint32_t> hidden) const {
    return Walk(*this, seed, ends, coats, hidden).run(origin, direction);
}

}  // namespace raybundle
