// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/many_lamps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"
#include "scene/mix_bits.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

static_assert(lamp_slots == LAMP_SLOTS && LampPoint::moved == LAMP_POINT_MOVED);
constexpr std::size_t most_scratch = 1U << 16U;  // points
constexpr unsigned patch_points = 4;             // points of a patch
/// Lamps of each cell that are looked at from all points of a patch, and anew after a move.
constexpr std::size_t near_lamps = std::size_t{4} * LAMP_SLOTS;
constexpr std::size_t most_changed = 64;  // lamps that change apart from the others

std::size_t rows_of(std::size_t lamps) {
    return (lamps + LAMP_SLOTS - 1) / LAMP_SLOTS;
}

unsigned levels_of(std::size_t lamps) {
    return static_cast<unsigned>(std::bit_width(std::max<std::size_t>(rows_of(lamps), 1) - 1)) + 1;
}

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

bool lamps_differ(const layout::PunctualData& a, const layout::PunctualData& b) {
    const bool directional = a.map.z == PUNCTUAL_DIRECTIONAL;  // placed by the scene's bounds
    return (!directional && a.position != b.position) || a.axis_x != b.axis_x ||
           a.axis_y != b.axis_y || a.axis_z != b.axis_z || a.intensity != b.intensity;
}

/// A number in [0, 1) of two.
float random_number(std::uint32_t a, std::uint32_t b) {
    return static_cast<float>(mix_bits(std::uint64_t{a} << 32U | b) >> 40U) * 0x1p-24F;
}

}  // namespace

ManyLamps::ManyLamps(const GpuScene& scene)
    : scene_(scene),
      lamps_(scene.punctual_lights().size()),
      most_points_(std::min<std::size_t>(
          most_scratch, most_storage_bytes() / sizeof(LampPoint) / patch_points * patch_points)),
      levels_(levels_of(lamps_)),
      points_(most_points_),
      lit_(most_points_),
      sums_("lamp sums", 3 * std::size_t{scene.patch_count()} * sizeof(glm::vec4)),
      levels_buffer_("lamp levels",
                     (levels_ + 1) * std::size_t{scene.patch_count()} * sizeof(glm::vec4)),
      points_buffer_("lamp points", most_points_ * sizeof(LampPoint)),
      masks_("lamp masks", most_points_ * sizeof(std::uint32_t)),
      chances_("lamp chances", most_points_ * LAMP_CHANCES * sizeof(glm::uvec2)),
      make_points_({"lamps_patch_points.comp"}, scene.defines()),
      add_({"lamps_patches.comp"}, scene.defines()),
      publish_({"lamps_publish.comp"}, scene.defines()) {
    sums_.clear();
    levels_buffer_.clear();
    order_patches();
    for (const Buffer* buffer : {&sums_, &levels_buffer_, &points_buffer_, &chances_, &slots_}) {
        check_storage("many lamps", buffer->bytes());
    }
}

/// Cells by a point of each patch.
void ManyLamps::order_patches() {
    const std::size_t count = scene_.patch_count();
    patch_order_.resize(count);
    std::iota(patch_order_.begin(), patch_order_.end(), 0U);
    order_buffer_ = Buffer::from<std::uint32_t>("lamp patch order", patch_order_);
    cells_ = Buffer("lamp cells", count * sizeof(std::uint32_t));
    cells_.clear();
    scene_.bind();
    bind();
    std::vector<glm::vec3> centres, corners;
    const std::size_t most = most_points_ / patch_points;
    for (std::size_t first = 0; first < count; first += most) {
        const std::size_t end = std::min(first + most, count);
        make_points(first, end, patch_points);
        for (std::size_t i = 0; i < end - first; ++i) {
            const auto own = std::span(points_).subspan(i * patch_points, patch_points);
            glm::vec3 centre(0.0F);
            for (const LampPoint& point : own) {
                centre += point.position / static_cast<float>(patch_points);
            }
            centres.push_back(centre);
            for (const LampPoint& point : own) {  // centroids of parts are half as far away
                corners.push_back(2.0F * point.position - centre);
            }
        }
    }
    order_ = LampOrder(centres, lamps_);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        order_.include(i / patch_points, corners[i]);
    }
    const auto cell_of = order_.cell_of();
    std::stable_sort(patch_order_.begin(), patch_order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return cell_of[a] < cell_of[b]; });
    order_buffer_.write<std::uint32_t>(patch_order_, 0);
    cells_.write(cell_of, 0);
    reaches_.assign(order_.cells() * lamps_, 0);
    slots_ = Buffer("lamp slots", order_.cells() * LAMP_SLOTS * sizeof(std::uint32_t));
    if (scene_.reflectance().any_glossy()) {
        proposals_ = Buffer("lamp proposals", order_.cells() * LAMP_SLOTS * sizeof(glm::uvec2));
        proposals_.clear();
    }
}

