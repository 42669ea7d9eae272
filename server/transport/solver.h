// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solution/geometry/gpu_scene.h"
#include "solution/store/radiance_store.h"
#include "transport/carried_light.h"
#include "transport/iteration_schedule.h"
#include "transport/scene_change.h"
#include "transport/special_phase.h"
#include "transport/strategy_mix.h"
#include "transport/transfer.h"

namespace raybundle {

struct SolverSettings {
    std::uint64_t seed = 1;
    StrategyProbabilities probabilities;
    BundleResolution coarse{256, 400};  ///< first iterations, and special phases
    BundleResolution fine{512, 800};
    /// Bundles stay coarse for so many iterations, and then until the noise of the patches is below
    /// fine_noise, but eight times as many at most: bundles are cheap while noise hides what their
    /// resolution does.
    std::uint64_t coarse_iterations = 768;
    float fine_noise = 0.02F;
    float density_error = 1.0F;  ///< fault injection of tests: factor of the densities
    /// Iterations planned, M of eq. 5.6: perspective bundles trade bias for noise, most of all
    /// without parallel ones, which bound their contributions anyway. 0: unbiased.
    std::uint64_t noise_horizon = 0;
    /// Patches send the average of what they reflected (ch. 4.4: separated main part). Otherwise
    /// what the last bundle brought, as in plain stochastic iteration; to compare.
    bool main_part = true;
    /// Bundles carry what radiance is beyond the mean radiance (ch. 5.5), where GpuScene allows it.
    /// With perspective bundles alone only closed scenes have what nothing is missing from.
    bool constant_radiance = false;
    /// Single rays follow light by mirrors and glass (effects plan: `caustics`); false: to measure
    /// what they cost.
    bool caustics = true;
    /// Bundles that start where zones are open to the sky, beside those of adapted probabilities
    /// (zones/sky_openings.h).
    bool openings = true;
    /// Glossy shooters send through some faces of their hemicubes only (ch. 5.2).
    bool random_faces = false;
    /// Probabilities follow the kinds of light and what is measured, see suited_to() and
    /// StrategyMix.
    bool adapt_probabilities = true;
    /// Where there are any, the first iterations have these, and while samples gain weight they
    /// become the others (ch. 7.1.3: perspective bundles first, parallel ones refine).
    std::optional<StrategyProbabilities> first_probabilities;
    unsigned planes_per_direction = 1;  ///< plane bundles in a row that share a direction
    SpecialSettings special;            ///< how changes are worked in
};

/// Stochastic iteration of the object-space solution: one bundle at a time to patches and
/// receivers, and the correction of the solution when an object moves. Deterministic for a seed: no
/// clock.
class Solver {
  public:
    Solver(const Scene& scene, const PatchMesh& mesh, const SolverSettings& settings = {});

    /// One iteration, or one slice of a running special phase.
    void step(std::span<BundleReceiver* const> receivers);

    /// Starts one special iteration phase for objects at new places, MOST_MOVED at most (throws
    /// std::invalid_argument for more); step()
    /// carries it through. Requires !correcting().
    void move_objects(std::span<const ObjectMove> moves,
                      std::span<BundleReceiver* const> receivers);
    /// The same for one. world_from_object is in the scene's own world.
    void move_object(std::uint32_t object, const glm::mat4& world_from_object,
                     std::span<BundleReceiver* const> receivers);
    /// Carries through the move of an object to where it is, before any change: nothing changes,
    /// but a driver that compiles shaders at their first use has done so.
    void rehearse_move(std::uint32_t object, const glm::mat4& world_from_object,
                       std::span<BundleReceiver* const> receivers);
    /// Lights or materials have changed in the scene: gives their patches their colours in the
    /// mesh, and starts the special iteration phase. Requires !correcting(), covers() of each, and
    /// the scene and mesh that the solver was made of. reflecting: those of the materials that
    /// reflect otherwise, the rest emits otherwise only.
    void change_surfaces(const Scene& scene, PatchMesh& mesh,
                         std::span<const std::uint32_t> materials,
                         std::span<const std::uint32_t> reflecting,
                         std::span<BundleReceiver* const> receivers);
    /// Whether the shaders of this solver can show a material as it is in the scene now; else a new
    /// solver takes over, see take_over().
    [[nodiscard]] bool covers(const Scene& scene, std::uint32_t material) const {
        return scene_.covers(scene, material);
    }
    /// Likewise of its lights.
    [[nodiscard]] bool covers_lights(const Scene& scene) const {
        return scene_.covers_lights(scene);
    }
    /// Goes on where another solver is that does not cover some materials as they are now, of the
    /// scene and mesh that this one was made of: keeps its mean irradiance and starts the special
    /// phase for what these reflect otherwise. Requires !other.correcting().
    void take_over(const Solver& other, std::span<const std::uint32_t> reflecting,
                   std::span<BundleReceiver* const> receivers);
    /// Goes on where another solver is whose scene has had objects added since, all of them removed
    /// still, and mesh the same patches besides: light is as it was. scene, mesh: that this solver
    /// was made of. Requires !other.correcting().
    void continue_from(const Solver& other, const Scene& scene, const PatchMesh& mesh);
    [[nodiscard]] bool correcting() const { return phase_.has_value(); }

    /// Iterations since the last change, or since the start.
    [[nodiscard]] std::uint64_t samples() const {
        return changes_ > 0 ? since_change_ : iterations_;
    }
    /// Mean irradiance that own iterations have brought since then, see RadianceStore::own_light(),
    /// once what the iterate had before has next to no weight in it; null before, and where it is
    /// not known.
    [[nodiscard]] const Buffer* own_light() const {
        return !correcting() && static_cast<float>(samples()) >= 2.0F * transient_
                   ? store_.own_light()
                   : nullptr;
    }
    /// How further changes are worked in.
    void set_special(const SpecialSettings& special) { settings_.special = special; }
    /// Bundles of the last special phase's first stage, 0 before any.
    [[nodiscard]] unsigned special_bundles() const { return special_bundles_; }

