// SPDX-License-Identifier: Apache-2.0
// What a change of lamps or places makes of the light of many lamps.
#include <algorithm>

#include "solution/direct/many_lamps.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

constexpr std::size_t most_changed = 64;  // lamps that change apart from the others

std::vector<glm::vec4> places_of(std::span<const layout::PunctualData> lights) {
    std::vector<glm::vec4> places;
    places.reserve(lights.size());
    for (const layout::PunctualData& light : lights) {
        places.push_back(light.map.z == PUNCTUAL_DIRECTIONAL
                             ? glm::vec4(glm::vec3(light.axis_z), 0.0F)
                             : glm::vec4(glm::vec3(light.position), 1.0F));
    }
    return places;
}

/// Whether one shines that was a dark one elsewhere: nothing is known of what it reaches.
bool is_new(const layout::PunctualData& before, const layout::PunctualData& now) {
    return before.intensity == glm::vec4(0.0F) && now.intensity != glm::vec4(0.0F) &&
           before.map.z != PUNCTUAL_DIRECTIONAL && before.position != now.position;
}

bool lamps_differ(const layout::PunctualData& a, const layout::PunctualData& b) {
    const bool directional = a.map.z == PUNCTUAL_DIRECTIONAL;  // placed by the scene's bounds
    return (!directional && a.position != b.position) || a.axis_x != b.axis_x ||
           a.axis_y != b.axis_y || a.axis_z != b.axis_z || a.intensity != b.intensity ||
           a.profile != b.profile;
}

}  // namespace

/// Some lamps are others: what they brought goes, and what they bring comes. What has moved looks
/// at all of them in add_moves().
void ManyLamps::add_changes(Buffer& lights, std::span<const layout::PunctualData> now) {
    for (const bool before : {true, false}) {
        if (!before) {
            lights.write(now, 0);
        }
        for (std::size_t first = 0; first < changed_.size(); first += LAMP_SLOTS) {
            const std::size_t count = std::min<std::size_t>(LAMP_SLOTS, changed_.size() - first);
            Pass pass;
            pass.before = before;
            pass.sign = before ? -1.0F : 1.0F;
            pass.but_moved = true;
            run_all(row_of(std::span(changed_).subspan(first, count)), pass);
        }
    }
}

/// What has moved is among other lamps.
void ManyLamps::follow_moved() {
    for (std::size_t first = 0; first < patch_order_.size(); first += most_points_) {
        const std::size_t end = std::min(first + most_points_, patch_order_.size());
        make_points(first, end, 1);
        for (std::size_t i = 0; i < end - first; ++i) {
            if ((points_[i].cell & LampPoint::moved) != 0) {
                order_.move_point(patch_order_[first + i], order_.cell_at(points_[i].position));
            }
        }
    }
    cells_.write(order_.cell_of(), 0);
}

/// Objects are elsewhere: the nearest lamps anew where their light passes either place, and
/// everything on the objects themselves.
void ManyLamps::add_moves(std::span<const Bounds> boxes) {
    const std::size_t end = std::min(near_lamps, lamps_);
    for (rank_ = 0; rank_ < end; rank_ += LAMP_SLOTS) {
        std::vector<std::uint32_t> row = rank_row(rank_);
        Pass pass;
        pass.boxes = boxes;
        pass.chances = rank_ + LAMP_SLOTS >= end;
        run_all(row, pass);
        pass.chances = false;
        pass.before = true;
        pass.sign = -1.0F;
        pass.but_moved = true;
        run_all(row, pass);
    }
}

void ManyLamps::update(Buffer& lights, const IesProfiles& profiles, bool radiance_follows) {
    const std::vector<layout::PunctualData> now = placed_lights(scene_, profiles);
    const bool first = known_.empty();
    const bool moved = scene_.moved_objects().x != NO_PATCH;
    bool added = false;
    changed_.clear();
    for (std::uint32_t k = 0; k < known_.size(); ++k) {
        if (lamps_differ(known_[k], now[k])) {
            changed_.push_back(k);
            added = added || is_new(known_[k], now[k]);
        }
    }
    ++version_;
    places_before_ = std::move(places_);
    places_ = places_of(now);
    const bool anew =
        first || added || changed_.size() > most_changed || unit_ != scene_.radiance_unit();
    unit_ = scene_.radiance_unit();
    all_changed_ = anew || moved;
    if (!anew && !moved && changed_.empty() && !scene_.reflectance().any_glossy()) {
        publish_reflection(radiance_follows);  // surfaces alone have changed
        return;
    }
    if (anew) {
        lights.write<layout::PunctualData>(now, 0);
        std::vector<PlacedLight> lamps;
        std::vector<float> ranges;
        for (std::size_t k = 0; k < lamps_; ++k) {
            lamps.push_back(scene_.placed_light(k));
            ranges.push_back(scene_.punctual_lights()[k].range);
        }
        order_.rank(lamps, ranges);
        restart();
        Pass pass;
        pass.chances = true;
        pass.note = true;
        run_all(rank_row(0), pass);
        finish_row();
        publish(false, radiance_follows);
        found_ = false;
    } else {
        if (lights_before_.bytes() == 0) {
            lights_before_ = Buffer("punctual lights before", lights.bytes());
        }
        lights_before_.write<layout::PunctualData>(known_, 0);
        restart();
        if (!changed_.empty()) {
            add_changes(lights, now);
        }
        if (moved) {
            follow_moved();
            add_moves(scene_.moved_bounds());
        }
        publish(true, radiance_follows);
        restart();
    }
    known_ = now;
}

}  // namespace raybundle