void ManyLamps::bind() const {
    cells_.bind_storage(BINDING_LAMP_CELLS);
    if (proposals_.bytes() > 0) {
        proposals_.bind_storage(BINDING_LAMP_PROPOSALS);
    }
}

void ManyLamps::bind_points() const {
    points_buffer_.bind_storage(BINDING_LAMP_POINTS);
    masks_.bind_storage(BINDING_LAMP_MASKS);
}

void ManyLamps::bind_row(std::span<const std::uint32_t> row) {
    slots_.write(row, 0);
    slots_.bind_storage(BINDING_LAMP_SLOTS);
    bind_points();
    bind();
}

unsigned ManyLamps::parts_of(std::size_t rank) const {
    return rank < near_lamps ? patch_points : 1;
}

std::size_t ManyLamps::lamps_of_level(unsigned level) const {
    return std::min(std::size_t{LAMP_SLOTS} << level, rows_of(lamps_) * LAMP_SLOTS);
}

/// The next lamps of each cell's order.
std::vector<std::uint32_t> ManyLamps::rank_row(std::size_t rank) const {
    std::vector<std::uint32_t> row(order_.cells() * LAMP_SLOTS, no_lamp);
    const std::size_t count = std::min<std::size_t>(LAMP_SLOTS, lamps_ - std::min(rank, lamps_));
    for (std::size_t cell = 0; cell < order_.cells(); ++cell) {
        for (std::size_t slot = 0; slot < count; ++slot) {
            row[cell * LAMP_SLOTS + slot] = order_.order(cell)[rank + slot];
        }
    }
    return row;
}

std::vector<std::uint32_t> ManyLamps::row_of(std::span<const std::uint32_t> lamps) const {
    std::vector<std::uint32_t> row(order_.cells() * LAMP_SLOTS, no_lamp);
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = i % LAMP_SLOTS < lamps.size() ? lamps[i % LAMP_SLOTS] : no_lamp;
    }
    return row;
}

std::vector<std::vector<std::uint32_t>> ManyLamps::rows(std::size_t first, std::size_t end,
                                                        bool dark) const {
    std::vector<std::vector<std::uint32_t>> result;
    end = std::min(end, lamps_);
    for (std::size_t cell = 0; cell < order_.cells(); ++cell) {
        std::size_t found = 0;
        for (std::size_t rank = first; rank < end; ++rank) {
            const bool reaches = !complete_ || reaches_[cell * lamps_ + rank] != 0;
            if (reaches == dark) {
                continue;
            }
            const std::size_t row = found / LAMP_SLOTS;
            if (row == result.size()) {
                result.emplace_back(order_.cells() * LAMP_SLOTS, no_lamp);
            }
            result[row][cell * LAMP_SLOTS + found % LAMP_SLOTS] = order_.order(cell)[rank];
            ++found;
        }
    }
    return result;
}

/// Writes and reads points of the patches [first, end) of the order. Returns how many.
std::size_t ManyLamps::make_points(std::size_t first, std::size_t end, unsigned count) {
    const std::size_t points = (end - first) * count;
    bind_points();
    order_buffer_.bind_storage(BINDING_LAMP_ORDER);
    make_points_.set("first_patch", static_cast<unsigned>(first));
    make_points_.set("end_patch", static_cast<unsigned>(end));
    make_points_.set("parts", count);
    make_points_.set("shift", count == patch_points && rank_ < LAMP_SLOTS ? 0U : step_);
    make_points_.set("moved_objects", scene_.moved_objects());
    make_points_.dispatch(points);
    points_buffer_.read(std::span(points_).first(points));
    return points;
}

void ManyLamps::ask(std::span<const LampPoint> points, std::span<const std::uint32_t> row,
                    const Pass& pass, std::span<std::uint32_t> lit) const {
    LampQuestion question;
    question.lamps = pass.before ? places_before_ : places_;
    question.slots = row;
    question.boxes = pass.boxes;
    question.but_moved = pass.but_moved;
    question.rules.place = static_cast<unsigned>(pass.before ? Place::before : Place::now);
    question.rules.glass = GlassRule::clear;
    question.tie = static_cast<float>(TIE_SHARE) * scene_.diameter();
    scene_.tracer()->reach(points, question, lit);
}

void ManyLamps::reach(std::size_t points, std::span<const std::uint32_t> row, bool before) {
    points_buffer_.read(std::span(points_).first(points));
    Pass pass;
    pass.before = before;
    ask(std::span(points_).first(points), row, pass, std::span(lit_).first(points));
    masks_.write<std::uint32_t>(std::span(lit_).first(points), 0);
}

