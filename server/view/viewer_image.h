// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bundle/bundle_frame.h"
#include "bundle/traced_picture.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/store/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "view/air_view.h"
#include "view/camera_matrices.h"
#include "view/depth_grid.h"
#include "view/error/confidence.h"
#include "view/error/error_interval.h"
#include "view/error/sample_batches.h"
#include "view/filters/crowded_pixels.h"
#include "view/filters/edge_filter.h"
#include "view/pixel_lamps.h"
#include "view/specular/gloss_rays.h"
#include "view/specular/specular_groups.h"
#include "view/tiles/affected_tiles.h"
#include "view/view_programs.h"

namespace raybundle {

class ContinuedView;

enum class DisplayMode { photo = 0, false_luminance = 1, false_illuminance = 2 };

/// How false colour shows a quantity: three decades below `maximum`, or evenly from 0 on, with
/// lines or without.
struct ColourScale {
    float maximum = 1000.0F;  ///< cd/m² or lx
    float isolines = 0.0F;    ///< unit of the values with lines, cd/m² or lx; 0: none
    bool linear = false;
};

/// How a picture for people shows radiance. exposure: EV.
struct PictureLook {
    DisplayMode mode = DisplayMode::photo;
    float exposure = 0.0F;
    ColourScale scale;
    bool automatic = false;  ///< the picture's own automatic exposure comes to `exposure`
};

/// Estimated error and brightness of what a viewer shows, from its probe pixels (one in 16).
struct ImageStatistics {
    /// Enough samples for an estimate, in this picture and since objects, lights or materials
    /// changed.
    bool known = false;
    /// Taken since camera or scene changed when this was requested; 0: it is of before that.
    std::uint64_t samples = 0;
    double relative_error = 1.0;  ///< estimated relRMSE of luminance
    double error_low = 1.0;       ///< 95 % interval
    double error_high = 1.0;
    double noise = 1.0;  ///< of it what more samples take away, and what they do not: detail finer
                         ///< than the pixels, and where errors are measured whatever else is wrong
    double discretisation = 0.0;
    double mean_log_luminance = 0.0;  ///< mean of ln(luminance / (cd/m²))
    double rms_luminance = 0.0;       ///< cd/m²
    double unresolved_light = 0.0;    ///< cd/m²; that no picture of this scene tells from none
    double faint_light = 0.0;  ///< cd/m²; next to nothing beside the sky, beside what was shown
                               ///< before the last change, or to the eye

    /// Next to no light arrives: so many cd/m² it is at most, as a root mean square. An error
    /// relative to light that may as well be none says nothing.
    [[nodiscard]] std::optional<double> darker_than() const;
    /// The interval ends below a target. Or it never will, and the noise is but half of what the
    /// pixels cannot resolve anyway: more samples bring next to nothing.
    [[nodiscard]] bool meets(double target) const {
        return error_high <= target ||
               (!reachable(discretisation, target) && noise <= 0.5 * discretisation);
    }
};

/// What a pixel of a viewer shows.
struct PixelProbe {
    glm::vec3 position{0.0F};  ///< world, m
    glm::vec3 normal{0.0F};    ///< world, unit, shading
    std::uint32_t object = 0;  ///< index into Scene::objects
    std::uint32_t patch = 0;
    glm::vec3 irradiance{0.0F};            ///< lx
    glm::vec3 radiance{0.0F};              ///< towards the eye, cd/m²
    std::optional<double> relative_error;  ///< standard error, where estimated
};

/// One viewer's picture: geometry buffer, irradiance accumulators at its pixels, and the finished
/// frame. Its pixels are receivers of every bundle.
class ViewerImage : public BundleReceiver {
  public:
    ViewerImage(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs,
                glm::uvec2 size);
    ~ViewerImage() override;

    /// How even its samples are.
    [[nodiscard]] SampleOrder sample_order() const;
    /// Changes what is seen; accumulated irradiance follows its surface points.
    void set_camera(const Camera& camera) { set_camera(camera, size_); }
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
    void rest() { rests_ = true; }
    /// Begins anew, with nothing accumulated.
    void restart(const Camera& camera, glm::uvec2 size);
    /// Pixels that it is drawn with, and what there is room for.
    [[nodiscard]] glm::uvec2 size() const { return size_; }
    [[nodiscard]] glm::uvec2 full_size() const { return full_size_; }
    [[nodiscard]] const Camera& camera() const { return camera_; }
    /// Samples taken since the camera last moved.
    [[nodiscard]] std::uint64_t samples() const { return samples_; }

