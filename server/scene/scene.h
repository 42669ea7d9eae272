// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/light/punctual_light.h"
#include "scene/medium.h"

namespace raybundle {

class Environment;
class SceneFolder;
struct AddedObject;
struct SceneAnimations;
struct SceneSource;

/// Axis-aligned box; empty while min > max.
struct Bounds {
    glm::vec3 min{1e30F};
    glm::vec3 max{-1e30F};

    void add(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    [[nodiscard]] bool empty() const { return min.x > max.x; }
    [[nodiscard]] glm::vec3 centre() const { return 0.5F * (min + max); }
    [[nodiscard]] glm::vec3 extent() const { return empty() ? glm::vec3(0) : max - min; }
};

/// Image of a texture, 8 bits a channel, RGBA, row 0 first as in the file (glTF: v = 0 is row 0).
/// Colours are sRGB-encoded; roughness, metalness and normals are not.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    bool repeat_u = true;  ///< else clamped to the edge
    bool repeat_v = true;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
};

/// A use of a texture by a material, with KHR_texture_transform already folded into
/// uv_from_mesh_uv.
struct TextureSlot {
    int texture = -1;                 ///< index into Scene::textures, -1: none
    glm::mat3 uv_from_mesh_uv{1.0F};  ///< homogeneous 2D transform
};

enum class AlphaMode { opaque, mask };  // BLEND: see scene/material/alpha_blend.h

/// A specular lobe after Neumann, Neumann and Szirmay-Kalos 1999, "Compact Metallic Reflectance
/// Models": k cos^exponent / max(cos_in, cos_out). The dissertation's scenes have it.
struct MaxPhong {
    glm::vec3 specular{0.0F};  ///< albedo at normal incidence, the largest; half of it at grazing
    float exponent = 1.0F;     ///< "shine", min_exponent to max_exponent

    static constexpr float min_exponent = 1.0F;  ///< below, oblique light would be reflected more
    static constexpr float max_exponent = 1000.0F;
};

/// glTF 2.0 metallic-roughness material. Colours are linear Rec. 709.
struct Material {
    std::string name;
    glm::vec3 base_colour{1.0F};  ///< factor, linear
    TextureSlot base_colour_texture;
    float alpha = 1.0F;  ///< factor of the base colour's alpha
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    float metallic = 1.0F;
    float roughness = 1.0F;
    /// Factors of roughness in G, of metalness in B. None for materials without a GGX lobe.
    TextureSlot metallic_roughness_texture;
    TextureSlot normal_texture;       ///< in tangent space, see scene/material/normal_map.h
    float normal_scale = 1.0F;        ///< of its x and y
    float specular = 1.0F;            ///< KHR_materials_specular specularFactor; 0: pure Lambert
    glm::vec3 specular_colour{1.0F};  ///< specularColorFactor of the same, linear
    float ior = 1.5F;                 ///< KHR_materials_ior, of what is transmitted
    float transmission = 0.0F;  ///< KHR_materials_transmission: share of what is not reflected
    float thickness = 0.0F;     ///< KHR_materials_volume; 0: a thin pane; below: thin_open_glass()
    glm::vec3 attenuation_colour{1.0F};  ///< of the same: left after attenuation_distance, m
    float attenuation_distance = 0.0F;   ///< m; 0: nothing is absorbed
    /// Over a Lambert base_colour, instead of metallic-roughness.
    std::optional<MaxPhong> max_phong;
    float clear_coat = 0.0F;            ///< KHR_materials_clearcoat clearcoatFactor; 0: none
    float clear_coat_roughness = 0.0F;  ///< of the same
    bool clear_coat_traced = false;     ///< its lobe is left out: view rays show what it reflects
    bool lobe_traced = false;           ///< likewise the GGX lobe below the coat
    float reflectance = 1.0F;           ///< factor of the whole BRDF; 1 in files
    glm::vec3 emission{0.0F};           ///< radiance, cd/m²: emissiveFactor * emissiveStrength
    TextureSlot emission_texture;
    /// Of a lamp that the file switches off, by an emissiveStrength of 0: its emissiveFactor.
    glm::vec3 dark_emission{0.0F};
    bool double_sided = false;
    /// KHR_materials_diffuse_transmission: share of the light on one side that is sent from the
    /// other, like a Lambert surface's. With it base_colour is what is left to reflect, there is no
    /// specular lobe, and the surface has two sides.
    glm::vec3 transmittance{0.0F};
    /// KHR_materials_unlit: a picture shows base_colour as it is; to light the surface is black.
    bool unlit = false;
};

inline bool transmits(const Material& material) {
    return material.transmittance != glm::vec3(0.0F);
}

/// Radiance of an unlit surface of base colour 1 where a picture is asked for radiance, cd/m²: the
/// white of the display that sRGB is defined for (IEC 61966-2-1).
constexpr float unlit_white = 80.0F;

/// Translation, rotation, scale: local transform of a node, as in glTF.
struct Transform {
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< glm order: w, x, y, z
    glm::vec3 scale{1.0F};

