// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/effects_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "scene/contact/world_triangle.h"
#include "scene/light/caustic_bound.h"
#include "scene/light/environment.h"
#include "scene/material/brdf.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr double skipped_share = 0.1;  // of the accuracy: smaller classes are not simulated
// Radiance, mean, iterate, accumulator, cdf, checkpoint, slope of the radiance, light at vertices.
constexpr std::size_t diffuse_bytes = 124;
constexpr std::size_t glossy_bytes = 56;      // reflector, accepted light, its chain, sent radiance
constexpr std::size_t first_shot_bytes = 32;  // irradiance, and the radiance that it makes
constexpr std::size_t caustic_bytes = 88;     // flux, irradiance, the radiance of it, at vertices
constexpr const char* caustic_paths = "L(D|G)*S+D(D|G)*E";
constexpr std::size_t transmission_bytes = 16;  // transmittance and the other side

/// Numbers that several effects ask for.
struct Survey {
    std::vector<bool> used;  // materials
    double area_flux = 0.0;  // lm, luminance, of emitting surfaces
    double punctual_flux = 0.0;
    double sky_flux = 0.0;  // through the scene's bounding sphere, as are the next two
    double environment_flux = 0.0;
    double sun_flux = 0.0;
    double caustic_flux = 0.0;  // of lamps, at most, that meets mirrors and glass first
    double specular_area = 0.0, other_area = 0.0;  // of sides of surfaces
    std::size_t punctual = 0, suns = 0;
    std::size_t mirrors = 0, polished = 0, panes = 0, bodies = 0;
    double mirrored_share = 0.0;     // largest of mirrors at normal incidence, of others at any
    double transmitted_share = 0.0;  // largest share that glass lets pass
    std::size_t glossy = 0, textured = 0, masked = 0, profiles = 0, bumpy = 0, transmitting = 0;
    std::size_t coats = 0, smooth_coats = 0;
    double diffused_share = 0.0;  // largest that a material transmits diffusely
    double specular_share = 0.0;  // largest of a material, of what it reflects

    [[nodiscard]] double share(double flux) const {
        const double all = area_flux + punctual_flux + sky_flux + environment_flux + sun_flux;
        return all > 0.0 ? flux / all : 0.0;
    }
    /// Of reflected light, if it is the same everywhere: so many of the lines between surfaces meet
    /// mirrors or glass (Cauchy, Crofton).
    [[nodiscard]] double crossed_share() const {
        return other_area > 0.0 ? std::min(specular_area / other_area, 1.0) : 0.0;
    }
};

/// A side of a triangle that reflects, or passes, or both.
void survey_area(const Scene& scene, const Triangle& triangle, double area, Survey& survey) {
    const Material& material = scene.materials[triangle.material];
    const SpecularKind kind = specular_kind(material);
    const double sides = two_sided(scene, triangle) || kind == SpecularKind::pane ? 2.0 : 1.0;
    const bool other = kind == SpecularKind::none || kind == SpecularKind::coat;
    (other ? survey.other_area : survey.specular_area) += sides * area;
}

void survey_lights(const Scene& scene, Survey& survey) {
    constexpr double pi = glm::pi<double>();
    std::vector<double> radiance(scene.materials.size(), 0.0);
    for (const Light& light : scene.lights) {
        radiance[static_cast<std::size_t>(light.material)] =
            static_cast<double>(luminance(light.radiance));
    }
    for (const Triangle& triangle : scene.triangles) {
        survey.used[triangle.material] = true;
        const double area = 0.5 * glm::length(double_area(world_corners(scene, triangle)));
        survey_area(scene, triangle, area, survey);
        if (radiance[triangle.material] > 0.0) {
            const double sides = two_sided(scene, triangle) ? 2.0 : 1.0;
            survey.area_flux += sides * pi * radiance[triangle.material] * area;
        }
    }
    const auto diameter = static_cast<double>(glm::length(scene.bounds.extent()));
    const double sphere = pi * diameter * diameter;
    survey.caustic_flux = flux_on_specular_surfaces(scene);
    const bool image = scene.environment && scene.environment->is_image();
    const auto from_environment =
        scene.environment
            ? pi * static_cast<double>(luminance(glm::vec3(scene.environment->mean()))) * sphere
            : 0.0;
    survey.sky_flux = pi * static_cast<double>(luminance(scene.sky_radiance)) * sphere;
    (image ? survey.environment_flux : survey.sky_flux) += from_environment;
    for (const PunctualLight& light : scene.punctual_lights) {
        const PlacedLight placed = place_light(scene, light);
        const bool directional = light.kind == PunctualKind::directional;
        const auto flux = static_cast<double>(
            luminance(glm::vec3(directional ? placed.intensity : placed.flux())));
        (light.of_sky ? survey.sun_flux : survey.punctual_flux) +=
            directional ? directional_flux(scene, flux) : flux;
        ++(light.of_sky ? survey.suns : survey.punctual);
        survey.profiles += light.profile ? 1 : 0;
    }
}

