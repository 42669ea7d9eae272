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
    /// Notes how the materials reflect before the changes are made. lamps: numbers of those that
    /// may shine otherwise, too.
    void look(const Scene& scene, std::span<const PendingChange> pending,
              std::span<const std::uint32_t> lamps);
    /// Looks at the scene after the changes that have been made. lamps: numbers of those that do.
    void look_again(const Scene& scene, std::span<const PendingChange> made,
                    std::span<const std::uint32_t> lamps);

    /// Indices of materials that emit or reflect otherwise.
    [[nodiscard]] const std::vector<std::uint32_t>& all() const { return all_; }
    /// Those of them that reflect otherwise.
    [[nodiscard]] const std::vector<std::uint32_t>& reflecting() const { return reflecting_; }

  private:
    void take(const Scene& scene, std::uint32_t material, bool lamp);

    std::map<std::uint32_t, SpecularKind> before_;
    std::vector<std::uint32_t> all_;
    std::vector<std::uint32_t> reflecting_;
};

}  // namespace raybundle
