// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewer_session.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "net/server.h"
#include "scheduling/elapsed.h"
#include "session/scene_messages.h"
#include "session/viewers/exposure_follow.h"
#include "session/viewers/stated_error.h"

namespace raybundle {

namespace {

constexpr double moving_s = 0.4;             // after the last change a viewer counts as moving
constexpr double moving_interval_s = 0.016;  // between frames while moving
constexpr double cost_smoothing = 0.2;       // weight of a new measurement
constexpr glm::uvec2 default_size(800, 600);

/// Frames of a refining picture: often at first, when it changes much, then less and less.
double refining_interval(double since_change) {
    return std::clamp(0.1 * since_change, 0.1, 1.0);
}

/// The next 1, 2 or 5 times a power of ten, so that a scale that follows the exposure keeps still.
float round_up_125(float value) {
    const float power = std::pow(10.0F, std::floor(std::log10(std::max(value, 1e-6F))));
    const float lead = value / power;
    return power * (lead <= 1.0F ? 1.0F : lead <= 2.0F ? 2.0F : lead <= 5.0F ? 5.0F : 10.0F);
}

}  // namespace

glm::uvec2 ViewerSession::size_of(const v1::Hello& hello) {
    return hello.has_viewport() ? glm::uvec2(hello.viewport().width(), hello.viewport().height())
                                : default_size;
}

ViewerSession::ViewerSession(ViewerId viewer, const v1::Hello& hello, const Camera& camera)
    : viewer_(viewer),
      name_(hello.name()),
      size_(size_of(hello)),
      camera_(camera),
      last_change_(Clock::now()) {
    lossless_ =
        std::find(hello.codecs().begin(), hello.codecs().end(), v1::PNG) != hello.codecs().end();
}

double ViewerSession::since_change_s(Clock::time_point now) const {
    return seconds(now - last_change_);
}

void ViewerSession::note_change() {
    changed_ = true;
    measured_.carry_over();
    samples_at_check_ = 0;
    last_change_ = Clock::now();
}

void ViewerSession::set_camera(const v1::SetCamera& message, std::uint32_t request_id) {
    camera_.eye = from_message(message.eye());
    camera_.target = from_message(message.target());
    camera_.up = message.has_up() ? from_message(message.up()) : glm::vec3(0.0F, 1.0F, 0.0F);
    if (message.has_vertical_fov()) {
        camera_.vertical_fov = message.vertical_fov();
    }
    camera_.near = message.has_near() ? message.near() : 0.0F;
    view_waits_ = true;
    camera_id_ = request_id;
    note_change();
    last_motion_ = last_change_;
}

void ViewerSession::set_hidden(std::vector<std::uint32_t> objects) {
    camera_.hidden = std::move(objects);
    view_waits_ = true;
    note_change();
}

void ViewerSession::adopt_camera(const Camera& camera) {
    camera_ = camera;
    view_waits_ = true;
    note_change();
    last_motion_ = last_change_;
}

void ViewerSession::apply_view() {
    if (!view_waits_) {
        return;
    }
    view_waits_ = false;
    if (image_->full_size() != size_) {
        rendering_ = false;
        image_->set_view(camera_, size_);
        return;
    }
    image_->set_camera(camera_, drawn_size());
    redrawn_ = true;
}

glm::uvec2 ViewerSession::drawn_size() const {
    return {glm::round(glm::dvec2(size_) * moving_scale_)};
}

void ViewerSession::set_moving_scale(double scale, Clock::time_point now) {
    const bool moves = in_motion(now);
    // A picture in motion changes its size with its camera, one that has come to rest at once.
    view_waits_ = view_waits_ || (!moves && image_ && image_->size() != image_->full_size());
    moving_scale_ = moves ? scale : 1.0;
}

void ViewerSession::note_drag(double scale, Clock::time_point now) {
    last_motion_ = now;
    moving_scale_ = scale;
    view_waits_ = view_waits_ || image_->size() != drawn_size();
    apply_view();
}

void ViewerSession::note_frame_cost(double cost_ms) {
    if (std::exchange(redrawn_, false)) {
        const double full_ms = cost_ms * pixels() / std::max(drawn_pixels(), 1.0);
        full_frame_ms_ +=
            (full_frame_ms_ > 0.0 ? cost_smoothing : 1.0) * (full_ms - full_frame_ms_);
    }
}

std::vector<std::optional<PixelProbe>> ViewerSession::probe(std::span<const glm::uvec2> pixels) {
    std::vector<glm::uvec2> drawn(pixels.begin(), pixels.end());
    for (glm::uvec2& pixel : drawn) {
        pixel = (2U * pixel + 1U) * image_->size() / (2U * image_->full_size());
    }
    return image_->probe(drawn);
}

std::optional<PixelProbe> ViewerSession::probe(glm::uvec2 pixel) {
    return probe(std::span(&pixel, 1)).front();
}

double ViewerSession::pixels() const {
    return static_cast<double>(size_.x) * static_cast<double>(size_.y);
}

double ViewerSession::drawn_pixels() const {
    const glm::uvec2 size = image_ ? image_->size() : size_;
    return static_cast<double>(size.x) * static_cast<double>(size.y);
}

void ViewerSession::set_viewport(glm::uvec2 size) {
    view_waits_ = view_waits_ || size != size_;
    size_ = size;
    note_change();
}

void ViewerSession::give_image(std::unique_ptr<ViewerImage> image, bool shown) {
    image_ = std::move(image);
    measured_.carry_over();
    samples_at_check_ = 0;
    view_waits_ = view_waits_ || !shown;
    rendering_ = false;
    changed_ = true;
}

void ViewerSession::drop_image() {
    image_.reset();
    rendering_ = false;
}

void ViewerSession::set_display(const v1::SetDisplay& message) {
    if (message.has_mode() && message.mode() != v1::SetDisplay::MODE_UNSPECIFIED) {
        mode_ = message.mode() == v1::SetDisplay::FALSE_LUMINANCE ? DisplayMode::false_luminance
                : message.mode() == v1::SetDisplay::FALSE_ILLUMINANCE
                    ? DisplayMode::false_illuminance
                    : DisplayMode::photo;
    }
    if (message.has_exposure()) {
        exposure_offset_ = message.exposure();
    }
    if (message.has_auto_exposure()) {
        auto_exposure_ = message.auto_exposure();
    }
    if (message.has_scale_maximum()) {
        scale_maximum_ = message.scale_maximum();
    }
    if (message.has_isolines()) {
        isolines_ = message.isolines();
    }
    if (message.has_scale_unit()) {
        scale_unit_ = message.scale_unit();
    }
    if (message.has_linear_scale()) {
        linear_scale_ = message.linear_scale();
    }
    shown_exposure_.reset();
    changed_ = true;
}

void ViewerSession::set_target(const v1::SetTarget& message) {
    target_error_ =
        message.has_relative_error() ? static_cast<double>(message.relative_error()) : 0.0;
    target_seconds_ = message.has_seconds() ? static_cast<double>(message.seconds()) : 0.0;
}

bool ViewerSession::moving(Clock::time_point now) const {
    return view_waits_ || since_change_s(now) < moving_s;
}

/// The camera has just moved, or an object has been dragged.
bool ViewerSession::in_motion(Clock::time_point now) const {
    return seconds(now - last_motion_) < moving_s;
}

bool ViewerSession::smooth(Clock::time_point now) {
    if (!image_ || moving(now) || image_->smoothed()) {
        return false;
    }
    image_->smooth_step();
    changed_ = changed_ || image_->smoothed();
    return true;
}

bool ViewerSession::due(Clock::time_point now) const {
    if (rendering_) {
        return false;
    }
    const double since_frame = seconds(now - last_frame_);
    if (changed_) {
        return since_frame >= moving_interval_s;
    }
    if (!image_) {
        return acknowledged_;
    }
    if (image_->size() != image_->full_size() && !in_motion(now)) {
        return true;
    }
    return image_->samples() > samples_at_frame_ &&
           since_frame >= refining_interval(since_change_s(now));
}

FrameDemand ViewerSession::demand(Clock::time_point now) const {
    return {moving(now), lossless_ && !moving(now), pixels()};
}

PictureLook ViewerSession::look() const {
    const float automatic = auto_exposure_ && image_ ? image_->automatic_exposure() : 0.0F;
    const float exposure = shown_exposure_.value_or(automatic + exposure_offset_);
    return {mode_, exposure, colour_scale(exposure)};
}

float ViewerSession::exposure(const ViewerImage& image, const ImageStatistics& statistics,
                              double since_frame_s) {
    if (auto_exposure_ && shown_exposure_ && !image.brightness_known()) {
        return *shown_exposure_;  // of another size, or of other shaders: as bright as the last one
    }
    const float automatic =
        auto_exposure_ ? image.automatic_exposure(statistics.darker_than()) : 0.0F;
    const float wanted = automatic + exposure_offset_;
    // Follow slowly, so that the picture neither pumps nor jumps; a first picture is right at once.
    const float follow = shown_exposure_ ? exposure_follow(since_frame_s) : 1.0F;
    const float before = shown_exposure_.value_or(wanted);
    shown_exposure_ = before + (wanted - before) * follow;
    return *shown_exposure_;
}

ColourScale ViewerSession::colour_scale(float exposure) const {
    const float isolines = isolines_ ? scale_unit_ : 0.0F;
    if (scale_maximum_ > 0.0F) {
        return {scale_maximum_, isolines, linear_scale_};
    }
    // Display white, in lx on a surface of albedo 0.5 where illuminance is shown.
    const float white = 1.0F / ViewerImage::display_factor(exposure);
    const bool lux = mode_ == DisplayMode::false_illuminance;
    const float top = lux ? 2.0F * std::numbers::pi_v<float> * white : white;
    return {round_up_125(top / scale_unit_) * scale_unit_, isolines, linear_scale_};
}

void ViewerSession::render(const FrameAdvice& advice, const v1::FrameHeader& figures,
                           Clock::time_point now) {
    apply_view();
    compose(*image_, advice, figures, now);
    depths_coming_ = depth_columns_ > 0;
    if (depths_coming_) {
        image_->request_depths(depth_columns_);
    }
    rendering_ = true;
}

bool ViewerSession::frame_finished() {
    return rendering_ && image_->finished() && (!depths_coming_ || image_->depths()->ready());
}

DepthMap ViewerSession::take_depths() {
    if (!depths_coming_) {
        return {};
    }
    DepthGrid& grid = *image_->depths();
    const std::span<const float> inverse = grid.take();
    return {grid.points().x, grid.points().y, {inverse.begin(), inverse.end()}};
}

std::pair<v1::FrameHeader, std::span<const std::uint8_t>> ViewerSession::render_first(
    ViewerImage& shared, const FrameAdvice& advice, const v1::FrameHeader& figures,
    Clock::time_point now) {
    shared.restart(camera_, size_);
    shared.request_statistics();
    shared.finish_statistics();
    view_waits_ = false;
    compose(shared, advice, figures, now);
    return {header_, shared.take()};
}

void ViewerSession::compose(ViewerImage& image, const FrameAdvice& advice,
                            const v1::FrameHeader& figures, Clock::time_point now) {
    const auto scaled = [&](unsigned pixels) {
        return std::max(1U, static_cast<unsigned>(std::lround(pixels * advice.scale)));
    };
    const glm::uvec2 frame_size =
        glm::min(glm::uvec2(scaled(size_.x), scaled(size_.y)), image.size());
    // What was measured is of the own picture; a shared one has just begun.
    const ImageStatistics statistics =
        &image == image_.get() ? measured_statistics() : image.statistics();
    header_ = figures;
    header_.set_frame(++frame_);
    header_.set_camera_id(camera_id_);
    header_.set_codec(advice.quality == FrameAdvice::kLossless && lossless_ ? v1::PNG : v1::JPEG);
    header_.set_quality(static_cast<unsigned>(advice.quality));
    header_.set_width(frame_size.x);
    header_.set_height(frame_size.y);
    state_error(statistics, &image == image_.get() && measured_.known(), header_);
    header_.set_exposure(exposure(image, statistics, seconds(now - last_frame_)));
    header_.set_server_time_ms(Server::now_ms());
    const ColourScale scale = colour_scale(header_.exposure());
    if (mode_ != DisplayMode::photo) {
        header_.set_scale_maximum(scale.maximum);
        header_.set_scale_linear(scale.linear);
        header_.set_scale_illuminance(mode_ == DisplayMode::false_illuminance);
    }
    image.compose(mode_, header_.exposure(), frame_size, scale);
    changed_ = false;
    last_frame_ = now;
    samples_at_frame_ = image.samples();
}

std::pair<v1::FrameHeader, std::span<const std::uint8_t>> ViewerSession::take_frame() {
    rendering_ = false;
    return {header_, image_->take()};
}

}  // namespace raybundle
