// SPDX-License-Identifier: Apache-2.0
#include "session/message_handlers.h"

#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace raybundle {
namespace {

using Client = v1::ClientMessage;

/// Answered on the network thread.
const std::set<Client::BodyCase> without_handler{Client::kHello, Client::kAck, Client::kAckLight,
                                                 Client::kPing};

TEST(MessageHandlers, EveryMessageThatReachesTheRenderThreadHasOne) {
    const auto* const body = Client::descriptor()->FindOneofByName("body");
    const auto handlers = message_handlers();
    for (int i = 0; i < body->field_count(); ++i) {
        const auto number = static_cast<Client::BodyCase>(body->field(i)->number());
        EXPECT_EQ(std::count_if(handlers.begin(), handlers.end(),
                                [number](const MessageHandler& h) { return h.body == number; }),
                  without_handler.contains(number) ? 0 : 1)
            << body->field(i)->name();
        EXPECT_EQ(handler_of(number) == nullptr, without_handler.contains(number));
    }
    EXPECT_EQ(handler_of(Client::BODY_NOT_SET), nullptr);
}

}  // namespace
}  // namespace raybundle
