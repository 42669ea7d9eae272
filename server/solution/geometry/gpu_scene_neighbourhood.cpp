// SPDX-License-Identifier: Apache-2.0
// Which objects have left the scene's neighbourhood.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "solution/geometry/gpu_scene.h"

namespace raybundle {

static_assert(coincidence_share == TIE_SHARE);

namespace {

float volume(const glm::mat4& matrix) {
    return std::abs(glm::determinant(glm::mat3(matrix)));
}

}  // namespace

/// What has to be known of the objects to tell when they have left the neighbourhood.
void GpuScene::find_pieces(const Scene& scene, const PatchMesh& mesh) {
    object_pieces_.resize(object_count_);
    const glm::mat4 shift = glm::translate(glm::mat4(1.0F), -origin_);
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const std::uint32_t object = mesh.vertex_object[t.x];
        const glm::mat3 world(scene.objects[object].placement());
        const float area =
            0.5F * glm::length(glm::cross(world * (mesh.positions[t.y] - mesh.positions[t.x]),
                                          world * (mesh.positions[t.z] - mesh.positions[t.x])));
        object_pieces_[object].area += area;
        object_pieces_[object].emission +=
            area * luminance(scene.materials[mesh.triangle_material[i]].emission);
    }
    for (std::uint32_t i = 0; i < object_count_; ++i) {
        const glm::mat4 place = shift * scene.objects[i].placement();  // removed ones may come back
        first_volume_.push_back(volume(place));
        object_pieces_[i] = piece_at(i, place);
    }
    neighbourhood_ = find_neighbourhood(object_pieces_);
}

/// An object as it would be elsewhere. The shifted world.
ScenePiece GpuScene::piece_at(std::uint32_t object, const glm::mat4& world_from_object) const {
    const Bounds box = bounds_at(object, world_from_object);
    ScenePiece piece = object_pieces_[object];
    piece.centre = box.empty() ? glm::vec3(0.0F) : box.centre();
    piece.radius = 0.5F * glm::length(box.extent());
    if (first_volume_[object] > 0.0F) {
        const float growth =
            std::pow(volume(world_from_object) / first_volume_[object], 2.0F / 3.0F);
        piece.area *= growth;
        piece.emission *= growth;
    }
    return piece;
}

/// Of all objects at both places. What a file has is there for good, see scene/gltf/gltf_place.h.
std::vector<glm::mat4> GpuScene::kept_places(const Scene& scene) const {
    std::vector<glm::mat4> places;
    for (std::uint32_t i = 0; i < 2 * object_count_; ++i) {
        const std::uint32_t object = i % object_count_;
        const bool movable = scene.objects[object].movable;
        places.push_back(movable ? kept(object, placed_[object]) : placed_[object]);
    }
    return places;
}

/// The matrix itself, or one that leaves nothing of an object that is stray.
glm::mat4 GpuScene::kept(std::uint32_t object, const glm::mat4& world_from_object) const {
    if (!neighbourhood_.has_lost(piece_at(object, world_from_object))) {
        return world_from_object;
    }
    return glm::translate(glm::mat4(1.0F), neighbourhood_.middle) *
           glm::scale(glm::mat4(1.0F), glm::vec3(0.0F));
}

}  // namespace raybundle
