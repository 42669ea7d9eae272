// SPDX-License-Identifier: Apache-2.0
#include "view/pixel_lamps.h"

#include <algorithm>
#include <span>

#include "gpu/gl_scope.h"
#include "solution/direct/many_lamps.h"

namespace raybundle {

namespace {

constexpr std::size_t most_changed = LAMP_SLOTS;  // lamps that change without a new beginning

void set_pixels(const ShaderProgram& program, std::size_t first, std::size_t end) {
    program.set("first_pixel", static_cast<unsigned>(first));
    program.set("end_pixel", static_cast<unsigned>(end));
}

}  // namespace

PixelLamps::PixelLamps(std::size_t pixels, bool glossy)
    : sums_("pixel lamps", (glossy ? 2 : 1) * pixels * sizeof(glm::vec4)) {}

void PixelLamps::begin(const ViewPrograms& programs, const FirstShot& first_shot,
                       std::size_t pixels) {
    pixels_ = pixels;
    version_ = first_shot.many()->version();
    level_ = 0;
    exact_ = false;
    done_ = false;
    planned_ = false;
    asked_end_ = 0;
    skipped_.clear();
    programs.first_shot.set("step_kind", LAMPS_BEGIN);
    programs.first_shot.set("all_lamps", false);
    count(programs, first_shot);
}

/// Begins, or makes what has been added count.
void PixelLamps::count(const ViewPrograms& programs, const FirstShot& first_shot) const {
    const ManyLamps& many = *first_shot.many();
    many.bind_levels();
    sums_.bind_storage(BINDING_LAMP_PIXELS);
    const ShaderProgram& program = programs.first_shot;
    program.set("first_pixel", 0U);
    program.set("end_pixel", static_cast<unsigned>(pixels_));
    program.set("patch_count", first_shot.patch_count());
    program.set("level", std::min(level_, many.levels() - 1));
    program.dispatch(pixels_);
}

void PixelLamps::add(const ViewPrograms& programs, ManyLamps& many, const Row& row,
                     std::size_t first, std::size_t end, bool before) const {
    const GlScope scope("pixel lamps");
    many.bind_row(row);
    sums_.bind_storage(BINDING_LAMP_PIXELS);
    set_pixels(programs.lamp_points, first, end);
    set_pixels(programs.first_shot, first, end);
    programs.lamp_points.dispatch(end - first);
    many.reach(end - first, row, before);
    programs.first_shot.set("sign", before ? -1.0F : 1.0F);
    programs.first_shot.dispatch(end - first);
}

void PixelLamps::change(const ViewPrograms& programs, const FirstShot& first_shot) {
    ManyLamps& many = *first_shot.many();
    const std::vector<std::uint32_t>& changed = many.changed();
    if (!exact_ || version_ + 1 != many.version() || many.all_changed() ||
        changed.size() > most_changed) {
        begin(programs, first_shot, pixels_);
        return;
    }
    version_ = many.version();
    done_ = true;
    if (changed.empty()) {
        return;
    }
    const Row row = many.row_of(changed);
    programs.first_shot.set("step_kind", LAMPS_CHANGE);
    for (const bool before : {true, false}) {
        first_shot.bind_lights(before ? many.lights_before() : first_shot.lights());
        for (std::size_t first = 0; first < pixels_; first += many.most_points()) {
            add(programs, many, row, first, std::min(first + many.most_points(), pixels_), before);
        }
    }
}

/// Which lamps come next. False where there is nothing to do, or not yet.
bool PixelLamps::plan(const ManyLamps& many) {
    if (planned_) {
        return true;
    }
    rows_.clear();
    row_ = 0;
    next_ = 0;
    if (level_ < many.levels()) {
        if (level_ >= many.levels_known()) {
            return false;
        }
        const std::size_t first = level_ > 0 ? many.lamps_of_level(level_ - 1) : 0;
        const std::size_t end = many.lamps_of_level(level_);
        if (many.complete()) {
            skipped_.emplace_back(first, end);
        }
        rows_ = many.rows(first, end, false);
    } else if (many.complete()) {
        for (const auto& [first, end] : skipped_) {
            auto rows = many.rows(first, end, true);
            std::move(rows.begin(), rows.end(), std::back_inserter(rows_));
        }
    } else {
        return false;
    }
    planned_ = true;
    return true;
}

void PixelLamps::finish_rows(const ViewPrograms& programs, const FirstShot& first_shot) {
    const unsigned levels = first_shot.many()->levels();
    planned_ = false;
    programs.first_shot.set("step_kind", LAMPS_COUNT);
    programs.first_shot.set("all_lamps", level_ + 1 >= levels);
    count(programs, first_shot);
    done_ = level_ >= levels;
    exact_ = level_ + 1 >= levels;
    ++level_;
}

/// Asks for the points of the next pixels.
void PixelLamps::request_points(const ViewPrograms& programs, const ManyLamps& many,
                                std::size_t points) {
    points = std::min({points, many.most_points(), pixels_});
    if (points_.bytes() < points * sizeof(LampPoint)) {
        points_ = Buffer("pixel lamp points", points * sizeof(LampPoint));
        back_.emplace("pixel lamp points", points_.bytes());
    }
    asked_end_ = std::min(next_ + points, pixels_);
    many.bind();
    points_.bind_storage(BINDING_LAMP_POINTS);
    set_pixels(programs.lamp_points, next_, asked_end_);
    programs.lamp_points.dispatch(asked_end_ - next_);
    back_->request(points_, (asked_end_ - next_) * sizeof(LampPoint));
}

bool PixelLamps::advance(const ViewPrograms& programs, const FirstShot& first_shot,
                         std::size_t points) {
    ManyLamps& many = *first_shot.many();
    if (done_ || version_ != many.version() || !plan(many)) {
        return false;
    }
    if (row_ < rows_.size() && asked_end_ > next_) {
        const GlScope scope("pixel lamps");
        many.bind_row(rows_[row_]);
        points_.bind_storage(BINDING_LAMP_POINTS);
        sums_.bind_storage(BINDING_LAMP_PIXELS);
        many.reach(back_->take_as<LampPoint>(), rows_[row_]);
        set_pixels(programs.first_shot, next_, asked_end_);
        programs.first_shot.set("step_kind", LAMPS_ADD);
        programs.first_shot.set("sign", 1.0F);
        programs.first_shot.dispatch(asked_end_ - next_);
        next_ = asked_end_;
        if (next_ == pixels_) {
            next_ = 0;
            asked_end_ = 0;
            ++row_;
        }
    }
    if (row_ < rows_.size()) {
        request_points(programs, many, points);
    }
    if (row_ == rows_.size()) {
        finish_rows(programs, first_shot);
    }
    return true;
}

}  // namespace raybundle
