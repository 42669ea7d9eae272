// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// A point of a surface by what does not change when the mesh grows, when the object moves, or when
/// another run cuts the object otherwise. Numbers of sides do.
struct SurfacePlace {
    std::uint32_t object = 0;  ///< index into Scene::objects
    glm::vec3 position{0.0F};  ///< object space, m
    glm::vec3 normal{0.0F};    ///< object space, unit, away from the side that is meant
};

/// The point of a side that is nearest to another point. near: space of the side's object, m.
SurfacePlace surface_place(const PatchMesh& mesh, std::uint32_t side, const glm::vec3& near);

/// The side that a point lies on: of the nearest ones of its object that face as it does the one
/// that does so best. Nothing where the object has none.
std::optional<std::uint32_t> side_at(const PatchMesh& mesh, const SurfacePlace& point);

}  // namespace raybundle
