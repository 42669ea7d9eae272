// SPDX-License-Identifier: Apache-2.0
#include "trace/bundle_builder.h"

#include <atomic>

namespace raybundle {

namespace {
std::atomic<BundleBuilder> chosen_builder{BundleBuilder::automatic};
}  // namespace

void set_bundle_builder(BundleBuilder builder) {
    chosen_builder = builder;
}

std::optional<BundleBuilder> bundle_builder_named(std::string_view name) {
    if (name == "auto") {
        return BundleBuilder::automatic;
    }
    if (name == "raster") {
        return BundleBuilder::raster;
    }
    return name == "trace" ? std::optional(BundleBuilder::trace) : std::nullopt;
}

BundleBuilder bundle_builder() {
    return chosen_builder;
}

}  // namespace raybundle
