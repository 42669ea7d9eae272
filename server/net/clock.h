// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// Steady clock of the protocol: milliseconds since the program started.
double server_time_ms();

}  // namespace raybundle
