// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/contours.h"
#include "report/report_html.h"
#include "report/report_sections.h"
#include "report/zone_plan.h"

namespace raybundle {
namespace {

v1::Vec3 vec3(double x, double y, double z) {
    v1::Vec3 v;
    v.set_x(static_cast<float>(x));
    v.set_y(static_cast<float>(y));
    v.set_z(static_cast<float>(z));
    return v;
}

/// A zone of 4 m x 3 m with 4 x 3 points, brighter along x from 100 lx on, by 100 lx a point.
ReportZone zone_of(const std::string& name) {
    ReportZone zone;
    zone.lattice = {{0, 0.75, 0}, {4, 0, 0}, {0, 0, 3}};
    zone.lattice_size = {4, 3};
    zone.area = 12.0;
    zone.measure.set_quantity(v1::Measure::HORIZONTAL);
    zone.found.set_quantity(v1::Measure::HORIZONTAL);
    zone.found.set_name(name);
    for (std::uint32_t i = 0; i < 12; ++i) {
        zone.cells.push_back(i);
        v1::Measured::Point& point = *zone.found.add_points();
        *point.mutable_position() = vec3(0.5 + i % 4, 0.75, 0.5 + i / 4);
        point.set_value(100.0F * static_cast<float>(1 + i % 4));
        point.set_low(point.value() - 5.0F);
        point.set_high(point.value() + 5.0F);
    }
    for (const auto& [x, z] :
         {std::pair(0, 0), std::pair(4, 0), std::pair(4, 3), std::pair(0, 3)}) {
        *zone.found.add_outline() = vec3(x, 0.75, z);
    }
    zone.found.set_mean(250.0F);
    zone.found.set_mean_low(245.0F);
    zone.found.set_mean_high(255.0F);
    zone.found.set_uniformity(0.4F);
    zone.found.set_requirement("Office");
    zone.found.set_verdict(v1::MISSED);
    v1::Check& check = *zone.found.add_checks();
    check.set_what("Em");
    check.set_required(500.0F);
    check.set_verdict(v1::MISSED);
    return zone;
}

ReportData data_of() {
    ReportData data;
    data.server = "raybundle";
    data.scene.set_name("office <script>alert(1)</script>");
    v1::Light& lamp = *data.scene.add_lights();
    lamp.set_id(1);
    lamp.set_name("panel");
    lamp.set_kind(v1::Light::POINT);
    lamp.set_on(true);
    lamp.set_dim(0.5F);
    lamp.set_flux(4000.0F);
    lamp.set_watts(36.0F);
    lamp.set_maintenance_factor(0.8F);
    data.floor_area = 40.0;
    data.zones.push_back(zone_of("=desk, \"A\""));
    v1::PinChanged& pin = data.pins.emplace_back();
    pin.set_pin(1);
    pin.set_text("Glare </td><b>");
    pin.add_replies()->set_text("Seen");
    v1::SceneChanged& change = *data.changes.add_changes();
    change.set_epoch(3);
    change.set_at_ms(1'780'000'000'000.0);
    change.mutable_set_light()->set_light(1);
    return data;
}

TEST(Contours, OfAPlaneAreStraightAtTheirLevel) {
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) {
        values.push_back(100.0 * (1 + i % 4));
    }
    const auto pieces = contour(values, 4, 3, 250.0);
    ASSERT_EQ(pieces.size(), 2U);
    for (const ContourPiece& piece : pieces) {
        EXPECT_NEAR(piece.from.x, 1.5, 1e-12);
        EXPECT_NEAR(piece.to.x, 1.5, 1e-12);
    }
    EXPECT_TRUE(contour(values, 4, 3, 1000.0).empty());
    values[5] = std::nan("");
    EXPECT_EQ(contour(values, 4, 3, 350.0).size(), 2U);
    EXPECT_EQ(contour(values, 4, 3, 150.0).size(), 0U);
}

/// At a saddle, lines go between the corners that the middle tells apart.
TEST(Contours, SaddlesHaveTwoPieces) {
    const std::vector<double> values = {1, 0, 0, 1};
    const auto high = contour(values, 2, 2, 0.4);  // the middle, 0.5, is above: 1s are joined
    ASSERT_EQ(high.size(), 2U);
    const auto low = contour(values, 2, 2, 0.6);
    ASSERT_EQ(low.size(), 2U);
    const auto cuts = [](const ContourPiece& piece, const glm::dvec2& corner) {
        return std::max(glm::distance(piece.from, corner), glm::distance(piece.to, corner)) < 0.7;
    };
    EXPECT_TRUE(cuts(high[0], {1, 0}) || cuts(high[1], {1, 0}));
    EXPECT_TRUE(cuts(low[0], {0, 0}) || cuts(low[1], {0, 0}));
}

TEST(Contours, LevelsAreRound) {
    EXPECT_EQ(round_levels(120.0, 690.0), (std::vector<double>{200, 300, 400, 500, 600}));
    EXPECT_TRUE(round_levels(5.0, 5.0).empty());
}

TEST(Report, TellsEverythingAndTrustsNobody) {
    const std::string html = report_html(data_of(), {});
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("</td><b>"), std::string::npos);
    for (const char* text :
         {"Luminaires", "panel", "Zones at a glance", "Requirement", "not", "missed", "@page",
          "size:A4", "counter(page)", "<svg", "class=\"isolux\"", "Em ≥ 500 lx", "W/m²", "LENI",
          "Glare", "Seen", "Method and accuracy", "95 %"}) {
        EXPECT_NE(html.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg"));  // needs nothing else
}

TEST(Report, SaysWhereLightIsDirectAlone) {
    ReportData data = data_of();
    EXPECT_EQ(report_html(data, {}).find("Direct light only."), std::string::npos);
    data.zones[0].found.set_direct(true);
    EXPECT_NE(report_html(data, {}).find("Direct light only."), std::string::npos);
}

/// A glowing material is one light on however many luminaires: it has no number.
TEST(Report, CountsLuminairesAndNoMaterials) {
    ReportData data = data_of();
    v1::Light& material = *data.scene.add_lights();
    material.set_id(2);
    material.set_kind(v1::Light::AREA);
    for (const auto& [light, name] : {std::pair(2U, "LED"), std::pair(1U, "panel")}) {
        v1::Measured::Luminaire& luminaire = *data.zones.front().found.add_luminaires();
        luminaire.set_light(light);
        luminaire.set_name(name);
    }
    EXPECT_NE(report_html(data, {}).find(
                  "Lit by all surfaces of LED, Ra not stated; 1 × panel, Ra not stated."),
              std::string::npos);
}

TEST(Report, SpeaksGermanAndFootcandles) {
    const std::string html = report_html(data_of(), {true, true});
    for (const char* text : {"lang=\"de\"", "Leuchten", "Zonen auf einen Blick", "nicht erfüllt",
                             "Em ≥ 46.5 fc", "Verfahren und Genauigkeit"}) {
        EXPECT_NE(html.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(html.find("Zones at a glance"), std::string::npos);
}

/// 36 W dimmed to a half on 40 m² of floor, whatever zones cover: 0.45 W/m², and 1.125 kWh/(m² a)
/// in 2500 h. Who knows the floor says it: 10 m².
TEST(Report, AddsUpPower) {
    const ReportData data = data_of();
    EXPECT_NEAR(power_of(data).watts, 18.0, 1e-6);
    const auto json = nlohmann::json::parse(report_json(data, {}));
    EXPECT_NEAR(json["power"]["area"], 40.0, 1e-12);
    EXPECT_NEAR(json["power"]["wattsPerSquareMetre"], 0.45, 1e-6);
    EXPECT_NEAR(json["power"]["leni"], 1.125, 1e-6);
    ReportOptions stated;
    stated.area = 10.0;
    EXPECT_NEAR(nlohmann::json::parse(report_json(data, stated))["power"]["leni"], 4.5, 1e-6);
    EXPECT_NE(report_html(data, stated).find("10.0 m² of floor (as stated)"), std::string::npos);
    ReportData nowhere = data;
    nowhere.floor_area = 0.0;
    EXPECT_FALSE(nlohmann::json::parse(report_json(nowhere, {}))["power"].contains("leni"));
    EXPECT_NE(report_html(nowhere, {}).find("no luminaire is in a room"), std::string::npos);
    EXPECT_EQ(json["zones"][0]["points"].size(), 12U);
    EXPECT_EQ(json["pins"][0]["replies"][0]["text"], "Seen");
    ReportOptions later;
    later.since_ms = 1'790'000'000'000.0;
    EXPECT_EQ(nlohmann::json::parse(report_json(data, later))["changes"].size(), 0U);
    EXPECT_EQ(json["changes"].size(), 1U);
}

/// Light that is dimmed by its intensity, as the page's fields do it, is dimmed.
TEST(Report, KnowsLampsThatAreSetToLess) {
    ReportData data = data_of();
    v1::Light& lamp = *data.scene.mutable_lights(0);
    lamp.clear_dim();
    lamp.set_loaded_intensity(4000.0F);
    lamp.set_intensity(1000.0F);
    EXPECT_NEAR(power_of(data).watts, 9.0, 1e-6);
    const std::string html = report_html(data, {});
    EXPECT_NE(html.find("<td>25 %</td>"), std::string::npos);
    EXPECT_NE(html.find("as they are switched: 1000 lm, 9 W"), std::string::npos);
    EXPECT_EQ(html.find("glowing material"), std::string::npos);
    lamp.set_kind(v1::Light::AREA);
    EXPECT_NE(report_html(data, {}).find("glowing material"), std::string::npos);
}

TEST(Report, SaysWhichPointsAreDark) {
    ReportData data = data_of();
    EXPECT_EQ(report_html(data, {}).find("dark and counted"), std::string::npos);
    data.zones[0].found.mutable_points(2)->set_value(0.0F);
    data.zones[0].found.mutable_points(3)->set_value(0.0F);
    EXPECT_NE(report_html(data, {}).find("2 of the points are dark"), std::string::npos);
    data.zones[0].found.set_direct(true);
    EXPECT_EQ(report_html(data, {}).find("dark and counted"), std::string::npos);
}

TEST(Report, ChangesSayWhoAndFromWhatToWhat) {
    ReportData data = data_of();
    data.scene.mutable_lights(0)->set_loaded_intensity(4000.0F);
    v1::SceneChanged& dimmed = *data.changes.add_changes();
    dimmed.set_by(6);
    dimmed.mutable_set_light()->set_light(1);
    dimmed.mutable_set_light()->set_intensity(2000.0F);
    dimmed.mutable_light_before()->set_intensity(4000.0F);
    v1::SceneChanged& painted = *data.changes.add_changes();
    painted.set_by_name("Ada");
    data.scene.add_materials()->set_id(2);
    data.scene.mutable_materials(0)->set_name("wall");
    painted.mutable_set_material()->set_material(2);
    *painted.mutable_set_material()->mutable_base_colour() = vec3(0.5, 0.5, 0.5);
    *painted.mutable_material_before()->mutable_base_colour() = vec3(0.7, 0.7, 0.7);
    const std::string html = report_html(data, {});
    EXPECT_NE(html.find("<td>Viewer 6</td><td>light panel: 100 → 50 %</td>"), std::string::npos);
    EXPECT_NE(html.find("<td>Ada</td><td>material wall: reflectance 70 → 50 %</td>"),
              std::string::npos);
}

/// A file without a power: a dash and words, no 0; half of the lamps with one: its sum, and a note.
TEST(Report, LeavesOutPowerThatNoFileStates) {
    ReportData data = data_of();
    data.scene.mutable_lights(0)->clear_watts();
    const std::string html = report_html(data, {});
    EXPECT_NE(html.find("– W, W/m² and LENI: no file states a power"), std::string::npos);
    EXPECT_EQ(html.find(" 0 W"), std::string::npos);
    const auto power = nlohmann::json::parse(report_json(data, {}))["power"];
    EXPECT_TRUE(power["watts"].is_null()) << power;
    EXPECT_FALSE(power.contains("wattsPerSquareMetre")) << power;
    EXPECT_FALSE(power.contains("leni")) << power;
    EXPECT_EQ(power["lampsWithoutPower"], 1);
    *data.scene.add_lights() = data.scene.lights(0);
    data.scene.mutable_lights(1)->set_watts(20.0F);
    EXPECT_NE(report_html(data, {}).find("Lamps without a stated power"), std::string::npos);
    EXPECT_NEAR(nlohmann::json::parse(report_json(data, {}))["power"]["watts"], 10.0, 1e-6);
}

TEST(Report, ChangesNameTheObject) {
    ReportData data = data_of();
    data.objects[7] = "desk <lamp>";
    data.changes.add_changes()->mutable_move_object()->set_object(7);
    data.changes.add_changes()->mutable_remove_object()->set_object(7);
    const std::string html = report_html(data, {});
    EXPECT_NE(html.find("object moved: desk &lt;lamp&gt;"), std::string::npos);
    EXPECT_NE(html.find("object removed: desk &lt;lamp&gt;"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(report_json(data, {}))["changes"][1]["objectName"],
              "desk <lamp>");
}

TEST(Report, SaysWhereARequirementAsksNothingOfAQuantity) {
    ReportData data = data_of();
    data.zones[0].found.clear_checks();
    data.zones[0].found.clear_verdict();
    const std::string html = report_html(data, {});
    EXPECT_NE(html.find("Office: asks nothing of this quantity, not checked"), std::string::npos);
    EXPECT_NE(html.find("<td>not checked</td>"), std::string::npos);
}

TEST(Report, TablesAreQuotedAndHoldNoFormulas) {
    const std::string csv = report_csv(data_of(), {});
    EXPECT_NE(csv.find("\"'=desk, \"\"A\"\"\",HORIZONTAL,0.5000,0.7500,0.5000,100,95,105,lx,"),
              std::string::npos)
        << csv;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
}

/// Seen from above: with u along x and v along z, z is down on the page.
TEST(ZonePlan, IsSeenFromAbove) {
    ReportZone zone = zone_of("a");
    const std::string plan = zone_plan(zone, ReportWords({}));
    // The first point is at the upper left: labels follow the points' order.
    const std::size_t first = plan.find("class=\"value\">100");
    ASSERT_NE(first, std::string::npos);
    const auto y_of = [&](std::size_t at) {
        const std::size_t y = plan.rfind("y=\"", at) + 3;
        return std::stod(plan.substr(y));
    };
    std::size_t last = first;
    for (std::size_t at = first; at != std::string::npos;
         at = plan.find("class=\"value\">100", at + 1)) {
        last = at;
    }
    EXPECT_LT(y_of(first), y_of(last));
    zone.lattice.v = {0, 0, -3};
    zone.found.clear_points();
    EXPECT_EQ(zone_plan(zone, ReportWords({})), "");
}

}  // namespace
}  // namespace raybundle
