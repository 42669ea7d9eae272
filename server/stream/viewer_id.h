// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace raybundle {

using ViewerId = std::uint32_t;  ///< >= 1, never given twice by one server

}  // namespace raybundle
