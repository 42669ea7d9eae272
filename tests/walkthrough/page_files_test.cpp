// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/page_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace raybundle {
namespace {

TEST(WalkthroughPage, HasItsModulesAndNothingOfTheServers) {
    std::set<std::string> names;
    for (const EmbeddedFile& file : walkthrough_page(client_files())) {
        EXPECT_TRUE(names.insert(std::string(file.name)).second) << file.name;
    }
    for (const char* name :
         {"index.html", "style/style.css", "walkthrough/main.js", "walkthrough/walkthrough.css",
          "camera/camera_control.js", "camera/camera.js", "camera/motion.js", "ui/vector.js"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    EXPECT_TRUE(std::none_of(names.begin(), names.end(), [](const std::string& name) {
        return name.starts_with("net/") || name.starts_with("app/");
    }));
}

TEST(WalkthroughPage, NamesAFileThatIsMissing) {
    const EmbeddedFile files[] = {
        {"walkthrough.html", R"(<script src="walkthrough/main.js">)"},
        {"walkthrough/main.js", "import {\n  a,\n} from '../lost.js';\n"}};
    try {
        walkthrough_page(files);
        FAIL();
    } catch (const std::logic_error& error) {
        EXPECT_EQ(std::string(error.what()), "lost.js: is not among the files of the page");
    }
}

TEST(WalkthroughShaders, AreWholeTexts) {
    const std::vector<ShaderText> texts = walkthrough_shaders(shader_files());
    ASSERT_EQ(texts.size(), 2U);
    EXPECT_NE(texts[0].text.find("vec3 shoulder(vec3 x)"), std::string::npos);
    EXPECT_NE(texts[0].text.find("vec3 srgb_encoded(vec3 c)"), std::string::npos);
    EXPECT_NE(texts[1].text.find("float luminance("), std::string::npos);
    EXPECT_NE(texts[1].text.find("vec3 false_colour("), std::string::npos);
    for (const ShaderText& text : texts) {
        EXPECT_EQ(text.text.find("#include"), std::string::npos) << text.name;
    }
}

}  // namespace
}  // namespace raybundle
