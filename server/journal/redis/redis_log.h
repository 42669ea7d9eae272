// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "journal/project_log.h"
#include "journal/redis/log_state.h"
#include "journal/redis/peer_channel.h"
#include "journal/redis/redis_connection.h"

namespace raybundle {

struct RedisLogSettings {
    RedisAddress address;
    std::string project;
    std::string scene_digest;  ///< of the scene file: a project has one scene
    /// Changes after which the log's state is kept whole, and after how many more its beginning is
    /// forgotten; of tests less.
    std::uint32_t snapshot_every = 4096;
    std::uint32_t most_past = 16384;
    /// Of a connection and of each answer, before a change is refused; pictures stand still
    /// meanwhile, as while a journal's file is busy.
    int timeout_ms = 1000;
    int retry_ms = 200;  ///< from an outage to the next look whether it is over
    /// Of Redis, that must have an entry before it is acknowledged; 0: the master alone.
    std::uint32_t replicas = 0;
};

/// The log of a project that several servers share: a stream of Redis. A change's ID is its epoch,
/// and Redis takes growing IDs only, so that adding is compare and set: who comes second has a
/// conflict, reads on and tries again. A change that append() has returned `yes` of is as durable
/// as Redis is set up to be (appendonly yes, appendfsync always), and so many replicas have it as
/// the settings want. Another thread follows the
/// stream. While Redis is away nothing can be appended; what others have added comes once it is
/// back.
class RedisLog final : public ProjectLog {
  public:
    static constexpr std::uint32_t keyed_changes = 16384;

    /// Reads the log as far as Redis answers; else it begins empty and all comes by
    /// take_entries(). Throws JournalError where the project has another scene.
    explicit RedisLog(const RedisLogSettings& settings);
    ~RedisLog() override;

    [[nodiscard]] std::uint32_t epoch() const override { return epoch_; }
    [[nodiscard]] std::vector<v1::SceneChanged> changes() override { return state_.changes(); }
    [[nodiscard]] std::vector<v1::SceneChanged> past() override { return past_; }
    [[nodiscard]] std::vector<KeyedChange> keyed() override { return keyed_; }
    [[nodiscard]] Appended append(const v1::SceneChanged& change, const v1::SceneChanged& before,
                                  const std::vector<RequestKey>& keys,
                                  const std::string& traceparent = {}) override;
    [[nodiscard]] std::vector<LogEntry> take_entries() override;

    [[nodiscard]] std::uint32_t new_number(NoteKind kind, std::uint32_t free) override;
    [[nodiscard]] Appended keep_note(NoteKind kind, std::uint32_t number, const std::string& body,
                                     const std::string& key = {}) override;
    [[nodiscard]] std::vector<KeyedNote> keyed_notes() override { return keyed_notes_; }
    void drop_note(NoteKind kind, std::uint32_t number) override;
    [[nodiscard]] std::vector<std::string> notes(NoteKind kind) override {
        return state_.notes(kind);
    }
    /// Each server shows what it was started with.
    void remember_scene(const std::string& /*started_with*/,
                        const std::string& /*shown*/) override {}

    void publish(const std::string& body, bool lasting) override { peers_->publish(body, lasting); }
    [[nodiscard]] std::vector<PeerNews> take_news() override { return peers_->take(); }

    [[nodiscard]] std::optional<std::string> outage() const override;
    [[nodiscard]] bool shared() const override { return true; }

  private:
    void load(RedisConnection& connection);
    void check_project(RedisConnection& connection) const;
    [[nodiscard]] std::optional<std::string> gap(RedisConnection& connection) const;
    void follow();
    void follow_by(RedisConnection& connection);
    void take_in(std::vector<StreamEntry> entries);
    void set_outage(std::optional<std::string> reason);
    bool rest();
    RedisConnection& writer();
    void read_now();
    [[nodiscard]] Appended add(const StreamEntry& entry, bool again);
    [[nodiscard]] Appended append_note(const StreamEntry& entry);
    [[nodiscard]] Appended write(std::uint64_t request,
                                 const std::function<Appended(bool again)>& add);
    void note_write();
    void await_replicas();
    [[nodiscard]] bool overtaken(const StreamEntry& note) const;
    [[nodiscard]] bool arrived(const StreamEntry& entry) const;
    void keep_snapshot();

    RedisLogSettings settings_;
    std::string stream_, scene_key_, snapshot_key_, numbers_key_;
    std::string worker_;
    std::uint32_t epoch_ = 0;
    std::uint64_t requests_ = 0;
    std::set<std::uint64_t> done_;  ///< own requests that are in the stream and not read yet
    /// Notes that this server has forgotten, which is in the stream and not read yet.
    std::set<std::pair<NoteKind, std::uint32_t>> dropped_;
    LogState state_;
    std::vector<v1::SceneChanged> past_;
    std::vector<KeyedChange> keyed_;
    std::vector<KeyedNote> keyed_notes_;
    std::unique_ptr<RedisConnection> writer_;

    mutable std::mutex mutex_;
    std::condition_variable woken_;
    bool stop_ = false;
    std::deque<StreamEntry> received_;
    StreamId cursor_;
    std::optional<std::string> outage_;
    std::thread follower_;
    std::unique_ptr<PeerChannel> peers_;
};

}  // namespace raybundle
