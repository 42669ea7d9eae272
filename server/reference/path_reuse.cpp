// SPDX-License-Identifier: Apache-2.0
#include "reference/path_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raybundle {
namespace {

constexpr std::uint32_t tile_side = 8;  // pixels
constexpr std::size_t most_views = std::size_t{tile_side} * tile_side;
// Whether a path arrives at its second surface must not be a matter of roulette: no density knows
// of that.
static_assert(PathSettings{}.certain_bounces > 0);

/// One pixel's way to an offered point.
struct Join {
    glm::dvec3 reflected{0.0};  // f_r cos / squared distance, with the cosine of the offered point
    double density = 0.0;       // with which the pixel's own path goes there, per area
};

Join join(const PathEnd& from, const SurfacePoint& to) {
    const glm::dvec3 way = to.position - from.point.position;
    const double squared_distance = glm::dot(way, way);
    if (!(squared_distance > 0.0)) {
        return {};
    }
    const glm::dvec3 direction = way / std::sqrt(squared_distance);
    const double cosine = -glm::dot(direction, to.normal);
    if (!(cosine > 0.0)) {
        return {};
    }
    const double solid_angle = cosine / squared_distance;  // per area
    return {from.scattering.evaluate(direction) * solid_angle,
            from.scattering.density(direction) * solid_angle};
}

}  // namespace

void PathReuse::add_pass(ImageEstimate& image, const CameraRays& camera) const {
    image.add_tiled_pass(camera, tile_side,
                         [this](const glm::dvec3& origin, std::span<PixelRay> rays,
                                std::span<glm::dvec3> values) { radiance(origin, rays, values); });
}

void PathReuse::radiance(const glm::dvec3& origin, std::span<PixelRay> rays,
                         std::span<glm::dvec3> radiance) const {
    if (tracer_.air()) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            radiance[i] = tracer_.radiance(origin, rays[i].direction, rays[i].sampler);
        }
        return;
    }
    std::vector<View> views;
    std::vector<Offer> offers;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Sampler& sampler = rays[i].sampler;
        const Seen seen = tracer_.see(origin, rays[i].direction, sampler);
        radiance[i] = seen.emitted;
        if (!seen.end) {
            continue;
        }
        views.push_back({i, *seen.end, scene_.departure(seen.end->point)});
        PathEnd end = *seen.end;
        if (!tracer_.advance(end, radiance[i], sampler)) {
            continue;
        }
        if (!end.scattering.is_lambert() || end.passed || transmits(scene_.material(end.point))) {
            radiance[i] += tracer_.reflected(end, sampler);
            continue;
        }
        end.throughput = glm::dvec3(1.0);
        const Offer offer{i, end.point, tracer_.reflected(end, sampler)};
        if (offer.radiance != glm::dvec3(0.0)) {
            offers.push_back(offer);
        }
    }
    for (const Offer& offer : offers) {
        share(offer, views, radiance);
    }
}

void PathReuse::share(const Offer& offer, std::span<const View> views,
                      std::span<glm::dvec3> radiance) const {
    std::array<Join, most_views> joins;
    std::array<std::size_t, most_views> joined;  // views
    std::array<glm::vec3, most_views> departures;
    std::size_t count = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Join way = join(views[i].end, offer.point);
        if (way.density > 0.0) {
            joins[count] = way;
            joined[count] = i;
            departures[count++] = views[i].departure;
        }
    }
    std::array<bool, most_views> open;
    scene_.find_unobstructed(scene_.departure(offer.point), std::span(departures).first(count),
                             open);
    double density = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        // The pixel's own path has been there.
        open[i] = open[i] || views[joined[i]].pixel == offer.pixel;
        density += open[i] ? joins[i].density : 0.0;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (open[i]) {
            const View& view = views[joined[i]];
            radiance[view.pixel] +=
                view.end.throughput * joins[i].reflected * offer.radiance / density;
        }
    }
}

}  // namespace raybundle
