// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <optional>

#include "gpu/egl_context.h"
#include "trace/bundle_builder.h"

namespace {

/// One GL context for all tests of the process; listing tests needs none.
class GlEnvironment : public testing::Environment {
  public:
    void SetUp() override {
        spdlog::set_level(spdlog::level::warn);
        // RAYBUNDLE_BUNDLES=raster or trace runs all tests with that builder of bundles.
        if (const char* const wanted = std::getenv("RAYBUNDLE_BUNDLES"); wanted != nullptr) {
            const auto builder = raybundle::bundle_builder_named(wanted);
            ASSERT_TRUE(builder) << "RAYBUNDLE_BUNDLES=" << wanted;
            raybundle::set_bundle_builder(*builder);
        }
        context_.emplace(raybundle::create_egl_context());
    }
    void TearDown() override { context_.reset(); }

  private:
    std::optional<raybundle::EglContext> context_;
};

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    testing::AddGlobalTestEnvironment(new GlEnvironment);  // gtest owns it
    return RUN_ALL_TESTS();
}
