// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/many_lamps.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"
#include "trace/facet_tracer.h"

namespace raybundle {

namespace {

static_assert(lamp_slots == LAMP_SLOTS && LampPoint::moved == LAMP_POINT_MOVED);
constexpr std::size_t most_scratch = 1U << 16U;  // points

std::size_t rows_of(std::size_t lamps) {
    return (lamps + LAMP_SLOTS - 1) / LAMP_SLOTS;
}

unsigned levels_of(std::size_t lamps) {
    return static_cast<unsigned>(std::bit_width(std::max<std::size_t>(rows_of(lamps), 1) - 1)) + 1;
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

/// Writes points of the patches [first, end) of the order to the bound buffer.
void ManyLamps::write_points(std::size_t first, std::size_t end, unsigned count) {
    order_buffer_.bind_storage(BINDING_LAMP_ORDER);
    make_points_.set("first_patch", static_cast<unsigned>(first));
    make_points_.set("end_patch", static_cast<unsigned>(end));
    make_points_.set("parts", count);
    make_points_.set("shift", count == patch_points && rank_ < LAMP_SLOTS ? 0U : step_);
    make_points_.set("moved_objects", scene_.moved_objects());
    make_points_.dispatch((end - first) * count);
}

/// Writes and reads them. Returns how many.
std::size_t ManyLamps::make_points(std::size_t first, std::size_t end, unsigned count) {
    const std::size_t points = (end - first) * count;
    bind_points();
    write_points(first, end, count);
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

void ManyLamps::reach(std::span<const LampPoint> points, std::span<const std::uint32_t> row,
                      bool before) {
    Pass pass;
    pass.before = before;
    const auto lit = std::span(lit_).first(points.size());
    ask(points, row, pass, lit);
    masks_.write<std::uint32_t>(lit, 0);
}

void ManyLamps::reach(std::size_t points, std::span<const std::uint32_t> row, bool before) {
    points_buffer_.read(std::span(points_).first(points));
    reach(std::span(points_).first(points), row, before);
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
        make_points(first, last, pass.parts);
        add_points(row, pass, first, last);
    }
}

/// The same for patches whose points are known and bound.
void ManyLamps::add_points(std::span<const std::uint32_t> row, const Pass& pass, std::size_t first,
                           std::size_t end) {
    const std::size_t points = (end - first) * pass.parts;
    ask(std::span(points_).first(points), row, pass, std::span(lit_).first(points));
    masks_.write<std::uint32_t>(std::span(lit_).first(points), 0);
    if (pass.note) {
        note_dark(row, points);
    }
    if (pass.chances) {
        draw_chances(end - first, pass, first);
    }
    order_buffer_.bind_storage(BINDING_LAMP_ORDER);
    add_.set("first_patch", static_cast<unsigned>(first));
    add_.set("end_patch", static_cast<unsigned>(end));
    add_.set("parts", pass.parts);
    add_.set("sign", pass.sign);
    add_.set("chances", pass.chances);
    add_.dispatch(end - first);
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
    slice_.end = 0;
    slice_.row.clear();
    sums_.clear();
    std::fill(reaches_.begin(), reaches_.end(), std::uint8_t{0});
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
    if (slice_.end > next_patch_) {
        const GlScope scope("many lamps");
        Pass pass;
        pass.parts = parts_of(rank_);
        pass.chances = true;
        pass.note = true;
        const auto found = slice_.back->take_as<LampPoint>();
        std::copy(found.begin(), found.end(), points_.begin());
        bind_row(slice_.row);
        slice_.points.bind_storage(BINDING_LAMP_POINTS);
        sums_.bind_storage(BINDING_LAMP_SUMS);
        chances_.bind_storage(BINDING_LAMP_CHANCES);
        add_points(slice_.row, pass, next_patch_, slice_.end);
        next_patch_ = slice_.end;
        if (next_patch_ == patch_order_.size()) {
            finish_row();
        }
    }
    if (!complete_) {
        request_slice(points);
    }
    return true;
}

/// Asks for the points of the next patches.
void ManyLamps::request_slice(std::size_t points) {
    points = std::min(std::max<std::size_t>(points, patch_points), most_points_);
    if (slice_.points.bytes() < points * sizeof(LampPoint)) {
        slice_.points = Buffer("lamp slice points", points * sizeof(LampPoint));
        slice_.back.emplace("lamp slice points", slice_.points.bytes());
    }
    if (slice_.row.empty() || slice_.rank != rank_) {
        slice_.row = rank_row(rank_);
        slice_.rank = rank_;
    }
    const unsigned parts = parts_of(rank_);
    slice_.end = std::min(next_patch_ + points / parts, patch_order_.size());
    slice_.points.bind_storage(BINDING_LAMP_POINTS);
    write_points(next_patch_, slice_.end, parts);
    slice_.back->request(slice_.points, (slice_.end - next_patch_) * parts * sizeof(LampPoint));
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

std::size_t ManyLamps::bytes() const {
    std::size_t sum = 0;
    for (const Buffer* buffer :
         {&cells_, &order_buffer_, &sums_, &levels_buffer_, &slots_, &points_buffer_, &masks_,
          &chances_, &proposals_, &lights_before_}) {
        sum += buffer->bytes();
    }
    return sum + 2 * slice_.points.bytes();
}

}  // namespace raybundle
