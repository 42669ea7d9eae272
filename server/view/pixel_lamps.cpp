// SPDX-License-Identifier: Apache-2.0
#include "view/pixel_lamps.h"

#include <algorithm>
#include <span>

#include "gpu/gl_scope.h"
#include "solution/direct/many_lamps.h"

namespace raybundle {

namespace {

// As in shaders/view/view_lamps.comp.
constexpr unsigned step_begin = 0, step_add = 1, step_change = 2, step_count = 3;
constexpr std::size_t most_changed = LAMP_SLOTS;  // lamps that change without a new beginning

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
    skipped_.clear();
    programs.first_shot.set("step_kind", step_begin);
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
    for (const ShaderProgram* program : {&programs.lamp_points, &programs.first_shot}) {
        program->set("first_pixel", static_cast<unsigned>(first));
        program->set("end_pixel", static_cast<unsigned>(end));
    }
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
    programs.first_shot.set("step_kind", step_change);
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
    programs.first_shot.set("step_kind", step_count);
    programs.first_shot.set("all_lamps", level_ + 1 >= levels);
    count(programs, first_shot);
    done_ = level_ >= levels;
    exact_ = level_ + 1 >= levels;
    ++level_;
}

bool PixelLamps::advance(const ViewPrograms& programs, const FirstShot& first_shot,
                         std::size_t points) {
    ManyLamps& many = *first_shot.many();
    if (done_ || version_ != many.version() || !plan(many)) {
        return false;
    }
    if (row_ < rows_.size()) {
        const std::size_t end = std::min({next_ + points, next_ + many.most_points(), pixels_});
        programs.first_shot.set("step_kind", step_add);
        add(programs, many, rows_[row_], next_, end, false);
        next_ = end;
        if (next_ == pixels_) {
            next_ = 0;
            ++row_;
        }
    }
    if (row_ == rows_.size()) {
        finish_rows(programs, first_shot);
    }
    return true;
}

}  // namespace raybundle
