// SPDX-License-Identifier: Apache-2.0
// Lights and glazing as other programs write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_files.h"
#include "gltf_builder.h"
#include "scene/contact/solid_shells.h"
#include "scene/edit/surface_edit.h"
#include "scene/material/base_colour.h"
#include "scene/material/specular_surface.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

TEST(CasesSpot, HardSpotsAreDiscsOfEvenIntensity) {
    const Scene scene = load_gltf(case_path("spot/hard_edge.gltf"));
    EXPECT_NEAR(direct_illuminance(scene, {0, 0, 0}), 111.1, 0.1);
    EXPECT_NEAR(direct_illuminance(scene, {0.928, 0, 0}), 96.9, 0.1);
    EXPECT_EQ(direct_illuminance(scene, {1.639, 0, 0}), 0.0);
    const PlacedLight spot = place_light(scene, scene.punctual_lights[0]);
    EXPECT_NEAR(spot.flux().g, 2000.0 * pi * (1.0 - std::cos(0.4)), 0.1);
}

/// A file whose inner cone is the wider one: all of the outer cone is as bright as the axis.
TEST(CasesSpot, AnInnerConeBeyondTheOuterOneIsCutOff) {
    for (const double inner : {0.6, 0.400001}) {
        GltfBuilder builder = one_triangle();
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"},
             {"intensity", 1000},
             {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", 0.4}}}}};
        builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        const Scene scene = builder.load();
        EXPECT_NEAR(place_light(scene, scene.punctual_lights.at(0)).flux().g,
                    2000.0 * pi * (1.0 - std::cos(0.4)), 0.1);
        EXPECT_EQ(has_notice(scene, "the outer cone gets a hard edge"), inner > 0.5);
    }
}

/// However narrow or wide, and where rounding puts one cone beyond the other.
TEST(CasesSpot, TheEdgeIsWhereTheOuterConeIs) {
    for (const double angle : {0.005, 0.02, 0.4, 1.0, 1.5}) {
        GltfBuilder builder = one_triangle();
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"},
             {"intensity", 1000},
             {"spot", {{"innerConeAngle", angle}, {"outerConeAngle", angle}}}}};
        builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        const Scene scene = builder.load();
        const PlacedLight spot = place_light(scene, scene.punctual_lights[0]);
        const auto towards = [&](double from_axis) {
            return spot.towards({std::sin(from_axis), 0, -std::cos(from_axis)}).g;
        };
        EXPECT_NEAR(towards(0.0), 1000.0, 1e-6) << angle;
        EXPECT_NEAR(towards(0.9 * angle), 1000.0, 1e-6) << angle;
        EXPECT_EQ(towards(1.1 * angle), 0.0) << angle;
    }
}

/// Exporters write the largest float for lights that reach everywhere.
TEST(CasesSpot, RangesMayBeTheLargestFloat) {
    GltfBuilder builder = one_triangle();
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 5}, {"range", 3.40282347e+38}}};
    builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    EXPECT_EQ(builder.load().punctual_lights.size(), 1U);
}

GltfBuilder film(const Json& material, const std::vector<std::uint8_t>& rgba, int width) {
    GltfBuilder builder;
    const int texture = builder.add_view(png(width, 1, rgba));
    builder.json["images"] = {{{"bufferView", texture}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    const int uvs = builder.add_uvs({{0, 0}, {1, 0}, {0, 1}});
    const int mesh = builder.add_mesh(
        {{"attributes", {{"POSITION", builder.add_positions(unit_triangle)}, {"TEXCOORD_0", uvs}}},
         {"material", builder.add_material(material)}});
    builder.add_node({{"mesh", mesh}});
    return builder;
}

Json blended_film(double alpha) {
    return {{"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", 0}}},
              {"baseColorFactor", {1, 1, 1, alpha}},
              {"metallicFactor", 0}}},
            {"alphaMode", "BLEND"}};
}

TEST(CasesGlazing, ATextureOfConstantAlphaIsThatAlpha) {
    const Scene scene = load_gltf(case_path("glazing/texture_alpha40.gltf"));
    const auto pane = std::find_if(scene.materials.begin(), scene.materials.end(),
                                   [](const Material& m) { return m.name == "glass"; });
    ASSERT_NE(pane, scene.materials.end());
    ASSERT_EQ(specular_kind(*pane), SpecularKind::pane);
    EXPECT_NEAR(pane_shares(specular_surface(*pane, pane->base_colour), 1.0F).transmitted.g, 0.6F,
                1e-4F);
    // As the factor of the same alpha, and both are multiplied.
    for (const int alpha : {51, 102, 153, 204, 255}) {
        const float exact = static_cast<float>(alpha) / 255.0F;
        const Scene by_texture =
            film(blended_film(1.0), {255, 255, 255, static_cast<std::uint8_t>(alpha)}, 1).load();
        const Scene by_factor = film(blended_film(exact), {255, 255, 255, 255}, 1).load();
        const Material& a = by_texture.materials[0];
        const Material& b = by_factor.materials[0];
        EXPECT_EQ(specular_kind(a), specular_kind(b));
        EXPECT_LT(glm::distance(a.transmittance, b.transmittance), 1e-5F);
        EXPECT_LT(glm::distance(a.base_colour, b.base_colour), 1e-5F);
        if (alpha < 255) {
            const float passing = specular_kind(a) == SpecularKind::pane
                                      ? specular_surface(a, a.base_colour).tint.g
                                      : a.transmittance.g / max_albedo;
            EXPECT_NEAR(passing, 1.0F - exact, 1e-5F);
        }
    }
    const Material both = film(blended_film(0.5), {255, 255, 255, 102}, 1).load().materials[0];
    EXPECT_NEAR(specular_surface(both, both.base_colour).tint.g, 0.8F, 1e-5F);
}

