// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"

namespace raybundle {

namespace {

constexpr int largest_map = 1024;
constexpr int smallest_map = 128;
constexpr std::size_t most_bytes = 96U << 20U;  // of all maps
constexpr float near_share = 1e-6F;             // of the scene's diameter
constexpr float widest_face = 1.8F;             // tangent; wider spots take a cube

unsigned layers_of(const PunctualLight& light) {
    if (light.kind == PunctualKind::directional) {
        return 1;
    }
    const bool narrow = light.kind == PunctualKind::spot &&
                        std::sqrt(1.0F - light.outer_cosine * light.outer_cosine) <
                            widest_face * light.outer_cosine;
    return narrow ? 1 : 6;
}

int map_size(unsigned layers) {
    int size = largest_map;
    while (size > smallest_map && std::size_t{layers} * static_cast<std::size_t>(size) *
                                          static_cast<std::size_t>(size) * sizeof(std::uint32_t) >
                                      most_bytes) {
        size /= 2;
    }
    return size;
}

Texture2D create_layers(GLenum format, int size, unsigned layers) {
    check_texture_layers("the shadow maps of the punctual lights", layers);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    Texture2D texture(name);
    glTextureStorage3D(name, 1, format, size, size, static_cast<GLsizei>(layers));
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, name, -1, "shadow maps");
    check_gl_errors("making the shadow maps of the punctual lights or before");
    return texture;
}

/// Axes of a face of a cube map; the same table as cube_face() in shaders/solution/first_shot.glsl.
struct FaceAxes {
    glm::vec3 right{0.0F}, up{0.0F}, forward{0.0F};
};

FaceAxes face_axes(unsigned face) {
    const int axis = static_cast<int>(face / 2);
    const float sign = (face & 1U) != 0 ? -1.0F : 1.0F;
    FaceAxes axes;
    axes.forward[axis] = sign;
    axes.right[(axis + 1) % 3] = -sign;
    axes.up[(axis + 2) % 3] = 1.0F;
    return axes;
}

glm::vec4 row(const glm::vec3& axis, const glm::vec3& origin) {
    return {axis, -glm::dot(axis, origin)};
}

}  // namespace

ShadowMaps::ShadowMaps(const GpuScene& scene)
    : scene_(scene),
      profiles_(profiles_of(scene.punctual_lights())),
      raster_({"bundle_raster.vert", "bundle_nearest.frag"},
              with(scene.defines(), "CLEAR_GLASS 1")),
      edge_raster_({"bundle_raster.vert", "shadow_edges.frag"}) {
    for (const PunctualLight& light : scene.punctual_lights()) {
        layers_ += layers_of(light);
    }
    size_ = map_size(layers_);
    maps_ = create_layers(GL_R32UI, size_, layers_);
    edges_ = create_layers(GL_R8UI, size_, layers_);
    depths_ = create_texture_2d("shadow depths", GL_DEPTH_COMPONENT32F, size_, size_);
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer_ = Framebuffer(name);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depths_.get(), 0);
    glObjectLabel(GL_FRAMEBUFFER, name, -1, "shadow maps");
    glCreateFramebuffers(1, &name);
    edge_framebuffer_ = Framebuffer(name);
    glObjectLabel(GL_FRAMEBUFFER, name, -1, "shadow edges");
    const auto& defines = scene.defines();
    if (std::find(defines.begin(), defines.end(), "ALPHA_MASK 1") != defines.end()) {
        cut_out_raster_.emplace(std::vector<std::string>{"bundle_raster.vert", "shadow_edges.frag"},
                                std::vector<std::string>{"CUT_OUT 1"});
    }
}

void ShadowMaps::bind() const {
    glBindTextureUnit(UNIT_SHADOW_MAPS, maps_.get());
    glBindTextureUnit(UNIT_SHADOW_EDGES, edges_.get());
}

