// SPDX-License-Identifier: Apache-2.0
// The C++ side of shaders/common/layouts.glsl: the same text, with GLSL's types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace raybundle::layout {
using glm::ivec4;
using glm::mat4;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

#include "shaders/common/layouts.glsl"

// std430 puts a scalar into the fourth component after a vec3, as C++ does.
static_assert(sizeof(PatchGeometry) == 32 && offsetof(PatchGeometry, offset) == 12);
static_assert(sizeof(PatchSurface) == 32);
static_assert(sizeof(RadianceSlope) == 16 && sizeof(VertexLight) == 32);
static_assert(sizeof(Shooter) == 128 && offsetof(Shooter, normal) == 16);
static_assert(sizeof(Counters) == 48);
static_assert(sizeof(FacetGeometry) == 64 && offsetof(FacetGeometry, root_code) == 48);
static_assert(sizeof(FluxSums) == 48 && sizeof(Balance) == 48);
static_assert(sizeof(ZoneLevelData) == 64 && sizeof(ZoneRay) == 8);
static_assert(sizeof(VertexData) == 32 && offsetof(VertexData, first_triangle) == 16);
static_assert(sizeof(MaterialData) == 80);
static_assert(sizeof(Reflectance) == 48);
static_assert(sizeof(MaterialDetails) == MATERIAL_DETAILS_TEXELS * sizeof(vec4));
static_assert(sizeof(PunctualData) == 192);
static_assert(sizeof(LuminaireData) == 112);
static_assert(sizeof(LuminaireHead) == 32 + 32 * (MOST_LUMINAIRES / LUMINAIRES_IN_GROUP));
static_assert(sizeof(PixelSurface) == 32 && offsetof(PixelSurface, normal) == 16);
static_assert(sizeof(ContinuedPixel) == 48 && offsetof(ContinuedPixel, towards) == 28);
static_assert(sizeof(PickResult) == 64);
static_assert(sizeof(BundleParameters) == 16 * (19 + 4 * MOST_MOVED));
static_assert(sizeof(OpeningParameters) == 16 * (5 * MOST_OPENINGS + 1));
static_assert(sizeof(ViewParameters) == 64 + 16 * 21);
}  // namespace raybundle::layout
