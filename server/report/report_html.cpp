// SPDX-License-Identifier: Apache-2.0
#include "report/report_html.h"

#include "report/html_text.h"
#include "report/report_sections.h"

namespace raybundle {
namespace {

constexpr const char* style = R"(
@page{size:A4;margin:16mm 14mm 18mm;@bottom-right{content:counter(page) " / " counter(pages);
font:9pt system-ui,sans-serif;color:#54595f}}
*{box-sizing:border-box}body{font:10.5pt/1.45 system-ui,sans-serif;color:#1a1c1e;background:#fff;max-width:182mm;margin:12mm auto;padding:0 4mm}
h1{font-size:22pt;line-height:1.2;margin:0 0 2mm;overflow-wrap:anywhere}h2{font-size:14pt;margin:9mm 0 2mm;break-after:avoid}
h3{font-size:11.5pt;margin:6mm 0 1mm;break-after:avoid}p{margin:1mm 0 2mm}
.quiet{color:#54595f}.met{color:#146c2e}.missed{color:#b3261e}.open{color:#7a4f00}
table{border-collapse:collapse;width:100%;font-size:9.5pt;margin:1mm 0 3mm}thead{display:table-header-group}
th,td{text-align:left;padding:1mm 3mm 1mm 0;border-bottom:.3mm solid #d2d5d8;vertical-align:top;overflow-wrap:break-word}
tr,svg,figure,.zone{break-inside:avoid}svg{display:block;width:100%;max-height:110mm;margin:2mm 0;print-color-adjust:exact}
text{font:9px system-ui,sans-serif;fill:#1a1c1e}.value{text-anchor:middle;dominant-baseline:middle;font-size:8px}
.level{text-anchor:middle;font-weight:700;font-size:10px;paint-order:stroke;stroke:#fff;stroke-width:3px}
.isolux{fill:none;stroke:#1a1c1e;stroke-width:1.1}.outline{fill:none;stroke:#1a1c1e;stroke-width:1.6}
.gaze{fill:none;stroke:#b3261e;stroke-width:1.6}
@media print{body{margin:0;padding:0;max-width:none}a{color:inherit;text-decoration:none}}
@media screen and (max-width:600px){body{margin:4mm auto}table{font-size:8.5pt}}
)";

}  // namespace

std::string report_html(const ReportData& data, const ReportOptions& options) {
    const ReportWords words(options);
    const std::string title =
        escaped(data.scene.name()) + ": " + words.of("lighting report", "Lichtbericht");
    std::string html = std::string("<!DOCTYPE html>\n<html lang=\"") + words.of("en", "de") +
                       "\">\n<head><meta charset=\"utf-8\">"
                       "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
                       "<title>" +
                       title + "</title>\n<style>" + style + "</style></head>\n<body>\n";
    html += project_section(data, words);
    html += overview_section(data, words);
    html += luminaire_section(data, words);
    html += zone_sections(data, words);
    html += pin_section(data, words);
    html += change_section(data, words);
    html += method_section(data, words);
    return html + "</body>\n</html>\n";
}

}  // namespace raybundle
