// SPDX-License-Identifier: Apache-2.0
#include "net/access/gate.h"

#include <spdlog/spdlog.h>

namespace raybundle {

std::variant<Pass, Denial> Gate::enter(const v1::Hello& hello) {
    const auto current = access();
    const Pass pass{v1::EDITOR, token_digest(hello.token()), {}};
    const auto role = current->tokens.role_of(pass.token);
    if (!role) {
        const std::string reason = hello.token().empty() ? "is missing" : "is not valid";
        return Denial{{v1::Error::UNAUTHENTICATED, "hello.token: " + reason, std::nullopt},
                      std::nullopt};
    }
    const auto token = current->tokens.find(pass.token);
    const std::string token_name = token ? token->name : "";
    if (current->tokens.owns_name(hello.name()) && !same_name(hello.name(), token_name)) {
        return Denial{
            {v1::Error::PERMISSION_DENIED,
             "hello.name: '" + hello.name() + "' is the name of another token", std::nullopt},
            std::nullopt};
    }
    const std::lock_guard lock(mutex_);
    if (present_ >= max_viewers_) {
        return Denial{{v1::Error::RESOURCE_EXHAUSTED,
                       "the server is full, it takes " + std::to_string(max_viewers_) +
                           (max_viewers_ == 1 ? " viewer" : " viewers"),
                       std::nullopt},
                      CloseCode::try_again_later};
    }
    ++present_;
    return Pass{*role, pass.token, token_name};
}

double Gate::note_wrong_token(const std::string& peer, std::string_view where, double now_ms) {
    const WrongTokens::Answer answer = wrong_tokens_.note(peer, now_ms);
    if (answer.worth_a_line) {
        spdlog::warn("wrong token from {} in {}, {} so far", peer, where, answer.of_this_peer);
    }
    return answer.delay_ms;
}

void Gate::leave() {
    const std::lock_guard lock(mutex_);
    present_ -= present_ > 0 ? 1 : 0;
}

bool Gate::still_valid(const Pass& pass) const {
    return access()->tokens.role_of(pass.token) == pass.role;
}

bool Gate::opens_metrics(std::string_view authorization) const {
    return role_of(authorization).has_value();
}

std::optional<v1::Role> Gate::role_of(std::string_view authorization) const {
    constexpr std::string_view kScheme = "Bearer ";
    const auto current = access();
    if (current->tokens.empty()) {
        return v1::EDITOR;
    }
    return authorization.starts_with(kScheme)
               ? current->tokens.role_of(token_digest(authorization.substr(kScheme.size())))
               : std::nullopt;
}

std::shared_ptr<const Access> Gate::access() const {
    const std::lock_guard lock(mutex_);
    return access_;
}

void Gate::set_access(Access access) {
    auto next = std::make_shared<const Access>(std::move(access));
    const std::lock_guard lock(mutex_);
    access_ = std::move(next);
}

std::size_t Gate::present() const {
    const std::lock_guard lock(mutex_);
    return present_;
}

}  // namespace raybundle
