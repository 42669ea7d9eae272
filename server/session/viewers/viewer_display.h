// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "raybundle.pb.h"
#include "session/viewers/exposure_follow.h"
#include "view/viewer_image.h"

namespace raybundle {

/// How a viewer wants its picture shown: as a photo or in false colours, how bright, by which
/// scale.
class ViewerDisplay {
  public:
    void set(const v1::SetDisplay& message);

    [[nodiscard]] DisplayMode mode() const { return mode_; }
    /// EV of the next frame, which comes so long after the last one: exposure follows the picture
    /// slowly, so that the picture neither pumps nor jumps. The first frame is right at once.
    float next_exposure(const ViewerImage& image, const ImageStatistics& statistics,
                        double since_frame_s);
    [[nodiscard]] ColourScale colour_scale(float exposure) const;
    /// Of the frames that are shown now. image: null where the viewer has none.
    [[nodiscard]] PictureLook look(const ViewerImage* image) const;

  private:
    DisplayMode mode_ = DisplayMode::photo;
    float exposure_offset_ = 0.0F;
    bool auto_exposure_ = true;
    float scale_maximum_ = 0.0F;  // 0: follows the exposure
    bool isolines_ = false;
    float scale_unit_ = 1.0F;  // lx or cd/m²
    bool linear_scale_ = false;
    ShownExposure shown_;
};

}  // namespace raybundle
