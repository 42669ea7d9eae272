// SPDX-License-Identifier: Apache-2.0
#include "transport/special_phase.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace raybundle {

namespace {

// Halton dimensions; parallel bundles have numbers of their own in the same sequences.
enum Dimension : unsigned {
    choose_patch = 0,
    point_u = 1,
    point_v = 2,
    turn = 3,
    polar = 4,
    azimuth = 5,
    shift_x = 6,
    shift_y = 7
};

constexpr unsigned second_stage = 64;       // first number of the second stage's bundles
constexpr unsigned parallel_numbers = 128;  // and of parallel bundles' turns and shifts
constexpr unsigned shooters_at_once = MOST_DIFFERENCES;
constexpr float unseen_share = 0.3F;  // of the light that has gone round more than once
/// Of what changed light goes on to change, relative to its reflected share, to reckon with where
/// that is not carried on, and where it is.
constexpr float unseen_bounce = 2.0F;
constexpr float unseen_carried = 1.0F;
constexpr float visible_share = 0.05F;    // of all light: a level that is off by so much is seen
constexpr float mostly_changed = 0.5F;    // a smaller share mostly cancels: shadows go and come
constexpr float sample_deviation = 0.4F;  // as in corrected_weight.glsl

/// A shooter that moves with its object.
layout::Shooter shooter_at(const layout::Shooter& shooter, Place place) {
    layout::Shooter placed = shooter;
    if (place == Place::before) {
        placed.position = shooter.position_before;
        placed.normal = shooter.normal_before;
        placed.density = shooter.density_before;
    }
    return placed;
}

}  // namespace

SpecialPhase::SpecialPhase(const GpuScene& scene, RadianceStore& store, ChangeStore& change,
                           Transfer& transfer, const SpecialSettings& settings, PhaseKind kind,
                           std::uint64_t seed)
    : scene_(scene),
      store_(store),
      change_(change),
      transfer_(transfer),
      settings_(settings),
      moving_(kind == PhaseKind::moves),
      sky_changes_(kind == PhaseKind::surfaces_and_sky),
      numbers_(seed),
      bundles_(std::max(settings.bundles, 1U)) {
    settings_.bundles = bundles_;
    if (moving_) {
        boxes_ = scene.moved_bounds();
    }
    store_.bind();
    change_.begin();
    if (moving_) {
        store_.refresh_slopes();  // light and materials may have changed since
        store_.refresh_power(RadianceStore::Levels::kept);
    } else {
        change_.send();
    }
}

/// Parallel bundles among so many: drawn in fixed numbers, the deterministic mixture of the balance
/// heuristic. They alone bring light of the sky.
unsigned SpecialPhase::layered_of(unsigned bundles) const {
    return sky_changes_ && !bouncing_ ? bundles - bundles / 4 : bundles / 4;
}

/// Whether a bundle is a parallel one; they are spread evenly.
bool SpecialPhase::is_layered(unsigned index, unsigned bundles) const {
    const unsigned i = index % bundles;
    return (i + 1) * layered_of(bundles) / bundles > i * layered_of(bundles) / bundles;
}

std::vector<glm::vec4> SpecialPhase::shooter_numbers(unsigned first, unsigned count) const {
    std::vector<glm::vec4> numbers;
    for (unsigned i = first; i < first + count; ++i) {
        const unsigned n = first_number_ + i + 1;
        numbers.emplace_back(numbers_.sample(choose_patch, n), 0.0, numbers_.sample(point_u, n),
                             numbers_.sample(point_v, n));
    }
    return numbers;
}

/// Shooters of the next few bundles, which do not change what is sent.
void SpecialPhase::choose_source_shooters() {
    const auto numbers = shooter_numbers(next_, shooters_at_once);
    store_.bind();
    shooters_ = moving_ ? store_.choose_shooters(numbers) : change_.choose_shooters(numbers);
}

/// Tells the receivers of the bundles whose shooters have been chosen.
void SpecialPhase::plan_differences(std::span<BundleReceiver* const> receivers) const {
    std::vector<BundleRays> bundles;
    for (unsigned i = 0; i < shooters_at_once; ++i) {
        if (is_layered(next_ + i, settings_.bundles)) {
            const ParallelWindow window = window_of(next_ + i);
            bundles.push_back({false, window.frame.z, window.pixel_size});
            continue;
        }
        const glm::vec3& eye = shooters_[i].position;
        float farthest = 0.0F;
        for (const Bounds& box : boxes_) {
            farthest = std::max(
                farthest, glm::length(glm::max(glm::abs(box.min - eye), glm::abs(box.max - eye))));
        }
        const float pixel = 2.0F / static_cast<float>(transfer_.hemicube().size());
        bundles.push_back({true, eye, farthest * pixel});
    }
    for (BundleReceiver* receiver : receivers) {
        receiver->plan_differences(bundles, boxes_);
    }
}

