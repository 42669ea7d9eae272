// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <google/protobuf/util/json_util.h>

#include <nlohmann/json.hpp>

#include "report/report_html.h"
#include "report/report_sections.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

/// A cell of CSV (RFC 4180). What a table program would take for a formula is text.
std::string cell(std::string text) {
    if (!text.empty() && std::string("=+-@\t").find(text.front()) != std::string::npos) {
        text.insert(text.begin(), '\'');
    }
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

template <class Message>
Json json_of(const Message& message) {
    std::string text;
    google::protobuf::util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    if (!google::protobuf::util::MessageToJsonString(message, &text, options).ok()) {
        return nullptr;
    }
    return Json::parse(text, nullptr, false);
}

template <class Messages>
Json list_of(const Messages& messages) {
    Json list = Json::array();
    for (const auto& message : messages) {
        list.push_back(json_of(message));
    }
    return list;
}

}  // namespace

std::string report_csv(const ReportData& data, const ReportOptions& options) {
    const ReportWords words(options);
    std::string csv = "zone,quantity,x (m),y (m),z (m),value,95 % from,95 % to,unit,note\r\n";
    for (const ReportZone& zone : data.zones) {
        const auto q = zone.found.quantity();
        const double divisor =
            options.foot_candles && is_illuminance(q) ? lux_per_foot_candle : 1.0;
        const auto number = [divisor](bool given, float value) {
            return given ? fmt::format("{:.6g}", static_cast<double>(value) / divisor) : "";
        };
        for (const v1::Measured::Point& point : zone.found.points()) {
            const v1::Vec3& at = point.position();
            csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{},{},{},{},{}\r\n",
                               cell(zone.found.name()), v1::Measure::Quantity_Name(q), at.x(),
                               at.y(), at.z(), number(point.has_value(), point.value()),
                               number(point.has_low(), point.low()),
                               number(point.has_high(), point.high()), words.unit(q),
                               point.inside() ? "in a solid" : cell(point.glare().words()));
        }
    }
    return csv;
}

std::string report_json(const ReportData& data, const ReportOptions& options) {
    const ReportPower power = power_of(data);
    const double area = lit_area(data, options);
    Json json = {{"server", data.server},
                 {"epoch", data.epoch},
                 {"madeAtMs", data.made_at_ms},
                 {"scene", json_of(data.scene)},
                 {"power", {{"watts", nullptr}, {"lampsWithoutPower", power.unknown}}}};
    if (power.stated) {
        json["power"]["watts"] = power.watts;
    }
    if (area > 0.0 && power.stated) {
        json["power"]["area"] = area;
        json["power"]["wattsPerSquareMetre"] = power.watts / area;
        json["power"]["leni"] = power.watts * options.hours / 1000.0 / area;
        json["power"]["hours"] = options.hours;
    }
    json["requirements"] = list_of(data.requirements);
    json["zones"] = Json::array();
    for (const ReportZone& zone : data.zones) {
        Json one = json_of(zone.found);
        one["area"] = zone.area;
        one["asked"] = json_of(zone.measure);
        json["zones"].push_back(std::move(one));
    }
    json["pins"] = list_of(data.pins);
    json["changes"] = Json::array();
    for (const v1::SceneChanged& change : data.changes.changes()) {
        if (change.at_ms() >= options.since_ms) {
            Json one = json_of(change);
            if (const auto object = data.objects.find(object_of(change));
                object != data.objects.end()) {
                one["objectName"] = object->second;
            }
            json["changes"].push_back(std::move(one));
        }
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace raybundle
