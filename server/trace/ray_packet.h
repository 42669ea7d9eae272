// SPDX-License-Identifier: Apache-2.0
// Rays that Embree follows together.
#pragma once

#include <embree3/rtcore.h>

#include "trace/ray_grid.h"

namespace raybundle {

/// Those of a few columns and rows.
template <unsigned Width>
struct Packet;

template <>
struct Packet<16> {
    using Rays = RTCRayHit16;
    static constexpr int columns = 4, rows = 4;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          Rays& rays) {
        rtcIntersect16(valid, scene, context, &rays);
    }
};

template <>
struct Packet<8> {
    using Rays = RTCRayHit8;
    static constexpr int columns = 4, rows = 2;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          Rays& rays) {
        rtcIntersect8(valid, scene, context, &rays);
    }
};

template <>
struct Packet<4> {
    using Rays = RTCRayHit4;
    static constexpr int columns = 2, rows = 2;
    static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          Rays& rays) {
        rtcIntersect4(valid, scene, context, &rays);
    }
};

inline unsigned packet_width(RTCDevice device) {
    const auto native = [&](RTCDeviceProperty property) {
        return rtcGetDeviceProperty(device, property) != 0;
    };
    return native(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)  ? 16
           : native(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? 8
                                                               : 4;
}

/// Number of a line among those of its bundle, as shaders/material/glass.glsl has it.
inline std::uint32_t line_number(int column, int row) {
    return static_cast<std::uint32_t>(row) << 16U | static_cast<std::uint32_t>(column);
}

/// Makes the rays of a packet from its first pixel on; last: end of the pixels of the grid.
template <unsigned Width>
void make_rays(const RayGrid& grid, const glm::ivec2& first, const glm::ivec2& last,
               typename Packet<Width>::Rays& rays, int* valid) {
    for (unsigned i = 0; i < Width; ++i) {
        const int x = first.x + static_cast<int>(i) % Packet<Width>::columns;
        const int y = first.y + static_cast<int>(i) / Packet<Width>::columns;
        valid[i] = x < last.x && y < last.y ? -1 : 0;
        const auto u = static_cast<float>(x);
        const auto v = static_cast<float>(y);
        const glm::vec3 origin = grid.origin + u * grid.origin_x + v * grid.origin_y;
        const glm::vec3 direction = grid.direction + u * grid.direction_x + v * grid.direction_y;
        rays.ray.org_x[i] = origin.x;
        rays.ray.org_y[i] = origin.y;
        rays.ray.org_z[i] = origin.z;
        rays.ray.dir_x[i] = direction.x;
        rays.ray.dir_y[i] = direction.y;
        rays.ray.dir_z[i] = direction.z;
        rays.ray.tnear[i] = grid.near;
        rays.ray.tfar[i] = grid.far;
        rays.ray.time[i] = 0.0F;
        rays.ray.mask[i] = ~0U;
        rays.ray.id[i] = line_number(x, y + grid.line_row);
        rays.ray.flags[i] = 0;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
}

template <typename Rays>
float along_normal(const Rays& rays, unsigned i) {
    return rays.hit.Ng_x[i] * rays.ray.dir_x[i] + rays.hit.Ng_y[i] * rays.ray.dir_y[i] +
           rays.hit.Ng_z[i] * rays.ray.dir_z[i];
}

}  // namespace raybundle
