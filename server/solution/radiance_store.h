// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"
#include "solution/caustics.h"
#include "solution/first_shot.h"
#include "solution/gpu_scene.h"
#include "solution/zone_balance.h"

namespace raybundle {

/// How far the solution is from the end of its last correction; see solution_statistics.comp.
struct SolutionStatistics {
    double settled = 0.0;  ///< 1 - remaining correction / size of the correction, 0..1
    /// Of the iterate from the mean irradiance, root mean square over patches, relative.
    double distance = 1.0;
};

/// How one bundle joins the solution.
struct BundleUpdate {
    bool scalar = false;       ///< the sums are form factors of one Lambert shooter
    float weight = 1.0F;       ///< of the sample in the mean
    float iterate_age = 0.0F;  ///< samples that the iterate is worth; see ITERATE_EXPONENT
    /// p_j / A_j of a perspective bundle, 1/m²; 0: a parallel one.
    float shooter_density = 0.0F;
    std::uint64_t iteration = 0;
    unsigned scatter = SCATTER_NOT_MEASURED;  ///< which sum of take_scatter() it joins
    glm::vec3 constant_irradiance{0.0F};      ///< that the bundle did not carry, radiance units
};

/// The object-space solution (ch. 7.2): mean irradiance per patch, the iterate that is transferred
/// (main part, and the random representation of what glossy patches send), and the selection
/// probabilities that follow from them.
class RadianceStore {
  public:
    /// zones, and caustics where the scene has any, must outlive this.
    RadianceStore(const GpuScene& scene, ZoneBalance& zones, Caustics* caustics = nullptr);

    void bind() const;
    /// Takes the running bundle's sums into the mean and into the iterate. The bundle's parameters
    /// are bound.
    void update(const BundleUpdate& bundle) const;
    /// An update at this age of the iterate has done nothing, since its bundle had too little room.
    void discard_update(float iterate_age, float weight) const {
        zones_.forget_step(iterate_age, weight);
    }
    /// Whether only perspective bundles are drawn, which never find what lines meet nothing.
    void set_shoots_only(bool shoots_only) { shoots_only_ = shoots_only; }
    /// What all patches send along the parallel bundle whose parameters are bound takes the place
    /// of the radiance, UNIT_RADIANCE, until the next bind(): in glossy scenes, and where objects
    /// have another size at the other place.
    void send_along_bundle(Place place) const;
    /// Objects have moved: makes ready for those that have another size now.
    void follow_sizes();
    /// Objects, maybe with lights, are elsewhere: the light of punctual lights is found anew, and
    /// the means lose weight by how much of all light that is. phase_weight: as for correct().
    void reshoot(float phase_weight);
    /// Before lights or surfaces change: what punctual lights bring by `other`, this store or one
    /// that it takes over, is kept for ChangeStore::set_source(). Nothing where there are none.
    void remember_first_shot(const RadianceStore& other);
    /// After that: it is found anew. The radiance is left to set_source().
    void renew_first_shot();
    /// Share of its weight that a mean of this weight has kept in the last reshoot().
    [[nodiscard]] float kept_share(float weight) const {
        return 1.0F / (1.0F + weight * forgetting_);
    }
    /// Many lamps: looks at some of those that have not been looked at. Between iterations.
    void look_at_lamps() const;
    /// What has been found of them takes effect. Between groups of iterations; bind() comes next.
    void take_lamps(std::uint32_t group);
    /// Of punctual lights, or nothing where the scene has none.
    [[nodiscard]] const FirstShot* first_shot() const {
        return first_shot_ ? &*first_shot_ : nullptr;
    }
    /// An object has turned: its glossy patches keep the directions of their light.
    void turn_gloss(std::uint32_t object, const glm::mat4& now_from_before) const;
    /// From now on bundles carry this radiance (as BINDING_RADIANCE, with the texture on it)
    /// instead of the solution's, until stop_sending_other(). Both must outlive that.
    void send_other(const Buffer& radiance, const Texture2D& texture);
    void stop_sending_other();
    /// How radiance changes within patches follows the present solution; nothing is known of that
    /// before.
    void refresh_slopes() const;
    /// Whether bundles carry it: not where they carry other radiance than the solution's.
    [[nodiscard]] bool sends_slopes() const { return other_ == nullptr; }
    /// Whether the iterate is put to the levels of its zones.
    enum class Levels { found, kept };
    /// New selection probabilities from the present solution.
    void refresh_power(Levels levels = Levels::found) const;
    /// After the first group of iterations: what its bundles could not carry yet, reflected light,
    /// is added to the mean irradiance and the iterate. Receivers add the same to their samples:
    /// the result, at BINDING_COMPLETION.
    [[nodiscard]] Buffer complete_start() const;
    /// Shooting points for the coming perspective bundles; one small readback. numbers: see
    /// solution_shooters.comp; at most 16.
    std::vector<layout::Shooter> choose_shooters(std::span<const glm::vec4> numbers);

