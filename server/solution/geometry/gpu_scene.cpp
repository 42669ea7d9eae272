// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/gpu_scene.h"

#include "solution/geometry/creases.h"
#include "solution/geometry/thin_walls.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/packing.hpp>
#include <numeric>

#include "gpu/octahedral.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

/// Whether a triangle's vertex normals bend away from its plane.
bool is_smooth(const PatchMesh& mesh, std::size_t triangle) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 plane = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                       mesh.positions[t.z] - mesh.positions[t.x]);
    constexpr float flat_cosine = 0.9999F;
    for (int k = 0; k < 3; ++k) {
        if (glm::dot(mesh.normals[t[k]], plane) < flat_cosine * glm::length(plane)) {
            return true;
        }
    }
    return false;
}

Bounds transformed(const Bounds& box, const glm::mat4& matrix) {
    Bounds result;
    if (box.empty()) {
        return result;
    }
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? box.max.x : box.min.x,
                          (corner & 2) != 0 ? box.max.y : box.min.y,
                          (corner & 4) != 0 ? box.max.z : box.min.z);
        result.add(glm::vec3(matrix * glm::vec4(p, 1.0F)));
    }
    return result;
}

/// world_from_object of all objects, see GpuScene::origin().
std::vector<glm::mat4> shifted_matrices(const Scene& scene) {
    const glm::mat4 shift = glm::translate(glm::mat4(1.0F), -scene.bounds.centre());
    std::vector<glm::mat4> matrices;
    for (const Object& object : scene.objects) {
        matrices.push_back(shift * object.world_from_object());
    }
    return matrices;
}

/// Side of a square patch of mean size, m.
double patch_length(const Scene& scene, const PatchMesh& mesh) {
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::mat3 m(scene.objects[mesh.vertex_object[t.x]].world_from_object());
        area += 0.5 * static_cast<double>(
                          glm::length(glm::cross(m * (mesh.positions[t.y] - mesh.positions[t.x]),
                                                 m * (mesh.positions[t.z] - mesh.positions[t.x]))));
    }
    return std::sqrt(area /
                     static_cast<double>(std::max<std::size_t>(mesh.front_patch_count(), 1)));
}

}  // namespace

GpuScene::GpuScene(const Scene& scene, const PatchMesh& mesh, bool constant_radiance, bool caustics)
    : patch_count_(static_cast<std::uint32_t>(mesh.patch_count())),
      front_patch_count_(static_cast<std::uint32_t>(mesh.front_patch_count())),
      side_count_(static_cast<std::uint32_t>(mesh.side_count())),
      triangle_count_(static_cast<std::uint32_t>(mesh.triangle_count())),
      vertex_count_(static_cast<std::uint32_t>(mesh.positions.size())),
      object_count_(static_cast<std::uint32_t>(scene.objects.size())),
      origin_(scene.bounds.centre()),
      radiance_unit_(unit_for(largest_emission(scene, mesh))),
      medium_(scene.medium),
      air_box_{scene.bounds.min - origin_, scene.bounds.max - origin_},
      trace_caustics_(caustics),
      constant_radiance_(constant_radiance),
      has_sky_(raybundle::has_sky(scene)),
      sky_(sky_of(scene)),
      sky_before_(sky_),
      light_slots_(scene, patch_length(scene, mesh)),
      reflectance_(scene),
      world_positions_("world positions", 2 * mesh.positions.size() * sizeof(glm::vec4)),
      facets_(mesh, world_positions_),
      facet_boxes_(mesh.positions, mesh.facets.empty() ? mesh.triangles : mesh.facets,
                   mesh.vertex_object, shifted_matrices(scene)),
      members_(mesh),
      place_vertices_({"scene_place_vertices.comp"}),
      place_patches_({"scene_place_patches.comp"}, members_.defines()) {
    for (const Object& object : scene.objects) {
        object_bounds_.push_back(object.bounds);
    }
    placed_ = shifted_matrices(scene);
    find_pieces(scene, mesh);
    world_from_object_ = kept_places(scene);
    upload_geometry(scene, mesh);
    upload_materials(scene, mesh);
    upload_details(scene);
    upload_transmittance(scene, mesh);
    upload_reflectors(mesh);
    upload_vertex_data(mesh);
    create_textures();
    upload_environment();
    if (has_specular_surfaces(scene)) {
        specular_rays_ = std::make_unique<SpecularRays>(
            scene, mesh, std::span(world_from_object_).first(object_count_));
    }
    make_tracer(scene, mesh);
    choose_defines(scene, mesh);
    upload_matrices();
    place_geometry(Place::now);
    place_geometry(Place::before);
    measure();
}

