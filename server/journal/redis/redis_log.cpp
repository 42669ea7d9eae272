// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/redis_log.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "journal/redis/redis_setup.h"

namespace raybundle {
namespace {

constexpr int block_ms = 200;  ///< of XREAD: how long the end of a server waits for it
constexpr const char* page_entries = "1000";

constexpr const char* lost_changes =
    "the log in Redis lacks changes that are shown here: restart this server";

}  // namespace

RedisLog::RedisLog(const RedisLogSettings& settings) : settings_(settings), worker_(random_name()) {
    const std::string prefix = "raybundle:{" + settings.project + "}:";
    stream_ = prefix + "log";
    scene_key_ = prefix + "scene";
    snapshot_key_ = prefix + "snapshot";
    numbers_key_ = prefix + "numbers";
    try {
        writer_ = std::make_unique<RedisConnection>(settings.address, settings.timeout_ms);
        check_project(*writer_);
        check_durability(*writer_);
        load(*writer_);
    } catch (const RedisAway& away) {
        writer_.reset();
        outage_ = away.what();
    } catch (const RedisRefusal& refusal) {
        throw JournalError(refusal.what());
    }
    if (outage_) {
        spdlog::error("changes cannot be stored until it is back: {}", *outage_);
    }
    cursor_ = state_.last();
    epoch_ = static_cast<std::uint32_t>(cursor_.epoch);
    peers_ = std::make_unique<PeerChannel>(settings.address, prefix, worker_);
    follower_ = std::thread([this] { follow(); });
}

RedisLog::~RedisLog() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    woken_.notify_all();
    follower_.join();
}

/// Throws JournalError where the project is about another scene.
void RedisLog::check_project(RedisConnection& connection) const {
    connection.command({"SET", scene_key_, settings_.scene_digest, "NX"});
    const RedisReply digest = connection.command({"GET", scene_key_});
    if (digest.text != settings_.scene_digest) {
        throw JournalError("project '" + settings_.project + "' in Redis at " +
                           settings_.address.text() + " has another scene file, that of SHA-256 " +
                           digest.text);
    }
}

void RedisLog::load(RedisConnection& connection) {
    const RedisReply snapshot = connection.command({"GET", snapshot_key_});
    if (!snapshot.text.empty() && !state_.from_snapshot(snapshot.text)) {
        throw JournalError(snapshot_key_ + " in Redis cannot be read");
    }
    std::string begin = "-";
    for (;;) {
        const auto page = parse_entries(
            connection.command({"XRANGE", stream_, begin, "+", "COUNT", page_entries}));
        if (page.empty()) {
            break;
        }
        begin = "(" + page.back().id.text();
        for (const StreamEntry& entry : page) {
            state_.apply(entry);
            if (!entry.is_change) {
                for (const RequestKey& key : entry.entry.keys) {
                    keyed_notes_.push_back({key.text, entry.entry.kind, entry.entry.number});
                }
                continue;
            }
            const bool known = entry.before.change_case() != v1::SceneChanged::CHANGE_NOT_SET;
            if (!known) {
                past_.clear();  // nobody can go back beyond it
            } else {
                past_.push_back(entry.before);
                past_.back().set_epoch(entry.entry.change.epoch());
            }
            if (!entry.entry.keys.empty()) {
                keyed_.push_back({entry.entry.change, entry.before, entry.entry.keys});
            }
        }
    }
    const auto shorten = [](auto& list, std::size_t most) {
        if (list.size() > most) {
            list.erase(list.begin(), list.end() - static_cast<std::ptrdiff_t>(most));
        }
    };
    shorten(past_, settings_.most_past);
    shorten(keyed_, keyed_changes);
    shorten(keyed_notes_, keyed_changes);
}

