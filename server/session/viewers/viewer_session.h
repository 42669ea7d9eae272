// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "net/ws/client_event.h"
#include "raybundle.pb.h"
#include "scheduling/clock.h"
#include "scheduling/scheduling_settings.h"
#include "session/viewers/video_frames.h"
#include "session/viewers/viewer_display.h"
#include "stream/congestion_window.h"
#include "stream/depth_code.h"
#include "view/error/measured_error.h"
#include "view/viewer_image.h"

namespace raybundle {

/// All that the render loop keeps of one viewer: what it wants to see, its picture, how far that
/// is. The picture exists while somebody looks at it: from the first acknowledged frame on, until
/// frames have stayed unacknowledged for long.
class ViewerSession {
  public:
    /// Size of the pictures that a hello asks for.
    static glm::uvec2 size_of(const v1::Hello& hello);

    ViewerSession(ViewerId viewer, const v1::Hello& hello, const Camera& camera,
                  const ViewerPaceSettings& pace, const Clock& clock);

    /// Camera and size take effect with the next frame or apply_view(): drawing them costs time,
    /// which is shared among viewers.
    void set_camera(const v1::SetCamera& message, std::uint32_t request_id);
    void set_viewport(glm::uvec2 size);
    /// objects: indices of those that its pictures do not show.
    void set_hidden(std::vector<std::uint32_t> objects);
    void apply_view();
    /// Sets the share of full width and height that the next frame's picture has while the camera
    /// moves or objects are dragged. Between special phases only.
    void set_moving_scale(double scale, TimePoint now);
    /// Somebody drags an object: the picture has this size at once. Requires has_image().
    void note_drag(double scale, TimePoint now);
    /// Keeps the picture's size: a step of the drag has just been worked in.
    void stay_in_motion(TimePoint now) { motion_.last = now; }
    /// Time of a frame in motion with a full picture, ms; 0: not known yet.
    [[nodiscard]] double full_frame_ms() const { return motion_.full_frame_ms; }
    /// Notes the cost of the frame just rendered.
    void note_frame_cost(double cost_ms);
    /// Whether the page draws by itself while its camera or an object moves.
    void set_drawing(bool drawing) { drawing_ = drawing; }
    /// True while it does, and wants no picture.
    [[nodiscard]] bool draws_itself(TimePoint now) const { return drawing_ && in_motion(now); }
    /// The picture takes no part in a change, and begins anew with its next frame.
    void note_outdated() { outdated_ = true; }
    /// Shows what another viewer sees.
    void adopt_camera(const Camera& camera);
    /// The camera of the next frame.
    [[nodiscard]] const Camera& camera() const { return camera_; }
    /// Size of the full picture of the next frame.
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
    void set_depths(std::uint32_t columns) { frame_.depth_columns = columns; }

    /// Makes one slice of antialiasing if the picture has been at rest for a while. True if there
    /// was something to do.
    bool smooth(TimePoint now);
    /// Notes that the whole picture has changed: it is due soon.
    void note_change();
    /// True while the camera or an object has just moved, or no frame has shown the camera yet: a
    /// viewer that has waited long must not fall behind those just served.
    [[nodiscard]] bool moving(TimePoint now) const;
    /// True while a change is not shown by any frame, or a frame is being drawn.
    [[nodiscard]] bool awaits_frame() const { return frame_.changed || frame_.rendering; }
    /// Whether a new frame is worth sending now.
    [[nodiscard]] bool due(TimePoint now) const;
    [[nodiscard]] bool target_met();
    [[nodiscard]] FrameDemand demand(TimePoint now) const;

    /// Renders the next frame into its readback. epoch and the other figures go into its header.
    /// Requires has_image().
    void render(const FrameAdvice& advice, const v1::FrameHeader& figures, TimePoint now);
    /// What a frame of video may take; 0: the frame that was rendered last is none.
    [[nodiscard]] std::size_t video_bytes() const { return video_.bytes(); }
    /// Ends the video where the picture rests or nobody looks. True where there was one.
    bool end_video(TimePoint now);

    /// Renders the first frame into a picture that others use, too, from the solution alone. Waits
    /// for it.
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> render_first(
        ViewerImage& shared, const FrameAdvice& advice, const v1::FrameHeader& figures,
        TimePoint now);
    [[nodiscard]] bool frame_finished();
    /// Its depths, before take_frame(); empty where none were asked for.
    [[nodiscard]] DepthMap take_depths();
    /// Header of the finished frame, and its pixels (RGBA, row 0 at the top).
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> take_frame();

