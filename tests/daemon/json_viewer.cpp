// SPDX-License-Identifier: Apache-2.0
#include "json_viewer.h"

#include <chrono>

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

/// Below ctest's limit, so that what hangs says where. An error of a picture at rest is measured on
/// a sixth of one core, which took more than five minutes where others had all but a tenth of it.
constexpr auto kPatience = std::chrono::seconds(3000);

}  // namespace

Json JsonViewer::join(const std::string& token, int width, int height) {
    return request({{"hello",
                     {{"protocol", "1.0"},
                      {"name", "test"},
                      {"token", token},
                      {"viewport", {{"width", width}, {"height", height}}}}}});
}

Json JsonViewer::request(Json body) {
    body["id"] = ++last_id_;
    send(body);
    return answer_to(last_id_);
}

std::optional<JsonViewer::Received> JsonViewer::receive() {
    const auto message = client_.read_message();
    if (!message || message->opcode == 8) {
        close_code_ = message ? message->close_code() : close_code_;
        return std::nullopt;
    }
    if (message->opcode == 1) {
        return Received{false, Json::parse(message->payload)};
    }
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;) {
        length = 256 * length + static_cast<unsigned char>(message->payload.at(i));
    }
    Json header = Json::parse(message->payload.substr(4, length));
    send({{"ack", {{"frame", header["frame"]}, {"decodeMs", 1}}}});
    return Received{true, std::move(header)};
}

Json JsonViewer::next(const std::function<bool(const Json&)>& fits) {
    const auto end = Clock::now() + kPatience;
    while (Clock::now() < end) {
        auto received = receive();
        if (!received) {
            return Json::object();
        }
        if (!received->is_frame && fits(received->json)) {
            return std::move(received->json);
        }
    }
    return Json::object();
}

Json JsonViewer::next_frame(const std::function<bool(const Json&)>& fits) {
    const auto end = Clock::now() + kPatience;
    while (Clock::now() < end) {
        auto received = receive();
        if (!received) {
            return Json::object();
        }
        if (received->is_frame && fits(received->json)) {
            return std::move(received->json);
        }
    }
    return Json::object();
}

int JsonViewer::close_code() {
    while (receive()) {
    }
    return close_code_;
}

}  // namespace raybundle
