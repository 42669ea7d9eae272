// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace raybundle {

/// What keeps a text from being well-formed XML, as far as our own writers use it: tags that match,
/// attributes that are quoted and named once, entities that exist, one root. Empty: nothing.
std::string xml_fault(const std::string& text);

}  // namespace raybundle
