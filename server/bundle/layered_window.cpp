// SPDX-License-Identifier: Apache-2.0
#include "bundle/layered_window.h"

#include "bundle/traced_picture.h"
#include "gpu/egl_context.h"
#include "gpu/gl_scope.h"

namespace raybundle {

namespace {
constexpr std::uint32_t initial_capacity = 8;  // surfaces per pixel to begin with
constexpr std::size_t max_list_bytes = std::size_t{2} << 30U;

Buffer list_buffer(const std::string& label, std::size_t bytes, bool mapped) {
    return mapped ? Buffer::mapped(label, bytes) : Buffer(label, bytes);
}
}  // namespace

LayeredWindow::LayeredWindow(int n, const std::vector<std::string>& defines, bool traced)
    : n_(n),
      traced_(traced),
      counts_(list_buffer("layer counts",
                          static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * 4, traced)) {
    grow(initial_capacity);
    if (traced) {
        return;
    }
    raster_ = ShaderProgram({"bundle_raster.vert", "bundle_layers.frag"}, defines);
    clear_ = ShaderProgram({"bundle_layers_clear.comp"});
    // Nothing is drawn into it: the framebuffer only has a size.
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer_ = Framebuffer(name);
    glNamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_WIDTH, n);
    glNamedFramebufferParameteri(name, GL_FRAMEBUFFER_DEFAULT_HEIGHT, n);
}

void LayeredWindow::draw(const GpuScene& scene, const ParallelWindow& window, Place place,
                         const PixelRectangle& rectangle, const Buffer& counters) const {
    if (rectangle.empty()) {
        return;
    }
    bind();
    if (traced_) {
        trace(scene, window, place, rectangle, counters);
        return;
    }
    const GLuint zero = 0;
    glClearNamedBufferSubData(counters.get(), GL_R32UI, offsetof(layout::Counters, layers), 4,
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    empty_lists(rectangle);

    const glm::mat4 clip_from_world = window.clip_from_world(1.0F / window.depth, 0.0F);
    const GlScope scope("layered raster");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, n_, n_);
    glEnable(GL_SCISSOR_TEST);
    glScissor(rectangle.x0, rectangle.y0, rectangle.width(), rectangle.height());
    raster_.use();
    raster_.set("facet_base", scene.facet_base(place));
    raster_.set("clip_from_world", clip_from_world);
    scene.draw(place, narrowed(clip_from_world, rectangle, {n_, n_}), false, raster_);
    glDisable(GL_SCISSOR_TEST);
    storage_barrier();
}

void LayeredWindow::trace(const GpuScene& scene, const ParallelWindow& window, Place place,
                          const PixelRectangle& rectangle, const Buffer& counters) const {
    const GlScope scope("layered rays");
    const BundleFrame& frame = window.frame;
    RayGrid grid;
    grid.origin = frame.origin + 0.5F * window.pixel_size * (frame.x + frame.y);
    grid.origin_x = window.pixel_size * frame.x;
    grid.origin_y = window.pixel_size * frame.y;
    grid.direction = frame.z;
    grid.far = window.depth;
    grid.first = {rectangle.x0, rectangle.y0};
    grid.last = {rectangle.x1, rectangle.y1};
    grid.result_row = static_cast<std::size_t>(n_);
    TraceRules rules = scene.trace_rules(place);
    rules.bundle = bundle_number(frame);
    const LineOrder order{frame.z, rules.tie, 16.0F * window.pixel_size};
    finish_commands();  // earlier bundles have been read
    const std::uint32_t longest = scene.tracer()->all(
        grid, rules, order,
        {counts_.data<std::uint32_t>(), surfaces_.data<std::uint32_t>(),
         static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_), capacity_});
    glClearNamedBufferSubData(counters.get(), GL_R32UI, offsetof(layout::Counters, layers), 4,
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &longest);
}

void LayeredWindow::empty_lists(const PixelRectangle& rectangle) const {
    if (rectangle.width() == n_ && rectangle.height() == n_) {
        counts_.clear();
        return;
    }
    clear_.set("first_column", static_cast<unsigned>(rectangle.x0));
    clear_.set("first_row", static_cast<unsigned>(rectangle.y0));
    clear_.set("columns", static_cast<unsigned>(rectangle.width()));
    clear_.set("rows", static_cast<unsigned>(rectangle.height()));
    clear_.set("window_width", static_cast<unsigned>(n_));
    clear_.dispatch(static_cast<std::size_t>(rectangle.width()) *
                    static_cast<std::size_t>(rectangle.height()));
}

void LayeredWindow::bind() const {
    counts_.bind_storage(BINDING_LAYER_COUNTS);
    surfaces_.bind_storage(BINDING_LAYER_SURFACES);
    glBindTextureUnit(UNIT_LAYERS, list_texture_.get());
}

void LayeredWindow::grow(std::uint32_t capacity) {
    if (capacity <= capacity_) {
        return;
    }
    const std::size_t bytes = counts_.bytes() * capacity;
    if (bytes > max_list_bytes) {
        throw GpuError("a parallel bundle of this scene meets " + std::to_string(capacity) +
                       " surfaces along a line, for which there is no room; use a smaller bundle "
                       "resolution");
    }
    surfaces_ =
        traced_ ? Buffer::mapped("layer surfaces", bytes) : Buffer("layer surfaces", bytes, 0);
    list_texture_ = create_buffer_texture("layer surfaces", GL_RGBA32UI, surfaces_);
    capacity_ = capacity;
}

}  // namespace raybundle