/// Largest share of a specular lobe in what a material reflects at normal incidence, where a lobe
/// is weakest: towards grazing angles it may be all of it, so a dielectric's bound is 1.
double lobe_share(const Material& material) {
    const Brdf brdf = make_brdf(material, material.base_colour);
    return brdf.lobe.kind == LobeKind::none ? 0.0 : 1.0;
}

void survey_specular(const SpecularSurface& surface, Survey& survey) {
    survey.mirrors += surface.kind == SpecularKind::mirror ? 1 : 0;
    survey.panes += surface.kind == SpecularKind::pane ? 1 : 0;
    survey.bodies += surface.kind == SpecularKind::glass ? 1 : 0;
    survey.mirrored_share =
        std::max(survey.mirrored_share, static_cast<double>(luminance(surface.f0)));
    if (surface.is_glass()) {
        const PaneShares shares = pane_shares(surface, 1.0F);
        survey.transmitted_share =
            std::max(survey.transmitted_share, static_cast<double>(luminance(shares.transmitted)));
        survey.mirrored_share = std::max(survey.mirrored_share, 1.0);  // at grazing angles
    }
    if (surface.kind == SpecularKind::coat && surface.f90 > 0.0F) {
        ++survey.polished;
        survey.mirrored_share = std::max(survey.mirrored_share, 1.0);
    }
}

void survey_materials(const Scene& scene, Survey& survey) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (!survey.used[i]) {
            continue;
        }
        const double share = lobe_share(material);
        if (share > 0.0) {
            ++survey.glossy;
            survey.specular_share = std::max(survey.specular_share, share);
        }
        survey_specular(specular_surface(material, mean_base_colour(scene, material)), survey);
        survey.coats += material.clear_coat > 0.0F ? 1 : 0;
        survey.smooth_coats +=
            specular_kind(material) == SpecularKind::coat && has_smooth_coat(material) ? 1 : 0;
        survey.textured += varies_by_texture(material) ? 1 : 0;
        survey.transmitting += transmits(material) ? 1 : 0;
        const glm::vec3& through = material.transmittance;
        survey.diffused_share =
            std::max(survey.diffused_share,
                     static_cast<double>(std::max({through.r, through.g, through.b})));
        survey.bumpy += material.normal_texture.texture >= 0 ? 1 : 0;
        survey.masked += material.alpha_mode == AlphaMode::mask ? 1 : 0;
    }
}

