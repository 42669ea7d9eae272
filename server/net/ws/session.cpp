// SPDX-License-Identifier: Apache-2.0
#include "net/ws/session.h"

#include <spdlog/spdlog.h>

#include <optional>
#include <utility>

#include "net/clock.h"
#include "net/ws/rules/message_rules.h"

namespace raybundle {
namespace {

constexpr int kMaxWrongTokens = 3;  ///< of one connection

}  // namespace

void Session::on_fragment(std::string_view bytes, bool first, bool last, bool binary,
                          double now_ms) {
    if (link_.closing() || held_) {
        return;
    }
    if (first) {
        buffer_.clear();
        binary_ = binary;
    }
    if (buffer_.size() + bytes.size() > limits_.max_message_bytes) {
        buffer_.clear();
        const std::string limit = std::to_string(limits_.max_message_bytes);
        refuse_and_close({v1::Error::RESOURCE_EXHAUSTED,
                          "the message is larger than " + limit + " bytes", std::nullopt},
                         CloseCode::too_large);
        return;
    }
    buffer_.append(bytes);
    if (!last) {
        return;
    }
    if (!messages_.take(now_ms)) {
        if (complaints_.take(now_ms)) {
            refuse({v1::Error::RESOURCE_EXHAUSTED, "too many messages a second", std::nullopt});
        }
        return;
    }
    ParsedMessage parsed = binary_ ? parse_binary_message(buffer_, limits_, reading_)
                                   : parse_text_message(buffer_, limits_, reading_);
    buffer_.clear();
    if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
        refuse(*refusal);
        return;
    }
    on_message(std::get<v1::ClientMessage>(std::move(parsed)), now_ms);
}

void Session::on_message(v1::ClientMessage message, double now_ms) {
    const auto id = message.has_id() ? std::optional(message.id()) : std::nullopt;
    if (message.has_hello()) {
        on_hello(std::move(message), now_ms);
    } else if (!pass_) {
        refuse({v1::Error::UNAUTHENTICATED, "hello must come first", id});
    } else if (const auto refusal = refuse_role(message, pass_->role)) {
        if (audit_ != nullptr) {
            audit_->refuse(link_.viewer(), message_name(message), refusal->text);
        }
        refuse(*refusal);
    } else if (message.has_ack()) {
        link_.on_ack(message.ack(), now_ms);
        if (id) {
            answer_ok(*id);
        }
    } else if (message.has_ack_light()) {
        if (!light_) {
            refuse({v1::Error::INVALID_ARGUMENT, "ackLight: hello has not asked for light", id});
            return;
        }
        link_.on_light_ack(message.ack_light().light());
        if (id) {
            answer_ok(*id);
        }
    } else if (message.has_ping()) {
        v1::ServerMessage answer;
        if (id) {
            answer.set_reply_to(*id);
        }
        answer.mutable_pong()->set_server_time_ms(server_time_ms());
        link_.send(answer);
    } else {
        if (audit_ != nullptr && is_audited(message)) {
            audit_->request(link_.viewer(), message_name(message));
        }
        const auto pushed = inbox_.push(link_.viewer(), std::move(message), pass_->role);
        if (!pushed) {
            refuse({v1::Error::RESOURCE_EXHAUSTED, "too many requests wait for an answer", id});
        } else if (pushed.replaced) {
            answer_ok(*pushed.replaced);
        }
    }
}

void Session::answer_ok(std::uint32_t id) {
    v1::ServerMessage answer;
    answer.set_reply_to(id);
    answer.mutable_ok();
    link_.send(answer);
}

/// Refuses a hello in a version that is not spoken here.
bool Session::speaks_our_version(const v1::ClientMessage& message) {
    const auto id = message.has_id() ? std::optional(message.id()) : std::nullopt;
    const std::string& version = message.hello().protocol();
    const auto spoken = parse_protocol_version(version);
    if (!spoken) {
        refuse({v1::Error::INVALID_ARGUMENT, "hello.protocol: must be major.minor, as in 1.0", id});
        return false;
    }
    if (spoken->major != own_protocol_version().major) {
        refuse_and_close({v1::Error::UNIMPLEMENTED,
                          "hello.protocol: client speaks " + version + ", server speaks " +
                              std::string(kProtocolVersion),
                          id},
                         CloseCode::protocol_error);
        return false;
    }
    return true;
}