void GpuScene::upload_geometry(const Scene&, const PatchMesh& mesh) {
    std::vector<glm::vec4> vertices;
    vertices.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        vertices.emplace_back(mesh.positions[i], std::bit_cast<float>(mesh.vertex_object[i]));
    }
    std::vector<glm::uvec4> triangles;
    triangles.reserve(mesh.triangles.size());
    const std::vector<std::uint32_t> creases = find_creases(mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        triangles.emplace_back(mesh.triangles[i], mesh.triangle_material[i] |
                                                      creases[i] << CREASE_SHIFT |
                                                      (is_smooth(mesh, i) ? TRIANGLE_SMOOTH : 0U));
    }
    vertices_ = Buffer::from<glm::vec4>("vertices", vertices);
    triangles_ = Buffer::from<glm::uvec4>("triangles", triangles);
    std::vector<std::uint32_t> patch_triangle;
    patch_triangle.reserve(patch_count_);
    for (std::uint32_t patch = 0; patch < patch_count_; ++patch) {
        patch_triangle.push_back(mesh.triangle_of(patch));
    }
    patch_triangle_ = Buffer::from<std::uint32_t>("patch triangles", patch_triangle);
    back_side_ = Buffer::from<std::uint32_t>("back sides", mesh.back_side);
    patches_ = Buffer("patches", 2 * std::size_t{patch_count_} * sizeof(layout::PatchGeometry));
    objects_ = Buffer("object matrices", world_from_object_.size() * sizeof(glm::mat4));
}

float GpuScene::largest_emission(const Scene& scene, const PatchMesh& mesh) {
    // No surface that an environment lights is brighter than four times its mean.
    const glm::vec3 sky =
        scene.sky_radiance +
        (scene.environment ? 2.0F * glm::vec3(scene.environment->mean()) : glm::vec3(0.0F));
    float largest = std::max({sky.r, sky.g, sky.b});
    // Of a white surface that faces a directional light, or is a quarter of the diameter from a
    // lamp.
    const float distance = 0.25F * glm::length(scene.bounds.extent());
    for (const PunctualLight& light : scene.punctual_lights) {
        const glm::vec3 i =
            light.intensity *
            (light.profile ? static_cast<float>(light.profile->flux()) / (4.0F * glm::pi<float>())
                           : 1.0F);
        const float square =
            light.kind == PunctualKind::directional ? 1.0F : std::max(distance * distance, 1e-12F);
        largest = std::max(largest, std::max({i.r, i.g, i.b}) / (glm::pi<float>() * square));
    }
    for (const glm::vec3& emission : mesh.emission) {
        largest = std::max({largest, emission.r, emission.g, emission.b});
    }
    return largest;
}

/// Power of two near the largest emitted radiance: fixed-point sums then never overflow or starve.
float GpuScene::unit_for(float largest) {
    return largest > 0.0F ? std::exp2(std::round(std::log2(largest))) : 1.0F;
}

void GpuScene::create_textures() {
    patch_texture_ = create_buffer_texture("patches", GL_RGBA32F, patches_);
    triangle_texture_ = create_buffer_texture("triangles", GL_RGBA32UI, triangles_);
    world_texture_ = create_buffer_texture("world positions", GL_RGBA32F, world_positions_);
    vertex_texture_ = create_buffer_texture("vertex data", GL_RGBA32UI, vertex_data_);
    material_texture_ = create_buffer_texture("materials", GL_RGBA32F, materials_);
}