bool SpecialPhase::carried(const layout::Shooter& shooter) const {
    return moving_ && glm::any(glm::equal(glm::uvec4(shooter.object), scene_.moved_objects()));
}

TransferSettings SpecialPhase::transfer_settings(Place place) const {
    const unsigned all = bouncing_ ? settings_.bounces : settings_.bundles;
    TransferSettings settings;
    settings.probabilities.layered = static_cast<float>(layered_of(all)) / static_cast<float>(all);
    settings.probabilities.perspective = 1.0F - settings.probabilities.layered;
    const float sign = place == Place::now ? 1.0F : -1.0F;
    settings.weight = sign / static_cast<float>(bouncing_ ? settings_.bounces : bundles_);
    settings.coloured = true;
    // What is carried on comes from surfaces.
    settings.sky = bouncing_ ? SkyTransfer::none
                   : moving_ ? SkyTransfer::whole
                             : SkyTransfer::change;
    settings.context.place = place;
    settings.context.sample_weight = 0.0F;
    settings.context.special = true;
    settings.context.number = next_;
    return settings;
}

TransferSettings SpecialPhase::difference_settings(Place place, unsigned index) const {
    TransferSettings settings = transfer_settings(place);
    const std::size_t slot = index % shooters_at_once;
    const bool everywhere = !is_layered(index, settings_.bundles) && carried(shooters_[slot]);
    if (settings_.scissored && !everywhere) {
        settings.context.difference = static_cast<std::uint32_t>(slot);
    }
    return settings;
}

void SpecialPhase::step(std::span<BundleReceiver* const> receivers) {
    if (done_) {
        return;
    }
    if (settings_.skipped) {
        finish(receivers);
    } else if (bouncing_) {
        step_bounce(receivers);
    } else {
        step_source(receivers);
    }
}

void SpecialPhase::step_source(std::span<BundleReceiver* const> receivers) {
    if (next_ % shooters_at_once == 0) {
        choose_source_shooters();
        if (moving_ && settings_.scissored) {
            plan_differences(receivers);
        }
    }
    if (is_layered(next_, settings_.bundles)) {
        layered(next_, receivers);
    } else if (moving_) {
        move_perspective(shooters_[next_ % shooters_at_once], next_, receivers);
    } else {
        perspective(shooters_[next_ % shooters_at_once], next_, receivers);
    }
    store_.bind();
    change_.take(bundles_);
    if (++next_ >= bundles_) {
        end_source(receivers);
    }
}

/// Ends the first stage, or prolongs it where its bundles disagree too much.
void SpecialPhase::end_source(std::span<BundleReceiver* const> receivers) {
    if (bundles_ == settings_.bundles && settings_.most_bundles >= 2 * bundles_) {
        const ChangeNoise noise = change_.noise(bundles_);
        const double wanted = std::max<double>(
            settings_.noise, settings_.relevant_noise / std::max(noise.change, 1e-6));
        unsigned more = bundles_;
        for (double error = noise.relative; error > wanted && 2 * more <= settings_.most_bundles;
             error /= std::sqrt(2.0)) {
            more *= 2;
        }
        if (more > bundles_) {
            for (BundleReceiver* receiver : receivers) {
                receiver->scale_special(static_cast<float>(bundles_) / static_cast<float>(more));
            }
            bundles_ = more;
            return;
        }
    }
    change_.fold(bundles_, 0.0F);
    next_ = 0;
    bouncing_ = settings_.bounces > 0;
    first_number_ = second_stage;
    if (!bouncing_) {
        finish(receivers);
    }
}

void SpecialPhase::step_bounce(std::span<BundleReceiver* const> receivers) {
    store_.bind();
    change_.reflect(next_);
    change_.send();
    if (is_layered(next_, settings_.bounces)) {
        layered(next_, receivers);
    } else {
        perspective(change_.choose_shooters(shooter_numbers(next_, 1)).front(), next_, receivers);
    }
    store_.bind();
    change_.take(settings_.bounces);
    if (++next_ >= settings_.bounces) {
        change_.fold(settings_.bounces, unseen_share);
        finish(receivers);
    }
}

