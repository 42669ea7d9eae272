// SPDX-License-Identifier: Apache-2.0
// A viewer's pixels as receivers of bundles.
#include <algorithm>
#include <utility>

#include "view/specular/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Marks more of the pixels that have other surfaces near them. Where the camera may move on soon
/// it waits until it rests, and does a part at a time: frames shall not wait for it.
void ViewerImage::mark_crowded(float window_pixel) {
    constexpr std::uint64_t resting_samples = 8;
    constexpr std::size_t parts = 16;
    constexpr std::size_t fewest = 4096;  // pixels
    if (!rests_ && samples_ < resting_samples) {
        return;
    }
    const std::size_t pixels = pixel_count(size_);
    crowded_->mark(programs_.crowded, pixels, rests_ ? pixels : std::max(pixels / parts, fewest),
                   window_pixel, static_cast<float>(TIE_SHARE) * scene_.diameter());
}

void ViewerImage::set_place(const ShaderProgram& program, Place place) const {
    program.set("facet_base", scene_.facet_base(place));
    program.set("vertex_base", scene_.vertex_base(place));
    program.set("moved_objects", scene_.moved_objects());
}

void ViewerImage::receive(const ViewPrograms::Receive& programs, const Context& context,
                          bool layered) {
    bind_pixels();
    set_place(programs.all, context.place);
    if (gloss_.bytes() > 0) {
        set_place(programs.glossy, context.place);
    }
    if (context.special) {
        receive_special(programs, context);
        return;
    }
    programs.all.dispatch(pixel_count(size_));
    if (gloss_rays_) {
        programs.glossy.set("ray_share", GlossRays::share());
        gloss_rays_->trace(scene_, programs_.gloss_rays, *specular_, context, layered);
    }
    if (gloss_.bytes() > 0) {
        specular_->dispatch(programs.glossy);
    }
    ++samples_;
    ++scatter_samples_;
    parameters_.weights.x += context.sample_weight;
    parameters_.weights.y += context.sample_weight;
    parameters_.weights.z += context.sample_weight * context.sample_weight;
    parameters_.constant += glm::vec4(context.sample_weight * context.constant_irradiance, 0.0F);
}

/// How the own light counts beside that of the patches is looked at while nothing is under way.
void ViewerImage::begin_sample() {
    if (continued() != nullptr) {
        continued()->begin_sample();
    }
    look_at_lamps();
    if (air_ && air_samples_++ % GROUP_SIZE == 0) {
        air_->refine(*store_.air(), scene_.radiance_unit());
    }
    if (!confidence_->due(scatter_samples_)) {
        return;
    }
    store_.bind();
    bind_pixels();
    programs_.vertex_irradiance.set("vertex_count", scene_.vertex_count());
    programs_.vertex_irradiance.dispatch(scene_.vertex_count());
    upload_view();
    confidence_->look(programs_.confidence, size_, scene_.triangle_count(), scatter_samples_);
    tell_confidence();
}

/// Of a picture of another size what is known of all of it goes on.
void ViewerImage::renew_confidence() {
    Confidence confidence(size_);
    if (confidence_) {
        confidence.inherit(*confidence_);
    }
    confidence_.emplace(std::move(confidence));
}

void ViewerImage::tell_confidence() {
    // The ends behind mirrors have no neighbours.
    const bool tiles = ends_ == nullptr;
    parameters_.confidence = glm::vec4(tiles ? confidence_->tiles() : glm::vec3(0.0F),
                                       confidence_->has_looked() ? 1.0F : 0.0F);
    const SequenceGain gain = gain_of(sample_order());
    parameters_.gain = glm::vec4(2.0 * gain.exponent, gain.from_samples, 0.0, 0.0);
}

void ViewerImage::receive_hemicube(const Context& context) {
    const ViewPrograms::ReceiveHemicube& programs =
        context.special ? programs_.hemicube_pixels_special : programs_.hemicube_pixels;
    receive(context.glossy_shooter ? programs.from_glossy : programs.from_lambert, context);
    if (continued() != nullptr) {
        continued()->receive_hemicube(context);
    }
}

void ViewerImage::receive_layers(const Context& context) {
    if (context.special) {
        receive(programs_.layers_pixels_special, context);
    } else {
        bind_pixels();
        mark_crowded(context.window_pixel);
        receive_crowded(programs_.layers_crowded.all, context);
        if (gloss_.bytes() > 0) {
            receive_crowded(programs_.layers_crowded.glossy, context);
        }
        receive(programs_.layers_pixels, context, true);
    }
    if (continued() != nullptr) {
        if (rests_) {
            continued()->rest();
        }
        continued()->receive_layers(context);
    }
}

void ViewerImage::receive_crowded(const ShaderProgram& program, const Context& context) {
    set_place(program, context.place);
    if (gloss_rays_) {
        program.set("ray_share", GlossRays::share());
    }
    crowded_->dispatch(program, context.window_pixel);
}

void ViewerImage::receive_planes(const Context& context) {
    receive(programs_.planes_pixels, context);
    if (continued() != nullptr) {
        continued()->receive_planes(context);
    }
}

void ViewerImage::receive_opening(const Context& context) {
    receive(programs_.opening_pixels, context);
    if (continued() != nullptr) {
        continued()->receive_opening(context);
    }
}

void ViewerImage::discard_sample(const Context& context) {
    if (continued() != nullptr) {
        continued()->discard_sample(context);
    }
    --samples_;
    --scatter_samples_;
    parameters_.weights.x -= context.sample_weight;
    parameters_.weights.y -= context.sample_weight;
    parameters_.weights.z -= context.sample_weight * context.sample_weight;
    parameters_.constant -= glm::vec4(context.sample_weight * context.constant_irradiance, 0.0F);
}

void ViewerImage::complete_start() {
    if (continued() != nullptr) {
        continued()->complete_start();
    }
    upload_view();
    bind_pixels();
    programs_.complete.dispatch(pixel_count(size_));
    forget_lobes();  // rays have seen nothing but lamps
}

/// What patches send into the lobes of new pixels.
void ViewerImage::look_into_lobes() {
    if (gloss_rays_ && store_.sends_slopes()) {  // the solution, not what a change makes different
        store_.bind();
        bind_pixels();
        gloss_rays_->begin(scene_, programs_.gloss_rays, *specular_);
    }
}

/// What rays have seen so far is of before a change.
void ViewerImage::forget_lobes() const {
    if (gloss_rays_) {
        const std::size_t half = pixel_count(size_) * sizeof(glm::vec4);
        glClearNamedBufferSubData(gloss_.get(), GL_R32F, static_cast<GLintptr>(half),
                                  static_cast<GLsizeiptr>(half), GL_RED, GL_FLOAT, nullptr);
    }
}

}  // namespace raybundle
