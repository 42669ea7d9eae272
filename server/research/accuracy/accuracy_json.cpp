// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "research/accuracy/accuracy_report.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no infinity: what is not known yet is null.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const ReferenceReport& reference) {
    return {{"method", reference.method.empty() ? Json(nullptr) : Json(reference.method)},
            {"pixelFilter", filter_name(reference.filter)},
            {"file", reference.file},
            {"samples", reference.samples},
            {"seconds", number(reference.seconds)},
            {"relativeError",
             reference.noise ? number(reference.noise->relative_rmse) : Json(nullptr)}};
}

Json json_of(const CurvePoint& point) {
    Json json = {{"seconds", number(point.seconds)},
                 {"iterations", point.iterations},
                 {"relRMSE", number(point.relative_rmse)},
                 {"mrse", number(point.mrse)},
                 {"median", number(point.median)},
                 {"p95", number(point.p95)},
                 {"estimatedError", number(point.estimated_error)},
                 {"estimatedLow", number(point.estimated_low)},
                 {"estimatedHigh", number(point.estimated_high)},
                 {"resolved", point.resolved}};
    if (point.interval) {
        json["relRMSELow"] = number(point.interval->first);
        json["relRMSEHigh"] = number(point.interval->second);
    }
    return json;
}

/// Seconds to each target; null where it was not met.
Json json_of_times(const ErrorCurve& curve) {
    Json times = Json::array();
    for (const double target : target_errors) {
        const auto time = time_to_error(curve, target);
        times.push_back({{"error", target},
                         {"seconds", time ? number(time->seconds) : Json(nullptr)},
                         {"atMost", time && time->at_most},
                         {"resolved", !time || time->resolved}});
    }
    return times;
}

Json json_of(const ErrorCurve& curve) {
    Json json = {{"method", curve.method},
                 {"name", curve.name},
                 {"knob", curve.knob.empty() ? Json(nullptr) : Json(curve.knob)},
                 {"pixelFilter", filter_name(PixelFilter::box)},
                 {"settings", curve.settings},
                 {"secondsToError", json_of_times(curve)},
                 {"points", Json::array()}};
    for (const CurvePoint& point : curve.points) {
        json["points"].push_back(json_of(point));
    }
    return json;
}

}  // namespace

nlohmann::ordered_json accuracy_json(const AccuracyReport& report) {
    Json json = {{"scene", report.scene},
                 {"camera", report.camera},
                 {"device", report.device.empty() ? report.processor : report.device},
                 {"processor", report.processor},
                 {"size", {report.size.x, report.size.y}},
                 {"patches", report.patches},
                 {"seconds", report.seconds},
                 {"seed", report.seed},
                 {"repeats", report.repeats}};
    Json references = Json::array();
    for (const ReferenceReport& reference : report.references) {
        references.push_back(json_of(reference));
    }
    json["reference"] = references.empty() ? Json(nullptr) : references.front();
    json["references"] = references;
    json["curves"] = Json::array();
    for (const ErrorCurve& curve : report.curves) {
        json["curves"].push_back(json_of(curve));
    }
    return json;
}

}  // namespace raybundle
