// SPDX-License-Identifier: Apache-2.0
// What a change of lamps or places makes of the light of many lamps.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

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

/// Whether a way from a point of a box to a lamp (LampQuestion::lamps) may meet another box: at
/// time t all ways together are a box, whose sides move evenly.
bool ways_meet(const Bounds& from, const glm::vec4& lamp, const Bounds& other) {
    if (from.empty() || other.empty()) {
        return false;
    }
    const bool distant = lamp.w == 0.0F;
    float enter = 0.0F;
    float leave = distant ? std::numeric_limits<float>::infinity() : 1.0F;
    // least + t * step <= 0 holds from the time on, or up to it, where both are equal.
    const auto below = [&](float least, float step) {
        if (step > 0.0F) {
            leave = std::min(leave, -least / step);
        } else if (step < 0.0F) {
            enter = std::max(enter, -least / step);
        } else if (least > 0.0F) {
            leave = -1.0F;
        }
    };
    for (int axis = 0; axis < 3; ++axis) {
        const float to = lamp[axis];
        below(from.min[axis] - other.max[axis], distant ? to : to - from.min[axis]);
        below(other.min[axis] - from.max[axis], distant ? -to : from.max[axis] - to);
    }
    return enter <= leave;
}

}  // namespace

/// Boxes round the points of each cell's patches, as run() will have them for the present row.
/// Returns of the order which patches are on objects that have moved.
std::vector<bool> ManyLamps::enclose_points(std::vector<Bounds>& cells) {
    cells.assign(order_.cells(), Bounds{});
    std::vector<bool> moved(patch_order_.size(), false);
    const std::size_t most = most_points_ / patch_points;
    for (std::size_t first = 0; first < patch_order_.size(); first += most) {
        const std::size_t end = std::min(first + most, patch_order_.size());
        const std::size_t points = make_points(first, end, patch_points);
        for (std::size_t i = 0; i < points; ++i) {
            const LampPoint& point = points_[i];
            if ((point.cell & LampPoint::moved) != 0) {
                moved[first + i / patch_points] = true;
            } else {
                cells[point.cell].add(point.position);
            }
        }
    }
    return moved;
}

/// Which cells have a way to a lamp of a row that may meet a box, where that is now or was before.
std::vector<std::uint8_t> ManyLamps::cells_behind(std::span<const std::uint32_t> row,
                                                  std::span<const Bounds> cells,
                                                  std::span<const Bounds> boxes) const {
    std::vector<Bounds> wider(boxes.begin(), boxes.end());
    for (Bounds& box : wider) {  // than what rounding makes of them
        if (!box.empty()) {
            const float margin = 1e-5F * scene_.diameter();
            box.min -= margin;
            box.max += margin;
        }
    }
    std::vector<std::uint8_t> behind(cells.size(), 0);
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t cell) {
        const auto slots = row.subspan(cell * LAMP_SLOTS, LAMP_SLOTS);
        const auto meets = [&](const glm::vec4& lamp) {
            return std::any_of(wider.begin(), wider.end(), [&](const Bounds& box) {
                return ways_meet(cells[cell], lamp, box);
            });
        };
        behind[cell] = std::any_of(slots.begin(), slots.end(), [&](std::uint32_t lamp) {
            return lamp != no_lamp && (meets(places_[lamp]) || meets(places_before_[lamp]));
        });
    });
    return behind;
}

/// run_all() for some patches of the order alone.
void ManyLamps::run_some(std::span<const std::uint32_t> row, const Pass& pass,
                         std::vector<std::uint32_t> patches) {
    if (patches.empty()) {
        return;
    }
    patch_order_.swap(patches);
    order_buffer_.write<std::uint32_t>(patch_order_, 0);
    run_all(row, pass);
    patch_order_.swap(patches);
    order_buffer_.write<std::uint32_t>(patch_order_, 0);
}

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
    std::vector<Bounds> cells;
    std::vector<bool> moved;
    for (rank_ = 0; rank_ < end; rank_ += LAMP_SLOTS) {
        if (rank_ <= LAMP_SLOTS) {  // other points, but for the first row always the same
            moved = enclose_points(cells);
        }
        const std::vector<std::uint32_t> row = rank_row(rank_);
        const std::vector<std::uint8_t> behind = cells_behind(row, cells, boxes);
        std::vector<std::uint32_t> own;
        std::vector<std::uint32_t> others;
        for (std::size_t i = 0; i < patch_order_.size(); ++i) {
            const std::uint32_t patch = patch_order_[i];
            if (moved[i]) {
                own.push_back(patch);
            } else if (behind[order_.cell_of()[patch]] != 0) {
                others.push_back(patch);
            }
        }
        Pass pass;
        pass.boxes = boxes;
        run_some(row, pass, others);
        pass.chances = rank_ + LAMP_SLOTS >= end;
        run_some(row, pass, std::move(own));
        pass.chances = false;
        pass.before = true;
        pass.sign = -1.0F;
        pass.but_moved = true;
        run_some(row, pass, std::move(others));
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
