// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "net/ws/client_event.h"
#include "raybundle.pb.h"
#include "stream/congestion_window.h"
#include "stream/depth_code.h"
#include "view/measured_error.h"
#include "view/viewer_image.h"

namespace raybundle {

/// What one viewer wants to see and how far its picture is; everything the render loop keeps of it.
/// The picture itself exists while somebody looks at it: from the first acknowledged frame on,
/// until frames have stayed unacknowledged for long.
class ViewerSession {
  public:
    using Clock = std::chrono::steady_clock;

    /// Size of the pictures that a hello asks for.
    static glm::uvec2 size_of(const v1::Hello& hello);

    ViewerSession(ViewerId viewer, const v1::Hello& hello, const Camera& camera);

    /// Camera and size take effect with the next frame or apply_view(): that costs time, of which
    /// every viewer gets his share.
    void set_camera(const v1::SetCamera& message, std::uint32_t request_id);
    void set_viewport(glm::uvec2 size);
    /// objects: indices of those that its pictures do not show.
    void set_hidden(std::vector<std::uint32_t> objects);
    void apply_view();
    /// Next frame's picture has so much of its full width and height while the camera moves or
    /// objects are dragged. Between special phases only.
    void set_moving_scale(double scale, Clock::time_point now);
    /// Somebody drags an object: the picture has this size at once. Requires has_image().
    void note_drag(double scale, Clock::time_point now);
    /// A step of the drag has been worked in, however long that took: the picture keeps its size.
    void stay_in_motion(Clock::time_point now) { last_motion_ = now; }
    /// What a frame of the moving camera takes with a full picture, ms; 0: not known yet.
    [[nodiscard]] double full_frame_ms() const { return full_frame_ms_; }
    /// The frame just rendered took so long.
    void note_frame_cost(double cost_ms);
    /// Shows what another viewer sees.
    void adopt_camera(const Camera& camera);
    /// What it looks at, or will with its next frame.
    [[nodiscard]] const Camera& camera() const { return camera_; }
    /// Of its full picture, likewise.
    [[nodiscard]] glm::uvec2 size() const { return size_; }
    /// What pixels of the full picture show. Requires has_image().
    [[nodiscard]] std::vector<std::optional<PixelProbe>> probe(std::span<const glm::uvec2> pixels);
    [[nodiscard]] std::optional<PixelProbe> probe(glm::uvec2 pixel);

    [[nodiscard]] bool has_image() const { return image_ != nullptr; }
    /// Requires has_image().
    [[nodiscard]] ViewerImage& image() { return *image_; }
    /// Takes a picture. shown: it is the one of render_first().
    void give_image(std::unique_ptr<ViewerImage> image, bool shown);
    void drop_image();
    void set_display(const v1::SetDisplay& message);
    void set_target(const v1::SetTarget& message);
    /// Frames carry depths on a grid with so many columns; 0: none.
    void set_depths(std::uint32_t columns) { depth_columns_ = columns; }

    /// One slice of antialiasing where the picture has been at rest for a while. True if there was
    /// something to do.
    bool smooth(Clock::time_point now);
    /// Something that the whole picture shows has changed: answer with a frame soon.
    void note_change();
    /// The camera or an object moved within the last moments, or no frame has shown the camera yet:
    /// whoever waits long for it must not fall behind those who have just been served.
    [[nodiscard]] bool moving(Clock::time_point now) const;
    /// Something has changed that no frame shows yet, or a frame is being drawn.
    [[nodiscard]] bool awaits_frame() const { return changed_ || rendering_; }
    /// A new frame is worth sending now.
    [[nodiscard]] bool due(Clock::time_point now) const;
    [[nodiscard]] bool target_met();
    [[nodiscard]] FrameDemand demand(Clock::time_point now) const;

    /// Renders the next frame into its readback. epoch and the other figures go into its header.
    /// Requires has_image().
    void render(const FrameAdvice& advice, const v1::FrameHeader& figures, Clock::time_point now);
    /// The same of a picture that others use, too, from what the solution knows: waits for it.
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> render_first(
        ViewerImage& shared, const FrameAdvice& advice, const v1::FrameHeader& figures,
        Clock::time_point now);
    [[nodiscard]] bool frame_finished();
    /// Its depths, before take_frame(); empty where none were asked for.
    [[nodiscard]] DepthMap take_depths();
    /// Header of the finished frame, and its pixels (RGBA, row 0 at the top).
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> take_frame();