/// Lamps for the patches of a chunk among those that have not been looked at after this row, by
/// what they may bring, in strata; and whether they reach a point of the patch.
void ManyLamps::draw_chances(std::size_t patches, const Pass& pass, std::size_t first) {
    const std::size_t known = std::min(rank_ + LAMP_SLOTS, lamps_);
    std::vector<glm::uvec2> drawn(patches * LAMP_CHANCES, glm::uvec2(no_lamp, 0U));
    const std::size_t points = patches * pass.parts;
    std::vector<std::uint32_t> rows(points * LAMP_SLOTS, no_lamp);
    std::vector<LampPoint> own(points_.begin(),
                               points_.begin() + static_cast<std::ptrdiff_t>(points));
    for (std::size_t i = 0; i < points; ++i) {
        own[i].cell = static_cast<std::uint32_t>(i) | (own[i].cell & LampPoint::moved);
    }
    if (known < lamps_) {
        std::vector<double> sums;
        std::uint32_t cell_of_sums = LampPoint::no_cell;
        for (std::size_t i = 0; i < patches; ++i) {
            const std::uint32_t patch = patch_order_[first + i];
            const std::uint32_t cell = order_.cell_of()[patch];
            if (cell != cell_of_sums) {
                const auto weights = order_.weights(cell).subspan(known);
                sums.assign(weights.begin(), weights.end());
                std::partial_sum(sums.begin(), sums.end(), sums.begin());
                cell_of_sums = cell;
            }
            const double offset = static_cast<double>(random_number(patch, step_));
            for (std::size_t k = 0; k < LAMP_CHANCES; ++k) {
                const double at = (static_cast<double>(k) + offset) / LAMP_CHANCES * sums.back();
                const auto found = std::min<std::size_t>(
                    static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), at) -
                                             sums.begin()),
                    sums.size() - 1);
                const double weight =
                    sums.back() /
                    (LAMP_CHANCES * static_cast<double>(order_.weights(cell)[known + found]));
                const std::uint32_t lamp = order_.order(cell)[known + found];
                drawn[i * LAMP_CHANCES + k] = {
                    lamp, std::bit_cast<std::uint32_t>(static_cast<float>(weight))};
                rows[(i * pass.parts + k % pass.parts) * LAMP_SLOTS + k] = lamp;
            }
        }
    }
    std::vector<std::uint32_t> lit(points, 0);
    Pass plain = pass;
    plain.boxes = {};
    ask(own, rows, plain, lit);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const std::size_t k = i % LAMP_CHANCES;
        if ((lit[i / LAMP_CHANCES * pass.parts + k % pass.parts] >> k & 1U) == 0) {
            drawn[i].y = 0;
        }
    }
    chances_.write<glm::uvec2>(drawn, 0);
}

void ManyLamps::note_dark(std::span<const std::uint32_t> row, std::size_t points) {
    for (std::size_t i = 0; i < points; ++i) {
        const std::size_t cell = points_[i].cell & ~LampPoint::moved;
        for (std::size_t slot = 0; slot < LAMP_SLOTS && lit_[i] != 0; ++slot) {
            if ((lit_[i] >> slot & 1U) != 0 && row[cell * LAMP_SLOTS + slot] != no_lamp) {
                reaches_[cell * lamps_ + rank_ + slot] = 1;
            }
        }
    }
}

/// Adds the light of a row to the sums of the patches [first, end) of the order.
void ManyLamps::run(std::span<const std::uint32_t> row, const Pass& pass, std::size_t first,
                    std::size_t end) {
    const GlScope scope("many lamps");
    bind_row(row);
    sums_.bind_storage(BINDING_LAMP_SUMS);
    chances_.bind_storage(BINDING_LAMP_CHANCES);
    const std::size_t most = most_points_ / pass.parts;
    for (; first < end; first += most) {
        const std::size_t last = std::min(first + most, end);
        const std::size_t points = make_points(first, last, pass.parts);
        ask(std::span(points_).first(points), row, pass, std::span(lit_).first(points));
        masks_.write<std::uint32_t>(std::span(lit_).first(points), 0);
        if (pass.note) {
            note_dark(row, points);
        }
        if (pass.chances) {
            draw_chances(last - first, pass, first);
        }
        add_.set("first_patch", static_cast<unsigned>(first));
        add_.set("end_patch", static_cast<unsigned>(last));
        add_.set("parts", pass.parts);
        add_.set("sign", pass.sign);
        add_.set("chances", pass.chances);
        add_.dispatch(last - first);
    }
}

void ManyLamps::run_all(std::span<const std::uint32_t> row, const Pass& pass) {
    run(row, pass, 0, patch_order_.size());
}

