// SPDX-License-Identifier: Apache-2.0
#include "telemetry/trace_context.h"

#include <gtest/gtest.h>

namespace raybundle {
namespace {

const std::string kExample = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";

TEST(TraceContext, IsReadAndWrittenAsTheStandardHasIt) {
    const auto context = parse_traceparent(kExample);
    ASSERT_TRUE(context);
    EXPECT_EQ(hex_of(context->trace), "0af7651916cd43dd8448eb211c80319c");
    EXPECT_EQ(hex_of(context->span), "b7ad6b7169203331");
    EXPECT_TRUE(context->sampled);
    EXPECT_EQ(traceparent_of(*context), kExample);
    std::string unsampled = kExample;
    unsampled.back() = '0';
    EXPECT_FALSE(parse_traceparent(unsampled)->sampled);
    EXPECT_EQ(traceparent_of(*parse_traceparent(unsampled)), unsampled);
}

TEST(TraceContext, OfALaterVersionIsReadAsFarAsItIsKnown) {
    std::string later = kExample;
    later.replace(0, 2, "cc");
    EXPECT_TRUE(parse_traceparent(later));
    EXPECT_TRUE(parse_traceparent(later + "-what-the-future-brings"));
    EXPECT_FALSE(parse_traceparent(later + ".more"));
}

TEST(TraceContext, IgnoresWhatIsNone) {
    const auto with = [](std::size_t place, std::string_view letters) {
        std::string text = kExample;
        return parse_traceparent(text.replace(place, letters.size(), letters));
    };
    EXPECT_FALSE(parse_traceparent(""));
    EXPECT_FALSE(parse_traceparent(kExample.substr(1)));
    EXPECT_FALSE(parse_traceparent(kExample + "-00"));
    EXPECT_FALSE(with(0, "ff"));
    EXPECT_FALSE(with(2, "_"));
    EXPECT_FALSE(with(35, "_"));
    EXPECT_FALSE(with(52, "_"));
    EXPECT_FALSE(with(3, "0AF7"));  // lower case alone
    EXPECT_FALSE(with(53, "0g"));
    EXPECT_FALSE(with(3, std::string(32, '0')));
    EXPECT_FALSE(with(36, std::string(16, '0')));
}

TEST(TraceContext, IdsDifferAndAreNotZero) {
    EXPECT_NE(random_trace_id(), random_trace_id());
    EXPECT_NE(random_span_id(), random_span_id());
    EXPECT_NE(random_trace_id(), TraceId{});
}

}  // namespace
}  // namespace raybundle
