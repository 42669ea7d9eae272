// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/viewer_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "net/server.h"
#include "session/measure/stated_error.h"
#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

constexpr glm::uvec2 default_size(800, 600);

/// Between frames of a refining picture: short at first, when it changes much, then longer.
double refining_interval_s(double since_change_s, const ViewerPaceSettings& pace) {
    return std::clamp(pace.refining_share * since_change_s, pace.min_refining_s,
                      pace.max_refining_s);
}

}  // namespace

glm::uvec2 ViewerSession::size_of(const v1::Hello& hello) {
    return hello.has_viewport() ? glm::uvec2(hello.viewport().width(), hello.viewport().height())
                                : default_size;
}

ViewerSession::ViewerSession(ViewerId viewer, const v1::Hello& hello, const Camera& camera,
                             const ViewerPaceSettings& pace, const Clock& clock)
    : pace_(pace),
      clock_(clock),
      size_(size_of(hello)),
      camera_(camera),
      last_change_(clock.now()) {
    identity_.viewer = viewer;
    identity_.name = hello.name();
    identity_.lossless =
        std::find(hello.codecs().begin(), hello.codecs().end(), v1::PNG) != hello.codecs().end();
    identity_.video = VideoFrames::wanted_by(hello);
}

double ViewerSession::since_change_s(TimePoint now) const {
    return seconds(now - last_change_);
}

void ViewerSession::note_change() {
    frame_.changed = true;
    errors_.measured.carry_over();
    errors_.samples_at_check = 0;
    last_change_ = clock_.now();
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
    frame_.camera_id = request_id;
    note_change();
    motion_.last = last_change_;
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
    motion_.last = last_change_;
}

void ViewerSession::apply_view() {
    if (std::exchange(outdated_, false)) {
        frame_.rendering = false;
        view_waits_ = false;
        motion_.redrawn = true;
        image_->restart(camera_, size_);
        return;
    }
    if (!view_waits_) {
        return;
    }
    view_waits_ = false;
    if (image_->full_size() != size_) {
        frame_.rendering = false;
        image_->set_view(camera_, size_);
        return;
    }
    image_->set_camera(camera_, drawn_size());
    motion_.redrawn = true;
}

glm::uvec2 ViewerSession::drawn_size() const {
    return {glm::round(glm::dvec2(size_) * motion_.scale)};
}

void ViewerSession::set_moving_scale(double scale, TimePoint now) {
    const bool moves = in_motion(now);
    // A picture in motion changes its size with its camera, one that has come to rest at once.
    view_waits_ = view_waits_ || (!moves && image_ && image_->size() != image_->full_size());
    motion_.scale = moves ? scale : 1.0;
}

void ViewerSession::note_drag(double scale, TimePoint now) {
    motion_.last = now;
    if (drawing_) {
        return;
    }
    motion_.scale = scale;
    view_waits_ = view_waits_ || image_->size() != drawn_size();
    apply_view();
}

