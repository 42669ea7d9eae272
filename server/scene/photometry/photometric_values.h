// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/photometry/ies_profile.h"
#include "scene/photometry/ies_text.h"

namespace raybundle {

/// The profile of what has been read, negative values that are noise of the measurement as 0, with
/// a note. Fails in `lowest_line`, that of the lowest value, where they are more than noise, and
/// where the luminaire gives no light.
IesProfile checked_profile(const IesReader& reader, IesProfile::Data data, int lowest_line);

}  // namespace raybundle
