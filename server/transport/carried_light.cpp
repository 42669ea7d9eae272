// SPDX-License-Identifier: Apache-2.0
#include "transport/carried_light.h"

#include <algorithm>

#include "scene/light/environment.h"
#include "transport/patch_area.h"

namespace raybundle {

void CarriedLight::update(const Scene& scene, const PatchMesh& mesh) {
    flux_.assign(scene.objects.size(), 0.0);
    there_.clear();
    for (const Object& object : scene.objects) {
        there_.push_back(!object.removed);
    }
    other_light_ = has_sky(scene) || !scene.punctual_lights.empty();
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        if (mesh.emission[i] == glm::vec3(0.0F)) {
            continue;
        }
        const std::uint32_t object = mesh.vertex_object[mesh.triangles[mesh.side_triangle[i]].x];
        flux_[object] += area_at(scene.objects[object].placement(), mesh, i) *
                         static_cast<double>(luminance(mesh.emission[i]));
    }
}

float CarriedLight::moved_share(std::span<const ObjectMove> moves,
                                std::span<const Bounds> moved_bounds, float diameter) {
    double total = 0.0;
    double carried = 0.0;
    float way = 0.0F;
    for (const ObjectMove& move : moves) {
        carried += flux_[move.object];
        const bool there = glm::mat3(move.world_from_object) != glm::mat3(0.0F);
        if (there != there_[move.object]) {
            way = diameter;
        }
        there_[move.object] = true;  // before or after
    }
    for (std::size_t object = 0; object < flux_.size(); ++object) {
        total += there_[object] ? flux_[object] : 0.0;
    }
    for (const ObjectMove& move : moves) {
        there_[move.object] = glm::mat3(move.world_from_object) != glm::mat3(0.0F);
    }
    if (other_light_ || total <= 0.0 || diameter <= 0.0F) {
        return 0.0F;
    }
    for (std::size_t i = 0; i + 1 < moved_bounds.size(); i += 2) {
        const Bounds& now = moved_bounds[i];
        const Bounds& before = moved_bounds[i + 1];
        if (!now.empty() && !before.empty()) {
            way = std::max(
                {way, glm::distance(now.min, before.min), glm::distance(now.max, before.max)});
        }
    }
    return static_cast<float>(std::min(carried / total, 1.0)) *
           std::min(4.0F * way / diameter, 1.0F);
}

}  // namespace raybundle
