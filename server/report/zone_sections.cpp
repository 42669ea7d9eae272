// SPDX-License-Identifier: Apache-2.0
// Zones in the report.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "report/html_text.h"
#include "report/report_sections.h"
#include "report/zone_plan.h"

namespace raybundle {
namespace {

std::string with_interval(const ReportWords& w, double value, double low, double high,
                          v1::Measure::Quantity quantity) {
    return fmt::format("{} <span class=\"quiet\">({} – {})</span>", w.number(value, quantity),
                       w.number(low, quantity), w.number(high, quantity));
}

std::string ratio(double value, double low, double high) {
    return fmt::format("{:.2f} <span class=\"quiet\">({:.2f} – {:.2f})</span>", value, low, high);
}

std::string check_text(const v1::Measured& zone, const ReportWords& w) {
    if (zone.checks().empty()) {
        return zone.requirement().empty()
                   ? "–"
                   : escaped(zone.requirement()) + ": " +
                         w.of("asks nothing of this quantity, not checked",
                              "verlangt nichts von dieser Größe, nicht geprüft");
    }
    std::string text = escaped(zone.requirement()) + ": ";
    for (const v1::Check& check : zone.checks()) {
        const bool light = check.what() == "Em" || check.what() == "Ez" || check.what() == "Ev" ||
                           check.what() == "Esz";
        const std::string required =
            light ? w.number(static_cast<double>(check.required()), zone.quantity()) + " " +
                        w.unit(zone.quantity())
                  : fmt::format("{:g}", check.required());
        text += fmt::format("{} {} {} {}; ", check.what(), check.at_most() ? "≤" : "≥", required,
                            w.verdict(check.verdict()));
    }
    text.resize(text.size() - 2);
    return text;
}

std::string grid_text(const ReportZone& zone, const ReportWords& w) {
    const v1::Measured& found = zone.found;
    std::string text = fmt::format("{} {}", found.points_size(), w.of("points", "Punkte"));
    if (zone.lattice_size.points() > 0) {
        text += fmt::format(" ({} × {})", zone.lattice_size.columns, zone.lattice_size.rows);
    }
    if (found.has_spacing()) {
        text += fmt::format(fmt::runtime(w.of(", at most {:.2f} m apart as EN 12464-1 asks for",
                                              ", höchstens {:.2f} m Abstand nach EN 12464-1")),
                            found.spacing());
    }
    if (zone.measure.margin() > 0.0F) {
        text += fmt::format(fmt::runtime(w.of(", {:.2f} m along the edges left out",
                                              ", Randzone {:.2f} m ausgenommen")),
                            zone.measure.margin());
    }
    if (zone.measure.surrounding() > 0.0F) {
        text += fmt::format(fmt::runtime(w.of(", the strip of {:.2f} m around the area",
                                              ", Umgebungsbereich von {:.2f} m um die Fläche")),
                            zone.measure.surrounding());
    }
    const auto inside =
        std::count_if(found.points().begin(), found.points().end(),
                      [](const v1::Measured::Point& point) { return point.inside(); });
    if (inside > 0) {
        text += fmt::format(fmt::runtime(w.of("; {} lie in solids and are left out",
                                              "; {} liegen in Körpern und sind ausgenommen")),
                            inside);
    }
    if (zone.area > 0.0) {
        text += fmt::format("; {:.1f} m²", zone.area);
    }
    return text;
}

/// Of reflected light something comes everywhere in a building: what is black is mostly outside.
std::string dark_text(const v1::Measured& found, const ReportWords& w) {
    const auto q = found.quantity();
    if (found.direct() || q == v1::Measure::UGR || q == v1::Measure::DGP ||
        !(found.mean() > 0.0F)) {
        return "";
    }
    const auto dark = std::count_if(
        found.points().begin(), found.points().end(), [](const v1::Measured::Point& point) {
            return point.has_value() && !point.inside() && point.value() == 0.0F;
        });
    return dark == 0 ? ""
                     : fmt::format(" {} {}", dark,
                                   w.of("of the points are dark and counted: they may lie outside "
                                        "of the rooms.",
                                        "der Punkte sind dunkel und mitgezählt: Sie liegen "
                                        "vielleicht außerhalb der Räume."));
}

/// The place that glares most, and what glares there.
std::string glare_text(const v1::Measured& found, const ReportWords& w) {
    const v1::Measured::Point* worst = nullptr;
    std::map<std::string, std::size_t> words;
    for (const v1::Measured::Point& point : found.points()) {
        if (point.has_glare() && !point.glare().words().empty()) {
            ++words[point.glare().words()];
        }
        if (point.has_value() && point.has_glare() &&
            (worst == nullptr || point.value() > worst->value())) {
            worst = &point;
        }
    }
    std::string html;
    if (worst != nullptr) {
        const v1::Glare& glare = worst->glare();
        html += fmt::format(
            "<p>{} {} {} ({:.2f}, {:.2f}, {:.2f}) m, {} ({:.2f}, {:.2f}, {:.2f}).</p>\n",
            w.of("Worst:", "Am stärksten:"),
            with_interval(w, worst->value(), worst->low(), worst->high(), found.quantity()),
            w.of("at", "bei"), worst->position().x(), worst->position().y(), worst->position().z(),
            w.of("looking along", "Blick entlang"), glare.direction().x(), glare.direction().y(),
            glare.direction().z());
        std::vector<std::vector<std::string>> rows;
        for (const v1::Glare::Source& source : glare.sources()) {
            rows.push_back(
                {escaped(source.name()), fmt::format("{:.0f} %", 100.0F * source.share()),
                 three_digits(source.luminance()), fmt::format("{:.3g}", source.solid_angle()),
                 three_digits(source.position_index())});
        }
        html += html_table({w.of("Source of glare", "Blendquelle"), w.of("Share", "Anteil"),
                            "cd/m²", "sr", w.of("Position index", "Positionsindex")},
                           rows);
    }
    for (const auto& [text, count] : words) {
        html += fmt::format("<p class=\"quiet\">{} {}: {}.</p>\n", count, w.of("places", "Plätze"),
                            escaped(text));
    }
    return html;
}

bool is_material(const v1::Scene& scene, std::uint32_t number) {
    return std::any_of(scene.lights().begin(), scene.lights().end(), [&](const v1::Light& light) {
        return light.id() == number && light.kind() == v1::Light::AREA;
    });
}

/// What lights it, and how well colours look in that light: types with their number. A glowing
/// material, on however many luminaires, has none: 0.
std::string luminaire_text(const v1::Measured& found, const v1::Scene& scene,
                           const ReportWords& w) {
    constexpr std::size_t most = 12;
    std::vector<std::pair<std::pair<std::string, std::string>, int>> types;
    for (const v1::Measured::Luminaire& luminaire : found.luminaires()) {
        const int one = is_material(scene, luminaire.light()) ? 0 : 1;
        const std::pair<std::string, std::string> type(luminaire.name(),
                                                       w.colour_rendering(luminaire));
        const auto known = std::find_if(types.begin(), types.end(),
                                        [&](const auto& other) { return other.first == type; });
        if (known == types.end()) {
            types.emplace_back(type, one);
        } else {
            known->second += one;
        }
    }
    if (types.empty()) {
        return "";
    }
    std::string text;
    for (std::size_t i = 0; i < std::min(types.size(), most); ++i) {
        const auto& [type, count] = types[i];
        text += fmt::format("{}{}{}, {}", text.empty() ? "" : "; ",
                            count > 0 ? fmt::format("{} × ", count)
                                      : w.of("all surfaces of ", "allen Flächen von "),
                            type.first.empty() ? w.of("lamp without a name", "Leuchte ohne Namen")
                                               : escaped(type.first),
                            type.second.empty() ? w.of("Ra not stated", "Ra nicht angegeben")
                                                : "Ra " + type.second);
    }
    if (types.size() > most) {
        text += fmt::format("; {} {}", types.size() - most, w.of("more types", "weitere Typen"));
    }
    return std::string("<p>") + w.of("Lit by ", "Beleuchtet von ") + text + ".</p>\n";
}

std::string zone_section(const ReportZone& zone, const v1::Scene& scene, const ReportWords& w) {
    const v1::Measured& found = zone.found;
    std::string html = "<div class=\"zone\"><h3>" + escaped(found.name()) + "</h3>\n<p>" +
                       w.quantity(found.quantity()) + ". " + grid_text(zone, w) + ". ";
    html += found.maintained() ? w.of("Maintained values.", "Wartungswerte.")
                               : w.of("Initial values.", "Neuwerte.");
    if (found.direct()) {
        html += std::string(" ") + w.of("Direct light only.", "Nur direktes Licht.");
    }
    html += dark_text(found, w);
    html += "</p>\n";
    html += zone_plan(zone, w) + "</div>\n";
    if (found.has_mean()) {
        const auto q = found.quantity();
        const std::string unit = w.unit(q).empty() ? "" : " (" + w.unit(q) + ")";
        std::vector<std::string> heads = {w.of("Mean", "Mittel") + unit, "Min" + unit,
                                          "Max" + unit};
        std::vector<std::string> row = {
            with_interval(w, found.mean(), found.mean_low(), found.mean_high(), q),
            with_interval(w, found.minimum(), found.minimum_low(), found.minimum_high(), q),
            with_interval(w, found.maximum(), found.maximum_low(), found.maximum_high(), q)};
        if (found.has_uniformity()) {
            heads.insert(heads.end(), {"Uo (min/mean)", "Ud (min/max)"});
            row.insert(row.end(),
                       {ratio(found.uniformity(), found.uniformity_low(), found.uniformity_high()),
                        ratio(found.diversity(), found.diversity_low(), found.diversity_high())});
        }
        html += html_table(heads, {row});
    } else {
        html += std::string("<p class=\"quiet\">") +
                w.of("Nothing is known yet.", "Noch nichts bekannt.") + "</p>\n";
    }
    html += luminaire_text(found, scene, w);
    if (!found.requirement().empty()) {
        html += "<p>" + check_text(found, w) + "</p>\n";
    }
    return html + glare_text(found, w);
}

}  // namespace

std::string overview_section(const ReportData& data, const ReportWords& w) {
    if (data.zones.empty()) {
        return std::string("<p>") +
               w.of("No zones are kept with the project.", "Das Projekt hat keine Zonen.") +
               "</p>\n";
    }
    std::vector<std::vector<std::string>> rows;
    for (const ReportZone& zone : data.zones) {
        const v1::Measured& found = zone.found;
        const auto q = found.quantity();
        const bool glare = q == v1::Measure::UGR || q == v1::Measure::DGP;
        const std::string value =
            glare && found.has_maximum()
                ? with_interval(w, found.maximum(), found.maximum_low(), found.maximum_high(), q)
            : found.has_mean()
                ? with_interval(w, found.mean(), found.mean_low(), found.mean_high(), q) + " " +
                      w.unit(q)
                : "–";
        rows.push_back({escaped(found.name()), w.quantity(q) + (glare ? ", max" : ""), value,
                        found.has_uniformity() ? ratio(found.uniformity(), found.uniformity_low(),
                                                       found.uniformity_high())
                                               : "–",
                        escaped(found.requirement()),
                        found.checks().empty() && !found.requirement().empty()
                            ? w.of("not checked", "nicht geprüft")
                            : w.verdict(found.verdict())});
    }
    return std::string("<h2>") + w.of("Zones at a glance", "Zonen auf einen Blick") + "</h2>\n" +
           html_table({w.of("Zone", "Zone"), w.of("Quantity", "Größe"),
                       w.of("Value (95 % interval)", "Wert (95-%-Intervall)"), "Uo",
                       w.of("Requirement", "Anforderung"), w.of("Result", "Ergebnis")},
                      rows);
}

std::string zone_sections(const ReportData& data, const ReportWords& w) {
    if (data.zones.empty()) {
        return "";
    }
    std::string html = std::string("<h2>") + w.of("Zones", "Zonen") + "</h2>\n";
    for (const ReportZone& zone : data.zones) {
        html += zone_section(zone, data.scene, w);
    }
    return html;
}

}  // namespace raybundle
