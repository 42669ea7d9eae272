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

void ChangedMaterials::look(const Scene& scene, std::span<const PendingChange> pending,
                            std::span<const std::uint32_t> lamps) {
    const auto note = [&](std::uint32_t material) {
        if (material != no_material) {
            before_.emplace(material, specular_kind(scene.materials[material]));
        }
    };
    for (const PendingChange& p : pending) {
        note(material_of(scene, p));
    }
    for (const std::uint32_t lamp : lamps) {
        note(material_of_light(scene, lamp));
    }
}

void ChangedMaterials::look_again(const Scene& scene, std::span<const PendingChange> made,
                                  std::span<const std::uint32_t> lamps) {
    for (const PendingChange& p : made) {
        take(scene, material_of(scene, p), p.change.has_set_light());
    }
    for (const std::uint32_t lamp : lamps) {
        take(scene, material_of_light(scene, lamp), true);
    }
}

void ChangedMaterials::take(const Scene& scene, std::uint32_t material, bool lamp) {
    if (material == no_material) {
        return;
    }
    all_.push_back(material);
    // A polished lamp that is put out is a mirror.
    if (!lamp || specular_kind(scene.materials[material]) != before_.at(material)) {
        reflecting_.push_back(material);
    }
}

}  // namespace raybundle
