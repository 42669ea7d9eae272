// SPDX-License-Identifier: Apache-2.0
#include "transport/solver.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "gpu/egl_context.h"
#include "transport/patch_area.h"

namespace raybundle {

namespace {

constexpr std::size_t group_size = GROUP_SIZE;  // iterations planned together
constexpr float transient_iterations =
    64.0F;  // times 1/(1 - albedo): over which sample weights rise
// Samples of the completed group lack no light, only where it is: they weigh alike. Were it 32,
// what is wrong at the start would stay: a room in the sun was 2.4 % too bright after 200
// iterations.
constexpr auto completed_start = static_cast<float>(GROUP_SIZE);
constexpr float fine_sample_weight = 2.0F;  // of fine bundles against coarse ones
constexpr std::uint64_t statistics_interval = 16;
constexpr float least_iterate_age = 3.0F;  // after a change, in samples

/// Area mean of the albedo's largest channel: how slowly the dark beginning fades.
float mean_albedo(const Scene& scene, const PatchMesh& mesh) {
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        const double area = world_area(scene, mesh, i);
        const glm::vec3& albedo = mesh.base_colour[i];
        sum += area * static_cast<double>(std::max({albedo.r, albedo.g, albedo.b}));
        total += area;
    }
    return total > 0.0 ? static_cast<float>(sum / total) : 0.0F;
}

StrategyMix choose_mix(const SolverSettings& settings, const Scene& scene) {
    return {settings.adapt_probabilities ? suited_to(scene, settings.probabilities)
                                         : settings.probabilities,
            settings.adapt_probabilities};
}

unsigned scatter_kind(Strategy strategy) {
    switch (strategy) {
        case Strategy::layered:
            return SCATTER_PARALLEL;
        case Strategy::perspective:
            return SCATTER_PERSPECTIVE;
        case Strategy::plane:
        case Strategy::opening:
            break;
    }
    return SCATTER_NOT_MEASURED;
}

}  // namespace

Solver::Solver(const Scene& scene, const PatchMesh& mesh, const SolverSettings& settings)
    : settings_(settings),
      mix_(choose_mix(settings, scene)),
      probabilities_(mix_.probabilities()),
      scene_(scene, mesh, settings.constant_radiance, settings.caustics),
      caustics_(scene_.caustics() ? std::make_unique<Caustics>(scene, mesh, scene_, settings.seed)
                                  : nullptr),
      zones_(scene, mesh, scene_, settings.seed),
      store_(scene_, zones_, caustics_.get()),
      lacks_reflection_(settings.main_part && zones_.start_lacks_light()),
      schedule_(settings_.seed, probabilities_, scene_.reflectance().any_glossy(),
                settings_.planes_per_direction),
      coarse_(std::make_unique<Transfer>(scene_, store_, settings_.coarse)),
      transient_(transient_iterations / (1.0F - std::min(mean_albedo(scene, mesh), 0.999F))),
      carried_light_(scene, mesh) {}

const BundleResolution& Solver::resolution() const {
    return is_fine() ? settings_.fine : settings_.coarse;
}

std::uint64_t Solver::non_finite() const {
    return coarse_->non_finite() + (fine_ ? fine_->non_finite() : 0);
}

std::size_t Solver::bytes() const {
    return scene_.bytes() + store_.bytes() + coarse_->bytes() + (fine_ ? fine_->bytes() : 0) +
           (change_store_ ? change_store_->bytes() : 0) + (caustics_ ? caustics_->bytes() : 0);
}

double Solver::noise() const {
    // Averaging with a constant step s leaves the variance s/2 of single samples.
    const double step = std::pow(static_cast<double>(iterate_age()) + 1.0, -ITERATE_EXPONENT);
    const double samples = static_cast<double>(std::max<std::uint64_t>(iterations_, 1));
    return statistics_.distance * std::sqrt(2.0 / (samples * step));
}

bool Solver::noise_is_low() const {
    constexpr std::uint64_t patience = 8;
    return noise() <= static_cast<double>(settings_.fine_noise) ||
           iterations_ >= patience * settings_.coarse_iterations;
}

/// Bundles are fine from now on; where there is no memory for that, they stay as they are.
void Solver::refine() {
    try {
        fine_ = std::make_unique<Transfer>(scene_, store_, settings_.fine);
    } catch (const GpuError& error) {
        fine_fits_ = false;
        spdlog::error("bundles stay coarse, so small shadows stay blurred: {}", error.what());
    }
}

/// How light changes within patches is found anew when there are so many more samples of it.
void Solver::refresh_slopes() {
    constexpr std::uint64_t share = 8;
    if (since_change_ >= next_slopes_) {
        store_.refresh_slopes();
        next_slopes_ = since_change_ + std::max<std::uint64_t>(since_change_ / share, group_size);
    }
}

