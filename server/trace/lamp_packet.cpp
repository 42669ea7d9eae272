// SPDX-License-Identifier: Apache-2.0
#include "trace/lamp_packet.h"

#include <algorithm>
#include <limits>

namespace raybundle {

namespace {

constexpr float at_light = 1.0F - 1e-6F;  // lamps may have a surface where their light is
constexpr unsigned lamp_rays = 8;         // rays of a packet

/// Whether a way from an origin to what is `to` further on meets a box. distant: it has no end.
bool meets(const Bounds& box, const glm::vec3& origin, const glm::vec3& to, bool distant) {
    if (box.empty()) {
        return false;
    }
    float enter = 0.0F;
    float leave = distant ? std::numeric_limits<float>::infinity() : 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        if (to[axis] == 0.0F) {
            if (origin[axis] < box.min[axis] || origin[axis] > box.max[axis]) {
                return false;
            }
            continue;
        }
        const float a = (box.min[axis] - origin[axis]) / to[axis];
        const float b = (box.max[axis] - origin[axis]) / to[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

struct LampPacket {
    alignas(32) RTCRay8 rays{};
    alignas(32) int valid[lamp_rays] = {};
    std::uint32_t slot[lamp_rays] = {};
    unsigned count = 0;
};

std::uint32_t trace_lamps(LampPacket& packet, Query& query) {
    rtcOccluded8(packet.valid, query.tree->get(), &query.context, &packet.rays);
    std::uint32_t lit = 0;
    for (unsigned i = 0; i < packet.count; ++i) {
        lit |= packet.rays.tfar[i] >= 0.0F ? 1U << packet.slot[i] : 0U;
        packet.valid[i] = 0;
    }
    packet.count = 0;
    return lit;
}

}  // namespace

std::uint32_t lamps_that_reach(const LampPoint& point, const Query& query,
                               const LampQuestion& question) {
    const bool moved = (point.cell & LampPoint::moved) != 0;
    if (point.cell == LampPoint::no_cell || (moved && question.but_moved)) {
        return 0;
    }
    Query own = query;
    own.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    own.context.filter = &filter_shadow;
    own.own_facet = point.facet;
    own.tie = question.tie;
    LampPacket packet;
    std::uint32_t lit = 0;
    const auto slots =
        question.slots.subspan(lamp_slots * (point.cell & ~LampPoint::moved), lamp_slots);
    for (std::uint32_t slot = 0; slot < lamp_slots; ++slot) {
        if (slots[slot] == no_lamp) {
            continue;
        }
        const glm::vec4& lamp = question.lamps[slots[slot]];
        const bool distant = lamp.w == 0.0F;
        const glm::vec3 to = distant ? glm::vec3(lamp) : glm::vec3(lamp) - point.position;
        const bool behind = point.normal != glm::vec3(0.0F) && glm::dot(point.normal, to) <= 0.0F;
        if (behind ||
            (!moved && !question.boxes.empty() &&
             std::none_of(question.boxes.begin(), question.boxes.end(), [&](const Bounds& box) {
                 return meets(box, point.position, to, distant);
             }))) {
            continue;
        }
        const unsigned i = packet.count++;
        packet.slot[i] = slot;
        packet.valid[i] = -1;
        packet.rays.org_x[i] = point.position.x;
        packet.rays.org_y[i] = point.position.y;
        packet.rays.org_z[i] = point.position.z;
        packet.rays.dir_x[i] = to.x;
        packet.rays.dir_y[i] = to.y;
        packet.rays.dir_z[i] = to.z;
        packet.rays.tnear[i] = 0.0F;
        packet.rays.tfar[i] = distant ? std::numeric_limits<float>::infinity() : at_light;
        packet.rays.time[i] = 0.0F;
        packet.rays.mask[i] = ~0U;
        packet.rays.id[i] = 0;
        packet.rays.flags[i] = 0;
        if (packet.count == lamp_rays) {
            lit |= trace_lamps(packet, own);
        }
    }
    return packet.count > 0 ? lit | trace_lamps(packet, own) : lit;
}

}  // namespace raybundle
