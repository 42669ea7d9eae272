// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "metrics_check.h"
#include "net/http/metrics_text.h"
#include "net/network_state.h"
#include "session/loop_metrics.h"

namespace raybundle {
namespace {

TEST(MetricsText, IsThePrometheusFormat) {
    MetricsText text;
    text.gauge("a_seconds", "How long", 0.25);
    text.counter("b_total", "How many", 1e12);
    text.family("c", "summary", "By kind");
    text.sample("c_sum", "kind=\"x\"", std::nan(""));
    text.sample("c_sum", "kind=\"y\"", std::numeric_limits<double>::infinity());
    EXPECT_EQ(
        text.text(),
        "# HELP a_seconds How long\n# TYPE a_seconds gauge\na_seconds 0.25\n"
        "# HELP b_total How many\n# TYPE b_total counter\nb_total 1000000000000\n"
        "# HELP c By kind\n# TYPE c summary\nc_sum{kind=\"x\"} NaN\nc_sum{kind=\"y\"} +Inf\n");
}

TEST(NetworkMetrics, EveryFamilyIsDeclaredOnceAndHasSamples) {
    NetworkState state({});
    const auto link = state.viewers.add(1000, {});
    std::istringstream lines(state.metrics());
    std::set<std::string> declared;
    std::set<std::string> sampled;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("# TYPE ")) {
            const std::string name = line.substr(7, line.find(' ', 7) - 7);
            EXPECT_TRUE(declared.insert(name).second) << name;
        } else if (!line.starts_with("# ")) {
            sampled.insert(line.substr(0, line.find_first_of(" {")));
        }
    }
    EXPECT_EQ(declared, sampled);
    EXPECT_TRUE(declared.contains("raybundle_queue_delay_seconds"));
    EXPECT_TRUE(declared.contains("raybundle_viewers"));
}

TEST(MetricsCheck, FindsWhatPromtoolFinds) {
    const auto finds = [](const std::string& text, std::string_view problem) {
        for (const std::string& found : metrics_problems(text)) {
            if (found.find(problem) != std::string::npos) {
                return true;
            }
        }
        return false;
    };
    const std::string good = "# HELP a_total How many\n# TYPE a_total counter\na_total 1\n";
    EXPECT_TRUE(metrics_problems(good).empty());
    EXPECT_TRUE(finds(good + good, "once"));
    EXPECT_TRUE(finds(good + "a_total 2\n", "twice"));
    EXPECT_TRUE(finds("# HELP a How\n# TYPE a counter\na 1\n", "_total"));
    EXPECT_TRUE(finds("# HELP a_total How\n# TYPE a_total gauge\na_total 1\n", "_total"));
    EXPECT_TRUE(finds("# TYPE a gauge\na 1\n", "HELP"));
    EXPECT_TRUE(finds("# HELP a How\n# TYPE a gauge\n", "no sample"));
    EXPECT_TRUE(finds("# HELP a_ms How\n# TYPE a_ms gauge\na_ms 1\n", "base unit"));
    EXPECT_TRUE(finds("# HELP a How\n# TYPE a gauge\na{quantile=\"1\"} 1\n", "no summary"));
    EXPECT_TRUE(finds("# HELP a How\n# TYPE a gauge\na nan\n", "number"));
    EXPECT_TRUE(finds("# HELP a How\n# TYPE a gauge\na 1", "does not end"));
    EXPECT_TRUE(finds("a 1\n", "TYPE"));
}

TEST(MetricsCheck, FindsNothingInWhatTheServerSays) {
    NetworkState state({});
    const auto link = state.viewers.add(1000, {});
    LoopMetrics loop;
    state.set_metrics_source([&] { return loop.text(); });
    for (const std::string& problem : metrics_problems(state.metrics())) {
        ADD_FAILURE() << problem;
    }
}

}  // namespace
}  // namespace raybundle
