// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "net/ws/wire_codec.h"

namespace raybundle {

class MessageChecker;

/// What becomes of a message of which an older one waits in the inbox.
enum class Waiting {
    queued,       ///< both are handled
    newest_only,  ///< the older one is dropped, if both set the same thing
};

/// What the network thread has to know of a kind of message of a client.
struct MessageRule {
    v1::ClientMessage::BodyCase body = v1::ClientMessage::BODY_NOT_SET;
    v1::Role role = v1::EDITOR;  ///< lowest that may send it
    Waiting waiting = Waiting::queued;
    /// Requires every range that raybundle.proto states; null: there is none.
    void (*check)(const v1::ClientMessage&, MessageChecker&) = nullptr;
};

/// One rule for each kind of message: the table of message_rules.cpp. What the render thread does
/// with them is in session/message_handlers.cpp.
std::span<const MessageRule> message_rules();

/// Null where there is none.
const MessageRule* rule_of(v1::ClientMessage::BodyCase body);

/// Name of a message as JSON has it, "addPin".
std::string message_name(const v1::ClientMessage& message);

/// Lowest role that may send a message of this kind.
v1::Role required_role(v1::ClientMessage::BodyCase body);

/// The refusal of a message that the role does not allow, with the message's id.
std::optional<Refusal> refuse_role(const v1::ClientMessage& message, v1::Role role);

/// Checks every range that raybundle.proto states and that can be checked without a scene: finite
/// numbers, field of view, sizes, directions, rotations, colours. Returns the first violation.
/// Whether an object, light, material, viewer or pixel exists is for the render thread to say.
std::optional<Refusal> validate(const v1::ClientMessage& message, const WireLimits& limits);

}  // namespace raybundle
