// SPDX-License-Identifier: Apache-2.0
#include "view/filters/edge_filter.h"

#include <cstdint>

#include "view/filters/sub_samples.h"

namespace raybundle {

EdgePrograms::EdgePrograms(const GpuScene& scene, const std::vector<std::string>& defines)
    : count({"view_edge_count.comp"}, scene.defines()),
      list({"view_edge_tiles.comp"}),
      finish({"view_tile_commands.comp"}),
      average({"view_edge_average.comp"}, defines),
      average_linear({"view_edge_average.comp"}, with(defines, "LINEAR 1")),
      triangle_count(scene.triangle_count()) {}

EdgeFilter::EdgeFilter(glm::uvec2 size)
    : size_(size),
      counts_("edge counts", std::size_t{size.x} * size.y * 2 * sizeof(std::uint32_t)),
      smoothed_("smoothed frame", std::size_t{size.x} * size.y * sizeof(std::uint32_t)),
      tiles_("tiles with edges", size, 1) {}

glm::vec2 EdgeFilter::next_offset() const {
    return sub_sample(counted_);
}

void EdgeFilter::count(const EdgePrograms& programs) {
    if (counted_ == 0) {
        counts_.clear();
    }
    counts_.bind_storage(BINDING_EDGE_COUNTS);
    programs.count.set("offset", glm::vec3(next_offset(), 0.0F));
    programs.count.dispatch(size_.x, size_.y);
    ++counted_;
    if (complete()) {
        tiles_.begin();
        programs.list.dispatch(tiles_.tile_count());
        tiles_.end(programs.finish);
    }
}

void EdgeFilter::average(const ShaderProgram& program, const Buffer& frame,
                         const Buffer& result) const {
    counts_.bind_storage(BINDING_EDGE_COUNTS);
    frame.bind_storage(BINDING_FRAME);
    result.bind_storage(BINDING_SMOOTHED);
    glCopyNamedBufferSubData(frame.get(), result.get(), 0, 0,
                             static_cast<GLsizeiptr>(result.bytes()));
    tiles_.dispatch(program, 0);
}

const Buffer& EdgeFilter::average(const EdgePrograms& programs, const Buffer& frame,
                                  bool with_strangers) const {
    programs.average.set("triangle_count", programs.triangle_count);
    programs.average.set("with_strangers", with_strangers);
    average(programs.average, frame, smoothed_);
    return smoothed_;
}

Buffer EdgeFilter::average_linear(const EdgePrograms& programs, const Buffer& frame) const {
    Buffer result("smoothed linear frame", frame.bytes());
    programs.average_linear.set("triangle_count", programs.triangle_count);
    programs.average_linear.set("with_strangers", true);
    average(programs.average_linear, frame, result);
    return result;
}

}  // namespace raybundle
