// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "journal/redis/redis_connection.h"
#include "journal/solution_exchange.h"

namespace raybundle {

struct RedisExchangeSettings {
    RedisAddress address;
    std::string project;
    std::string worker;     ///< a name that nobody else has: random_name()
    int timeout_ms = 1000;  ///< of a connection and of each answer
    int poll_ms = 500;      ///< from one look at the others to the next, at least
    /// After which an estimate is gone whose worker does not tell any more that it is there.
    int alive_ms = 30000;
};

/// By keys of Redis, of which each worker writes its own alone. Another thread sends and reads; of
/// its time the exchange takes a twentieth at most. While Redis is away what has been merged
/// stays.
class RedisExchange final : public SolutionExchange {
  public:
    explicit RedisExchange(RedisExchangeSettings settings);
    ~RedisExchange() override;

    void begin(const SolutionState& state, float unit) override;
    void publish(PatchMeans own) override;
    [[nodiscard]] std::optional<MergedMeans> collect() override;
    [[nodiscard]] ExchangeFigures figures() const override;

  private:
    /// What the thread works on: estimates of one state.
    struct Round {
        std::uint64_t state_number = 0;  ///< counts begin()
        SolutionState state;
        float unit = 1.0F;
        std::optional<PatchMeans> own;  ///< to be sent
    };
    struct Other {
        std::uint32_t number = 0;  ///< of the estimate that was looked at last
        std::string estimate;      ///< empty: refused
        bool merged = false;
    };

    void run();
    void exchange(RedisConnection& connection);
    Round take_round();
    void send(RedisConnection& connection, const Round& round);
    void read_others(RedisConnection& connection, const Round& round);
    void read_other(RedisConnection& connection, const Round& round, const std::string& worker);
    void refuse(const std::string& worker, const std::string& reason);
    void merge(const Round& round);
    void note_working(const std::string& problem);
    [[nodiscard]] std::string key_of(std::uint32_t epoch, const std::string& worker) const;
    std::string counted(std::string bytes);

    RedisExchangeSettings settings_;
    std::string prefix_;
    // Of the thread alone.
    std::uint64_t working_on_ = 0;  // Round::state_number
    std::string own_;               // estimate, in case Redis forgets it; empty: none yet
    std::uint32_t own_number_ = 0;
    bool stored_ = false;                         // it is in Redis, as far as is known
    std::map<std::string, Other> others_;         // in the order in which they are summed
    std::map<std::string, std::string> refused_;  // reasons that have been told, by worker

    mutable std::mutex mutex_;
    std::condition_variable woken_;
    bool stop_ = false;
    Round next_;
    std::optional<MergedMeans> merged_;  // to be collected
    ExchangeFigures figures_;
    std::thread thread_;
};

}  // namespace raybundle
