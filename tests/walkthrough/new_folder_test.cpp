// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/new_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "../unit/gltf_builder.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::string reason_against(const fs::path& path, bool replace) {
    try {
        check_new_folder(path.string(), replace);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(NewFolder, AppearsWholeOrNotAtAll) {
    const TemporaryFolder parent;
    const fs::path path = parent.path() / "walk";
    {
        const NewFolder folder(path.string(), false);
        write_bytes(folder.file("a/b.bin"), "1234");
        EXPECT_FALSE(fs::exists(path));
    }
    EXPECT_EQ(entries(parent.path()), 0U);
    NewFolder folder(path.string() + "/", false);
    write_bytes(folder.file("a/b.bin"), "1234");
    folder.keep();
    EXPECT_EQ(fs::file_size(path / "a/b.bin"), 4U);
    EXPECT_EQ(entries(parent.path()), 1U);
}

TEST(NewFolder, KeepsWhatIsThereUnlessTold) {
    const TemporaryFolder parent;
    parent.write("walk/mine.txt", "mine");
    const fs::path path = parent.path() / "walk";
    EXPECT_NE(reason_against(path, false).find("is not empty (--force"), std::string::npos);
    EXPECT_NE(reason_against(path, true).find("something else than a walkthrough"),
              std::string::npos);
    parent.write("walk/scene.json", "{}");
    EXPECT_EQ(reason_against(path, true), "");
    { const NewFolder unfinished(path.string(), true); }
    EXPECT_TRUE(fs::exists(path / "mine.txt"));
    NewFolder folder(path.string(), true);
    write_bytes(folder.file("new.txt"), "new");
    folder.keep();
    EXPECT_FALSE(fs::exists(path / "mine.txt"));
    EXPECT_TRUE(fs::exists(path / "new.txt"));
    EXPECT_EQ(entries(parent.path()), 1U);
}

TEST(NewFolder, ReasonsNameThePath) {
    const TemporaryFolder parent;
    const std::string file = parent.write("file", "x");
    EXPECT_EQ(reason_against(file, true), file + ": cannot be written: it is no folder");
    const fs::path lost = parent.path() / "absent" / "walk";
    EXPECT_EQ(reason_against(lost, false), lost.string() +
                                               ": cannot be written: there is no folder '" +
                                               lost.parent_path().string() + "'");
    for (const char* name : {"", ".", "..", "/"}) {
        EXPECT_NE(reason_against(name, true), "") << name;
    }
    fs::create_directory(parent.path() / "empty");
    EXPECT_EQ(reason_against(parent.path() / "empty", false), "");
}

}  // namespace
}  // namespace raybundle
