// SPDX-License-Identifier: Apache-2.0
#include "report/report_sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "report/html_text.h"

namespace raybundle {
namespace {

std::string heading(const ReportWords& w, const char* english, const char* german) {
    return std::string("<h2>") + w.of(english, german) + "</h2>\n";
}

bool is_lamp(const v1::Light& light) {
    return light.kind() != v1::Light::SKY && light.kind() != v1::Light::ENVIRONMENT &&
           light.kind() != v1::Light::DIRECTIONAL;
}

/// Share of the light that its file gives a lamp which it sends now: dimmed by its dimmer or by its
/// intensity, which flux and power follow.
double share_of(const v1::Light& light) {
    const double dim = light.has_dim() ? static_cast<double>(light.dim()) : 1.0;
    const double set =
        light.loaded_intensity() > 0.0F
            ? static_cast<double>(light.intensity()) / static_cast<double>(light.loaded_intensity())
            : 1.0;
    return light.on() ? dim * set : 0.0;
}

}  // namespace

ReportPower power_of(const ReportData& data) {
    ReportPower power;
    for (const v1::Light& light : data.scene.lights()) {
        if (is_lamp(light)) {
            power.watts +=
                light.has_watts() ? share_of(light) * static_cast<double>(light.watts()) : 0.0;
            power.unknown += light.has_watts() ? 0 : 1;
            power.stated = power.stated || light.has_watts();
        }
    }
    return power;
}

double lit_area(const ReportData& data, const ReportOptions& options) {
    return options.area > 0.0 ? options.area : data.floor_area;
}

std::string project_section(const ReportData& data, const ReportWords& w) {
    std::string html =
        "<h1>" + escaped(data.scene.name()) + "</h1>\n<p class=\"quiet\">" +
        w.of("Lighting report", "Lichtbericht") + ", " + ReportWords::time(data.made_at_ms) +
        fmt::format(fmt::runtime(w.of(", after change {}", ", nach Änderung {}")), data.epoch) +
        ". " + escaped(data.server) + ".</p>\n";
    std::vector<std::vector<std::string>> rows = {
        {w.of("Daylight", "Tageslicht"), daylight_text(data.scene.daylight(), w)}};
    std::string scenes;
    for (const auto& scene : data.scene.lighting_scenes()) {
        scenes += (scenes.empty() ? "" : ", ") + escaped(scene.name());
    }
    if (!scenes.empty()) {
        rows.push_back({w.of("Lighting scenes kept", "Gespeicherte Lichtszenen"), scenes});
    }
    const v1::Bounds& bounds = data.scene.bounds();
    rows.push_back(
        {w.of("Size of the model", "Größe des Modells"),
         fmt::format("{:.1f} m × {:.1f} m × {:.1f} m", bounds.max().x() - bounds.min().x(),
                     bounds.max().z() - bounds.min().z(), bounds.max().y() - bounds.min().y())});
    return html + html_table({w.of("Project", "Projekt"), ""}, rows);
}

std::string luminaire_section(const ReportData& data, const ReportWords& w) {
    // The last one: a material that glows, on however many lamps.
    using Type =
        std::tuple<std::string, std::string, float, float, std::string, float, double, bool>;
    std::map<Type, int> types;  // number of them
    double flux = 0.0;
    bool glowing = false;
    for (const v1::Light& light : data.scene.lights()) {
        if (is_lamp(light)) {
            const bool material = light.kind() == v1::Light::AREA;
            ++types[{light.name(), light.group(), light.flux(), light.watts(),
                     w.colour_rendering(light), light.maintenance_factor(), share_of(light),
                     material}];
            glowing = glowing || material;
            flux += share_of(light) * static_cast<double>(light.flux());
        }
    }
    if (types.empty()) {
        return "";
    }
    std::vector<std::vector<std::string>> rows;
    for (const auto& [type, number] : types) {
        const auto& [name, group, lumens, watts, rendering, factor, share, material] = type;
        rows.push_back({escaped(name), material ? "–" : std::to_string(number),
                        lumens > 0.0F ? fmt::format("{:.0f}", lumens) : "–",
                        watts > 0.0F ? fmt::format("{:.1f}", watts) : "–",
                        rendering.empty() ? "–" : rendering, fmt::format("{:.2f}", factor),
                        group.empty() ? "–" : escaped(group),
                        fmt::format("{:.0f} %", 100.0 * share)});
    }
    std::string html =
        heading(w, "Luminaires", "Leuchten") +
        html_table({w.of("Type", "Typ"), w.of("Number", "Anzahl"), "lm", "W", "Ra",
                    w.of("MF", "WF"), w.of("Group", "Gruppe"), w.of("Light now", "Licht jetzt")},
                   rows);
    const ReportPower power = power_of(data);
    const double area = lit_area(data, w.options());
    html += fmt::format(
        "<p>{}: {:.0f} lm",
        w.of("All together, as they are switched", "Zusammen, wie sie geschaltet sind"), flux);
    html += power.stated ? fmt::format(", {:.0f} W", power.watts)
                         : w.of("; – W, W/m² and LENI: no file states a power",
                                "; – W, W/m² und LENI: keine Datei nennt eine Leistung");
    if (area > 0.0 && power.stated) {
        html += fmt::format(
            fmt::runtime(w.of("; {:.2f} W/m² and LENI {:.1f} kWh/(m² a) with {:.0f} h a year, on "
                              "{:.1f} m² of floor ({})",
                              "; {:.2f} W/m² und LENI {:.1f} kWh/(m² a) bei {:.0f} h im Jahr, auf "
                              "{:.1f} m² Grundfläche ({})")),
            power.watts / area, power.watts * w.options().hours / 1000.0 / area, w.options().hours,
            area,
            w.options().area > 0.0
                ? w.of("as stated", "wie angegeben")
                : w.of("rooms with luminaires, by the model", "Räume mit Leuchten, laut Modell"));
    } else if (power.stated) {
        html += w.of("; no W/m² and LENI: no luminaire is in a room with a floor and a ceiling",
                     "; keine W/m² und LENI: keine Leuchte ist in einem Raum mit Boden und Decke");
    }
    html += ".</p>\n";
    if (glowing) {
        html += std::string("<p class=\"quiet\">") +
                w.of(
                    "Lamps that are a glowing material have no number: lm is that of all surfaces "
                    "of the material.",
                    "Leuchten aus leuchtendem Material haben keine Anzahl: lm gilt für alle "
                    "Flächen des Materials.") +
                "</p>\n";
    }
    if (power.stated && power.unknown > 0) {
        html +=
            fmt::format("<p class=\"quiet\">{} {}.</p>\n",
                        w.of("Lamps without a stated power, which are not in W, W/m² and LENI:",
                             "Leuchten ohne Leistungsangabe, in W, W/m² und LENI nicht enthalten:"),
                        power.unknown);
    }
    return html;
}

std::string pin_section(const ReportData& data, const ReportWords& w) {
    std::vector<std::vector<std::string>> rows;
    for (const v1::PinChanged& pin : data.pins) {
        std::string thread = escaped(pin.text());
        for (const v1::PinReply& reply : pin.replies()) {
            thread += "<br><span class=\"quiet\">" + escaped(reply.by_name()) + ", " +
                      ReportWords::time(reply.at_ms()) + ":</span> " + escaped(reply.text());
        }
        rows.push_back(
            {std::to_string(pin.pin()), thread,
             pin.resolved() ? w.of("resolved", "erledigt") : w.of("open", "offen"),
             pin.assigned_to().empty() ? "–" : escaped(pin.assigned_to()),
             w.number(pin.illuminance(), v1::Measure::HORIZONTAL) + " " +
                 w.unit(v1::Measure::HORIZONTAL) +
                 (pin.has_change() ? fmt::format(" ({:+.0f} %)", 100.0F * pin.change()) : ""),
             escaped(pin.by_name()) + ", " + ReportWords::time(pin.set_at_ms())});
    }
    if (rows.empty()) {
        return "";
    }
    return heading(w, "Pins", "Anmerkungen") +
           html_table({"#", w.of("Thread", "Verlauf"), w.of("State", "Stand"),
                       w.of("Assigned to", "Zuständig"), w.of("Light there", "Licht dort"),
                       w.of("By", "Von")},
                      rows);
}

std::string method_section(const ReportData& data, const ReportWords& w) {
    std::string html = heading(w, "Method and accuracy", "Verfahren und Genauigkeit");
    html += w.of(
        "<p>Every point of a zone gathers light by paths of its own, independent of any picture: "
        "direct light of all luminaires, light that comes through panes and by mirrors, and light "
        "reflected by all surfaces. Each number has a 95 % interval, from the scatter of 16 "
        "independent batches of paths (Student's t). A requirement is met where the whole interval "
        "lies on the right side of the limit, missed where it lies on the wrong side, and not yet "
        "known where it holds the limit.</p>"
        "<p>Intervals state the error of the calculation. They do not hold what the model leaves "
        "open: reflectances, furniture, the tolerance of luminaires, dirt.</p>"
        "<p>UGR is that of CIE 117:1995: 8 log10(0.25/Lb Σ L²ω/p²), the luminance L and solid "
        "angle ω "
        "of the luminous parts that are seen from the place, Guth's position index p, and Lb from "
        "the illuminance at the eye without the luminaires' direct light. Luminaires below the "
        "line "
        "of sight and those with H/R above 2 are left out and counted. Places outside of the "
        "method's range have words instead of a number. DGP is that of Wienold and Christoffersen "
        "(2006).</p>",
        "<p>Jeder Punkt einer Zone sammelt Licht auf eigenen Strahlwegen, unabhängig von jedem "
        "Bild: "
        "direktes Licht aller Leuchten, Licht durch Scheiben und über Spiegel und von allen "
        "Flächen "
        "reflektiertes Licht. Zu jeder Zahl gehört ein 95-%-Intervall aus der Streuung von 16 "
        "unabhängigen Gruppen von Strahlwegen (Student-t). Eine Anforderung ist erfüllt, wenn das "
        "ganze Intervall auf der richtigen Seite der Grenze liegt, nicht erfüllt, wenn es auf der "
        "falschen liegt, und noch offen, wenn es die Grenze enthält.</p>"
        "<p>Die Intervalle nennen den Fehler der Berechnung, nicht, was das Modell offenlässt: "
        "Reflexionsgrade, Möblierung, Toleranzen der Leuchten, Schmutz.</p>"
        "<p>UGR nach CIE 117:1995: 8 log10(0,25/Lb Σ L²ω/p²), mit Leuchtdichte L und Raumwinkel ω "
        "der "
        "gesehenen leuchtenden Teile, Positionsindex p nach Guth und Lb aus der "
        "Beleuchtungsstärke am Auge ohne direktes Licht der Leuchten. Leuchten unter der "
        "Blickrichtung und solche mit H/R über 2 sind ausgenommen und gezählt. Plätze außerhalb "
        "des "
        "Verfahrens haben Worte statt einer Zahl. DGP nach Wienold und Christoffersen (2006).</p>");
    if (data.picture_error) {
        html += fmt::format("<p>{} {:.1f} %.</p>\n",
                            w.of("Error of the picture that was seen at the time:",
                                 "Fehler des Bildes zu dieser Zeit:"),
                            100.0 * *data.picture_error);
    }
    return html;
}

}  // namespace raybundle
