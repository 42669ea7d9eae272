// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/live/light_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

#include "walkthrough/live/light_block_code.h"
#include "walkthrough/quantise.h"

namespace raybundle {
namespace {

constexpr std::size_t wide_open = 1U << 30U;

/// Vertices along a line, 10 blocks of 100, with light that falls off along it.
struct Row {
    Row() : stream(cut_into_blocks(places(), 100)) { publish(1.0F); }

    static std::vector<glm::vec3> places() {
        std::vector<glm::vec3> positions;
        for (int i = 0; i < 1000; ++i) {
            positions.emplace_back(0.1F * static_cast<float>(i), 0.0F, 0.0F);
        }
        return positions;
    }

    /// Brighter by a factor, from a vertex on.
    std::size_t publish(float factor, std::size_t from = 0) {
        light.resize(1000);
        for (std::size_t i = from; i < light.size(); ++i) {
            const auto x = static_cast<float>(i);
            light[i] = factor * glm::vec3(100.0F, 60.0F, 30.0F) / (1.0F + 0.01F * x);
        }
        std::vector<std::uint32_t> packed;
        for (const glm::vec3& value : light) {
            packed.push_back(rgb9e5(value));
        }
        return stream.publish(packed);
    }

    LightStream stream;
    std::vector<glm::vec3> light;
};

/// A viewer's own copy of the light.
struct Copy {
    explicit Copy(const LightStream& stream) {
        for (const LightBlock& block : stream.blocks()) {
            values.resize(std::max(values.size(), block.first + block.count));
        }
    }

    static std::uint32_t word(const std::string& bytes, std::size_t at) {
        std::uint32_t number = 0;
        std::memcpy(&number, bytes.data() + at, sizeof number);
        return number;
    }

    /// Returns the blocks, in their order.
    std::vector<std::size_t> take(const LightStream& stream, const std::string& bytes) {
        std::vector<std::size_t> order;
        std::size_t at = 4;
        for (std::uint32_t i = 0; i < word(bytes, 0); ++i) {
            const LightBlock& block = stream.blocks()[word(bytes, at)];
            order.push_back(word(bytes, at));
            const std::size_t size = word(bytes, at + 4);
            const auto code = std::string_view(bytes).substr(at + 8, size);
            const auto decoded = decode_light_block(code, block.count);
            EXPECT_TRUE(decoded.has_value());
            std::copy(decoded->begin(), decoded->end(),
                      values.begin() + static_cast<std::ptrdiff_t>(block.first));
            at += 8 + size;
        }
        EXPECT_EQ(at, bytes.size());
        return order;
    }

