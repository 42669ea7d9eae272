// SPDX-License-Identifier: Apache-2.0
#include "report/report_words.h"

#include <fmt/core.h>

#include <cmath>
#include <ctime>

#include "report/html_text.h"

namespace raybundle {
double area_of(const std::vector<glm::dvec3>& outline) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 2; i < outline.size(); ++i) {
        sum += glm::cross(outline[i - 1] - outline[0], outline[i] - outline[0]);
    }
    return 0.5 * glm::length(sum);
}

bool is_illuminance(v1::Measure::Quantity quantity) {
    return quantity != v1::Measure::DAYLIGHT_FACTOR && quantity != v1::Measure::UGR &&
           quantity != v1::Measure::DGP;
}

std::string ReportWords::quantity(v1::Measure::Quantity quantity) const {
    switch (quantity) {
        case v1::Measure::HORIZONTAL:
            return of("Horizontal illuminance", "Horizontale Beleuchtungsstärke");
        case v1::Measure::VERTICAL:
            return of("Vertical illuminance", "Vertikale Beleuchtungsstärke");
        case v1::Measure::NORMAL:
            return of("Illuminance of the surface", "Beleuchtungsstärke der Fläche");
        case v1::Measure::CYLINDRICAL:
            return of("Cylindrical illuminance", "Zylindrische Beleuchtungsstärke");
        case v1::Measure::SEMICYLINDRICAL:
            return of("Semicylindrical illuminance", "Halbzylindrische Beleuchtungsstärke");
        case v1::Measure::DAYLIGHT_FACTOR:
            return of("Daylight factor", "Tageslichtquotient");
        case v1::Measure::UGR:
            return of("Unified glare rating UGR", "Blendung UGR");
        case v1::Measure::DGP:
            return of("Daylight glare probability DGP", "Tageslichtblendung DGP");
        default:
            return "";
    }
}

std::string ReportWords::unit(v1::Measure::Quantity quantity) const {
    if (!is_illuminance(quantity)) {
        return quantity == v1::Measure::DAYLIGHT_FACTOR ? "%" : "";
    }
    return options_.foot_candles ? "fc" : "lx";
}

std::string ReportWords::number(double value, v1::Measure::Quantity quantity) const {
    if (quantity == v1::Measure::UGR) {
        return fmt::format("{:.1f}", value);
    }
    if (quantity == v1::Measure::DGP) {
        return fmt::format("{:.2f}", value);
    }
    const bool feet = options_.foot_candles && is_illuminance(quantity);
    return three_digits(feet ? value / lux_per_foot_candle : value);
}

std::string ReportWords::verdict(v1::Verdict verdict) const {
    switch (verdict) {
        case v1::MET:
            return std::string("<b class=\"met\">✓ ") + of("met", "erfüllt") + "</b>";
        case v1::MISSED:
            return std::string("<b class=\"missed\">✗ ") + of("missed", "nicht erfüllt") + "</b>";
        case v1::NOT_YET_KNOWN:
            return std::string("<b class=\"open\">? ") + of("not yet known", "noch offen") + "</b>";
        default:
            return "–";
    }
}

std::string ReportWords::range(float least, float most) const {
    return most > least ? fmt::format("{:g} {} {:g}", least, of("to", "bis"), most)
                        : fmt::format("{:g}", least);
}

std::string ReportWords::time(double unix_ms) {
    const auto seconds = static_cast<std::time_t>(std::floor(unix_ms / 1000.0));
    std::tm parts{};
    if (!(std::abs(unix_ms) < 1e14) || gmtime_r(&seconds, &parts) == nullptr) {
        return "–";
    }
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC", parts.tm_year + 1900, parts.tm_mon + 1,
                       parts.tm_mday, parts.tm_hour, parts.tm_min);
}

}  // namespace raybundle
