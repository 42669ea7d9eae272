// SPDX-License-Identifier: Apache-2.0
// Where journals are that nobody has named.
#include "journal/state_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../daemon/test_folder.h"
#include "journal/file_lock.h"
#include "journal/session_journal.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// An environment variable while a test runs.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = getenv(name)) {
            before_ = before;
        }
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { before_.empty() ? unsetenv(name_) : setenv(name_, before_.c_str(), 1); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::string before_;
};

TEST(StateFolder, IsTheOneOfTheEnvironmentAndOnlyForItsUser) {
    const TestFolder home;
    const Variable at_home("HOME", home.path());
    {
        const Variable state("XDG_STATE_HOME", home.path("state"));
        EXPECT_EQ(StateFolder::of_user().journal_for("d"), home.path("state/raybundle/d.db"));
        EXPECT_EQ(fs::status(home.path("state/raybundle")).permissions(), fs::perms::owner_all);
    }
    const Variable relative("XDG_STATE_HOME", "state");
    EXPECT_EQ(StateFolder::of_user().journal_for("d"), home.path(".local/state/raybundle/d.db"));
}

TEST(StateFolder, GivesEachServerOfASceneAJournalOfItsOwn) {
    const TestFolder folder;
    const StateFolder state(folder.path());
    const std::string first = state.journal_for("d");
    {
        const FileLock used(first);
        EXPECT_EQ(state.journal_for("d"), folder.path("d-2.db"));
        EXPECT_EQ(state.journal_for("e"), folder.path("e.db"));
    }
    EXPECT_EQ(state.journal_for("d"), first);
}

TEST(StateFolder, SaysWhatIsWrongWithIt) {
    const TestFolder folder;
    folder.write("file", "");
    EXPECT_THROW(StateFolder(folder.path("file")).journal_for("d"), JournalError);
    const Variable home("HOME", "");
    const Variable state("XDG_STATE_HOME", "");
    EXPECT_THROW(StateFolder::of_user(), JournalError);
}

TEST(StateFolder, KnowsWhichSceneWasOpenHoweverItsFileIsNamed) {
    const TestFolder folder;
    const StateFolder state(folder.path());
    EXPECT_EQ(state.remembered_scene(folder.path("a.glb")), "");
    state.remember_scene(folder.path("a.glb"), "b.glb");
    state.remember_scene(folder.path("c.glb"), "d.glb");
    EXPECT_EQ(state.remembered_scene(folder.path("./a.glb")), "b.glb");
    state.remember_scene(folder.path("a.glb"), "c.glb");
    EXPECT_EQ(state.remembered_scene(folder.path("a.glb")), "c.glb");
}

}  // namespace
}  // namespace raybundle
