// SPDX-License-Identifier: Apache-2.0
// Names of files that other systems write.
#include <gtest/gtest.h>

#include <filesystem>

#include "case_files.h"
#include "gltf_builder.h"
#include "scene/file_name_key.h"
#include "scene/gltf/file/gltf_confinement.h"
#include "scene/gltf/file/gltf_uri.h"

namespace raybundle::test {
namespace {

namespace fs = std::filesystem;

TEST(CasesFileNames, BackslashesSeparateFolders) {
    const std::string path = case_path("file_names/backslash/scene.gltf");
    const Scene scene = load_gltf(path);
    EXPECT_EQ(scene.textures.size(), 1U);
    EXPECT_TRUE(has_notice(scene,
                           "images[0].uri: there is no file \"textures\\wood.png\": "
                           "\"textures/wood.png\" is read"));
    EXPECT_NO_THROW(check_confined(path));
}

TEST(CasesFileNames, DecomposedLettersAreThoseOfTheFile) {
    const Scene scene = load_gltf(case_path("file_names/umlaut_decomposed/scene.gltf"));
    EXPECT_EQ(scene.textures.size(), 1U);
    EXPECT_TRUE(has_notice(scene, "\"Fl\xC3\xBCr.png\" is read"));
}

TEST(CasesFileNames, NamesAreEqualInCaseAndNormalForm) {
    const auto same = [](const char* a, const char* b) {
        return file_name_key(a) == file_name_key(b);
    };
    EXPECT_TRUE(same("Wood.PNG", "wood.png"));
    EXPECT_TRUE(same("\u00DCber", "u\u0308ber"));
    EXPECT_TRUE(same("Vi\u1EC7t", "VIE\u0323\u0302T"));
    EXPECT_TRUE(same("\u0412\u0418\u0414", "\u0432\u0438\u0434"));
    EXPECT_TRUE(same("\u0391\u0399", "\u03B1\u03B9"));
    EXPECT_TRUE(same("\u0141\u00D8\u00C6", "\u0142\u00F8\u00E6"));
    EXPECT_TRUE(same("\u304C\u30D1", "\u304B\u3099\u30CF\u309A"));
    EXPECT_TRUE(same("\uD55C\uAE00", "\u1112\u1161\u11AB\u1100\u1173\u11AF"));
    EXPECT_FALSE(same("wood", "w\u00F6od"));
    EXPECT_FALSE(same("a\xFF", "a\xFE"));
    EXPECT_FALSE(same("\xC3", "\u00C3"));
    EXPECT_TRUE(same("\U0001F600.png", "\U0001F600.PNG"));
}

/// What a scene in `folder` finds under a name, relative to the folder; the name itself if nothing.
std::string found(const TemporaryFolder& folder, const std::string& uri) {
    return fs::path(local_file((folder.path() / "scene.gltf").string(), "", uri))
        .lexically_relative(folder.path())
        .string();
}

TEST(CasesFileNames, OnlyOneFileMayFit) {
    const TemporaryFolder folder;
    folder.write("Maps/Wood.png", "1");
    EXPECT_EQ(found(folder, "maps\\wood.PNG"), "Maps/Wood.png");
    EXPECT_EQ(found(folder, ".\\maps\\..\\Maps\\wood.png"), "Maps/Wood.png");
    EXPECT_EQ(found(folder, "maps%5Cwood.png"), "Maps/Wood.png");
    folder.write("maps/brick.png", "2");
    EXPECT_EQ(found(folder, "maps/wood.png"), "Maps/Wood.png");  // in the other folder
    folder.write("maps/WOOD.png", "3");
    EXPECT_EQ(found(folder, "maps/wood.png"), "maps/wood.png");  // which is not there
    EXPECT_EQ(found(folder, "maps/WOOD.png"), "maps/WOOD.png");
    EXPECT_FALSE(other_spelling((folder.path() / "scene.gltf").string(), "", "maps/WOOD.png"));
    // A folder is no file.
    folder.write("Folder.png/x", "4");
    EXPECT_EQ(found(folder, "folder.png"), "folder.png");
}

TEST(CasesFileNames, ASceneInTheWorkingFolderFindsThem) {
    const TemporaryFolder folder;
    folder.write("Maps/Wood.png", "1");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    EXPECT_EQ(local_file("scene.gltf", "", "maps\\wood.png"), "Maps/Wood.png");
    EXPECT_EQ(local_file("./scene.gltf", "", "maps/wood.png"), "./Maps/Wood.png");
    fs::current_path(before);
}

TEST(CasesFileNames, NothingOutsideOfTheFolderFits) {
    const TemporaryFolder folder;
    folder.write("Secret.png", "1");
    folder.write("scenes/a.png", "2");
    const std::string scene = (folder.path() / "scenes" / "scene.gltf").string();
    const auto exists = [&](const std::string& uri) {
        std::error_code error;
        return fs::is_regular_file(local_file(scene, "", uri), error);
    };
    EXPECT_TRUE(exists("A.png"));
    EXPECT_FALSE(exists("..\\Secret.png"));
    EXPECT_FALSE(exists("../secret.png"));
    EXPECT_FALSE(exists("x/../../secret.png"));
    fs::create_directory_symlink(folder.path(), folder.path() / "scenes" / "link");
    EXPECT_FALSE(exists("Link\\Secret.png"));
    EXPECT_THROW((void)local_file(scene, "", "C:\\Secret.png"), SceneError);
}

/// The image of the surroundings is confined like all others.
TEST(CasesFileNames, SurroundingsAreConfinedToo) {
    const TemporaryFolder folder;
    GltfBuilder builder = one_triangle();
    builder.json["scenes"][0]["extras"]["raybundle"]["daylight"] = {{"environment", "../x.hdr"}};
    folder.write("x.hdr", "#?RADIANCE\n");
    EXPECT_THROW(check_confined(folder.write("inner/scene.gltf", builder.text())), SceneError);
}

}  // namespace
}  // namespace raybundle::test
