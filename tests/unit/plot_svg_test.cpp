// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "research/plot/line_plot.h"
#include "research/plot/svg_text.h"
#include "xml_check.h"

namespace raybundle {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

LinePlot two_lines() {
    LinePlot plot;
    plot.title = "errors";
    plot.x = {"time", " s", AxisScale::logarithmic};
    plot.y = {"error", " %", AxisScale::logarithmic};
    plot.series = {{"combined", {{0.1, 20.0, {}}, {1.0, 5.0, {}}, {10.0, 1.5, {}}}, false, 0},
                   {"path",
                    {{0.1, 30.0, std::pair{25.0, 36.0}}, {1.0, 10.0, std::pair{8.0, 12.0}}},
                    false,
                    1}};
    plot.rules = {{0.4, "noise of the reference"}};
    return plot;
}

/// The check of these tests can itself fail.
TEST(XmlCheck, FindsWhatIsWrong) {
    EXPECT_EQ(xml_fault("<a x=\"1\"><b/>text &amp; more</a>\n"), "");
    for (const char* bad : {"<a><b></a></b>", "<a", "<a>&nbsp;</a>", "<a x=1/>", "<a/><b/>",
                            "<a x=\"1\" x=\"2\"/>", "<a>", "</a>", "<a x=\"<\"/>", "text", ""}) {
        EXPECT_NE(xml_fault(bad), "") << bad;
    }
}

TEST(LinePlotSvg, IsWellFormedAndHasEveryPart) {
    const std::string svg = svg_of(two_lines());
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_EQ(count_of(svg, "<polyline"), 2U);
    EXPECT_EQ(count_of(svg, "class=\"marker"), 5U);
    EXPECT_EQ(count_of(svg, "<polygon class=\"band"), 1U);
    for (const char* text : {">combined<", ">path<", ">errors<", ">time<", ">error<", ">10 s<",
                             ">20 %<", ">noise of the reference<", "prefers-color-scheme: dark"}) {
        EXPECT_EQ(count_of(svg, text) > 0, true) << text;
    }
}

TEST(LinePlotSvg, EscapesNamesAndTitles) {
    LinePlot plot = two_lines();
    plot.title = "<script>alert(1)</script> & \"more\"";
    plot.series[0].name = "a<b>&'c' \x01 \xff \xc3\xa9";
    plot.rules[0].name = "]]>";
    plot.x.title = "</svg>";
    const std::string svg = svg_of(plot);
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_EQ(count_of(svg, "<script"), 0U);
    EXPECT_EQ(count_of(svg, "</svg>"), 1U);
    EXPECT_GT(count_of(svg, "a&lt;b&gt;&amp;&#39;c&#39; \xEF\xBF\xBD \xEF\xBF\xBD \xc3\xa9"), 0U);
}

TEST(LinePlotSvg, NeverHasANumberThatIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    LinePlot plot = two_lines();
    plot.series[0].points = {{nan, 1.0, {}},
                             {1.0, nan, {}},
                             {0.0, 1.0, {}},
                             {1.0, -1.0, {}},
                             {infinity, 1.0, {}},
                             {2.0, 3.0, std::pair{nan, 4.0}},
                             {3.0, 3.0, std::pair{0.0, 4.0}}};
    plot.rules = {{nan, "nothing"}, {0.0, "zero"}};
    const std::string svg = svg_of(plot);
    EXPECT_EQ(xml_fault(svg), "");
    for (const char* bad : {"nan", "inf", "NaN", "Inf", "zero", "nothing"}) {
        EXPECT_EQ(count_of(svg, bad), 0U) << bad;
    }
    EXPECT_EQ(count_of(svg, "class=\"marker f0"), 2U);
    EXPECT_THROW(svg_number(nan), std::invalid_argument);
}

TEST(LinePlotSvg, DotsTheLineToWhatIsNotFirm) {
    LinePlot plot = two_lines();
    plot.series[0].points[2].firm = false;
    const std::string svg = svg_of(plot);
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_EQ(count_of(svg, "class=\"line s0\""), 1U);
    EXPECT_EQ(count_of(svg, "class=\"line s0 dotted\""), 1U);
    EXPECT_EQ(count_of(svg, "class=\"marker f0\""), 2U);
    EXPECT_EQ(count_of(svg, "class=\"open s0\""), 1U);
}

TEST(LinePlotSvg, DrawsAPlotWithNothingInIt) {
    LinePlot plot = two_lines();
    plot.series.clear();
    plot.rules.clear();
    EXPECT_EQ(xml_fault(svg_of(plot)), "");
}

TEST(LinePlotSvg, PutsHigherValuesHigher) {
    const std::string svg = svg_of(two_lines());
    const std::size_t at = svg.find("points=\"", svg.find("<polyline")) + 8;
    double x0 = 0.0;
    double y0 = 0.0;
    double x1 = 0.0;
    double y1 = 0.0;
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "%lf,%lf %lf,%lf", &x0, &y0, &x1, &y1), 4);
    EXPECT_LT(x0, x1);
    EXPECT_LT(y0, y1);  // downwards: the error falls
}

TEST(ReadableNumber, HasNoExponentWhereNoneIsNeeded) {
    EXPECT_EQ(readable_number(0.05), "0.05");
    EXPECT_EQ(readable_number(2.0), "2");
    EXPECT_EQ(readable_number(12345.6), "12346");
    EXPECT_EQ(readable_number(1.2345), "1.23");
}

}  // namespace
}  // namespace raybundle