void Session::on_hello(v1::ClientMessage message, double now_ms) {
    const auto id = message.has_id() ? std::optional(message.id()) : std::nullopt;
    if (pass_) {
        refuse({v1::Error::INVALID_ARGUMENT, "hello: has been said already", id});
        return;
    }
    if (!speaks_our_version(message)) {
        return;
    }
    auto answer = gate_.enter(message.hello());
    if (auto* denial = std::get_if<Denial>(&answer)) {
        denial->refusal.id = id;
        const bool wrong = denial->refusal.code == v1::Error::UNAUTHENTICATED;
        if (audit_ != nullptr) {
            audit_->refuse({message.hello().name(), std::nullopt, "", peer_}, "hello",
                           denial->refusal.text);
        }
        on_denied(*denial, wrong && !message.hello().token().empty(), now_ms);
        return;
    }
    pass_ = std::get<Pass>(answer);
    if (!pass_->token_name.empty()) {
        message.mutable_hello()->set_name(pass_->token_name);  // whatever its holder says
    }
    reading_ = reading_of(message.hello());
    light_ = message.hello().light();
    spdlog::info("viewer {} from {} is '{}', {}{}", link_.viewer(), peer_, message.hello().name(),
                 v1::Role_Name(pass_->role),
                 pass_->token_name.empty() ? "" : " by the token '" + pass_->token_name + "'");
    if (audit_ != nullptr) {
        audit_->connect(link_.viewer(),
                        {message.hello().name(), pass_->role, pass_->token_name, peer_});
    }
    message.mutable_hello()->clear_token();  // nobody behind the gate needs it
    inbox_.joined(link_.viewer(), std::move(message), pass_->role);
}

/// The answer to a wrong token waits the longer the more there were.
void Session::on_denied(const Denial& denial, bool wrong_token, double now_ms) {
    held_ = Held{denial, now_ms};
    if (++wrong_tokens_ >= kMaxWrongTokens && !denial.close) {
        held_->denial.close = CloseCode::policy_violation;
    }
    const double delay = wrong_token ? gate_.note_wrong_token(peer_, "hello", now_ms) : 0.0;
    if (delay > 0.0) {
        held_->until_ms = now_ms + delay;
    } else {
        release_held();
    }
}

std::optional<double> Session::held_until() const {
    return held_ ? std::optional(held_->until_ms) : std::nullopt;
}

void Session::release_held() {
    if (!held_) {
        return;
    }
    const Denial denial = std::move(held_->denial);
    held_.reset();
    if (denial.close) {
        refuse_and_close(denial.refusal, *denial.close);
    } else {
        refuse(denial.refusal);
    }
}

void Session::check_pass() {
    if (pass_ && !gate_.still_valid(*pass_)) {
        refuse_and_close(
            {v1::Error::UNAUTHENTICATED,
             "the token is no longer valid, or allows something else now", std::nullopt},
            CloseCode::policy_violation);
    }
}

void Session::on_hello_timeout() {
    if (!pass_) {
        refuse_and_close({v1::Error::UNAUTHENTICATED, "hello did not come in time", std::nullopt},
                         CloseCode::policy_violation);
    }
}

void Session::on_closed() {
    if (pass_) {
        gate_.leave();
        if (audit_ != nullptr) {
            audit_->disconnect(link_.viewer());
        }
        inbox_.left(link_.viewer());
    }
}

void Session::refuse(const Refusal& refusal) {
    link_.send(to_message(refusal));
}

void Session::refuse_and_close(const Refusal& refusal, CloseCode code) {
    refuse(refusal);
    link_.close(code, refusal.text);
}

}  // namespace raybundle