void ManyLamps::restart() {
    rank_ = 0;
    next_patch_ = 0;
    levels_known_ = 0;
    complete_ = false;
    found_ = false;
    sums_.clear();
    std::fill(reaches_.begin(), reaches_.end(), std::uint8_t{0});
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
    changed_.clear();
    for (std::uint32_t k = 0; k < known_.size(); ++k) {
        if (lamps_differ(known_[k], now[k])) {
            changed_.push_back(k);
        }
    }
    ++version_;
    places_before_ = std::move(places_);
    places_ = places_of(now);
    const bool anew = first || changed_.size() > most_changed || unit_ != scene_.radiance_unit();
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

/// A row has been looked at by all patches.
void ManyLamps::finish_row() {
    rank_ += LAMP_SLOTS;
    next_patch_ = 0;
    ++step_;
    found_ = found_ || std::min(rank_, lamps_) >= quality_;
    if (rank_ < lamps_of_level(levels_known_)) {
        return;
    }
    sums_.bind_storage(BINDING_LAMP_SUMS);
    bind_levels();
    publish_.set("pass", 2U);
    publish_.set("level", levels_known_);
    publish_.set("patch_count", scene_.patch_count());
    publish_.dispatch(scene_.patch_count());
    ++levels_known_;
    complete_ = rank_ >= lamps_;
}

bool ManyLamps::advance(std::size_t points) {
    if (complete_ || found_) {
        return false;  // what has been found waits for publish_found()
    }
    Pass pass;
    pass.parts = parts_of(rank_);
    pass.chances = true;
    pass.note = true;
    const std::size_t end =
        std::min(next_patch_ + std::max<std::size_t>(points / pass.parts, 1), patch_order_.size());
    run(rank_row(rank_), pass, next_patch_, end);
    next_patch_ = end;
    if (next_patch_ == patch_order_.size()) {
        finish_row();
    }
    return true;
}

bool ManyLamps::publish_found() {
    if (!found_) {
        return false;
    }
    publish(false, true);
    return true;
}

/// What surfaces make of the light that patches have.
void ManyLamps::publish_reflection(bool radiance_follows) {
    bind_levels();
    publish_.set("patch_count", scene_.patch_count());
    publish_.set("radiance_follows", radiance_follows);
    publish_.set("level", levels_);
    publish_.set("pass", 1U);
    publish_.dispatch(scene_.patch_count());
}

void ManyLamps::publish(bool adds, bool radiance_follows) {
    sums_.bind_storage(BINDING_LAMP_SUMS);
    bind_levels();
    publish_.set("patch_count", scene_.patch_count());
    publish_.set("adds", adds);
    publish_.set("level", levels_);
    publish_.set("moved_objects", scene_.moved_objects());
    publish_.set("pass", 0U);
    publish_.dispatch(scene_.patch_count());
    publish_reflection(radiance_follows);
    quality_ = adds ? quality_ : std::min(rank_, lamps_);
    found_ = false;
}

void ManyLamps::draw_proposals(std::uint32_t seed) {
    if (proposals_.bytes() == 0) {
        return;
    }
    // All at first, and then one in so many of the cells: there are groups enough.
    constexpr std::size_t stride = 16;
    const bool all = drawn_.empty();
    drawn_.resize(order_.cells() * LAMP_SLOTS);
    tbb::parallel_for(std::size_t{0}, order_.cells(), [&](std::size_t cell) {
        if (!all && (cell + seed) % stride != 0) {
            return;
        }
        const auto weights = order_.weights(cell);
        // What has been looked at and reaches nothing here brings nothing.
        const std::size_t known = std::min(rank_, lamps_);
        std::vector<double> sums(lamps_);
        double sum = 0.0;
        for (std::size_t rank = 0; rank < lamps_; ++rank) {
            const bool dark = rank < known && reaches_[cell * lamps_ + rank] == 0;
            sum += dark ? 0.0 : static_cast<double>(weights[rank]);
            sums[rank] = sum;
        }
        const auto offset =
            static_cast<double>(random_number(static_cast<std::uint32_t>(cell), seed));
        for (std::size_t k = 0; k < LAMP_SLOTS; ++k) {
            const double at = (static_cast<double>(k) + offset) / LAMP_SLOTS * sum;
            const auto rank = std::min<std::size_t>(
                static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), at) -
                                         sums.begin()),
                lamps_ - 1);
            const double weight = sum / static_cast<double>(weights[rank]);
            drawn_[cell * LAMP_SLOTS + k] = {
                order_.order(cell)[rank], std::bit_cast<std::uint32_t>(static_cast<float>(weight))};
        }
    });
    proposals_.write<glm::uvec2>(drawn_, 0);
}

std::size_t ManyLamps::bytes() const {
    std::size_t sum = 0;
    for (const Buffer* buffer :
         {&cells_, &order_buffer_, &sums_, &levels_buffer_, &slots_, &points_buffer_, &masks_,
          &chances_, &proposals_, &lights_before_}) {
        sum += buffer->bytes();
    }
    return sum;
}

}  // namespace raybundle