/// Noise and soft gradients are their mean; what has holes is cut out.
TEST(CasesGlazing, AlphaThatVariesLittleIsItsMean) {
    const auto texels = [](std::initializer_list<int> alphas) {
        std::vector<std::uint8_t> rgba;
        for (const int alpha : alphas) {
            rgba.insert(rgba.end(), {255, 255, 255, static_cast<std::uint8_t>(alpha)});
        }
        return rgba;
    };
    const Material noisy =
        film(blended_film(1.0), texels({100, 104, 98, 106}), 4).load().materials[0];
    EXPECT_EQ(noisy.alpha_mode, AlphaMode::opaque);
    EXPECT_NEAR(specular_surface(noisy, noisy.base_colour).tint.g, 0.6F, 1e-5F);
    const Material soft =
        film(blended_film(1.0), texels({120, 130, 140, 150}), 4).load().materials[0];
    EXPECT_NEAR(soft.transmittance.g, max_albedo * (1.0F - 135.0F / 255.0F), 1e-5F);
    const Material lace = film(blended_film(1.0), texels({0, 255, 30, 240}), 4).load().materials[0];
    EXPECT_EQ(lace.alpha_mode, AlphaMode::mask);
}

Json transmitting(double factor, double metallic = 0.0) {
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", {0.8, 0.8, 0.8, 1.0}},
              {"metallicFactor", metallic},
              {"roughnessFactor", 0.0}}},
            {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", factor}}}}}};
}

/// Share of light that goes through at normal incidence, and diffusely reflected share.
std::pair<float, float> shares(const Material& material) {
    return is_glass(material)
               ? std::pair(pane_shares(specular_surface(material, material.base_colour), 1.0F)
                               .transmitted.g,
                           0.0F)
               : std::pair(material.transmittance.g, material.base_colour.g);
}

/// A pane of n = 1.5 lets 0.923 of what it does not absorb through, of which its colour is left.
TEST(CasesGlazing, PartOfTheLightPassesWhateverTheTransmission) {
    for (const double factor : {0.01, 0.2, 0.4, 0.49, 0.5, 0.6, 0.8, 1.0}) {
        const Material material =
            film(transmitting(factor), {255, 255, 255, 255}, 1).load().materials[0];
        const auto [passing, reflected] = shares(material);
        EXPECT_NEAR(passing, 0.8 * factor * 0.923, 0.002) << factor;
        if (factor < 0.5) {
            EXPECT_NEAR(reflected, 0.8 * (1.0 - factor), 1e-5);
        }
    }
    // Metals transmit nothing.
    EXPECT_FALSE(
        transmits(film(transmitting(0.4, 1.0), {255, 255, 255, 255}, 1).load().materials[0]));
    // The file's pane has a base colour of a half, which tints what passes.
    const Scene scene = load_gltf(case_path("glazing/transmission40.gltf"));
    EXPECT_TRUE(has_notice(scene, "less than half of the light send it diffusely"));
    const auto pane = std::find_if(scene.materials.begin(), scene.materials.end(),
                                   [](const Material& m) { return m.name == "glass"; });
    ASSERT_NE(pane, scene.materials.end());
    EXPECT_NEAR(shares(*pane).first, 0.4 * 0.5 * 0.923, 1e-3);
    EXPECT_NEAR(shares(*pane).second, 0.6 * 0.5, 1e-5);
}

