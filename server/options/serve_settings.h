// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/server_settings.h"
#include "options/cli_options.h"

namespace raybundle {

/// What the network layer needs of the options. Throws UsageError where they do not fit together,
/// above all where they would let strangers in: an address beyond this machine needs tokens or
/// --allow-remote.
ServerSettings server_settings(const Options& options);

/// Null where the options name no file. Throws UsageError.
std::shared_ptr<AuditLog> open_audit_log(const Options& options);

}  // namespace raybundle
