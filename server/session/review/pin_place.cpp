// SPDX-License-Identifier: Apache-2.0
#include "session/review/pin_place.h"

#include <cmath>
#include <vector>

#include "scene/triangle_corners.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

std::uint32_t object_of(const PatchMesh& mesh, std::uint32_t side) {
    return mesh.vertex_object[mesh.triangles[mesh.side_triangle[side]].x];
}

/// Of some sides the nearest point that is the object's.
std::optional<SurfacePlace> nearest_on(const PatchMesh& mesh, std::uint32_t object,
                                       const glm::vec3& position, std::size_t first,
                                       std::size_t end) {
    std::optional<SurfacePlace> nearest;
    for (auto side = static_cast<std::uint32_t>(first); side < end; ++side) {
        if (object_of(mesh, side) != object) {
            continue;
        }
        const SurfacePlace point = surface_place(mesh, side, position);
        if (!nearest ||
            glm::distance(point.position, position) < glm::distance(nearest->position, position)) {
            nearest = point;
        }
    }
    return nearest;
}

/// Where a pin is of which the journal has a side's number and, where its light was measured, the
/// place on its object. Fronts keep their numbers when objects are added, backs do not: what is no
/// front of the pin's object was a back of it.
std::optional<SurfacePlace> place_of_number(const PatchMesh& mesh, const Pin& pin) {
    const v1::PinChanged& message = pin.message;
    if (message.object() == 0) {
        const bool nowhere = pin.patch == 0 || pin.patch >= mesh.side_count();
        return nowhere ? std::nullopt
                       : std::optional(surface_place(mesh, pin.patch,
                                                     from_message(message.local_position())));
    }
    const std::uint32_t object = message.object() - 1;
    const glm::vec3 position = from_message(message.local_position());
    const bool front = pin.patch < mesh.triangle_count() && object_of(mesh, pin.patch) == object;
    if (front) {
        return nearest_on(mesh, object, position, 0, mesh.triangle_count());
    }
    const auto back = nearest_on(mesh, object, position, mesh.triangle_count(), mesh.side_count());
    return back ? back : nearest_on(mesh, object, position, 0, mesh.triangle_count());
}

TriangleCorners world_corners(const PatchMesh& mesh, std::uint32_t triangle,
                              const glm::mat4& world) {
    const auto corner = [&](std::uint32_t vertex) {
        return glm::vec3(world * glm::vec4(mesh.positions[vertex], 1.0F));
    };
    const glm::uvec3& vertex = mesh.triangles[triangle];
    return {corner(vertex.x), corner(vertex.y), corner(vertex.z)};
}

/// The side of a triangle that an eye sees.
std::uint32_t seen_side(const PatchMesh& mesh, std::uint32_t triangle, float facing) {
    const bool has_back = mesh.back_side[triangle] != PatchMesh::no_patch;
    return facing < 0.0F && has_back ? mesh.back_side[triangle] : triangle;
}

}  // namespace

std::optional<NearSide> side_near(const Scene& scene, const PatchMesh& mesh, std::uint32_t named,
                                  const glm::vec3& point, const std::optional<glm::vec3>& eye,
                                  float rounding) {
    std::vector<glm::mat4> placements;
    for (const Object& object : scene.objects) {
        placements.push_back(object.placement());
    }
    const auto corners_of = [&](std::uint32_t triangle) {
        return world_corners(mesh, triangle,
                             placements[mesh.vertex_object[mesh.triangles[triangle].x]]);
    };
    if (named < mesh.side_count() && !scene.objects[object_of(mesh, named)].removed) {
        const float distance =
            glm::distance(nearest_point(corners_of(mesh.side_triangle[named]), point), point);
        if (distance <= rounding) {
            return NearSide{named, distance};
        }
    }
    std::optional<NearSide> nearest;
    float best_facing = 0.0F;
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        if (scene.objects[object_of(mesh, triangle)].removed) {
            continue;
        }
        const TriangleCorners corners = corners_of(triangle);
        const float distance = glm::distance(nearest_point(corners, point), point);
        const float facing =
            eye ? glm::dot(front_normal(corners), glm::normalize(*eye - point)) : 1.0F;
        // Of walls that meet there the one that is seen best.
        const bool both_there = nearest && distance <= rounding && nearest->distance <= rounding;
        if (!nearest ||
            (both_there ? std::abs(facing) > best_facing : distance < nearest->distance)) {
            nearest = NearSide{seen_side(mesh, triangle, facing), distance};
            best_facing = std::abs(facing);
        }
    }
    return nearest;
}

void put_on(const Scene& scene, const PatchMesh& mesh, std::uint32_t side,
            const glm::vec3& position, Pin& pin) {
    const Object& object = scene.objects[object_of(mesh, side)];
    const glm::vec3 local(glm::inverse(object.placement()) * glm::vec4(position, 1.0F));
    pin.place = surface_place(mesh, side, local);
    pin.patch = side;
    pin.triangles = mesh.triangle_count();
    pin.message.set_object(object.id);
    to_message(position, pin.message.mutable_position());
    to_message(local, pin.message.mutable_local_position());
}

std::optional<std::uint32_t> side_of(const Scene& scene, const PatchMesh& mesh, Pin& pin) {
    if (!pin.place && pin.message.object() <= scene.objects.size()) {
        pin.place = place_of_number(mesh, pin);
    }
    if (!pin.place || pin.place->object >= scene.objects.size() ||
        scene.objects[pin.place->object].removed) {
        return std::nullopt;
    }
    if (pin.triangles != mesh.triangle_count()) {
        const auto side = side_at(mesh, *pin.place);
        if (!side) {
            return std::nullopt;
        }
        pin.patch = *side;
        pin.triangles = mesh.triangle_count();
    }
    return pin.patch;
}

}  // namespace raybundle
