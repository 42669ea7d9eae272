// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "scene/light/environment.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/neighbourhood.h"
#include "scene/scene.h"
#include "solution/geometry/facet_boxes.h"
#include "solution/geometry/facet_raster.h"
#include "solution/geometry/light_slots.h"
#include "solution/geometry/patch_members.h"
#include "solution/geometry/reflectance_tables.h"
#include "solution/specular/specular_rays.h"

namespace raybundle {

class FacetTracer;
struct TraceRules;

/// What surfaces are found for.
enum class SeenAs { hemicube, layers, planes, picture };

/// Where the objects are: now, or before the change that is being corrected.
enum class Place : unsigned { now = 0, before = 1 };

/// An object and where it is to be, in the scene's own world.
struct ObjectMove {
    std::uint32_t object = 0;
    glm::mat4 world_from_object{1.0F};
};

/// The scene's geometry and materials on the GPU. "World" on the GPU is the scene's world shifted
/// by -origin(), so that scenes far from their origin keep their precision.
class GpuScene {
  public:
    /// constant_radiance: bundles shall carry what radiance is beyond a constant (ch. 5.5). Only
    /// where nothing is glossy, since what a glossy surface reflects of a constant depends on the
    /// direction.
    /// caustics: single rays follow light by mirrors and glass, where the scene may have any.
    GpuScene(const Scene& scene, const PatchMesh& mesh, bool constant_radiance = false,
             bool caustics = true);
    ~GpuScene();
    GpuScene(GpuScene&&) noexcept;
    [[nodiscard]] bool constant_radiance() const { return constant_radiance_; }

    /// Keeps the present place as `before` and puts MOST_MOVED objects elsewhere, at most. Uploads
    /// matrices only. What leaves the scene's neighbourhood has no size until it comes back, so
    /// that bundles stay as fine, and places as precise, as without it.
    void move_objects(std::span<const ObjectMove> moves);
    /// Those objects until settle(), the rest NO_PATCH.
    [[nodiscard]] const glm::uvec4& moved_objects() const { return moved_; }
    /// Whether some of them are of another size or shape than before: patches have another area.
    [[nodiscard]] bool rescaled() const { return rescaled_; }
    /// Boxes that hold them, and shooters on them, at either place, shifted world.
    [[nodiscard]] std::vector<Bounds> moved_bounds() const;
    /// Takes over the colours that some materials and their patches have now. Each must be covered
    /// by reflectance(). The unit of radiance stays.
    void update_surfaces(const Scene& scene, const PatchMesh& mesh,
                         std::span<const std::uint32_t> materials);
    /// Another unit of radiance: a power of two, cd/m². Only surfaces and sky are converted.
    void set_radiance_unit(float unit, const Scene& scene, const PatchMesh& mesh);
    /// Unit for a brightest emission, or sky, of so much, cd/m².
    static float unit_for(float largest);
    /// Largest radiance that something sends of its own, cd/m².
    static float largest_emission(const Scene& scene, const PatchMesh& mesh);
    [[nodiscard]] const Buffer& surfaces() const { return surfaces_; }
    /// Forgets `before`: both places are the present one.
    void settle();

    /// Draws the facets that a view can see, see FacetRaster::draw(). Where nearest_only, front
    /// faces win over back faces of equal depth.
    void draw(Place place, const glm::mat4& clip_from_world, bool nearest_only,
              const ShaderProgram& program, std::span<const std::uint32_t> hidden = {}) const;

    /// What finds by rays what draw() draws, and the lamps where they are many; else null.
    [[nodiscard]] FacetTracer* tracer() const { return tracer_.get(); }
    /// Whether rays find the surfaces of so many pixels. That depends on numbers alone, never on a
    /// clock, so that results are the same each time.
    [[nodiscard]] bool traces(SeenAs kind, std::size_t pixels) const;
    /// How it does so for bundles.
    [[nodiscard]] TraceRules trace_rules(Place place) const;

    void bind() const;  ///< all storage buffers and buffer textures of this class
    /// What the scene calls for, as macros for its shaders: PATCH_SETS, DOUBLE_SIDED, TEXTURED,
    /// SMOOTH, VERTEX_COLOURS, ALPHA_MASK, DETAILS (materials have textures beside the base colour,
    /// or are unlit), NORMAL_MAPS, UNLIT, SKY, THIN_WALLS, FOLDS (the rasteriser may turn facets
    /// over in ways that matter), SPECULAR (some albedo depends on the angle), GLOSSY (some
    /// radiance depends on direction), MAX_PHONG, FIRST_SHOT (punctual lights), MANY_LAMPS, IES
    /// (some with profiles), TRANSMISSION (some patches send light that arrives on their other
    /// side), ENVIRONMENT (a sky that varies over direction), CONSTANT_RADIANCE, MIRRORS (view rays
    /// go on from some surfaces), GLASS (bundles pass some), CAUSTICS (light may shine on such
    /// surfaces, or air scatters it), MEDIUM (see shaders/scene/air.glsl). What is absent is not
    /// even compiled.
    [[nodiscard]] const std::vector<std::string>& defines() const { return defines_; }
    /// PATCH_SETS, where some patches are several triangles, for what needs no other macro.
    [[nodiscard]] const std::vector<std::string>& set_defines() const { return members_.defines(); }
    [[nodiscard]] bool transmitting() const { return transmittance_.bytes() > 0; }
    [[nodiscard]] std::uint32_t patch_base(Place place) const;
    [[nodiscard]] std::uint32_t facet_base(Place place) const;
    [[nodiscard]] std::uint32_t vertex_base(Place place) const;
    /// What programs that include corrected_weight.glsl have to know of a move.
    void set_move(const ShaderProgram& program) const;

