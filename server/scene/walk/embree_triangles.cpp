// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/embree_triangles.h"

#include <new>
#include <vector>

namespace raybundle {
namespace {

constexpr std::uint32_t nobody = 0xffffffffU;

/// The object that uses each vertex, the first one. corners: of other objects at such vertices.
std::vector<std::uint32_t> owners(const Scene& scene, std::span<const std::uint32_t> triangles,
                                  std::size_t& corners) {
    std::vector<std::uint32_t> owner(scene.vertices.size(), nobody);
    for (const std::uint32_t t : triangles) {
        const Triangle& triangle = scene.triangles[t];
        for (const std::uint32_t vertex : triangle.vertex) {
            owner[vertex] = owner[vertex] == nobody ? triangle.object : owner[vertex];
            corners += owner[vertex] == triangle.object ? 0 : 1;
        }
    }
    return owner;
}

template <typename T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    auto* const buffer =
        static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
    if (buffer == nullptr) {
        throw std::bad_alloc();
    }
    return buffer;
}

}  // namespace

void set_triangles(RTCGeometry geometry, const Scene& scene,
                   std::span<const std::uint32_t> triangles) {
    std::size_t shared_corners = 0;
    const std::vector<std::uint32_t> owner = owners(scene, triangles, shared_corners);
    auto* const points = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                               scene.vertices.size() + shared_corners);
    auto* const indices =
        new_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.size());
    std::vector<glm::mat4> world;
    for (const Object& object : scene.objects) {
        world.push_back(object.world_from_object());
    }
    const auto place = [&](std::uint32_t vertex, std::uint32_t object) {
        return glm::vec3(world[object] * glm::vec4(scene.vertices[vertex].position, 1.0F));
    };
    for (std::uint32_t vertex = 0; vertex < owner.size(); ++vertex) {
        points[vertex] = owner[vertex] == nobody ? glm::vec3(0.0F) : place(vertex, owner[vertex]);
    }
    auto next = static_cast<std::uint32_t>(owner.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& triangle = scene.triangles[triangles[i]];
        for (int k = 0; k < 3; ++k) {
            std::uint32_t vertex = triangle.vertex[k];
            if (owner[vertex] != triangle.object) {
                points[next] = place(vertex, triangle.object);
                vertex = next++;
            }
            indices[i][k] = vertex;
        }
    }
}

}  // namespace raybundle
