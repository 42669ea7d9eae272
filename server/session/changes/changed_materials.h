// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scene/material/specular_surface.h"
#include "scene/scene.h"
#include "session/changes/change_queue.h"

namespace raybundle {

/// The materials of changed lights and materials, by how much has to be made anew for them.
class ChangedMaterials {
  public:
    /// Notes how the materials reflect before the changes are made.
    ChangedMaterials(const Scene& scene, std::span<const PendingChange> pending);
    /// Looks at the scene after the changes that have been made.
    void look_again(const Scene& scene, std::span<const PendingChange> made);

    /// Indices of materials that emit or reflect otherwise.
    [[nodiscard]] const std::vector<std::uint32_t>& all() const { return all_; }
    /// Those of them that reflect otherwise.
    [[nodiscard]] const std::vector<std::uint32_t>& reflecting() const { return reflecting_; }

  private:
    std::map<std::uint32_t, SpecularKind> before_;
    std::vector<std::uint32_t> all_;
    std::vector<std::uint32_t> reflecting_;
};

}  // namespace raybundle
