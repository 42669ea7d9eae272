// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solution/store/radiance_store.h"
#include "transport/bundle_receiver.h"
#include "view/error/confidence.h"
#include "view/error/pixel_sums.h"
#include "view/filters/crowded_pixels.h"
#include "view/pixels/picture_view.h"
#include "view/pixels/pixel_buffers.h"
#include "view/pixels/pixel_first_shot.h"
#include "view/pixels/vertex_irradiance.h"
#include "view/specular/gloss_rays.h"
#include "view/specular/specular_groups.h"
#include "view/tiles/affected_tiles.h"
#include "view/view_programs.h"

namespace raybundle {

class VisibleSurfaces;

/// The pixels of a picture as receivers of every bundle: those of a viewer, or those behind mirrors
/// and glass, which SpecularView finds. It knows what they show and have gathered; whose picture it
/// is makes frames and statistics of that.
class PixelAccumulator {
  public:
    using Context = BundleReceiver::Context;

    PixelAccumulator(const GpuScene& scene, const RadianceStore& store,
                     const ViewPrograms& programs, glm::uvec2 size);

    /// Begins anew with another size; what is known of the whole picture's confidence goes on.
    void allocate(glm::uvec2 size);
    /// Draws with fewer pixels than there is room for, or as many.
    void set_size(glm::uvec2 size);
    [[nodiscard]] glm::uvec2 size() const { return size_; }
    [[nodiscard]] const layout::ViewParameters& view() const { return view_.values; }
    /// Accumulators that can be reprojected.
    [[nodiscard]] bool has_picture() const { return progress_.has_picture; }
    /// Taken since the pixels last showed something else.
    [[nodiscard]] std::uint64_t samples() const { return progress_.samples; }
    /// The same since the sums of their scatter began.
    [[nodiscard]] std::uint64_t scatter_samples() const { return progress_.scatter_samples; }
    /// How even the samples are.
    [[nodiscard]] SampleOrder sample_order() const;
    /// Whether some light is of before the last change.
    [[nodiscard]] bool keeps_light() const { return progress_.keeps_light; }
    [[nodiscard]] bool lamps_exact() const { return !shot_ || shot_->exact(); }
    /// The camera will not move again: what takes a while is done at once.
    void rest() { progress_.rests = true; }
    [[nodiscard]] bool rests() const { return progress_.rests; }
    void forget_confidence() { confidence_->forget(); }

    // What the pixels show.

    /// Looks from another place from now on: the present picture is the one that renew() takes
    /// light over from. whole: size of the picture that the camera sees, pixels. grid: see
    /// ViewerImage::refine(). near: distance of its plane, m.
    void look_from(const Camera& camera, glm::uvec2 whole, unsigned grid, float near);
    void upload_view() {
        view_.values.gain.z = store_.sequences();
        view_.upload();
    }
    /// Makes the pixels of what look_from() sees; light that is kept counts with this share of its
    /// weight.
    void renew(const VisibleSurfaces& surfaces, float kept_weight, Shows shows);
    /// Objects have moved before a camera that rests: only a rectangle shows something else.
    void renew_moved(const VisibleSurfaces& surfaces, const PixelRectangle& rectangle);
    /// The pixels are these ends of view rays (ContinuedPixel each; must outlive this).
    void show_ends(const Buffer& ends, const Camera& camera, float near, float kept_weight);
    /// Draws what it shows with `factor` times as many pixels along each edge. renew: makes those,
    /// of what the old ones have.
    template <typename Renew>
    void refine(unsigned factor, const Renew& renew) {
        Coarse coarse = begin_refining(factor);
        renew();
        end_refining(std::move(coarse), factor);
    }

    // Samples, as BundleReceiver says.

    void begin_sample();
    void receive_hemicube(const Context& context);
    void receive_layers(const Context& context);
    void receive_planes(const Context& context);
    void receive_opening(const Context& context);
    void discard_sample(const Context& context);
    void complete_start();

    // Changes, as BundleReceiver says.