    [[nodiscard]] glm::mat4 matrix() const;
};

/// What an object is, as its names tell.
enum class ObjectKind { thing, structure, door };

/// A glTF node subtree that is moved as a whole. Objects are not nested in one another.
struct Object {
    std::uint32_t id = 0;  ///< 1-based and equal to its index in Scene::objects plus one
    std::string name;
    bool movable = false;
    ObjectKind kind = ObjectKind::thing;
    std::vector<std::string> path;             ///< names of the nodes above, the outermost first
    Transform transform;                       ///< local, relative to world_from_parent
    glm::mat4 world_from_parent{1.0F};         ///< fixed: product of the ancestors' matrices
    Bounds bounds;                             ///< object space, of its triangles
    std::shared_ptr<const AddedObject> added;  ///< null: it is of the scene's file
    int node = -1;                             ///< of the scene's file; -1: it has been added
    bool removed = false;                      ///< it has its number, but takes part in nothing

    /// Where it is, or would be if it had not been removed.
    [[nodiscard]] glm::mat4 placement() const { return world_from_parent * transform.matrix(); }
    /// Of what has been removed all is in one point.
    [[nodiscard]] glm::mat4 world_from_object() const;
};

/// Perspective camera. Lengths in metres, world space.
struct Camera {
    std::string name;
    glm::vec3 eye{0.0F};
    glm::vec3 target{0.0F, 0.0F, -1.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float vertical_fov = 0.7F;  ///< radians
    /// Part of its picture that is drawn: x and y of the part's centre from the picture's, upwards,
    /// then the part's width and height, in units of the picture's half and whole edges.
    glm::vec4 part{0.0F, 0.0F, 1.0F, 1.0F};
    float near = 0.0F;                  ///< what is nearer along the line of sight is not drawn, m
    std::vector<std::uint32_t> hidden;  ///< indices of objects that are not drawn

    /// Whether it shows less than there is: a section, or what is left of an isolated object.
    [[nodiscard]] bool cut() const { return near > 0.0F || !hidden.empty(); }
};

/// An emitting material seen as a luminaire: what the protocol lists under `lights`.
struct Light {
    std::uint32_t id = 0;  ///< 1-based
    std::string name;
    int material = -1;         ///< index of the emitting material
    glm::vec3 radiance{0.0F};  ///< cd/m², RGB, while it is on
    glm::vec3 colour{1.0F};    ///< of luminance 1, kept while radiance is 0
    glm::vec3 texture{1.0F};   ///< mean of the emission texture: radiance is emission times this
    bool on = true;
    glm::vec3 loaded{0.0F};  ///< radiance as the file has it
    double area = 0.0;       ///< that emits, of both sides where both do, as loaded, m²
    LightControl control{};
};

/// The sky without its suns, seen as a luminaire.
struct SkyLight {
    bool image = false;   ///< an image of the surroundings, else a uniform or standard sky
    bool in_lux = false;  ///< intensity: illuminance of an open horizontal plane; else mean, cd/m²
    glm::vec3 intensity{0.0F};  ///< RGB, while it is on
    glm::vec3 colour{1.0F};     ///< of luminance 1, kept while intensity is 0
    bool on = true;
    glm::vec3 loaded{0.0F};   ///< intensity as the file has it
    glm::vec3 uniform{0.0F};  ///< Scene::sky_radiance as the file has it
};

struct Sky;

/// Daylight that is chosen while a scene is shown. Angles in degrees, in the scene's axes.
struct DaylightSetting {
    static constexpr const char* loaded = "loaded";  ///< what the scene was opened with
    static constexpr const char* none = "none";