    [[nodiscard]] std::uint32_t patch_count() const { return patch_count_; }
    [[nodiscard]] std::uint32_t front_patch_count() const { return front_patch_count_; }
    /// Fronts and backs of triangles that have light.
    [[nodiscard]] std::uint32_t side_count() const { return side_count_; }
    [[nodiscard]] std::uint32_t vertex_count() const { return vertex_count_; }
    [[nodiscard]] std::uint32_t triangle_count() const { return triangle_count_; }
    [[nodiscard]] float radiance_unit() const { return radiance_unit_; }  ///< cd/m², a power of two
    [[nodiscard]] const glm::vec3& origin() const { return origin_; }
    [[nodiscard]] bool has_sky() const { return has_sky_; }
    /// Radiance of lines that leave the scene in a direction, radiance units.
    [[nodiscard]] glm::vec3 sky_towards(const glm::vec3& direction) const;
    /// What a view shows beyond the scene; its environment is bound with bind().
    void set_background(layout::ViewParameters& view) const;
    [[nodiscard]] const Sky& sky() const { return sky_; }
    /// A sky was another before, and what has been transferred of it has been multiplied since.
    void set_sky_before(const Sky& sky, const glm::vec3& factor) {
        sky_before_ = sky;
        sky_factor_ = factor;
    }
    /// What the sky sends in a direction now, less what has been transferred of the one before;
    /// radiance units.
    [[nodiscard]] glm::vec3 sky_change_towards(const glm::vec3& direction) const;
    /// Whether the last update_surfaces() has changed what lets light pass: glass, or holes.
    [[nodiscard]] bool openings_changed() const { return openings_changed_; }
    /// The lights without extent and the sky as they are now. Requires covers_lights().
    void update_lights(const Scene& scene);
    /// A light with a disc or a large opening is several; see LightSlots.
    [[nodiscard]] const std::vector<PunctualLight>& punctual_lights() const {
        return light_slots_.lights();
    }
    /// There are more of them than shadow maps: rays look for them, see ManyLamps.
    [[nodiscard]] bool many_lamps() const {
        return punctual_lights().size() > PunctualLight::most_mapped;
    }
    /// Whether the shaders and buffers made for the first scene fit its lights as they are now.
    [[nodiscard]] bool covers_lights(const Scene& scene) const;
    /// A punctual light in the shifted world, its object at its present place.
    [[nodiscard]] PlacedLight placed_light(std::size_t light) const;
    [[nodiscard]] const ReflectanceTables& reflectance() const { return reflectance_; }
    /// What deflects view rays, at the present places; null where nothing does.
    [[nodiscard]] const SpecularRays* specular_rays() const { return specular_rays_.get(); }
    /// Whether patches have light that single rays bring: any may shine on mirrors or glass, so
    /// that there are caustics, or the air scatters.
    [[nodiscard]] bool caustics() const { return caustics_; }
    /// Whether any light may shine on mirrors or glass.
    [[nodiscard]] bool mirrors_shine() const { return mirrors_shine_; }
    /// Air between the surfaces, none where it is clear, and the box that holds it, shifted world.
    [[nodiscard]] const std::optional<Medium>& medium() const { return medium_; }
    [[nodiscard]] const Bounds& air_box() const { return air_box_; }
    /// Whether a material as it is in the scene now needs no macro that is not among defines().
    [[nodiscard]] bool covers(const Scene& scene, std::size_t material) const;
    /// Of an object, shifted world, at a place.
    [[nodiscard]] Bounds object_bounds(std::uint32_t object, Place place) const;
    /// Of an object where a move would put it, shifted world.
    [[nodiscard]] Bounds bounds_moved(const ObjectMove& move) const;
    [[nodiscard]] glm::mat4 world_from_object(std::uint32_t object, Place place) const;
    /// Rotation of an object's directions from `before` to `now`, nearest to its change of place
    /// where that also scales or shears; identity where it has no size.
    [[nodiscard]] glm::mat4 now_from_before(std::uint32_t object) const;
    [[nodiscard]] Bounds bounds() const;  ///< of everything, both places, shifted world
    [[nodiscard]] float diameter() const { return diameter_; }  ///< R of the densities, m
    [[nodiscard]] std::size_t bytes() const;

