// SPDX-License-Identifier: Apache-2.0
// What has been changed, by whom and when, in the report.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/html_text.h"
#include "report/report_sections.h"
#include "scene/significant.h"

namespace raybundle {
namespace {

/// A blank and the name of the entry with that number; empty: there is none (any more).
template <typename Entries>
std::string named(const Entries& entries, std::uint32_t id) {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [id](const auto& entry) { return entry.id() == id; });
    return found == entries.end() ? "" : " " + escaped(found->name());
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

/// A light or a material has changed by less where single precision has.
bool differ(double before, double after) {
    return std::abs(after - before) > 1e-4 * std::max(std::abs(before), std::abs(after));
}

bool differ(const v1::Vec3& a, const v1::Vec3& b) {
    const auto apart = [](float one, float other) {
        return std::abs(one - other) > 1e-4F * std::max(1.0F, std::abs(one));
    };
    return apart(a.x(), b.x()) || apart(a.y(), b.y()) || apart(a.z(), b.z());
}

/// "100 → 50 %".
std::string percents(double before, double after) {
    return significant(100.0 * before, 3) + " → " + significant(100.0 * after, 3) + " %";
}

/// Of the light that the file gives it, or in cd, lm … where the file gives none.
std::string intensity_text(double before, double after, const v1::Light* light) {
    const double whole = light != nullptr ? static_cast<double>(light->loaded_intensity()) : 0.0;
    if (whole > 0.0) {
        return percents(before / whole, after / whole);
    }
    const char* const unit = light == nullptr                 ? ""
                             : light->unit() == v1::Light::CD ? " cd"
                             : light->unit() == v1::Light::LM ? " lm"
                             : light->unit() == v1::Light::LX ? " lx"
                                                              : " cd/m²";
    return significant(before, 3) + " → " + significant(after, 3) + unit;
}

/// What has been done to a light, with old and new values, as far as both are known.
std::vector<std::string> light_deeds(const v1::SceneChanged& change, const v1::Scene& scene,
                                     const ReportWords& w) {
    std::vector<std::string> deeds;
    if (!change.has_light_before()) {
        return deeds;
    }
    const v1::SetLight& from = change.light_before();
    const v1::SetLight& to = change.set_light();
    const auto found =
        std::find_if(scene.lights().begin(), scene.lights().end(),
                     [&](const v1::Light& light) { return light.id() == to.light(); });
    if (to.has_on() && to.on() != from.on()) {
        deeds.emplace_back(to.on() ? w.of("switched on", "eingeschaltet")
                                   : w.of("switched off", "ausgeschaltet"));
    }
    if (to.has_intensity() && differ(from.intensity(), to.intensity())) {
        deeds.push_back(intensity_text(from.intensity(), to.intensity(),
                                       found == scene.lights().end() ? nullptr : &*found));
    }
    if (to.has_dim() && from.has_dim() && differ(from.dim(), to.dim())) {
        deeds.push_back(w.of("dimmer ", "Dimmer ") + percents(from.dim(), to.dim()));
    }
    if (to.has_colour() && from.has_colour() && differ(from.colour(), to.colour())) {
        deeds.emplace_back(w.of("colour", "Farbe"));
    }
    if (to.has_position() && from.has_position() && differ(from.position(), to.position())) {
        deeds.emplace_back(w.of("moved", "versetzt"));
    }
    if ((to.has_aim() && from.has_aim() && differ(from.aim(), to.aim())) ||
        (to.has_rotation() && from.has_rotation() && differ(from.rotation(), to.rotation()))) {
        deeds.emplace_back(w.of("aimed", "ausgerichtet"));
    }
    if (to.has_group() && to.group() != from.group()) {
        deeds.push_back(w.of("group ", "Gruppe ") +
                        (to.group().empty() ? "–" : escaped(to.group())));
    }
    if (to.has_maintenance_factor() && differ(from.maintenance_factor(), to.maintenance_factor())) {
        deeds.push_back(fmt::format("{} {:.2f} → {:.2f}", w.of("MF", "WF"),
                                    from.maintenance_factor(), to.maintenance_factor()));
    }
    if (to.has_colour_rendering() && differ(from.colour_rendering(), to.colour_rendering())) {
        deeds.push_back(to.colour_rendering() > 0.0F
                            ? fmt::format("Ra {:g}", to.colour_rendering())
                            : w.of("Ra as its file states it", "Ra wie in der Datei"));
    }
    return deeds;
}

double luminance(const v1::Vec3& colour) {
    return 0.2126 * static_cast<double>(colour.x()) + 0.7152 * static_cast<double>(colour.y()) +
           0.0722 * static_cast<double>(colour.z());
}

std::vector<std::string> material_deeds(const v1::SceneChanged& change, const ReportWords& w) {
    std::vector<std::string> deeds;
    if (!change.has_material_before()) {
        return deeds;
    }
    const v1::SetMaterial& from = change.material_before();
    const v1::SetMaterial& to = change.set_material();
    if (to.has_base_colour() && from.has_base_colour() &&
        differ(from.base_colour(), to.base_colour())) {
        deeds.push_back(fmt::format("{} {:.0f} → {:.0f} %", w.of("reflectance", "Reflexionsgrad"),
                                    100.0 * luminance(from.base_colour()),
                                    100.0 * luminance(to.base_colour())));
    }
    if (to.has_roughness() && from.has_roughness() && differ(from.roughness(), to.roughness())) {
        deeds.push_back(fmt::format("{} {:.2f} → {:.2f}", w.of("roughness", "Rauheit"),
                                    from.roughness(), to.roughness()));
    }
    if (to.has_metallic() && from.has_metallic() && differ(from.metallic(), to.metallic())) {
        deeds.push_back(fmt::format("{} {:.2f} → {:.2f}", w.of("metallic", "Metall"),
                                    from.metallic(), to.metallic()));
    }
    return deeds;
}

/// ": one, two"; empty: nothing is known.
std::string listed(const std::vector<std::string>& deeds) {
    std::string text;
    for (const std::string& deed : deeds) {
        text += (text.empty() ? ": " : ", ") + deed;
    }
    return text;
}

/// As the page names people.
std::string who_text(const v1::SceneChanged& change, const ReportWords& w) {
    if (!change.by_name().empty()) {
        return escaped(change.by_name());
    }
    return change.by() == 0 ? w.of("the server", "der Server")
                            : fmt::format("{} {}", w.of("Viewer", "Person"), change.by());
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
                   listed(light_deeds(change, data.scene, w)) + fade_text(change.set_light(), w);
        case v1::SceneChanged::kSetMaterial:
            return w.of("material", "Material") +
                   named(scene.materials(), change.set_material().material()) +
                   listed(material_deeds(change, w));
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

}  // namespace

std::uint32_t object_of(const v1::SceneChanged& change) {
    return change.has_move_object()     ? change.move_object().object()
           : change.has_remove_object() ? change.remove_object().object()
                                        : 0;
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

std::string change_section(const ReportData& data, const ReportWords& w) {
    std::vector<std::vector<std::string>> rows;
    for (const v1::SceneChanged& change : data.changes.changes()) {
        if (change.at_ms() < w.options().since_ms) {
            continue;
        }
        const std::string what = change_text(change, data, w);
        rows.push_back({std::to_string(change.epoch()), ReportWords::time(change.at_ms()),
                        who_text(change, w), what});
    }
    if (rows.empty()) {
        return "";
    }
    std::string title = std::string("<h2>") + w.of("Changes", "Änderungen") + "</h2>\n";
    if (w.options().since_ms > 0.0) {
        title += std::string("<p class=\"quiet\">") + w.of("Since ", "Seit ") +
                 ReportWords::time(w.options().since_ms) + ".</p>\n";
    }
    return title +
           html_table({"#", w.of("When", "Wann"), w.of("By", "Von"), w.of("What", "Was")}, rows);
}

}  // namespace raybundle
