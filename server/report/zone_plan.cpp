// SPDX-License-Identifier: Apache-2.0
#include "report/zone_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/contours.h"
#include "report/html_text.h"

namespace raybundle {
namespace {

constexpr double plan_width = 640.0;   // px
constexpr double plan_height = 460.0;  // px, at most
constexpr double plan_border = 12.0;
constexpr std::size_t most_numbers = 150;

/// Five colours of viridis (Smith, van der Walt 2015), which grow lighter evenly.
glm::dvec3 viridis(double share) {
    constexpr std::array<std::array<double, 3>, 5> stops = {
        {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
    const double at = std::clamp(share, 0.0, 1.0) * 4.0;
    const auto below = static_cast<std::size_t>(std::min(at, 3.999));
    const auto colour = [&](std::size_t i) {
        return glm::dvec3(stops[i][0], stops[i][1], stops[i][2]);
    };
    return glm::mix(colour(below), colour(below + 1), at - static_cast<double>(below));
}

glm::dvec3 vector_of(const v1::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

/// From the zone's plane to the page.
class Sheet {
  public:
    explicit Sheet(const ReportZone& zone) : area_(zone.lattice) {
        length_ = glm::length(area_.u);
        width_ = glm::length(area_.v);
        u_ = area_.u / length_;
        v_ = glm::normalize(area_.v - glm::dot(area_.v, u_) * u_);
        // Seen from above v is up where u, v and the vertical are right-handed.
        turned_ = glm::cross(u_, v_).y < 0.0;
        low_ = glm::dvec2(std::numeric_limits<double>::max());
        high_ = -low_;
        take(glm::dvec2(0.0));
        take({length_, width_});
        for (const v1::Vec3& corner : zone.found.outline()) {
            take(local(vector_of(corner)));
        }
        const glm::dvec2 size = high_ - low_;
        scale_ = std::min((plan_width - 2.0 * plan_border) / size.x,
                          (plan_height - 2.0 * plan_border) / size.y);
    }

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& point) const { return on_page(local(point)); }
    /// Of the grid's columns and rows, the first point at (0, 0).
    [[nodiscard]] glm::dvec2 at(const glm::dvec2& cell, const GridSize& grid) const {
        return on_page(
            {(cell.x + 0.5) / grid.columns * length_, (cell.y + 0.5) / grid.rows * width_});
    }
    [[nodiscard]] glm::dvec2 step(const GridSize& grid) const {
        return scale_ * glm::dvec2(length_ / grid.columns, width_ / grid.rows);
    }
    [[nodiscard]] glm::dvec2 direction(const glm::dvec3& d) const {
        const glm::dvec2 on(glm::dot(d, u_), glm::dot(d, v_));
        return {on.x, turned_ ? on.y : -on.y};
    }
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] glm::dvec2 size() const { return scale_ * (high_ - low_) + 2.0 * plan_border; }

  private:
    [[nodiscard]] glm::dvec2 local(const glm::dvec3& point) const {
        return {glm::dot(point - area_.origin, u_), glm::dot(point - area_.origin, v_)};
    }
    [[nodiscard]] glm::dvec2 on_page(const glm::dvec2& p) const {
        return {plan_border + scale_ * (p.x - low_.x),
                plan_border + scale_ * (turned_ ? p.y - low_.y : high_.y - p.y)};
    }
    void take(const glm::dvec2& p) {
        low_ = glm::min(low_, p);
        high_ = glm::max(high_, p);
    }

    MeasuredArea area_;
    double length_ = 1.0, width_ = 1.0, scale_ = 1.0;
    glm::dvec3 u_{1.0, 0.0, 0.0}, v_{0.0, 0.0, 1.0};
    glm::dvec2 low_{0.0}, high_{1.0};
    bool turned_ = false;
};

struct Field {
    std::vector<double> values;  // of the whole grid; not a number: not measured
    double least = std::numeric_limits<double>::max();
    double largest = std::numeric_limits<double>::lowest();
};

Field field_of(const ReportZone& zone) {
    Field field;
    field.values.assign(zone.lattice_size.points(), std::numeric_limits<double>::quiet_NaN());
    const auto count = std::min<std::size_t>(zone.cells.size(),
                                             static_cast<std::size_t>(zone.found.points_size()));
    for (std::size_t i = 0; i < count; ++i) {
        const v1::Measured::Point& point = zone.found.points(static_cast<int>(i));
        if (point.has_value() && zone.cells[i] < field.values.size()) {
            const double value = static_cast<double>(point.value());
            field.values[zone.cells[i]] = value;
            field.least = std::min(field.least, value);
            field.largest = std::max(field.largest, value);
        }
    }
    return field;
}

std::string coloured_cells(const ReportZone& zone, const Sheet& sheet, const Field& field) {
    std::string svg;
    const glm::dvec2 step = sheet.step(zone.lattice_size);
    const double range = std::max(field.largest - field.least, 1e-12);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
        if (!std::isfinite(field.values[i])) {
            continue;
        }
        const glm::dvec2 middle =
            sheet.at(glm::dvec2(i % zone.lattice_size.columns, i / zone.lattice_size.columns),
                     zone.lattice_size);
        const glm::dvec3 c = viridis((field.values[i] - field.least) / range);
        svg += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
            "fill=\"rgb({:.0f},{:.0f},{:.0f})\" fill-opacity=\"0.45\"/>\n",
            middle.x - 0.5 * step.x, middle.y - 0.5 * step.y, step.x + 0.3, step.y + 0.3, c.x, c.y,
            c.z);
    }
    return svg;
}

std::string label(const glm::dvec2& at, const std::string& text, const char* kind) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", at.x, at.y, kind,
                       escaped(text));
}