    /// Whether pixels have the exact light of many lamps; true where there are none.
    [[nodiscard]] bool lamps_exact() const { return !lamps_ || lamps_->exact(); }

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
    void compose(DisplayMode mode, float exposure) { compose(mode, exposure, size_); }
    /// The same, averaged down to a smaller frame.
    void compose(DisplayMode mode, float exposure, glm::uvec2 frame_size) {
        compose(mode, exposure, frame_size, {1.0F / display_factor(exposure), false});
    }
    /// The same, with the scale of false colour.
    void compose(DisplayMode mode, float exposure, glm::uvec2 frame_size, const ColourScale& scale);
    [[nodiscard]] bool finished() const { return frame_readback_->ready(); }
    /// RGBA bytes, row 0 at the top; valid until the next compose().
    std::span<const std::uint8_t> take();
    /// Queues the depths of the picture on a grid with so many columns, for whoever wants them.
    void request_depths(std::uint32_t columns);
    /// Of the depths that were requested last; null before.
    [[nodiscard]] DepthGrid* depths() { return depth_grid_ ? &*depth_grid_ : nullptr; }
    /// Linear radiance of all pixels, cd/m², row 0 at the top: where they are looked at, or once
    /// smoothed() means over their areas. Synchronous.
    std::vector<glm::vec4> read_radiance();
    /// Mean irradiance at the pixels as accumulated (lx, w = weight), row 0 at the bottom.
    /// Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const;

    /// What a pixel (row 0 at the top) shows; nothing where it meets no patch. Small, synchronous.
    [[nodiscard]] std::optional<PixelProbe> probe(glm::uvec2 pixel);
    /// The same of many pixels, in one dispatch.
    [[nodiscard]] std::vector<std::optional<PixelProbe>> probe(std::span<const glm::uvec2> pixels);

    /// Queues the statistics; statistics() returns the newest that has arrived.
    void request_statistics();
    const ImageStatistics& statistics();
    /// Waits for those that were requested last.
    void finish_statistics();
    [[nodiscard]] std::size_t bytes() const;

    // Of the pixels of a ContinuedView alone, whose programs it was made with.

    /// The pixels become these ends of view rays (ContinuedPixel each; must outlive this).
    void refresh_continued(const Buffer& ends, const Camera& camera, float kept_weight);
    /// Writes the radiance (vec4, radiance units) that each pixel shows, in their own order.
    void shade_continued(const Buffer& radiance);
    /// The sums of view_statistics.comp and view_detail.comp as last requested; waits for them.
    struct StatisticsSums {
        glm::dvec4 light{0.0}, detail{0.0}, drift{0.0}, difference{0.0}, batches{0.0};
    };
    StatisticsSums statistics_sums();

    /// Factor from radiance (cd/m²) to the tone curve's input for an exposure in stops.
    static float display_factor(float exposure);
    /// Exposure that puts the mean logarithm of luminance at mid-grey.
    [[nodiscard]] float automatic_exposure() const {
        return automatic_exposure(statistics_.darker_than());
    }
    /// The same where it is known better whether any light arrives, ImageStatistics::darker_than():
    /// what shows none stays dark.
    [[nodiscard]] float automatic_exposure(std::optional<double> darker_than) const;
    /// Whether it has been measured how bright this picture is: a new one knows nothing.
    [[nodiscard]] bool brightness_known() const { return statistics_.rms_luminance > 0.0; }

  private:
    static constexpr std::size_t statistics_groups = 64;  // of 64 invocations
    static constexpr float mid_grey = 0.18F;
    static constexpr float near_share = 1e-4F;  // of the scene's diameter

    static std::size_t pixel_count(glm::uvec2 size) { return std::size_t{size.x} * size.y; }

    void allocate();
    void set_size(glm::uvec2 size);
    [[nodiscard]] PixelRectangle whole_picture() const;
    [[nodiscard]] PixelRectangle rectangle_of_moved() const;
    void bind_old_picture() const;
    void copy_rows(const PixelRectangle& rectangle) const;
    void resolve(const ViewPrograms::Resolve& programs, const PixelRectangle& rectangle,
                 float kept_weight);
    /// What a picture shows against the one before it.
    enum class Shows { another_view, moved_objects, same_surfaces };
    void refresh_geometry(float kept_weight, Shows shows = Shows::another_view);
    void refresh_moved();
    void allocate_gloss();
    void look_into_lobes();
    void forget_lobes() const;
    void allocate_first_shot();
    void shoot_first(Shows shows);
    void shoot_changes(const FirstShot& first_shot);
    void take_back_shot(bool stays, FirstShot::Reach reach);
    void shoot(const FirstShot& first_shot, unsigned pass, const PixelRectangle& part) const;
    void look_at_lamps();
    void look_into_air();
    void see_air();
    void begin_raster(const PixelRectangle& rectangle) const;
    static void end_raster();
    void raster_shifted(const ShaderProgram& program, const glm::vec2& place,
                        const PixelRectangle& rectangle) const;
    void see_pixels(const PixelRectangle& rectangle);
    void see_sub_sample();
    void trace(std::span<const RayGrid> grids, const PixelRectangle& rectangle);
    void trace_pixels(const PixelRectangle& rectangle);
    void raster_pixels(const PixelRectangle& rectangle) const;
    void raster_sub_sample() const;
    void create_pixel_textures();
    void bind_pixels() const;
    void upload_view();
    void check_picture() const;
    void receive(const ViewPrograms::Receive& programs, const Context& context,
                 bool layered = false);
    void mark_crowded(float window_pixel);
    void set_place(const ShaderProgram& program, Place place) const;
    void receive_crowded(const ShaderProgram& program, const Context& context);
    void receive_special(const ViewPrograms::Receive& programs, const Context& context);
    void clear_increments() const;
    void restart_scatter();
    void renew_confidence();
    void tell_confidence();
    void refine_scatter(const Buffer& coarse, glm::uvec2 coarse_size);
    void begin_change();
    void keep_light(bool apart);
    void join_kept();
    void interpolate_vertices();
    void evaluate(const StatisticsSums& sums);
    void note_light(double mean);
    [[nodiscard]] double noise_factor(const StatisticsSums& sums) const;
    [[nodiscard]] SuspectedError suspected_error(const StatisticsSums& sums) const;
    void measure_detail();
    [[nodiscard]] ViewerImage* continued() const;
    [[nodiscard]] float near_distance() const {
        return std::max(near_share * scene_.diameter(), camera_.near);
    }
    [[nodiscard]] PixelProbe from_pick(const layout::PickResult& pick) const;

