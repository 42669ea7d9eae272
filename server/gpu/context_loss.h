// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// Throws GpuError where the driver has reset the current context: nothing in it can be used any
/// more, and another context may or may not be had.
void check_context();

}  // namespace raybundle
