// SPDX-License-Identifier: Apache-2.0
#include "view/specular/specular_groups.h"

#include <cstdint>
#include <span>

namespace raybundle {

namespace {

std::size_t group_count(std::size_t pixels) {
    return (pixels + SPECULAR_GROUP - 1) / SPECULAR_GROUP;
}

}  // namespace

SpecularGroups::SpecularGroups(std::size_t pixels)
    : list_("specular groups", (4 + group_count(pixels)) * sizeof(std::uint32_t)),
      flags_("specular flags", group_count(pixels) * sizeof(std::uint32_t)),
      finish_({"view_specular_groups.comp"}) {
    begin();
}

void SpecularGroups::bind() const {
    list_.bind_storage(BINDING_SPECULAR_GROUPS);
    flags_.bind_storage(BINDING_SPECULAR_FLAGS);
}

void SpecularGroups::begin() const {
    list_.clear();
    flags_.clear();
}

void SpecularGroups::end() const {
    finish_.dispatch(1);
}

std::uint32_t SpecularGroups::count() const {
    std::uint32_t count = 0;
    list_.read(std::span(&count, 1), 3 * sizeof(count));
    return count;
}

void SpecularGroups::dispatch(const ShaderProgram& program) const {
    program.dispatch_indirect(list_);
}

}  // namespace raybundle
