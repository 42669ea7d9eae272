// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "solution/direct/first_shot.h"
#include "view/view_programs.h"

namespace raybundle {

class ManyLamps;

/// The light of many lamps (ManyLamps) at the pixels of a picture. They begin with what their
/// patches have, and look at the lamps that these have looked at, level by level: after each of
/// them pixels have the exact light of its lamps, and of the others what their patches have. What
/// reaches no patch round a pixel comes last. The pixels, their picture and the solution are bound
/// for all calls; afterwards they have to be bound anew.
class PixelLamps {
  public:
    /// At most so many pixels; glossy: some of them may be.
    PixelLamps(std::size_t pixels, bool glossy);

    /// Of pixels that are new, or whose surroundings have changed.
    void begin(const ViewPrograms& programs, const FirstShot& first_shot, std::size_t pixels);
    /// The same pixels after other lamps have changed: exact where it can be.
    void change(const ViewPrograms& programs, const FirstShot& first_shot);
    /// Looks at lamps of so many pixels, whose points it has asked for the last time. False where
    /// nothing can be done at present.
    bool advance(const ViewPrograms& programs, const FirstShot& first_shot, std::size_t points);
    /// Whether every pixel has the exact light of all lamps that reach anything round it.
    [[nodiscard]] bool exact() const { return exact_; }
    [[nodiscard]] std::size_t bytes() const { return sums_.bytes() + 2 * points_.bytes(); }

  private:
    using Row = std::vector<std::uint32_t>;
    void count(const ViewPrograms& programs, const FirstShot& first_shot) const;
    bool plan(const ManyLamps& many);
    void request_points(const ViewPrograms& programs, const ManyLamps& many, std::size_t points);
    void finish_rows(const ViewPrograms& programs, const FirstShot& first_shot);
    void add(const ViewPrograms& programs, ManyLamps& many, const Row& row, std::size_t first,
             std::size_t end, bool before) const;

    std::size_t pixels_ = 0;
    std::uint64_t version_ = 0;  // of the lamps
    unsigned level_ = 0;         // that comes next
    bool exact_ = false, done_ = false;
    std::vector<Row> rows_;  // of that level
    bool planned_ = false;
    std::size_t row_ = 0, next_ = 0;                            // and the pixel that comes next
    std::vector<std::pair<std::size_t, std::size_t>> skipped_;  // ranks of dark lamps
    std::size_t asked_end_ = 0;     // of the pixels from next_ on whose points have been asked for
    Buffer points_;                 // of those
    std::optional<Readback> back_;  // of these
    Buffer sums_;
};

}  // namespace raybundle
