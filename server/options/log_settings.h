// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options/cli_options.h"

namespace raybundle {

/// Level and format of the log, on stderr. As JSON each line is an object with time (ISO 8601,
/// UTC), level and message.
void set_log(const Options& options);

/// The level alone.
void set_log_level(const Options& options);

}  // namespace raybundle
