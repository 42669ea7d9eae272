// SPDX-License-Identifier: Apache-2.0
// Lights, materials and places that change while the scene is shown.
#include <algorithm>
#include <cmath>

#include "solution/geometry/gpu_scene.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

/// Whether two maps differ by more than a rigid motion: lengths and angles of the axes' images.
bool differ_in_size(const glm::mat4& a, const glm::mat4& b) {
    constexpr float rounding = 1e-4F;
    const glm::mat3 ga = glm::transpose(glm::mat3(a)) * glm::mat3(a);
    const glm::mat3 gb = glm::transpose(glm::mat3(b)) * glm::mat3(b);
    float difference = 0.0F;
    float size = 0.0F;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            difference = std::max(difference, std::abs(ga[i][k] - gb[i][k]));
            size = std::max(size, std::max(std::abs(ga[i][k]), std::abs(gb[i][k])));
        }
    }
    return difference > rounding * size;
}

}  // namespace

void GpuScene::update_surfaces(const Scene& scene, const PatchMesh& mesh,
                               std::span<const std::uint32_t> materials) {
    openings_changed_ = false;
    for (const std::uint32_t index : materials) {
        const glm::vec2 opening = opening_of(scene.materials[index]);
        openings_changed_ = openings_changed_ || opening != openings_[index];
        openings_[index] = opening;
        reflectance_.update(scene, index);
        if (specular_rays_) {
            specular_rays_->update(scene, index);
        }
        const layout::MaterialData data = material_data(scene, index);
        materials_.write<layout::MaterialData>(std::span(&data, 1),
                                               index * sizeof(layout::MaterialData));
        if (tracer_) {
            tracer_->update_material(scene, index);
        }
    }
    upload_details(scene);
    upload_surfaces(mesh);
    upload_reflectors(mesh);
}

void GpuScene::update_lights(const Scene& scene) {
    light_slots_.update(scene);
    const bool other = scene.environment != sky_.environment;
    sky_ = sky_of(scene);
    if (other) {
        upload_environment();
    }
}

bool GpuScene::covers_lights(const Scene& scene) const {
    return light_slots_.fit(scene) && (has_profiles_ || !any_profile(scene.punctual_lights)) &&
           raybundle::has_sky(scene) == has_sky_ &&
           (scene.environment != nullptr) == (sky_.environment != nullptr);
}

bool GpuScene::covers(const Scene& scene, std::size_t material) const {
    const SpecularKind kind = specular_kind(scene.materials[material]);
    const bool followed =
        kind == SpecularKind::none || (kind == SpecularKind::coat ? coats_ : mirror_or_glass_);
    const bool passed = (glass_ || !is_glass(scene.materials[material])) &&
                        (absorbing_glass_ || !has_absorbing_glass(scene));
    const bool lit = mirrors_shine_ || !trace_caustics_ || !mirror_or_glass_ ||
                     scene.materials[material].emission == glm::vec3(0.0F);
    return followed && passed && lit && reflectance_.covers(scene, material);
}

void GpuScene::set_radiance_unit(float unit, const Scene& scene, const PatchMesh& mesh) {
    radiance_unit_ = unit;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const layout::MaterialData data = material_data(scene, i);
        materials_.write<layout::MaterialData>(std::span(&data, 1),
                                               i * sizeof(layout::MaterialData));
    }
    upload_surfaces(mesh);
}

Bounds GpuScene::bounds_moved(const ObjectMove& move) const {
    const glm::mat4 there = glm::translate(glm::mat4(1.0F), -origin_) * move.world_from_object;
    return bounds_at(move.object, kept(move.object, there));
}

void GpuScene::move_objects(std::span<const ObjectMove> moves) {
    settle();
    openings_changed_ = false;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const ObjectMove& move = moves[i];
        moved_[static_cast<int>(i)] = move.object;
        placed_[move.object] = glm::translate(glm::mat4(1.0F), -origin_) * move.world_from_object;
        world_from_object_[move.object] = kept(move.object, placed_[move.object]);
        rescaled_ = rescaled_ || differ_in_size(world_from_object(move.object, Place::now),
                                                world_from_object(move.object, Place::before));
        facet_boxes_.place(move.object, world_from_object_[move.object]);
        if (specular_rays_) {
            specular_rays_->place(move.object, world_from_object_[move.object]);
        }
        if (tracer_) {
            tracer_->move(move.object, world_from_object_[move.object]);
        }
    }
    upload_matrices();
    place_geometry(Place::now);
    measure();
}

PlacedLight GpuScene::placed_light(std::size_t light) const {
    const PunctualLight& punctual = punctual_lights()[light];
    if (punctual.object == PunctualLight::no_object) {
        return place_light(punctual, glm::translate(glm::mat4(1.0F), -origin_));
    }
    const glm::mat4& carrier = placed_[static_cast<std::size_t>(punctual.object)];
    PlacedLight placed = place_light(punctual, carrier);
    placed.intensity *= glm::mat3(carrier) == glm::mat3(0.0F) ? 0.0 : 1.0;  // it has been removed
    return placed;
}

std::vector<Bounds> GpuScene::moved_bounds() const {
    // Shooters stand a little above the surfaces of their object.
    const glm::vec3 margin(4.0F * static_cast<float>(SHOOTER_LIFT) * diameter_);
    std::vector<Bounds> boxes;
    for (int i = 0; i < MOST_MOVED && moved_[i] != NO_PATCH; ++i) {
        for (const Place place : {Place::now, Place::before}) {
            Bounds box = object_bounds(moved_[i], place);
            if (!box.empty()) {
                box.add(box.min - margin);
                box.add(box.max + margin);
            }
            boxes.push_back(box);
        }
    }
    return boxes;
}

void GpuScene::set_move(const ShaderProgram& program) const {
    constexpr float far_share = 0.2F;  // of the diameter
    program.set("place_before", vertex_count_);
    program.set("far_move", far_share * diameter_);
}

}  // namespace raybundle