    /// What was known is of another scene.
    void begin_change();
    /// stays: what the pixels show does.
    void take_back_shot(bool stays, FirstShot::Reach reach);
    /// The pixels show the same, and have other samples.
    void restart_samples();
    void clear_increments() const { buffers_->clear_increments(); }
    void plan_differences(std::span<const BundleRays> bundles, std::span<const Bounds> boxes);
    /// redrawn: renew() has been called since.
    void begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                        bool redrawn);
    void scale_special(float factor);
    void end_special(float bundles_noise, float max_weight);

    // What the pixels say.

    /// Binds the pixels and their view.
    void bind() const;
    void bind_with_solution() const;
    /// Interpolates the present light of patches between vertices, for what follows.
    /// Binds the pixels and the solution.
    void light_vertices() const;
    /// Uploads ViewParameters::display with the rest.
    void set_display(const glm::vec4& display);
    /// Writes the radiance (vec4, in units of set_display()) that each pixel shows, rows from the
    /// top.
    void write_radiance(const Buffer& target) const;
    /// Sums of the statistics of light_vertices(); readback: sums().request().
    void sum_statistics(double error_before);
    [[nodiscard]] PixelSums& sums() { return sums_; }
    /// Mean irradiance as accumulated (lx, w = weight), row 0 at the bottom. Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct OldPicture {  ///< what was accumulated in it is reprojected
        glm::mat4 clip_from_world{1.0F};
        glm::uvec2 size{0};
        glm::vec3 eye{0.0F};
        float common_weight = 0.0F;
        glm::vec3 constant{0.0F};
    };
    struct Coarse {  ///< what a refined picture keeps of the one before
        glm::uvec2 size{0};
        glm::vec4 weights{0.0F};
        std::uint64_t scatter_samples = 0;
        Buffer scatter;
        PixelBuffers::Picture spare;  // room for a picture of the new size
        Confidence confidence;
    };
    struct Lists {  ///< of the pixels that some passes go over, the others not
        Lists(glm::uvec2 size, bool specular);
        CrowdedPixels crowded;
        AffectedTiles affected;
        std::optional<SpecularGroups> specular;  ///< only where the scene is
    };
    struct Progress {
        std::uint64_t samples = 0;
        std::uint64_t scatter_samples = 0;
        bool has_picture = false;
        bool keeps_light = false;
        bool rests = false;
    };
    Coarse begin_refining(unsigned factor);
    void end_refining(Coarse coarse, unsigned factor);
    void renew_all(const VisibleSurfaces* surfaces, float kept_weight, Shows shows);
    void remember_picture(glm::uvec2 size);
    void resolve(const ViewPrograms::Resolve& programs, const PixelRectangle& rectangle,
                 float kept_weight);
    void shoot(Shows shows);
    void look_at_lamps();
    void look_into_lobes();
    void forget_lobes() const;
    void restart_scatter();
    void refine_scatter(const Buffer& coarse, glm::uvec2 coarse_size);
    void tell_confidence();
    void keep_light(bool apart);
    void join_kept();
    void set_place(const ShaderProgram& program, Place place) const;
    void receive(const ViewPrograms::Receive& programs, const Context& context,
                 bool layered = false);
    void receive_special(const ViewPrograms::Receive& programs, const Context& context);
    void count_sample(const Context& context, int sign);
    void mark_crowded(float window_pixel);
    void receive_crowded(const ShaderProgram& program, const Context& context);

    const GpuScene& scene_;
    const RadianceStore& store_;
    const ViewPrograms& programs_;
    glm::uvec2 size_{0};  // in use of the buffers
    PictureView view_;
    OldPicture old_;
    std::optional<PixelBuffers> buffers_;  // always
    VertexIrradiance vertex_irradiance_;
    PixelSums sums_;
    std::optional<Confidence> confidence_;  // always
    std::optional<Lists> lists_;            // always
    std::optional<GlossRays> gloss_rays_;   // only where lobes are narrow
    std::optional<PixelFirstShot> shot_;    // only where the scene has punctual lights
    const Buffer* ends_ = nullptr;          // of view rays, see show_ends()
    Progress progress_;
};

}  // namespace raybundle