  private:
    void upload_geometry(const Scene& scene, const PatchMesh& mesh);
    void upload_materials(const Scene& scene, const PatchMesh& mesh);
    [[nodiscard]] static glm::vec2 opening_of(const Material& material);
    void upload_surfaces(const PatchMesh& mesh);
    [[nodiscard]] layout::MaterialData material_data(const Scene& scene,
                                                     std::size_t material) const;
    void upload_vertex_data(const PatchMesh& mesh);
    void create_textures();
    void upload_details(const Scene& scene);
    void upload_transmittance(const Scene& scene, const PatchMesh& mesh);
    [[nodiscard]] layout::MaterialDetails material_details(const Scene& scene,
                                                           std::size_t material) const;
    [[nodiscard]] std::vector<std::uint32_t> reflectance_records(const PatchMesh& mesh) const;
    void upload_environment();
    void upload_reflectors(const PatchMesh& mesh);
    void choose_defines(const Scene& scene, const PatchMesh& mesh);
    void define_air();
    void upload_matrices();
    void make_tracer(const Scene& scene, const PatchMesh& mesh);
    void settle_tracer();
    [[nodiscard]] std::size_t tracer_bytes() const;
    void place_geometry(Place place) const;
    void measure();
    void find_pieces(const Scene& scene, const PatchMesh& mesh);
    [[nodiscard]] std::vector<glm::mat4> kept_places(const Scene& scene) const;
    [[nodiscard]] Bounds bounds_at(std::uint32_t object, const glm::mat4& world) const;
    [[nodiscard]] ScenePiece piece_at(std::uint32_t object, const glm::mat4& world) const;
    [[nodiscard]] glm::mat4 kept(std::uint32_t object, const glm::mat4& world_from_object) const;

    std::uint32_t patch_count_, front_patch_count_, side_count_, triangle_count_, vertex_count_,
        object_count_;
    glm::vec3 origin_;
    float radiance_unit_ = 1.0F;
    float diameter_ = 1.0F;
    glm::uvec4 moved_{NO_PATCH};
    bool rescaled_ = false;
    bool thin_walls_ = false;  // fronts and backs may coincide
    bool caustics_ = false;
    bool mirrors_shine_ = false;
    std::optional<Medium> medium_;
    Bounds air_box_;
    bool glass_ = false;            // some surfaces let bundles pass
    bool absorbing_glass_ = false;  // and absorb some of their light
    bool mirror_or_glass_ = false;  // some are more than a smooth coat
    bool coats_ = false;            // some are such
    bool trace_caustics_;
    bool constant_radiance_;
    bool has_sky_ = false;
    bool has_profiles_ = false;  // some lights may shine by photometric files
    Sky sky_, sky_before_;
    glm::vec3 sky_factor_{1.0F};     // of what has been transferred of sky_before_
    Texture2D environment_texture_;  // only where there is one
    Texture2D carried_sky_texture_;  // where it is another: what bundles carry
    std::size_t environment_bytes_ = 0;
    LightSlots light_slots_;
    std::vector<Bounds> object_bounds_;         // object space
    std::vector<glm::mat4> world_from_object_;  // [place * objects + object]
    std::vector<glm::mat4> placed_;             // present ones, of what is stray as well
    std::vector<ScenePiece> object_pieces_;     // areas and emission at `placed_` of the beginning
    std::vector<float> first_volume_;           // of their unit cubes at that time, m³
    Neighbourhood neighbourhood_;

    ReflectanceTables reflectance_;
    std::unique_ptr<SpecularRays> specular_rays_;
    std::unique_ptr<FacetTracer> tracer_;
    std::vector<glm::vec2> openings_;  // of materials: glass, and the alpha below which are holes
    bool openings_changed_ = false;
    bool always_traces_ = false;
    bool traces_bundles_ = false;
    Buffer world_positions_;
    FacetRaster facets_;
    FacetBoxes facet_boxes_;
    PatchMembers members_;
    Buffer vertices_, triangles_, patches_, patch_triangle_, back_side_;
    Buffer surfaces_, objects_, materials_, texels_, vertex_data_, vertex_triangles_;
    std::vector<glm::uvec4> texture_info_;  // of the scene's textures, see MaterialData
    Buffer reflectors_;                     // only where some patch is glossy
    Buffer details_;                        // only where some material has any
    Texture2D details_texture_;
    Buffer transmittance_;  // only where a material transmits
    Texture2D patch_texture_, triangle_texture_, world_texture_, vertex_texture_, material_texture_;
    Texture2D reflector_texture_;
    std::vector<std::string> defines_;
    ShaderProgram place_vertices_, place_patches_;
};

}  // namespace raybundle
