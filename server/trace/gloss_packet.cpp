// SPDX-License-Identifier: Apache-2.0
#include "trace/gloss_packet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

float along_normal(const RTCRayHit& ray) {
    return ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y +
           ray.hit.Ng_z * ray.ray.dir_z;
}

RTCRayHit ray_of(const GlossRay& ray) {
    RTCRayHit result{};
    result.ray.org_x = ray.origin.x;
    result.ray.org_y = ray.origin.y;
    result.ray.org_z = ray.origin.z;
    result.ray.dir_x = ray.direction.x;
    result.ray.dir_y = ray.direction.y;
    result.ray.dir_z = ray.direction.z;
    result.ray.tnear = 0.0F;
    result.ray.tfar = std::numeric_limits<float>::infinity();
    result.ray.mask = ~0U;
    result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return result;
}

/// A back that a ray has met gives way to the front that coincides with it, if any.
void prefer_front(RTCRayHit& met, Query query) {
    const float along = along_normal(met);
    const float tie = query.rules->tie;
    if (tie <= 0.0F || along <= 0.0F) {
        return;
    }
    const float normal = std::sqrt(met.hit.Ng_x * met.hit.Ng_x + met.hit.Ng_y * met.hit.Ng_y +
                                   met.hit.Ng_z * met.hit.Ng_z);
    const float way = tie * normal / along;
    RTCRayHit front = met;
    front.ray.tnear = std::max(met.ray.tfar - way, 0.0F);
    front.ray.tfar = met.ray.tfar + way;
    front.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.fronts_only = true;
    query.context.filter = &filter_query;
    rtcIntersect1(query.tree->get(), &query.context, &front);
    if (front.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        met = front;
    }
}

}  // namespace

void follow_gloss_ray(GlossRay& ray, std::uint32_t number, const Query& query, float tie) {
    Query own = query;
    own.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    own.context.filter = &filter_shadow;
    own.own_facet = ray.facet;
    own.tie = tie;
    RTCRayHit met = ray_of(ray);
    met.ray.id = number;
    rtcIntersect1(query.tree->get(), &own.context, &met);
    ray.surface = FacetTracer::no_hit;
    if (met.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return;
    }
    prefer_front(met, own);
    const std::uint32_t facet = query.tree->part(met.hit.geomID).facets[met.hit.primID];
    ray.surface = 2 * facet + (along_normal(met) > 0.0F ? 1U : 0U);
}

}  // namespace raybundle
