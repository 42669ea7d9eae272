// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/redis_exchange.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "journal/solution_estimate.h"

namespace raybundle {
namespace {

constexpr std::size_t most_others = 63;
constexpr int rest_per_work = 19;  // a twentieth of the time is work

/// As random_name() makes them: what else is in the set is nobody's.
bool is_worker_name(const std::string& text) {
    constexpr std::size_t digits = 16;
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

RedisExchange::RedisExchange(RedisExchangeSettings settings)
    : settings_(std::move(settings)),
      prefix_("raybundle:{" + settings_.project + "}:"),
      thread_([this] { run(); }) {}

RedisExchange::~RedisExchange() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void RedisExchange::begin(const SolutionState& state, float unit) {
    const std::lock_guard lock(mutex_);
    next_ = {next_.state_number + 1, state, unit, std::nullopt};
    merged_.reset();
    figures_.workers = 0;
}

void RedisExchange::publish(PatchMeans own) {
    const std::lock_guard lock(mutex_);
    next_.own = std::move(own);
}

std::optional<MergedMeans> RedisExchange::collect() {
    const std::lock_guard lock(mutex_);
    return std::exchange(merged_, std::nullopt);
}

ExchangeFigures RedisExchange::figures() const {
    const std::lock_guard lock(mutex_);
    return figures_;
}

std::string RedisExchange::key_of(std::uint32_t epoch, const std::string& worker) const {
    return prefix_ + "solution:" + std::to_string(epoch) + ":" + worker;
}

void RedisExchange::run() {
    std::unique_ptr<RedisConnection> connection;
    std::unique_lock lock(mutex_);
    while (!stop_) {
        lock.unlock();
        using Clock = std::chrono::steady_clock;
        const Clock::time_point begun = Clock::now();
        Clock::duration rest = std::chrono::milliseconds(settings_.poll_ms);
        try {
            if (!connection) {
                connection =
                    std::make_unique<RedisConnection>(settings_.address, settings_.timeout_ms);
            }
            exchange(*connection);
            note_working({});
            // An estimate is told to be there three times before it is taken to be gone.
            rest = std::clamp<Clock::duration>(
                rest_per_work * (Clock::now() - begun), rest,
                std::max<Clock::duration>(rest, std::chrono::milliseconds(settings_.alive_ms / 3)));
        } catch (const std::runtime_error& error) {
            connection.reset();
            note_working(error.what());
        }
        lock.lock();
        woken_.wait_for(lock, rest, [this] { return stop_; });
    }
}

void RedisExchange::note_working(const std::string& problem) {
    const std::lock_guard lock(mutex_);
    if (!problem.empty() && figures_.working) {
        spdlog::warn("light is not shared with other workers until it is back: {}", problem);
    } else if (problem.empty() && !figures_.working) {
        spdlog::info("light is shared with other workers again");
    }
    figures_.working = problem.empty();
}

RedisExchange::Round RedisExchange::take_round() {
    const std::lock_guard lock(mutex_);
    std::optional<PatchMeans> own = std::exchange(next_.own, std::nullopt);
    Round round = next_;
    round.own = std::move(own);
    return round;
}

void RedisExchange::exchange(RedisConnection& connection) {
    const Round round = take_round();
    if (round.state_number == 0) {
        return;
    }
    // Redis may go away at any command: what is known here is brought up to date before.
    std::string old;
    if (round.state_number != working_on_) {
        working_on_ = round.state_number;
        old = std::exchange(own_, {});
        others_.clear();
    }
    if (round.own) {
        own_ = encode_estimate({round.state, ++own_number_}, *round.own, round.unit);
        stored_ = false;
    }
    if (const auto head = read_estimate_head(old); head && head->state.epoch != round.state.epoch) {
        connection.command({"PEXPIRE", key_of(head->state.epoch, settings_.worker), "0"});
    }
    if (!own_.empty()) {
        send(connection, round);
    }
    read_others(connection, round);
    merge(round);
}

/// Stores the own estimate, or says that it is still somebody's.
void RedisExchange::send(RedisConnection& connection, const Round& round) {
    const std::string key = key_of(round.state.epoch, settings_.worker);
    const std::string alive = std::to_string(settings_.alive_ms);
    stored_ = stored_ && connection.command({"PEXPIRE", key, alive}).number == 1;
    if (!stored_) {
        connection.command({"SET", key, own_, "PX", alive});
        stored_ = true;
        const std::lock_guard lock(mutex_);
        figures_.bytes_sent += own_.size();
        ++figures_.published;
    }
    connection.command({"SADD", prefix_ + "workers", settings_.worker});
}

void RedisExchange::read_others(RedisConnection& connection, const Round& round) {
    std::set<std::string> present;
    for (const RedisReply& member : connection.command({"SMEMBERS", prefix_ + "workers"}).list) {
        if (is_worker_name(member.text) && member.text != settings_.worker) {
            present.insert(member.text);
        }
    }
    while (present.size() > most_others) {
        refuse(*present.rbegin(), "more than " + std::to_string(most_others) + " others are here");
        present.erase(std::prev(present.end()));
    }
    std::erase_if(others_, [&](const auto& other) { return !present.contains(other.first); });
    for (const std::string& worker : present) {
        read_other(connection, round, worker);
    }
}

std::string RedisExchange::counted(std::string bytes) {
    const std::lock_guard lock(mutex_);
    figures_.bytes_received += bytes.size();
    return bytes;
}

void RedisExchange::read_other(RedisConnection& connection, const Round& round,
                               const std::string& worker) {
    // One byte more than there may be, so that a longer value is not taken for a whole one.
    const auto read = [&](std::size_t bytes) {
        return counted(connection
                           .command({"GETRANGE", key_of(round.state.epoch, worker), "0",
                                     std::to_string(bytes)})
                           .text);
    };
    const std::string begin = read(estimate_head_bytes);
    if (begin.empty()) {  // it has ended, or has nothing of this state yet
        connection.command({"SREM", prefix_ + "workers", worker});
        others_.erase(worker);
        return;
    }
    const std::optional<EstimateHead> head = read_estimate_head(begin);
    const std::uint32_t number = head ? head->number : 0;
    const auto known = others_.find(worker);
    if (known != others_.end() && known->second.number == number) {
        return;
    }
    Other& other = others_[worker];
    other = {number, {}, false};
    std::string problem = problem_of_head(head, round.state);
    if (problem.empty()) {
        other.estimate = read(estimate_bytes(round.state.patches));
        problem = problem_of_estimate(other.estimate, round.state);
    }
    if (!problem.empty()) {
        other.estimate.clear();
        refuse(worker, problem);
        return;
    }
    other.number = read_estimate_head(other.estimate)->number;  // a newer one may have come
    refused_.erase(worker);
    const std::lock_guard lock(mutex_);
    ++figures_.received;
}

/// Says why once.
void RedisExchange::refuse(const std::string& worker, const std::string& reason) {
    constexpr std::size_t most_told = 1024;
    if (refused_.size() > most_told) {
        refused_.clear();
    }
    std::string& told = refused_[worker];
    if (told != reason) {
        told = reason;
        spdlog::warn("the light of worker {} is not merged: {}", worker, reason);
        const std::lock_guard lock(mutex_);
        ++figures_.refused;
    }
}

/// Where the others have something else than what was added up last.
void RedisExchange::merge(const Round& round) {
    unsigned workers = 0;
    bool fresh = false;
    for (const auto& [worker, other] : others_) {
        workers += other.estimate.empty() ? 0 : 1;
        fresh |= !other.estimate.empty() && !other.merged;
    }
    if (!fresh && workers == figures().workers) {
        return;
    }
    EstimateSum sum(round.state.patches);
    for (auto& [worker, other] : others_) {
        if (!other.estimate.empty()) {
            sum.add(other.estimate);
            other.merged = true;
        }
    }
    MergedMeans merged = sum.means(round.unit);
    const std::lock_guard lock(mutex_);
    if (round.state_number == next_.state_number) {
        figures_.workers = merged.workers;
        merged_ = std::move(merged);
    }
}

}  // namespace raybundle
