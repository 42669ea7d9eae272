// SPDX-License-Identifier: Apache-2.0
#include "transport/special_phase.h"

#include <glm/gtc/constants.hpp>

namespace raybundle {

namespace {

// Halton dimensions.
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

}  // namespace

SpecialPhase::SpecialPhase(const GpuScene& scene, RadianceStore& store, Transfer& transfer,
                           std::uint32_t object, std::uint64_t seed)
    : scene_(scene),
      store_(store),
      transfer_(transfer),
      object_(object),
      numbers_(seed),
      boxes_{scene.object_bounds(object, Place::now), scene.object_bounds(object, Place::before)} {
    std::vector<glm::vec4> numbers;
    for (unsigned i = 0; i < perspective_iterations; ++i) {
        numbers.emplace_back(numbers_.sample(choose_patch, i + 1), 0.0,
                             numbers_.sample(point_u, i + 1), numbers_.sample(point_v, i + 1));
    }
    store_.bind();
    store_.refresh_power();
    shooters_ = store_.choose_shooters(numbers);
}

TransferSettings SpecialPhase::transfer_settings(Place place) const {
    TransferSettings settings;
    // Both kinds are drawn in fixed numbers: the deterministic mixture of the balance heuristic.
    settings.probabilities.layered = static_cast<float>(layered_iterations) / iterations;
    settings.probabilities.perspective = static_cast<float>(perspective_iterations) / iterations;
    const float sign = place == Place::now ? 1.0F : -1.0F;
    settings.weight = sign / static_cast<float>(iterations);
    settings.coloured = true;
    settings.context.place = place;
    settings.context.sample_weight = 0.0F;
    settings.context.special = true;
    settings.context.moved_object = object_;
    return settings;
}

void SpecialPhase::step(std::span<BundleReceiver* const> receivers) {
    if (done()) {
        return;
    }
    if (next_ < perspective_iterations) {
        perspective(shooters_[next_],
                    static_cast<float>(numbers_.sample(turn, next_ + 1)) * glm::two_pi<float>(),
                    receivers);
    } else {
        layered(numbers_, next_ - perspective_iterations + 1, receivers);
    }
    if (++next_ < iterations) {
        return;
    }
    store_.bind();
    constexpr auto phase_weight = static_cast<float>(iterations);
    store_.correct(phase_weight);
    for (BundleReceiver* receiver : receivers) {
        receiver->end_special(phase_weight);
    }
}

void SpecialPhase::perspective(const layout::Shooter& shooter, float angle,
                               std::span<BundleReceiver* const> receivers) {
    const bool carried = shooter.object == object_;
    const glm::vec2 pixel_shift(numbers_.sample(shift_x, next_ + 1) - 0.5,
                                numbers_.sample(shift_y, next_ + 1) - 0.5);
    for (const Place place : {Place::before, Place::now}) {
        BundleFrame frame = make_frame(shooter.position, shooter.normal, angle);
        frame.pixel_shift = pixel_shift;
        if (carried && place == Place::before) {
            const glm::mat4 before_from_now =
                scene_.world_from_object(object_, Place::before) *
                glm::inverse(scene_.world_from_object(object_, Place::now));
            const auto rotate = glm::transpose(glm::inverse(glm::mat3(before_from_now)));
            frame = make_frame(glm::vec3(before_from_now * glm::vec4(shooter.position, 1.0F)),
                               glm::normalize(rotate * shooter.normal), angle);
            frame.pixel_shift = pixel_shift;
        }
        // A shooter on the object moves with it: everything that it sees changes.
        const auto rectangles =
            carried ? transfer_.hemicube().full() : transfer_.hemicube().covering(frame, boxes_);
        transfer_.perspective(frame, shooter, rectangles, transfer_settings(place), receivers);
    }
}

void SpecialPhase::layered(const RandomisedHalton& numbers, unsigned index,
                           std::span<BundleReceiver* const> receivers) {
    IterationSample sample;
    sample.direction =
        uniform_direction(numbers.sample(polar, index), numbers.sample(azimuth, index));
    sample.angle = numbers.sample(turn, index + iterations) * glm::two_pi<double>();
    sample.shift = {static_cast<float>(numbers.sample(point_u, index + iterations)),
                    static_cast<float>(numbers.sample(point_v, index + iterations))};
    const ParallelWindow window = transfer_.parallel_window(sample);
    const PixelRectangle rectangle = window.covering(boxes_);
    transfer_.take_overflow();
    for (const Place place : {Place::before, Place::now}) {
        do {
            transfer_.layered(window, rectangle, transfer_settings(place), receivers);
        } while (transfer_.take_overflow() != 0);
    }
}

}  // namespace raybundle
