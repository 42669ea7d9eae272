// SPDX-License-Identifier: Apache-2.0
#include "view/viewer_image.h"

#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "view/filters/sub_samples.h"
#include "view/specular/continued_view.h"

namespace raybundle {

namespace {

constexpr float crease_share = 1.25e-3F;    // of the diameter: a pixel of an 800-pixel window
constexpr float moving_kept_weight = 0.9F;  // of a reprojected value per camera change

}  // namespace

ViewerImage::ViewerImage(const GpuScene& scene, const RadianceStore& store,
                         const ViewPrograms& programs, glm::uvec2 size)
    : scene_(scene),
      store_(store),
      programs_(programs),
      full_size_(glm::max(size, glm::uvec2(1))),
      size_(full_size_),
      view_("view parameters", sizeof(layout::ViewParameters)),
      vertex_irradiance_("vertex irradiance",
                         2 * std::size_t{scene.vertex_count()} * sizeof(glm::uvec2)),
      statistics_buffer_("view statistics", 5 * statistics_groups * sizeof(glm::vec4)) {
    statistics_buffer_.clear();
    statistics_readback_.emplace("view statistics readback", statistics_buffer_.bytes());
    vertex_irradiance_texture_ =
        create_buffer_texture("vertex irradiance", GL_RGBA16F, vertex_irradiance_);
    if (programs.continued) {
        continued_ = std::make_unique<ContinuedView>(scene, store, *programs.continued);
    }
    allocate();
}

ViewerImage::~ViewerImage() = default;

ViewerImage* ViewerImage::continued() const {
    return continued_ ? continued_->image() : nullptr;
}

void ViewerImage::allocate() {
    const std::size_t pixels = pixel_count(size_);
    const auto width = static_cast<int>(size_.x);
    const auto height = static_cast<int>(size_.y);
    const std::size_t probes = pixel_count((size_ + 3U) / 4U);
    pixels_ = Buffer("pixels", pixels * sizeof(layout::PixelSurface));
    old_pixels_ = Buffer("old pixels", pixels * sizeof(layout::PixelSurface));
    irradiance_ = Buffer("pixel irradiance", pixels * sizeof(glm::vec4));
    old_irradiance_ = Buffer("old pixel irradiance", pixels * sizeof(glm::vec4));
    delta_ = Buffer("pixel increments", pixels * sizeof(glm::vec4));
    kept_ = Buffer("kept pixel irradiance", pixels * sizeof(glm::vec4));
    kept_.clear();
    kept_texture_ = create_buffer_texture("kept pixel irradiance", GL_RGBA32F, kept_);
    keeping_ = false;
    scatter_ = Buffer("pixel scatter", probes * SCATTER_SUMS * sizeof(float));
    frame_ = Buffer("frame", pixels * sizeof(std::uint32_t));
    surface_ids_ = create_texture_2d("view surface ids", GL_R32UI, width, height);
    const bool traced = scene_.traces(SeenAs::picture, pixels);
    depths_ =
        create_texture_2d("view depths", traced ? GL_R32F : GL_DEPTH_COMPONENT32F, width, height);
    traced_.reset();  // another size may be cheaper the other way
    if (traced) {
        traced_.emplace(width, height, true);
    } else {
        framebuffer_ = create_framebuffer("view", surface_ids_.get(), depths_.get());
    }
    frame_readback_.emplace("frame readback", frame_.bytes());
    delta_.clear();
    scatter_.clear();
    create_pixel_textures();
    edges_.emplace(size_);
    renew_confidence();
    affected_.emplace(size_);
    crowded_.emplace(pixels);
    if (scene_.reflectance().specular()) {
        specular_.emplace(pixels);
    }
    if (scene_.reflectance().any_glossy()) {
        allocate_gloss();
    }
    if (store_.first_shot() != nullptr) {
        allocate_first_shot();
    }
    has_picture_ = false;
}

void ViewerImage::allocate_gloss() {
    const std::size_t bytes = pixel_count(size_) * sizeof(glm::vec4);
    const std::size_t values = scene_.reflectance().draws_lobes() ? 2 : 1;
    gloss_ = Buffer("pixel gloss", values * bytes);
    old_gloss_ = Buffer("old pixel gloss", values * bytes);
    gloss_delta_ = Buffer("pixel gloss increments", bytes);
    gloss_delta_.clear();
    if (scene_.reflectance().draws_lobes()) {
        gloss_rays_.emplace(pixel_count(size_));
    }
    gloss_texture_ = create_buffer_texture("pixel gloss", GL_RGBA32F, gloss_);
    old_gloss_texture_ = create_buffer_texture("old pixel gloss", GL_RGBA32F, old_gloss_);
}

void ViewerImage::allocate_first_shot() {
    const std::size_t values = scene_.reflectance().any_glossy() ? 2 : 1;
    first_shot_ = Buffer("pixel first shot", values * pixel_count(size_) * sizeof(glm::vec4));
    first_shot_texture_ = create_buffer_texture("pixel first shot", GL_RGBA32F, first_shot_);
    lamps_.reset();
    if (store_.first_shot()->many() == nullptr) {
        shot_rest_ = Buffer("pixel first shot rest", first_shot_.bytes());
    } else {
        lamps_.emplace(pixel_count(size_), values == 2);
    }
}

void ViewerImage::create_pixel_textures() {
    pixel_texture_ = create_buffer_texture("pixels", GL_RGBA32UI, pixels_);
    old_pixel_texture_ = create_buffer_texture("old pixels", GL_RGBA32UI, old_pixels_);
    irradiance_texture_ = create_buffer_texture("pixel irradiance", GL_RGBA32F, irradiance_);
    old_irradiance_texture_ =
        create_buffer_texture("old pixel irradiance", GL_RGBA32F, old_irradiance_);
}

void ViewerImage::set_view(const Camera& camera, glm::uvec2 size) {
    if (glm::max(size, glm::uvec2(1)) == full_size_) {
        set_camera(camera, full_size_);
    } else {
        restart(camera, size);
    }
}

void ViewerImage::restart(const Camera& camera, glm::uvec2 size) {
    size = glm::max(size, glm::uvec2(1));
    grid_ = 1;
    if (size != full_size_) {
        full_size_ = size;
        size_ = size;
        allocate();
    }
    set_size(size);
    camera_ = camera;
    statistics_ = {};
    light_before_ = 0.0;
    confidence_->forget();
    refresh_geometry(0.0F);
}

void ViewerImage::set_camera(const Camera& camera, glm::uvec2 size) {
    camera_ = camera;
    set_size(glm::clamp(size, glm::uvec2(1), full_size_));
    refresh_geometry(moving_kept_weight);
}

void ViewerImage::refine(unsigned factor) {
    join_kept();
    // What there is becomes the old picture of the finer one, and is replaced when that is made.
    const glm::uvec2 coarse_size = size_;
    const glm::vec4 weights = parameters_.weights;
    const std::uint64_t scatter_samples = scatter_samples_;
    const Buffer scatter = std::move(scatter_);
    Buffer pixels = std::move(pixels_);
    Buffer irradiance = std::move(irradiance_);
    Buffer gloss = std::move(gloss_);
    Texture2D pixel_texture = std::move(pixel_texture_);
    Texture2D irradiance_texture = std::move(irradiance_texture_);
    Texture2D gloss_texture = std::move(gloss_texture_);
    const Confidence confidence = std::move(*confidence_);
    confidence_.reset();
    grid_ *= factor;
    full_size_ *= factor;
    size_ = full_size_;
    allocate();
    std::swap(pixels_, pixels);
    std::swap(irradiance_, irradiance);
    std::swap(gloss_, gloss);
    std::swap(pixel_texture_, pixel_texture);
    std::swap(irradiance_texture_, irradiance_texture);
    std::swap(gloss_texture_, gloss_texture);
    has_picture_ = true;
    refresh_geometry(1.0F);
    refine_scatter(scatter, coarse_size);
    parameters_.weights.y = weights.y;
    parameters_.weights.z = weights.z;
    scatter_samples_ = scatter_samples;
    confidence_->inherit_tiles(confidence, factor);
    tell_confidence();
    old_pixels_ = std::move(pixels);
    old_irradiance_ = std::move(irradiance);
    old_gloss_ = std::move(gloss);
    old_pixel_texture_ = std::move(pixel_texture);
    old_irradiance_texture_ = std::move(irradiance_texture);
    old_gloss_texture_ = std::move(gloss_texture);
}

void ViewerImage::set_size(glm::uvec2 size) {
    if (size != size_) {
        join_kept();
        size_ = size;
        affected_.emplace(size_);
    }
}

void ViewerImage::upload_view() {
    view_.write(std::span(&std::as_const(parameters_), 1), 0);
    view_.bind_uniform(BINDING_VIEW);
}

PixelRectangle ViewerImage::whole_picture() const {
    return {0, 0, static_cast<int>(size_.x), static_cast<int>(size_.y)};
}

bool ViewerImage::smooth_step() {
    if (!has_picture_ || size_ != full_size_ || edges_->complete()) {
        return false;
    }
    see_sub_sample();
    store_.bind();
    bind_pixels();
    glBindTextureUnit(UNIT_SURFACE_IDS, surface_ids_.get());
    edges_->count(programs_.edges);
    return !edges_->complete();
}

/// moved_objects: the picture still shows them at their old places.
void ViewerImage::refresh_geometry(float kept_weight, Shows shows) {
    join_kept();
    old_ = {parameters_.clip_from_world, glm::uvec2(parameters_.size), glm::vec3(parameters_.eye),
            parameters_.weights.x, glm::vec3(parameters_.constant)};
    const glm::vec4 display = parameters_.display;
    parameters_ = make_view_parameters(camera_, scene_.origin(), full_size_, near_distance());
    parameters_.size = picture_size(size_);
    parameters_.display = display;
    set_places(parameters_, staggered_places(grid_));
    tell_confidence();
    scene_.set_background(parameters_);
    if (continued_) {
        continued_->refresh(parameters_, camera_, kept_weight);
    }
    look_into_air();
    upload_view();
    if (ends_ == nullptr) {
        see_pixels(whole_picture());
    }
    std::swap(pixels_, old_pixels_);
    std::swap(irradiance_, old_irradiance_);
    std::swap(pixel_texture_, old_pixel_texture_);
    std::swap(irradiance_texture_, old_irradiance_texture_);
    std::swap(gloss_, old_gloss_);
    std::swap(gloss_texture_, old_gloss_texture_);
    store_.bind();
    bind_pixels();
    bind_old_picture();
    if (specular_) {
        specular_->begin();
    }
    resolve(!has_picture_ || kept_weight <= 0.0F ? programs_.resolve_new
            : shows == Shows::moved_objects      ? programs_.resolve_moved
                                                 : programs_.resolve_reprojected,
            whole_picture(), kept_weight);
    shoot_first(has_picture_ && ends_ == nullptr ? shows : Shows::another_view);
    restart_scatter();
    edges_->restart();
    samples_ = 0;
    look_into_lobes();
    crowded_->begin();
    has_picture_ = true;
}

/// The air before the pixels of another view.
void ViewerImage::look_into_air() {
    if (store_.air() == nullptr || ends_ != nullptr) {
        return;
    }
    if (!air_) {
        air_.emplace();
    }
    air_->begin(parameters_, glm::max(size_ / grid_, glm::uvec2(1)), grid_);
    see_air();
}

/// What shows a picture finds some air in it.
void ViewerImage::see_air() {
    if (air_ && air_->empty(*store_.air())) {
        air_->refine(*store_.air(), scene_.radiance_unit());
    }
}

void ViewerImage::bind_old_picture() const {
    glBindTextureUnit(UNIT_OLD_PIXELS, old_pixel_texture_.get());
    glBindTextureUnit(UNIT_OLD_PIXEL_IRRADIANCE, old_irradiance_texture_.get());
    glBindTextureUnit(UNIT_OLD_PIXEL_GLOSS, old_gloss_texture_.get());
    glBindTextureUnit(UNIT_SURFACE_IDS, surface_ids_.get());
}

/// Makes the pixels of a rectangle from the surfaces rasterised there.
void ViewerImage::resolve(const ViewPrograms::Resolve& programs, const PixelRectangle& rectangle,
                          float kept_weight) {
    const auto set_common = [&](const ShaderProgram& program) {
        program.set("refreshed",
                    glm::uvec4(rectangle.x0, rectangle.y0, rectangle.x1, rectangle.y1));
        program.set("common_weight", parameters_.weights.x);
        program.set("vertex_count", scene_.vertex_count());
        program.set("old_clip_from_world", old_.clip_from_world);
        program.set("old_eye", old_.eye);
        program.set("old_width", old_.size.x);
        program.set("old_height", old_.size.y);
        program.set("kept_weight", kept_weight);
        program.set("old_common_weight", old_.common_weight);
        program.set("old_constant", old_.constant);
        program.set("moved_objects", scene_.moved_objects());
        // Two pixels' width at unit distance, of the coarser picture.
        program.set("same_distance", 4.0F * std::tan(0.5F * camera_.vertical_fov) /
                                         static_cast<float>(std::min(size_.y, old_.size.y)));
    };
    set_common(programs.all);
    programs.all.set("crease_distance", crease_share * scene_.diameter());
    programs.all.dispatch(static_cast<std::size_t>(rectangle.width()),
                          static_cast<std::size_t>(rectangle.height()));
    if (specular_) {
        specular_->end();
        set_common(programs.specular);
        specular_->dispatch(programs.specular);
    }
}

void ViewerImage::bind_pixels() const {
    view_.bind_uniform(BINDING_VIEW);
    pixels_.bind_storage(BINDING_PIXELS);
    irradiance_.bind_storage(BINDING_PIXEL_IRRADIANCE);
    delta_.bind_storage(BINDING_PIXEL_DELTA);
    scatter_.bind_storage(BINDING_PIXEL_SCATTER);
    vertex_irradiance_.bind_storage(BINDING_VERTEX_IRRADIANCE);
    statistics_buffer_.bind_storage(BINDING_STATISTICS);
    frame_.bind_storage(BINDING_FRAME);
    glBindTextureUnit(UNIT_PIXELS, pixel_texture_.get());
    glBindTextureUnit(UNIT_PIXEL_IRRADIANCE, irradiance_texture_.get());
    glBindTextureUnit(UNIT_PIXEL_KEPT, kept_texture_.get());
    glBindTextureUnit(UNIT_VERTEX_IRRADIANCE, vertex_irradiance_texture_.get());
    confidence_->bind();
    if (specular_) {
        specular_->bind();
    }
    if (continued_) {
        continued_->bind();
    } else if (ends_ != nullptr) {
        ends_->bind_storage(BINDING_CONTINUED);
    }
    if (first_shot_.bytes() > 0) {
        first_shot_.bind_storage(BINDING_PIXEL_FIRST_SHOT);
        glBindTextureUnit(UNIT_PIXEL_FIRST_SHOT, first_shot_texture_.get());
    }
    if (air_) {
        air_->bind();
    }
    if (gloss_.bytes() > 0) {
        gloss_.bind_storage(BINDING_PIXEL_GLOSS);
        gloss_delta_.bind_storage(BINDING_PIXEL_GLOSS_DELTA);
        glBindTextureUnit(UNIT_PIXEL_GLOSS, gloss_texture_.get());
    }
}

void ViewerImage::refresh_continued(const Buffer& ends, const Camera& camera, float kept_weight) {
    ends_ = &ends;
    camera_ = camera;
    refresh_geometry(kept_weight);
    clear_increments();
}

}  // namespace raybundle