StrategyProbabilities Solver::planned_probabilities() const {
    StrategyProbabilities planned = mix_.probabilities();
    if (settings_.first_probabilities) {
        const StrategyProbabilities& first = *settings_.first_probabilities;
        const float share = std::min(static_cast<float>(iterations_) / transient_, 1.0F);
        planned = {glm::mix(first.layered, planned.layered, share),
                   glm::mix(first.plane, planned.plane, share),
                   glm::mix(first.perspective, planned.perspective, share)};
    }
    planned.opening = openings_.probability(zones_.sky_share(openings_.sheltered_areas));
    planned.layered *= 1.0F - planned.opening;
    planned.perspective *= 1.0F - planned.opening;
    return planned;
}

void Solver::plan_group() {
    if (!fine_ && fine_fits_ && iterations_ >= settings_.coarse_iterations && noise_is_low()) {
        refine();
    }
    group_.clear();
    group_next_ = 0;
    if (mix_.is_due()) {
        const glm::dvec2 scatter = store_.take_scatter();
        mix_.adapt({scatter.x, scatter.y});
    }
    refresh_openings();
    probabilities_ = planned_probabilities();
    schedule_.set_probabilities(probabilities_);
    coarse_->set_openings(openings_, transfer_settings());
    if (fine_) {
        fine_->set_openings(openings_, transfer_settings());
    }
    store_.set_shoots_only(probabilities_.perspective >= 1.0F);
    std::vector<glm::vec4> numbers;
    for (std::size_t i = 0; i < group_size; ++i) {
        group_.push_back({schedule_.next(), {}});
        if (group_.back().sample.strategy == Strategy::perspective) {
            numbers.push_back(group_.back().sample.shooter_numbers);
        }
    }
    if (numbers.empty() && scene_.constant_radiance()) {
        numbers.emplace_back(0.0F);  // brings the constant
    }
    store_.bind();
    store_.take_lamps(static_cast<std::uint32_t>(iterations_ / group_size));
    store_.bind();
    if (caustics_) {
        caustics_->refine(store_.sent());
        store_.bind();
    }
    refresh_slopes();
    zones_.set_iterate_age(iterate_age());
    store_.refresh_power();
    const auto shooters = store_.choose_shooters(numbers);
    if (!shooters.empty()) {
        constant_ = glm::vec3(shooters.front().constant_radiance);
    }
    auto shooter = shooters.begin();
    for (Planned& planned : group_) {
        if (planned.sample.strategy == Strategy::perspective) {
            planned.shooter = *shooter++;
        }
    }
}

void Solver::step(std::span<BundleReceiver* const> receivers) {
    if (phase_) {
        last_strategy_.reset();
        phase_->step(receivers);
        if (phase_->done()) {
            special_bundles_ = phase_->bundles();
            const bool informed = phase_->informed();
            const bool much_changed = phase_->much_changed();
            limit_iterate_age(std::max(phase_->most_weight(), least_iterate_age));
            phase_.reset();
            scene_.settle();
            store_.bind();
            store_.keep_light();
            if (much_changed) {
                zones_.set_iterate_age(iterate_age());
                store_.refresh_power();
            }
            refresh_statistics();
            statistics_.settled *= informed ? 1.0 : 0.0;
            group_.clear();  // shooters may have moved, and what is bright has changed
        }
        return;
    }
    if (group_next_ >= group_.size()) {
        plan_group();
    }
    run(group_[group_next_], static_cast<unsigned>(group_next_), receivers);
    ++group_next_;
    if (group_next_ == group_.size()) {
        finish_group(receivers);
        complete_start(receivers);
        store_.serve();
    }
}

/// The first group of bundles carries what lights send. What surfaces will reflect of it is known
/// of each room as a whole, so that nobody has to see a room whose shadows are black.
void Solver::complete_start(std::span<BundleReceiver* const> receivers) {
    if (iterations_ != group_size || !start_is_completed()) {
        return;
    }
    store_.bind();
    const Buffer completion = store_.complete_start();
    for (BundleReceiver* receiver : receivers) {
        receiver->complete_start();
    }
}

/// Whether the first group of bundles carries, or has carried, nothing but emission, and lacks what
/// surfaces reflect.
bool Solver::start_is_completed() const {
    return lacks_reflection_ && changes_ == 0 && constant_ == glm::vec3(0.0F);
}

/// Weight of a sample in the mean since the last change, or since the start: rises, so that what
/// the iterate had before fades like 1/n^2.
float Solver::sample_weight() const {
    const auto since = static_cast<float>(samples() + 1);
    const float least = start_is_completed() ? completed_start : 0.0F;
    return std::min(std::max(since, least) / transient_, 1.0F) *
           (is_fine() ? fine_sample_weight : 1.0F);
}

/// A change has left the iterate as good as so many samples, at most.
void Solver::limit_iterate_age(float samples) {
    if (static_cast<float>(iterate_age_) > samples) {
        iterate_age_ = static_cast<std::uint64_t>(samples);
    }
}