void ViewerSession::note_frame_cost(double cost_ms) {
    if (std::exchange(motion_.redrawn, false)) {
        const double full_ms = cost_ms * pixels() / std::max(drawn_pixels(), 1.0);
        motion_.full_frame_ms += (motion_.full_frame_ms > 0.0 ? pace_.cost_smoothing : 1.0) *
                                 (full_ms - motion_.full_frame_ms);
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
    errors_.measured.carry_over();
    errors_.samples_at_check = 0;
    view_waits_ = view_waits_ || !shown;
    frame_.rendering = false;
    frame_.changed = true;
}

void ViewerSession::drop_image() {
    image_.reset();
    frame_.rendering = false;
}

void ViewerSession::set_display(const v1::SetDisplay& message) {
    display_.set(message);
    frame_.changed = true;
}

void ViewerSession::set_target(const v1::SetTarget& message) {
    target_.error =
        message.has_relative_error() ? static_cast<double>(message.relative_error()) : 0.0;
    target_.seconds = message.has_seconds() ? static_cast<double>(message.seconds()) : 0.0;
}

bool ViewerSession::moving(TimePoint now) const {
    return view_waits_ || since_change_s(now) < moving_s();
}

/// The camera has just moved, or an object has been dragged.
bool ViewerSession::in_motion(TimePoint now) const {
    return seconds(now - motion_.last) < moving_s();
}

bool ViewerSession::smooth(TimePoint now) {
    if (!image_ || moving(now) || image_->smoothed()) {
        return false;
    }
    image_->smooth_step();
    frame_.changed = frame_.changed || image_->smoothed();
    return true;
}

bool ViewerSession::due(TimePoint now) const {
    if (frame_.rendering || draws_itself(now)) {
        return false;
    }
    const double since_frame = seconds(now - frame_.last);
    if (frame_.changed) {
        return since_frame >= pace_.moving_interval_s;
    }
    if (!image_) {
        return acknowledged_;
    }
    if (image_->size() != image_->full_size() && !in_motion(now)) {
        return true;
    }
    return image_->samples() > frame_.samples &&
           since_frame >= refining_interval_s(since_change_s(now), pace_);
}

FrameDemand ViewerSession::demand(TimePoint now) const {
    return {moving(now), identity_.lossless && !moving(now), pixels(),
            identity_.video && moving(now)};
}

bool ViewerSession::end_video(TimePoint now) {
    return !frame_.rendering && (paused_ || !moving(now)) && video_.end();
}

void ViewerSession::render(const FrameAdvice& advice, const v1::FrameHeader& figures,
                           TimePoint now) {
    apply_view();
    compose(*image_, advice, figures, now);
    frame_.depths_coming = frame_.depth_columns > 0;
    if (frame_.depths_coming) {
        image_->request_depths(frame_.depth_columns);
    }
    frame_.rendering = true;
}

bool ViewerSession::frame_finished() {
    return frame_.rendering && image_->finished() &&
           (!frame_.depths_coming || image_->depths()->ready());
}

DepthMap ViewerSession::take_depths() {
    if (!frame_.depths_coming) {
        return {};
    }
    DepthGrid& grid = *image_->depths();
    const std::span<const float> inverse = grid.take();
    return {grid.points().x, grid.points().y, {inverse.begin(), inverse.end()}};
}

std::pair<v1::FrameHeader, std::span<const std::uint8_t>> ViewerSession::render_first(
    ViewerImage& shared, const FrameAdvice& advice, const v1::FrameHeader& figures, TimePoint now) {
    shared.restart(camera_, size_);
    shared.request_statistics();
    shared.finish_statistics();
    view_waits_ = false;
    compose(shared, advice, figures, now);
    return {frame_.header, shared.take()};
}

void ViewerSession::compose(ViewerImage& image, const FrameAdvice& advice,
                            const v1::FrameHeader& figures, TimePoint now) {
    const auto scaled = [&](unsigned pixels) {
        return std::max(1U, static_cast<unsigned>(std::lround(pixels * advice.scale)));
    };
    const glm::uvec2 frame_size =
        video_.next(advice, glm::min(glm::uvec2(scaled(size_.x), scaled(size_.y)), image.size()),
                    size_, camera_, now);
    // What was measured is of the own picture; a shared one has just begun.
    const ImageStatistics statistics =
        &image == image_.get() ? measured_statistics() : image.statistics();
    frame_.header = figures;
    frame_.header.set_frame(++frame_.number);
    frame_.header.set_camera_id(frame_.camera_id);
    frame_.header.set_codec(
        advice.quality == FrameAdvice::kLossless && identity_.lossless ? v1::PNG : v1::JPEG);
    frame_.header.set_quality(static_cast<unsigned>(advice.quality));
    video_.fill(frame_.header);
    frame_.header.set_width(frame_size.x);
    frame_.header.set_height(frame_size.y);
    state_error(statistics, &image == image_.get() && errors_.measured.known(), frame_.header);
    frame_.header.set_exposure(
        display_.next_exposure(image, statistics, seconds(now - frame_.last)));
    frame_.header.set_server_time_ms(Server::now_ms());
    const ColourScale scale = display_.colour_scale(frame_.header.exposure());
    if (display_.mode() != DisplayMode::photo) {
        frame_.header.set_scale_maximum(scale.maximum);
        frame_.header.set_scale_linear(scale.linear);
        frame_.header.set_scale_illuminance(display_.mode() == DisplayMode::false_illuminance);
    }
    image.compose(display_.mode(), frame_.header.exposure(), frame_size, scale);
    frame_.changed = false;
    frame_.last = now;
    frame_.samples = image.samples();
}

std::pair<v1::FrameHeader, std::span<const std::uint8_t>> ViewerSession::take_frame() {
    frame_.rendering = false;
    return {frame_.header, image_->take()};
}

}  // namespace raybundle
