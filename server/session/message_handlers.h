// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "session/handler_result.h"
#include "session/session_services.h"

namespace raybundle {

/// Handles a message on the render thread. Throws GpuError.
using HandleMessage = HandlerResult (*)(SessionServices&, ViewerSession&, const ClientEvent&);

struct MessageHandler {
    v1::ClientMessage::BodyCase body;
    HandleMessage handle;
};

/// The handler of each message that reaches the render thread. What a message may contain, who may
/// send it and whether a newer one replaces it is in net/ws/rules/message_rules.cpp.
std::span<const MessageHandler> message_handlers();

/// Null where there is none.
HandleMessage handler_of(v1::ClientMessage::BodyCase body);

}  // namespace raybundle