    const GpuScene& scene_;
    const RadianceStore& store_;
    const ViewPrograms& programs_;
    glm::uvec2 full_size_;  // of the buffers
    glm::uvec2 size_;       // in use of it
    unsigned grid_ = 1;     // a picture's pixel is the mean of grid x grid, see refine()
    Camera camera_;
    layout::ViewParameters parameters_{};
    struct OldPicture {  ///< what was accumulated in it is reprojected
        glm::mat4 clip_from_world{1.0F};
        glm::uvec2 size{0};
        glm::vec3 eye{0.0F};
        float common_weight = 0.0F;
        glm::vec3 constant{0.0F};
    } old_;
    std::size_t frame_bytes_ = 0;
    bool has_picture_ = false;  // accumulators that can be reprojected
    std::uint64_t samples_ = 0;
    bool rests_ = false;                   // see rest()
    std::uint64_t scatter_samples_ = 0;    // since the sums of their scatter began
    std::uint64_t detail_samples_ = 0;     // of them when the detail was measured last
    std::uint64_t requested_samples_ = 0;  // of them when statistics were requested last
    ImageStatistics statistics_;
    SampleBatches batches_;
    double noise_factor_ = 1.0;    // see noise_factor(), by the last statistics
    double sampling_noise_ = 1.0;  // of the last statistics: noise without what is suspected
    double error_before_ = 1.0;    // relative, of what was shown before the sums of scatter began
    struct LightThen {
        std::uint64_t samples = 0;
        double light = 0.0;      // mean luminance, radiance units
    } earlier_, latest_;         // see note_light()
    double light_before_ = 0.0;  // cd/m², root mean square before the last change; 0: none yet

    Buffer view_, pixels_, old_pixels_, irradiance_, old_irradiance_, delta_, scatter_;
    Buffer kept_;           // of pixels over the last change, see view_keep.comp
    bool keeping_ = false;  // some of them have any
    Texture2D kept_texture_;
    Buffer vertex_irradiance_, statistics_buffer_, frame_;
    std::optional<Confidence> confidence_;      // always
    std::optional<EdgeFilter> edges_;           // always
    std::optional<CrowdedPixels> crowded_;      // always
    std::optional<DepthGrid> depth_grid_;       // only for who asks for depths
    std::optional<AffectedTiles> affected_;     // always
    std::optional<SpecularGroups> specular_;    // only where the scene is specular
    std::unique_ptr<ContinuedView> continued_;  // only where it has mirrors or glass
    const Buffer* ends_ = nullptr;              // of a ContinuedView's pixels
    Buffer gloss_, old_gloss_, gloss_delta_;    // only where it is glossy
    Buffer first_shot_;                         // only where it has punctual lights
    Buffer shot_rest_;                          // likewise, but of many: see shot_pass.glsl
    std::uint64_t shot_version_ = 0;            // of the first shot that the pixels have
    bool shot_taken_back_ = false;              // what a move can reach of it
    Texture2D first_shot_texture_;
    std::optional<GlossRays> gloss_rays_;  // only where lobes are narrow
    std::optional<PixelLamps> lamps_;      // only where these are many
    std::optional<AirView> air_;           // only where it scatters, and not behind mirrors
    unsigned air_samples_ = 0;             // of the running group of iterations
    Texture2D gloss_texture_, old_gloss_texture_;
    std::optional<TracedPicture> traced_;  // only where rays find what pixels see
    Texture2D surface_ids_, depths_;
    Texture2D pixel_texture_, old_pixel_texture_, irradiance_texture_, old_irradiance_texture_;
    Texture2D vertex_irradiance_texture_;
    Framebuffer framebuffer_;
    std::optional<Readback> frame_readback_, statistics_readback_;
};

}  // namespace raybundle
