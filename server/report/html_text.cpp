// SPDX-License-Identifier: Apache-2.0
#include "report/html_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace raybundle {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                if (byte >= 0x20 || c == '\n' || c == '\t') {
                    result += c;
                }
        }
    }
    return result;
}

std::string three_digits(double value) {
    if (!std::isfinite(value)) {
        return "–";
    }
    if (value == 0.0) {
        return "0";
    }
    const double magnitude = std::floor(std::log10(std::abs(value) * 1.0005));
    const int digits = std::clamp(2 - static_cast<int>(magnitude), 0, 4);
    return fmt::format("{:.{}f}", value, digits);
}

std::string html_table(const std::vector<std::string>& heads,
                       const std::vector<std::vector<std::string>>& rows) {
    std::string html = "<table><thead><tr>";
    for (const std::string& head : heads) {
        html += "<th scope=\"col\">" + head + "</th>";
    }
    html += "</tr></thead><tbody>\n";
    for (const auto& row : rows) {
        html += "<tr>";
        for (const std::string& cell : row) {
            html += "<td>" + cell + "</td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

}  // namespace raybundle
