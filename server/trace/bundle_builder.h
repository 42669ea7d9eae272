// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace raybundle {

/// What finds the surfaces that bundles and pictures see.
enum class BundleBuilder {
    automatic,  ///< rays where OpenGL runs on the processor and that is cheaper, else the
                ///< rasteriser
    raster,
    trace  ///< rays on the processor, whatever OpenGL runs on
};

/// The builder of all scenes that are made from now on; automatic at first. For the start of a
/// program.
void set_bundle_builder(BundleBuilder builder);
BundleBuilder bundle_builder();
/// Of "auto", "raster" or "trace".
std::optional<BundleBuilder> bundle_builder_named(std::string_view name);

}  // namespace raybundle
