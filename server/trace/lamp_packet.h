// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trace/lamp_rays.h"
#include "trace/trace_query.h"

namespace raybundle {

/// Which of a point's lamps reach it, bit by slot. The query is that of the question's rules.
std::uint32_t lamps_that_reach(const LampPoint& point, const Query& query,
                               const LampQuestion& question);

}  // namespace raybundle
