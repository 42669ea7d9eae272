// SPDX-License-Identifier: Apache-2.0
#include "session/changes/changed_materials.h"

#include "scene/edit/surface_edit.h"

namespace raybundle {

namespace {

/// Index of the material that a change concerns, or no_material.
std::uint32_t material_of(const Scene& scene, const PendingChange& pending) {
    const std::uint32_t id = subject_of(pending.change).second;
    if (pending.change.has_set_daylight() || pending.change.has_add_luminaire()) {
        return no_material;
    }
    return pending.change.has_set_light() ? material_of_light(scene, id) : id - 1;
}

}  // namespace

ChangedMaterials::ChangedMaterials(const Scene& scene, std::span<const PendingChange> pending) {
    for (const PendingChange& p : pending) {
        if (const std::uint32_t material = material_of(scene, p); material != no_material) {
            before_.emplace(material, specular_kind(scene.materials[material]));
        }
    }
}

void ChangedMaterials::look_again(const Scene& scene, std::span<const PendingChange> made) {
    for (const PendingChange& p : made) {
        const std::uint32_t material = material_of(scene, p);
        if (material == no_material) {
            continue;
        }
        all_.push_back(material);
        // A polished lamp that is put out is a mirror.
        if (!p.change.has_set_light() ||
            specular_kind(scene.materials[material]) != before_.at(material)) {
            reflecting_.push_back(material);
        }
    }
}

}  // namespace raybundle
