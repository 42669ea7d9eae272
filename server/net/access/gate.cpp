// SPDX-License-Identifier: Apache-2.0
#include "net/access/gate.h"

#include <spdlog/spdlog.h>

#include <chrono>

namespace raybundle {

namespace {

double unix_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

/// Of "Bearer TOKEN"; empty where it is something else.
std::string_view token_of(std::string_view authorization) {
    constexpr std::string_view kScheme = "Bearer ";
    return authorization.starts_with(kScheme) ? authorization.substr(kScheme.size())
                                              : std::string_view();
}

}  // namespace

/// Nothing for a token that opens nothing.
std::optional<Pass> Gate::pass_for(const Access& access, std::string_view token) {
    if (access.open()) {
        return Pass{};
    }
    if (access.jwt != nullptr && looks_like_jwt(token)) {
        const auto jwt = access.jwt->verify(token, unix_s());
        return jwt ? std::optional(
                         Pass{jwt->role, access.jwt->fingerprint(), jwt->name, jwt->expires_s})
                   : std::nullopt;
    }
    const TokenDigest digest = token_digest(token);
    const auto found = access.tokens.find(digest);
    return found ? std::optional(Pass{found->role, digest, found->name}) : std::nullopt;
}

std::variant<Pass, Denial> Gate::check(const Access& access, std::string_view token,
                                       const std::string& name) {
    auto pass = pass_for(access, token);
    if (!pass) {
        const std::string reason = token.empty() ? "is missing" : "is not valid";
        return Denial{{v1::Error::UNAUTHENTICATED, "hello.token: " + reason, std::nullopt},
                      std::nullopt};
    }
    if (access.tokens.owns_name(name) && !same_name(name, pass->token_name)) {
        return Denial{{v1::Error::PERMISSION_DENIED,
                       "hello.name: '" + name + "' is the name of another token", std::nullopt},
                      std::nullopt};
    }
    return std::move(*pass);
}

std::variant<Pass, Denial> Gate::enter(const v1::Hello& hello) {
    auto checked = check(*access(), hello.token(), hello.name());
    if (std::holds_alternative<Denial>(checked)) {
        return checked;
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
    return checked;
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
    const auto current = access();
    if (pass.expires_s) {
        return current->jwt != nullptr && current->jwt->fingerprint() == pass.token &&
               unix_s() < *pass.expires_s;
    }
    if (current->open()) {
        return pass.role == v1::EDITOR;
    }
    const auto token = current->tokens.find(pass.token);
    return token && token->role == pass.role;
}

bool Gate::opens_metrics(std::string_view authorization) const {
    return role_of(authorization).has_value();
}

std::optional<v1::Role> Gate::role_of(std::string_view authorization) const {
    const auto pass = pass_of(authorization);
    return pass ? std::optional(pass->role) : std::nullopt;
}

std::optional<Pass> Gate::pass_of(std::string_view authorization) const {
    return pass_for(*access(), token_of(authorization));
}

std::variant<Pass, Denial> Gate::admit(std::string_view authorization,
                                       const std::string& name) const {
    return check(*access(), token_of(authorization), name);
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
