// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "net/access/access_tokens.h"
#include "net/access/jwt.h"
#include "net/access/wrong_tokens.h"
#include "net/ws/upgrade_check.h"
#include "net/ws/viewer_link.h"
#include "net/ws/wire_codec.h"

namespace raybundle {

/// Who may come in; replaced as a whole when the settings are read again.
struct Access {
    AccessTokens tokens;
    OriginRules origins;
    std::shared_ptr<const JwtVerifier> jwt{};  ///< null: such tokens open nothing

    /// Everybody may do everything.
    [[nodiscard]] bool open() const { return tokens.empty() && jwt == nullptr; }
};

/// What a viewer got for its token.
struct Pass {
    v1::Role role = v1::EDITOR;
    TokenDigest token{};
    std::string token_name{};  ///< empty where the server has no tokens
    /// Of a JWT: Unix time, s; `token` is its verifier's fingerprint then.
    std::optional<double> expires_s{};
};

/// Why a viewer stays outside; `close` says whether its connection ends.
struct Denial {
    Refusal refusal;
    std::optional<CloseCode> close;
};

/// Lets viewers in: checks tokens and counts who is there. Any thread.
class Gate {
  public:
    explicit Gate(std::size_t max_viewers, Access access = {})
        : max_viewers_(max_viewers), access_(std::make_shared<const Access>(std::move(access))) {}

    /// Checks a hello. With a Pass the viewer counts as present until leave().
    std::variant<Pass, Denial> enter(const v1::Hello& hello);
    void leave();

    /// Checks an HTTP Authorization header, "Bearer TOKEN", and the name that its sender goes by.
    /// Who asks over HTTP does not count as present.
    [[nodiscard]] std::variant<Pass, Denial> admit(std::string_view authorization,
                                                   const std::string& name) const;

    /// Remembers a wrong token of a peer, in a log line where it is worth one, and says how long
    /// the answer is to wait.
    double note_wrong_token(const std::string& peer, std::string_view where, double now_ms);
    [[nodiscard]] std::uint64_t wrong_tokens() const { return wrong_tokens_.total(); }

    /// Whether the pass would be given again today.
    [[nodiscard]] bool still_valid(const Pass& pass) const;

    /// Whether an HTTP Authorization header opens /metrics: "Bearer TOKEN" with any token of the
    /// server, or anything where it has none.
    [[nodiscard]] bool opens_metrics(std::string_view authorization) const;

    /// What an HTTP Authorization header is worth; nothing for a wrong token or none.
    [[nodiscard]] std::optional<Pass> pass_of(std::string_view authorization) const;

    /// Role of an HTTP Authorization header, "Bearer TOKEN": EDITOR where the server has no tokens,
    /// nothing for a wrong token or none.
    [[nodiscard]] std::optional<v1::Role> role_of(std::string_view authorization) const;

    [[nodiscard]] std::shared_ptr<const Access> access() const;
    void set_access(Access access);

    [[nodiscard]] std::size_t present() const;

  private:
    [[nodiscard]] static std::optional<Pass> pass_for(const Access& access, std::string_view token);
    [[nodiscard]] static std::variant<Pass, Denial> check(const Access& access,
                                                          std::string_view token,
                                                          const std::string& name);

    const std::size_t max_viewers_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Access> access_;
    std::size_t present_ = 0;
    WrongTokens wrong_tokens_;
};

}  // namespace raybundle
