// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "net/access/token_bucket.h"
#include "net/audit/audit_file.h"
#include "raybundle.pb.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// Somebody, as far as the server knows.
struct AuditIdentity {
    std::string name;              ///< that others see
    std::optional<v1::Role> role;  ///< none: it may do nothing
    std::string token;             ///< name of the token; empty: none
    std::string address;
};

/// Who has connected, changed, asked for and fetched what: a JSON object a line,
/// deploy/README.md has the fields. Any thread; waits for the file system and for nothing else.
class AuditLog {
  public:
    static constexpr double max_refusals_per_second = 20.0;  ///< further ones are counted
    /// Changes may be made after their viewer has left.
    static constexpr std::size_t max_left = 1024;

    /// Throws std::runtime_error where the file cannot be written.
    explicit AuditLog(std::string file) : file_(std::move(file)) {}

    void reopen() { file_.reopen(); }
    [[nodiscard]] std::uint64_t failures() const { return file_.failures(); }

    /// A viewer comes and goes.
    void connect(ViewerId viewer, const AuditIdentity& who);
    void disconnect(ViewerId viewer);
    /// Somebody who asks over HTTP comes and goes, without lines.
    void enter(ViewerId viewer, const AuditIdentity& who);
    void leave(ViewerId viewer);

    /// Somebody is not let in, or may not do what it asks for.
    void refuse(const AuditIdentity& who, std::string_view what, std::string_view reason);
    void refuse(ViewerId viewer, std::string_view what, std::string_view reason);
    /// A viewer asks for something that is no change of the scene, "addPin"; or somebody over HTTP.
    void request(ViewerId viewer, std::string_view what);
    void request(const AuditIdentity& who, std::string_view what);
    /// A file goes to somebody, or comes from it.
    void transfer(const AuditIdentity& who, bool upload, std::string_view path);
    /// A change of the scene has been recorded.
    void change(const v1::SceneChanged& change, std::uint32_t epoch);

  private:
    using Value = std::variant<std::string, std::int64_t>;
    using Fields = std::vector<std::pair<std::string, Value>>;

    void write(std::string_view event, ViewerId viewer, const AuditIdentity& who,
               const Fields& fields);
    [[nodiscard]] AuditIdentity identity(ViewerId viewer) const;
    /// Nothing: too many.
    std::optional<std::int64_t> count_refusal();
    void note_refusal(ViewerId viewer, const AuditIdentity& who, std::string_view what,
                      std::string_view reason);

    AuditFile file_;
    mutable std::mutex mutex_;
    std::map<ViewerId, AuditIdentity> identities_;
    std::deque<ViewerId> left_;  ///< of identities_, the oldest first
    TokenBucket refusals_{max_refusals_per_second, max_refusals_per_second};
    std::int64_t unsaid_ = 0;  ///< refusals since the last line of one
};

/// Whether a message is worth a line by itself: it changes what is kept or fetches it, and is no
/// change of the scene, which gets a line when it is recorded.
bool is_audited(const v1::ClientMessage& message);

}  // namespace raybundle
