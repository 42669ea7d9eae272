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
#include "session/viewers/viewer_display.h"
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
    /// Size of the pictures that a hello asks for.
    static glm::uvec2 size_of(const v1::Hello& hello);

    ViewerSession(ViewerId viewer, const v1::Hello& hello, const Camera& camera,
                  const ViewerPaceSettings& pace, const Clock& clock);

    /// Camera and size take effect with the next frame or apply_view(): that costs time, of which
    /// every viewer gets his share.
    void set_camera(const v1::SetCamera& message, std::uint32_t request_id);
    void set_viewport(glm::uvec2 size);
    /// objects: indices of those that its pictures do not show.
    void set_hidden(std::vector<std::uint32_t> objects);
    void apply_view();
    /// Next frame's picture has so much of its full width and height while the camera moves or
    /// objects are dragged. Between special phases only.
    void set_moving_scale(double scale, TimePoint now);
    /// Somebody drags an object: the picture has this size at once. Requires has_image().
    void note_drag(double scale, TimePoint now);
    /// A step of the drag has been worked in, however long that took: the picture keeps its size.
    void stay_in_motion(TimePoint now) { motion_.last = now; }
    /// What a frame of the moving camera takes with a full picture, ms; 0: not known yet.
    [[nodiscard]] double full_frame_ms() const { return motion_.full_frame_ms; }
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
    void set_depths(std::uint32_t columns) { frame_.depth_columns = columns; }

    /// One slice of antialiasing where the picture has been at rest for a while. True if there was
    /// something to do.
    bool smooth(TimePoint now);
    /// Something that the whole picture shows has changed: answer with a frame soon.
    void note_change();
    /// The camera or an object moved within the last moments, or no frame has shown the camera yet:
    /// whoever waits long for it must not fall behind those who have just been served.
    [[nodiscard]] bool moving(TimePoint now) const;
    /// Something has changed that no frame shows yet, or a frame is being drawn.
    [[nodiscard]] bool awaits_frame() const { return frame_.changed || frame_.rendering; }
    /// A new frame is worth sending now.
    [[nodiscard]] bool due(TimePoint now) const;
    [[nodiscard]] bool target_met();
    [[nodiscard]] FrameDemand demand(TimePoint now) const;

    /// Renders the next frame into its readback. epoch and the other figures go into its header.
    /// Requires has_image().
    void render(const FrameAdvice& advice, const v1::FrameHeader& figures, TimePoint now);
    /// The same of a picture that others use, too, from what the solution knows: waits for it.
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> render_first(
        ViewerImage& shared, const FrameAdvice& advice, const v1::FrameHeader& figures,
        TimePoint now);
    [[nodiscard]] bool frame_finished();
    /// Its depths, before take_frame(); empty where none were asked for.
    [[nodiscard]] DepthMap take_depths();
    /// Header of the finished frame, and its pixels (RGBA, row 0 at the top).
    std::pair<v1::FrameHeader, std::span<const std::uint8_t>> take_frame();

    /// Its statistics are old.
    [[nodiscard]] bool wants_statistics(TimePoint now) const;
    [[nodiscard]] TimePoint last_statistics() const { return errors_.last_statistics; }
    /// Queues new ones. Requires has_image().
    void refresh_statistics(TimePoint now);
    /// Error, interval and prediction for a `solution` message that has its iterationsPerSecond.
    void fill_solution(v1::Solution* solution);

    /// The picture is at rest and its true error worth measuring (again).
    [[nodiscard]] bool wants_check(TimePoint now);
    /// Since when it shows what it shows: what was measured before that is of another picture.
    [[nodiscard]] TimePoint last_change() const { return last_change_; }
    /// The picture is being measured.
    void note_check(TimePoint now);
    [[nodiscard]] TimePoint last_check() const { return errors_.last_check; }
    /// by_samples: what they said when it was.
    void take_measured(const SquaredError& square, const ImageStatistics& by_samples) {
        errors_.measured.take(square, by_samples);
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
    [[nodiscard]] PictureLook look() const { return display_.look(image_.get()); }
    [[nodiscard]] ViewerId id() const { return identity_.viewer; }
    [[nodiscard]] const std::string& name() const { return identity_.name; }
    /// Viewer whose camera it follows, 0: none.
    [[nodiscard]] ViewerId following() const { return identity_.following; }
    void follow(ViewerId leader) { identity_.following = leader; }
    [[nodiscard]] v1::Role role() const { return identity_.role; }
    void set_role(v1::Role role) { identity_.role = role; }
    [[nodiscard]] double target_error() const { return target_.error; }  ///< 0: none
    [[nodiscard]] bool has_target() const { return target_.error > 0.0 || target_.seconds > 0.0; }

  private:
    [[nodiscard]] ImageStatistics measured_statistics();
    [[nodiscard]] double since_change_s(TimePoint now) const;
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
    bool paused_ = false;
    bool acknowledged_ = false;
};

}  // namespace raybundle
