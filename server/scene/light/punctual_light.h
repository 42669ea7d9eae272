// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/photometry/ies_profile.h"
#include "scene/photometry/luminous_opening.h"

namespace raybundle {

enum class PunctualKind { point, spot, directional };

/// What people sort and control lights by.
struct LightControl {
    std::string group;  ///< empty: none
    float dim = 1.0F;   ///< 0..1, share of its full light while it is on
    /// What remains of its light when it is to be serviced, 0..1 (EN 12464-1); for maintained
    /// values, without effect on the light.
    float maintenance_factor = 0.8F;
    /// Ra that a person has set; nothing: as the photometric file states it. Without effect on the
    /// light, too.
    std::optional<float> colour_rendering{};
};

/// What can be changed of a punctual light while a scene is shown.
struct PunctualSetting {
    glm::vec3 intensity{0.0F};  ///< as PunctualLight::intensity, while it is on
    glm::vec3 colour{1.0F};     ///< of luminance 1, kept while intensity is 0
    bool on = true;
    glm::vec3 loaded{0.0F};  ///< intensity as the file has it
};

/// How a luminaire was made that has been added while the scene is shown.
struct AddedLuminaire {
    std::uint32_t number = 0;  ///< its Light::id
    std::string name;
    std::string photometry;  ///< file of SceneFolder
    glm::vec3 position{0.0F}, aim{0.0F, -1.0F, 0.0F};
    float rotation = 0.0F;  ///< all three as in LightPlace
    std::string group;
};

/// A light that no ray can hit (glTF's KHR_lights_punctual): a point, or the opening that its
/// photometric file states. It shines along -z of its axes. Photometric, without a cut-off: glTF's
/// `range` is not physical, and tells of many lights only which to look at first.
struct PunctualLight {
    /// Each of so many keeps shadow maps; where there are more, rays look for all of them.
    static constexpr std::size_t most_mapped = 256;
    static constexpr int no_object = -1;
    static constexpr int whole = -1;

    std::string name;
    PunctualKind kind = PunctualKind::point;
    /// Index into Scene::objects of what carries it, or no_object.
    int object = no_object;
    glm::vec3 position{0.0F};  ///< in its object's space, else in the world's; metres
    glm::mat3 axes{1.0F};      ///< x, y, z in the same space; z is opposite to its direction
    /// Directional: illuminance of a surface that faces it, lx; else luminous intensity, cd, of a
    /// spot along its axis.
    glm::vec3 intensity{0.0F};
    glm::vec3 dark_colour{
        1.0F};           ///< of luminance 1: its colour where the file gives it intensity 0
    float range = 0.0F;  ///< m, as the file has it; 0: not given
    float angular_radius = 0.0F;  ///< directional: half of the diameter of its disc, radians
    bool of_sky = false;          ///< part of Scene::environment
    float inner_cosine = 1.0F;    ///< spot: full intensity within this cone
    float outer_cosine = 0.0F;    ///< spot: dark outside this one; below inner_cosine
    /// Of a point light: its intensity over direction, whose factor `intensity` is then.
    std::shared_ptr<const IesProfile> profile;
    /// Which quarter of the profile's opening it is, 0 to 3, or `whole`: see in_parts().
    int part = whole;
    std::string photometry;  ///< name of the file of its profile; empty: none, or not known
    /// What it was like before its photometry was exchanged; null: it has not been.
    std::shared_ptr<const PunctualLight> as_loaded;
    std::shared_ptr<const AddedLuminaire> added;  ///< null: it is of the scene's file
    bool removed = false;                         ///< it is dark, but has its number
    LightControl control;
    /// Once it has been changed; `intensity` is that times control.dim, and 0 while it is off.
    std::optional<PunctualSetting> setting;
};

/// Of luminance 1.
glm::vec3 colour_of(const PunctualLight& light);

/// What a person has set; nothing: nobody has.
std::optional<ColourRendering> colour_rendering_of(const LightControl& control);
/// As set, else as its photometric file states it; nothing: not known.
std::optional<ColourRendering> colour_rendering_of(const PunctualLight& light);

/// Also of a light that has never been changed.
PunctualSetting setting_of(const PunctualLight& light);

/// What the luminance of an intensity is multiplied by in the unit that people know it in: the flux
/// (lm) of a luminaire whose profile is known, else 1, of cd and lx.
float intensity_unit(const PunctualLight& light);

/// A punctual light in the world.
struct PlacedLight {
    PunctualKind kind = PunctualKind::point;
    glm::dvec3 position{0.0};  ///< m; the middle of its opening, or of a part where it is seen from
    glm::dmat3 axes{1.0};      ///< orthonormal; it shines along -axes[2]
    glm::dvec3 intensity{0.0};
    double angular_radius = 0.0;
    double inner_cosine = 1.0, outer_cosine = 0.0;
    std::shared_ptr<const IesProfile> profile;
    LuminousOpening opening;  ///< its intensity comes from there, evenly

    [[nodiscard]] bool has_opening() const {
        return opening.shape != LuminousOpening::Shape::point;
    }
    /// Draws points evenly over its opening; its position where it has none. u: in [0, 1]².
    [[nodiscard]] glm::dvec3 point(const glm::dvec2& u) const;
    [[nodiscard]] glm::dvec3 direction() const { return -axes[2]; }
    /// Directional: lx; else cd, towards a unit direction away from the light.
    [[nodiscard]] glm::dvec3 towards(const glm::dvec3& direction) const;
    /// Its factor of `intensity` in that direction, cd where it has a profile.
    [[nodiscard]] double attenuation(const glm::dvec3& direction) const;
    /// Luminous flux, lm, of a light that is not directional.
    [[nodiscard]] glm::dvec3 flux() const;
};

/// world_from_object: of the light's object; identity for a light without one.
PlacedLight place_light(const PunctualLight& light, const glm::mat4& world_from_object);

/// The same light by lights without a disc: one that has a disc becomes eight, spread over it.
std::vector<PunctualLight> without_discs(std::span<const PunctualLight> lights);

/// The same light by the four quarters of its opening.
std::vector<PunctualLight> in_parts(const PunctualLight& light);

}  // namespace raybundle
