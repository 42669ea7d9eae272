// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "bundle/bundle_frame.h"
#include "gpu/gl_objects.h"
#include "solution/direct/first_shot.h"
#include "view/pixel_lamps.h"
#include "view/pixels/picture_view.h"
#include "view/view_programs.h"

namespace raybundle {

/// What a picture shows against the one before it.
enum class Shows { another_view, moved_objects, same_surfaces };

/// The light of punctual lights at the pixels of a picture. After a change only that light is found
/// anew which the change can reach. The pixels, their picture and the solution are bound for all
/// calls; afterwards they have to be bound anew.
class PixelFirstShot {
  public:
    /// glossy: some pixels may be. many: lamps, see PixelLamps.
    PixelFirstShot(std::size_t pixels, bool glossy, bool many);

    void bind() const;
    /// Of the present lights. moved: boxes that hold the moved objects at either place.
    void shoot(const ViewPrograms& programs, const FirstShot& first_shot,
               const layout::ViewParameters& view, Shows shows, std::span<const Bounds> moved);
    /// A change will reach some of it: what that was is taken back, where the picture stays and
    /// knows it.
    void take_back(const ViewPrograms& programs, const FirstShot& first_shot,
                   const layout::ViewParameters& view, bool stays, FirstShot::Reach reach);
    /// Of many lamps, those whose light pixels have found little by little.
    [[nodiscard]] PixelLamps* lamps() { return lamps_ ? &*lamps_ : nullptr; }
    [[nodiscard]] bool exact() const { return !lamps_ || lamps_->exact(); }
    [[nodiscard]] std::size_t bytes() const { return light_.bytes() + rest_.bytes(); }

  private:
    void add_changes(const ShaderProgram& program, const FirstShot& first_shot,
                     const layout::ViewParameters& view, std::span<const Bounds> moved) const;

    bool glossy_;
    Buffer light_, rest_;  // rest: of shot_pass.glsl, not of many lamps
    Texture2D texture_;
    std::uint64_t version_ = 0;        // of the first shot that the pixels have
    bool taken_back_ = false;          // what a change can reach of it
    std::optional<PixelLamps> lamps_;  // only where they are many
};

}  // namespace raybundle
