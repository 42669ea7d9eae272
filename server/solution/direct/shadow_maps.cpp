// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"

namespace raybundle {

namespace {

constexpr int largest_map = 1024;
constexpr int smallest_map = 128;
constexpr std::size_t most_bytes = 96U << 20U;  // of all maps
constexpr float near_share = 1e-6F;             // of the scene's diameter
constexpr float widest_face = 1.8F;             // tangent; wider spots take a cube
constexpr float edge_width = 3.0F;              // texels, of lines and points that mark edges
constexpr float edge_reach = edge_width;        // beyond a surface, with rounding

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

/// Clip coordinates of the part of a map from those of the whole. Surfaces beside it whose edges
/// reach into it belong to it.
glm::mat4 part_of_map(const MapTexels& texels, int size) {
    const glm::vec2 low = glm::vec2(texels.first) - edge_reach;
    const glm::vec2 high = glm::vec2(texels.last) + 1.0F + edge_reach;
    const glm::vec2 scale = static_cast<float>(size) / (high - low);
    const glm::vec2 centre = (low + high) / static_cast<float>(size) - 1.0F;
    glm::mat4 part(1.0F);
    part[0][0] = scale.x;
    part[1][1] = scale.y;
    part[3] = glm::vec4(-centre * scale, 0.0F, 1.0F);
    return part;
}

glm::vec4 row(const glm::vec3& axis, const glm::vec3& origin) {
    return {axis, -glm::dot(axis, origin)};
}

}  // namespace

ShadowMaps::ShadowMaps(const GpuScene& scene)
    : scene_(scene),
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

std::vector<layout::PunctualData> ShadowMaps::placed(const IesProfiles& profiles) const {
    std::vector<layout::PunctualData> lights = placed_lights(scene_, profiles);
    unsigned layer = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const unsigned layers = layers_of(scene_.punctual_lights()[i]);
        lights[i].map.x = layer;
        lights[i].map.y = layers;
        lights[i].map.w = static_cast<unsigned>(size_);
        layer += layers;
    }
    return lights;
}

MapTexels ShadowMaps::showing(const layout::PunctualData& light, unsigned face,
                              const Bounds& box) const {
    if (box.empty()) {
        return {};
    }
    const glm::mat4 clip = clip_from_world(light, face);
    const MapTexels whole = MapTexels::whole(size_);
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high = -low;
    constexpr unsigned corners = 8;
    unsigned behind = 0;
    for (unsigned corner = 0; corner < corners; ++corner) {
        const glm::bvec3 high_side(corner & 1U, corner & 2U, corner & 4U);
        const glm::vec4 at = clip * glm::vec4(glm::mix(box.min, box.max, high_side), 1.0F);
        if (at.w <= 0.0F) {
            ++behind;
            continue;
        }
        const glm::vec2 texel = (glm::vec2(at) / at.w * 0.5F + 0.5F) * static_cast<float>(size_);
        low = glm::min(low, texel);
        high = glm::max(high, texel);
    }
    if (behind == corners) {
        return {};
    }
    if (behind > 0) {
        return whole;  // the box lies beside the light
    }
    const auto last = static_cast<float>(size_ - 1);
    if (glm::any(glm::lessThan(high, glm::vec2(-edge_reach))) ||
        glm::any(glm::greaterThan(low, glm::vec2(last + 1.0F + edge_reach)))) {
        return {};
    }
    return {glm::ivec2(glm::floor(glm::clamp(low - edge_reach, 0.0F, last))),
            glm::ivec2(glm::floor(glm::clamp(high + edge_reach, 0.0F, last)))};
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
void ShadowMaps::mark_edges(const Part& part) {
    glBindFramebuffer(GL_FRAMEBUFFER, edge_framebuffer_.get());
    glNamedFramebufferTextureLayer(edge_framebuffer_.get(), GL_COLOR_ATTACHMENT0, edges_.get(), 0,
                                   static_cast<GLint>(part.layer));
    const GLuint unmarked[4] = {0, 0, 0, 0};
    glClearBufferuiv(GL_COLOR, 0, unmarked);
    glDisable(GL_DEPTH_TEST);
    glLineWidth(edge_width);
    glPointSize(edge_width);
    edge_raster_.use();
    edge_raster_.set("clip_from_world", part.clip_from_world);
    for (const GLenum mode : {GL_LINE, GL_POINT}) {
        glPolygonMode(GL_FRONT_AND_BACK, mode);
        scene_.draw(Place::now, part.seen, false, edge_raster_);
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (cut_out_raster_) {
        cut_out_raster_->use();
        cut_out_raster_->set("clip_from_world", part.clip_from_world);
        scene_.draw(Place::now, part.seen, false, *cut_out_raster_);
    }
}

void ShadowMaps::draw_part(const Part& part) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glEnable(GL_DEPTH_TEST);
    raster_.use();
    glNamedFramebufferTextureLayer(framebuffer_.get(), GL_COLOR_ATTACHMENT0, maps_.get(), 0,
                                   static_cast<GLint>(part.layer));
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float far_depth = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, no_hit);
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    raster_.set("clip_from_world", part.clip_from_world);
    scene_.draw(Place::now, part.seen, true, raster_);
}

void ShadowMaps::draw(std::span<const layout::PunctualData> lights) {
    const GlScope scope("shadow maps");
    glViewport(0, 0, size_, size_);
    glEnable(GL_SCISSOR_TEST);
    glDepthFunc(GL_GREATER);
    for (const layout::PunctualData& light : lights) {
        for (unsigned face = 0; face < light.map.y; ++face) {
            const MapTexels texels = touched(light, face);
            if (texels.empty()) {
                continue;
            }
            glScissor(texels.first.x, texels.first.y, texels.last.x - texels.first.x + 1,
                      texels.last.y - texels.first.y + 1);
            const glm::mat4 clip = clip_from_world(light, face);
            const Part part{light.map.x + face, clip, part_of_map(texels, size_) * clip};
            draw_part(part);
            mark_edges(part);
        }
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
}

std::size_t ShadowMaps::bytes() const {
    const auto texels = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
    return texels * ((sizeof(std::uint32_t) + 1) * std::size_t{layers_} + sizeof(float));
}

}  // namespace raybundle