/// A floor with a lamp of 0 cd and a panel of no emissive strength.
GltfBuilder switched_off() {
    GltfBuilder builder =
        film({{"name", "panel"},
              {"emissiveFactor", {1, 0.5, 0.25}},
              {"emissiveTexture", {{"index", 0}}},
              {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 0}}}}}},
             {255, 255, 255, 255}, 1);
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 0}, {"color", {1, 0.5, 0.25}}}};
    builder.add_node({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return builder;
}

TEST(CasesLamp, LampsThatAreOffInTheFileCanBeSwitchedOn) {
    Scene scene = switched_off().load();
    const glm::vec3 colour = glm::vec3(1, 0.5, 0.25) / luminance({1, 0.5, 0.25});
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].name, "panel");
    EXPECT_EQ(scene.lights[0].radiance, glm::vec3(0.0F));
    EXPECT_EQ(scene.lights[0].loaded, glm::vec3(0.0F));
    EXPECT_LT(glm::distance(scene.lights[0].colour, colour), 1e-5F);
    ASSERT_EQ(scene.punctual_lights.size(), 1U);
    EXPECT_EQ(scene.punctual_lights[0].intensity, glm::vec3(0.0F));
    EXPECT_LT(glm::distance(colour_of(scene.punctual_lights[0]), colour), 1e-5F);
    // Nothing emits, so the scene has its sky.
    EXPECT_FALSE(has_emitter(scene));
    EXPECT_EQ(scene.sky_radiance, glm::vec3(1000.0F));
    LightEdit edit;
    edit.light = 1;
    edit.intensity = 200.0F;
    EXPECT_EQ(problem_of(scene, edit), "");
    apply(scene, edit);
    EXPECT_LT(glm::distance(scene.materials[0].emission, 200.0F * colour), 1e-3F);
    EXPECT_TRUE(has_emitter(scene));
    EXPECT_GE(scene.materials[0].emission_texture.texture, 0);
}

/// There may be any number of them, dark or not.
TEST(CasesLamp, AnyNumberOfThemIsRead) {
    GltfBuilder builder = one_triangle();
    Json& lights = builder.json["extensions"]["KHR_lights_punctual"]["lights"];
    for (int i = 0; i < 300; ++i) {
        lights.push_back({{"type", "point"}, {"intensity", i < 20 ? 0 : 1}});
        builder.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    const Scene scene = builder.load();
    EXPECT_EQ(scene.punctual_lights.size(), 300U);
    EXPECT_EQ(std::count_if(scene.punctual_lights.begin(), scene.punctual_lights.end(),
                            [](const PunctualLight& l) { return l.intensity.g > 0.0F; }),
              280);
}

/// --ies gives a lamp of 0 cd the intensity of the file.
TEST(CasesLamp, PhotometricFilesSwitchLampsOn) {
    SceneSettings settings;
    settings.ies = {"lamp=" + case_path("ies/00_clean.ies")};
    const Scene scene = switched_off().load(settings);
    EXPECT_NEAR(luminance(scene.punctual_lights[0].intensity), 1.0F, 1e-5F);
    EXPECT_NEAR(place_light(scene, scene.punctual_lights[0]).flux().g /
                    static_cast<double>(colour_of(scene.punctual_lights[0]).g),
                1000.0 * pi, 4.0);
}

TEST(CasesLamp, LampsInClosedBodiesAreNamed) {
    const auto enclosed = [](const glm::vec3& lamp, const Json& body, const Json& extra = {}) {
        GltfBuilder builder;
        const int mesh = builder.add_box_mesh({-0.1F, -0.1F, -0.1F}, {0.1F, 0.1F, 0.1F});
        builder.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["material"] =
            builder.add_material(body);
        builder.add_node({{"mesh", mesh}, {"name", "shade"}});
        builder.add_node(
            {{"mesh", builder.add_box_mesh({-2, -1, -2}, {2, 2, 2})}, {"name", "room"}});
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"intensity", 100}}};
        builder.json["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}}};
        builder.add_node({{"camera", 0}, {"translation", {1, 1, 1}}});
        builder.add_node({{"name", "bulb"},
                          {"translation", {lamp.x, lamp.y, lamp.z}},
                          {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        if (!extra.is_null()) {
            const int filament = builder.add_box_mesh(glm::vec3(-0.01F), glm::vec3(0.01F));
            builder
                .json["meshes"][static_cast<std::size_t>(filament)]["primitives"][0]["material"] =
                builder.add_material(extra);
            builder.add_node({{"mesh", filament}, {"name", "filament"}});
        }
        std::string text;
        for (const EnclosedLight& light : find_enclosed_lights(builder.load())) {
            text += light.light + " in " + light.object + "; ";
        }
        return text;
    };
    EXPECT_EQ(enclosed({0, 0, 0}, Json::object()), "bulb in shade; ");
    EXPECT_EQ(enclosed({0, 0, 0}, {{"doubleSided", true}}), "bulb in shade; ");
    EXPECT_EQ(enclosed({0, 0.2F, 0}, Json::object()),
              "");  // not in the room either: it has a camera
    EXPECT_EQ(enclosed({0, 0, 0}, transmitting(1.0)), "");
    EXPECT_EQ(enclosed({0, 0, 0}, {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.3}}}},
                                   {"alphaMode", "BLEND"}}),
              "");
    EXPECT_EQ(
        enclosed({1, 0, 0}, Json::object(), {{"name", "glow"}, {"emissiveFactor", {1, 1, 1}}}),
        "glow in shade; ");
}

}  // namespace
}  // namespace raybundle::test
