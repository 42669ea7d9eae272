// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "net/metrics_text.h"
#include "net/network_state.h"

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

}  // namespace
}  // namespace raybundle
