// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "raybundle.pb.h"

namespace raybundle {

/// What a change is about: its kind (SceneChanged::ChangeCase) and the number of the object, light
/// or material.
using ChangeSubject = std::pair<int, std::uint32_t>;
ChangeSubject subject_of(const v1::SceneChanged& change);

/// Whether a change sets how bright a light is, or its colour: what fades.
bool sets_light(const v1::SetLight& set);

/// Adds a change to an earlier one of the same subject, or to an empty message: a place replaces
/// the one before it, of lights and materials what is absent stays. Epoch and viewer are the newer
/// ones.
void add_change(const v1::SceneChanged& change, v1::SceneChanged& sum);

}  // namespace raybundle
