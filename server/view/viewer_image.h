// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "solution/store/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "view/air_view.h"
#include "view/error/picture_error.h"
#include "view/filters/edge_filter.h"
#include "view/frame_composer.h"
#include "view/pixels/pixel_accumulator.h"
#include "view/pixels/pixel_probe.h"
#include "view/pixels/visible_surfaces.h"
#include "view/shown_luminaires.h"
#include "view/specular/specular_view.h"
#include "view/view_programs.h"

namespace raybundle {

/// One viewer's picture. Its pixels, and those behind mirrors and glass, receive every bundle;
/// frames, statistics and single pixels are made of what they have by then.
class ViewerImage : public BundleReceiver {
  public:
    ViewerImage(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs,
                glm::uvec2 size);

    /// How even its samples are.
    [[nodiscard]] SampleOrder sample_order() const { return pixels_.sample_order(); }
    /// Changes what is seen; accumulated irradiance follows its surface points.
    void set_camera(const Camera& camera) { set_camera(camera, size()); }
    /// The same, drawn with fewer pixels than full_size(), or as many: quickly, for a picture that
    /// moves. What it shows reaches as far. Between special phases only.
    void set_camera(const Camera& camera, glm::uvec2 size);
    /// The same with another full size, where nothing is kept.
    void set_view(const Camera& camera, glm::uvec2 size);
    /// Draws the same view with `factor` times as many pixels along each edge, which are from now
    /// on parts of the pixels that there were: they are looked at in staggered places
    /// (view/filters/sub_samples.h), and what is said of the error is that of means over them. What
    /// is accumulated goes along, and so does what its samples say of their scatter; what is seen
    /// in mirrors and through glass begins anew. For pictures of full size, between special phases.
    void refine(unsigned factor);
    /// The camera will not move again: what makes the picture better and takes a while is done at
    /// once.
    void rest() { pixels_.rest(); }
    /// Begins anew, with nothing accumulated.
    void restart(const Camera& camera, glm::uvec2 size);
    /// Pixels that it is drawn with, and what there is room for.
    [[nodiscard]] glm::uvec2 size() const { return pixels_.size(); }
    [[nodiscard]] glm::uvec2 full_size() const { return full_size_; }
    [[nodiscard]] const Camera& camera() const { return camera_; }
    /// Samples taken since the camera last moved.
    [[nodiscard]] std::uint64_t samples() const { return pixels_.samples(); }

    /// Whether pixels have the exact light of many lamps; true where there are none.
    [[nodiscard]] bool lamps_exact() const { return pixels_.lamps_exact(); }

    /// Antialiasing of a picture whose camera rests, in slices of one raster each. Frames of full
    /// size and radiance have smooth edges once it is complete, until camera, size or an object
    /// changes. Does one slice; false where nothing is left to do.
    bool smooth_step();
    void smooth() {
        while (smooth_step()) {
        }
    }
    [[nodiscard]] bool smoothed() const { return edges_->complete(); }

    // BundleReceiver
    void begin_sample() override;
    void receive_hemicube(const Context& context) override;
    void receive_layers(const Context& context) override;
    void receive_planes(const Context& context) override;
    void receive_opening(const Context& context) override;
    void discard_sample(const Context& context) override;
    void complete_start() override;
    void begin_moves() override;
    void begin_lights() override;
    void begin_special() override;
    void plan_differences(std::span<const BundleRays> bundles,
                          std::span<const Bounds> boxes) override;
    void begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                        bool redraw) override;
    void scale_special(float factor) override;
    void end_special(float bundles_noise, float most_weight) override;