    /// Whether its statistics are old.
    [[nodiscard]] bool wants_statistics(TimePoint now) const;
    [[nodiscard]] TimePoint last_statistics() const { return errors_.last_statistics; }
    /// Queues new ones. Requires has_image().
    void refresh_statistics(TimePoint now);
    /// Error, interval and prediction for a `solution` message that has its iterationsPerSecond.
    void fill_solution(v1::Solution* solution);

    /// Whether the picture is at rest and its true error is worth measuring (again).
    [[nodiscard]] bool wants_check(TimePoint now);
    /// Time since which the picture shows the same. What was measured before belongs to another
    /// picture.
    [[nodiscard]] TimePoint last_change() const { return last_change_; }
    /// Notes that the picture is being measured.
    void note_check(TimePoint now);
    [[nodiscard]] TimePoint last_check() const { return errors_.last_check; }
    /// by_samples: statistics at the time of the measurement.
    void take_measured(const SquaredError& square, const ImageStatistics& by_samples) {
        errors_.measured.take(square, by_samples);
    }

    /// True while frames stay unacknowledged: nobody seems to look.
    [[nodiscard]] bool paused() const { return paused_; }
    void set_paused(bool paused) { paused_ = paused; }

    /// True once it has acknowledged a frame: its own picture is worth having.
    [[nodiscard]] bool acknowledged() const { return acknowledged_; }
    void note_acknowledged() { acknowledged_ = true; }

    [[nodiscard]] double pixels() const;        ///< of the full picture
    [[nodiscard]] double drawn_pixels() const;  ///< of the picture as it is
    /// Display of the frames that are shown now.
    [[nodiscard]] PictureLook look() const { return display_.look(image_.get()); }
    [[nodiscard]] ViewerId id() const { return identity_.viewer; }
    [[nodiscard]] const std::string& name() const { return identity_.name; }
    /// Viewer whose camera it follows, 0: none.
    [[nodiscard]] ViewerId following() const { return identity_.following; }
    void follow(ViewerId leader) { identity_.following = leader; }
    [[nodiscard]] v1::Role role() const { return identity_.role; }
    void set_role(v1::Role role) { identity_.role = role; }
    /// It asks over HTTP and never gets a picture, see ClientEvent::caller.
    [[nodiscard]] bool is_caller() const { return identity_.caller; }
    void set_caller() { identity_.caller = true; }
    [[nodiscard]] double target_error() const { return target_.error; }  ///< 0: none
    [[nodiscard]] bool has_target() const { return target_.error > 0.0 || target_.seconds > 0.0; }

  private:
    [[nodiscard]] ImageStatistics measured_statistics();
    [[nodiscard]] double since_change_s(TimePoint now) const;
    [[nodiscard]] double moving_s() const { return drawing_ ? pace_.drawn_rest_s : pace_.moving_s; }
    [[nodiscard]] bool in_motion(TimePoint now) const;
    [[nodiscard]] glm::uvec2 drawn_size() const;
    void compose(ViewerImage& image, const FrameAdvice& advice, const v1::FrameHeader& figures,
                 TimePoint now);

    struct Identity {
        ViewerId viewer = 0;
        std::string name;
        v1::Role role = v1::EDITOR;
        ViewerId following = 0;
        bool lossless = false;  ///< the client decodes PNG
        bool video = false;     ///< the client wants VP9 rather than JPEG, and there is an encoder
        bool caller = false;
    };
    struct Motion {
        double scale = 1.0;          ///< of the picture's width and height
        double full_frame_ms = 0.0;  ///< 0: not known yet
        bool redrawn = false;        ///< for the frame that is being rendered
        TimePoint last;
    };
    struct Target {
        double error = 0.0;    ///< relative; 0: none
        double seconds = 0.0;  ///< likewise
    };
    struct Errors {
        MeasuredError measured;
        std::uint64_t samples_at_check = 0;
        TimePoint last_check, last_statistics;
    };
    struct Frame {
        v1::FrameHeader header;
        std::uint32_t number = 0;
        std::uint32_t camera_id = 0;
        bool changed = true;  ///< something that no frame shows yet
        bool rendering = false;
        std::uint32_t depth_columns = 0;
        bool depths_coming = false;  ///< with the frame that is being rendered
        std::uint64_t samples = 0;   ///< of the picture, at the last frame
        TimePoint last;
    };

    ViewerPaceSettings pace_;
    const Clock& clock_;
    Identity identity_;
    std::unique_ptr<ViewerImage> image_;
    glm::uvec2 size_;
    Camera camera_;
    bool view_waits_ = true;  // the picture does not show size and camera yet
    TimePoint last_change_;
    Motion motion_;
    ViewerDisplay display_;
    Target target_;
    Errors errors_;
    Frame frame_;
    VideoFrames video_;
    bool drawing_ = false;
    bool outdated_ = false;
    bool paused_ = false;
    bool acknowledged_ = false;
};

}  // namespace raybundle
