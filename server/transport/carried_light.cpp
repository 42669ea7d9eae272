// SPDX-License-Identifier: Apache-2.0
#include "transport/carried_light.h"

#include <algorithm>

#include "scene/light/environment.h"
#include "transport/patch_area.h"

namespace raybundle {

void CarriedLight::update(const Scene& scene, const PatchMesh& mesh) {
    flux_.assign(scene.objects.size(), 0.0);
    total_ = 0.0;
    other_light_ = has_sky(scene) || !scene.punctual_lights.empty();
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        if (mesh.emission[i] == glm::vec3(0.0F)) {
            continue;
        }
        const double flux =
            world_area(scene, mesh, i) * static_cast<double>(luminance(mesh.emission[i]));
        flux_[mesh.vertex_object[mesh.triangles[mesh.side_triangle[i]].x]] += flux;
        total_ += flux;
    }
}

float CarriedLight::moved_share(std::span<const ObjectMove> moves,
                                std::span<const Bounds> moved_bounds, float diameter) const {
    if (other_light_ || total_ <= 0.0 || diameter <= 0.0F) {
        return 0.0F;
    }
    double carried = 0.0;
    for (const ObjectMove& move : moves) {
        carried += move.object < flux_.size() ? flux_[move.object] : 0.0;
    }
    float way = 0.0F;
    for (std::size_t i = 0; i + 1 < moved_bounds.size(); i += 2) {
        const Bounds& now = moved_bounds[i];
        const Bounds& before = moved_bounds[i + 1];
        if (!now.empty() && !before.empty()) {
            way = std::max(
                {way, glm::distance(now.min, before.min), glm::distance(now.max, before.max)});
        }
    }
    return static_cast<float>(std::min(carried / total_, 1.0)) *
           std::min(4.0F * way / diameter, 1.0F);
}

}  // namespace raybundle
