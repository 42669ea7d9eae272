// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "view/error/confidence.h"
#include "view/filters/edge_filter.h"
#include "view/specular/gloss_rays.h"
#include "view/tiles/affected_tiles.h"

namespace raybundle {

/// What light pixels show: also what they have gathered, or that of patches alone, interpolated
/// over vertices.
enum class PixelLight { gathered, patches };

/// Macros of view_vertex_irradiance.comp for all light that patches have.
std::vector<std::string> patch_light_defines(const GpuScene& scene);

/// Programs that all viewers share.
struct ViewPrograms {
    explicit ViewPrograms(const GpuScene& scene, PixelLight shown = PixelLight::gathered);
    /// The same with more macros.
    ViewPrograms(const GpuScene& scene, const std::vector<std::string>& variant);

    PixelLight light = PixelLight::gathered;
    ShaderProgram raster;
    ShaderProgram raster_staggered;  ///< some of the pixels, see view/filters/sub_samples.h
    /// Geometry buffers: of a first picture, with what was accumulated reprojected, and the same
    /// after an object has moved; `specular` goes over specular pixels alone.
    struct Resolve {
        ShaderProgram all, specular;
    };
    Resolve resolve_new, resolve_reprojected, resolve_moved;
    ShaderProgram compose_linear;
    std::array<ShaderProgram, 3> compose, compose_scaled;  ///< by DisplayMode
    ShaderProgram keep;                                    ///< what pixels have over a change
    ShaderProgram complete;                                ///< what the start could not carry
    ShaderProgram correct, scale, scale_delta, vertex_irradiance, statistics, detail, probe;
    ShaderProgram scatter_refine;
    ConfidencePrograms confidence;
    ShaderProgram depths;
    ShaderProgram crowded;
    ShaderProgram first_shot;   ///< only where the scene has punctual lights
    ShaderProgram lamp_points;  ///< only where these are many
    /// Transfers to pixels; `glossy` goes over the glossy ones, `all` over the others.
    struct Receive {
        ShaderProgram all, glossy;
    };
    struct ReceiveHemicube {
        Receive from_lambert, from_glossy;  ///< kind of the shooter
    };
    ReceiveHemicube hemicube_pixels, hemicube_pixels_special;
    Receive layers_pixels, layers_pixels_special, planes_pixels;
    Receive opening_pixels;  ///< only where the scene has a sky
    Receive layers_crowded;  ///< to crowded pixels, which layers_pixels leaves out
    GlossRayPrograms gloss_rays;
    EdgePrograms edges;
    AffectedTilePrograms affected_tiles;
    std::unique_ptr<ViewPrograms> continued;  ///< of SpecularView; only where view rays go on
};

}  // namespace raybundle
