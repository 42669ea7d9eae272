// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/command.h"

namespace raybundle {

/// `accuracy --early`: the error of a viewer's first pictures over iterations, since nothing and
/// since a turn of the camera, against a path-traced reference. Iterations are counted, not
/// seconds: the figures are the same on any machine. Writes early.json, early.svg and the pictures.
int run_accuracy_early(const Options& options);

}  // namespace raybundle
