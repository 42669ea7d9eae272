// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace raybundle {

/// Journals that nobody has named: one for each scene file, by its digest, in the user's folder of
/// state. Knows also which scene was open last.
class StateFolder {
  public:
    /// $XDG_STATE_HOME/raybundle, or ~/.local/state/raybundle; only the user may look into it.
    /// Throws JournalError where the environment names neither, or it cannot be made.
    static StateFolder of_user();

    /// Makes the folder where it is missing. Throws JournalError.
    explicit StateFolder(std::filesystem::path folder);

    /// The journal of a scene file: DIGEST.db, or DIGEST-2.db and so on while other servers use
    /// those before. Throws JournalError: 16 servers do, or the folder cannot be written.
    [[nodiscard]] std::string journal_for(const std::string& digest) const;

    /// Keeps in mind which scene of the library is shown in place of the one that the server was
    /// started with. Throws JournalError.
    void remember_scene(const std::string& started_with, const std::string& shown) const;
    /// What remember_scene() was told last for that scene; empty: nothing, or it cannot be read.
    [[nodiscard]] std::string remembered_scene(const std::string& started_with) const;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  private:
    [[nodiscard]] std::string memory() const { return folder_ / "open_scenes.db"; }

    std::filesystem::path folder_;
};

}  // namespace raybundle
