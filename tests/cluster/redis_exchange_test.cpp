// SPDX-License-Identifier: Apache-2.0
// What workers of a project share of their light by Redis, without a solver around it.
#include "journal/redis/redis_exchange.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "journal/solution_estimate.h"
#include "redis_server.h"

namespace raybundle::redis_exchange_test {
namespace {

constexpr SolutionState state{3, 42, 2};
const PatchMeans one_means = {{1.0F, 2.0F, 3.0F, 1.0F}, {4.0F, 4.0F, 4.0F, 1.0F}};
const PatchMeans two_means = {{4.0F, 2.0F, 0.0F, 2.0F}, {1.0F, 4.0F, 7.0F, 2.0F}};

void pause() {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// The first sum that fits; a lack of it ends in the test's time limit.
MergedMeans collected(SolutionExchange& exchange,
                      const std::function<bool(const MergedMeans&)>& fits) {
    for (;;) {
        if (auto merged = exchange.collect(); merged && fits(*merged)) {
            return *merged;
        }
        pause();
    }
}

MergedMeans of_workers(SolutionExchange& exchange, unsigned workers) {
    return collected(exchange, [=](const MergedMeans& m) { return m.workers == workers; });
}

void wait_for(const SolutionExchange& exchange,
              const std::function<bool(const ExchangeFigures&)>& fits) {
    while (!fits(exchange.figures())) {
        pause();
    }
}

class RedisExchangeTest : public testing::Test {
  protected:
    /// A worker that has begun.
    std::unique_ptr<RedisExchange> worker(char name, const SolutionState& of = state,
                                          float unit = 1.0F, int alive_ms = 60000) const {
        RedisExchangeSettings settings;
        settings.address = server.address();
        settings.project = "office";
        settings.worker = std::string(16, name);
        settings.poll_ms = 5;
        settings.alive_ms = alive_ms;
        auto exchange = std::make_unique<RedisExchange>(settings);
        exchange->begin(of, unit);
        return exchange;
    }
    RedisServer server;
};

TEST_F(RedisExchangeTest, EachGetsTheSumOfTheOthersAndNeverItsOwn) {
    const auto one = worker('a');
    const auto two = worker('b', state, 10.0F);
    const auto idle = worker('c');
    one->publish(one_means);
    EXPECT_EQ(of_workers(*two, 1).means[0], glm::vec4(0.1F, 0.2F, 0.3F, 1.0F)) << "in its own unit";
    two->publish({{0.4F, 0.2F, 0.0F, 2.0F}, {0.1F, 0.4F, 0.7F, 2.0F}});
    EXPECT_EQ(of_workers(*one, 1).means[0], two_means[0]);
    const MergedMeans all = of_workers(*idle, 2);
    EXPECT_EQ(all.means[0], glm::vec4(3.0F, 2.0F, 1.0F, 3.0F));
    EXPECT_EQ(all.means[1], glm::vec4(2.0F, 4.0F, 6.0F, 3.0F));
    // What is published again takes the place of what was there.
    one->publish({{7.0F, 2.0F, -3.0F, 4.0F}, {4.0F, 4.0F, 4.0F, 4.0F}});
    EXPECT_EQ(collected(*idle, [](const MergedMeans& m) { return m.weights > 5.0; }).means[0],
              glm::vec4(6.0F, 2.0F, -2.0F, 6.0F));
    EXPECT_FALSE(one->collect()) << "it has what it had";
}

TEST_F(RedisExchangeTest, TheSameEstimatesGiveTheSameBits) {
    const auto one = worker('a');
    const auto two = worker('b');
    const auto three = worker('c');
    PatchMeans odd = {{0.1F, 1e-7F, 3.3F, 0.7F}, {1e7F, 1.0F, 2.0F, 0.3F}};
    for (const auto* each : {&one, &two, &three}) {
        (*each)->publish(odd);
        odd[0] *= 1.1F;
        odd[1] *= 0.9F;
    }
    const auto first = worker('d');
    const auto later = worker('e');
    const MergedMeans a = of_workers(*first, 3);
    const MergedMeans b = of_workers(*later, 3);
    EXPECT_EQ(a.means, b.means);
}

TEST_F(RedisExchangeTest, AfterAChangeOldEstimatesDoNotCount) {
    const auto one = worker('a');
    const auto two = worker('b');
    one->publish(one_means);
    two->publish(two_means);
    of_workers(*one, 1);
    of_workers(*two, 1);
    SolutionState changed = state;
    ++changed.epoch;
    one->begin(changed, 1.0F);
    EXPECT_EQ(one->figures().workers, 0U);
    EXPECT_EQ(of_workers(*two, 0).means[0].w, 0.0F) << "what is of another state is gone";
    two->begin(changed, 1.0F);
    two->publish(one_means);
    EXPECT_EQ(of_workers(*one, 1).means[0], one_means[0]);
}

TEST_F(RedisExchangeTest, WhoDoesNotTellThatHeIsThereFades) {
    const auto one = worker('a', state, 1.0F, 300);
    one->publish(one_means);
    {
        const auto two = worker('b', state, 1.0F, 300);
        two->publish(two_means);
        of_workers(*one, 1);
    }
    EXPECT_EQ(of_workers(*one, 0).weights, 0.0);
    // It is forgotten, and who is there is not.
    const auto three = worker('c');
    EXPECT_EQ(of_workers(*three, 1).means[0], one_means[0]);
}

TEST_F(RedisExchangeTest, WhatDoesNotFitIsRefused) {
    SolutionState other = state;
    other.fingerprint = 43;
    const auto one = worker('a', other);
    const auto two = worker('b');
    one->publish(one_means);
    wait_for(*two, [](const ExchangeFigures& f) { return f.refused == 1; });
    EXPECT_FALSE(two->collect());
    // Bytes that somebody else has put there.
    server.command({"SADD", "raybundle:{office}:workers", std::string(16, 'd'), "not a worker",
                    std::string(16, 'x')});
    server.command({"SET", "raybundle:{office}:solution:3:" + std::string(16, 'd'),
                    encode_estimate({state, 1}, one_means, 1.0F) + "more"});
    wait_for(*two, [](const ExchangeFigures& f) { return f.refused == 2; });
    EXPECT_FALSE(two->collect());
    EXPECT_TRUE(two->figures().working);
    const auto fitting = worker('c');
    fitting->publish(two_means);
    EXPECT_EQ(of_workers(*two, 1).means[0], two_means[0]);
}

TEST_F(RedisExchangeTest, GoesOnWhenRedisIsBackWithoutItsData) {
    const auto one = worker('a');
    const auto two = worker('b');
    one->publish(one_means);
    of_workers(*two, 1);
    server.kill_it();
    wait_for(*two, [](const ExchangeFigures& f) { return !f.working; });
    EXPECT_FALSE(two->collect()) << "what has been merged stays";
    server.lose_data();
    server.start();
    wait_for(*two, [](const ExchangeFigures& f) { return f.working; });
    const auto three = worker('c');
    EXPECT_EQ(of_workers(*three, 1).means[0], one_means[0]);
}

}  // namespace
}  // namespace raybundle::redis_exchange_test
