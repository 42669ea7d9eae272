// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trace/gloss_ray.h"
#include "trace/trace_query.h"

namespace raybundle {

/// Follows a ray to the first surface. The query is that of the rules. tie: m, as that of
/// LampQuestion; number: of the ray, for what absorbs by chance.
void follow_gloss_ray(GlossRay& ray, std::uint32_t number, const Query& query, float tie);

}  // namespace raybundle