/// Why the log in Redis does not go on where this server is: it was emptied, or its beginning is
/// forgotten.
std::optional<std::string> RedisLog::gap(RedisConnection& connection) const {
    const auto last =
        parse_entries(connection.command({"XREVRANGE", stream_, "+", "-", "COUNT", "1"}));
    const auto first =
        parse_entries(connection.command({"XRANGE", stream_, "-", "+", "COUNT", "1"}));
    const std::lock_guard lock(mutex_);
    if ((last.empty() ? StreamId() : last[0].id) < cursor_) {
        return lost_changes;
    }
    if (!first.empty() && first[0].id.epoch > cursor_.epoch + 1) {
        return "the log in Redis does not know any more what came after change " +
               std::to_string(cursor_.epoch) + ": restart this server";
    }
    return std::nullopt;
}

void RedisLog::follow() {
    do {
        try {
            RedisConnection connection(settings_.address, settings_.timeout_ms);
            check_project(connection);
            if (auto reason = gap(connection)) {
                set_outage(std::move(reason));
                continue;
            }
            set_outage(std::nullopt);
            follow_by(connection);
        } catch (const std::runtime_error& error) {
            set_outage(error.what());
        }
    } while (!rest());
}

void RedisLog::follow_by(RedisConnection& connection) {
    for (;;) {
        std::string from;
        {
            const std::lock_guard lock(mutex_);
            if (stop_) {
                return;
            }
            from = cursor_.text();
        }
        take_in(
            entries_read(connection.command({"XREAD", "COUNT", page_entries, "BLOCK",
                                             std::to_string(block_ms), "STREAMS", stream_, from})));
    }
}

/// Waits a little before the next attempt. True: the server ends.
bool RedisLog::rest() {
    std::unique_lock lock(mutex_);
    return woken_.wait_for(lock, std::chrono::milliseconds(settings_.retry_ms),
                           [this] { return stop_; });
}

void RedisLog::set_outage(std::optional<std::string> reason) {
    const std::lock_guard lock(mutex_);
    if (reason && !outage_) {
        spdlog::error("changes cannot be stored until it is back: {}", *reason);
    } else if (!reason && outage_) {
        spdlog::info("Redis is back: changes can be stored again");
    }
    outage_ = std::move(reason);
}

std::optional<std::string> RedisLog::outage() const {
    const std::lock_guard lock(mutex_);
    return outage_;
}

/// What has been read by the follower, or before a change that comes second.
void RedisLog::take_in(std::vector<StreamEntry> entries) {
    const std::lock_guard lock(mutex_);
    for (StreamEntry& entry : entries) {
        if (entry.id > cursor_) {
            cursor_ = entry.id;
            received_.push_back(std::move(entry));
        }
    }
}

std::vector<LogEntry> RedisLog::take_entries() {
    std::deque<StreamEntry> received;
    {
        const std::lock_guard lock(mutex_);
        received.swap(received_);
    }
    std::vector<LogEntry> entries;
    for (StreamEntry& entry : received) {
        state_.apply(entry);
        const bool own = entry.worker == worker_;
        const std::pair note{entry.entry.kind, entry.entry.number};
        if (entry.is_change) {
            epoch_ = std::max(epoch_, static_cast<std::uint32_t>(entry.id.epoch));
            if (own && entry.id.epoch % settings_.snapshot_every == 0) {
                keep_snapshot();
            }
        }
        if (own && done_.erase(entry.request) > 0) {
            if (!entry.is_change && entry.entry.body.empty()) {
                dropped_.erase(note);
            }
        } else if (entry.is_change || !dropped_.contains(note)) {
            entries.push_back(std::move(entry.entry));
        }
    }
    return entries;
}

/// So that the log need not be read from its beginning, which is forgotten then.
void RedisLog::keep_snapshot() {
    try {
        writer().command({"SET", snapshot_key_, state_.to_snapshot()});
        const std::uint64_t last = state_.last().epoch;
        if (last > settings_.most_past) {
            writer().command(
                {"XTRIM", stream_, "MINID", StreamId{last - settings_.most_past, 0}.text()});
        }
    } catch (const std::runtime_error& error) {
        writer_.reset();
        spdlog::warn("the log of the project is not shortened: {}", error.what());
    }
}

