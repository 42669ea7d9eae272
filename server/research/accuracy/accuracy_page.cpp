// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "research/accuracy/accuracy_report.h"
#include "research/accuracy/error_map.h"
#include "research/plot/svg_text.h"
#include "scene/base64.h"

namespace raybundle {
namespace {

constexpr const char* style_sheet = R"css(
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1f2328; --faint: #5f666e;
  --edge: #d9dce0; --best: #0b6b45; }
@media (prefers-color-scheme: dark) { :root { --ground: #16191d; --ink: #e6e9ec; --faint: #a2a9b1;
  --edge: #343a41; --best: #5ad8a6; } }
body { font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif;
  background: var(--ground); color: var(--ink); max-width: 72rem; margin: 0 auto;
  padding: 1.5rem 1rem 4rem; }
h1 { font-size: 1.6rem; margin: 0 0 .4rem; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .4rem; }
p { max-width: 46rem; margin: .4rem 0; }
.faint, figcaption small, td small { color: var(--faint); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .8rem 0; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: .3rem .7rem; border-bottom: 1px solid var(--edge);
  white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
th { font-weight: 600; }
td.best { color: var(--best); font-weight: 600; }
td.never { color: var(--faint); }
svg.plot { max-width: 100%; height: auto; border: 1px solid var(--edge); border-radius: 4px; }
.plots, .pictures { display: flex; flex-wrap: wrap; gap: 1rem; margin: .8rem 0; }
figure { margin: 0; }
.pictures img { display: block; width: 16rem; height: auto; margin-bottom: .3rem;
  image-rendering: auto; }
figcaption { line-height: 1.35; }
.scale { width: 16rem; }
.scale i { display: block; height: .8rem; border: 1px solid var(--edge); }
.scale span { display: flex; justify-content: space-between; font-size: .85rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1.2rem; margin: .8rem 0; }
dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
)css";

constexpr const char* no_break = "\xC2\xA0";  // a space at which no line ends

std::string percent_text(double error) {
    return readable_number(100.0 * error) + no_break + "%";
}

std::string seconds_text(double seconds) {
    return fmt::format("{:.{}f}{}s", seconds, seconds < 10.0 ? 2 : 1, no_break);
}

/// What a user reads first: who met 5 % first, or who came nearest.
std::string summary(const AccuracyReport& report) {
    const ErrorCurve* first = nullptr;
    const ErrorCurve* nearest = nullptr;
    double seconds = 0.0;
    double error = 0.0;
    constexpr double target = 0.05;
    for (const ErrorCurve& curve : report.curves) {
        if (!curve.knob.empty() || curve.points.empty()) {
            continue;
        }
        const auto time = time_to_error(curve, target);
        if (time && (first == nullptr || time->seconds < seconds)) {
            first = &curve;
            seconds = time->seconds;
        }
        const double last = curve.points.back().relative_rmse;
        if (nearest == nullptr || last < error) {
            nearest = &curve;
            error = last;
        }
    }
    if (first != nullptr) {
        return fmt::format("<b>{}</b> was the first to come within {} of the reference: after {}.",
                           xml_escaped(first->name), percent_text(target), seconds_text(seconds));
    }
    if (nearest == nullptr) {
        return "Nothing was measured.";
    }
    return fmt::format(
        "No method came within {} of the reference in {} s; <b>{}</b> came nearest, {}.",
        percent_text(target), readable_number(report.seconds), xml_escaped(nearest->name),
        percent_text(error));
}

std::string time_cell(const std::optional<TimeToError>& time, double best, double limit) {
    if (!time) {
        return fmt::format("<td class=\"never\">not in {} s</td>", readable_number(limit));
    }
    return fmt::format("<td{}>{}{}</td>", time->seconds <= best ? " class=\"best\"" : "",
                       time->at_most    ? "≤ "
                       : time->resolved ? ""
                                        : "≈ ",
                       seconds_text(time->seconds));
}

bool chosen(const ErrorCurve& curve, const std::string& knob) {
    return curve.knob == knob && !curve.points.empty();
}

/// Rows of the methods, or of the variants of one knob.
std::string table(const AccuracyReport& report, const std::string& knob) {
    std::string html = "<div class=\"wide\"><table>\n<tr><th>";
    html += knob.empty() ? "method" : xml_escaped(knob);
    for (const double target : target_errors) {
        html += "</th><th>time to " + percent_text(target);
    }
    html += "</th><th>error at the end</th><th>its own estimate</th><th>memory</th></tr>\n";
    std::vector<double> best;
    for (const double target : target_errors) {
        best.push_back(1e300);
        for (const ErrorCurve& curve : report.curves) {
            const auto time = time_to_error(curve, target);
            if (chosen(curve, knob) && time) {
                best.back() = std::min(best.back(), time->seconds);
            }
        }
    }
    for (const ErrorCurve& curve : report.curves) {
        if (!chosen(curve, knob)) {
            continue;
        }
        html += "<tr><td>" + xml_escaped(curve.name) + "</td>";
        for (std::size_t i = 0; i < best.size(); ++i) {
            html += time_cell(time_to_error(curve, target_errors[i]), best[i], report.seconds);
        }
        const CurvePoint& last = curve.points.back();
        html +=
            fmt::format("<td>{}{}</td><td>{} <small>({} to {})</small></td><td>{}</td></tr>\n",
                        last.resolved ? "" : "≈ ", percent_text(last.relative_rmse),
                        percent_text(last.estimated_error), percent_text(last.estimated_low),
                        percent_text(last.estimated_high),
                        curve.settings.contains("bytes")
                            ? readable_number(curve.settings["bytes"].get<double>() / 1e6) + " MB"
                            : "");
    }
    return html + "</table></div>\n";
}

std::string image(const std::string& png, const std::string& alt) {
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", xml_escaped(alt),
                       base64(png));
}

std::string pictures(const AccuracyReport& report) {
    if (report.pictures.empty()) {
        return "";
    }
    std::string html = fmt::format(
        "<h2>The pictures after {} s each</h2>\n<p>All with the same exposure. Below each, where "
        "it "
        "errs: blue is too dark, red too bright, pale is right; grey pixels see a lamp and do not "
        "count.</p>\n<div class=\"scale\"><i style=\"background: {}\"></i><span><span>−{}</span>"
        "<span>0</span><span>+{}</span></span></div>\n<div class=\"pictures\">\n",
        readable_number(report.seconds), error_map_gradient(), percent_text(report.map_scale),
        percent_text(report.map_scale));
    for (const PictureReport& picture : report.pictures) {
        html += "<figure>" + image(picture.png, "picture by " + picture.name);
        if (picture.map_png.empty()) {
            html += fmt::format("<figcaption><b>{}</b></figcaption>", xml_escaped(picture.name));
        } else {
            html += image(picture.map_png, "errors of " + picture.name);
            html += fmt::format(
                "<figcaption><b>{}</b><br><small>{} off after {}</small>"
                "</figcaption>",
                xml_escaped(picture.name), percent_text(picture.relative_rmse),
                seconds_text(picture.seconds));
        }
        html += "</figure>\n";
    }
    return html + "</div>\n";
}

std::string entry(const std::string& term, const std::string& text) {
    return "<dt>" + xml_escaped(term) + "</dt><dd>" + xml_escaped(text) + "</dd>\n";
}

std::string settings_text(const ErrorCurve& curve) {
    std::string text;
    for (const auto& [key, value] : curve.settings.items()) {
        text += (text.empty() ? "" : ", ") + key + " " + value.dump();
    }
    return text;
}

std::string reference_text(const ReferenceReport& reference) {
    const std::string pixels = reference.filter == PixelFilter::centre
                                   ? "pixel centres"
                                   : "means over pixels, as all pictures";
    if (!reference.noise) {
        return reference.file + ", accuracy unknown";
    }
    return fmt::format("{}: path tracing, {}, {} samples a pixel in {}, within {}", reference.file,
                       pixels, reference.samples, seconds_text(reference.seconds),
                       percent_text(reference.noise->relative_rmse));
}

std::string what_was_run(const AccuracyReport& report) {
    std::string html = "<h2>What was run</h2>\n<dl>\n";
    html += entry("scene", fmt::format("{}, camera {}, {} patches", report.scene, report.camera,
                                       report.patches));
    html += entry("picture", fmt::format("{} × {} pixels", report.size.x, report.size.y));
    if (!report.device.empty()) {
        html += entry("ray bundles on", report.device);
    }
    html += entry("CPU methods on", report.processor);
    html += entry(
        "each run",
        fmt::format(
            "{} s, seed {}{}", readable_number(report.seconds), report.seed,
            report.repeats > 1 ? fmt::format(" to {}", report.seed + report.repeats - 1) : ""));
    for (const ReferenceReport& reference : report.references) {
        html += entry("reference", reference_text(reference));
    }
    for (const ErrorCurve& curve : report.curves) {
        html += entry(curve.name, settings_text(curve));
    }
    return html +
           "</dl>\n<p class=\"faint\">The clock runs while a method solves: not while it is "
           "set up or measured.</p>\n";
}

constexpr const char* how_to_read =
    "<p>Lower is better, and further left is sooner. An error of 5 % means: weighed over the whole "
    "picture, luminances are off by 5 % of its root mean square (relRMSE). For illuminances, 10 % "
    "is a quick look, 5 % a design review, 2 % a figure to sign.</p>\n";

std::string own_estimates(const std::vector<NamedPlot>& plots) {
    std::string html =
        "<h2>Can a method's own error bar be believed?</h2>\n<p>While it solves, a method knows no "
        "reference; it estimates its error from independent parts of its samples. The shaded band "
        "is its 95 % interval; the solid line is what was measured.</p>\n<div class=\"plots\">\n";
    bool any = false;
    for (const NamedPlot& plot : plots) {
        if (plot.file.rfind("estimate_", 0) == 0) {
            html += svg_of(plot.plot);
            any = true;
        }
    }
    return any ? html + "</div>\n" : "";
}

std::string knobs(const AccuracyReport& report, const std::vector<NamedPlot>& plots) {
    std::string html;
    std::vector<std::string> seen;
    for (const ErrorCurve& curve : report.curves) {
        if (!curve.knob.empty() && std::find(seen.begin(), seen.end(), curve.knob) == seen.end()) {
            seen.push_back(curve.knob);
        }
    }
    auto plot = std::find_if(plots.begin(), plots.end(),
                             [](const NamedPlot& p) { return p.file.rfind("knob_", 0) == 0; });
    for (const std::string& knob : seen) {
        html += "<h2>Knob: " + xml_escaped(knob) + "</h2>\n" + table(report, knob);
        html += svg_of((plot++)->plot);
    }
    return html;
}

bool has_unresolved(const AccuracyReport& report) {
    return std::any_of(report.curves.begin(), report.curves.end(), [](const ErrorCurve& curve) {
        return std::any_of(curve.points.begin(), curve.points.end(),
                           [](const CurvePoint& point) { return !point.resolved; });
    });
}

}  // namespace

std::string accuracy_page(const AccuracyReport& report) {
    const std::vector<NamedPlot> plots = accuracy_plots(report);
    const std::string title = "What accuracy costs: " + xml_escaped(report.scene);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
        title + "</title>\n<style>" + style_sheet + "</style>\n</head>\n<body>\n";
    html += "<h1>" + title + "</h1>\n<p>" + summary(report) + "</p>\n";
    html += "<h2>How long until the picture is right?</h2>\n" + table(report, "") + how_to_read;
    html += "<h2>Error over time</h2>\n" + svg_of(plots[0].plot);
    if (report.repeats > 1) {
        html += fmt::format(
            "<p class=\"faint\">Shaded: 95 % confidence of the mean of {} runs that "
            "differ in their seed.</p>\n",
            report.repeats);
    }
    html += "<h2>Error over iterations</h2>\n" + svg_of(plots[1].plot);
    if (has_unresolved(report)) {
        html +=
            "<p class=\"faint\">Open markers, and ≈ in the table: the reference is less than 4 "
            "times as accurate as these points, so that they rest on its noise being subtracted. "
            "Running again refines it.</p>\n";
    }
    html += pictures(report) + own_estimates(plots) + knobs(report, plots) + what_was_run(report);
    return html + "</body>\n</html>\n";
}

}  // namespace raybundle