void ShadowMaps::place_lights() {
    lights_ = placed_lights(scene_, profiles_);
    unsigned layer = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const unsigned layers = layers_of(scene_.punctual_lights()[i]);
        lights_[i].map.x = layer;
        lights_[i].map.y = layers;
        lights_[i].map.w = static_cast<unsigned>(size_);
        layer += layers;
    }
}

/// Reversed depth: 1 at the near plane, 0 infinitely far away (directional: behind the scene).
glm::mat4 ShadowMaps::clip_from_world(const layout::PunctualData& light, unsigned face) const {
    const glm::vec3 origin(light.position);
    const glm::vec3 z(light.axis_z);
    const float width = light.position.w;
    if (light.map.z == PUNCTUAL_DIRECTIONAL) {
        const glm::vec4 depth = 0.5F * row(z, origin) / width + glm::vec4(0, 0, 0, 0.5F);
        return glm::transpose(glm::mat4(row(glm::vec3(light.axis_x), origin) / width,
                                        row(glm::vec3(light.axis_y), origin) / width, depth,
                                        glm::vec4(0, 0, 0, 1)));
    }
    const glm::vec4 near(0, 0, 0, near_share * scene_.diameter());
    if (light.map.y == 6) {
        const FaceAxes axes = face_axes(face);
        return glm::transpose(glm::mat4(row(axes.right, origin), row(axes.up, origin), near,
                                        row(axes.forward, origin)));
    }
    return glm::transpose(glm::mat4(row(glm::vec3(light.axis_x), origin) / width,
                                    row(glm::vec3(light.axis_y), origin) / width, near,
                                    row(-z, origin)));
}

/// Lines and points of three texels reach at least one of the four texel centres round any point
/// beside an edge, however short it is.
void ShadowMaps::mark_edges(unsigned layer, const glm::mat4& clip) {
    constexpr float width = 3.0F;  // texels
    glBindFramebuffer(GL_FRAMEBUFFER, edge_framebuffer_.get());
    glNamedFramebufferTextureLayer(edge_framebuffer_.get(), GL_COLOR_ATTACHMENT0, edges_.get(), 0,
                                   static_cast<GLint>(layer));
    const GLuint unmarked[4] = {0, 0, 0, 0};
    glClearBufferuiv(GL_COLOR, 0, unmarked);
    glDisable(GL_DEPTH_TEST);
    glLineWidth(width);
    glPointSize(width);
    edge_raster_.use();
    edge_raster_.set("clip_from_world", clip);
    for (const GLenum mode : {GL_LINE, GL_POINT}) {
        glPolygonMode(GL_FRONT_AND_BACK, mode);
        scene_.draw(Place::now, clip, false, edge_raster_);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (cut_out_raster_) {
        cut_out_raster_->use();
        cut_out_raster_->set("clip_from_world", clip);
        scene_.draw(Place::now, clip, false, *cut_out_raster_);
    }
}

void ShadowMaps::draw_layer(unsigned layer, const glm::mat4& clip) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glEnable(GL_DEPTH_TEST);
    raster_.use();
    glNamedFramebufferTextureLayer(framebuffer_.get(), GL_COLOR_ATTACHMENT0, maps_.get(), 0,
                                   static_cast<GLint>(layer));
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float far_depth = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, no_hit);
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    raster_.set("clip_from_world", clip);
    scene_.draw(Place::now, clip, true, raster_);
}

std::span<const layout::PunctualData> ShadowMaps::draw() {
    const GlScope scope("shadow maps");
    place_lights();
    glViewport(0, 0, size_, size_);
    glDepthFunc(GL_GREATER);
    for (const layout::PunctualData& light : lights_) {
        for (unsigned face = 0; face < light.map.y; ++face) {
            const glm::mat4 clip = clip_from_world(light, face);
            draw_layer(light.map.x + face, clip);
            mark_edges(light.map.x + face, clip);
        }
    }
    glDisable(GL_DEPTH_TEST);
    return lights_;
}

std::size_t ShadowMaps::bytes() const {
    const auto texels = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
    return texels * ((sizeof(std::uint32_t) + 1) * std::size_t{layers_} + sizeof(float));
}

}  // namespace raybundle
