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

/// Share of its full light that a lamp sends now.
double share_of(const v1::Light& light) {
    const double dim = light.has_dim() ? static_cast<double>(light.dim()) : 1.0;
    return light.on() ? dim : 0.0;
}

std::string daylight_text(const v1::SetDaylight& day, const ReportWords& w) {
    if (day.sky().empty() || day.sky() == "none") {
        return w.of("no sky", "kein Himmel");
    }
    if (day.sky() == "loaded") {
        return w.of("as the scene's file has it", "wie in der Datei der Szene");
    }
    std::string text = escaped(day.sky());
    if (!day.time().empty()) {
        text += ", " + escaped(day.time());
    }
    if (day.has_place()) {
        text += fmt::format(", {:.2f}° N, {:.2f}° {}", day.place().latitude(),
                            day.place().longitude(), w.of("E", "O"));
    }
    if (day.has_sun_elevation()) {
        text +=
            fmt::format(", {} {:.1f}°", w.of("sun's elevation", "Sonnenhöhe"), day.sun_elevation());
    }
    return text;
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

double lit_area(const ReportData& data) {
    double area = 0.0;
    for (const ReportZone& zone : data.zones) {
        const bool counts = zone.measure.quantity() == v1::Measure::HORIZONTAL &&
                            zone.measure.surrounding() == 0.0F;
        area += counts ? zone.area : 0.0;
    }
    return area;
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
    using Type = std::tuple<std::string, std::string, float, float, std::string, float, float>;
    std::map<Type, std::pair<int, double>> types;  // number of them, and share of the light
    double flux = 0.0;
    for (const v1::Light& light : data.scene.lights()) {
        if (is_lamp(light)) {
            auto& [count, share] =
                types[{light.name(), light.group(), light.flux(), light.watts(),
                       w.colour_rendering(light), light.maintenance_factor(), light.dim()}];
            ++count;
            share += share_of(light);
            flux += share_of(light) * static_cast<double>(light.flux());
        }
    }
    if (types.empty()) {
        return "";
    }
    std::vector<std::vector<std::string>> rows;
    for (const auto& [type, number] : types) {
        const auto& [name, group, lumens, watts, rendering, factor, dim] = type;
        rows.push_back({escaped(name), std::to_string(number.first),
                        lumens > 0.0F ? fmt::format("{:.0f}", lumens) : "–",
                        watts > 0.0F ? fmt::format("{:.1f}", watts) : "–",
                        rendering.empty() ? "–" : rendering, fmt::format("{:.2f}", factor),
                        group.empty() ? "–" : escaped(group),
                        fmt::format("{:.0f} %", 100.0 * number.second / number.first)});
    }
    std::string html =
        heading(w, "Luminaires", "Leuchten") +
        html_table({w.of("Type", "Typ"), w.of("Number", "Anzahl"), "lm", "W", "Ra",
                    w.of("MF", "WF"), w.of("Group", "Gruppe"), w.of("Light now", "Licht jetzt")},
                   rows);
    const ReportPower power = power_of(data);
    const double area = lit_area(data);
    html += fmt::format(
        "<p>{}: {:.0f} lm",
        w.of("All together, as they are switched", "Zusammen, wie sie geschaltet sind"), flux);
    html += power.stated ? fmt::format(", {:.0f} W", power.watts)
                         : w.of("; – W, W/m² and LENI: no file states a power",
                                "; – W, W/m² und LENI: keine Datei nennt eine Leistung");
    if (area > 0.0 && power.stated) {
        html += fmt::format(
            fmt::runtime(w.of(
                "; {:.2f} W/m² and LENI {:.1f} kWh/(m² a) with {:.0f} h a year, of {:.1f} m² of "
                "zones of horizontal illuminance",
                "; {:.2f} W/m² und LENI {:.1f} kWh/(m² a) bei {:.0f} h im Jahr, auf {:.1f} m² "
                "Zonen horizontaler Beleuchtungsstärke")),
            power.watts / area, power.watts * w.options().hours / 1000.0 / area, w.options().hours,
            area);
    }
    html += ".</p>\n";
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

/// A blank and the name of the entry with that number; empty: there is none (any more).
template <typename Entries>
std::string named(const Entries& entries, std::uint32_t id) {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [id](const auto& entry) { return entry.id() == id; });
    return found == entries.end() ? "" : " " + escaped(found->name());
}

std::uint32_t object_of(const v1::SceneChanged& change) {
    return change.has_move_object()     ? change.move_object().object()
           : change.has_remove_object() ? change.remove_object().object()
                                        : 0;
}

/// A colon and the name of the object that a change is about.
std::string named_object(const v1::SceneChanged& change, const ReportData& data) {
    const auto found = data.objects.find(object_of(change));
    return found == data.objects.end() || found->second.empty() ? ""
                                                                : ": " + escaped(found->second);
}

/// How long a light takes for it.
std::string fade_text(const v1::SetLight& set, const ReportWords& w) {
    return set.fade_seconds() > 0.0F
               ? fmt::format("{}{:.1f} s", w.of(", over ", ", in "), set.fade_seconds())
               : "";
}

/// What a change has done, in words.
std::string change_text(const v1::SceneChanged& change, const ReportData& data,
                        const ReportWords& w) {
    const v1::Scene& scene = data.scene;
    switch (change.change_case()) {
        case v1::SceneChanged::kMoveObject:
            return w.of("object moved", "Objekt bewegt") + named_object(change, data);
        case v1::SceneChanged::kSetLight:
            return w.of("light", "Licht") + named(scene.lights(), change.set_light().light()) +
                   fade_text(change.set_light(), w);
        case v1::SceneChanged::kSetMaterial:
            return w.of("material", "Material") +
                   named(scene.materials(), change.set_material().material());
        case v1::SceneChanged::kSetDaylight:
            return w.of("daylight: ", "Tageslicht: ") + daylight_text(change.set_daylight(), w);
        case v1::SceneChanged::kAddObject:
            return (change.add_object().removed()
                        ? w.of("object removed: ", "Objekt entfernt: ")
                        : w.of("object added: ", "Objekt hinzugefügt: ")) +
                   escaped(change.add_object().name());
        case v1::SceneChanged::kRemoveObject:
            return w.of("object removed", "Objekt entfernt") + named_object(change, data);
        case v1::SceneChanged::kAddLuminaire:
            return change.add_luminaire().removed()
                       ? w.of("luminaire removed", "Leuchte entfernt")
                       : w.of("luminaire added: ", "Leuchte hinzugefügt: ") +
                             escaped(change.add_luminaire().name());
        case v1::SceneChanged::kRemoveLight:
            return w.of("luminaire removed", "Leuchte entfernt");
        case v1::SceneChanged::CHANGE_NOT_SET:
            break;
    }
    return w.of("change", "Änderung");
}

std::string change_section(const ReportData& data, const ReportWords& w) {
    std::vector<std::vector<std::string>> rows;
    for (const v1::SceneChanged& change : data.changes.changes()) {
        if (change.at_ms() < w.options().since_ms) {
            continue;
        }
        const std::string what = change_text(change, data, w);
        rows.push_back({std::to_string(change.epoch()), ReportWords::time(change.at_ms()),
                        change.by_name().empty() ? "–" : escaped(change.by_name()), what});
    }
    if (rows.empty()) {
        return "";
    }
    std::string title = heading(w, "Changes", "Änderungen");
    if (w.options().since_ms > 0.0) {
        title += std::string("<p class=\"quiet\">") + w.of("Since ", "Seit ") +
                 ReportWords::time(w.options().since_ms) + ".</p>\n";
    }
    return title +
           html_table({"#", w.of("When", "Wann"), w.of("By", "Von"), w.of("What", "Was")}, rows);
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
