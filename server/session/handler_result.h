// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// What is left to do for a request when its handler returns.
enum class HandlerResult {
    ok,        ///< it is to be answered with `ok`
    answered,  ///< nothing: the handler has answered it, or will
};

}  // namespace raybundle
