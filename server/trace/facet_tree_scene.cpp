// SPDX-License-Identifier: Apache-2.0
#include "trace/facet_tree_scene.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace raybundle {

namespace {

/// As shaders/scene/scene_place_vertices.comp places it.
glm::vec3 placed(const glm::mat4& world_from_object, const glm::vec3& position) {
    return glm::vec3(world_from_object * glm::vec4(position, 1.0F));
}

}  // namespace

FacetTreeScene::FacetTreeScene(const Scene& scene, const PatchMesh& mesh,
                               std::span<const glm::mat4> world_from_object,
                               const std::vector<bool>& may_pass, RTCFilterFunctionN filter)
    : device_(rtcNewDevice(nullptr)),
      scene_(rtcNewScene(device_.get())),
      filter_(filter),
      materials_(mesh.facets.empty() ? mesh.triangle_material : mesh.facet_material) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC |
                                       RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);  // a tree for each geometry
    const std::vector<glm::uvec3>& facets = mesh.facets.empty() ? mesh.triangles : mesh.facets;
    // All that cannot move comes first, as one part of all objects.
    constexpr std::int64_t fixed = -1;
    std::map<std::pair<std::int64_t, bool>, Part*> parts;
    for (std::uint32_t facet = 0; facet < facets.size(); ++facet) {
        const std::uint32_t object = mesh.vertex_object[facets[facet].x];
        const bool passed = may_pass[materials_[facet]];
        const bool movable = scene.objects[object].movable;
        Part*& part = parts[{movable ? std::int64_t{object} : fixed, passed}];
        if (part == nullptr) {
            part = parts_.emplace_back(std::make_unique<Part>()).get();
            part->object = object;
            part->movable = movable;
            part->may_pass = passed;
        }
        part->facets.push_back(facet);
        objects_.push_back(object);
    }
    std::vector<std::uint32_t> local_vertex(mesh.positions.size(), no_vertex);
    for (const auto& part : parts_) {
        fill(*part, mesh, world_from_object, local_vertex);
        attach(*part);
    }
    commit();
}

/// Gives a part its vertices. local_vertex: no_vertex everywhere, before and after.
void FacetTreeScene::fill(Part& part, const PatchMesh& mesh,
                          std::span<const glm::mat4> world_from_object,
                          std::vector<std::uint32_t>& local_vertex) {
    const std::vector<glm::uvec3>& facets = mesh.facets.empty() ? mesh.triangles : mesh.facets;
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t facet : part.facets) {
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& local = local_vertex[facets[facet][k]];
            if (local == no_vertex) {
                local = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(facets[facet][k]);
            }
        }
    }
    make_geometry(part, vertices.size());
    for (std::size_t i = 0; i < part.facets.size(); ++i) {
        const glm::uvec3& corners = facets[part.facets[i]];
        part.corners[i] = {local_vertex[corners.x], local_vertex[corners.y],
                           local_vertex[corners.z]};
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t vertex = vertices[i];
        local_vertex[vertex] = no_vertex;
        part.world[i] =
            placed(world_from_object[mesh.vertex_object[vertex]], mesh.positions[vertex]);
        if (part.movable) {
            part.positions.push_back(mesh.positions[vertex]);
        }
        if (part.may_pass) {
            part.uvs.push_back(mesh.uvs[vertex]);
        }
    }
}

void FacetTreeScene::make_geometry(Part& part, std::size_t vertices) {
    part.geometry.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* const world = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(part.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), vertices));
    auto* const corners = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(part.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), part.facets.size()));
    if (world == nullptr || corners == nullptr) {
        throw std::runtime_error("tracing bundles: out of memory");
    }
    part.world = {world, vertices};
    part.corners = {corners, part.facets.size()};
}

void FacetTreeScene::attach(Part& part) {
    const bool filtered = part.may_pass || part.in_motion;
    rtcSetGeometryIntersectFilterFunction(part.geometry.get(), filtered ? filter_ : nullptr);
    rtcSetGeometryOccludedFilterFunction(part.geometry.get(), filtered ? filter_ : nullptr);
    rtcCommitGeometry(part.geometry.get());
    if (part.id == RTC_INVALID_GEOMETRY_ID) {
        part.id = rtcAttachGeometry(scene_.get(), part.geometry.get());
        by_id_.resize(std::max<std::size_t>(by_id_.size(), part.id + 1), nullptr);
        by_id_[part.id] = &part;
    }
    changed_ = true;
}

void FacetTreeScene::detach(Part& part) {
    rtcDetachGeometry(scene_.get(), part.id);
    by_id_[part.id] = nullptr;
    changed_ = true;
}

/// A copy of a part that stays where it is.
void FacetTreeScene::add_place_before(const Part& part) {
    Part& copy = *before_.emplace_back(std::make_unique<Part>());
    copy.object = part.object;
    copy.place = 1;
    copy.in_motion = true;
    copy.may_pass = part.may_pass;
    copy.facets = part.facets;
    copy.uvs = part.uvs;
    make_geometry(copy, part.world.size());
    std::copy(part.world.begin(), part.world.end(), copy.world.begin());
    std::copy(part.corners.begin(), part.corners.end(), copy.corners.begin());
    attach(copy);
}

void FacetTreeScene::move(std::uint32_t object, const glm::mat4& world_from_object) {
    bool found = false;
    for (const auto& part : parts_) {
        if (!part->movable || part->object != object) {
            continue;
        }
        found = true;
        add_place_before(*part);
        for (std::size_t i = 0; i < part->world.size(); ++i) {
            part->world[i] = placed(world_from_object, part->positions[i]);
        }
        part->in_motion = true;
        rtcUpdateGeometryBuffer(part->geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
        attach(*part);
    }
    if (!found && std::find(objects_.begin(), objects_.end(), object) != objects_.end()) {
        throw std::invalid_argument("tracing bundles: object " + std::to_string(object) +
                                    " is not movable");
    }
}

void FacetTreeScene::let_pass(std::uint32_t material) {
    for (const auto& part : parts_) {
        if (!part->may_pass &&
            std::any_of(part->facets.begin(), part->facets.end(),
                        [&](std::uint32_t facet) { return materials_[facet] == material; })) {
            part->may_pass = true;
            attach(*part);
        }
    }
}

void FacetTreeScene::settle() {
    for (const auto& part : before_) {
        detach(*part);
    }
    before_.clear();
    for (const auto& part : parts_) {
        if (part->in_motion) {
            part->in_motion = false;
            attach(*part);
        }
    }
}

void FacetTreeScene::commit() {
    if (changed_) {
        rtcCommitScene(scene_.get());
        changed_ = false;
        check();
    }
}

void FacetTreeScene::check() const {
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
        throw std::runtime_error("tracing bundles: building the tree failed, Embree error " +
                                 std::to_string(static_cast<int>(error)));
    }
}

std::size_t FacetTreeScene::bytes() const {
    constexpr std::size_t tree_bytes = 80;  // of a facet, about
    std::size_t sum = (materials_.size() + objects_.size()) * sizeof(std::uint32_t);
    for (const auto* parts : {&parts_, &before_}) {
        for (const auto& part : *parts) {
            sum += part->facets.size() * (sizeof(glm::uvec3) + sizeof(std::uint32_t) + tree_bytes) +
                   part->world.size_bytes() + part->positions.size() * sizeof(glm::vec3);
        }
    }
    return sum;
}

}  // namespace raybundle