void GpuScene::choose_defines(const Scene& scene, const PatchMesh& mesh) {
    const auto define_if = [this](bool active, const char* name) {
        if (active) {
            defines_.push_back(std::string(name) + " 1");
        }
    };
    bool smooth = false;
    for (std::size_t i = 0; i < mesh.triangle_count() && !smooth; ++i) {
        smooth = is_smooth(mesh, i);
    }
    defines_ = members_.defines();
    define_if(side_count_ > triangle_count_, "DOUBLE_SIDED");
    define_if(!scene.textures.empty(), "TEXTURED");
    define_if(smooth, "SMOOTH");
    define_if(!mesh.colours.empty(), "VERTEX_COLOURS");
    define_if(!mesh.coverage.empty(), "ALPHA_MASK");
    define_if(details_.bytes() > 0, "DETAILS");
    define_if(transmitting(), "TRANSMISSION");
    const auto any_material = [&scene](auto property) {
        return std::any_of(scene.materials.begin(), scene.materials.end(), property);
    };
    define_if(any_material([](const Material& m) { return m.normal_texture.texture >= 0; }),
              "NORMAL_MAPS");
    define_if(any_material([](const Material& m) { return m.unlit; }), "UNLIT");
    define_if(!punctual_lights().empty(), "FIRST_SHOT");
    define_if(many_lamps(), "MANY_LAMPS");
    has_profiles_ = light_slots_.any_slots() || any_profile(punctual_lights());
    define_if(has_profiles_, "IES");
    define_if(sky_.environment != nullptr, "ENVIRONMENT");
    thin_walls_ = has_thin_walls(scene, mesh);
    constant_radiance_ = constant_radiance_ && !reflectance_.any_glossy() && !medium_;
    define_if(constant_radiance_, "CONSTANT_RADIANCE");
    // A line that meets nothing lacks the constant.
    define_if(has_sky_ || constant_radiance_, "SKY");
    define_if(thin_walls_, "THIN_WALLS");
    define_if(has_slivers(scene, mesh), "FOLDS");
    define_if(reflectance_.specular(), "SPECULAR");
    define_if(reflectance_.any_glossy(), "GLOSSY");
    define_if(reflectance_.draws_lobes(), "GLOSS_RAYS");
    define_if(specular_rays_ != nullptr, "MIRRORS");
    coats_ = has_coats(scene);
    define_if(coats_, "COATS");
    glass_ = has_glass(scene);
    define_if(glass_, "GLASS");
    absorbing_glass_ = has_absorbing_glass(scene);
    define_if(absorbing_glass_, "GLASS_ABSORBS");
    const auto dark = [](const glm::vec3& emission) { return emission == glm::vec3(0.0F); };
    mirror_or_glass_ = has_mirror_or_glass(scene);
    mirrors_shine_ = trace_caustics_ && mirror_or_glass_ &&
                     (has_sky_ || !punctual_lights().empty() ||
                      !std::all_of(mesh.emission.begin(), mesh.emission.end(), dark));
    caustics_ = mirrors_shine_ || medium_.has_value();
    define_if(caustics_, "CAUSTICS");
    define_air();
    const std::vector<std::string>& lobes = reflectance_.defines();
    defines_.insert(defines_.end(), lobes.begin(), lobes.end());
}

void GpuScene::upload_matrices() {
    objects_.write<glm::mat4>(world_from_object_, 0);
}

void GpuScene::place_geometry(Place place) const {
    bind();
    place_vertices_.set("place", static_cast<unsigned>(place));
    place_vertices_.set("vertex_count", vertex_count_);
    place_vertices_.set("object_count", object_count_);
    place_vertices_.dispatch(vertex_count_);
    place_patches_.set("place", static_cast<unsigned>(place));
    place_patches_.set("vertex_count", vertex_count_);
    place_patches_.set("patch_count", patch_count_);
    place_patches_.set("front_count", front_patch_count_);
    members_.bind_for_placing();
    place_patches_.dispatch(patch_count_);
    facets_.place(static_cast<unsigned>(place));
}

void GpuScene::settle() {
    moved_ = glm::uvec4(NO_PATCH);
    rescaled_ = false;
    const auto half = world_from_object_.begin() + object_count_;
    std::copy(world_from_object_.begin(), half, half);
    upload_matrices();
    const auto copy_half = [](const Buffer& buffer, std::size_t bytes) {
        glCopyNamedBufferSubData(buffer.get(), buffer.get(), 0, static_cast<GLintptr>(bytes),
                                 static_cast<GLsizeiptr>(bytes));
    };
    copy_half(world_positions_, std::size_t{vertex_count_} * sizeof(glm::vec4));
    copy_half(patches_, std::size_t{patch_count_} * sizeof(layout::PatchGeometry));
    facets_.settle();
    settle_tracer();
    measure();
}

/// What lies far away makes every bundle coarse, but only as long as it is there.
void GpuScene::measure() {
    diameter_ = std::max(glm::length(bounds().extent()), 1e-6F);
}

void GpuScene::draw(Place place, const glm::mat4& clip_from_world, bool nearest_only,
                    const ShaderProgram& program, std::span<const std::uint32_t> hidden) const {
    const auto first = static_cast<std::size_t>(place) * object_count_;
    facets_.draw(static_cast<unsigned>(place),
                 std::span(world_from_object_).subspan(first, object_count_), clip_from_world,
                 nearest_only && thin_walls_, program, hidden);
}