/// Samples that the transferred iterate is worth; its step follows from them, see
/// solution_update.comp.
float Solver::iterate_age() const {
    constexpr double smallest_step = 1.0 / 2048.0;
    static const auto oldest =
        static_cast<float>(std::pow(smallest_step, -1.0 / ITERATE_EXPONENT) - 1.0);
    return settings_.main_part ? std::min(static_cast<float>(iterate_age_), oldest) : 0.0F;
}

TransferSettings Solver::transfer_settings() const {
    TransferSettings settings;
    settings.probabilities = probabilities_;
    settings.density_error = settings_.density_error;
    settings.constant = constant_;
    settings.context.constant_irradiance = glm::pi<float>() * constant_;
    settings.context.sample_weight = sample_weight();
    settings.context.seed = static_cast<std::uint32_t>(settings_.seed);
    settings.noise_horizon = static_cast<float>(settings_.noise_horizon);
    return settings;
}

/// Of a bundle that carries its light itself.
BundleUpdate Solver::update_of(const TransferSettings& settings) const {
    return {.weight = settings.context.sample_weight,
            .iterate_age = iterate_age(),
            .iteration = iterations_,
            .constant_irradiance = settings.context.constant_irradiance};
}

void Solver::run(const Planned& planned, unsigned slot,
                 std::span<BundleReceiver* const> receivers) {
    for (BundleReceiver* receiver : receivers) {
        receiver->begin_sample();
    }
    TransferSettings settings = transfer_settings();
    settings.slot = slot;
    settings.row_phase = planned.sample.row_phase;
    const Strategy strategy = planned.sample.strategy;
    last_strategy_ = strategy;
    mix_.count(strategy);
    BundleUpdate update = update_of(settings);
    update.scatter = mix_.adaptive() ? scatter_kind(strategy) : SCATTER_NOT_MEASURED;
    if (strategy == Strategy::perspective) {
        run_perspective(planned, settings, receivers);
        update.scalar = planned.shooter.glossy == 0;
        update.from_point = true;
        update.shooter_density = planned.shooter.density;
    } else if (strategy == Strategy::opening) {
        run_opening(planned.sample, settings, receivers);
        update.from_point = true;
    } else {
        const ParallelWindow window = transfer().parallel_window(planned.sample);
        if (strategy == Strategy::plane) {
            transfer().plane(window, settings, receivers);
        } else {
            transfer().layered(window, window.full(), settings, receivers);
        }
    }
    store_.update(update);
    after_iteration();
}

void Solver::run_perspective(const Planned& planned, TransferSettings& settings,
                             std::span<BundleReceiver* const> receivers) {
    BundleFrame frame = make_frame(planned.shooter.position, planned.shooter.normal,
                                   static_cast<float>(planned.sample.angle));
    frame.pixel_shift = planned.sample.shift - 0.5F;
    Hemicube::FaceRectangles faces = transfer().hemicube().full();
    if (settings_.random_faces && planned.shooter.glossy != 0) {
        settings.face_weights =
            choose_faces(frame.to_bundle(frame.origin + glm::vec3(planned.shooter.lobe)),
                         planned.shooter.lobe.w, planned.sample.faces);
        for (std::size_t face = 0; face < faces.size(); ++face) {
            if (settings.face_weights[face] == 0.0F) {
                faces[face] = {};
            }
        }
    }
    transfer().perspective(frame, planned.shooter, faces, settings, receivers);
    ++shots_.all;
    shots_.from_emitters += planned.shooter.emitter;
}

/// Layered iterations whose lists were too small have done nothing: they are done now.
void Solver::finish_group(std::span<BundleReceiver* const> receivers) {
    for (std::uint32_t mask = transfer().take_overflow(); mask != 0;
         mask = transfer().take_overflow()) {
        for (unsigned slot = 0; slot < group_.size(); ++slot) {
            if ((mask >> slot & 1U) != 0) {
                --iterations_;
                --since_change_;
                --iterate_age_;
                store_.discard_update(iterate_age(), sample_weight());
                mix_.count(group_[slot].sample.strategy, -1);
                for (BundleReceiver* receiver : receivers) {
                    receiver->discard_sample({.sample_weight = sample_weight(),
                                              .constant_irradiance = glm::pi<float>() * constant_});
                }
                run(group_[slot], slot, receivers);
            }
        }
    }
}

void Solver::after_iteration() {
    store_.look_at_lamps();
    ++iterations_;
    ++since_change_;
    ++iterate_age_;
    if (since_change_ % statistics_interval == 0) {
        refresh_statistics();
    }
}

void Solver::refresh_statistics() {
    statistics_ = store_.statistics();
    // Above 0.9 no zone is off by more than 5 % (two standard deviations).
    const double doubt = zones_.doubt();
    statistics_.settled = std::min(statistics_.settled,
                                   std::max(doubt < 0.05 ? 1.0 - 2.0 * doubt : 0.95 - doubt, 0.0));
}

}  // namespace raybundle