std::string count_of(std::size_t count, const char* thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string count_of(std::size_t count, const char* one, const char* several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
}

class Planner {
  public:
    Planner(const Scene& scene, double accuracy) : scene_(scene), accuracy_(accuracy) {
        survey_.used.resize(scene.materials.size(), false);
        survey_lights(scene, survey_);
        survey_materials(scene, survey_);
    }

    std::vector<Effect> plan() {
        add("diffuse", true, "every surface may reflect diffusely", "LD+E", 1.0, diffuse_bytes);
        plan_reflection();
        const bool textured = survey_.textured > 0;
        add("textures", textured,
            textured
                ? count_of(survey_.textured, "material has a texture", "materials have a texture")
                : "no material in use has a texture",
            "L(D|G)+E", textured ? 1.0 : 0.0, 0);
        const bool bumpy = survey_.bumpy > 0;
        add("normal-maps", bumpy,
            bumpy ? count_of(survey_.bumpy, "material") + " with a normal map, at the pixels"
                  : "no material in use has a normal map",
            "L(D|G)+E", bumpy ? 1.0 : 0.0, 0);
        plan_lights();
        plan_air();
        return std::move(effects_);
    }

  private:
    void add(const char* name, bool active, std::string reason, const char* path_class,
             double share, std::size_t bytes) {
        effects_.push_back({name, active, std::move(reason), path_class, active ? share : 0.0,
                            active ? bytes : 0, std::nullopt});
    }
    void absent(const char* name, std::string reason, const char* path_class) {
        add(name, false, std::move(reason), path_class, 0.0, 0);
    }

    /// Whether a class of light paths is too small for the accuracy that is asked for.
    [[nodiscard]] bool skips(double bound) const {
        return bound > 0.0 && bound < skipped_share * accuracy_;
    }
    void add_skipped(const char* name, double bound, const char* path_class) {
        effects_.push_back({name, false,
                            fmt::format("skipped: at most {:.2g} % of the light, less than a tenth "
                                        "of the accuracy of {:.3g} % that is asked for",
                                        100.0 * bound, 100.0 * accuracy_),
                            path_class, bound, 0, std::nullopt});
    }

    void plan_reflection() {
        const bool glossy = survey_.glossy > 0;
        add("glossy", glossy,
            glossy ? count_of(survey_.glossy, "material") + " with a specular lobe"
                   : "no material in use has a specular lobe",
            "L(D|G)*G(D|G)*E", survey_.specular_share, glossy_bytes);
        plan_specular();
        const bool coated = survey_.coats > 0;
        add("clear-coat", coated,
            coated ? count_of(survey_.coats, "material") + " below a clear coat, " +
                         std::to_string(survey_.smooth_coats) +
                         " of them so smooth that view rays show what it reflects"
                   : "no material in use has a clear coat",
            "L(D|G)*(G|S)(D|G)*E", 1.0, 0);
        const bool through = survey_.transmitting > 0;
        add("diffuse-transmission", through,
            through ? count_of(survey_.transmitting, "material") + " transmitting light diffusely"
                    : "no material in use transmits light diffusely",
            "L(D|G)*D(D|G)*E", survey_.diffused_share, transmission_bytes);
    }

    void plan_specular() {
        const std::size_t glass = survey_.panes + survey_.bodies;
        const bool any = survey_.mirrors + survey_.polished + glass > 0;
        add("specular-reflection", any,
            any ? count_of(survey_.mirrors, "mirror") + ", " +
                      count_of(survey_.polished, "polished surface") + " and " +
                      std::to_string(glass) +
                      " of glass: view rays go on from them, pixels gather light at their ends"
                : "no material in use is a mirror, polished or glass",
            "L(D|G)*S+E", survey_.mirrored_share, 0);
        add("refraction", glass > 0,
            glass > 0
                ? count_of(survey_.panes, "thin pane") + " and " + std::to_string(survey_.bodies) +
                      " of solid glass: view rays are refracted"
                : "no material in use transmits",
            "L(D|G)*S+E", survey_.transmitted_share, 0);
        plan_caustics();
    }

    void plan_caustics() {
        const std::size_t surfaces = survey_.mirrors + survey_.panes + survey_.bodies;
        const double lamps =
            survey_.share(survey_.area_flux + survey_.punctual_flux + survey_.sun_flux);
        const double skies = survey_.share(survey_.sky_flux + survey_.environment_flux);
        const double light = std::min(survey_.share(survey_.caustic_flux), lamps) + skies;
        const bool active = surfaces > 0 && light > 0.0;
        const double bound = active
                                 ? std::min(light + survey_.crossed_share(), 1.0) *
                                       std::max(survey_.mirrored_share, survey_.transmitted_share)
                                 : 0.0;
        if (skips(bound)) {
            add_skipped("caustics", bound, caustic_paths);
            return;
        }
        std::string reason = surfaces > 0 ? "no light shines at the mirrors and the glass"
                                          : "nothing reflects or refracts like a mirror";
        if (active) {
            reason =
                "light of lamps, skies and other surfaces is followed by single rays to where " +
                count_of(surfaces, "mirror or glass", "mirrors and kinds of glass") +
                " throw it, with what bundles make of it taken away";
        }
        caustics_planned_ = active;
        add("caustics", active, std::move(reason), caustic_paths, bound, caustic_bytes);
    }

    void plan_lights() {
        const bool punctual = survey_.punctual > 0;
        add("punctual-lights", punctual,
            punctual ? count_of(survey_.punctual, "light") + " without extent"
                     : "no light of the scene is without extent",
            "L(D|G)+E", survey_.share(survey_.punctual_flux), first_shot_bytes);
        const bool ies = survey_.profiles > 0;
        add("ies", ies,
            ies ? count_of(survey_.profiles, "light") + " with an IES profile"
                : "no light has an IES profile",
            "L(D|G)+E", survey_.share(survey_.punctual_flux), 0);
        plan_sky();
    }

    void plan_air() {
        if (!scene_.medium) {
            absent("medium", "the air is clear", "L(M|D|G)+E");
            return;
        }
        const Medium& air = *scene_.medium;
        const auto diagonal = static_cast<double>(glm::length(scene_.bounds.extent()));
        add("medium", true,
            fmt::format("visibility of {:.4g} m in the scene's box: bundles and view rays are "
                        "dimmed, single paths bring what is scattered",
                        air.visibility()),
            "L(M|D|G)+E", 1.0 - air.left_after(diagonal), caustics_planned_ ? 0 : caustic_bytes);
    }

    void plan_sky() {
        const bool image = scene_.environment && scene_.environment->is_image();
        const float uniform = luminance(scene_.sky_radiance);
        const bool dome = scene_.environment && !image;
        std::string reason = "no sky is set";
        if (dome) {
            reason = scene_.environment->description();
        } else if (uniform > 0.0F) {
            reason = fmt::format("uniform sky of {:.4g} cd/m²{}", uniform,
                                 has_emitter(scene_) ? "" : ": nothing in the scene emits");
        }
        add("sky", dome || uniform > 0.0F, std::move(reason), "L(D|G)+E",
            survey_.share(survey_.sky_flux), 0);
        const bool sun = survey_.suns > 0;
        add("sun", sun,
            sun ? count_of(survey_.suns, "disc") + " in the sky, by the first shot"
                : "no sun is set; a directional light is one without a diameter",
            "L(D|G)+E", survey_.share(survey_.sun_flux),
            survey_.punctual > 0 ? 0 : first_shot_bytes);
        add("environment", image,
            image ? scene_.environment->description() : "no environment map is given", "L(D|G)+E",
            survey_.share(survey_.environment_flux), 0);
    }

    const Scene& scene_;
    double accuracy_;  // relative error that is asked for; 0: none
    bool caustics_planned_ = false;
    Survey survey_;
    std::vector<Effect> effects_;
};

}  // namespace