void GpuScene::bind() const {
    vertices_.bind_storage(BINDING_VERTICES);
    world_positions_.bind_storage(BINDING_WORLD_POSITIONS);
    triangles_.bind_storage(BINDING_TRIANGLES);
    patches_.bind_storage(BINDING_PATCHES);
    patch_triangle_.bind_storage(BINDING_PATCH_TRIANGLE);
    back_side_.bind_storage(BINDING_BACK_SIDE);
    surfaces_.bind_storage(BINDING_SURFACES);
    objects_.bind_storage(BINDING_OBJECTS);
    materials_.bind_storage(BINDING_MATERIALS);
    texels_.bind_storage(BINDING_TEXELS);
    vertex_data_.bind_storage(BINDING_VERTEX_DATA);
    vertex_triangles_.bind_storage(BINDING_VERTEX_TRIANGLES);
    glBindTextureUnit(UNIT_PATCHES, patch_texture_.get());
    glBindTextureUnit(UNIT_TRIANGLES, triangle_texture_.get());
    glBindTextureUnit(UNIT_WORLD_POSITIONS, world_texture_.get());
    glBindTextureUnit(UNIT_VERTEX_DATA, vertex_texture_.get());
    glBindTextureUnit(UNIT_MATERIALS, material_texture_.get());
    members_.bind();
    facets_.bind();
    facet_boxes_.bind();
    reflectance_.bind();
    if (transmitting()) {
        transmittance_.bind_storage(BINDING_TRANSMITTANCE);
    }
    if (details_.bytes() > 0) {
        glBindTextureUnit(UNIT_MATERIAL_DETAILS, details_texture_.get());
    }
    if (sky_.environment) {
        glBindTextureUnit(UNIT_ENVIRONMENT, environment_texture_.get());
        const bool other = carried_sky_texture_.get() != 0;
        glBindTextureUnit(UNIT_CARRIED_SKY,
                          (other ? carried_sky_texture_ : environment_texture_).get());
    }
    if (reflectance_.any_glossy()) {
        glBindTextureUnit(UNIT_REFLECTORS, reflector_texture_.get());
    }
}

std::uint32_t GpuScene::patch_base(Place place) const {
    return place == Place::now ? 0 : patch_count_;
}
std::uint32_t GpuScene::facet_base(Place place) const {
    return place == Place::now ? 0 : facets_.count();
}
std::uint32_t GpuScene::vertex_base(Place place) const {
    return place == Place::now ? 0 : vertex_count_;
}

glm::mat4 GpuScene::world_from_object(std::uint32_t object, Place place) const {
    return world_from_object_[static_cast<unsigned>(place) * object_count_ + object];
}

glm::mat4 GpuScene::now_from_before(std::uint32_t object) const {
    const glm::mat3 now(world_from_object(object, Place::now));
    const glm::mat3 before(world_from_object(object, Place::before));
    constexpr float smallest = 1e-30F;
    if (std::abs(glm::determinant(now)) < smallest ||
        std::abs(glm::determinant(before)) < smallest) {
        return glm::mat4(1.0F);
    }
    // Gram-Schmidt on the images of the axes.
    const glm::mat3 m = now * glm::inverse(before);
    const glm::vec3 x = glm::normalize(m[0]);
    const glm::vec3 y = glm::normalize(m[1] - glm::dot(m[1], x) * x);
    const glm::vec3 z = glm::cross(x, y);
    return glm::mat4(glm::mat3(x, y, z));
}

Bounds GpuScene::bounds_at(std::uint32_t object, const glm::mat4& world) const {
    return transformed(object_bounds_[object], world);
}

Bounds GpuScene::object_bounds(std::uint32_t object, Place place) const {
    return bounds_at(object, world_from_object(object, place));
}

Bounds GpuScene::bounds() const {
    Bounds all;
    for (std::uint32_t object = 0; object < object_count_; ++object) {
        for (const Place place : {Place::now, Place::before}) {
            const Bounds box = object_bounds(object, place);
            if (!box.empty()) {
                all.add(box.min);
                all.add(box.max);
            }
        }
    }
    return all;
}

std::size_t GpuScene::bytes() const {
    std::size_t sum = members_.bytes() + details_.bytes() + transmittance_.bytes() +
                      facets_.bytes() + facet_boxes_.bytes() + reflectance_.bytes() +
                      reflectors_.bytes() + environment_bytes_ + tracer_bytes();
    for (const Buffer* buffer :
         {&vertices_, &world_positions_, &triangles_, &patches_, &patch_triangle_, &back_side_,
          &surfaces_, &objects_, &materials_, &texels_, &vertex_data_, &vertex_triangles_}) {
        sum += buffer->bytes();
    }
    return sum;
}

}  // namespace raybundle
