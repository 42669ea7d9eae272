// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/direct/first_shot.h"
#include "solution/geometry/gpu_scene.h"
#include "solution/specular/caustics.h"
#include "solution/store/gloss_samples.h"
#include "solution/store/kept_mean.h"
#include "solution/store/radiance_slopes.h"
#include "solution/store/sent_radiance.h"
#include "solution/store/shooter_selection.h"
#include "solution/store/solution_measures.h"
#include "solution/store/zone_balance.h"

namespace raybundle {

/// How one bundle joins the solution.
struct BundleUpdate {
    bool scalar = false;       ///< the sums are form factors of one Lambert shooter
    bool from_point = false;   ///< all light came through one point; else from one direction
    float weight = 1.0F;       ///< of the sample in the mean
    float iterate_age = 0.0F;  ///< samples that the iterate is worth; see ITERATE_EXPONENT
    /// p_j / A_j of a shooter, 1/m²; 0: there is none.
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
    /// After that, for one pass: the patches' light by caustics, which otherwise is at vertices.
    void bind_caustics_of_patches() const;
    /// Null where the air is clear.
    [[nodiscard]] const ScatteredLight* air() const {
        return caustics_ != nullptr ? caustics_->air() : nullptr;
    }
    /// Takes the running bundle's sums into the mean and into the iterate. The bundle's parameters
    /// are bound.
    void update(const BundleUpdate& bundle) const;
    /// An update at this age of the iterate has done nothing, since its bundle had too little room.
    void discard_update(float iterate_age, float weight) const {
        zones_.forget_step(iterate_age, weight);
    }
    /// Whether only perspective bundles are drawn, which never find what lines meet nothing.
    void set_shoots_only(bool shoots_only) { selection_.set_shoots_only(shoots_only); }
    /// What all patches send along the parallel bundle whose parameters are bound takes the place
    /// of the radiance, UNIT_RADIANCE, until the next bind(): in glossy scenes, and where objects
    /// have another size at the other place.
    void send_along_bundle(Place place) const { sent_.send_along_bundle(scene_, place); }
    /// Objects have moved: makes ready for those that have another size now.
    void follow_sizes() { sent_.follow_sizes(scene_); }
    /// Objects will be moved thus, and reshoot() comes afterwards.
    void begin_moves(std::span<const ObjectMove> moves);
    /// Lights have changed, and renew_first_shot() comes next.
    void begin_lights();
    /// Objects, maybe with lights, are elsewhere: the light of punctual lights is found anew, and
    /// the means lose weight by how much of all light that is. phase_weight: as for correct().
    void reshoot(float phase_weight);
    /// Before lights or surfaces change: what punctual lights bring by `other`, this store or one
    /// that it takes over, is kept for ChangeStore::set_source(). Nothing where there are none.
    void remember_first_shot(const RadianceStore& other);
    /// After that: what has changed of it is found anew. The radiance is left to set_source().
    /// reflecting: materials whose reflection is another.
    void renew_first_shot(std::span<const std::uint32_t> reflecting);
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
    void turn_gloss(std::uint32_t object, const glm::mat4& now_from_before) const {
        gloss_.turn(object, now_from_before);
    }
    /// From now on bundles carry this radiance (as BINDING_RADIANCE, with the texture on it)
    /// instead of the solution's, until stop_sending_other(). Both must outlive that.
    void send_other(const Buffer& radiance, const Texture2D& texture);
    void stop_sending_other();
    /// How radiance changes within patches follows the present solution; nothing is known of that
    /// before.
    void refresh_slopes() const { slopes_.refresh(scene_); }
    /// Whether bundles carry it: not where they carry other radiance than the solution's.
    [[nodiscard]] bool sends_slopes() const { return !sent_.sends_other(); }
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
    std::vector<layout::Shooter> choose_shooters(std::span<const glm::vec4> numbers) {
        return selection_.choose(numbers, scene_.diameter());
    }

    /// Copies the solution of a store for the same patches, with what is left of its last change;
    /// glossy parts stay as they are. This store may have patches of more objects, see
    /// scene/mesh/mesh_growth.h: these stay as they are.
    void adopt(const RadianceStore& other);
    /// Mean irradiance that own samples have brought since the last change, radiance units, w =
    /// weight; null where that is not known.
    [[nodiscard]] const Buffer* own_light() const { return kept_.own(light_.irradiance); }
    /// What other workers' samples have brought since the last change is served with what own ones
    /// do, until the next change. others: of each patch, as own_light(). sequences: see
    /// KeptMean::merge().
    void merge(std::span<const glm::vec4> others, float sequences);
    /// Of so many independent sequences of bundles the mean irradiance is made.
    [[nodiscard]] float sequences() const { return kept_.sequences(); }
    /// What is served is from now on kept as it is, apart from what iterations bring: both means
    /// estimate the same light, so that what was kept can be judged (zones/kept_light.h).
    void keep_light();
    /// Brings the mean irradiance up to date, which follows iterations only between their groups.
    void serve() const;
    /// There has been no change: nothing is kept apart.
    void forget_kept() { kept_.forget(); }
    [[nodiscard]] bool keeping() const { return kept_.keeping(); }
    /// Remembers the state before a change. unsettled: the last one is still being worked in, and
    /// both are one for statistics().
    void checkpoint(bool unsettled) const { measures_.checkpoint(unsettled); }
    /// There has been no change.
    void forget_checkpoint() const { measures_.forget_checkpoint(); }
    [[nodiscard]] SolutionStatistics statistics() const { return measures_.statistics(); }
    /// Sums of the squared deviations of bundles from the mean irradiance over patches (luminance),
    /// of parallel and of perspective ones, in one unknown unit. What was measured before weighs
    /// half from now on.
    [[nodiscard]] glm::dvec2 take_scatter() const { return measures_.take_scatter(); }
    /// The light has changed: what was measured no longer counts.
    void forget_scatter() const { measures_.forget_scatter(); }
    /// See SolutionMeasures::reduce().
    [[nodiscard]] glm::dvec4 reduce(const ShaderProgram& program) const {
        return measures_.reduce(program);
    }

    /// Reads the counters back and clears them (synchronous, four numbers).
    layout::Counters take_counters() const { return measures_.take_counters(); }
    void clear_counters() const { measures_.clear_counters(); }
    [[nodiscard]] const Buffer& counters() const { return measures_.counters(); }
    /// Radiance per patch as it is transferred, radiance units, w = p_j/A_j.
    [[nodiscard]] const Buffer& sent() const { return light_.radiance; }

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
    /// Per patch, written by every update.
    struct Light {
        explicit Light(std::size_t patch_count);

        Buffer radiance;    ///< as it is transferred
        Buffer irradiance;  ///< the mean
        Buffer iterate;     ///< irradiance of the iterate
        Buffer sums;        ///< of the running bundle, fixed-point
    };

    const GpuScene& scene_;
    ZoneBalance& zones_;
    std::uint32_t patch_count_;
    Light light_;
    SentRadiance sent_;
    GlossSamples gloss_;
    RadianceSlopes slopes_;
    ShooterSelection selection_;
    SolutionMeasures measures_;
    KeptMean kept_;
    std::optional<FirstShot> first_shot_;      // only where the scene has punctual lights
    std::vector<glm::vec4> reflected_before_;  // of it, before a move
    Caustics* caustics_;                       // null where the scene has none
    float forgetting_ = 0.0F;
    std::optional<ShaderProgram> level_;  // only where patches transmit light
    ShaderProgram update_, complete_, forget_;
};

}  // namespace raybundle
