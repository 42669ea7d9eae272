// SPDX-License-Identifier: Apache-2.0
#include "gpu/binding_counts.h"

#include <gtest/gtest.h>

#include <string>

#include "gpu/egl_context.h"
#include "gpu/layouts.h"

namespace raybundle::binding_counts_test {
namespace {

std::string message_for(const BindingCounts& needed, const BindingCounts& driver) {
    try {
        check_bindings(needed, driver);
    } catch (const GpuError& error) {
        return error.what();
    }
    return "";
}

TEST(BindingCounts, AreThoseOfTheShaders) {
    const BindingCounts needed = bindings_needed();
    EXPECT_GT(needed.storage, unsigned{BINDING_CROWDED});
    EXPECT_LT(needed.storage, 100U);
    EXPECT_GT(needed.textures, unsigned{UNIT_PIXEL_AIR});
    EXPECT_LT(needed.textures, 100U);
    EXPECT_GT(needed.uniforms, unsigned{BINDING_VIEW});
    EXPECT_LT(needed.uniforms, needed.storage);
}

TEST(BindingCounts, ADriverThatLacksOneIsRefusedInWords) {
    EXPECT_EQ(message_for({64, 2, 34}, {64, 2, 34}), "");
    EXPECT_EQ(message_for({64, 2, 34}, {63, 2, 34}),
              "Raybundle needs 64 bindings of storage buffers, and the driver has 63 "
              "(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS). Use another driver or device: "
              "--list-gpus, --gpu");
    EXPECT_NE(message_for({64, 2, 34}, {64, 1, 34}).find("needs 2 bindings of uniform"),
              std::string::npos);
    EXPECT_NE(message_for({64, 2, 34}, {64, 2, 33}).find("needs 34 texture units"),
              std::string::npos);
}

TEST(BindingCounts, TheDriverOfTheseTestsHasEnough) {
    EXPECT_EQ(message_for(bindings_needed(), bindings_of_driver()), "");
}

}  // namespace
}  // namespace raybundle::binding_counts_test