/// Samples that any mean is worth where part of its light is still that from before: what the
/// change goes on to change is not carried on, or by few bundles. A carried light changes all of
/// it, a box next to nothing.
float SpecialPhase::weight_beside_unseen(float share) const {
    const float unseen =
        share * share / (share + mostly_changed) * (bouncing_ ? unseen_carried : unseen_bounce);
    return sample_deviation * sample_deviation / std::max(unseen * unseen, 1e-12F);
}

void SpecialPhase::finish(std::span<BundleReceiver* const> receivers) {
    change_.stop_sending();
    const float bundles_noise = 1.0F / static_cast<float>(bundles_);
    most_weight_ = settings_.most_weight;
    if (!settings_.skipped) {
        const auto share = static_cast<float>(change_.reflected_share());
        most_weight_ = std::min(most_weight_, weight_beside_unseen(share));
        much_changed_ = share > visible_share;
    }
    change_.correct(bundles_noise, most_weight_);
    for (BundleReceiver* receiver : receivers) {
        receiver->end_special(bundles_noise, most_weight_);
    }
    done_ = true;
}

/// The same bundle before and after the move.
void SpecialPhase::move_perspective(const layout::Shooter& shooter, unsigned index,
                                    std::span<BundleReceiver* const> receivers) {
    const unsigned n = first_number_ + index + 1;
    const float angle = static_cast<float>(numbers_.sample(turn, n)) * glm::two_pi<float>();
    const glm::vec2 pixel_shift(numbers_.sample(shift_x, n) - 0.5,
                                numbers_.sample(shift_y, n) - 0.5);
    for (const Place place : {Place::before, Place::now}) {
        const layout::Shooter placed = shooter_at(shooter, place);
        if (placed.density <= 0.0F) {
            continue;  // an object without a size sends nothing
        }
        BundleFrame frame = make_frame(placed.position, placed.normal, angle);
        frame.pixel_shift = pixel_shift;
        // A shooter on the object moves with it: everything that it sees changes.
        const auto rectangles = carried(shooter) || !settings_.scissored
                                    ? transfer_.hemicube().full()
                                    : transfer_.hemicube().covering(frame, boxes_);
        transfer_.perspective(frame, placed, rectangles, difference_settings(place, index),
                              receivers);
    }
}

/// What is sent with the objects where they are now.
void SpecialPhase::perspective(const layout::Shooter& shooter, unsigned index,
                               std::span<BundleReceiver* const> receivers) {
    if (shooter.density <= 0.0F) {
        return;  // nothing but the sky has changed
    }
    const unsigned n = first_number_ + index + 1;
    const float angle = static_cast<float>(numbers_.sample(turn, n)) * glm::two_pi<float>();
    BundleFrame frame = make_frame(shooter.position, shooter.normal, angle);
    frame.pixel_shift = {numbers_.sample(shift_x, n) - 0.5, numbers_.sample(shift_y, n) - 0.5};
    transfer_.perspective(frame, shooter, transfer_.hemicube().full(),
                          transfer_settings(Place::now), receivers);
}

ParallelWindow SpecialPhase::window_of(unsigned index) const {
    const unsigned n = first_number_ + index + 1;
    const unsigned m = n + parallel_numbers;
    IterationSample sample;
    sample.direction = uniform_direction(numbers_.sample(polar, n), numbers_.sample(azimuth, n));
    sample.angle = numbers_.sample(turn, m) * glm::two_pi<double>();
    sample.shift = {static_cast<float>(numbers_.sample(point_u, m)),
                    static_cast<float>(numbers_.sample(point_v, m))};
    return transfer_.parallel_window(sample);
}

void SpecialPhase::layered(unsigned index, std::span<BundleReceiver* const> receivers) {
    const ParallelWindow window = window_of(index);
    const bool both = moving_ && !bouncing_;
    const PixelRectangle rectangle =
        both && settings_.scissored ? window.covering(boxes_) : window.full();
    transfer_.take_overflow();
    for (const Place place : {Place::before, Place::now}) {
        if (place == Place::before && !both) {
            continue;
        }
        do {
            transfer_.layered(window, rectangle,
                              both ? difference_settings(place, index) : transfer_settings(place),
                              receivers);
        } while (transfer_.take_overflow() != 0);
    }
}

}  // namespace raybundle
