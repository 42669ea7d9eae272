// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/pixel_accumulator.h"

#include <algorithm>
#include <cmath>

#include "view/camera_matrices.h"
#include "view/filters/sub_samples.h"
#include "view/pixels/visible_surfaces.h"

namespace raybundle {

namespace {

constexpr float crease_share = 1.25e-3F;  // of the diameter: a pixel of an 800-pixel window

/// A picture whose camera may move on soon waits for so many samples until it does what takes a
/// while, and then a part at a time: frames shall not wait for it.
constexpr std::uint64_t resting_samples = 8;

}  // namespace

PixelAccumulator::Lists::Lists(glm::uvec2 size, bool is_specular)
    : crowded(pixel_count(size)), affected(size) {
    if (is_specular) {
        specular.emplace(pixel_count(size));
    }
}

PixelAccumulator::PixelAccumulator(const GpuScene& scene, const RadianceStore& store,
                                   const ViewPrograms& programs, glm::uvec2 size)
    : scene_(scene), store_(store), programs_(programs), vertex_irradiance_(scene.vertex_count()) {
    allocate(size);
}

void PixelAccumulator::allocate(glm::uvec2 size) {
    size_ = size;
    const ReflectanceTables& reflectance = scene_.reflectance();
    buffers_.emplace(size, reflectance);
    Confidence confidence(size);
    if (confidence_) {
        confidence.inherit(*confidence_);
    }
    confidence_.emplace(std::move(confidence));
    lists_.emplace(size, reflectance.specular());
    if (reflectance.draws_lobes()) {
        gloss_rays_.emplace(pixel_count(size));
    }
    if (const FirstShot* const first_shot = store_.first_shot(); first_shot != nullptr) {
        shot_.emplace(pixel_count(size), reflectance.any_glossy(), first_shot->many() != nullptr);
    }
    progress_.keeps_light = false;
    progress_.has_picture = false;
}

void PixelAccumulator::set_size(glm::uvec2 size) {
    if (size != size_) {
        join_kept();
        size_ = size;
        lists_->affected = AffectedTiles(size);
    }
}

SampleOrder PixelAccumulator::sample_order() const {
    return scene_.reflectance().any_glossy() ? SampleOrder::shuffled : SampleOrder::low_discrepancy;
}

void PixelAccumulator::bind() const {
    view_.bind();
    buffers_->bind();
    vertex_irradiance_.bind();
    sums_.bind();
    confidence_->bind();
    if (lists_->specular) {
        lists_->specular->bind();
    }
    if (ends_ != nullptr) {
        ends_->bind_storage(BINDING_CONTINUED);
    }
    if (shot_) {
        shot_->bind();
    }
}

void PixelAccumulator::bind_with_solution() const {
    store_.bind();
    bind();
}

void PixelAccumulator::look_from(const Camera& camera, glm::uvec2 whole, unsigned grid,
                                 float near) {
    join_kept();
    remember_picture(glm::uvec2(view_.values.size));
    const glm::vec4 display = view_.values.display;
    view_.vertical_fov = camera.vertical_fov;
    view_.values = make_view_parameters(camera, scene_.origin(), whole, near);
    view_.values.size = picture_size(size_);
    view_.values.display = display;
    set_places(view_.values, staggered_places(grid));
    tell_confidence();
    scene_.set_background(view_.values);
}

/// size: of the picture, pixels.
void PixelAccumulator::remember_picture(glm::uvec2 size) {
    const layout::ViewParameters& view = view_.values;
    old_ = {view.clip_from_world, size, glm::vec3(view.eye), view.weights.x,
            glm::vec3(view.constant)};
}

void PixelAccumulator::renew(const VisibleSurfaces& surfaces, float kept_weight, Shows shows) {
    renew_all(&surfaces, kept_weight, progress_.has_picture ? shows : Shows::another_view);
}

void PixelAccumulator::show_ends(const Buffer& ends, const Camera& camera, float near,
                                 float kept_weight) {
    ends_ = &ends;
    look_from(camera, size_, 1, near);
    upload_view();
    renew_all(nullptr, kept_weight, Shows::another_view);
    clear_increments();
}

/// surfaces: none of ends of view rays.
void PixelAccumulator::renew_all(const VisibleSurfaces* surfaces, float kept_weight, Shows shows) {
    buffers_->swap();
    bind_with_solution();
    buffers_->bind_before();
    if (surfaces != nullptr) {
        surfaces->bind();
    }
    if (lists_->specular) {
        lists_->specular->begin();
    }
    resolve(!progress_.has_picture || kept_weight <= 0.0F ? programs_.resolve_new
            : shows == Shows::moved_objects               ? programs_.resolve_moved
                                                          : programs_.resolve_reprojected,
            whole_picture(view()), kept_weight);
    shoot(shows);
    restart_scatter();
    progress_.samples = 0;
    look_into_lobes();
    lists_->crowded.begin();
    progress_.has_picture = true;
}

void PixelAccumulator::renew_moved(const VisibleSurfaces& surfaces,
                                   const PixelRectangle& rectangle) {
    remember_picture(size_);
    buffers_->copy_rows(rectangle, size_.x);
    bind_with_solution();
    buffers_->bind_before();
    surfaces.bind();
    resolve(programs_.resolve_moved, rectangle, 1.0F);
}

/// Makes the pixels of a rectangle from the surfaces seen there.
void PixelAccumulator::resolve(const ViewPrograms::Resolve& programs,
                               const PixelRectangle& rectangle, float kept_weight) {
    // Two pixels' width at unit distance, of the coarser picture.
    const float same_distance = 4.0F * std::tan(0.5F * view_.vertical_fov) /
                                static_cast<float>(std::min(size_.y, old_.size.y));
    const auto set_common = [&](const ShaderProgram& program) {
        program.set("refreshed",
                    glm::uvec4(rectangle.x0, rectangle.y0, rectangle.x1, rectangle.y1));
        program.set("common_weight", view().weights.x);
        program.set("vertex_count", scene_.vertex_count());
        program.set("old_clip_from_world", old_.clip_from_world);
        program.set("old_eye", old_.eye);
        program.set("old_width", old_.size.x);
        program.set("old_height", old_.size.y);
        program.set("kept_weight", kept_weight);
        program.set("old_common_weight", old_.common_weight);
        program.set("old_constant", old_.constant);
        program.set("moved_objects", scene_.moved_objects());
        program.set("same_distance", same_distance);
    };
    set_common(programs.all);
    programs.all.set("crease_distance", crease_share * scene_.diameter());
    programs.all.dispatch(static_cast<std::size_t>(rectangle.width()),
                          static_cast<std::size_t>(rectangle.height()));
    if (lists_->specular) {
        lists_->specular->end();
        set_common(programs.specular);
        lists_->specular->dispatch(programs.specular);
    }
}

PixelAccumulator::Coarse PixelAccumulator::begin_refining(unsigned factor) {
    join_kept();
    Coarse coarse{
        size_, view().weights,         progress_.scatter_samples, std::move(buffers_->scatter()),
        {},    std::move(*confidence_)};
    confidence_.reset();  // the tiles are taken over when the pixels are there
    PixelBuffers::Picture picture = buffers_->exchange({});
    allocate(factor * size_);
    // What there is becomes the old picture of the finer one.
    coarse.spare = buffers_->exchange(std::move(picture));
    progress_.has_picture = true;
    return coarse;
}

void PixelAccumulator::end_refining(Coarse coarse, unsigned factor) {
    refine_scatter(coarse.scatter, coarse.size);
    view_.values.weights.y = coarse.weights.y;
    view_.values.weights.z = coarse.weights.z;
    progress_.scatter_samples = coarse.scatter_samples;
    confidence_->inherit_tiles(coarse.confidence, factor);
    tell_confidence();
    buffers_->set_before(std::move(coarse.spare));
}

/// The sums of a coarser picture of the same view.
void PixelAccumulator::refine_scatter(const Buffer& coarse, glm::uvec2 coarse_size) {
    const glm::uvec2 coarse_probes = (coarse_size + 3U) / 4U;
    const glm::uvec2 probes = (size_ + 3U) / 4U;
    const ShaderProgram& program = programs_.scatter_refine;
    program.set("factor", size_.x / coarse_size.x);
    program.set("probes", static_cast<std::uint32_t>(pixel_count(probes)));
    program.set("probe_columns", probes.x);
    program.set("coarse_columns", coarse_probes.x);
    program.set("coarse_rows", coarse_probes.y);
    coarse.bind_storage(BINDING_FRAME);
    buffers_->scatter().bind_storage(BINDING_PIXEL_SCATTER);
    program.dispatch(pixel_count(probes));
}

/// What the pixels show is another thing from now on, or of other accuracy.
void PixelAccumulator::restart_scatter() {
    buffers_->scatter().clear();
    view_.values.weights.y = 0.0F;
    view_.values.weights.z = 0.0F;
    progress_.scatter_samples = 0;
    sums_.restart();
    confidence_->restart();
    tell_confidence();
}

void PixelAccumulator::restart_samples() {
    restart_scatter();
    progress_.samples = 0;
    lists_->crowded.restart();
}

void PixelAccumulator::tell_confidence() {
    // The ends behind mirrors have no neighbours.
    const bool tiles = ends_ == nullptr;
    view_.values.confidence = glm::vec4(tiles ? confidence_->tiles() : glm::vec3(0.0F),
                                        confidence_->has_looked() ? 1.0F : 0.0F);
    const SequenceGain gain = gain_of(sample_order());
    view_.values.gain = glm::vec4(2.0 * gain.exponent, gain.from_samples, 0.0, 0.0);
}

/// What patches send into the lobes of new pixels.
void PixelAccumulator::look_into_lobes() {
    if (gloss_rays_ && store_.sends_slopes()) {  // the solution, not what a change makes different
        bind_with_solution();
        gloss_rays_->begin(scene_, programs_.gloss_rays, *lists_->specular);
    }
}

/// What rays have seen so far is of before a change.
void PixelAccumulator::forget_lobes() const {
    if (gloss_rays_) {
        buffers_->clear_lobes(pixel_count(size_));
    }
}

void PixelAccumulator::shoot(Shows shows) {
    if (!shot_) {
        return;
    }
    shot_->shoot(programs_, *store_.first_shot(), view(), shows, scene_.moved_bounds());
    bind_with_solution();
}

/// Of many lamps some more at the pixels.
void PixelAccumulator::look_at_lamps() {
    constexpr std::size_t points = 4096;  // some 10 ms on a core
    constexpr std::size_t points_at_rest = 16 * points;
    PixelLamps* const lamps = shot_ ? shot_->lamps() : nullptr;
    if (lamps == nullptr || (!progress_.rests && progress_.samples < resting_samples)) {
        return;
    }
    bind_with_solution();
    lamps->advance(programs_, *store_.first_shot(), progress_.rests ? points_at_rest : points);
    bind_with_solution();
}

/// How the own light counts beside that of the patches is looked at while nothing is under way.
void PixelAccumulator::begin_sample() {
    look_at_lamps();
    if (!confidence_->due(progress_.scatter_samples)) {
        return;
    }
    bind_with_solution();
    vertex_irradiance_.interpolate(programs_.vertex_irradiance);
    upload_view();
    confidence_->look(programs_.confidence, size_, scene_.triangle_count(),
                      progress_.scatter_samples);
    tell_confidence();
}

void PixelAccumulator::set_place(const ShaderProgram& program, Place place) const {
    program.set("facet_base", scene_.facet_base(place));
    program.set("vertex_base", scene_.vertex_base(place));
    program.set("moved_objects", scene_.moved_objects());
}

void PixelAccumulator::receive(const ViewPrograms::Receive& programs, const Context& context,
                               bool layered) {
    bind();
    set_place(programs.all, context.place);
    if (buffers_->glossy()) {
        set_place(programs.glossy, context.place);
    }
    if (context.special) {
        receive_special(programs, context);
        return;
    }
    programs.all.dispatch(pixel_count(size_));
    if (gloss_rays_) {
        programs.glossy.set("ray_share", GlossRays::share());
        gloss_rays_->trace(scene_, programs_.gloss_rays, *lists_->specular, context, layered);
    }
    if (buffers_->glossy()) {
        lists_->specular->dispatch(programs.glossy);
    }
    count_sample(context, 1.0F);
}

/// sign: 1, or -1, which takes it back.
void PixelAccumulator::count_sample(const Context& context, int sign) {
    progress_.samples += static_cast<std::uint64_t>(sign);
    progress_.scatter_samples += static_cast<std::uint64_t>(sign);
    const float weight = static_cast<float>(sign) * context.sample_weight;
    glm::vec4& weights = view_.values.weights;
    weights.x += weight;
    weights.y += weight;
    weights.z += weight * context.sample_weight;
    view_.values.constant += glm::vec4(weight * context.constant_irradiance, 0.0F);
}

void PixelAccumulator::discard_sample(const Context& context) {
    count_sample(context, -1);
}

void PixelAccumulator::receive_hemicube(const Context& context) {
    const ViewPrograms::ReceiveHemicube& programs =
        context.special ? programs_.hemicube_pixels_special : programs_.hemicube_pixels;
    receive(context.glossy_shooter ? programs.from_glossy : programs.from_lambert, context);
}

void PixelAccumulator::receive_layers(const Context& context) {
    if (context.special) {
        receive(programs_.layers_pixels_special, context);
        return;
    }
    bind();
    mark_crowded(context.window_pixel);
    receive_crowded(programs_.layers_crowded.all, context);
    if (buffers_->glossy()) {
        receive_crowded(programs_.layers_crowded.glossy, context);
    }
    receive(programs_.layers_pixels, context, true);
}

void PixelAccumulator::receive_planes(const Context& context) {
    receive(programs_.planes_pixels, context);
}

void PixelAccumulator::receive_opening(const Context& context) {
    receive(programs_.opening_pixels, context);
}

/// Marks more of the pixels that have other surfaces near them.
void PixelAccumulator::mark_crowded(float window_pixel) {
    constexpr std::size_t parts = 16;
    constexpr std::size_t fewest = 4096;  // pixels
    if (!progress_.rests && progress_.samples < resting_samples) {
        return;
    }
    const std::size_t pixels = pixel_count(size_);
    lists_->crowded.mark(programs_.crowded, pixels,
                         progress_.rests ? pixels : std::max(pixels / parts, fewest), window_pixel,
                         static_cast<float>(TIE_SHARE) * scene_.diameter());
}

void PixelAccumulator::receive_crowded(const ShaderProgram& program, const Context& context) {
    set_place(program, context.place);
    if (gloss_rays_) {
        program.set("ray_share", GlossRays::share());
    }
    lists_->crowded.dispatch(program, context.window_pixel);
}

}  // namespace raybundle
