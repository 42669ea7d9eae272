// SPDX-License-Identifier: Apache-2.0
#include "view/view_programs.h"

#include <algorithm>
#include <array>

namespace raybundle {

namespace {

using Defines = std::vector<std::string>;

Defines with_all(Defines defines, const Defines& more) {
    defines.insert(defines.end(), more.begin(), more.end());
    return defines;
}

ViewPrograms::Resolve make_resolve(const GpuScene& scene, const Defines& variant) {
    const auto defines = with_all(scene.defines(), variant);
    ViewPrograms::Resolve programs;
    programs.all = ShaderProgram({"view_resolve.comp"}, defines);
    if (scene.reflectance().specular()) {
        programs.specular = ShaderProgram({"view_resolve_specular.comp"}, defines);
    }
    return programs;
}

ViewPrograms::Receive make_receive(const std::string& shader, const GpuScene& scene,
                                   const Defines& variant) {
    const auto defines = with_all(scene.defines(), variant);
    ViewPrograms::Receive programs;
    programs.all = ShaderProgram({shader}, defines);
    if (scene.reflectance().any_glossy()) {
        programs.glossy = ShaderProgram({shader}, with(defines, "GLOSSY_PIXELS 1"));
    }
    return programs;
}

ViewPrograms::ReceiveHemicube make_receive_hemicube(const GpuScene& scene, Defines variant) {
    const std::string shader = "transport_hemicube_pixels.comp";
    ViewPrograms::ReceiveHemicube programs;
    programs.from_lambert = make_receive(shader, scene, variant);
    if (scene.reflectance().any_glossy()) {
        variant.emplace_back("SHOOTER_GLOSSY 1");
        programs.from_glossy = make_receive(shader, scene, variant);
    }
    return programs;
}

const std::string continued_macro = "CONTINUED 1";

const std::string patches_macro = "PATCHES_ONLY 1";
/// Pictures may show bodies of luminaires.
const std::string profiles_macro = "IES 1";

Defines variant_of(PixelLight light) {
    return light == PixelLight::patches ? Defines{patches_macro} : Defines{};
}

bool is_among(const Defines& defines, const std::string& define) {
    return std::find(defines.begin(), defines.end(), define) != defines.end();
}

/// What the light at vertices depends on.
Defines vertex_defines(const GpuScene& scene, const Defines& variant) {
    Defines defines = with_all(scene.set_defines(), variant);
    for (const char* effect : {"FIRST_SHOT 1", "CAUSTICS 1"}) {
        if (is_among(scene.defines(), effect)) {
            defines.emplace_back(effect);
        }
    }
    return defines;
}

}  // namespace

std::vector<std::string> patch_light_defines(const GpuScene& scene) {
    return vertex_defines(scene, {patches_macro});
}

ViewPrograms::ViewPrograms(const GpuScene& scene, PixelLight shown)
    : ViewPrograms(scene, variant_of(shown)) {
    if (scene.specular_rays() != nullptr) {
        continued = std::make_unique<ViewPrograms>(scene, with(variant_of(shown), continued_macro));
    }
}

ViewPrograms::ViewPrograms(const GpuScene& scene, const std::vector<std::string>& variant)
    : light(is_among(variant, patches_macro) ? PixelLight::patches : PixelLight::gathered),
      raster({"bundle_raster.vert", "bundle_nearest.frag"}, with(scene.defines(), "SHOW_GLASS 1")),
      raster_staggered({"bundle_raster.vert", "bundle_nearest.frag"},
                       with_all(scene.defines(), {"SHOW_GLASS 1", "STAGGERED 1"})),
      resolve_new(make_resolve(scene, variant)),
      resolve_reprojected(make_resolve(scene, with(variant, "REPROJECT 1"))),
      resolve_moved(make_resolve(scene, with_all(variant, {"REPROJECT 1", "MOVED 1"}))),
      compose_linear({"view_compose.comp"}, with_all(scene.defines(), with(variant, "LINEAR 1"))),
      keep({"view_keep.comp"}, scene.defines()),
      complete({"view_complete.comp"}, scene.set_defines()),
      correct({"view_correct.comp"}, scene.defines()),
      scale({"view_scale.comp"}, scene.defines()),
      scale_delta({"view_scale.comp"}, with(scene.defines(), "INCREMENTS 1")),
      vertex_irradiance({"view_vertex_irradiance.comp"}, vertex_defines(scene, variant)),
      statistics({"view_statistics.comp"}, with_all(scene.defines(), variant)),
      detail({"view_detail.comp"},
             is_among(scene.defines(), profiles_macro) ? Defines{profiles_macro} : Defines{}),
      probe({"view_probe.comp"}, with_all(scene.defines(), variant)),
      scatter_refine({"view_scatter_refine.comp"}),
      confidence({ShaderProgram({"view_confidence_look.comp"}, with_all(scene.defines(), variant)),
                  ShaderProgram({"view_confidence.comp"})}),
      depths({"view_depths.comp"}),
      crowded({"view_crowded.comp"}),
      hemicube_pixels(make_receive_hemicube(scene, variant)),
      hemicube_pixels_special(make_receive_hemicube(scene, with(variant, "SPECIAL 1"))),
      layers_pixels(
          make_receive("transport_layers_pixels.comp", scene, with(variant, "BUT_CROWDED 1"))),
      layers_pixels_special(
          make_receive("transport_layers_pixels.comp", scene, with(variant, "SPECIAL 1"))),
      planes_pixels(make_receive("transport_planes_pixels.comp", scene, variant)),
      layers_crowded(
          make_receive("transport_layers_pixels.comp", scene, with(variant, "CROWDED 1"))),
      edges(scene, with_all(scene.defines(), variant)),
      affected_tiles(scene) {
    const std::array<const char*, 3> modes = {"PHOTO 1", "FALSE_LUMINANCE 1",
                                              "FALSE_ILLUMINANCE 1"};
    for (std::size_t i = 0; i < modes.size() && !is_among(variant, continued_macro); ++i) {
        const auto defines = with_all(scene.defines(), with(variant, modes[i]));
        compose[i] = ShaderProgram({"view_compose.comp"}, defines);
        compose_scaled[i] = ShaderProgram({"view_compose.comp"}, with(defines, "SCALED 1"));
    }
    if (scene.has_sky()) {
        opening_pixels = make_receive("transport_opening_pixels.comp", scene, variant);
    }
    if (scene.reflectance().draws_lobes()) {
        const auto defines = with_all(scene.defines(), variant);
        gloss_rays = {ShaderProgram({"view_gloss_rays.comp"}, defines),
                      ShaderProgram({"view_gloss_rays.comp"}, with(defines, "LAND 1"))};
    }
    if (!scene.punctual_lights().empty()) {
        const auto defines = with_all(scene.defines(), variant);
        first_shot = ShaderProgram(
            {scene.many_lamps() ? "view_lamps.comp" : "view_first_shot.comp"}, defines);
        if (scene.many_lamps()) {
            lamp_points = ShaderProgram({"lamps_pixel_points.comp"}, defines);
        }
    }
}

}  // namespace raybundle
