// SPDX-License-Identifier: Apache-2.0
// What workers tell each other of their light, as bytes.
#include "journal/solution_estimate.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace raybundle::solution_estimate_test {
namespace {

const SolutionState state{7, 0x123456789abcdef0ULL, 3};
const PatchMeans few = {
    {1.0F, 2.0F, 3.0F, 2.0F}, {0.0F, 0.0F, 0.0F, 0.0F}, {5.0F, 5.0F, 5.0F, 1.0F}};
const PatchMeans many = {
    {4.0F, 2.0F, 0.0F, 6.0F}, {1.0F, 1.0F, 1.0F, 6.0F}, {5.0F, 1.0F, 5.0F, 3.0F}};

std::string encoded(const PatchMeans& means, float unit = 1.0F) {
    return encode_estimate({state, 1}, means, unit);
}

void put(std::string& bytes, std::size_t at, float value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

TEST(SolutionEstimate, HasSixteenBytesAPatchAndItsHead) {
    const std::string bytes = encode_estimate({state, 9}, few, 1.0F);
    EXPECT_EQ(bytes.size(), 24U + 3 * 16U);
    const auto head = read_estimate_head(bytes);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->state, state);
    EXPECT_EQ(head->number, 9U);
    EXPECT_EQ(problem_of_estimate(bytes, state), "");
}

TEST(SolutionEstimate, SumIsTheWeightedMean) {
    EstimateSum sum(state.patches);
    sum.add(encoded(few));
    sum.add(encoded(many));
    const MergedMeans merged = sum.means(1.0F);
    EXPECT_EQ(merged.means[0], glm::vec4(3.25F, 2.0F, 0.75F, 8.0F));
    EXPECT_EQ(merged.means[1], many[1]) << "what has no weight does not count";
    EXPECT_EQ(merged.means[2], glm::vec4(5.0F, 2.0F, 5.0F, 4.0F));
    EXPECT_EQ(merged.workers, 2U);
    EXPECT_DOUBLE_EQ(merged.weights, 1.0 + 5.0);
    EXPECT_DOUBLE_EQ(merged.squared_weights, 1.0 + 25.0);
}

TEST(SolutionEstimate, WorkersHaveUnitsOfTheirOwn) {
    EstimateSum sum(state.patches);
    sum.add(encoded(few, 100.0F));
    EXPECT_EQ(sum.means(10.0F).means[0], glm::vec4(10.0F, 20.0F, 30.0F, 2.0F));
}

TEST(SolutionEstimate, OfAnotherSceneOrStateIsRefused) {
    const std::string bytes = encoded(few);
    SolutionState other = state;
    other.epoch = 8;
    EXPECT_NE(problem_of_estimate(bytes, other).find("another state"), std::string::npos);
    other = state;
    other.fingerprint += 1;
    EXPECT_NE(problem_of_estimate(bytes, other).find("options, version"), std::string::npos);
    other = state;
    other.patches = 4;
    EXPECT_NE(problem_of_estimate(bytes, other).find("3 patches, and this one into 4"),
              std::string::npos);
}

TEST(SolutionEstimate, BytesThatAreNoneAreRefused) {
    EXPECT_FALSE(read_estimate_head(""));
    EXPECT_FALSE(read_estimate_head(std::string(100, 'x')));
    const std::string whole = encoded(few);
    for (const std::size_t bytes :
         {std::size_t{0}, std::size_t{23}, std::size_t{24}, whole.size() - 1}) {
        EXPECT_NE(problem_of_estimate(whole.substr(0, bytes), state), "") << bytes;
    }
    EXPECT_NE(problem_of_estimate(whole + "x", state), "");
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 2e30F}) {
        for (const std::size_t at : {24U, 24U + 12U, 24U + 44U}) {
            std::string bytes = whole;
            put(bytes, at, wrong);
            EXPECT_NE(problem_of_estimate(bytes, state), "") << wrong << " at " << at;
        }
    }
    std::string bytes = whole;
    put(bytes, 24 + 12, -1.0F);
    EXPECT_NE(problem_of_estimate(bytes, state), "") << "a weight below 0";
}

}  // namespace
}  // namespace raybundle::solution_estimate_test
