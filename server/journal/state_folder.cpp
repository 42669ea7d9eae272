// SPDX-License-Identifier: Apache-2.0
#include "journal/state_folder.h"

#include <cstdlib>
#include <string_view>
#include <system_error>

#include "journal/file_lock.h"
#include "journal/session_journal.h"

namespace raybundle {

namespace {

namespace fs = std::filesystem;

constexpr int most_servers = 16;

/// An environment variable that names a folder; relative ones do not count (XDG base directories).
fs::path folder_in_environment(const char* name) {
    const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    const fs::path path = text == nullptr ? "" : text;
    return path.is_absolute() ? path : fs::path();
}

/// The same scene has the same name, wherever the server is started.
std::string absolute(const std::string& file) {
    std::error_code unknown;
    const fs::path path = fs::weakly_canonical(file, unknown);
    return unknown ? file : path.string();
}

}  // namespace

StateFolder StateFolder::of_user() {
    if (const fs::path state = folder_in_environment("XDG_STATE_HOME"); !state.empty()) {
        return StateFolder(state / "raybundle");
    }
    if (const fs::path home = folder_in_environment("HOME"); !home.empty()) {
        return StateFolder(home / ".local" / "state" / "raybundle");
    }
    throw JournalError("neither XDG_STATE_HOME nor HOME names a folder");
}

StateFolder::StateFolder(fs::path folder) : folder_(std::move(folder)) {
    std::error_code problem;
    const bool made = fs::create_directories(folder_, problem);
    if (made && !problem) {
        fs::permissions(folder_, fs::perms::owner_all, problem);
    }
    if (problem) {
        throw JournalError(folder_.string() + ": " + problem.message());
    }
}

std::string StateFolder::journal_for(const std::string& digest) const {
    for (int server = 1; server <= most_servers; ++server) {
        const std::string number = server == 1 ? "" : "-" + std::to_string(server);
        const std::string file = folder_ / (digest + number + ".db");
        try {
            const FileLock free(file);
            return file;
        } catch (const std::system_error& error) {
            if (error.code() != std::errc::resource_unavailable_try_again) {
                throw JournalError(file + "-lock: " + error.code().message());
            }
        }
    }
    throw JournalError(folder_.string() + ": " + std::to_string(most_servers) +
                       " servers use journals of this scene");
}

void StateFolder::remember_scene(const std::string& started_with, const std::string& shown) const {
    SessionJournal::remember_scene(memory(), absolute(started_with), shown);
}

std::string StateFolder::remembered_scene(const std::string& started_with) const {
    return SessionJournal::remembered_scene(memory(), absolute(started_with));
}

}  // namespace raybundle