RedisConnection& RedisLog::writer() {
    if (!writer_) {
        writer_ = std::make_unique<RedisConnection>(settings_.address, settings_.timeout_ms);
    }
    return *writer_;
}

/// Waits until so many replicas as wanted have all that the writer has added. Throws JournalError
/// where they have it not in time: it is in the log, comes back by take_entries(), and is to be
/// refused all the same.
void RedisLog::await_replicas() {
    if (settings_.replicas == 0) {
        return;
    }
    const RedisReply reply = writer().command(
        {"WAIT", std::to_string(settings_.replicas), std::to_string(settings_.timeout_ms / 2)});
    if (reply.number < std::int64_t{settings_.replicas}) {
        throw JournalError("of Redis at " + settings_.address.text() + " " +
                           std::to_string(reply.number) + " replicas answer, and " +
                           std::to_string(settings_.replicas) + " are to have each change");
    }
}

/// An entry was written by a connection that is gone. WAIT asks for what its own connection has
/// written: something that comes behind the entry and changes nothing.
void RedisLog::note_write() {
    if (settings_.replicas > 0) {
        writer().command({"HINCRBY", numbers_key_, "0", "0"});
    }
}

void RedisLog::read_now() {
    std::string from;
    {
        const std::lock_guard lock(mutex_);
        from = cursor_.text();
    }
    take_in(
        entries_read(writer().command({"XREAD", "COUNT", page_entries, "STREAMS", stream_, from})));
}

/// Adds a change under its epoch. `again`: an earlier attempt may have arrived, although its answer
/// has not.
Appended RedisLog::add(const StreamEntry& entry, bool again) {
    const std::string id = entry.id.text();
    if (again) {
        const auto there = parse_entries(writer().command({"XRANGE", stream_, id, id}));
        if (!there.empty() && there[0].worker == worker_ && there[0].request == entry.request) {
            note_write();
            return Appended::yes;
        }
    }
    std::vector<std::string> words{"XADD", stream_};
    if (entry.id.epoch > 1) {
        words.emplace_back("NOMKSTREAM");
    }
    words.push_back(id);
    const std::vector<std::string> fields = words_of(entry);
    words.insert(words.end(), fields.begin(), fields.end());
    try {
        if (writer().command(words).kind == RedisReply::Kind::nothing) {
            throw JournalError(lost_changes);
        }
        return Appended::yes;
    } catch (const RedisRefusal& refusal) {
        if (!is_conflict(refusal)) {
            throw;
        }
        read_now();
        return Appended::conflict;
    }
}

/// Adds an entry, a second time where the connection has broken meanwhile, and has the replicas
/// take it.
Appended RedisLog::write(std::uint64_t request, const std::function<Appended(bool again)>& add) {
    for (const bool again : {false, true}) {
        try {
            await_replicas();  // if they are away, nothing is written
            const Appended result = add(again);
            if (result == Appended::yes) {
                await_replicas();
                done_.insert(request);
            }
            return result;
        } catch (const RedisAway& away) {
            writer_.reset();
            if (again) {
                throw JournalError(away.what());
            }
        } catch (const RedisRefusal& refusal) {
            throw JournalError(refusal.what());
        }
    }
    throw JournalError("not reached");
}

Appended RedisLog::append(const v1::SceneChanged& change, const v1::SceneChanged& before,
                          const std::vector<RequestKey>& keys, const std::string& traceparent) {
    if (const auto reason = outage()) {
        throw JournalError(*reason);
    }
    StreamEntry entry;
    entry.id = {change.epoch(), 0};
    entry.worker = worker_;
    entry.request = ++requests_;
    entry.is_change = true;
    entry.entry.change = change;
    entry.entry.keys = keys;
    entry.entry.traceparent = traceparent;
    entry.before = before;
    const Appended result = write(entry.request, [&](bool again) { return add(entry, again); });
    if (result == Appended::yes) {
        epoch_ = change.epoch();
    }
    return result;
}

}  // namespace raybundle