    /// Its statistics are old.
    [[nodiscard]] bool wants_statistics(Clock::time_point now) const;
    [[nodiscard]] Clock::time_point last_statistics() const { return last_statistics_; }
    /// Queues new ones. Requires has_image().
    void refresh_statistics(Clock::time_point now);
    /// Error, interval and prediction for a `solution` message that has its iterationsPerSecond.
    void fill_solution(v1::Solution* solution);

    /// The picture is at rest and its true error worth measuring (again).
    [[nodiscard]] bool wants_check(Clock::time_point now);
    /// Since when it shows what it shows: what was measured before that is of another picture.
    [[nodiscard]] Clock::time_point last_change() const { return last_change_; }
    /// The picture is being measured.
    void note_check(Clock::time_point now);
    [[nodiscard]] Clock::time_point last_check() const { return last_check_; }
    /// by_samples: what they said when it was.
    void take_measured(const SquaredError& square, const ImageStatistics& by_samples) {
        measured_.take(square, by_samples);
    }

    /// Nobody seems to look: frames stay unacknowledged.
    [[nodiscard]] bool paused() const { return paused_; }
    void set_paused(bool paused) { paused_ = paused; }

    /// It has acknowledged a frame, so that its own picture is worth having.
    [[nodiscard]] bool acknowledged() const { return acknowledged_; }
    void note_acknowledged() { acknowledged_ = true; }

    [[nodiscard]] double pixels() const;        ///< of the full picture
    [[nodiscard]] double drawn_pixels() const;  ///< of the picture as it is
    /// Of the pictures it shows now.
    [[nodiscard]] PictureLook look() const;
    [[nodiscard]] ViewerId id() const { return viewer_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Viewer whose camera it follows, 0: none.
    [[nodiscard]] ViewerId following() const { return following_; }
    void follow(ViewerId leader) { following_ = leader; }
    [[nodiscard]] v1::Role role() const { return role_; }
    void set_role(v1::Role role) { role_ = role; }
    [[nodiscard]] double target_error() const { return target_error_; }  ///< 0: none
    [[nodiscard]] bool has_target() const { return target_error_ > 0.0 || target_seconds_ > 0.0; }

  private:
    [[nodiscard]] ImageStatistics measured_statistics();
    [[nodiscard]] double since_change_s(Clock::time_point now) const;
    [[nodiscard]] bool in_motion(Clock::time_point now) const;
    [[nodiscard]] glm::uvec2 drawn_size() const;
    [[nodiscard]] float exposure(const ViewerImage& image, const ImageStatistics& statistics,
                                 double since_frame_s);
    void compose(ViewerImage& image, const FrameAdvice& advice, const v1::FrameHeader& figures,
                 Clock::time_point now);
    [[nodiscard]] ColourScale colour_scale(float exposure) const;

    ViewerId viewer_;
    std::string name_;
    v1::Role role_ = v1::EDITOR;
    ViewerId following_ = 0;
    bool lossless_ = false;  // the client decodes PNG
    std::unique_ptr<ViewerImage> image_;
    glm::uvec2 size_;
    Camera camera_;
    bool view_waits_ = true;  // the picture does not show them yet
    bool redrawn_ = false;    // for the frame that is being rendered
    double moving_scale_ = 1.0;
    double full_frame_ms_ = 0.0;
    DisplayMode mode_ = DisplayMode::photo;
    float exposure_offset_ = 0.0F;
    bool auto_exposure_ = true;
    float scale_maximum_ = 0.0F;  // 0: follows the exposure
    bool isolines_ = false;
    float scale_unit_ = 1.0F;  // lx or cd/m²
    bool linear_scale_ = false;
    std::optional<float> shown_exposure_;
    double target_error_ = 0.0;
    double target_seconds_ = 0.0;
    std::uint32_t camera_id_ = 0;
    std::uint32_t frame_ = 0;
    bool changed_ = true;
    bool rendering_ = false;
    std::uint32_t depth_columns_ = 0;
    bool depths_coming_ = false;  // with the frame that is being rendered
    bool paused_ = false;
    bool acknowledged_ = false;
    MeasuredError measured_;
    std::uint64_t samples_at_check_ = 0;
    Clock::time_point last_check_;
    v1::FrameHeader header_;
    Clock::time_point last_change_, last_motion_, last_frame_, last_statistics_;
    std::uint64_t samples_at_frame_ = 0;
};

}  // namespace raybundle