    std::string sky = loaded;               ///< one of these, or a name of cie_sky_type()
    float sun_elevation = 45.0F;            ///< -90..90; at 0 and below it is night
    float sun_azimuth = 180.0F;             ///< from -Z over +X
    std::optional<float> zenith_luminance;  ///< cd/m²; else typical of sky and sun's elevation
    std::optional<float> sun_illuminance;   ///< lx, of a surface that faces it; else typical
    std::optional<float> turbidity;         ///< luminous, of the air before the sun; else the sky's
    // Where the sun's angles are from, if not set as angles.
    std::optional<glm::vec2> place;  ///< latitude and longitude, degrees, north and east positive
    float north = 0.0F;              ///< of the model, from -Z over +X
    std::string time;                ///< as parse_time() takes it
};

/// How lamps are set, under a name, as a file has it.
struct SavedLightingScene {
    struct Lamp {
        std::uint32_t light = 0;  ///< Light::id
        glm::vec3 colour{1.0F};
        float intensity = 0.0F;  ///< as LightEdit has it
        float dim = 1.0F;
        bool on = true;
    };
    std::string name, by_name;
    std::vector<Lamp> lamps;
};

/// One triangle of the file, in the space of its object. Indices into Scene::vertices.
struct Triangle {
    std::uint32_t vertex[3] = {0, 0, 0};
    std::uint32_t material = 0;
    std::uint32_t object = 0;  ///< index into Scene::objects (not id)
    bool solid = false;        ///< behind it is a solid: no light, scene/contact/solid_shells.h
};

struct Vertex {
    glm::vec3 position{0.0F};  ///< object space, metres
    glm::vec3 normal{0.0F};    ///< object space, unit
    glm::vec2 uv{0.0F};        ///< TEXCOORD_0 (or the set that the base colour uses)
    glm::vec3 colour{1.0F};    ///< factor of the base colour, linear, 0 to 1
};

/// What loading left out because nothing could ever see it.
struct RemovedGeometry {
    std::size_t degenerate_triangles = 0;  ///< without area
    std::size_t duplicate_faces = 0;       ///< the same three positions and side once more
    std::size_t solid_insides = 0;  ///< back sides of doubleSided triangles, inside of solids
};

/// What a glTF file says, checked, in metres, rest pose, every node's geometry in its object's
/// space.
struct Scene {
    std::string name;  ///< file name without extension
    std::string path;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;  ///< no zero-area ones
    std::vector<Material> materials;  ///< at least one
    std::vector<Texture> textures;
    std::vector<Object> objects;  ///< at least one
    std::vector<Camera> cameras;  ///< at least one: a framing default where the file has none
    std::vector<Light> lights;
    std::vector<PunctualLight> punctual_lights;
    glm::vec3 sky_radiance{0.0F};  ///< cd/m²; uniform sky seen by lines that meet nothing
    /// What such lines see besides: a standard sky, or an image. Its suns are punctual lights.
    std::shared_ptr<const Environment> environment;
    std::optional<SkyLight> sky_light;  ///< none where no sky shines
    std::optional<Medium> medium;       ///< none: the air is clear
    DaylightSetting daylight;
    std::shared_ptr<const Sky> loaded_sky;  ///< once daylight has been set: that of the beginning
    std::shared_ptr<const SceneAnimations> animations;  ///< none where nothing is animated
    std::vector<SavedLightingScene> lighting_scenes;    ///< of the file
    std::shared_ptr<const SceneSource> source;          ///< how it was read; for saving it
    std::shared_ptr<const SceneFolder> folder;          ///< what can be added to it; null: nothing
    Bounds bounds;                                      ///< world space
    glm::dvec3 origin{0.0};                             ///< m, where the file has this scene's zero
    RemovedGeometry removed;
    std::vector<std::string> notices;  ///< what a user should know about how the file was read
};

/// Whether both sides of a triangle receive light and send it.
inline bool two_sided(const Scene& scene, const Triangle& triangle) {
    return scene.materials[triangle.material].double_sided && !triangle.solid;
}

/// Whether anything but a sky emits light.
bool has_emitter(const Scene& scene);

/// The light in the world, its object where it is. What a removed object carries is dark.
PlacedLight place_light(const Scene& scene, const PunctualLight& light);

/// Rec. 709 luminance of a linear RGB colour.
inline float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

}  // namespace raybundle