std::string contour_lines(const ReportZone& zone, const Sheet& sheet, const Field& field,
                          const ReportWords& words) {
    std::string svg;
    std::string labels;
    const auto quantity = zone.found.quantity();
    // Levels are round in the unit that the report has.
    const bool feet = words.options().foot_candles && is_illuminance(quantity);
    const double unit = feet ? lux_per_foot_candle : 1.0;
    for (const double round : round_levels(field.least / unit, field.largest / unit)) {
        const auto pieces =
            contour(field.values, zone.lattice_size.columns, zone.lattice_size.rows, round * unit);
        std::string path;
        for (const ContourPiece& piece : pieces) {
            const glm::dvec2 a = sheet.at(piece.from, zone.lattice_size);
            const glm::dvec2 b = sheet.at(piece.to, zone.lattice_size);
            path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
        }
        if (!pieces.empty()) {
            svg += "<path class=\"isolux\" d=\"" + path + "\"/>\n";
            const ContourPiece& middle = pieces[pieces.size() / 2];
            labels += label(sheet.at(0.5 * (middle.from + middle.to), zone.lattice_size),
                            words.number(round * unit, quantity), "level");
        }
    }
    return svg + labels;
}

std::string numbers(const ReportZone& zone, const Sheet& sheet, const ReportWords& words) {
    std::string svg;
    for (const v1::Measured::Point& point : zone.found.points()) {
        const glm::dvec2 at = sheet.at(vector_of(point.position()));
        if (point.has_value()) {
            svg +=
                label(at, words.number(static_cast<double>(point.value()), zone.found.quantity()),
                      "value");
        } else {
            svg += label(at, point.inside() ? "▪" : "–", "value");
        }
        if (point.glare().state() == v1::Glare::RATED) {
            const glm::dvec2 way = 14.0 * sheet.direction(vector_of(point.glare().direction()));
            svg += fmt::format("<path class=\"gaze\" d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}\"/>\n", at.x,
                               at.y, way.x, way.y);
        }
    }
    return svg;
}

std::string outline(const ReportZone& zone, const Sheet& sheet) {
    std::string corners;
    for (const v1::Vec3& corner : zone.found.outline()) {
        const glm::dvec2 at = sheet.at(vector_of(corner));
        corners += fmt::format("{:.1f},{:.1f} ", at.x, at.y);
    }
    return corners.empty() ? "" : "<polygon class=\"outline\" points=\"" + corners + "\"/>\n";
}

/// A bar of a round length.
std::string length_scale(const Sheet& sheet, double top) {
    const double metres = std::pow(10.0, std::floor(std::log10(200.0 / sheet.scale())));
    return fmt::format(
        "<path class=\"outline\" d=\"M{:.1f} {:.1f}v6h{:.1f}v-6\"/>\n"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"scale\">{:g} m</text>\n",
        plan_border, top, metres * sheet.scale(), plan_border + metres * sheet.scale() + 8.0,
        top + 8.0, metres);
}

}  // namespace

std::string zone_plan(const ReportZone& zone, const ReportWords& words) {
    if (zone.lattice_size.points() == 0 || zone.found.points().empty()) {
        return "";
    }
    const Sheet sheet(zone);
    const Field field = field_of(zone);
    std::string svg;
    if (field.largest >= field.least) {
        svg += coloured_cells(zone, sheet, field);
        svg += contour_lines(zone, sheet, field, words);
    }
    svg += outline(zone, sheet);
    if (static_cast<std::size_t>(zone.found.points_size()) <= most_numbers) {
        svg += numbers(zone, sheet, words);
    }
    const glm::dvec2 size = sheet.size();
    svg += length_scale(sheet, size.y + 2.0);
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
               "role=\"img\" aria-label=\"{}\">\n",
               std::max(size.x, 160.0), size.y + 20.0, escaped(zone.found.name())) +
           svg + "</svg>\n";
}

}  // namespace raybundle
