// SPDX-License-Identifier: Apache-2.0
#include "session/review/pin_place.h"

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

}  // namespace

void put_on(const Scene& scene, const PatchMesh& mesh, std::uint32_t side,
            const glm::vec3& position, Pin& pin) {
    const glm::mat4 world = scene.objects[object_of(mesh, side)].placement();
    pin.place =
        surface_place(mesh, side, glm::vec3(glm::inverse(world) * glm::vec4(position, 1.0F)));
    pin.patch = side;
    pin.triangles = mesh.triangle_count();
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
