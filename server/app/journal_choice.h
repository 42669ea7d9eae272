// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/load_scene.h"
#include "journal/redis/redis_log.h"
#include "journal/solution_exchange.h"
#include "journal/state_folder.h"
#include "options/cli_options.h"
#include "session/changes/change_log.h"
#include "session/render_loop_settings.h"

namespace raybundle {

/// Where `serve` keeps changes, pins and viewpoints: in the Redis of --redis, in the file of
/// --journal, nowhere with
/// `--journal none`, else in a file of the user's folder for each scene. Where that folder cannot
/// be used the server works without; the log says why.
class JournalChoice {
  public:
    explicit JournalChoice(const Options& options);

    /// The project of a scene file in Redis; nothing where it is not to be used.
    [[nodiscard]] std::optional<RedisLogSettings> redis_for(const std::string& digest) const;
    /// The journal of a scene file; empty: none.
    [[nodiscard]] std::string file_for(const std::string& digest) const;

    /// Name in the library of the scene that was open when a server started with this scene ended;
    /// empty: not known.
    [[nodiscard]] std::string remembered_scene(const std::string& started_with) const;
    /// A failure is logged. `log`: of the scene that is shown now.
    void remember_scene(ChangeLog& log, const std::string& started_with,
                        const std::string& shown) const;

  private:
    std::optional<RedisLogSettings> redis_;
    std::string file_;
    std::optional<StateFolder> folder_;
};

/// The log of a scene's changes, as the choice says.
ChangeLog open_change_log(const JournalChoice& journals, const LoadedScene& loaded);

/// What several workers of a project share of their light.
struct WorkerExchange {
    std::unique_ptr<SolutionExchange> exchange;  ///< null: each server is alone
    std::uint64_t fingerprint = 0;  ///< of scene file, options that light depends on, and version
    std::uint64_t seed = 0;         ///< of this worker alone
};
WorkerExchange open_exchange(const JournalChoice& journals, const LoadedScene& loaded,
                             const Options& options);
/// Settings with such an exchange, which must outlive whoever gets them.
RenderLoopSettings shared_by(const WorkerExchange& workers, RenderLoopSettings settings);

/// One line for whoever runs the server.
std::string where_saved(const ChangeLog& log);

}  // namespace raybundle
