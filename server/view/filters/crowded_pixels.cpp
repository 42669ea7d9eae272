// SPDX-License-Identifier: Apache-2.0
#include "view/filters/crowded_pixels.h"

#include <algorithm>
#include <cstdint>

namespace raybundle {
namespace {

/// Nearer surfaces crowd a pixel, in pixels of the window: how far a line is from what it stands
/// for, with some room.
constexpr float radius_in_pixels = 1.0F;
/// Own rays are followed so far: beyond it the line's distance makes little difference.
constexpr float reach_in_pixels = 6.0F;

}  // namespace

CrowdedPixels::CrowdedPixels(std::size_t capacity)
    : list_("crowded pixels", (4 + capacity) * sizeof(std::uint32_t)) {
    begin();
}

void CrowdedPixels::begin() {
    list_.clear(4 * sizeof(std::uint32_t));
    any_ = false;
    restart();
}

void CrowdedPixels::mark(const ShaderProgram& program, std::size_t pixels, std::size_t most,
                         float window_pixel, float tie) {
    if (window_pixel != window_pixel_) {
        window_pixel_ = window_pixel;
        restart();
    }
    if (marked_ >= pixels) {
        return;
    }
    list_.bind_storage(BINDING_CROWDED);
    program.set("tie", tie);
    const auto run = [&](std::size_t first, std::size_t end, float radius) {
        program.set("first_pixel", static_cast<unsigned>(first));
        program.set("end_pixel", static_cast<unsigned>(end));
        program.set("radius", radius);
        program.dispatch(end - first);
    };
    if (marked_ == 0 && any_) {
        begin();
        run(0, pixels, 0.0F);  // takes all marks away
    }
    any_ = true;
    const std::size_t end = std::min(pixels, marked_ + most);
    run(marked_, end, radius_in_pixels * window_pixel);
    marked_ = end;
}

void CrowdedPixels::dispatch(const ShaderProgram& program, float window_pixel) const {
    if (!any_) {
        return;
    }
    list_.bind_storage(BINDING_CROWDED);
    program.set("own_ray_reach", reach_in_pixels * window_pixel);
    program.dispatch_indirect(list_);
}

}  // namespace raybundle