    std::vector<std::uint32_t> values;
};

/// Largest relative error of a copy.
float error_of(const Copy& copy, const std::vector<glm::vec3>& light) {
    float most = 0.0F;
    for (std::size_t i = 0; i < light.size(); ++i) {
        most = std::max(
            most, glm::length(from_rgb9e5(copy.values[i]) - light[i]) / glm::length(light[i]));
    }
    return most;
}

TEST(LightBlockCode, LosesNothing) {
    std::mt19937 random(7);
    std::vector<std::uint32_t> values(257);
    for (std::uint32_t& value : values) {
        value = static_cast<std::uint32_t>(random());
    }
    EXPECT_EQ(decode_light_block(encode_light_block(values), values.size()), values);
    EXPECT_EQ(decode_light_block(encode_light_block({}), 0), std::vector<std::uint32_t>());
}

TEST(LightBlockCode, EvenLightTakesFewBytes) {
    Row row;
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < 100; ++i) {
        values.push_back(rgb9e5(row.light[i]));
    }
    EXPECT_LT(encode_light_block(values).size(), 200U);  // of 400
}

TEST(LightBlockCode, RefusesWhatIsNone) {
    const std::string code = encode_light_block(std::vector<std::uint32_t>(10, 5U));
    EXPECT_FALSE(decode_light_block(code, 9).has_value());
    EXPECT_FALSE(decode_light_block(code, 11).has_value());
    EXPECT_FALSE(decode_light_block(code.substr(0, code.size() / 2), 10).has_value());
    EXPECT_FALSE(decode_light_block("light", 10).has_value());
}

TEST(LightStream, WhoComesInHasTheLightToItsQuantisation) {
    Row row;
    LightFollower follower;
    Copy copy(row.stream);
    const auto message = follower.next(row.stream, {}, wide_open);
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(copy.take(row.stream, *message->bytes).size(), 10U);
    EXPECT_LT(error_of(copy, row.light), 1.0F / 256.0F);
    EXPECT_FALSE(follower.next(row.stream, {}, wide_open).has_value());
}

TEST(LightStream, WhatNobodySeesIsNotPublishedAndAddsUp) {
    Row row;
    EXPECT_EQ(row.publish(1.0F), 0U);
    EXPECT_EQ(row.publish(1.004F), 0U);
    // Slow changes count from what was published, so that they cannot creep away.
    EXPECT_EQ(row.publish(1.014F), 10U);
    EXPECT_EQ(row.publish(1.2F, 900), 1U);
}

TEST(LightStream, OneEncodingServesAll) {
    Row row;
    std::vector<LightFollower> followers(50);
    for (const float factor : {1.0F, 2.0F, 3.0F}) {
        row.publish(factor);
        for (LightFollower& follower : followers) {
            EXPECT_TRUE(follower.next(row.stream, {}, wide_open).has_value());
        }
    }
    EXPECT_EQ(row.stream.encodings(), 30U);
}

TEST(LightStream, WhoIsEquallyFarGetsTheVerySameMessage) {
    Row row;
    LightFollower early, late;
    const auto snapshot = early.next(row.stream, {}, wide_open);
    row.publish(2.0F, 900);
    const auto change = early.next(row.stream, {}, wide_open);
    Copy copy(row.stream);
    copy.take(row.stream, *snapshot->bytes);
    EXPECT_EQ(copy.take(row.stream, *change->bytes), std::vector<std::size_t>{9});
    EXPECT_LT(error_of(copy, row.light), 1.0F / 256.0F);
    // Who comes late has nothing of before, and is as far as the other one then.
    Copy other(row.stream);
    EXPECT_EQ(other.take(row.stream, *late.next(row.stream, {}, wide_open)->bytes).size(), 10U);
    row.publish(3.0F, 500);
    EXPECT_EQ(early.next(row.stream, {}, wide_open)->bytes,
              late.next(row.stream, {}, wide_open)->bytes);
}

TEST(LightStream, WhatHasChangedMoreComesFirst) {
    Row row;
    LightFollower follower;
    ASSERT_TRUE(follower.next(row.stream, {}, wide_open).has_value());
    row.publish(1.1F);
    row.publish(4.0F, 900);
    Copy copy(row.stream);
    // Far away all are about as large.
    const LightView view{{50.0F, 0.0F, 5000.0F}, {0.0F, 0.0F, -1.0F}, 0.6F};
    const auto message = follower.next(row.stream, view, wide_open);
    EXPECT_EQ(copy.take(row.stream, *message->bytes).front(), 9U);
}

TEST(LightStream, WhoAcknowledgesNothingGetsAWindowAndNoMore) {
    Row row;
    LightFollower follower;
    Copy copy(row.stream);
    constexpr std::size_t window = 700;
    std::vector<LightMessage> sent;
    for (int i = 1; i <= 100; ++i) {
        row.publish(1.0F + 0.1F * static_cast<float>(i));
        if (auto message = follower.next(row.stream, {}, window)) {
            sent.push_back(std::move(*message));
        }
        EXPECT_LE(follower.in_flight(), window);
    }
    // Then he gets the newest light, and nothing of what he has missed.
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        copy.take(row.stream, *sent[i].bytes);
        follower.acknowledge(sent[i].number);
        if (auto message = follower.next(row.stream, {}, window)) {
            bytes += message->bytes->size();
            sent.push_back(std::move(*message));
        }
    }
    EXPECT_EQ(follower.in_flight(), 0U);
    EXPECT_LT(error_of(copy, row.light), 1.0F / 256.0F);
    EXPECT_LT(bytes, 10U * 250U);
}

TEST(LightStream, AWindowSmallerThanABlockStillMovesOn) {
    Row row;
    LightFollower follower;
    Copy copy(row.stream);
    int messages = 0;
    while (const auto message = follower.next(row.stream, {}, 1)) {
        EXPECT_EQ(copy.take(row.stream, *message->bytes).size(), 1U);
        EXPECT_FALSE(follower.next(row.stream, {}, 1).has_value());
        follower.acknowledge(message->number + 5);  // not sent yet
        EXPECT_FALSE(follower.next(row.stream, {}, 1).has_value());
        follower.acknowledge(message->number);
        ++messages;
    }
    EXPECT_EQ(messages, 10);
    EXPECT_LT(error_of(copy, row.light), 1.0F / 256.0F);
}

TEST(LightStream, WhatIsSeenComesFirst) {
    Row row;
    row.publish(2.0F);
    LightFollower follower;
    Copy copy(row.stream);
    // Between block 3 and block 4, looking along the row.
    const LightView view{{40.0F, 2.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 0.6F};
    const auto message = follower.next(row.stream, view, wide_open);
    ASSERT_TRUE(message.has_value());
    const std::vector<std::size_t> order = copy.take(row.stream, *message->bytes);
    ASSERT_EQ(order.size(), 10U);
    const auto rank = [&](std::size_t block) {
        return std::find(order.begin(), order.end(), block) - order.begin();
    };
    for (std::size_t block = 5; block < 9; ++block) {
        EXPECT_LT(rank(block), rank(block + 1));  // nearer ones are larger
        EXPECT_LT(rank(block), rank(1));          // and all of them before what is behind
    }
}

TEST(LightStream, RefusesLightOfAnotherScene) {
    Row row;
    EXPECT_THROW(row.stream.publish(std::vector<std::uint32_t>(999)), std::invalid_argument);
}

}  // namespace
}  // namespace raybundle
