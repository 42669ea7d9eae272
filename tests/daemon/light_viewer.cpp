// SPDX-License-Identifier: Apache-2.0
#include "light_viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "walkthrough/live/light_block_code.h"
#include "walkthrough/quantise.h"

namespace raybundle {
namespace {

/// As JsonViewer's: below ctest's limit.
constexpr auto kLightPatience = std::chrono::seconds(1000);

std::uint32_t little_word(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

}  // namespace

LightViewer::LightViewer(std::uint16_t port) : client_(port) {
    client_.upgrade();
}

Json LightViewer::join(bool light) {
    Json hello = {
        {"protocol", "1.0"}, {"name", "light"}, {"viewport", {{"width", 160}, {"height", 120}}}};
    if (light) {
        hello["light"] = true;
    }
    return request({{"hello", hello}});
}

Json LightViewer::request(Json body) {
    body["id"] = ++last_id_;
    answer_ = nullptr;
    send(body);
    read_until([&] { return !answer_.is_null(); });
    return answer_;
}

bool LightViewer::read_until(const std::function<bool()>& enough) {
    const auto end = std::chrono::steady_clock::now() + kLightPatience;
    while (!enough()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        const auto message = client_.read_message();
        if (!message || message->opcode == 8) {
            return false;
        }
        if (message->opcode == 1) {
            take_text(Json::parse(message->payload));
        } else {
            take_binary(message->payload);
        }
    }
    return true;
}

void LightViewer::take_text(const Json& message) {
    if (message.value("replyTo", 0U) == last_id_) {
        answer_ = message;
    }
    if (message.contains("lightScene")) {
        scene = message["lightScene"];
        const auto size = scene["blockValues"].get<std::size_t>();
        values.assign(scene["values"].get<std::size_t>(), 0U);
        block_count_ = (values.size() + size - 1) / size;
        seen_.assign(block_count_, false);
        blocks_ = 0;
    } else if (message.contains("lightSky")) {
        sky = message["lightSky"];
    } else if (message.contains("lightMaterial")) {
        materials.push_back(message["lightMaterial"]);
    }
}

void LightViewer::take_binary(const std::string& payload) {
    const std::size_t length = little_word(payload, 0);
    const Json header = Json::parse(payload.substr(4, length));
    if (!header.contains("light")) {
        ++frames;
        send({{"ack", {{"frame", header["frame"]}, {"decodeMs", 1}}}});
        return;
    }
    ++messages;
    bytes += payload.size() - 4 - length;
    last = header["light"];
    epoch = header["epoch"];
    ASSERT_EQ(header["scene"], scene["scene"]);
    const std::string body = payload.substr(4 + length);
    const auto size = scene["blockValues"].get<std::size_t>();
    std::size_t at = 4;
    for (std::uint32_t i = 0; i < little_word(body, 0); ++i) {
        const std::size_t block = little_word(body, at);
        const std::size_t code = little_word(body, at + 4);
        ASSERT_LT(block, block_count_);
        const std::size_t count = std::min(size, values.size() - block * size);
        const auto decoded = decode_light_block(std::string_view(body).substr(at + 8, code), count);
        ASSERT_TRUE(decoded.has_value());
        std::copy(decoded->begin(), decoded->end(),
                  values.begin() + static_cast<std::ptrdiff_t>(block * size));
        blocks_ += seen_[block] ? 0 : 1;
        seen_[block] = true;
        at += 8 + code;
    }
    ASSERT_EQ(at, body.size());
    if (acknowledges) {
        send({{"ackLight", {{"light", last}}}});
    }
}

double LightViewer::mean() const {
    double sum = 0.0;
    for (const std::uint32_t value : values) {
        const glm::vec3 light = from_rgb9e5(value);
        sum += static_cast<double>(light.r + light.g + light.b) / 3.0;
    }
    return sum / static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

}  // namespace raybundle