    /// Copies the solution of a store for the same patches, with what is left of its last change;
    /// glossy parts stay as they are.
    void adopt(const RadianceStore& other) const;
    /// What is served is from now on kept as it is, apart from what iterations bring: both means
    /// estimate the same light, so that what was kept can be judged (zones/kept_light.h).
    void keep_light();
    /// Brings the mean irradiance up to date, which follows iterations only between their groups.
    void serve() const;
    /// There has been no change: nothing is kept apart.
    void forget_kept() { keeping_ = false; }
    [[nodiscard]] bool keeping() const { return keeping_; }
    /// Remembers the state before a change. unsettled: the last one is still being worked in, and
    /// both are one for statistics().
    void checkpoint(bool unsettled) const;
    /// There has been no change.
    void forget_checkpoint() const { checkpoint_buffer_.clear(); }
    [[nodiscard]] SolutionStatistics statistics() const;
    /// Sums of the squared deviations of bundles from the mean irradiance over patches (luminance),
    /// of parallel and of perspective ones, in one unknown unit. What was measured before weighs
    /// half from now on.
    [[nodiscard]] glm::dvec2 take_scatter() const;
    /// The light has changed: what was measured no longer counts.
    void forget_scatter() const { scatter_.clear(); }
    /// Sums of a reduction over all patches by statistics_groups groups of 256; see its shader.
    [[nodiscard]] glm::dvec4 reduce(const ShaderProgram& program) const;

    /// Reads the counters back and clears them (synchronous, four numbers).
    layout::Counters take_counters() const;
    void clear_counters() const;
    [[nodiscard]] const Buffer& counters() const { return counters_; }
    /// Radiance per patch as it is transferred, radiance units, w = p_j/A_j.
    [[nodiscard]] const Buffer& sent() const { return radiance_; }

    /// Mean irradiance per patch, lx, w = weight; for tests, results and files. Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_irradiance() const;
    /// The same of one patch; small, synchronous.
    [[nodiscard]] glm::vec4 read_irradiance(std::uint32_t patch) const;
    /// Radiance per patch as it is transferred, cd/m². Synchronous.
    [[nodiscard]] std::vector<glm::vec3> read_radiance() const;
    [[nodiscard]] std::size_t bytes() const;
    /// Overwrites what one patch sends (radiance units, w = p_j/A_j); fault injection of tests.
    void write_radiance(std::uint32_t patch, const glm::vec4& value);

  private:
    const GpuScene& scene_;
    ZoneBalance& zones_;
    std::uint32_t patch_count_, block_count_;
    Buffer radiance_, irradiance_, source_, accumulator_, counters_;
    Buffer power_, flux_, balance_, cdf_, shooters_, checkpoint_buffer_, statistics_buffer_;
    unsigned scout_stride_;
    Buffer scatter_;
    float forgetting_ = 0.0F;
    bool shoots_only_ = false;
    std::optional<FirstShot> first_shot_;  // only where the scene has punctual lights
    Buffer gloss_, chain_, sent_;          // only where the scene is glossy
    Caustics* caustics_;                   // null where the scene has none
    Buffer vertex_light_, slopes_;         // see radiance_slope.glsl
    Buffer kept_, since_;                  // from the first change on, see solution_serve.comp
    bool keeping_ = false;
    ShaderProgram serve_;
    Texture2D radiance_texture_, gloss_texture_, sent_texture_;
    Texture2D slope_texture_;
    /// Radiance with the densities of one place; exists from the first change of a size on.
    struct Placed {
        Buffer radiance;
        Texture2D texture;
        ShaderProgram program;
    };
    std::optional<Placed> placed_;
    const Buffer* other_ = nullptr;
    const Texture2D* other_texture_ = nullptr;
    Readback shooter_readback_;
    mutable Readback statistics_readback_, counters_readback_;
    std::optional<ShaderProgram> level_;  // only where patches transmit light
    ShaderProgram update_, power_sum_, power_scan_, power_density_, choose_;
    ShaderProgram complete_, flux_sum_, balance_flux_, gather_at_vertices_, find_slopes_;
    ShaderProgram checkpoint_, statistics_, measure_scatter_, turn_gloss_, send_, forget_;
};

}  // namespace raybundle