    /// Receivers may be exchanged now: no group of iterations is under way.
    [[nodiscard]] bool between_groups() const { return group_next_ >= group_.size(); }
    /// Of the last iteration; nothing after a slice of a special phase.
    [[nodiscard]] std::optional<Strategy> last_strategy() const { return last_strategy_; }

    [[nodiscard]] std::uint64_t iterations() const { return iterations_; }
    /// Perspective bundles so far, and those of them that were shot from emitters (ch. 5.6).
    struct Shots {
        std::uint64_t all = 0, from_emitters = 0;
    };
    [[nodiscard]] const Shots& shots() const { return shots_; }
    /// Of the strategies, at present.
    [[nodiscard]] const StrategyProbabilities& probabilities() const { return probabilities_; }
    [[nodiscard]] const GpuScene& scene() const { return scene_; }
    [[nodiscard]] RadianceStore& store() { return store_; }
    [[nodiscard]] const RadianceStore& store() const { return store_; }
    [[nodiscard]] const BundleResolution& resolution() const;
    /// Estimated standard error of the patches' irradiance, root mean square, relative: from how
    /// far the iterate, a mean over few samples, is from the mean of all. Too small in the first
    /// few hundred iterations, whose samples avoid each other.
    [[nodiscard]] double noise() const;
    /// State of the correction since loading or the last change; refreshed every few iterations.
    [[nodiscard]] const SolutionStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::uint64_t non_finite() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Planned {
        IterationSample sample;
        layout::Shooter shooter{};
    };

    void plan_group();
    void refine();
    void refresh_slopes();
    void complete_start(std::span<BundleReceiver* const> receivers);
    [[nodiscard]] bool start_is_completed() const;
    void restart_caustics();
    [[nodiscard]] bool noise_is_low() const;
    void run(const Planned& planned, unsigned slot, std::span<BundleReceiver* const> receivers);
    void run_perspective(const Planned& planned, TransferSettings& settings,
                         std::span<BundleReceiver* const> receivers);
    void run_opening(const IterationSample& sample, const TransferSettings& settings,
                     std::span<BundleReceiver* const> receivers);
    [[nodiscard]] TransferSettings transfer_settings() const;
    [[nodiscard]] BundleUpdate update_of(const TransferSettings& settings) const;
    void refresh_openings();
    [[nodiscard]] bool wants_openings() const;
    void finish_group(std::span<BundleReceiver* const> receivers);
    void after_iteration();
    /// A change of lights or materials as it is worked in.
    struct SurfaceChange {
        glm::vec3 scale{1.0F};  ///< factor of the solution
        std::span<const std::uint32_t> reflecting;
        bool transfer = true;  ///< the factor is not all
        bool redraw = true;
        bool glossy = false;  ///< some of the reflecting are, or were
        bool sky = false;     ///< some of the sky is to be transferred
    };
    void work_in(const SurfaceChange& change, std::span<BundleReceiver* const> receivers);
    void begin_change();
    void note_change();
    [[nodiscard]] bool unsettled() const;
    void start_phase(PhaseKind kind, float most_weight);
    [[nodiscard]] bool any_glossy(std::span<const std::uint32_t> materials) const;
    void adapt_unit(const Scene& scene, const PatchMesh& mesh, glm::vec3& scale);
    ChangeStore& change_store();
    void refresh_statistics();
    [[nodiscard]] bool is_fine() const {
        return fine_ != nullptr && (changes_ == 0 || since_change_ >= settings_.coarse_iterations);
    }
    [[nodiscard]] Transfer& transfer() { return is_fine() ? *fine_ : *coarse_; }
    [[nodiscard]] StrategyProbabilities planned_probabilities() const;
    [[nodiscard]] float sample_weight() const;
    void limit_iterate_age(float samples);
    [[nodiscard]] float iterate_age() const;

    SolverSettings settings_;
    StrategyMix mix_;
    StrategyProbabilities probabilities_;  // of the running group
    glm::vec3 constant_{0.0F};             // constant radiance term of the running group
    GpuScene scene_;
    std::unique_ptr<Caustics> caustics_;  // only where the scene has any
    ZoneBalance zones_;
    RadianceStore store_;
    bool lacks_reflection_;  // of the first bundles
    IterationSchedule schedule_;
    std::unique_ptr<Transfer> coarse_, fine_;  // fine_ exists from the switch-over on
    bool fine_fits_ = true;                    // there is memory for it, as far as is known
    float transient_;                          // iterations over which sample weights rise
    std::optional<ChangeStore> change_store_;  // exists from the first change on
    CarriedLight carried_light_;
    std::optional<SpecialPhase> phase_;
    unsigned special_bundles_ = 0;
    SkyOpenings openings_;  // to the sky, as they were at the last but few changes
    std::optional<std::uint64_t> openings_change_;  // number of changes by then
    std::vector<Planned> group_;
    std::size_t group_next_ = 0;
    std::optional<Strategy> last_strategy_;
    std::uint64_t iterations_ = 0;
    Shots shots_;
    std::uint64_t since_change_ = 0;
    std::uint64_t next_slopes_ = 0;  // of since_change_
    std::uint64_t iterate_age_ = 0;  // samples that the iterate is worth
    std::uint64_t changes_ = 0;
    SolutionStatistics statistics_;
};

}  // namespace raybundle