    /// Composes the picture with an exposure (EV: display white is 2^-exposure * a mid-grey scale;
    /// see display_factor()) and queues its readback. finished() and take() deliver it.
    void compose(DisplayMode mode, float exposure) { compose(mode, exposure, size()); }
    /// The same, averaged down to a smaller frame.
    void compose(DisplayMode mode, float exposure, glm::uvec2 frame_size) {
        compose(mode, exposure, frame_size, {1.0F / display_factor(exposure), false});
    }
    /// The same, with the scale of false colour.
    void compose(DisplayMode mode, float exposure, glm::uvec2 frame_size, const ColourScale& scale);
    [[nodiscard]] bool finished() const { return composer_.finished(); }
    /// RGBA bytes, row 0 at the top; valid until the next compose().
    std::span<const std::uint8_t> take() { return composer_.take(); }
    /// Queues the depths of the picture on a grid with so many columns, for whoever wants them.
    void request_depths(std::uint32_t columns);
    /// Of the depths that were requested last; null before.
    [[nodiscard]] DepthGrid* depths() { return composer_.depths(); }
    /// Linear radiance of all pixels, cd/m², row 0 at the top: where they are looked at, or once
    /// smoothed() means over their areas. Synchronous.
    std::vector<glm::vec4> read_radiance();
    /// Mean irradiance at the pixels as accumulated (lx, w = weight), row 0 at the bottom.
    /// Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const {
        return pixels_.read_irradiance();
    }

    /// What a pixel (row 0 at the top) shows; nothing where it meets no patch. Small, synchronous.
    [[nodiscard]] std::optional<PixelProbe> probe(glm::uvec2 pixel) {
        return probe(std::span(&pixel, 1)).front();
    }
    /// The same of many pixels, in one dispatch.
    [[nodiscard]] std::vector<std::optional<PixelProbe>> probe(std::span<const glm::uvec2> pixels);

    /// Queues the statistics; statistics() returns the newest that has arrived.
    void request_statistics();
    const ImageStatistics& statistics();
    /// Waits for those that were requested last.
    void finish_statistics();
    [[nodiscard]] std::size_t bytes() const;

    /// Factor from radiance (cd/m²) to the tone curve's input for an exposure in stops.
    static float display_factor(float exposure) { return FrameComposer::display_factor(exposure); }
    /// Exposure that puts the mean logarithm of luminance at mid-grey.
    [[nodiscard]] float automatic_exposure() const {
        return automatic_exposure(error_.statistics().darker_than());
    }
    /// The same where it is known better whether any light arrives, ImageStatistics::darker_than():
    /// what shows none stays dark.
    [[nodiscard]] float automatic_exposure(std::optional<double> darker_than) const {
        return error_.automatic_exposure(darker_than);
    }
    /// Whether it has been measured how bright this picture is: a new one knows nothing.
    [[nodiscard]] bool brightness_known() const { return error_.statistics().rms_luminance > 0.0; }

  private:
    void allocate(glm::uvec2 size);
    void refresh_geometry(float kept_weight, Shows shows = Shows::another_view);
    void refresh_moved();
    void begin_change();
    void look_into_air();
    void see_air();
    void see_luminaires();
    void bind_surroundings() const;
    void light_pixels();
    void measure_detail();
    void check_picture() const;
    [[nodiscard]] VisibleSurfaces::Look look() const;
    [[nodiscard]] float near_distance() const;
    /// null where the picture shows no mirrors or glass.
    [[nodiscard]] PixelAccumulator* behind_mirrors() {
        return specular_view_ ? specular_view_->pixels() : nullptr;
    }

    const GpuScene& scene_;
    const RadianceStore& store_;
    const ViewPrograms& programs_;
    glm::uvec2 full_size_;  // that there is room for, pixels
    unsigned grid_ = 1;     // a picture's pixel is the mean of grid x grid, see refine()
    Camera camera_;
    PixelAccumulator pixels_;
    std::optional<SpecularView> specular_view_;  // only where the scene has mirrors or glass
    std::optional<AirView> air_;                 // only where it scatters
    std::optional<ShownLuminaires> luminaires_;  // only where the scene may have any
    unsigned air_samples_ = 0;                   // of the running group of iterations
    std::optional<VisibleSurfaces> surfaces_;    // always
    std::optional<EdgeFilter> edges_;            // always
    FrameComposer composer_;
    PictureError error_;
};

}  // namespace raybundle
