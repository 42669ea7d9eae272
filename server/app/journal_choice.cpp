// SPDX-License-Identifier: Apache-2.0
#include "app/journal_choice.h"

#include <spdlog/spdlog.h>

#include <cstdlib>
#include <utility>

#include "journal/redis/redis_exchange.h"
#include "journal/redis/redis_setup.h"
#include "options/config_file.h"
#include "scene/mix_bits.h"

namespace raybundle {

namespace {

constexpr const char* none = "none";

void warn(const JournalError& error) {
    spdlog::warn("changes and pins are not saved, since a journal cannot be kept: {}",
                 error.what());
}

/// A secret: the environment wins over the configuration file.
std::string of_environment(const char* name, const std::string& otherwise) {
    const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    return value == nullptr ? otherwise : value;
}

std::uint64_t hash_of(const std::string& text) {
    std::uint64_t sum = text.size();
    for (const char c : text) {
        sum = mix_bits(sum ^ static_cast<unsigned char>(c));
    }
    return sum;
}

}  // namespace

JournalChoice::JournalChoice(const Options& options)
    : file_(options.serve.journal == none ? "" : options.serve.journal) {
    if (!options.serve.redis.empty()) {
        const auto [host, port] = parse_address(options.serve.redis);
        redis_.emplace();
        redis_->address = {
            host, port, of_environment("RAYBUNDLE_REDIS_USER", options.serve.redis_user),
            of_environment("RAYBUNDLE_REDIS_PASSWORD", options.serve.redis_password)};
        redis_->project = options.serve.project;
        redis_->replicas = static_cast<std::uint32_t>(options.serve.redis_wait);
        return;
    }
    if (options.serve.journal.empty()) {
        try {
            folder_ = StateFolder::of_user();
        } catch (const JournalError& error) {
            warn(error);
        }
    }
}

std::optional<RedisLogSettings> JournalChoice::redis_for(const std::string& digest) const {
    constexpr std::size_t digits = 16;  // of SHA-256: enough to tell scenes apart
    std::optional<RedisLogSettings> settings = redis_;
    if (settings) {
        settings->scene_digest = digest;
        settings->project = redis_->project.empty() ? digest.substr(0, digits) : redis_->project;
    }
    return settings;
}

std::string JournalChoice::file_for(const std::string& digest) const {
    try {
        return folder_ ? folder_->journal_for(digest) : file_;
    } catch (const JournalError& error) {
        warn(error);
        return {};
    }
}

std::string JournalChoice::remembered_scene(const std::string& started_with) const {
    if (folder_) {
        return folder_->remembered_scene(started_with);
    }
    return file_.empty() ? "" : SessionJournal::remembered_scene(file_, started_with);
}

void JournalChoice::remember_scene(ChangeLog& log, const std::string& started_with,
                                   const std::string& shown) const {
    if (!folder_) {
        log.remember_scene(started_with, shown);
        return;
    }
    try {
        folder_->remember_scene(started_with, shown);
    } catch (const JournalError& error) {
        spdlog::error("after a restart another scene will be shown: {}", error.what());
    }
}

ChangeLog open_change_log(const JournalChoice& journals, const LoadedScene& loaded) {
    if (const auto redis = journals.redis_for(loaded.digest)) {
        return {"project " + redis->project + " of Redis at " + redis->address.text(),
                [settings = *redis] { return std::make_unique<RedisLog>(settings); }};
    }
    JournalSettings settings;
    settings.file = journals.file_for(loaded.digest);
    if (settings.file.empty()) {
        return {};
    }
    settings.scene_name = loaded.scene.name;
    settings.scene_digest = loaded.digest;
    return ChangeLog(settings);
}

WorkerExchange open_exchange(const JournalChoice& journals, const LoadedScene& loaded,
                             const Options& options) {
    const auto redis = journals.redis_for(loaded.digest);
    if (!redis) {
        return {};
    }
    RedisExchangeSettings settings;
    settings.address = redis->address;
    settings.project = redis->project;
    settings.worker = random_name();
    WorkerExchange workers;
    workers.fingerprint =
        hash_of(RAYBUNDLE_VERSION " " + loaded.digest + " " + light_options(options));
    workers.seed = mix_bits(options.scene.seed ^ hash_of(settings.worker));
    workers.exchange = std::make_unique<RedisExchange>(std::move(settings));
    return workers;
}

RenderLoopSettings shared_by(const WorkerExchange& workers, RenderLoopSettings settings) {
    if (workers.exchange) {
        settings.exchange = workers.exchange.get();
        settings.fingerprint = workers.fingerprint;
        settings.solver.seed = workers.seed;
    }
    return settings;
}

std::string where_saved(const ChangeLog& log) {
    switch (log.saving()) {
        case v1::SAVED:
            return "changes and pins are saved in " + log.place();
        case v1::FAILING:
            return "changes and pins cannot be saved in " + log.place();
        default:
            return "changes and pins are not saved: a restart loses them";
    }
}

}  // namespace raybundle
