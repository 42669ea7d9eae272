// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "../daemon/test_folder.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

class PhotometryFolder : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(root / "photometry"); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(root / "photometry" / name) << text;
    }
    static std::string reason_of(const SceneFolder& folder, const std::string& name) {
        try {
            static_cast<void>(folder.photometry(name));
            return "";
        } catch (const SceneError& error) {
            return error.reason();
        }
    }

    const TestFolder folder_;
    const fs::path root = folder_.path();
};

TEST_F(PhotometryFolder, AFileThatIsNoneIsReadOnceUntilItIsAnother) {
    write("a.ies", "not photometric");
    const SceneFolder folder(root);
    EXPECT_EQ(folder.unread_bytes("a.ies"), 15U);
    const std::string reason = reason_of(folder, "a.ies");
    EXPECT_FALSE(reason.empty());
    EXPECT_EQ(folder.unread_bytes("a.ies"), 0U);
    EXPECT_EQ(reason_of(folder, "a.ies"), reason) << "as when it was read";
    write("a.ies", "not photometric either");
    EXPECT_EQ(folder.unread_bytes("a.ies"), 22U);
}

}  // namespace
}  // namespace raybundle
