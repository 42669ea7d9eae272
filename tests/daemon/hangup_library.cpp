// SPDX-License-Identifier: Apache-2.0
// Preloaded into a server: a hangup while its libraries are being made ready, before main().
#include <unistd.h>

#include <csignal>

namespace {

struct Hangup {
    Hangup() { static_cast<void>(kill(getpid(), SIGHUP)); }
};

const Hangup hangup;

}  // namespace
