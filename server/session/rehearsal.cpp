// SPDX-License-Identifier: Apache-2.0
#include "session/rehearsal.h"

#include <algorithm>

namespace raybundle {

namespace {

/// llvmpipe compiles a shader again for textures whose sizes are powers of two, and for buffer
/// textures whose size in bytes is a multiple of 65 536 (Mesa 22.3 takes a part of it for a number
/// of levels): 800x800 is drawn as 24x24 is, 640x480 as 192x192, 512x512 as 64x64. The first time
/// not everything is there that is looked up later.
constexpr glm::uvec2 rehearsal_sizes[] = {{24, 24}, {24, 24}, {192, 192}, {64, 64}};

void rehearse_picture(LiveScene& live, glm::uvec2 size, const std::atomic<bool>& stop) {
    const Scene& scene = live.scene();
    Solver& solver = live.solver();
    const auto image = live.make_picture(size);
    image->set_camera(scene.cameras.front());
    image->rest();
    BundleReceiver* const receivers[] = {image.get()};
    do {
        solver.step(receivers);
    } while (!solver.between_groups() && !stop);
    if (stop) {
        return;
    }
    image->set_camera(scene.cameras.front());
    image->request_statistics();
    image->smooth();
    image->compose(DisplayMode::photo, 0.0F);
    image->take();
    const auto movable = std::find_if(scene.objects.begin(), scene.objects.end(),
                                      [](const Object& object) { return object.movable; });
    if (movable != scene.objects.end()) {
        solver.rehearse_move(static_cast<std::uint32_t>(movable - scene.objects.begin()),
                             movable->world_from_object(), receivers);
    }
}

}  // namespace

void rehearse_pictures(LiveScene& live, const std::atomic<bool>& stop) {
    for (const glm::uvec2& size : rehearsal_sizes) {
        if (!stop) {
            rehearse_picture(live, size, stop);
        }
    }
}

}  // namespace raybundle
