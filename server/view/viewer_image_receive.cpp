// SPDX-License-Identifier: Apache-2.0
// A viewer's pixels as receivers of bundles.
#include "view/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

void ViewerImage::receive(const ViewPrograms::Receive& programs, const Context& context) {
    bind_pixels();
    const auto set_common = [&](const ShaderProgram& program) {
        program.set("facet_base", scene_.facet_base(context.place));
        program.set("vertex_base", scene_.vertex_base(context.place));
        program.set("moved_objects", scene_.moved_objects());
    };
    set_common(programs.all);
    if (gloss_.bytes() > 0) {
        set_common(programs.glossy);
    }
    if (context.special) {
        receive_special(programs, context);
        return;
    }
    programs.all.dispatch(pixel_count(size_));
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

void ViewerImage::receive_hemicube(const Context& context) {
    const ViewPrograms::ReceiveHemicube& programs =
        context.special ? programs_.hemicube_pixels_special : programs_.hemicube_pixels;
    receive(context.glossy_shooter ? programs.from_glossy : programs.from_lambert, context);
    if (continued() != nullptr) {
        continued()->receive_hemicube(context);
    }
}

void ViewerImage::receive_layers(const Context& context) {
    receive(context.special ? programs_.layers_pixels_special : programs_.layers_pixels, context);
    if (continued() != nullptr) {
        continued()->receive_layers(context);
    }
}

void ViewerImage::receive_planes(const Context& context) {
    receive(programs_.planes_pixels, context);
    if (continued() != nullptr) {
        continued()->receive_planes(context);
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

}  // namespace raybundle