EffectsPlan plan_effects(const Scene& scene, std::size_t patches, double accuracy) {
    EffectsPlan plan;
    plan.patches = patches;
    plan.effects = Planner(scene, accuracy).plan();
    for (const Effect& effect : plan.effects) {
        plan.bytes_per_patch += effect.bytes_per_patch;
    }
    return plan;
}

bool is_active(const EffectsPlan& plan, std::string_view name) {
    return std::any_of(plan.effects.begin(), plan.effects.end(),
                       [&](const Effect& e) { return e.name == name && e.active; });
}

nlohmann::json effects_plan_json(const EffectsPlan& plan) {
    nlohmann::json effects = nlohmann::json::array();
    for (const Effect& effect : plan.effects) {
        nlohmann::json entry = {{"name", effect.name},
                                {"active", effect.active},
                                {"reason", effect.reason},
                                {"pathClass", effect.path_class},
                                {"shareBound", effect.share_bound},
                                {"bytesPerPatch", effect.bytes_per_patch},
                                {"msPerIteration", nullptr}};
        if (effect.ms_per_iteration) {
            entry["msPerIteration"] = *effect.ms_per_iteration;
        }
        effects.push_back(std::move(entry));
    }
    return {{"patches", plan.patches},
            {"bytesPerPatch", plan.bytes_per_patch},
            {"effects", std::move(effects)}};
}

}  // namespace raybundle
